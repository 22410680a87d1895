//! Graphs, steps, transitions, enclosing: the rows with the structure.

use std::collections::BTreeMap;

use grafcet_core::program::{Enclosing, Forced, Graph, Macro, Order, Run, Stamp, Step, Transition};

use super::atoms::Atom;
use super::limits::index;
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
    pub macros: Vec<Macro>,
    pub armed_by: Vec<u16>,
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
        let entrance = self.link(&transition.entrance);
        let exit = self.link(&transition.exit);
        let trigger = match &transition.trigger {
            Trigger::Always | Trigger::Unknown => grafcet_core::program::Condition::Always,
            Trigger::Expression(expression) => self.condition(expression, Context::Trigger),
        };
        let actions = self.stored(&transition.action.stored, self.change());
        Transition {
            entrance,
            exit,
            trigger,
            actions,
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
            macros: Vec::new(),
            armed_by: Vec::new(),
        };
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
                let start = structure.armed_by.len();
                structure
                    .armed_by
                    .extend(armed.get(&step).into_iter().flatten());
                structure.steps.push(Step {
                    transitions: since(&structure.armed_by, start),
                    momentary: runs.momentary,
                    stored: runs.stored,
                    on_activation: runs.on_activation,
                    on_deactivation: runs.on_deactivation,
                    on_event: runs.on_event,
                    orders: runs.orders,
                    activated: activations.get(&Atom::Step(step)).copied(),
                });
            }
            let start = structure.armed_by.len();
            structure.armed_by.extend(sources);
            let orders = orders.get(row).copied().unwrap_or_default();
            structure.graphs.push(Graph {
                steps: rows(graph.steps.clone(), first_step),
                words: self.places.situations.get(row).copied().unwrap_or_default(),
                transitions: rows(graph.transitions.clone(), first_transition),
                sources: since(&structure.armed_by, start),
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
        structure
    }

    fn hierarchy(&self) -> Vec<u16> {
        let order = Hierarchy::of(self.model, &self.graphs).order;
        order
            .into_iter()
            .map(|graph| index(self.graph_row(graph)))
            .collect()
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
