//! Triggers and firing (`semantics.md`, phases 2 and 3; IEC 60848 rules 2 to 5).

use crate::engine::Engine;
use crate::memory::Store;
use crate::program::{Compiled, Run, Transition};

impl<P: Compiled, S: Store> Engine<P, S> {
    /// Marks every armed transition whose trigger is True, and tells whether there is one. The situations stay as
    /// they are meanwhile, so that all transitions see the same one.
    pub(crate) fn mark_fired(&mut self) -> bool {
        let tables = self.tables;
        let program = tables.program();
        let first = usize::from(program.layout.situations.start);
        let mut any = false;
        for (place, base) in program.bases.iter().enumerate() {
            let mut steps = self.memory.word(first + place);
            while steps != 0 {
                let step = usize::from(*base) + steps.trailing_zeros() as usize;
                steps &= steps - 1;
                if let Some(step) = program.steps.get(step) {
                    any |= self.mark_run(step.arms);
                }
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
            if let Some(graph) = graph.filter(|graph| self.is_alive(graph)) {
                any |= self.mark_run(graph.sources);
            }
        }
        any
    }

    fn mark_run(&mut self, arms: Run) -> bool {
        let tables = self.tables;
        let program = tables.program();
        let mut any = false;
        if let Some(arms) = arms.some(program.arms) {
            for arm in arms {
                if arm.first.holds(self.memory.store.image()) {
                    any |= self.mark(usize::from(arm.transition));
                }
            }
        }
        any
    }

    /// Marks a transition whose first term holds if all else holds.
    fn mark(&mut self, index: usize) -> bool {
        let tables = self.tables;
        let program = tables.program();
        let Some(transition) = program.transitions.get(index) else {
            return false;
        };
        let fires = self.holds(&transition.fires);
        if fires && let Some(word) = self.memory.store.fired_mut().get_mut(index / 32) {
            *word |= 1 << (index % 32);
        }
        fires
    }

    /// Fires all marked transitions together: first every entrance step is left, then every exit step is entered, so
    /// that activation has priority (IEC 60848 rule 5).
    pub(crate) fn fire(&mut self) {
        let tables = self.tables;
        let program = tables.program();
        self.for_each_fired(|engine, transition| {
            if let Some(steps) = transition.entrance.some(program.links) {
                for step in steps {
                    engine.memory.clear_bit(*step);
                }
            }
        });
        self.for_each_fired(|engine, transition| {
            if let Some(steps) = transition.exit.some(program.links) {
                for step in steps {
                    engine.memory.raise_bit(*step);
                }
            }
        });
    }

    /// Visits the transitions that fired in this round, in source order.
    pub(crate) fn for_each_fired(&mut self, mut visit: impl FnMut(&mut Self, &Transition)) {
        let tables = self.tables;
        let program = tables.program();
        for word in 0..self.memory.store.fired().len() {
            let mut marks = self.memory.store.fired().get(word).copied().unwrap_or(0);
            while marks != 0 {
                let row = word * 32 + marks.trailing_zeros() as usize;
                marks &= marks - 1;
                if let Some(transition) = program.transitions.get(row) {
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
