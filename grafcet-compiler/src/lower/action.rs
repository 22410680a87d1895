//! Actions: stored and momentary statements, in the order in which they run.

use std::collections::BTreeMap;

use grafcet_core::program::{Assignment, Dependent, Event, Momentary, Run, Slot, Stored, Target};

use super::atoms::Atom;
use super::graph::{StepRuns, since};
use super::limits::index;
use super::unit::Lowering;
use super::watch::Context;
use crate::model::{self, Causality, StepId};

impl Lowering<'_> {
    /// Where `do` and `on` statements stand: under `evolution stable` they belong to the rounds.
    pub fn change(&self) -> Context {
        if self.model.stable {
            Context::Round
        } else {
            Context::Action
        }
    }

    /// The stored and momentary statements of stand-alone actions and steps.
    pub fn lower_actions(&mut self) {
        let model = self.model;
        let graphs = self.graphs.clone();
        let always = graphs.iter().flat_map(|graph| &model[*graph].always);
        let always = always.flat_map(|action| &action.stored);
        self.rows.always_stored = self.stored(always, Context::Action);
        for step in self.steps() {
            let runs = self.step_actions(step);
            self.rows.steps.push(runs);
        }
        self.lower_momentary();
    }

    fn steps(&self) -> Vec<StepId> {
        let graphs = self.graphs.iter();
        graphs
            .flat_map(|graph| self.model[*graph].step_ids())
            .collect()
    }

    fn step_actions(&mut self, step: StepId) -> StepRuns {
        let action = &self.model[step].action;
        let change = self.change();
        StepRuns {
            stored: self.while_active(vec![step], |unit| {
                unit.stored(&action.stored, Context::Action)
            }),
            on_activation: self.stored(&action.on_activation, change),
            on_deactivation: self.stored(&action.on_deactivation, change),
            on_event: self.events(step, &action.on_event),
            ..StepRuns::default()
        }
    }

    fn events(&mut self, step: StepId, events: &[model::OnEvent]) -> Run {
        let bit = self.places.bit(Atom::Step(step));
        let change = self.change();
        let start = self.rows.events.len();
        for event in events {
            let row = Event {
                event: self.event(&event.event, bit),
                stored: self.stored(&event.stored, change),
            };
            self.rows.events.push(row);
        }
        since(&self.rows.events, start)
    }

    /// Stored statements, one behind the other.
    pub fn stored<'s>(
        &mut self,
        statements: impl IntoIterator<Item = &'s model::Stored>,
        context: Context,
    ) -> Run {
        let mut rows = Vec::new();
        for statement in statements {
            let Some(slot) = self.places.slot(Atom::Variable(statement.target.variable)) else {
                continue;
            };
            let assignment = match slot {
                Slot::Bit(bit) => Assignment::Bit(bit, self.condition(&statement.value, context)),
                Slot::Number(number) => {
                    Assignment::Number(number, self.code(&statement.value, context))
                }
            };
            let condition = self.optional(statement.condition.as_ref(), context);
            rows.push(Stored {
                assignment,
                condition,
            });
        }
        self.rows.stored.run(rows)
    }

    /// Momentary statements: first those of stand-alone actions, then those of each step; those that depend on others
    /// in the order of their dependencies.
    fn lower_momentary(&mut self) {
        let causality = Causality::of(self.model, &self.graphs);
        let independent = || causality.statements.iter().filter(|it| it.reads.is_empty());
        let always = independent().filter(|it| it.owner.is_none());
        let rows = always
            .map(|it| self.momentary(it.owner, it.statement))
            .collect();
        self.rows.always_momentary = self.rows.momentary.run(rows);
        let in_steps: Vec<_> = independent()
            .filter_map(|it| Some((it.owner?, it.statement)))
            .collect();
        for of_one_step in in_steps.chunk_by(|a, b| a.0 == b.0) {
            let statements = of_one_step.iter();
            let rows = statements.map(|(owner, statement)| self.momentary(Some(*owner), statement));
            let rows = rows.collect();
            let run = self.rows.momentary.run(rows);
            if let Some((step, _)) = of_one_step.first()
                && let Some(runs) = self.step_runs(*step)
            {
                runs.momentary = run;
            }
        }
        for it in causality
            .dependent
            .iter()
            .filter_map(|index| causality.statements.get(*index))
        {
            let row = Dependent {
                owner: it.owner.map(|step| self.places.bit(Atom::Step(step))),
                statement: self.momentary(it.owner, it.statement),
            };
            self.rows.dependent.push(row);
        }
    }

    fn momentary(&mut self, owner: Option<StepId>, statement: &model::Momentary) -> Momentary {
        let mut words: BTreeMap<u16, u32> = BTreeMap::new();
        for target in &statement.targets {
            let bit = self.places.bit(Atom::Variable(target.variable));
            *words.entry(index(bit.word())).or_default() |= bit.mask();
        }
        let targets = words.into_iter();
        let targets = targets.map(|(word, mask)| Target { word, mask });
        let targets = self.pool.targets.run(targets.collect());
        let owner = owner.into_iter().collect();
        let condition = self.while_active(owner, |unit| {
            unit.optional(statement.condition.as_ref(), Context::Action)
        });
        Momentary {
            targets,
            condition: self.pool.conditions.row(condition),
        }
    }
}
