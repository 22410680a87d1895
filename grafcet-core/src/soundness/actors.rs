//! What groups of words of steps do.

use crate::program::{Actors, Block, Masks, Program};
use crate::sets::{GROUP, rows};

impl Program<'_> {
    /// How many rows [`Program::actors`] has in a large program.
    #[must_use]
    pub const fn actor_rows(&self) -> usize {
        rows(self.blocks.len())
    }

    /// A row of [`Program::actors`] as the blocks and masks have it, which must be sound.
    #[must_use]
    pub const fn actors_of(&self, row: usize) -> Actors {
        let mut actors = Actors {
            momentary: 0,
            masks: Masks::NONE,
        };
        let mut place = row * 32 * GROUP;
        while place < self.blocks.len() && place < (row + 1) * 32 * GROUP {
            actors.join(&self.blocks[place], self.masks, 1 << (place / GROUP % 32));
            place += 1;
        }
        actors
    }

    /// Whether the table of what groups do is empty or right.
    pub(super) const fn actors_are_sound(&self) -> bool {
        if self.actors.is_empty() {
            return true;
        }
        if self.actors.len() != self.actor_rows() {
            return false;
        }
        let mut row = 0;
        while row < self.actors.len() {
            if !self.actors[row].are(&self.actors_of(row)) {
                return false;
            }
            row += 1;
        }
        true
    }
}

impl Actors {
    const fn join(&mut self, block: &Block, masks: &[Masks], group: u32) {
        let masks = &masks[block.masks as usize];
        join(&mut self.momentary, block.momentary, group);
        join(&mut self.masks.timed, masks.timed, group);
        join(&mut self.masks.stored, masks.stored, group);
        join(&mut self.masks.on_activation, masks.on_activation, group);
        join(
            &mut self.masks.on_deactivation,
            masks.on_deactivation,
            group,
        );
        join(&mut self.masks.on_event, masks.on_event, group);
        join(&mut self.masks.forcing, masks.forcing, group);
        join(&mut self.masks.varying, masks.varying, group);
    }

    /// `==`, which is not const.
    const fn are(&self, other: &Actors) -> bool {
        self.momentary == other.momentary
            && self.masks.timed == other.masks.timed
            && self.masks.stored == other.masks.stored
            && self.masks.on_activation == other.masks.on_activation
            && self.masks.on_deactivation == other.masks.on_deactivation
            && self.masks.on_event == other.masks.on_event
            && self.masks.forcing == other.masks.forcing
            && self.masks.varying == other.masks.varying
    }
}

const fn join(mask: &mut u32, steps: u32, group: u32) {
    if steps > 0 {
        *mask |= group;
    }
}
