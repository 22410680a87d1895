//! Events and actions (`semantics.md`, phases 5 to 7).

use crate::bits::set_bits_of;
use crate::engine::Engine;
use crate::memory::remembered;
use crate::program::{Assignment, Dependent, Momentary, Run, Step, Stored};

/// Which steps an action belongs to.
#[derive(Clone, Copy)]
enum Steps {
    /// Active now.
    Active,
    /// Active before this scan (round).
    Before,
    /// Active now and not before.
    Activated,
    /// Active before and not now.
    Deactivated,
}

impl Engine<'_, '_> {
    /// Phase 5: what has just become active is timed from now.
    pub(crate) fn stamp_activations(&mut self) {
        self.for_each_step(Steps::Activated, |engine, step| {
            if let Some(stamp) = step.activated {
                engine.memory.set_stamp(stamp, engine.now_ms);
            }
        });
        let program = self.program;
        for row in program.macros {
            if let Some(stamp) = row.activated
                && self.memory.bit(row.bit)
                && !self.memory.was_active(&program.layout, row.bit)
            {
                self.memory.set_stamp(stamp, self.now_ms);
            }
        }
    }

    /// Phase 6, the statements that belong to a change: `do`, `on event`, `on deactivation`, `on activation`.
    pub(crate) fn run_changes(&mut self) {
        self.for_each_fired(|engine, transition| engine.run_stored(transition.actions));
        if !self.program.events.is_empty() {
            self.for_each_step(Steps::Before, |engine, step| {
                for event in step.on_event.of(engine.program.events) {
                    if engine.memory.bit(event.event) {
                        engine.run_stored(event.stored);
                    }
                }
            });
        }
        self.for_each_step(Steps::Deactivated, |engine, step| {
            engine.run_stored(step.on_deactivation);
        });
        self.for_each_step(Steps::Activated, |engine, step| {
            engine.run_stored(step.on_activation);
        });
    }

    /// Phase 6, the statements without `on`: stand-alone actions, then actions of the active steps.
    pub(crate) fn run_lasting(&mut self) {
        self.run_stored(self.program.always_stored);
        self.for_each_step(Steps::Active, |engine, step| engine.run_stored(step.stored));
    }

    /// Phase 7: a momentary variable is the OR of its statements, those that read others after those they read.
    pub(crate) fn run_momentary(&mut self) {
        let program = self.program;
        if let Some(words) = self
            .memory
            .image
            .get_mut(program.layout.momentary.indices())
        {
            words.fill(0);
        }
        self.run_momentary_rows(program.always_momentary);
        self.for_each_step(Steps::Active, |engine, step| {
            engine.run_momentary_rows(step.momentary);
        });
        for Dependent { owner, statement } in program.dependent {
            if owner.is_none_or(|step| self.memory.bit(step)) {
                self.run_momentary_row(statement);
            }
        }
    }

    fn run_momentary_rows(&mut self, rows: Run) {
        for row in rows.of(self.program.momentary) {
            self.run_momentary_row(row);
        }
    }

    fn run_momentary_row(&mut self, row: &Momentary) {
        if self.holds(row.condition) {
            for bit in row.targets.of(self.program.links) {
                self.memory.set_bit(*bit, true);
            }
        }
    }

    fn run_stored(&mut self, rows: Run) {
        for Stored {
            assignment,
            condition,
        } in rows.of(self.program.stored)
        {
            if !self.holds(*condition) {
                continue;
            }
            match *assignment {
                Assignment::Bit(bit, value) => {
                    let value = self.holds(value);
                    self.memory.set_bit(bit, value);
                }
                Assignment::Number(number, value) => {
                    let value = self.value_of(value);
                    self.store_number(number, value);
                }
            }
        }
    }

    /// Visits steps in source order.
    fn for_each_step(&mut self, which: Steps, mut visit: impl FnMut(&mut Self, &Step)) {
        let program = self.program;
        for graph in program.graphs {
            for (offset, word) in graph.words.indices().enumerate() {
                let now = self.memory.word(word);
                let before = remembered(&program.layout, word)
                    .and_then(|word| self.memory.before.get(word).copied())
                    .unwrap_or(0);
                let steps = match which {
                    Steps::Active => now,
                    Steps::Before => before,
                    Steps::Activated => now & !before,
                    Steps::Deactivated => before & !now,
                };
                for bit in set_bits_of(steps) {
                    if let Some(step) = self.step(graph, offset * 32 + bit) {
                        visit(self, step);
                    }
                }
            }
        }
    }
}
