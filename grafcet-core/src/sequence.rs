//! Steps that stand in a sequence (IEC 60848: each has one way on). A large program keeps in mind what is armed in a word
//! in which such a step is the only active one, so that a scan looks at that transition and at nothing else.

use crate::engine::Engine;
use crate::evolution::Marking;
use crate::memory::Memory;
use crate::program::{Arm, Armed, Block, Compiled, Step};
use crate::sets::Set;
use crate::walk::VisitSteps;

impl<P: Compiled, M: Memory> Engine<P, M> {
    /// Finds out what is armed where one step is active, so that the next scan need not.
    pub(crate) fn find_armed(&mut self) {
        if !P::UNROLLED && !self.memory.store.armed().is_empty() {
            let tables = self.tables;
            tables.each_step(&mut Finding {
                engine: self,
                armed: Armed::UNKNOWN,
            });
        }
    }

    /// What a row of the arms arms, if there is such a row.
    #[inline(always)]
    pub(crate) fn armed_by(&self, row: u16) -> Armed {
        let tables = self.tables;
        let arm = tables.program().arms.get(usize::from(row));
        arm.map_or(Armed::UNKNOWN, |arm| Armed::by(row, arm.term))
    }

    /// Whether a condition holds. Kept apart, since it is long where few ask for it.
    #[inline(never)]
    fn holds_apart(&mut self, row: u16) -> bool {
        self.holds_row(row)
    }
}

impl<P: Compiled, M: Memory> Marking<'_, P, M> {
    /// Looks at neighbouring words from one on, as long as it is known what is armed in them, and gives the first of which
    /// it is not.
    #[inline(always)]
    pub(crate) fn follow_sequences(&mut self, from: usize, end: usize) -> usize {
        let mut place = from;
        while place < end {
            let armed = self.engine.memory.armed(place);
            let tables = self.engine.tables;
            let Some(term) = tables.program().terms.get(armed.term()) else {
                break;
            };
            if term.holds(self.engine.memory.store.image()) {
                let Some(arm) = tables.program().arms.get(armed.row()) else {
                    break;
                };
                self.go_on(place, arm);
            } else {
                self.stay(place);
            }
            place += 1;
        }
        place
    }

    /// Goes on in a sequence, if the rest of its condition holds too.
    #[inline(always)]
    fn go_on(&mut self, place: usize, arm: &Arm) {
        let tables = self.engine.tables;
        let program = tables.program();
        let row = usize::from(arm.transition);
        if arm.sequel.course.asks_more() {
            let transition = program.transitions.get(row);
            if transition.is_none_or(|it| !self.engine.holds_apart(it.fires)) {
                self.stay(place);
                return;
            }
        }
        self.mark(row, false);
        let now = self.engine.situation_word(place);
        self.put_next(place, now, arm.sequel.course.enters());
        let next = self.engine.armed_by(arm.sequel.next);
        self.engine.memory.put_armed(place, next);
    }

    /// Nothing fires in a word.
    #[inline(always)]
    fn stay(&mut self, place: usize) {
        let now = self.engine.situation_word(place);
        if let Some(word) = self.engine.memory.store.before_mut().get_mut(place) {
            *word = now;
        }
    }
}

/// Finds out what is armed.
struct Finding<'e, P, M> {
    engine: &'e mut Engine<P, M>,
    armed: Armed,
}

impl<P: Compiled, M: Memory> VisitSteps for Finding<'_, P, M> {
    fn groups(&self, row: usize) -> u32 {
        self.engine.memory.members(Set::Lively, row)
    }

    fn choose(&mut self, place: usize, _: &Block) -> u32 {
        self.armed = Armed::UNKNOWN;
        let now = self.engine.situation_word(place);
        if now.is_power_of_two() { now } else { 0 }
    }

    fn step(&mut self, step: &Step) {
        let tables = self.engine.tables;
        let arms = step.arms().of(tables.program().arms);
        if arms.iter().any(|arm| !arm.sequel.course.is_free()) {
            self.armed = self.engine.armed_by(step.first_arm);
        }
    }

    fn leave(&mut self, place: usize) {
        self.engine.memory.put_armed(place, self.armed);
    }
}
