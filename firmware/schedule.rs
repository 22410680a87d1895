//! When scans run: at fixed releases, counted when they are late or missed.
//!
//! Release k is at k periods after scan 0, whatever earlier scans cost. A release that nobody could serve is skipped,
//! never made up for: an overrun is followed by the next release to come, with the time stamp of that release
//! (`semantics.md`, phase 1).

use embassy_time::{Duration, Instant};

/// The releases of the scan.
#[derive(Clone, Debug)]
pub struct Schedule {
    period_ms: u32,
    period: Duration,
    late_after: Duration,
    release: Instant,
    time_ms: u64,
    faults: Faults,
    /// One bit for each of the latest scans, the newest lowest: it overran, or began too late for its release.
    recent: u128,
}

/// Of so many scans, the latest ones, overruns are added up to tell an overload.
pub const LATEST: u32 = 100;

/// What went wrong with the times of the scans since scan 0. Counts stay at their end when they reach it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Faults {
    /// Scans that started further than the tolerance behind the release that they served.
    pub late: u32,
    /// Times that releases went unserved, because a scan ended behind the next release or could not start before it:
    /// `System:overruns`.
    pub overruns: u32,
}

/// A scan that starts now.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Served {
    /// Its time stamp: the time of its release in ms since scan 0.
    pub time_ms: u64,
    /// How far behind the release it starts, when that is late.
    pub late_by: Option<Duration>,
    /// Releases that passed unserved before this one, since the previous scan ended.
    pub missed: u64,
}

impl Schedule {
    /// The releases behind a scan 0 that is released at `start`; a period of 0 counts as 1 ms. A scan that starts
    /// further than `late_after` behind its release is late.
    #[must_use]
    pub fn new(start: Instant, period_ms: u32, late_after: Duration) -> Self {
        let period_ms = period_ms.max(1);
        let period = Duration::from_millis(u64::from(period_ms));
        Schedule {
            period_ms,
            period,
            late_after,
            release: start.saturating_add(period),
            time_ms: u64::from(period_ms),
            faults: Faults::default(),
            recent: 0,
        }
    }

    /// When the next scan is due.
    #[must_use]
    pub fn release(&self) -> Instant {
        self.release
    }

    /// What has been counted.
    #[must_use]
    pub fn faults(&self) -> Faults {
        self.faults
    }

    /// Whether the latest scan overran, or began so late that releases had passed.
    #[must_use]
    pub fn overran(&self) -> bool {
        self.recent & 1 != 0
    }

    /// How many of the [`LATEST`] scans did so.
    #[must_use]
    pub fn recent_overruns(&self) -> u32 {
        self.recent.count_ones()
    }

    /// The program asked for what hid the releases before this scan: they are counted, and are no part of an overload.
    pub fn excuse(&mut self) {
        self.recent &= !1;
    }

    /// A scan starts at `now`, not before [`Schedule::release`]: it serves the latest release that is due.
    pub fn serve(&mut self, now: Instant) -> Served {
        self.recent = self.recent << 1 & (u128::MAX >> (u128::BITS - LATEST));
        let missed = self.periods(now.saturating_duration_since(self.release));
        self.skip(missed);
        let behind = now.saturating_duration_since(self.release);
        let late_by = (behind > self.late_after).then_some(behind);
        if late_by.is_some() {
            self.faults.late = self.faults.late.saturating_add(1);
        }
        let time_ms = self.time_ms;
        self.advance(1);
        Served {
            time_ms,
            late_by,
            missed,
        }
    }

    /// The scan has ended at `now`. The answer is how many releases passed meanwhile; they are skipped.
    pub fn complete(&mut self, now: Instant) -> u64 {
        if now <= self.release {
            return 0;
        }
        let missed = self.periods(now.saturating_duration_since(self.release)) + 1;
        self.skip(missed);
        missed
    }

    /// How many whole periods there are in a time. In nearly every scan that is none, without a division.
    fn periods(&self, time: Duration) -> u64 {
        if time < self.period {
            0
        } else {
            let periods = time.as_ticks().checked_div(self.period.as_ticks());
            periods.unwrap_or(0)
        }
    }

    fn skip(&mut self, releases: u64) {
        if releases > 0 {
            self.faults.overruns = self.faults.overruns.saturating_add(1);
            self.recent |= 1;
            self.advance(releases);
        }
    }

    fn advance(&mut self, releases: u64) {
        let ticks = self.period.as_ticks().saturating_mul(releases);
        self.release = self.release.saturating_add(Duration::from_ticks(ticks));
        let ms = u64::from(self.period_ms).saturating_mul(releases);
        self.time_ms = self.time_ms.saturating_add(ms);
    }
}
