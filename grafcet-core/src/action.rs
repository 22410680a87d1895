//! Events and actions (`semantics.md`, phases 5 to 7).

use core::cell::Cell;

use crate::engine::Engine;
use crate::memory::{Following, Memory};
use crate::program::{
    Arm, Assignment, Block, Compiled, Dependent, Masks, Momentary, Program, Run, Step, Stored,
    Target, VisitSteps,
};
use crate::sets::{GROUP, Set};
use crate::walk::{Groups, Visit, each};

impl<P: Compiled, M: Memory> Engine<P, M> {
    /// Phase 5: what has just become active is timed from now.
    #[inline(always)]
    pub(crate) fn stamp_activations(&mut self) {
        let tables = self.tables;
        let program = tables.program();
        if !self.is_timed() {
            return;
        }
        self.for_each_duty(Part::Activated);
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
            self.for_each_fired(|engine, _, transition| {
                let tables = engine.tables;
                engine.run_stored(tables.program().do_block(transition));
            });
        }
        if !program.events.is_empty() {
            self.for_each_duty(Part::OnEvent);
        }
        if program.stores_on_change {
            self.for_each_duty(Part::OnDeactivation);
            self.for_each_duty(Part::OnActivation);
        }
    }

    /// Phase 6, the statements without `on`: stand-alone actions, then actions of the active steps.
    #[inline(always)]
    pub(crate) fn run_lasting(&mut self) {
        let tables = self.tables;
        let program = tables.program();
        self.run_stored(program.always_stored);
        if program.lasting_in_steps {
            self.for_each_duty(Part::Stored);
        }
    }

    /// Whether a walk that is written out can tell by the active steps what momentary variables become.
    #[inline(always)]
    pub(crate) fn shows_in_steps(&self) -> bool {
        let program = self.program();
        P::UNROLLED && program.always_momentary.len == 0 && program.dependent.is_empty()
    }

    /// Whether momentary variables may become others while the situations stay.
    #[inline(always)]
    pub(crate) fn momentary_varies(&mut self) -> bool {
        let tables = self.tables;
        let program = tables.program();
        if !self.shows_in_steps() {
            return program.momentary_varies;
        }
        let mut varying = Varying {
            engine: self,
            any: false,
        };
        tables.each_step(&mut varying);
        varying.any
    }

    /// Phase 7: a momentary variable is the OR of its statements, those that read others after those they read.
    #[inline(always)]
    pub(crate) fn run_momentary(&mut self) {
        if P::UNROLLED {
            self.show_all();
        } else {
            self.show_all_apart();
        }
    }

    /// Kept apart, since a loop need not be written out in scan 0 and in all others.
    #[inline(never)]
    fn show_all_apart(&mut self) {
        self.show_all();
    }

    #[inline(always)]
    fn show_all(&mut self) {
        let tables = self.tables;
        let program = tables.program();
        let words = program.layout.momentary;
        // Mostly there is but one word: it is made beside the image and written once.
        let only = only(program);
        let before = self.memory.word(usize::from(words.start));
        if only.is_none() {
            self.memory.begin_showing(words);
        }
        let mut showing = Showing {
            engine: self,
            shown: 0,
        };
        if let Some(rows) = program.always_momentary.some(program.momentary) {
            each::<P, Momentary>(rows, &mut showing);
        }
        tables.each_step(&mut showing);
        let shown = showing.shown;
        if let Some(only) = only {
            self.memory.put_word(usize::from(only), shown);
        }
        for Dependent { owner, statement } in program.dependent {
            if owner.is_none_or(|step| self.memory.bit(step)) && self.holds_row(statement.condition)
            {
                for target in statement.targets.of(program.targets) {
                    self.memory.raise(*target);
                }
            }
        }
        // Triggers of the next scan see them as this one leaves them.
        let changed = match only {
            Some(only) => self.memory.word(usize::from(only)) != before,
            None => self.memory.shows_something_else(words),
        };
        if changed {
            self.note_change();
        }
    }

    #[inline(always)]
    fn run_stored(&mut self, rows: Run) {
        if rows.len > 0 {
            self.run_rows(rows);
        }
    }

    /// Kept apart, since written out at every place they would be long code.
    fn run_rows(&mut self, rows: Run) {
        let tables = self.tables;
        for row in rows.of(tables.program().stored) {
            self.store(row);
        }
    }

    #[inline(always)]
    fn store(&mut self, row: &Stored) {
        if !self.holds(&row.condition) {
            return;
        }
        match row.assignment {
            Assignment::Bit(bit, value) => {
                let value = self.holds(&value);
                self.set_bit(bit, value);
            }
            Assignment::Number(number, value) => {
                let value = self.value_of(value);
                self.store_number(number, value);
            }
        }
    }

    /// Does in source order what steps do beside momentary actions.
    #[inline(always)]
    fn for_each_duty(&mut self, part: Part) {
        let tables = self.tables;
        let mut acting = Acting { engine: self, part };
        tables.each_step(&mut acting);
    }
}

/// One of the things in [`Duties`](crate::program::Duties), which also says of which steps.
#[derive(Clone, Copy)]
enum Part {
    /// The time of activation, of those active now and not before.
    Activated,
    /// Of those active now.
    Stored,
    /// Of those active now and not before.
    OnActivation,
    /// Of those active before this scan (round) and not now.
    OnDeactivation,
    /// Of those active before this scan (round).
    OnEvent,
}

impl Part {
    /// Those who do it.
    #[inline(always)]
    const fn of(self, masks: &Masks) -> u32 {
        match self {
            Part::Activated => masks.timed,
            Part::Stored => masks.stored,
            Part::OnActivation => masks.on_activation,
            Part::OnDeactivation => masks.on_deactivation,
            Part::OnEvent => masks.on_event,
        }
    }
}

/// Does one thing for some steps.
struct Acting<'e, P, M> {
    engine: &'e mut Engine<P, M>,
    part: Part,
}

impl<P: Compiled, M: Memory> VisitSteps for Acting<'_, P, M> {
    #[inline(always)]
    fn groups(&self, row: usize) -> u32 {
        let tables = self.engine.tables;
        let acting = tables
            .program()
            .actors(row, |actors| self.part.of(&actors.masks));
        self.engine.memory.members(Set::Lively, row) & acting
    }

    #[inline(always)]
    fn choose(&mut self, place: usize, block: &Block) -> u32 {
        let now = self.engine.situation_word(place);
        let before = self.engine.memory.store.before().get(place);
        let before = before.copied().unwrap_or(0);
        let (activated, deactivated) = (now & !before, before & !now);
        let tables = self.engine.tables;
        let acting = self.part.of(tables.program().masks(block));
        match self.part {
            Part::Activated | Part::OnActivation => activated & acting,
            Part::Stored => now & acting,
            Part::OnDeactivation => deactivated & acting,
            Part::OnEvent => before & acting,
        }
    }

    #[inline(always)]
    fn step(&mut self, step: &Step) {
        let tables = self.engine.tables;
        let program = tables.program();
        let Some(duties) = program.duties_of(step) else {
            return;
        };
        match self.part {
            Part::Activated => {
                if let Some(stamp) = duties.activated {
                    self.engine.memory.set_stamp(stamp, self.engine.now_ms);
                }
                if let Some(since) = duties.since {
                    self.engine.memory.set_since(since, self.engine.now_ms);
                }
            }
            Part::Stored => match duties.stored.of(program.stored) {
                // Mostly it is one.
                [row] if P::UNROLLED => self.engine.store(row),
                _ => self.engine.run_stored(duties.stored),
            },
            Part::OnActivation => self.engine.run_stored(duties.on_activation),
            Part::OnDeactivation => self.engine.run_stored(duties.on_deactivation),
            Part::OnEvent => {
                for event in duties.on_event.of(program.events) {
                    if self.engine.memory.bit(event.event) {
                        self.engine.run_stored(event.stored);
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn leave(&mut self, _: usize) {}
}

/// Asks whether a step with conditions in its momentary actions is active.
struct Varying<'e, P, M> {
    engine: &'e mut Engine<P, M>,
    any: bool,
}

impl<P: Compiled, M: Memory> VisitSteps for Varying<'_, P, M> {
    #[inline(always)]
    fn groups(&self, row: usize) -> u32 {
        self.engine.memory.members(Set::Lively, row)
    }

    #[inline(always)]
    fn choose(&mut self, place: usize, block: &Block) -> u32 {
        let tables = self.engine.tables;
        let masks = tables.program().masks(block);
        self.any |= self.engine.situation_word(place) & masks.varying != 0;
        0
    }

    #[inline(always)]
    fn step(&mut self, _: &Step) {}

    #[inline(always)]
    fn leave(&mut self, _: usize) {}
}

/// Raises what momentary statements show.
struct Showing<'e, P, M> {
    engine: &'e mut Engine<P, M>,
    /// What the word of momentary variables becomes, if there is but one.
    shown: u32,
}

impl<P: Compiled, M: Memory> Showing<'_, P, M> {
    /// Raises what the steps of a group of words show, as long as each word has but one and what it shows is known. Gives
    /// the first word of which that is not so.
    ///
    /// Kept apart, so that it has the few registers of a small processor for itself.
    #[inline(never)]
    fn show_group(&mut self, first: usize) -> Option<usize> {
        let tables = self.engine.tables;
        let program = tables.program();
        let start = usize::from(program.layout.situations.start);
        let only = only(program);
        let mut shown = self.shown;
        let Following { image, armed, .. } = self.engine.memory.store.following();
        let image = Cell::from_mut(image).as_slice_of_cells();
        let situations = image.get(start..start + armed.len()).unwrap_or(&[]);
        let (armed, _) = armed.as_chunks::<GROUP>();
        let (situations, _) = situations.as_chunks::<GROUP>();
        let group = first / GROUP;
        let (Some(armed), Some(situations), Some(blocks)) = (
            armed.get(group),
            situations.get(group),
            program.blocks.get(first..),
        ) else {
            return Some(first);
        };
        let blocks = blocks.get(..GROUP).unwrap_or(blocks);
        let end = first + blocks.len();
        let mut words = blocks.iter().zip(situations.iter().zip(armed));
        let mut unknown = None;
        while let Some((block, (situation, armed))) = words.next() {
            if situation.get() & block.momentary == 0 {
                continue;
            }
            let shows = match armed.arm(program.arms) {
                Some(arm) if arm.shows != Arm::SHOWS_MORE => arm.shows,
                _ => {
                    unknown = Some(end - 1 - words.len());
                    break;
                }
            };
            let target = program.targets.get(usize::from(shows).wrapping_sub(1));
            let Some(target) = target else {
                continue;
            };
            if only == Some(target.word) {
                shown |= target.mask;
            } else if let Some(word) = image.get(usize::from(target.word)) {
                word.set(word.get() | target.mask);
            }
        }
        self.shown = shown;
        unknown
    }
}

/// The word of momentary variables, if there is but one.
#[inline(always)]
fn only(program: &Program<'_>) -> Option<u16> {
    let words = program.layout.momentary;
    (words.len == 1).then_some(words.start)
}

impl<P: Compiled, M: Memory> VisitSteps for Showing<'_, P, M> {
    /// Steps whose actions have conditions are not followed.
    #[inline(always)]
    fn is_apart(&self) -> bool {
        let tables = self.engine.tables;
        !tables.program().momentary_varies
    }

    #[inline(always)]
    fn groups(&self, row: usize) -> u32 {
        let tables = self.engine.tables;
        let showing = tables.program().actors(row, |actors| actors.momentary);
        self.engine.memory.members(Set::Lively, row) & showing
    }

    #[inline(always)]
    fn follow(&mut self, groups: &mut Groups) -> Option<usize> {
        for group in groups {
            let unknown = self.show_group(group * GROUP);
            if unknown.is_some() {
                return unknown;
            }
        }
        None
    }

    #[inline(always)]
    fn choose(&mut self, place: usize, block: &Block) -> u32 {
        self.engine.situation_word(place) & block.momentary
    }

    #[inline(always)]
    fn step(&mut self, step: &Step) {
        let tables = self.engine.tables;
        if let Some(rows) = step.momentary().some(tables.program().momentary) {
            each::<P, Momentary>(rows, self);
        }
    }

    #[inline(always)]
    fn leave(&mut self, _: usize) {}
}

impl<P: Compiled, M: Memory> Visit<Momentary> for Showing<'_, P, M> {
    #[inline(always)]
    fn row(&mut self, row: &Momentary) {
        let tables = self.engine.tables;
        if self.engine.holds_row(row.condition)
            && let Some(targets) = row.targets.some(tables.program().targets)
        {
            each::<P, Target>(targets, self);
        }
    }
}

impl<P: Compiled, M: Memory> Visit<Target> for Showing<'_, P, M> {
    #[inline(always)]
    fn row(&mut self, target: &Target) {
        let tables = self.engine.tables;
        if only(tables.program()) == Some(target.word) {
            self.shown |= target.mask;
        } else {
            self.engine.memory.raise(*target);
        }
    }
}
