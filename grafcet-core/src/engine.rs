//! One scan at a time: the phases of `semantics.md` in their order.

use crate::bits::{set_bits, set_bits_of};
use crate::images::Images;
use crate::memory::{Memory, remembered};
use crate::program::{Bit, Evolution, Graph, Number, Program, Slot, Step};
use crate::watch::Pass;

/// Rounds of one scan after which a program that evolves `stable` counts as unstable.
pub const MAX_ROUNDS: u32 = 100;

/// A program and its memory.
///
/// Between scans, inputs and parameters are written and everything can be read; during one, nothing else is looked
/// at. Scan 0 is [`Engine::start`]; each later scan is one call of [`Engine::scan`] with its time stamp.
#[derive(Debug)]
pub struct Engine<'p, 'm> {
    pub(crate) program: &'p Program<'p>,
    pub(crate) memory: Memory<'m>,
    /// The time stamp of the scan, in ms since scan 0.
    pub(crate) now_ms: u64,
}

impl<'p, 'm> Engine<'p, 'm> {
    /// Takes a program and memory for it. All variables have their declared values; nothing is active yet.
    pub fn new(program: &'p Program<'p>, memory: Memory<'m>) -> Self {
        let mut engine = Engine {
            program,
            memory,
            now_ms: 0,
        };
        engine.memory.clear();
        for (value, row) in engine.memory.numbers.iter_mut().zip(program.numbers) {
            *value = row.initial;
        }
        for bit in program.initially_true {
            engine.memory.set_bit(*bit, true);
        }
        engine
    }

    /// The program.
    #[must_use]
    pub fn program(&self) -> &'p Program<'p> {
        self.program
    }

    /// Gives a retained variable or parameter its stored value, before [`Engine::start`]. A value that the variable
    /// cannot have is not taken, and the answer is False: the declared value stays.
    pub fn restore(&mut self, slot: Slot, value: i32) -> bool {
        match slot {
            Slot::Bit(bit) => {
                let fits = matches!(value, 0 | 1);
                if fits {
                    self.memory.set_bit(bit, value == 1);
                }
                fits
            }
            Slot::Number(number) => {
                let fits = self.clamp(number, value) == value;
                if fits {
                    self.memory.set_number(number, value);
                }
                fits
            }
        }
    }

    /// Sets `System:recovered`, before [`Engine::start`].
    pub fn set_recovered(&mut self, recovered: bool) {
        self.memory.set_bit(Bit::RECOVERED, recovered);
    }

    /// Sets `System:overruns`; a count beyond 2^31 - 1 stays there.
    pub fn set_overruns(&mut self, overruns: u32) {
        let overruns = i32::try_from(overruns).unwrap_or(i32::MAX);
        self.memory.set_number(Number::OVERRUNS, overruns);
    }

    /// Writes a Boolean input for the next scan. A bit that is no input is left alone.
    pub fn set_input(&mut self, bit: Bit, value: bool) {
        if self.program.layout.inputs.indices().contains(&bit.word()) {
            self.memory.set_bit(bit, value);
        }
    }

    /// Writes a numeric input for the next scan, clamped to its range and counted when it goes out of it.
    pub fn sample_number(&mut self, number: Number, raw: i32) {
        let inputs = self.program.layout.number_inputs;
        if !inputs.indices().contains(&usize::from(number.0)) {
            return;
        }
        let value = self.clamp(number, raw);
        let place = number.0 - inputs.start;
        let outside = Bit(self.program.layout.outside.start * 32 + place);
        if value != raw && !self.memory.bit(outside) {
            self.count_arithmetic_fault();
        }
        self.memory.set_bit(outside, value != raw);
        self.memory.set_number(number, value);
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
            Slot::Bit(bit) => self.memory.set_bit(bit, value != 0),
            Slot::Number(number) => self.store_number(number, value),
        }
    }

    /// Scan 0: initialisation, at time 0.
    pub fn start(&mut self) {
        let program = self.program;
        self.now_ms = 0;
        self.memory.set_bit(Bit::FIRST_SCAN, true);
        self.take_initial_situations();
        self.watch(program.trigger_watches, Pass::Start);
        self.settle_hierarchy(Pass::Start);
        self.stamp_activations();
        self.watch(program.round_watches, Pass::Start);
        self.watch(program.action_watches, Pass::Start);
        self.run_changes();
        self.run_lasting();
        self.run_momentary();
        self.memory.forget_start();
    }

    /// Scan k > 0, at its scheduled release time in ms since scan 0. Times must not descend.
    pub fn scan(&mut self, time_ms: u64) {
        self.now_ms = time_ms;
        self.memory.set_bit(Bit::FIRST_SCAN, false);
        self.memory.remember(&self.program.layout);
        self.memory.mark_scan();
        match self.program.evolution {
            Evolution::Scan => {
                self.evolve(Pass::First);
                self.watch(self.program.action_watches, Pass::First);
                self.run_changes();
            }
            Evolution::Stable => {
                let settled = self.evolve_until_stable();
                self.memory.set_bit(Bit::UNSTABLE, !settled);
                self.watch(self.program.action_watches, Pass::First);
            }
        }
        self.run_lasting();
        self.run_momentary();
    }

    /// Phases 2 to 5, once.
    fn evolve(&mut self, pass: Pass) {
        self.watch(self.program.trigger_watches, pass);
        self.mark_fired();
        self.fire();
        self.refresh_macros();
        self.settle_hierarchy(pass);
        self.stamp_activations();
        for (passed, fired) in self.memory.passed.iter_mut().zip(&*self.memory.fired) {
            *passed |= fired;
        }
    }

    /// Rounds of phases 2 to 5 with the statements that belong to a change, until nothing fires or the situation is
    /// the one before the round. False when the last permitted round still changed it.
    fn evolve_until_stable(&mut self) -> bool {
        let mut pass = Pass::First;
        for _ in 0..MAX_ROUNDS {
            // The scan has remembered what is before its first round.
            if pass == Pass::Later {
                self.memory.remember(&self.program.layout);
            }
            self.evolve(pass);
            if pass == Pass::First {
                self.watch(self.program.round_watches, pass);
            }
            self.run_changes();
            if !self.any_fired() || !self.any_changed() {
                return true;
            }
            pass = Pass::Later;
        }
        false
    }

    fn any_changed(&self) -> bool {
        let steps = self.program.layout.situations.indices();
        let now = self.memory.image.get(steps).into_iter().flatten();
        now.zip(self.memory.before.iter())
            .any(|(now, before)| now != before)
    }

    /// A Boolean as the latest scan left it.
    #[must_use]
    pub fn bit(&self, bit: Bit) -> bool {
        self.memory.bit(bit)
    }

    /// A number as the latest scan left it.
    #[must_use]
    pub fn number(&self, number: Number) -> i32 {
        self.memory.number(number)
    }

    /// A Boolean (0 or 1) or a number as the latest scan left it.
    #[must_use]
    pub fn value(&self, slot: Slot) -> i32 {
        match slot {
            Slot::Bit(bit) => i32::from(self.bit(bit)),
            Slot::Number(number) => self.number(number),
        }
    }

    /// Both images as the latest scan left them.
    #[must_use]
    pub fn images(&self) -> Images<'_> {
        Images {
            image: self.memory.image,
            numbers: self.memory.numbers,
        }
    }

    /// The image: one bit for each Boolean.
    #[must_use]
    pub fn image(&self) -> &[u32] {
        self.memory.image
    }

    /// The numbers.
    #[must_use]
    pub fn numbers(&self) -> &[i32] {
        self.memory.numbers
    }

    /// The transitions that fired in the latest scan, as indices in [`Program::transitions`], in source order.
    pub fn fired(&self) -> impl Iterator<Item = usize> + '_ {
        set_bits(self.memory.passed)
    }

    /// Whether the latest scan changed a graph's situation.
    #[must_use]
    pub fn graph_changed(&self, graph: usize) -> bool {
        self.situation(graph).any(|(_, now, before)| now != before)
    }

    /// Whether the latest scan gave a graph its situation by forcing or enclosing, against its own evolution.
    #[must_use]
    pub fn graph_forced(&self, graph: usize) -> bool {
        self.memory
            .standings
            .get(graph)
            .is_some_and(|standing| standing.void)
    }

    /// The active steps of a graph, as indices in [`Program::steps`], in source order.
    pub fn active_steps(&self, graph: usize) -> impl Iterator<Item = usize> + '_ {
        self.situation(graph)
            .flat_map(|(first, now, _)| set_bits_of(now).map(move |bit| first + bit))
    }

    /// The steps that were active before the latest scan, likewise.
    pub fn steps_before(&self, graph: usize) -> impl Iterator<Item = usize> + '_ {
        self.situation(graph)
            .flat_map(|(first, _, before)| set_bits_of(before).map(move |bit| first + bit))
    }

    /// Word by word: index of the first step in it, the situation now and before the latest scan.
    fn situation(&self, graph: usize) -> impl Iterator<Item = (usize, u32, u32)> + '_ {
        let program = self.program;
        let graph = program.graphs.get(graph).copied();
        graph.into_iter().flat_map(move |graph| {
            let first = usize::from(graph.steps.start);
            graph
                .words
                .indices()
                .enumerate()
                .map(move |(offset, word)| {
                    let before = remembered(&program.layout, word)
                        .and_then(|word| self.memory.before_scan.get(word).copied())
                        .unwrap_or(0);
                    (first + offset * 32, self.memory.word(word), before)
                })
        })
    }

    /// The step with that place among the steps of a graph.
    pub(crate) fn step(&self, graph: &Graph, place: usize) -> Option<&'p Step> {
        graph.steps.of(self.program.steps).get(place)
    }

    /// Stores a number, clamped to its range and counted when it lies outside.
    pub(crate) fn store_number(&mut self, number: Number, value: i32) {
        let clamped = self.clamp(number, value);
        if clamped != value {
            self.count_arithmetic_fault();
        }
        self.memory.set_number(number, clamped);
    }

    pub(crate) fn count_arithmetic_fault(&mut self) {
        let count = self.memory.number(Number::ARITHMETIC_FAULTS);
        self.memory
            .set_number(Number::ARITHMETIC_FAULTS, count.saturating_add(1));
    }

    fn clamp(&self, number: Number, value: i32) -> i32 {
        match self.program.numbers.get(usize::from(number.0)) {
            // Not `clamp`, which panics when the ends are reversed.
            Some(row) => value.max(row.min).min(row.max),
            None => value,
        }
    }
}
