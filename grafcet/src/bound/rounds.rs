//! How many rounds a scan of a program that evolves `stable` takes at most.

use std::collections::BTreeMap;

use grafcet_compiler::activity::{Activity, Trigger};
use grafcet_core::engine::MAX_ROUNDS;
use grafcet_core::program::{Bit, Condition, Evolution, Program, Watch};

use super::settling::Settling;

/// The rounds of one scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rounds {
    /// It has none: one firing a scan.
    One,
    /// The first, and behind it one for each of so many firings and one in which nothing fires any more.
    Settle {
        /// Firings behind the first round at most.
        firings: u32,
    },
    /// Nothing but the engine's limit ends them for certain.
    Limit,
}

impl Rounds {
    /// Of a program with these graphs.
    #[must_use]
    pub fn of(program: &Program<'_>, graphs: &[&Activity]) -> Self {
        if program.evolution == Evolution::Scan {
            return Rounds::One;
        }
        let mut hierarchy = Hierarchy {
            program,
            graphs,
            steady: Steady::of(program),
            known: vec![None; graphs.len()],
        };
        let firings: Option<u64> = (0..graphs.len())
            .map(|graph| hierarchy.moves(graph).firings)
            .try_fold(0, |sum: u64, firings| Some(sum.saturating_add(firings?)));
        let firings = firings.and_then(|firings| u32::try_from(firings).ok());
        match firings.filter(|firings| *firings < MAX_ROUNDS - 2) {
            Some(firings) => Rounds::Settle { firings },
            None => Rounds::Limit,
        }
    }

    /// As a number.
    #[must_use]
    pub fn most(self) -> u32 {
        match self {
            Rounds::One => 1,
            Rounds::Settle { firings } => firings + 2,
            Rounds::Limit => MAX_ROUNDS,
        }
    }
}

/// What no round behind the first one changes: inputs, and edges, which are False then.
pub struct Steady {
    /// Bits of edges, as masks by words of the image.
    edges: BTreeMap<u16, u32>,
    inputs: std::ops::Range<usize>,
}

impl Steady {
    /// Of a program.
    pub fn of(program: &Program<'_>) -> Self {
        let inputs = program.edges.iter();
        let inputs = inputs.flat_map(|row| [row.rises, row.falls].into_iter().flatten());
        let inputs = inputs.map(|seen| (seen.word, seen.bits));
        let watched = program.watches.iter().filter_map(|watch| match watch {
            Watch::Edge {
                result: Bit(bit), ..
            } => Some((bit / 32, 1 << (bit % 32))),
            _ => None,
        });
        let mut edges = BTreeMap::new();
        for (word, bits) in inputs.chain(watched) {
            *edges.entry(word).or_default() |= bits;
        }
        Steady {
            edges,
            inputs: program.layout.inputs.indices(),
        }
    }

    /// Whether a bit is an input.
    pub fn is_input(&self, bit: u16) -> bool {
        self.inputs.contains(&usize::from(bit / 32))
    }

    /// Whether a bit is an edge.
    pub fn is_edge(&self, bit: u16) -> bool {
        let edges = self.edges.get(&(bit / 32));
        edges.is_some_and(|edges| edges >> (bit % 32) & 1 != 0)
    }

    /// Whether a condition depends on nothing else.
    fn decides(&self, program: &Program<'_>, condition: &Condition) -> bool {
        let is_steady = |bit| self.is_input(bit) || self.is_edge(bit);
        Trigger::when(program, condition).depends_on_none_but(is_steady)
    }
}

/// Graphs, each with what its superiors make it do.
struct Hierarchy<'p> {
    program: &'p Program<'p>,
    graphs: &'p [&'p Activity],
    steady: Steady,
    known: Vec<Option<Moves>>,
}

/// What a graph does behind the first round; nothing is known of one that can go round.
#[derive(Clone, Copy)]
struct Moves {
    /// How often its transitions fire at most.
    firings: Option<u64>,
    /// How often its situation changes at most.
    changes: Option<u64>,
}

impl Moves {
    const UNKNOWN: Moves = Moves {
        firings: None,
        changes: None,
    };
}

impl Hierarchy<'_> {
    fn moves(&mut self, graph: usize) -> Moves {
        if let Some(moves) = self.known.get(graph).copied().flatten() {
            return moves;
        }
        // Who comes back here while this is worked out is its own superior.
        self.note(graph, Moves::UNKNOWN);
        let moves = self.worked_out(graph).unwrap_or(Moves::UNKNOWN);
        self.note(graph, moves);
        moves
    }

    fn note(&mut self, graph: usize, moves: Moves) {
        if let Some(known) = self.known.get_mut(graph) {
            *known = Some(moves);
        }
    }

    fn worked_out(&mut self, graph: usize) -> Option<Moves> {
        let activity = *self.graphs.get(graph)?;
        let settles = Settling::of(self.program, activity, &self.steady).firings()?;
        let stretches = self.stretches(graph);
        let firings = match settles {
            0 => Some(0),
            _ => stretches.map(|stretches| settles.saturating_mul(stretches)),
        };
        let changes = firings.zip(stretches);
        let changes = changes.map(|(firings, stretches)| firings.saturating_add(stretches));
        Some(Moves { firings, changes })
    }

    /// The stretches of rounds in which no superior of a graph changes: in each it is ordered into one situation, or comes
    /// to rest on its own.
    fn stretches(&mut self, graph: usize) -> Option<u64> {
        let mut stretches: u64 = 1;
        for superior in self.superiors(graph)? {
            stretches = stretches.saturating_add(self.moves(superior).changes?);
        }
        Some(stretches)
    }

    /// The graphs on whose situations it depends whether one is forced or enclosed; none are known when it depends on
    /// more.
    fn superiors(&self, graph: usize) -> Option<Vec<usize>> {
        let mut superiors = Vec::new();
        let orders = self.program.orders.iter().enumerate();
        for (row, order) in orders.filter(|(_, order)| usize::from(order.graph) == graph) {
            if !self.steady.decides(self.program, &order.condition) {
                return None;
            }
            let by = usize::from(order.by);
            let role = self.program.role(self.program.graphs.get(by)?);
            let stands_alone = [role.orders, role.self_orders];
            if !stands_alone.iter().any(|run| run.indices().contains(&row)) {
                superiors.push(by);
            }
        }
        let role = self.program.role(self.program.graphs.get(graph)?);
        for enclosing in role.enclosings.of(self.program.enclosings) {
            let word = enclosing.step.word();
            let mut graphs = self.program.graphs.iter();
            superiors.push(graphs.position(|graph| graph.words().indices().contains(&word))?);
        }
        superiors.sort_unstable();
        superiors.dedup();
        Some(superiors)
    }
}
