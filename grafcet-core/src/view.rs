//! What the latest scan left, for whoever looks at it.

use crate::bits::{set_bits, set_bits_of};
use crate::engine::Engine;
use crate::images::Images;
use crate::memory::{Memory, remembered};
use crate::program::{Bit, Compiled, Evolution, Number, Slot};

impl<P: Compiled, M: Memory> Engine<P, M> {
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
            image: self.memory.store.image(),
            numbers: self.memory.store.numbers(),
        }
    }

    /// The image: one bit for each Boolean.
    #[must_use]
    pub fn image(&self) -> &[u32] {
        self.memory.store.image()
    }

    /// The numbers.
    #[must_use]
    pub fn numbers(&self) -> &[i32] {
        self.memory.store.numbers()
    }

    /// The transitions that fired in the latest scan, as indices in [`Program::transitions`](crate::program::Program::transitions), in source order.
    pub fn fired(&self) -> impl Iterator<Item = usize> + '_ {
        let tables = self.tables;
        let program = tables.program();
        set_bits(match program.evolution {
            Evolution::Scan => self.memory.store.fired(),
            Evolution::Stable => self.memory.store.passed(),
        })
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
            .store
            .standings()
            .get(graph)
            .is_some_and(|standing| standing.is_void())
    }

    /// The active steps of a graph, as indices in [`Program::steps`](crate::program::Program::steps), in source order.
    pub fn active_steps(&self, graph: usize) -> impl Iterator<Item = usize> + '_ {
        self.situation(graph)
            .flat_map(|(first, now, _)| set_bits_of(now).map(move |bit| first + bit))
    }

    /// The steps that were active before the latest scan, likewise.
    pub fn steps_before(&self, graph: usize) -> impl Iterator<Item = usize> + '_ {
        self.situation(graph)
            .flat_map(|(first, _, before)| set_bits_of(before).map(move |bit| first + bit))
    }

    /// The situations before the latest scan.
    fn before_scan(&self) -> &[u32] {
        let tables = self.tables;
        let program = tables.program();
        match program.evolution {
            Evolution::Scan => self.memory.store.before(),
            Evolution::Stable => self.memory.store.before_scan(),
        }
    }

    /// Word by word: index of the first step in it, the situation now and before the latest scan.
    fn situation(&self, graph: usize) -> impl Iterator<Item = (usize, u32, u32)> + '_ {
        let program = self.program();
        let graph = program.graphs.get(graph).copied();
        graph.into_iter().flat_map(move |graph| {
            let first = usize::from(graph.steps.start);
            graph
                .words()
                .indices()
                .enumerate()
                .map(move |(offset, word)| {
                    let before = remembered(&program.layout, word)
                        .and_then(|word| self.before_scan().get(word).copied())
                        .unwrap_or(0);
                    (first + offset * 32, self.memory.word(word), before)
                })
        })
    }
}
