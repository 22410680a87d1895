//! Situations that are exchanged while triggers are still to be evaluated.

use crate::program::{Graph, Op, Program, Rest, Run, Transition};

impl Program<'_> {
    /// Whether a word of situations can be exchanged as soon as its steps have been looked at: no trigger that is
    /// evaluated later reads it, and no transition is without entrance. The tables must be sound.
    #[must_use]
    pub const fn can_cross_at_once(&self) -> bool {
        let mut g = 0;
        while g < self.graphs.len() {
            let graph = &self.graphs[g];
            let mut place = 0;
            while place < graph.steps.len {
                let arms = self.steps[graph.steps.start as usize + place as usize].arms();
                if !self.see_no_earlier(arms, graph, place) {
                    return false;
                }
                place += 1;
            }
            g += 1;
        }
        self.sources.is_empty()
    }

    /// Whether what a step of a graph arms reads no word before that of the step.
    const fn see_no_earlier(&self, arms: Run, graph: &Graph, place: u16) -> bool {
        let word = graph.first_word + place / 32;
        let mut i = arms.start as usize;
        while i < arms.end() {
            let transition = &self.transitions[self.arms[i].transition as usize];
            if self.is_earlier(self.terms[transition.term as usize].word, word)
                || !self.sees_no_earlier(transition, word)
            {
                return false;
            }
            i += 1;
        }
        true
    }

    /// Whether a transition reads no word of situations before one, which has been exchanged by then.
    const fn sees_no_earlier(&self, transition: &Transition, word: u16) -> bool {
        let fires = self.conditions[transition.fires as usize];
        let terms = fires.terms;
        let mut i = terms.start as usize;
        while i < terms.end() {
            if self.is_earlier(self.terms[i].word, word) {
                return false;
            }
            i += 1;
        }
        if let Rest::Code(row) | Rest::Logic(row) = fires.rest {
            let code = self.codes[row as usize];
            let mut i = code.start as usize;
            while i < code.start as usize + code.len as usize {
                if let Op::Bit(bit) = &self.ops[i]
                    && self.is_earlier(bit.0 >> 5, word)
                {
                    return false;
                }
                i += 1;
            }
        }
        true
    }

    /// Whether a word holds steps, and stands before another.
    const fn is_earlier(&self, word: u16, other: u16) -> bool {
        self.layout.situations.start <= word && word < other
    }
}
