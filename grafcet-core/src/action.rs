//! Events and actions (`semantics.md`, phases 5 to 7).

use crate::bits::{clear, set_bits_of};
use crate::engine::Engine;
use crate::memory::Memory;
use crate::program::{Assignment, Compiled, Dependent, Duties, Momentary, Run, Stored};

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

impl<P: Compiled, M: Memory> Engine<P, M> {
    /// Phase 5: what has just become active is timed from now.
    pub(crate) fn stamp_activations(&mut self) {
        let tables = self.tables;
        let program = tables.program();
        if self.memory.store.stamps().is_empty() {
            return;
        }
        self.for_each_duty(Steps::Activated, |engine, duties| {
            if let Some(stamp) = duties.activated {
                engine.memory.set_stamp(stamp, engine.now_ms);
            }
        });
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
        let tables = self.tables;
        let program = tables.program();
        if program.stores_on_change {
            self.for_each_fired(|engine, transition| engine.run_stored(transition.actions));
        }
        if !program.events.is_empty() {
            self.for_each_duty(Steps::Before, |engine, duties| {
                for event in duties.on_event.of(program.events) {
                    if engine.memory.bit(event.event) {
                        engine.run_stored(event.stored);
                    }
                }
            });
        }
        if program.stores_on_change {
            self.for_each_duty(Steps::Deactivated, |engine, duties| {
                engine.run_stored(duties.on_deactivation);
            });
            self.for_each_duty(Steps::Activated, |engine, duties| {
                engine.run_stored(duties.on_activation);
            });
        }
    }

    /// Phase 6, the statements without `on`: stand-alone actions, then actions of the active steps.
    pub(crate) fn run_lasting(&mut self) {
        let tables = self.tables;
        let program = tables.program();
        self.run_stored(program.always_stored);
        if program.lasting_in_steps {
            self.for_each_duty(Steps::Active, |engine, duties| {
                engine.run_stored(duties.stored);
            });
        }
    }

    /// Phase 7: a momentary variable is the OR of its statements, those that read others after those they read.
    pub(crate) fn run_momentary(&mut self) {
        let tables = self.tables;
        let program = tables.program();
        let words = program.layout.momentary.indices();
        if let Some(words) = self.memory.store.image_mut().get_mut(words) {
            clear(words);
        }
        self.run_momentary_rows(program.always_momentary);
        let first = usize::from(program.layout.situations.start);
        for (place, block) in program.blocks.iter().enumerate() {
            let steps = self.memory.word(first + place) & block.momentary;
            for bit in set_bits_of(steps) {
                if let Some(step) = program.steps.get(usize::from(block.first) + bit) {
                    self.run_momentary_rows(step.momentary);
                }
            }
        }
        for Dependent { owner, statement } in program.dependent {
            if owner.is_none_or(|step| self.memory.bit(step)) {
                self.run_momentary_row(statement);
            }
        }
    }

    fn run_momentary_rows(&mut self, rows: Run) {
        let tables = self.tables;
        let program = tables.program();
        if let Some(rows) = rows.some(program.momentary) {
            for row in rows {
                self.run_momentary_row(row);
            }
        }
    }

    fn run_momentary_row(&mut self, row: &Momentary) {
        let tables = self.tables;
        let program = tables.program();
        if self.holds(&row.condition)
            && let Some(targets) = row.targets.some(program.targets)
        {
            for target in targets {
                if let Some(word) = self
                    .memory
                    .store
                    .image_mut()
                    .get_mut(usize::from(target.word))
                {
                    *word |= target.mask;
                }
            }
        }
    }

    fn run_stored(&mut self, rows: Run) {
        let tables = self.tables;
        let program = tables.program();
        let Some(rows) = rows.some(program.stored) else {
            return;
        };
        for Stored {
            assignment,
            condition,
        } in rows
        {
            if !self.holds(condition) {
                continue;
            }
            match assignment {
                Assignment::Bit(bit, value) => {
                    let value = self.holds(value);
                    self.set_bit(*bit, value);
                }
                Assignment::Number(number, value) => {
                    let value = self.value_of(*value);
                    self.store_number(*number, value);
                }
            }
        }
    }

    /// Visits in source order what steps do beside momentary actions.
    fn for_each_duty(&mut self, which: Steps, mut visit: impl FnMut(&mut Self, &Duties)) {
        let tables = self.tables;
        let program = tables.program();
        let first = usize::from(program.layout.situations.start);
        for (place, block) in program.blocks.iter().enumerate() {
            let now = self.memory.word(first + place);
            let before = self.memory.store.before().get(place).copied().unwrap_or(0);
            let steps = match which {
                Steps::Active => now,
                Steps::Before => before,
                Steps::Activated => now & !before,
                Steps::Deactivated => before & !now,
            } & block.duties;
            for bit in set_bits_of(steps) {
                let step = program.steps.get(usize::from(block.first) + bit);
                if let Some(duties) = step.and_then(|step| program.duties_of(step)) {
                    visit(self, duties);
                }
            }
        }
    }
}
