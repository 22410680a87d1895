//! One program on its way to tables.

use std::collections::BTreeMap;

use grafcet_core::program::{
    Crossing, Dependent, Enclosing, Event, Evolution, Momentary, Order, Run, Stamp, Stored,
    Transition,
};

use super::atoms::Atom;
use super::fingerprint;
use super::graph::{GraphOrders, StepRuns};
use super::limits::{self, index};
use super::places::{Contents, Places};
use super::pool::{Pool, Shared};
use super::reads;
use super::sequence;
use super::timing::Timing;
use super::watch::{Context, Memories, Watches};
use crate::application::Tables;
use crate::diagnostic::Diagnostic;
use crate::emit;
use crate::model::{GraphId, Model};

/// What a program stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// The controller or a plant: it has graphs of its own.
    Graphs,
    /// The expressions of a test.
    Observer,
}

/// Tables as they grow, with all that is needed to fill them.
pub(super) struct Lowering<'m> {
    pub model: &'m Model,
    pub kind: Kind,
    pub places: Places,
    pub pool: Pool,
    pub watches: Watches,
    pub memories: Memories,
    /// The graphs, in the order of their rows.
    pub graphs: Vec<GraphId>,
    pub rows: Rows,
    activations: BTreeMap<Atom, Stamp>,
    pub(super) timing: Timing,
}

/// Rows that refer to what lies in other tables.
#[derive(Default)]
pub(super) struct Rows {
    pub links: Shared<u16>,
    pub situations: Vec<u32>,
    pub stored: Shared<Stored>,
    pub events: Vec<Event>,
    pub momentary: Shared<Momentary>,
    pub orders: Vec<Order>,
    pub enclosings: Vec<Enclosing>,
    pub transitions: Vec<Transition>,
    pub crossings: Shared<Crossing>,
    pub do_blocks: Shared<Run>,
    /// What each step does, in the order of the steps.
    pub steps: Vec<StepRuns>,
    pub dependent: Vec<Dependent>,
    pub always_stored: Run,
    pub always_momentary: Run,
    /// What the stand-alone actions of each graph force.
    pub graph_orders: Vec<GraphOrders>,
    /// Rows of what encloses each graph.
    pub enclosing_runs: Vec<Run>,
    known_situations: BTreeMap<Vec<u32>, u16>,
    /// Those of the graphs' initial steps.
    pub initial_situations: BTreeMap<GraphId, u16>,
}

/// In a program with more words of situations it is noted which of them hold anything.
const FEW_WORDS: u16 = 8;

impl Rows {
    /// Index of the first word of a situation; equal ones share their words.
    pub fn situation(&mut self, words: Vec<u32>) -> u16 {
        if let Some(first) = self.known_situations.get(&words) {
            return *first;
        }
        let first = index(self.situations.len());
        self.situations.extend(&words);
        self.known_situations.insert(words, first);
        first
    }
}

impl<'m> Lowering<'m> {
    /// An empty program with everything in its place.
    pub fn new(model: &'m Model, kind: Kind, contents: Contents) -> Self {
        let places = Places::new(model, &contents);
        let memories = Memories {
            bits: places.next_bit,
            stamps: 0,
        };
        Lowering {
            model,
            kind,
            places,
            pool: Pool::default(),
            watches: Watches::default(),
            memories,
            graphs: contents.graphs,
            rows: Rows {
                do_blocks: Shared::behind(Run::EMPTY),
                ..Rows::default()
            },
            activations: BTreeMap::new(),
            timing: Timing::default(),
        }
    }

    /// Whether a step or macro step belongs to this program.
    pub fn is_own(&self, atom: Atom) -> bool {
        let graph = match atom {
            Atom::Step(id) => self.model[id].graph,
            Atom::Macro(id) => self.model[id].graph,
            Atom::Variable(_) | Atom::System(_) => return false,
        };
        self.graphs.binary_search(&graph).is_ok()
    }

    /// The row of a graph.
    pub fn graph_row(&self, graph: GraphId) -> usize {
        self.graphs.binary_search(&graph).unwrap_or(usize::MAX)
    }

    /// Where the time of activation of a step or macro step is kept, because a timer reads it.
    pub fn activation(&mut self, atom: Atom) -> Stamp {
        let memories = &mut self.memories;
        *self
            .activations
            .entry(atom)
            .or_insert_with(|| memories.stamp())
    }

    /// Lowers everything in the graphs.
    pub fn lower_graphs(&mut self) {
        self.lower_actions();
        self.lower_transitions();
        self.rows.graph_orders = self.lower_orders();
        self.rows.enclosing_runs = self.lower_enclosings();
    }

    /// The finished tables, unless they are too large.
    pub fn finish(mut self) -> Result<(Tables, Places), Vec<Diagnostic>> {
        let activations = std::mem::take(&mut self.activations);
        let edges = self.watches.edges();
        let (watches, runs) = std::mem::take(&mut self.watches).table();
        let run = |context| runs.get(&context).copied().unwrap_or_default();
        let structure = self.structure(&activations, run);
        let mut layout = self.places.layout;
        layout.words = index(self.memories.bits.div_ceil(32));
        layout.numbers = index(self.places.numbers.len());
        layout.stamps = index(self.memories.stamps);
        layout.since = index(self.timing.steps());
        layout.stack = index(self.pool.stack);
        layout.before = index(layout.situation_words());
        layout.fired = index(self.rows.transitions.len().div_ceil(32));
        let evolution = match self.kind {
            Kind::Graphs if self.model.stable => Evolution::Stable,
            Kind::Graphs | Kind::Observer => Evolution::Scan,
        };
        layout.passed = match evolution {
            Evolution::Scan => 0,
            Evolution::Stable => layout.fired,
        };
        if evolution == Evolution::Stable || !self.rows.enclosings.is_empty() {
            layout.remembered = index(layout.situation_words());
        }
        if !self.rows.orders.is_empty() || !self.rows.enclosings.is_empty() {
            layout.standings = index(structure.graphs.len());
        }
        if layout.situations.len > FEW_WORDS {
            layout.sets = index(layout.set_words());
        }
        if layout.momentary.len > 1 {
            layout.shown = layout.momentary.len;
        }
        let rows = self.rows;
        let mut tables = Tables {
            period_ms: self.model.period_ms,
            evolution,
            fingerprint: 0,
            layout,
            read_inputs: Vec::new(),
            reads_first_scan: false,
            crosses_at_once: false,
            marks_all: true,
            graphs: structure.graphs,
            roles: structure.roles,
            hierarchy: structure.hierarchy,
            blocks: structure.blocks,
            masks: structure.masks,
            actors: Vec::new(),
            steps: structure.steps,
            lasting_in_steps: structure.duties.iter().any(|row| row.stored.len > 0),
            momentary_varies: !rows.dependent.is_empty()
                || rows.momentary.rows.iter().any(|row| row.condition > 0),
            stores_on_change: structure
                .duties
                .iter()
                .any(|row| row.on_activation.len > 0 || row.on_deactivation.len > 0)
                || rows.do_blocks.rows.len() > 1,
            duties: structure.duties,
            macros: structure.macros,
            transitions: rows.transitions,
            crossings: rows.crossings.rows,
            do_blocks: rows.do_blocks.rows,
            links: rows.links.rows,
            arms: structure.arms,
            sources: structure.sources,
            situations: rows.situations,
            enclosings: rows.enclosings,
            orders: rows.orders,
            stored: rows.stored.rows,
            events: rows.events,
            always_stored: rows.always_stored,
            targets: self.pool.targets.rows,
            momentary: rows.momentary.rows,
            always_momentary: rows.always_momentary,
            dependent: rows.dependent,
            edges,
            watches,
            trigger_watches: run(Context::Trigger),
            round_watches: run(Context::Round),
            action_watches: run(Context::Action),
            conditions: self.pool.conditions.rows,
            terms: self.pool.terms.rows,
            timers: self.pool.timers.rows,
            codes: self.pool.codes.rows,
            ops: self.pool.ops,
            numbers: std::mem::take(&mut self.places.numbers),
            initially_true: std::mem::take(&mut self.places.initially_true),
            retained: Vec::new(),
        };
        let mut beyond = self.pool.beyond;
        beyond.extend(limits::check(
            &tables,
            self.memories.bits,
            self.memories.stamps,
            self.model.span,
        ));
        if !beyond.is_empty() {
            return Err(beyond);
        }
        sequence::join(&mut tables);
        if !emit::is_unrolled(&tables.program()) {
            let program = tables.program();
            tables.actors = (0..program.actor_rows())
                .map(|row| program.actors_of(row))
                .collect();
            tables.layout = tables.layout.with_armed();
        }
        tables.read_inputs = reads::inputs(&tables);
        tables.reads_first_scan = reads::first_scan(&tables);
        tables.crosses_at_once = tables.program().can_cross_at_once();
        tables.fingerprint = fingerprint::of(&tables);
        debug_assert_eq!(tables.program().unsoundness(), None);
        Ok((tables, self.places))
    }
}
