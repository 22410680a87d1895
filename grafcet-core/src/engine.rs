//! One scan at a time: the phases of `semantics.md` in their order.

use core::hint::cold_path;

use crate::bits::Flag;
use crate::evolution::Moved;
use crate::memory::{Bank, Memory};
use crate::program::{Bit, Compiled, Evolution, Number, Program, Slot};
use crate::watch::Pass;

/// Rounds of one scan after which a program that evolves `stable` counts as unstable.
pub const MAX_ROUNDS: u32 = 100;

/// Nothing is idle for longer, in ms: 6 days.
pub(crate) const LONG: u32 = 1 << 29;

/// Statements of actions, so many at most, that there is code for twice.
const FEW_STATEMENTS: usize = 16;

/// A program and its memory.
///
/// Between scans, inputs and parameters are written and everything can be read; during one, nothing else is looked
/// at. Scan 0 is [`Engine::start`]; each later scan is one call of [`Engine::scan`] with its time stamp.
// What every scan reads lies in front, where one instruction of a small processor reaches it.
#[repr(C)]
#[derive(Debug)]
pub struct Engine<P, M> {
    pub(crate) tables: P,
    /// The time stamp of the latest scan that was no idle one, in ms since scan 0.
    pub(crate) now_ms: u64,
    /// The situations are on the move and phase 5 has not timed the new ones yet.
    pub(crate) settling: Flag,
    /// Scans are idle for so long behind that one, in ms, [`LONG`] at most: 0 when the next one finds something new,
    /// otherwise until the next timer runs out that was found running.
    pub(crate) quiet_ms: u32,
    pub(crate) memory: Bank<M>,
}

impl<P: Compiled, M: Memory> Engine<P, M> {
    /// Takes a program and memory for it. All variables have their declared values; nothing is active yet.
    pub fn new(tables: P, store: M) -> Self {
        let mut engine = Engine {
            tables,
            now_ms: 0,
            settling: Flag::Off,
            quiet_ms: 0,
            memory: Bank { store },
        };
        let program = tables.program();
        engine.memory.clear();
        let values = engine.memory.store.numbers_mut().iter_mut();
        for (value, row) in values.zip(program.numbers) {
            *value = row.initial;
        }
        for bit in program.initially_true {
            engine.memory.raise_bit(*bit);
        }
        engine
    }

    /// Where it finds its program.
    #[must_use]
    pub fn tables(&self) -> P {
        self.tables
    }

    /// The program.
    #[must_use]
    pub fn program(&self) -> &Program<'_> {
        self.tables.program()
    }

    /// Gives a retained variable or parameter its stored value, before [`Engine::start`]. A value that the variable
    /// cannot have is not taken, and the answer is False: the declared value stays.
    pub fn restore(&mut self, slot: Slot, value: i32) -> bool {
        match slot {
            Slot::Bit(bit) => {
                let fits = matches!(value, 0 | 1);
                if fits {
                    self.memory.put_bit(bit, value == 1);
                }
                fits
            }
            Slot::Number(number) => {
                let fits = self.clamp(number, value) == value;
                if fits {
                    self.memory.put_number(number, value);
                }
                fits
            }
        }
    }

    /// Sets `System:recovered`, before [`Engine::start`].
    pub fn set_recovered(&mut self, recovered: bool) {
        self.memory.put_bit(Bit::RECOVERED, recovered);
    }

    /// Sets `System:overruns`; a count beyond 2^31 - 1 stays there.
    pub fn set_overruns(&mut self, overruns: u32) {
        let overruns = i32::try_from(overruns).unwrap_or(i32::MAX);
        if self.memory.put_number(Number::OVERRUNS, overruns) {
            self.note_change();
        }
    }

    /// Writes a Boolean input for the next scan. A bit that is no input is left alone.
    pub fn set_input(&mut self, bit: Bit, value: bool) {
        let tables = self.tables;
        let program = tables.program();
        let words = program.layout.inputs;
        if !words.indices().contains(&bit.word()) || !self.memory.put_bit(bit, value) {
            return;
        }
        let read = program.read_inputs.get(bit.word() - words.indices().start);
        if read.is_some_and(|read| read & bit.mask() != 0) {
            self.note_change();
        }
    }

    /// Writes 32 Boolean inputs for the next scan: the word with that place among the words of inputs, in which they
    /// lie in the order of their declarations.
    #[inline]
    pub fn set_inputs(&mut self, place: u16, inputs: u32) {
        let tables = self.tables;
        let program = tables.program();
        let word = usize::from(program.layout.inputs.start) + usize::from(place);
        let Some(read) = program.read_inputs.get(usize::from(place)) else {
            return;
        };
        let Some(word) = self.memory.store.image_mut().get_mut(word) else {
            return;
        };
        let changed = core::mem::replace(word, inputs) ^ inputs;
        if changed & read != 0 {
            self.note_change();
        }
    }

    /// Writes a numeric input for the next scan, clamped to its range and counted when it goes out of it.
    pub fn sample_number(&mut self, number: Number, raw: i32) {
        let tables = self.tables;
        let program = tables.program();
        let inputs = program.layout.number_inputs;
        if !inputs.indices().contains(&usize::from(number.0)) {
            return;
        }
        let value = self.clamp(number, raw);
        let place = number.0 - inputs.start;
        let outside = Bit(program.layout.outside.start * 32 + place);
        let is_outside = value != raw;
        let crossed = self.memory.put_bit(outside, is_outside);
        if crossed && is_outside {
            self.count_arithmetic_fault();
        }
        if self.memory.put_number(number, value) || crossed {
            self.note_change();
        }
    }

    /// Writes an input of either kind for the next scan.
    pub fn sample(&mut self, slot: Slot, value: i32) {
        match slot {
            Slot::Bit(bit) => self.set_input(bit, value != 0),
            Slot::Number(number) => self.sample_number(number, value),
        }
    }

    /// Gives a parameter a new value between two scans, clamped to its range and counted when it lies outside.
    pub fn set_parameter(&mut self, slot: Slot, value: i32) {
        match slot {
            Slot::Bit(bit) => self.set_bit(bit, value != 0),
            Slot::Number(number) => self.store_number(number, value),
        }
        self.note_change();
    }

    /// Scan 0: initialisation, at time 0.
    pub fn start(&mut self) {
        let tables = self.tables;
        let program = tables.program();
        self.now_ms = 0;
        self.memory.raise_bit(Bit::FIRST_SCAN);
        self.take_initial_situations();
        self.settling = Flag::On;
        if !self.has_hierarchy() {
            // These are the situations already.
            self.stamp_activations();
        }
        self.watch_inputs(Pass::Start);
        self.watch(program.trigger_watches, Pass::Start);
        if self.has_hierarchy() {
            self.settle_hierarchy(Pass::Start);
            self.stamp_activations();
        }
        self.settling = Flag::Off;
        self.watch(program.round_watches, Pass::Start);
        self.watch(program.action_watches, Pass::Start);
        self.run_changes();
        self.run_lasting();
        self.run_momentary();
        self.memory.forget_start();
        self.find_armed();
        if !self.keeps_first_scan() {
            self.memory.clear_bit(Bit::FIRST_SCAN);
        }
        self.note_change();
    }

    /// Scan k > 0, at its scheduled release time in ms since scan 0, below 2^62. Times must not descend, and no scan
    /// comes 2^31 ms (24 days) or more behind the one before.
    ///
    /// False when it was an idle one: no input is new, no timer has run out and the scan before has changed nothing,
    /// so that this one would find and do exactly the same. Nothing is evaluated then, and nothing needs writing.
    #[inline]
    pub fn scan(&mut self, time_ms: u64) -> bool {
        let idle = self.is_idle(time_ms);
        if !idle {
            self.scan_apart(time_ms);
        }
        !idle
    }

    /// Kept apart from what calls [`Engine::scan`], which mostly is an idle one.
    #[inline(never)]
    fn scan_apart(&mut self, time_ms: u64) {
        self.full_scan(time_ms);
    }

    /// Whether a scan at that time would be an idle one.
    #[inline(always)]
    pub fn is_idle(&self, time_ms: u64) -> bool {
        if self.is_timed() {
            // The low words will do, since this is known again after 6 days at most.
            (time_ms as u32).wrapping_sub(self.now_ms as u32) < self.quiet_ms
        } else {
            self.quiet_ms != 0
        }
    }

    /// Whether the situations are on the move, which they are at a time of their own only in a hierarchy.
    #[inline(always)]
    pub(crate) fn is_settling(&self) -> bool {
        self.asks_while_settling() && self.settling == Flag::On
    }

    /// Whether somebody may ask then when a step was activated.
    #[inline(always)]
    fn asks_while_settling(&self) -> bool {
        self.has_hierarchy() && !self.memory.store.stamps().is_empty()
    }

    #[inline(always)]
    fn set_settling(&mut self, settling: Flag) {
        if self.asks_while_settling() {
            self.settling = settling;
        }
    }

    /// Whether a graph forces or encloses another.
    #[inline(always)]
    fn has_hierarchy(&self) -> bool {
        !self.memory.store.standings().is_empty()
    }

    /// Whether `System:first_scan` is True until the next scan. It need not be where nobody reads it, neither the
    /// program nor, as on a host, somebody who looks on between two scans.
    #[inline(always)]
    fn keeps_first_scan(&self) -> bool {
        !P::UNROLLED || self.program().reads_first_scan
    }

    /// Whether the program has timers.
    #[inline(always)]
    pub(crate) fn is_timed(&self) -> bool {
        !self.memory.store.stamps().is_empty() || !self.memory.store.since().is_empty()
    }

    /// A scan that is not idle, or as if it was not.
    #[inline]
    pub fn full_scan(&mut self, time_ms: u64) {
        let tables = self.tables;
        let program = tables.program();
        // What changes from here on, or waits for its time, puts an end to this.
        if self.is_timed() {
            self.quiet_ms = LONG;
            self.pass_time(time_ms);
        } else {
            // Nobody asks for how long.
            self.quiet_ms = 1;
        }
        if self.keeps_first_scan() {
            self.memory.clear_bit(Bit::FIRST_SCAN);
        }
        let moved = match program.evolution {
            Evolution::Scan => self.evolve_once(),
            Evolution::Stable => self.evolve_until_stable(),
        };
        if moved.any && self.acts_little() {
            cold_path();
            self.run_lasting();
            self.run_momentary();
            return;
        }
        self.run_lasting();
        // Written out, what fires is mostly all that there is.
        let shows = if P::UNROLLED { moved.any } else { moved.shows };
        if shows || self.momentary_varies() {
            self.run_momentary();
        }
    }

    /// Whether actions are so few, and all in steps, that those of a scan in which something fires have code of their own:
    /// the other scan then need not remember that nothing has.
    #[inline(always)]
    fn acts_little(&self) -> bool {
        let program = self.program();
        let few = program.stored.len() + program.momentary.len() <= FEW_STATEMENTS;
        few && program.always_stored.len == 0 && self.shows_in_steps()
    }

    /// Phases 2 to 6, but for the statements that follow no change.
    #[inline(always)]
    fn evolve_once(&mut self) -> Moved {
        let tables = self.tables;
        let program = tables.program();
        let moved = self.evolve(Pass::First);
        self.watch(program.action_watches, Pass::First);
        if moved.any || !program.events.is_empty() {
            self.run_changes();
        }
        moved
    }

    /// Phases 2 to 5, once.
    #[inline(always)]
    fn evolve(&mut self, pass: Pass) -> Moved {
        let tables = self.tables;
        let program = tables.program();
        // It is. Here the compiler learns it, and that timers of triggers need no second look.
        self.set_settling(Flag::Off);
        self.clear_marks();
        self.watch_inputs(pass);
        self.watch(program.trigger_watches, pass);
        self.memory.remember_macros(&program.layout);
        let marked = self.mark_fired();
        let mut moved = Moved {
            any: marked.any,
            shows: marked.shows,
        };
        if moved.any {
            self.fire(marked);
            self.refresh_macros();
        }
        if self.has_hierarchy() {
            self.set_settling(Flag::On);
            if self.settle_hierarchy(pass) {
                moved.any = self.any_fired() || self.any_changed();
            }
            moved.shows = moved.any;
        }
        if moved.any {
            self.note_change();
            self.stamp_activations();
        }
        self.set_settling(Flag::Off);
        moved
    }

    /// Phases 2 to 5 of a round, kept apart from the loop around it: the compiler would work longer on both.
    #[inline(never)]
    fn round(&mut self, pass: Pass) -> bool {
        self.evolve(pass).any
    }

    /// Rounds of phases 2 to 5 with the statements that belong to a change, until nothing fires or the situation is
    /// the one before the round. When the last permitted round still changed it, the program is unstable.
    fn evolve_until_stable(&mut self) -> Moved {
        let tables = self.tables;
        let program = tables.program();
        self.memory.mark_scan(&program.layout);
        let mut pass = Pass::First;
        let mut moved = false;
        let mut settled = false;
        for _ in 0..MAX_ROUNDS {
            moved |= self.round(pass);
            self.memory.note_passed();
            if pass == Pass::First {
                self.watch(program.round_watches, pass);
            }
            self.run_changes();
            settled = !self.any_fired() || !self.any_changed();
            if settled {
                break;
            }
            pass = Pass::Later;
        }
        self.set_bit(Bit::UNSTABLE, !settled);
        self.watch(program.action_watches, Pass::First);
        Moved {
            any: moved,
            shows: moved,
        }
    }

    /// Whether the situation is another than before this scan (round).
    #[inline(always)]
    fn any_changed(&self) -> bool {
        let tables = self.tables;
        let program = tables.program();
        let steps = program.layout.situations.indices();
        let now = self.memory.store.image().get(steps).into_iter().flatten();
        now.zip(self.memory.store.before().iter())
            .any(|(now, before)| now != before)
    }

    /// Stores a Boolean.
    pub(crate) fn set_bit(&mut self, bit: Bit, value: bool) {
        if self.memory.put_bit(bit, value) {
            self.note_change();
        }
    }

    /// Stores a number, clamped to its range and counted when it lies outside.
    pub(crate) fn store_number(&mut self, number: Number, value: i32) {
        let clamped = self.clamp(number, value);
        if clamped != value {
            self.count_arithmetic_fault();
        }
        if self.memory.put_number(number, clamped) {
            self.note_change();
        }
    }

    pub(crate) fn count_arithmetic_fault(&mut self) {
        let count = self.memory.number(Number::ARITHMETIC_FAULTS);
        let count = count.saturating_add(1);
        if self.memory.put_number(Number::ARITHMETIC_FAULTS, count) {
            self.note_change();
        }
    }

    /// Notes that the next scan may find something else than this one.
    #[inline(always)]
    pub(crate) fn note_change(&mut self) {
        self.quiet_ms = 0;
    }

    fn clamp(&self, number: Number, value: i32) -> i32 {
        let tables = self.tables;
        let program = tables.program();
        match program.numbers.get(usize::from(number.0)) {
            // Not `clamp`, which panics when the ends are reversed.
            Some(row) => value.max(row.min).min(row.max),
            None => value,
        }
    }
}
