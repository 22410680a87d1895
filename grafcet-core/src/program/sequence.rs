//! Steps that stand in a sequence: what follows them.

/// How it goes on behind a step that stands in a sequence: it arms one transition, which leaves it alone and enters one
/// other step of the same word. While it is the only active step of its word, nothing else need be looked up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Sequel {
    /// Row of [`Program::arms`](super::Program::arms): what the other step arms, or [`Sequel::NO_NEXT`].
    pub next: u16,
    /// What the step shows: [`Sequel::SHOWS_NOTHING`], [`Sequel::SHOWS_MORE`], or the row of
    /// [`Program::targets`](super::Program::targets), counted from 1, that it shows whatever holds.
    pub shows: u8,
    /// Which step the other one is, and when it is entered.
    pub course: Course,
}

impl Sequel {
    /// None: the step stands in no sequence.
    pub const NONE: Sequel = Sequel {
        next: Sequel::NO_NEXT,
        shows: Sequel::SHOWS_NOTHING,
        course: Course::FREE,
    };
    /// The other step stands in no sequence.
    pub const NO_NEXT: u16 = u16::MAX;
    /// The step has no momentary action.
    pub const SHOWS_NOTHING: u8 = 0;
    /// The step has momentary actions with conditions or more than one, or its row does not fit.
    pub const SHOWS_MORE: u8 = u8::MAX;
}

/// How a step goes on: in the lowest five bits which bit of the word it enters, above them what it waits for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Course(pub u8);

impl Course {
    /// In any way, since it stands in no sequence.
    pub const FREE: Course = Course(0x80);
    const ASKS_MORE: u8 = 0x20;

    /// In a sequence, to a bit of the word: as soon as the first term of its transition holds, and
    /// [`Transition::fires`](super::Transition::fires) if that asks for more.
    #[must_use]
    pub const fn to(bit: u8, asks_more: bool) -> Course {
        let more = if asks_more { Self::ASKS_MORE } else { 0 };
        Course(bit & 0x1f | more)
    }

    /// Whether the step stands in no sequence.
    #[inline(always)]
    pub(crate) const fn is_free(self) -> bool {
        self.0 == Self::FREE.0
    }

    /// Whether the first term is not all that the transition asks for.
    #[inline(always)]
    pub(crate) const fn asks_more(self) -> bool {
        self.0 & Self::ASKS_MORE != 0
    }

    /// The step that is entered, in its word.
    #[inline(always)]
    pub(crate) const fn enters(self) -> u32 {
        // Turned round by what lies above, it is where it was.
        1_u32.rotate_left(self.0 as u32)
    }
}

/// What is armed in a word of situations in which one step is active, when it stands in a sequence: a row of
/// [`Program::arms`](super::Program::arms) in the upper half and its term in the lower.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Armed(pub u32);

impl Armed {
    /// The steps of the word have to be looked at. There is no such row.
    pub const UNKNOWN: Armed = Armed(u32::MAX);
    /// No step of the word is active, and none was before this scan (round). There is no such row either.
    pub const NOTHING: Armed = Armed(u32::MAX - 1);

    /// A row of the arms, with its term.
    #[must_use]
    pub const fn by(row: u16, term: u16) -> Armed {
        Armed((row as u32) << 16 | term as u32)
    }

    /// The row of the arms.
    #[inline(always)]
    pub(crate) const fn row(self) -> usize {
        (self.0 >> 16) as usize
    }

    /// The row of the terms.
    #[inline(always)]
    pub(crate) const fn term(self) -> usize {
        (self.0 & 0xffff) as usize
    }
}
