//! What a program's images hold between two scans, for whoever looks at them.

use crate::bits::set_bits;
use crate::program::{Run, Slot};

/// The images of a program between two scans.
#[derive(Clone, Copy, Debug)]
pub struct Images<'a> {
    /// The Booleans.
    pub image: &'a [u32],
    /// The numbers.
    pub numbers: &'a [i32],
}

impl<'a> Images<'a> {
    /// The value at a slot, False as 0 and True as 1; 0 where the images hold nothing.
    #[must_use]
    pub fn value(&self, slot: Slot) -> i32 {
        match slot {
            Slot::Bit(bit) => {
                let word = self.image.get(bit.word()).copied().unwrap_or(0);
                i32::from(word & bit.mask() != 0)
            }
            Slot::Number(number) => self
                .numbers
                .get(usize::from(number.0))
                .copied()
                .unwrap_or(0),
        }
    }

    /// The places of the active steps among the steps of a graph whose situation lies in these words, ascending.
    pub fn active(&self, words: Run) -> impl Iterator<Item = usize> + use<'a> {
        set_bits(words.of(self.image))
    }
}
