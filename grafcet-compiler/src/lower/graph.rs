//! Transitions, forcing, enclosing: what joins steps and graphs.

use std::collections::BTreeMap;

use grafcet_core::program::{Crossing, Enclosing, Forced, Order, Run, Transition};

use super::atoms::Atom;
use super::limits::index;
use super::node::Node;
use super::unit::Lowering;
use super::watch::Context;
use crate::model::{self, GraphId, Situation, StepId, TransitionId, Trigger};

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

/// Rows added to a table since it had a length. No rows are the same wherever there are none, so that what refers to
/// none is equal.
pub(super) fn since<T>(table: &[T], start: usize) -> Run {
    if table.len() == start {
        return Run::EMPTY;
    }
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
        let (node, span) = match &transition.trigger {
            Trigger::Always | Trigger::Unknown => (Node::Constant(1), self.model.span),
            Trigger::Expression(trigger) => {
                let entrance = transition.entrance.clone();
                let node = |unit: &mut Self| unit.node(trigger, Context::Trigger);
                (self.while_active(entrance, node), trigger.span)
            }
        };
        let others = transition.entrance.iter().skip(1);
        let others: Vec<_> = others
            .map(|step| self.places.bit(Atom::Step(*step)))
            .collect();
        let fires = self.pool.headed(&others, &node, span);
        let actions = self.stored(&transition.action.stored, self.change());
        let actions = self.rows.do_blocks.row(actions);
        let crossing = self.crossing(transition, actions);
        Transition {
            fires: fires.condition,
            term: fires.first,
            crossing: self.rows.crossings.row(crossing),
        }
    }

    fn crossing(&mut self, transition: &model::Transition, actions: u16) -> Crossing {
        let own = &self.model[transition.graph].steps;
        if own.len() > 32 {
            return Crossing::Across {
                actions,
                entrance: self.link(own.start, &transition.entrance),
                exit: self.link(own.start, &transition.exit),
            };
        }
        let mask = |steps: &[StepId]| {
            let bits = steps.iter().map(|step| 1 << (step.0 - own.start));
            bits.fold(0, |mask, bit: u32| mask | bit)
        };
        Crossing::Within {
            actions,
            leaves: mask(&transition.entrance),
            enters: mask(&transition.exit),
        }
    }

    /// Steps of a large graph, counted from its first one.
    fn link(&mut self, first: usize, steps: &[StepId]) -> Run {
        let places = steps.iter().map(|step| index(step.0 - first));
        self.rows.links.run(places.collect())
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
        let others = self.orders(others.into_iter(), row, Context::Forcing, rank);
        let own = self.orders(own.into_iter(), row, Context::SelfForcing, rank);
        for step in model[graph].step_ids() {
            let orders = model[step].action.orders.iter();
            let run = self.orders(orders, row, Context::Forcing, rank);
            if let Some(runs) = self.step_runs(step) {
                runs.orders = run;
            }
        }
        GraphOrders { others, own }
    }

    fn orders<'o>(
        &mut self,
        orders: impl Iterator<Item = &'o model::Order>,
        by: usize,
        context: fn(usize) -> Context,
        rank: impl Fn(&model::Order) -> u16,
    ) -> Run {
        let context = context(by);
        let start = self.rows.orders.len();
        for order in orders {
            let condition = self.optional(order.condition.as_ref(), context);
            let situation = match &order.situation {
                Situation::Current => Forced::Current,
                situation => Forced::Set(self.situation_row(order.graph, situation)),
            };
            let row = Order {
                graph: index(self.graph_row(order.graph)),
                by: index(by),
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
    pub(super) fn first_step(&self) -> usize {
        self.graphs
            .first()
            .map_or(0, |graph| self.model[*graph].steps.start)
    }

    pub(super) fn first_transition(&self) -> usize {
        self.graphs
            .first()
            .map_or(0, |graph| self.model[*graph].transitions.start)
    }

    /// Index of the first word of a situation of a graph.
    pub(super) fn situation_row(&mut self, graph: GraphId, situation: &Situation) -> u16 {
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
}
