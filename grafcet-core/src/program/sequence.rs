//! Steps that stand in a sequence: what follows them.

use core::cell::Cell;

use super::{Arm, Bit, Term};

impl Arm {
    /// The step has no momentary action.
    pub const SHOWS_NOTHING: u8 = 0;
    /// The step has momentary actions with conditions or more than one, or its row does not fit.
    pub const SHOWS_MORE: u8 = u8::MAX;

    /// A transition of a step that stands in no sequence, or of a graph.
    #[must_use]
    pub const fn alone(transition: u16) -> Arm {
        Arm {
            transition,
            course: Course::FREE,
            shows: Arm::SHOWS_NOTHING,
            next: Armed::UNKNOWN,
        }
    }
}

/// How it goes on behind a step that stands in a sequence: it arms one transition, which leaves it alone and enters one
/// other step of the same word. While it is the only active step of its word, nothing else need be looked up.
///
/// The lowest five bits are by how much the lowest bit of a word has to be turned to the right to become the step that is
/// entered. Bit 5 is set, and bit 6 when that step shows something else.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Course(pub u8);

impl Course {
    /// In any way, since it stands in no sequence.
    pub const FREE: Course = Course(u8::MAX);
    const TAKEN: u8 = 0x20;
    const SHOWS: u8 = 0x40;

    /// In a sequence, to a bit of the word, and whether that shows something else.
    #[must_use]
    pub const fn to(bit: u8, shows: bool) -> Course {
        let shows = if shows { Self::SHOWS } else { 0 };
        Course(bit.wrapping_neg() & 0x1f | Self::TAKEN | shows)
    }

    /// Whether the step stands in no sequence.
    #[inline(always)]
    pub(crate) const fn is_free(self) -> bool {
        self.0 == Self::FREE.0
    }

    /// The step that is entered, in its word.
    #[inline(always)]
    pub(crate) const fn enters(self) -> u32 {
        1_u32.rotate_right(self.0 as u32)
    }
}

/// The courses that have been taken.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Taken(u8);

impl Taken {
    /// None.
    pub(crate) const NONE: Taken = Taken(0);

    /// Takes another one.
    #[inline(always)]
    pub(crate) const fn take(&mut self, course: Course) {
        self.0 |= course.0;
    }

    /// Takes others.
    #[inline(always)]
    pub(crate) const fn join(&mut self, others: Taken) {
        self.0 |= others.0;
    }

    /// Whether it is any.
    #[inline(always)]
    pub(crate) const fn any(self) -> bool {
        self.0 != 0
    }

    /// Whether something else is shown behind one of them.
    #[inline(always)]
    pub(crate) const fn shows(self) -> bool {
        self.0 & Course::SHOWS != 0
    }
}

/// What is armed in a word of situations in which one step is active, when that step stands in a sequence: a row of
/// [`Program::arms`](super::Program::arms), and a Boolean that has to be True (or False) before anything else of it need
/// be looked up.
///
/// The highest five bits are the word of the image in which the Boolean lies. Bit 21 says whether it has to be False, and
/// bit 20 whether there is more to be looked up when it is as it has to be. Then there is the row, and in the lowest five
/// bits by how much the word has to be turned to the right so that the Boolean comes to lie at bit 21.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Armed(pub u32);

impl Armed {
    /// The steps of the word have to be looked at.
    pub const UNKNOWN: Armed = Armed::waits(Self::NO_ROW, Bit::NEVER, true, true);
    /// No step of the word is active, and none was before this scan (round): it waits for what never is.
    pub const NOTHING: Armed = Armed::waits(Self::NO_ROW, Bit::NEVER, false, true);

    /// So many words of the image, at its beginning, hold Booleans that can be waited for. The image of a program with
    /// sequences has as many at least.
    pub const WORDS: usize = 32;
    /// Of so many rows of the arms, the first ones, it can be known that they are armed; but for the last, which stands for
    /// none.
    pub(crate) const ROWS: usize = 1 << 15;
    const WORD: u32 = 27;
    const INVERTED: u32 = 21;
    const ASKS_MORE: u32 = 1 << 20;
    const ROW: u32 = 5;
    const NO_ROW: u16 = Self::ROWS as u16 - 1;

    /// A row of the arms whose transition asks first for a term, and whether it asks for more. Of several Booleans of the
    /// term the lowest one is waited for.
    #[must_use]
    pub const fn by(row: u16, first: &Term, asks_more: bool) -> Armed {
        if row >= Self::NO_ROW {
            return Armed::UNKNOWN;
        }
        if first.mask == 0 || first.word as usize >= Self::WORDS {
            return Armed::waits(row, Bit::NEVER, true, true);
        }
        let bit = Bit(first.word << 5 | first.mask.trailing_zeros() as u16);
        let inverted = first.state & bit.mask() == 0;
        let asks_more = asks_more || !first.mask.is_power_of_two();
        Armed::waits(row, bit, inverted, asks_more)
    }

    /// Whether that Boolean is all that is to be looked up.
    #[must_use]
    pub const fn is_plain(self) -> bool {
        self.plain_row() < Self::ROWS
    }

    const fn waits(row: u16, bit: Bit, inverted: bool, asks_more: bool) -> Armed {
        let more = if asks_more { Self::ASKS_MORE } else { 0 };
        let turned = (bit.0 as u32).wrapping_sub(Self::INVERTED) & 31;
        Armed(
            (bit.word() as u32) << Self::WORD
                | more
                | (inverted as u32) << Self::INVERTED
                | (row as u32) << Self::ROW
                | turned,
        )
    }

    /// What is armed, if it is known. In a long table the row that stands for none is one of another step.
    #[inline(always)]
    pub(crate) fn arm(self, arms: &[Arm]) -> Option<&Arm> {
        let known = arms.get(..usize::from(Self::NO_ROW)).unwrap_or(arms);
        known.get(self.row())
    }

    /// The row of the arms.
    #[inline(always)]
    const fn row(self) -> usize {
        self.plain_row() % Self::ROWS
    }

    /// The same when the Boolean is all that the transition asks for, and otherwise behind [`Armed::ROWS`].
    #[inline(always)]
    pub(crate) const fn plain_row(self) -> usize {
        (self.0 >> Self::ROW) as u16 as usize
    }

    /// Whether the Boolean is as it has to be, in an image.
    #[inline(always)]
    pub(crate) fn may_fire(self, image: &[Cell<u32>; Self::WORDS]) -> bool {
        // There always is such a word, as the compiler knows.
        let word = image.get((self.0 >> Self::WORD) as usize);
        word.is_some_and(|word| {
            (word.get().rotate_right(self.0) ^ self.0) & 1 << Self::INVERTED != 0
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The image in which one word is what it is and all others are the contrary.
    fn image(word: usize, value: u32) -> [Cell<u32>; Armed::WORDS] {
        let mut image = [!value; Armed::WORDS];
        image[word] = value;
        image.map(Cell::new)
    }

    #[test]
    fn a_boolean_is_found_in_its_word_wherever_it_lies() {
        for place in 0..Armed::WORDS as u16 * 32 {
            let bit = Bit(place);
            for inverted in [false, true] {
                let term = Term {
                    word: bit.0 / 32,
                    mask: bit.mask(),
                    state: if inverted { 0 } else { bit.mask() },
                };
                let armed = Armed::by(1234, &term, false);
                assert_eq!((armed.row(), armed.plain_row()), (1234, 1234));
                assert_eq!(armed.may_fire(&image(bit.word(), bit.mask())), !inverted);
                assert_eq!(armed.may_fire(&image(bit.word(), !bit.mask())), inverted);
            }
        }
    }

    #[test]
    fn what_does_not_wait_for_one_near_boolean_is_always_looked_up() {
        let by = |word, mask| {
            Armed::by(
                32_766,
                &Term {
                    word,
                    mask,
                    state: 0,
                },
                false,
            )
        };
        for armed in [by(32, 1), by(1, 0), Armed::UNKNOWN] {
            assert!(armed.plain_row() >= Armed::ROWS && armed.may_fire(&image(0, 0)));
        }
        assert_eq!([by(32, 1), by(1, 0)].map(Armed::row), [32_766; 2]);
    }

    #[test]
    fn of_several_booleans_one_is_waited_for() {
        let term = Term {
            word: 1,
            mask: 0b1100,
            state: 0b1000,
        };
        let armed = Armed::by(7, &term, false);
        assert!(!armed.is_plain() && armed.row() == 7);
        assert!(armed.may_fire(&image(1, 0b0000)) && armed.may_fire(&image(1, 0b1000)));
        assert!(!armed.may_fire(&image(1, 0b1100)));
    }

    #[test]
    fn of_rows_that_do_not_fit_it_is_not_known_that_they_are_armed() {
        let term = Term {
            word: 0,
            mask: 1,
            state: 1,
        };
        assert_eq!(Armed::by(32_766, &term, false).row(), 32_766);
        assert_eq!(Armed::by(32_767, &term, false), Armed::UNKNOWN);
        assert_eq!(Armed::by(u16::MAX, &term, false), Armed::UNKNOWN);
    }

    #[test]
    fn what_is_not_known_is_no_row_of_a_table_however_long() {
        let arms = [Arm::alone(7); Armed::ROWS + 1];
        for armed in [Armed::UNKNOWN, Armed::NOTHING] {
            assert_eq!(armed.arm(&arms), None);
        }
        let term = Term {
            word: 0,
            mask: 1,
            state: 1,
        };
        let last = Armed::by(32_766, &term, false);
        assert_eq!(last.arm(&arms), Some(&Arm::alone(7)));
        assert_eq!(last.arm(&arms[..32_766]), None);
    }

    #[test]
    fn where_nothing_is_active_nothing_is_waited_for() {
        assert!(!Armed::NOTHING.may_fire(&image(0, !Bit::NEVER.mask())));
        assert_eq!(Armed::NOTHING.row(), Armed::UNKNOWN.row());
    }
}
