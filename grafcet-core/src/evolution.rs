//! Triggers and firing (`semantics.md`, phases 2 and 3; IEC 60848 rules 2 to 5).

use crate::bits::set_bits_of;
use crate::engine::Engine;
use crate::program::{Graph, Run, Transition};

impl Engine<'_, '_> {
    /// Marks every armed transition whose trigger is True. The situations stay as they are meanwhile, so that all
    /// transitions see the same one.
    pub(crate) fn mark_fired(&mut self) {
        self.memory.fired.fill(0);
        for graph in self.program.graphs {
            for (offset, word) in graph.words.indices().enumerate() {
                for bit in set_bits_of(self.memory.word(word)) {
                    if let Some(step) = self.step(graph, offset * 32 + bit) {
                        self.mark_run(step.transitions);
                    }
                }
            }
            // A transition without entrance steps is always armed while its graph is alive.
            if graph.sources.len > 0 && self.is_alive(graph) {
                self.mark_run(graph.sources);
            }
        }
    }

    fn mark_run(&mut self, armed_by: Run) {
        for &index in armed_by.of(self.program.armed_by) {
            let Some(transition) = self.program.transitions.get(usize::from(index)) else {
                continue;
            };
            if self.is_armed(transition) && self.holds(transition.trigger) {
                let index = usize::from(index);
                if let Some(word) = self.memory.fired.get_mut(index / 32) {
                    *word |= 1 << (index % 32);
                }
            }
        }
    }

    fn is_armed(&self, transition: &Transition) -> bool {
        let entrance = transition.entrance.of(self.program.links);
        entrance.iter().all(|step| self.memory.bit(*step))
    }

    /// Fires all marked transitions together: first every entrance step is left, then every exit step is entered, so
    /// that activation has priority (IEC 60848 rule 5).
    pub(crate) fn fire(&mut self) {
        self.for_each_fired(|engine, transition| engine.set_links(transition.entrance, false));
        self.for_each_fired(|engine, transition| engine.set_links(transition.exit, true));
    }

    /// Visits the transitions that fired in this round, in source order.
    pub(crate) fn for_each_fired(&mut self, mut visit: impl FnMut(&mut Self, &Transition)) {
        for word in 0..self.memory.fired.len() {
            let marks = self.memory.fired.get(word).copied().unwrap_or(0);
            for bit in set_bits_of(marks) {
                if let Some(transition) = self.program.transitions.get(word * 32 + bit) {
                    visit(self, transition);
                }
            }
        }
    }

    /// Whether any transition of this round has fired.
    pub(crate) fn any_fired(&self) -> bool {
        self.memory.fired.iter().any(|word| *word != 0)
    }

    /// Takes back the firing of a graph whose own evolution is void.
    pub(crate) fn void_fired(&mut self, graph: &Graph) {
        for index in graph.transitions.indices() {
            if let Some(word) = self.memory.fired.get_mut(index / 32) {
                *word &= !(1 << (index % 32));
            }
        }
    }

    fn set_links(&mut self, links: Run, value: bool) {
        for bit in links.of(self.program.links) {
            self.memory.set_bit(*bit, value);
        }
    }
}
