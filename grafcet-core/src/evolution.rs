//! Triggers and firing (`semantics.md`, phases 2 and 3; IEC 60848 rules 2 to 5).

use crate::bits::set_bits_of;
use crate::engine::Engine;
use crate::memory::Memory;
use crate::program::{Compiled, Crossing, Run, Transition};

impl<P: Compiled, M: Memory> Engine<P, M> {
    /// Marks every armed transition whose trigger is True, and tells whether there is one. The situations stay as
    /// they are meanwhile, so that all transitions see the same one; the next ones are made beside them.
    pub(crate) fn mark_fired(&mut self) -> bool {
        let tables = self.tables;
        let program = tables.program();
        let first = usize::from(program.layout.situations.start);
        let mut any = false;
        for (place, block) in program.blocks.iter().enumerate() {
            let now = self.memory.word(first + place);
            let mut marked = Marked::default();
            for bit in set_bits_of(now) {
                if let Some(step) = program.steps.get(usize::from(block.first) + bit) {
                    self.mark_run(step.arms, &mut marked);
                }
            }
            any |= marked.any;
            let next = now & !marked.leaves | marked.enters;
            if let Some(word) = self.memory.store.before_mut().get_mut(place) {
                *word = next;
            }
        }
        any | self.mark_sources()
    }

    /// A transition without entrance steps is always armed while its graph is alive.
    fn mark_sources(&mut self) -> bool {
        let tables = self.tables;
        let program = tables.program();
        let mut any = false;
        for graph in program.sources {
            let graph = program.graphs.get(usize::from(*graph));
            let Some(graph) = graph.filter(|graph| self.is_alive(graph)) else {
                continue;
            };
            let mut marked = Marked::default();
            self.mark_run(graph.sources, &mut marked);
            any |= marked.any;
            let place = graph
                .words
                .start
                .saturating_sub(program.layout.situations.start);
            let word = self.memory.store.before_mut().get_mut(usize::from(place));
            if let Some(word) = word {
                *word |= marked.enters;
            }
        }
        any
    }

    fn mark_run(&mut self, arms: Run, marked: &mut Marked) {
        let tables = self.tables;
        let program = tables.program();
        let Some(arms) = arms.some(program.arms) else {
            return;
        };
        for arm in arms {
            let word = self.memory.store.image().get(usize::from(arm.word));
            if word.is_none_or(|word| word & arm.mask != arm.state) {
                continue;
            }
            let row = usize::from(arm.transition);
            let Some(transition) = program.transitions.get(row) else {
                continue;
            };
            if self.holds(&transition.fires) {
                self.mark(row);
                marked.add(&transition.crossing);
            }
        }
    }

    fn mark(&mut self, transition: usize) {
        let word = self.memory.store.fired_mut().get_mut(transition / 32);
        if let Some(word) = word {
            *word |= 1 << (transition % 32);
        }
    }

    /// Fires all marked transitions together: first every entrance step is left, then every exit step is entered, so
    /// that activation has priority (IEC 60848 rule 5). The situations before are kept.
    pub(crate) fn fire(&mut self) {
        let tables = self.tables;
        let program = tables.program();
        // With graphs of few steps alone, the next situations are complete.
        if !program.links.is_empty() {
            self.cross(|entrance, _| entrance, |word, bit| word & !bit);
            self.cross(|_, exit| exit, |word, bit| word | bit);
        }
        let first = usize::from(program.layout.situations.start);
        for place in 0..program.blocks.len() {
            let now = self.memory.word(first + place);
            let next = self.memory.store.before_mut().get_mut(place);
            if let Some(next) = next {
                let next = core::mem::replace(next, now);
                self.memory.put_word(first + place, next);
            }
        }
    }

    /// Changes the next situation by the steps on one side of every marked transition of a graph with many steps.
    fn cross(&mut self, side: impl Fn(Run, Run) -> Run, change: impl Fn(u32, u32) -> u32) {
        let tables = self.tables;
        let program = tables.program();
        self.for_each_fired(|engine, transition| {
            let Crossing::Across { entrance, exit } = transition.crossing else {
                return;
            };
            for step in side(entrance, exit).of(program.links) {
                let place = step
                    .word()
                    .saturating_sub(usize::from(program.layout.situations.start));
                if let Some(word) = engine.memory.store.before_mut().get_mut(place) {
                    *word = change(*word, step.mask());
                }
            }
        });
    }

    /// Visits the transitions that fired in this round, in source order.
    pub(crate) fn for_each_fired(&mut self, mut visit: impl FnMut(&mut Self, &Transition)) {
        let tables = self.tables;
        let program = tables.program();
        for word in 0..self.memory.store.fired().len() {
            let marks = self.memory.store.fired().get(word).copied().unwrap_or(0);
            for bit in set_bits_of(marks) {
                if let Some(transition) = program.transitions.get(word * 32 + bit) {
                    visit(self, transition);
                }
            }
        }
    }

    /// Whether any transition of this round has fired.
    pub(crate) fn any_fired(&self) -> bool {
        self.memory.store.fired().iter().any(|word| *word != 0)
    }

    /// Takes back the firing of a graph whose own evolution is void.
    pub(crate) fn void_fired(&mut self, transitions: Run) {
        for index in transitions.indices() {
            if let Some(word) = self.memory.store.fired_mut().get_mut(index / 32) {
                *word &= !(1 << (index % 32));
            }
        }
    }
}

/// What the marked transitions of one graph do to its word.
#[derive(Default)]
struct Marked {
    any: bool,
    leaves: u32,
    enters: u32,
}

impl Marked {
    fn add(&mut self, crossing: &Crossing) {
        self.any = true;
        if let Crossing::Within { leaves, enters } = crossing {
            self.leaves |= leaves;
            self.enters |= enters;
        }
    }
}
