//! What a program asks of the scan before.

use crate::program::{Evolution, Program};

impl Program<'_> {
    /// The program for an image in which nobody looks between two scans at which transitions have fired and which steps
    /// were active before: neither is kept, unless the program itself asks for it.
    #[must_use]
    pub const fn unwatched(mut self) -> Self {
        let (fired, was_active) = (self.asks_what_fired(), self.asks_what_was_active());
        self.marks_all = fired;
        if !fired && self.links.is_empty() {
            self.layout.fired = 0;
        }
        if !was_active {
            self.layout.before = 0;
        }
        if self.layout.sets > 0 {
            self.layout.sets = self.layout.set_words() as u16;
        }
        self
    }

    /// Whether the program itself asks which transitions have fired: for their `do` blocks, or to evolve until it
    /// is stable.
    #[must_use]
    pub const fn asks_what_fired(&self) -> bool {
        if !matches!(self.evolution, Evolution::Scan) {
            return true;
        }
        let mut i = 0;
        while i < self.crossings.len() {
            if self.crossings[i].actions() > 0 {
                return true;
            }
            i += 1;
        }
        false
    }

    /// Whether the program itself asks which steps were active before a scan (round): for statements on a change, for
    /// times of activation, to evolve until it is stable, or because a graph forces or encloses another; or the next
    /// situation is made beside that of now.
    #[must_use]
    pub const fn asks_what_was_active(&self) -> bool {
        if !matches!(self.evolution, Evolution::Scan)
            || self.layout.standings > 0
            || self.layout.macros.len > 0
            || !self.crosses_at_once
        {
            return true;
        }
        let mut i = 0;
        while i < self.duties.len() {
            let row = &self.duties[i];
            if row.activated.is_some()
                || row.since.is_some()
                || row.on_activation.len > 0
                || row.on_deactivation.len > 0
                || row.on_event.len > 0
            {
                return true;
            }
            i += 1;
        }
        false
    }
}
