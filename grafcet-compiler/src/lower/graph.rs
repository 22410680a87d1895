//! Graphs, steps, transitions, enclosing: the rows with the structure.

use std::collections::BTreeMap;

use grafcet_core::program::{
    Arm, Block, Crossing, Duties, Enclosing, Forced, Graph, Macro, Order, Run, Stamp, Step, Term,
    Transition,
};

use super::atoms::Atom;
use super::limits::index;
use super::node::Node;
use super::pool::{NO_TERM, Shared};
use super::unit::Lowering;
use super::watch::Context;
use crate::model::{self, GraphId, Hierarchy, Situation, StepId, TransitionId, Trigger};

/// Rows of what a step does.
#[derive(Clone, Copy, Default)]
pub(super) struct StepRuns {
    pub momentary: Run,
    pub stored: Run,
    pub on_activation: Run,
    pub on_deactivation: Run,
    pub on_event: Run,
    pub orders: Run,
}

/// Rows of what the stand-alone actions of a graph force.
#[derive(Clone, Copy, Default)]
pub(super) struct GraphOrders {
    pub others: Run,
    pub own: Run,
}

/// The rows that are made last, when it is known which steps are timed.
pub(super) struct Structure {
    pub graphs: Vec<Graph>,
    pub hierarchy: Vec<u16>,
    pub steps: Vec<Step>,
    pub duties: Vec<Duties>,
    pub blocks: Vec<Block>,
    pub macros: Vec<Macro>,
    pub arms: Vec<Arm>,
    /// Graphs with transitions without entrance steps.
    pub sources: Vec<u16>,
}

/// Rows added to a table since it had a length.
pub(super) fn since<T>(table: &[T], start: usize) -> Run {
    Run {
        start: index(start),
        len: index(table.len() - start),
    }
}

impl Lowering<'_> {
    /// The triggers and links of all transitions.
    pub fn lower_transitions(&mut self) {
        for graph in self.graphs.clone() {
            for id in self.model[graph].transition_ids() {
                let row = self.transition(id);
                self.rows.transitions.push(row);
            }
        }
    }

    fn transition(&mut self, id: TransitionId) -> Transition {
        let transition = &self.model[id];
        let crossing = self.crossing(transition);
        let (node, span) = match &transition.trigger {
            Trigger::Always | Trigger::Unknown => (Node::Constant(1), self.model.span),
            Trigger::Expression(trigger) => (self.node(trigger, Context::Trigger), trigger.span),
        };
        let others = transition.entrance.iter().skip(1);
        let others: Vec<_> = others
            .map(|step| self.places.bit(Atom::Step(*step)))
            .collect();
        let fires = self.pool.headed(&others, &node, span);
        self.rows.firsts.push(fires.first);
        let actions = self.stored(&transition.action.stored, self.change());
        Transition {
            fires: fires.condition,
            crossing,
            actions,
        }
    }

    fn crossing(&mut self, transition: &model::Transition) -> Crossing {
        let own = &self.model[transition.graph].steps;
        if own.len() > 32 {
            return Crossing::Across {
                entrance: self.link(&transition.entrance),
                exit: self.link(&transition.exit),
            };
        }
        let mask = |steps: &[StepId]| {
            let bits = steps.iter().map(|step| 1 << (step.0 - own.start));
            bits.fold(0, |mask, bit: u32| mask | bit)
        };
        Crossing::Within {
            leaves: mask(&transition.entrance),
            enters: mask(&transition.exit),
        }
    }

    fn link(&mut self, steps: &[StepId]) -> Run {
        let start = self.rows.links.len();
        let bits = steps.iter().map(|step| self.places.bit(Atom::Step(*step)));
        self.rows.links.extend(bits);
        since(&self.rows.links, start)
    }

    /// The forcing statements of all graphs: of each the stand-alone ones, then those of its steps.
    pub fn lower_orders(&mut self) -> Vec<GraphOrders> {
        let graphs = self.graphs.clone();
        graphs
            .into_iter()
            .map(|graph| self.orders_of(graph))
            .collect()
    }

    fn orders_of(&mut self, graph: GraphId) -> GraphOrders {
        let model = self.model;
        let row = self.graph_row(graph);
        let always = || model[graph].always.iter().flat_map(|action| &action.orders);
        let in_steps = model[graph]
            .step_ids()
            .flat_map(|step| &model[step].action.orders);
        let mut places: Vec<_> = always().chain(in_steps).map(|order| order.span).collect();
        places.sort_unstable();
        let rank =
            |order: &model::Order| index(places.partition_point(|place| *place < order.span));
        let (own, others): (Vec<&model::Order>, Vec<&model::Order>) =
            always().partition(|order| order.graph == graph);
        let others = self.orders(others.into_iter(), Context::Forcing(row), rank);
        let own = self.orders(own.into_iter(), Context::SelfForcing(row), rank);
        for step in model[graph].step_ids() {
            let orders = model[step].action.orders.iter();
            let run = self.orders(orders, Context::Forcing(row), rank);
            if let Some(runs) = self.step_runs(step) {
                runs.orders = run;
            }
        }
        GraphOrders { others, own }
    }

    fn orders<'o>(
        &mut self,
        orders: impl Iterator<Item = &'o model::Order>,
        context: Context,
        rank: impl Fn(&model::Order) -> u16,
    ) -> Run {
        let start = self.rows.orders.len();
        for order in orders {
            let condition = self.optional(order.condition.as_ref(), context);
            let situation = match &order.situation {
                Situation::Current => Forced::Current,
                situation => Forced::Set(self.situation_row(order.graph, situation)),
            };
            let row = Order {
                graph: index(self.graph_row(order.graph)),
                rank: rank(order),
                situation,
                condition,
            };
            self.rows.orders.push(row);
        }
        since(&self.rows.orders, start)
    }

    /// What a step does, by its row.
    pub fn step_runs(&mut self, step: StepId) -> Option<&mut StepRuns> {
        let first = self.first_step();
        self.rows.steps.get_mut(step.0 - first)
    }

    /// The steps of a program lie one behind the other in the model.
    fn first_step(&self) -> usize {
        self.graphs
            .first()
            .map_or(0, |graph| self.model[*graph].steps.start)
    }

    fn first_transition(&self) -> usize {
        self.graphs
            .first()
            .map_or(0, |graph| self.model[*graph].transitions.start)
    }

    /// Index of the first word of a situation of a graph.
    fn situation_row(&mut self, graph: GraphId, situation: &Situation) -> u16 {
        if *situation != Situation::Initial {
            return self.new_situation_row(graph, situation);
        }
        if let Some(row) = self.rows.initial_situations.get(&graph) {
            return *row;
        }
        let row = self.new_situation_row(graph, situation);
        self.rows.initial_situations.insert(graph, row);
        row
    }

    fn new_situation_row(&mut self, graph: GraphId, situation: &Situation) -> u16 {
        let active = self.model.steps_of(graph, situation).unwrap_or_default();
        let steps = self.model[graph].steps.clone();
        let mut words = vec![0_u32; steps.len().div_ceil(32)];
        for step in active {
            let place = step.0 - steps.start;
            if let Some(word) = words.get_mut(place / 32) {
                *word |= 1 << (place % 32);
            }
        }
        self.rows.situation(words)
    }

    /// The steps that enclose graphs, for each enclosed graph in source order.
    pub fn lower_enclosings(&mut self) -> Vec<Run> {
        let model = self.model;
        let mut enclosed: BTreeMap<GraphId, Vec<(StepId, &[StepId])>> = BTreeMap::new();
        for step in self
            .graphs
            .iter()
            .flat_map(|graph| model[*graph].step_ids())
        {
            for encloses in &model[step].encloses {
                let by = enclosed.entry(encloses.graph).or_default();
                by.push((step, &encloses.steps));
            }
        }
        let mut runs = Vec::with_capacity(self.graphs.len());
        for graph in self.graphs.clone() {
            let start = self.rows.enclosings.len();
            for (step, set) in enclosed.get(&graph).into_iter().flatten() {
                let row = self.enclosing(graph, *step, set);
                self.rows.enclosings.push(row);
            }
            runs.push(since(&self.rows.enclosings, start));
        }
        runs
    }

    fn enclosing(&mut self, graph: GraphId, step: StepId, set: &[StepId]) -> Enclosing {
        let situation = self.situation_row(graph, &Situation::Steps(set.to_vec()));
        let has_initial = self.model.initial_steps(graph).next().is_some();
        let at_start = if has_initial {
            self.situation_row(graph, &Situation::Initial)
        } else {
            situation
        };
        Enclosing {
            step: self.places.bit(Atom::Step(step)),
            situation,
            at_start: self.model[step].initial.then_some(at_start),
        }
    }

    /// The structure, made when everything else is.
    pub fn structure(
        &mut self,
        activations: &BTreeMap<Atom, Stamp>,
        watches: impl Fn(Context) -> Run,
    ) -> Structure {
        let model = self.model;
        let graphs = self.graphs.clone();
        let (first_step, first_transition) = (self.first_step(), self.first_transition());
        let enclosings = std::mem::take(&mut self.rows.enclosing_runs);
        let orders = std::mem::take(&mut self.rows.graph_orders);
        let mut structure = Structure {
            graphs: Vec::with_capacity(graphs.len()),
            hierarchy: self.hierarchy(),
            steps: Vec::with_capacity(self.rows.steps.len()),
            duties: Vec::new(),
            blocks: Vec::new(),
            macros: Vec::new(),
            arms: Vec::new(),
            sources: Vec::new(),
        };
        let mut duties = Shared::default();
        duties.row(duties_of(&StepRuns::default(), None));
        for (row, &id) in graphs.iter().enumerate() {
            let graph = &model[id];
            let (armed, sources) = armed_by(model, id, first_transition);
            for step in graph.step_ids() {
                let runs = self
                    .rows
                    .steps
                    .get(step.0 - first_step)
                    .copied()
                    .unwrap_or_default();
                let start = structure.arms.len();
                let armed = armed.get(&step).into_iter().flatten();
                structure.arms.extend(armed.map(|row| self.arm(*row)));
                let activated = activations.get(&Atom::Step(step)).copied();
                structure.steps.push(Step {
                    arms: since(&structure.arms, start),
                    momentary: runs.momentary,
                    duties: duties.row(duties_of(&runs, activated)),
                });
            }
            let start = structure.arms.len();
            if !sources.is_empty() {
                structure.sources.push(index(row));
            }
            structure
                .arms
                .extend(sources.iter().map(|row| self.arm(*row)));
            let own = graph.steps.start - first_step..graph.steps.end - first_step;
            let steps = structure.steps.get(own.clone()).unwrap_or_default();
            structure.blocks.extend(
                steps
                    .chunks(32)
                    .zip(own.step_by(32))
                    .map(|(steps, first)| block(index(first), steps)),
            );
            let orders = orders.get(row).copied().unwrap_or_default();
            structure.graphs.push(Graph {
                steps: rows(graph.steps.clone(), first_step),
                words: self.places.situations.get(row).copied().unwrap_or_default(),
                transitions: rows(graph.transitions.clone(), first_transition),
                sources: since(&structure.arms, start),
                initial: self.situation_row(id, &Situation::Initial),
                enclosings: enclosings.get(row).copied().unwrap_or_default(),
                orders: orders.others,
                self_orders: orders.own,
                watches: watches(Context::Forcing(row)),
                self_watches: watches(Context::SelfForcing(row)),
            });
            // Inner macro steps stand behind outer ones in the model.
            structure
                .macros
                .extend(graph.macro_ids().rev().map(|id| Macro {
                    bit: self.places.bit(Atom::Macro(id)),
                    graph: index(row),
                    steps: rows(model[id].steps.clone(), first_step),
                    activated: activations.get(&Atom::Macro(id)).copied(),
                }));
        }
        structure.duties = duties.rows;
        structure
    }

    fn arm(&self, transition: u16) -> Arm {
        let first = self.rows.firsts.get(usize::from(transition));
        let Term { word, mask, state } = first.copied().unwrap_or(NO_TERM);
        Arm {
            transition,
            word,
            mask,
            state,
        }
    }

    fn hierarchy(&self) -> Vec<u16> {
        let order = Hierarchy::of(self.model, &self.graphs).order;
        order
            .into_iter()
            .map(|graph| index(self.graph_row(graph)))
            .collect()
    }
}

/// Steps that share a word.
fn block(first: u16, steps: &[Step]) -> Block {
    let mask = |acts: fn(&Step) -> bool| {
        let bits = steps.iter().enumerate().filter(|(_, step)| acts(step));
        bits.fold(0, |mask, (place, _)| mask | 1 << place)
    };
    Block {
        first,
        momentary: mask(|step| step.momentary.len > 0),
        duties: mask(|step| step.duties > 0),
    }
}

fn duties_of(runs: &StepRuns, activated: Option<Stamp>) -> Duties {
    Duties {
        stored: runs.stored,
        on_activation: runs.on_activation,
        on_deactivation: runs.on_deactivation,
        on_event: runs.on_event,
        orders: runs.orders,
        activated,
    }
}

fn rows(range: std::ops::Range<usize>, first: usize) -> Run {
    Run {
        start: index(range.start - first),
        len: index(range.len()),
    }
}

/// The transitions that each step of a graph arms first, and those without entrance steps.
fn armed_by(
    model: &model::Model,
    graph: GraphId,
    first: usize,
) -> (BTreeMap<StepId, Vec<u16>>, Vec<u16>) {
    let mut armed: BTreeMap<StepId, Vec<u16>> = BTreeMap::new();
    let mut sources = Vec::new();
    for id in model[graph].transition_ids() {
        let row = index(id.0 - first);
        match model[id].entrance.first() {
            Some(step) => armed.entry(*step).or_default().push(row),
            None => sources.push(row),
        }
    }
    (armed, sources)
}
