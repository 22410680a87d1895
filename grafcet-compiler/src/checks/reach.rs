//! Steps that nothing can activate, as far as structure and constants tell.

use std::collections::{BTreeMap, BTreeSet};

use super::constants::truth;
use crate::diagnostic::{Diagnostic, Rule};
use crate::model::{Encloses, GraphId, Model, Order, Situation, StepId, TransitionId, Trigger};

/// Warns of steps that no evolution, forcing or enclosing can activate.
pub(super) fn advise(model: &Model, diagnostics: &mut Vec<Diagnostic>) {
    let reached = Reach::of(model);
    for (index, step) in model.steps.iter().enumerate() {
        if !reached[index] {
            let message = format!("nothing can activate step {}", step.id);
            let diagnostic = Diagnostic::new(Rule::UnreachableStep, step.span, message)
                .help("lead a transition to it, or make it initial");
            diagnostics.push(diagnostic);
        }
    }
}

/// Spreads from what is active at first.
struct Reach<'m> {
    model: &'m Model,
    reached: Vec<bool>,
    /// Steps whose consequences are still to be followed.
    waiting: Vec<StepId>,
    /// Transitions that each step helps to arm.
    leaving: BTreeMap<StepId, Vec<TransitionId>>,
    /// Entrance steps of each transition that are not reached yet.
    missing: Vec<usize>,
    /// Enclosed graphs, and whether an enclosing step has been reached.
    enclosed: BTreeMap<GraphId, bool>,
    /// Graphs whose initial steps have been reached.
    initialised: BTreeSet<GraphId>,
}

impl<'m> Reach<'m> {
    fn of(model: &'m Model) -> Vec<bool> {
        let enclosed = model.steps.iter().flat_map(|step| &step.encloses);
        let mut reach = Reach {
            model,
            reached: vec![false; model.steps.len()],
            waiting: Vec::new(),
            leaving: BTreeMap::new(),
            missing: model
                .transitions
                .iter()
                .map(|it| it.entrance.len())
                .collect(),
            enclosed: enclosed.map(|it| (it.graph, false)).collect(),
            initialised: BTreeSet::new(),
        };
        for (index, transition) in model.transitions.iter().enumerate() {
            for step in &transition.entrance {
                reach
                    .leaving
                    .entry(*step)
                    .or_default()
                    .push(TransitionId(index));
            }
        }
        reach.begin();
        while let Some(step) = reach.waiting.pop() {
            reach.follow(step);
        }
        reach.reached
    }

    fn begin(&mut self) {
        let model = self.model;
        for graph in (0..model.graphs.len()).map(GraphId) {
            if !self.enclosed.contains_key(&graph) {
                self.reach_initial(graph);
                self.fire_sources(graph);
            }
            for order in model[graph].always.iter().flat_map(|action| &action.orders) {
                self.force(order);
            }
        }
    }

    fn follow(&mut self, step: StepId) {
        let model = self.model;
        for encloses in &model[step].encloses {
            self.enclose(step, encloses);
        }
        for order in &model[step].action.orders {
            self.force(order);
        }
        for transition in self.leaving.get(&step).cloned().unwrap_or_default() {
            self.missing[transition.0] -= 1;
            if self.missing[transition.0] == 0 {
                self.fire(transition);
            }
        }
    }

    fn enclose(&mut self, step: StepId, encloses: &Encloses) {
        self.reach_all(encloses.steps.iter().copied());
        if self.model[step].initial {
            self.reach_initial(encloses.graph);
        }
        if self.enclosed.insert(encloses.graph, true) == Some(false) {
            self.fire_sources(encloses.graph);
        }
    }

    fn force(&mut self, order: &Order) {
        let never = order
            .condition
            .as_ref()
            .and_then(|it| it.constant(self.model))
            == Some(0);
        match &order.situation {
            _ if never => {}
            Situation::Steps(steps) => self.reach_all(steps.iter().copied()),
            Situation::Initial => self.reach_initial(order.graph),
            Situation::Current => {}
        }
    }

    /// Only the first order or enclosing has to look at all initial steps.
    fn reach_initial(&mut self, graph: GraphId) {
        if self.initialised.insert(graph) {
            self.reach_all(self.model.initial_steps(graph));
        }
    }

    fn fire_sources(&mut self, graph: GraphId) {
        let model = self.model;
        for transition in model[graph]
            .transition_ids()
            .filter(|id| model[*id].entrance.is_empty())
        {
            self.fire(transition);
        }
    }

    fn fire(&mut self, transition: TransitionId) {
        let transition = &self.model[transition];
        let never = match &transition.trigger {
            Trigger::Expression(trigger) => truth(self.model, trigger) == Some(false),
            Trigger::Always | Trigger::Unknown => false,
        };
        if !never {
            self.reach_all(transition.exit.iter().copied());
        }
    }

    fn reach_all(&mut self, steps: impl Iterator<Item = StepId>) {
        for step in steps {
            if !std::mem::replace(&mut self.reached[step.0], true) {
                self.waiting.push(step);
            }
        }
    }
}
