//! How fast the store may write: so that no program wears the flash out before its time.
//!
//! What is written is paid for out of a credit that grows with time. The credit is enough for half the retain area at
//! first, so that a change is written at once, and many are when they come together; a program that goes on faster than
//! the credit grows is slowed down, to what lets every sector be erased [`CYCLES`] times in [`LIFE_YEARS`]. It is kept
//! with each record, so that a restart is no new credit. Time without power counts for nothing.

use embassy_time::{Duration, Instant};

/// Erase cycles that each sector bears (W25Q16JV data sheet, section 1: more than 100 000).
pub const CYCLES: u64 = 100_000;

/// How long the flash lasts at least, in years of power.
pub const LIFE_YEARS: u64 = 20;

/// What is paid for, in bytes: records begin at multiples of it.
pub const GRAIN: usize = 16;

const LIFE: Duration = Duration::from_secs(LIFE_YEARS * 31_557_600);

/// The credit of a store.
#[derive(Clone, Debug)]
pub struct Budget {
    /// In grains. What has been paid may have been more than there was.
    credit: i32,
    most: i32,
    /// In which time a grain is earned.
    per_grain: Duration,
    /// When the latest grain was earned.
    earned: Instant,
}

impl Budget {
    /// The budget of an area of so many bytes, with a credit that has been kept, or with the most there is.
    #[must_use]
    pub fn new(area: usize, kept: Option<u16>, now: Instant) -> Self {
        let grains = (area / GRAIN).max(1);
        let most = i32::try_from(grains / 2).unwrap_or(i32::MAX);
        let bearable = CYCLES.saturating_mul(grains as u64);
        let ticks = LIFE.as_ticks().div_ceil(bearable.max(1));
        Budget {
            credit: kept.map_or(most, i32::from).min(most),
            most,
            per_grain: Duration::from_ticks(ticks.max(1)),
            earned: now,
        }
    }

    /// When the next record may be written: now, when there is any credit.
    #[must_use]
    pub fn ready(&mut self, now: Instant) -> Instant {
        self.earn(now);
        if self.credit > 0 {
            return now;
        }
        let missing = 1_u32.saturating_add(self.credit.unsigned_abs());
        let wait = self.per_grain.checked_mul(missing);
        self.earned.saturating_add(wait.unwrap_or(Duration::MAX))
    }

    /// Pays for so many grains of flash, even with more than there is.
    pub fn pay(&mut self, grains: u32) {
        let grains = i32::try_from(grains).unwrap_or(i32::MAX);
        self.credit = self.credit.saturating_sub(grains);
    }

    /// What is left, in grains, to be kept with a record.
    #[must_use]
    pub fn credit(&self) -> u16 {
        u16::try_from(self.credit.max(0)).unwrap_or(u16::MAX)
    }

    /// Whether half of the most has been saved up.
    #[must_use]
    pub fn is_comfortable(&self) -> bool {
        self.credit >= self.most / 2
    }

    /// In which time a grain is earned.
    #[must_use]
    pub fn per_grain(&self) -> Duration {
        self.per_grain
    }

    fn earn(&mut self, now: Instant) {
        let ticks = self.per_grain.as_ticks();
        let since = now.saturating_duration_since(self.earned).as_ticks();
        let grains = since.checked_div(ticks).unwrap_or(0);
        self.earned = self
            .earned
            .saturating_add(Duration::from_ticks(ticks.saturating_mul(grains)));
        let grains = i32::try_from(grains).unwrap_or(i32::MAX);
        self.credit = self.credit.saturating_add(grains).min(self.most);
    }
}
