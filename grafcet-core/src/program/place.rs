//! Where values lie: bits, numbers, time stamps, and runs of rows.

/// A Boolean of the image: bit `self.0 & 31` of word `self.0 >> 5`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Bit(pub u16);

impl Bit {
    /// `System:first_scan`.
    pub const FIRST_SCAN: Bit = Bit(0);
    /// `System:unstable`.
    pub const UNSTABLE: Bit = Bit(1);
    /// `System:recovered`.
    pub const RECOVERED: Bit = Bit(2);
    /// What is never True: the last of the word of `System`.
    pub(crate) const NEVER: Bit = Bit(31);

    /// Index of the word of the image.
    #[must_use]
    pub const fn word(self) -> usize {
        (self.0 >> 5) as usize
    }

    /// The bit within its word.
    #[must_use]
    pub const fn mask(self) -> u32 {
        1 << (self.0 & 31)
    }
}

/// A number: an `int`, or a `time` in milliseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Number(pub u16);

impl Number {
    /// `System:overruns`.
    pub const OVERRUNS: Number = Number(0);
    /// `System:arithmetic_faults`.
    pub const ARITHMETIC_FAULTS: Number = Number(1);
}

/// Where a value lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Slot {
    /// A Boolean.
    Bit(Bit),
    /// An `int` or a `time`.
    Number(Number),
}

/// A time stamp: the latest rise of a step, a macro step or a timer's enable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Stamp(pub u16);

/// Since when a step is active, where its timers are asked for only while it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Since(pub u16);

/// Consecutive rows of a table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Run {
    /// Index of the first row.
    pub start: u16,
    /// How many rows.
    pub len: u16,
}

impl Run {
    /// No rows.
    pub const EMPTY: Run = Run { start: 0, len: 0 };

    /// The rows of the run; none when the run leaves the table, which a checked table never does.
    #[must_use]
    pub fn of<T>(self, table: &[T]) -> &[T] {
        self.some(table).unwrap_or(&[])
    }

    /// The rows of the run, if there are any.
    #[inline]
    pub(crate) fn some<T>(self, table: &[T]) -> Option<&[T]> {
        if self.len == 0 {
            None
        } else {
            table.get(self.indices())
        }
    }

    /// The indices of the rows.
    #[must_use]
    pub fn indices(self) -> core::ops::Range<usize> {
        self.start as usize..self.start as usize + self.len as usize
    }
}
