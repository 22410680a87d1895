//! From readings of a converter to values of the program and back, in whole numbers.

/// The highest reading of a converter: 12 bits.
pub const FULL_SCALE: u16 = 4095;

/// What the ends of a converter's range mean to the program. In between it is linear.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scale {
    /// The value at reading 0.
    pub low: i32,
    /// The value at [`FULL_SCALE`]; it may lie below `low`.
    pub high: i32,
}

impl Scale {
    /// The value of the mean of so many readings, whose sum is `sum`: rounded once, to the nearest whole number, and
    /// toward `high` when two are as near. A mean beyond [`FULL_SCALE`] counts as that; no readings count as one.
    #[must_use]
    pub fn value(&self, sum: u32, readings: u16) -> i32 {
        let full = u64::from(FULL_SCALE) * u64::from(readings.max(1));
        let sum = u64::from(sum).min(full);
        self.at(divided(sum * u64::from(self.length()), full))
    }

    /// The reading whose value is nearest to the given one; what lies beyond an end is that end.
    ///
    /// It gives the value back when the scale is no longer than [`FULL_SCALE`]: then there are at least as many
    /// readings as values.
    #[must_use]
    pub fn reading(&self, value: i32) -> u16 {
        let (least, most) = (self.low.min(self.high), self.low.max(self.high));
        let steps = u64::from(value.clamp(least, most).abs_diff(self.low));
        let length = u64::from(self.length());
        let reading = divided(steps * u64::from(FULL_SCALE), length);
        u16::try_from(reading).map_or(FULL_SCALE, |reading| reading.min(FULL_SCALE))
    }

    fn length(&self) -> u32 {
        self.high.abs_diff(self.low)
    }

    /// The value so far from `low` on the way to `high`.
    fn at(&self, steps: u64) -> i32 {
        let steps = u32::try_from(steps).unwrap_or(u32::MAX);
        if self.high < self.low {
            self.low.saturating_sub_unsigned(steps)
        } else {
            self.low.saturating_add_unsigned(steps)
        }
    }
}

/// Divided and rounded to the nearest, halves up; a scale without length has nothing to divide by.
fn divided(dividend: u64, divisor: u64) -> u64 {
    (dividend + divisor / 2).checked_div(divisor).unwrap_or(0)
}
