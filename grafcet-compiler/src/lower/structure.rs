//! Graphs and steps: the rows that refer to all others.

use std::collections::BTreeMap;

use grafcet_core::program::{
    Arm, Block, Duties, Graph, Macro, Masks, Momentary, Role, Run, Since, Stamp, Step,
};

use super::atoms::Atom;
use super::graph::{StepRuns, since};
use super::limits::{MOST_OF_A_STEP, count, index, too_many};
use super::pool::Shared;
use super::unit::Lowering;
use super::watch::Context;
use crate::model::{self, GraphId, Hierarchy, Situation, StepId};

/// The rows that are made last, when it is known which steps are timed.
pub(super) struct Structure {
    pub graphs: Vec<Graph>,
    pub roles: Vec<Role>,
    pub hierarchy: Vec<u16>,
    pub steps: Vec<Step>,
    pub duties: Vec<Duties>,
    pub blocks: Vec<Block>,
    pub masks: Vec<Masks>,
    pub macros: Vec<Macro>,
    pub arms: Vec<Arm>,
    /// Graphs with transitions without entrance steps.
    pub sources: Vec<u16>,
}

impl Lowering<'_> {
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
            roles: Vec::new(),
            hierarchy: self.hierarchy(),
            steps: Vec::with_capacity(self.rows.steps.len()),
            duties: Vec::new(),
            blocks: Vec::new(),
            masks: Vec::new(),
            macros: Vec::new(),
            arms: Vec::new(),
            sources: Vec::new(),
        };
        let mut duties = Shared::behind(duties_of(&StepRuns::default(), None, None));
        let mut roles = Shared::behind(Role::NONE);
        let mut masks = Shared::default();
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
                structure.arms.extend(armed.map(|row| Arm::alone(*row)));
                let activated = activations.get(&Atom::Step(step)).copied();
                let (arms, momentary) = (structure.arms.len() - start, runs.momentary.len);
                self.limit_step(step, arms, usize::from(momentary));
                structure.steps.push(Step {
                    first_arm: index(start),
                    first_momentary: runs.momentary.start,
                    duties: duties.row(duties_of(&runs, activated, self.timing.since(step))),
                    arm_count: count(arms),
                    momentary_count: count(usize::from(momentary)),
                });
            }
            let start = structure.arms.len();
            if !sources.is_empty() {
                structure.sources.push(index(row));
            }
            structure
                .arms
                .extend(sources.iter().map(|row| Arm::alone(*row)));
            let own = graph.steps.start - first_step..graph.steps.end - first_step;
            let steps = structure.steps.get(own.clone()).unwrap_or_default();
            let words = steps.chunks(32).zip(own.step_by(32));
            structure.blocks.extend(words.map(|(steps, first)| Block {
                first: index(first),
                masks: masks.row(masks_of(steps, &duties.rows, &self.rows.momentary.rows)),
                momentary: mask(steps, |step| step.momentary_count > 0),
            }));
            let orders = orders.get(row).copied().unwrap_or_default();
            let role = roles.row(Role {
                sources: since(&structure.arms, start),
                enclosings: enclosings.get(row).copied().unwrap_or_default(),
                orders: orders.others,
                self_orders: orders.own,
                watches: watches(Context::Forcing(row)),
                self_watches: watches(Context::SelfForcing(row)),
            });
            let words = self.places.situations.get(row).copied();
            structure.graphs.push(Graph {
                steps: rows(graph.steps.clone(), first_step),
                first_word: words.unwrap_or_default().start,
                transitions: rows(graph.transitions.clone(), first_transition),
                initial: self.situation_row(id, &Situation::Initial),
                role,
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
        structure.roles = roles.rows;
        structure.masks = masks.rows;
        structure
    }

    /// Reports a step that has too much of something.
    fn limit_step(&mut self, step: StepId, arms: usize, momentary: usize) {
        let span = self.model[step].span;
        let counts = [
            (
                arms,
                "transitions that have it as their first entrance step",
            ),
            (momentary, "momentary statements"),
        ];
        let beyond = counts
            .into_iter()
            .filter(|(count, _)| *count > MOST_OF_A_STEP);
        let beyond = beyond.map(|(count, what)| too_many(count, what, span));
        self.pool.beyond.extend(beyond);
    }

    fn hierarchy(&self) -> Vec<u16> {
        let order = Hierarchy::of(self.model, &self.graphs).order;
        order
            .into_iter()
            .map(|graph| index(self.graph_row(graph)))
            .collect()
    }
}

/// Which of some steps that share a word do something beside momentary actions, and whose of those have conditions.
fn masks_of(steps: &[Step], duties: &[Duties], momentary: &[Momentary]) -> Masks {
    let acting = |acts: &dyn Fn(&Duties) -> bool| {
        let of = |step: &Step| duties.get(usize::from(step.duties));
        mask(steps, |step| of(step).is_some_and(acts))
    };
    Masks {
        timed: acting(&|duties| duties.activated.is_some() || duties.since.is_some()),
        stored: acting(&|duties| duties.stored.len > 0),
        on_activation: acting(&|duties| duties.on_activation.len > 0),
        on_deactivation: acting(&|duties| duties.on_deactivation.len > 0),
        on_event: acting(&|duties| duties.on_event.len > 0),
        forcing: acting(&|duties| duties.orders.len > 0),
        varying: mask(steps, |step| {
            let mut rows = step.momentary().of(momentary).iter();
            rows.any(|row| row.condition > 0)
        }),
    }
}

/// Those of some steps that share a word of which something is so.
fn mask(steps: &[Step], is: impl Fn(&Step) -> bool) -> u32 {
    let bits = steps.iter().enumerate().filter(|(_, step)| is(step));
    bits.fold(0, |mask, (place, _)| mask | 1 << place)
}

fn duties_of(runs: &StepRuns, activated: Option<Stamp>, since: Option<Since>) -> Duties {
    Duties {
        stored: runs.stored,
        on_activation: runs.on_activation,
        on_deactivation: runs.on_deactivation,
        on_event: runs.on_event,
        orders: runs.orders,
        activated,
        since,
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
