//! The input filter: what is shorter than its time never happened, what is longer reaches the scan.

/// The time between two samples, in µs.
pub const SAMPLE_US: u32 = 1000;

/// Follows one pin through samples taken about once a millisecond.
///
/// A level is accepted once samples have shown it for the filter's time, and the pin has not changed in between. With
/// samples at most 1 ms apart, a level shorter than the filter time is never accepted, whatever comes before and behind
/// it, and one that is longer by 2 ms always is. What is accepted is kept until the scan has read it, so that a pulse
/// longer than the filter time but shorter than the scan period is not lost; of several within one period the scan sees
/// one.
///
/// A pin that cannot tell whether it has changed between two samples is taken not to have, unless samples fail to come
/// for 1 ms more than the filter time. Then what they last showed is forgotten: two short pulses are not taken for one
/// long level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Filter {
    time_us: u32,
    /// The accepted level.
    level: bool,
    /// What the scan has read.
    read: bool,
    /// A level other than `read` has been accepted since the scan read it.
    pulse: bool,
    /// When the samples began to differ from the accepted level.
    differs_since: Option<u32>,
    sampled_at: u32,
}

impl Filter {
    /// A filter of so many ms on a pin that shows `level` at `now_us`. What was before that is unknown.
    #[must_use]
    pub const fn new(time_ms: u16, level: bool, now_us: u32) -> Self {
        Filter {
            time_us: time_ms as u32 * 1000,
            level,
            read: level,
            pulse: false,
            differs_since: None,
            sampled_at: now_us,
        }
    }

    /// Takes a sample, of a pin that has `changed` since the one before or not, or cannot tell. Times are in µs on a clock that may wrap
    /// around.
    pub fn sample(&mut self, level: bool, changed: Option<bool>, now_us: u32) {
        let gap = now_us.wrapping_sub(self.sampled_at);
        self.sampled_at = now_us;
        if level == self.level {
            self.differs_since = None;
            return;
        }
        let changed = changed.unwrap_or(gap > self.time_us + SAMPLE_US);
        let since = match self.differs_since {
            Some(since) if !changed => since,
            _ => now_us,
        };
        if now_us.wrapping_sub(since) >= self.time_us {
            self.level = level;
            self.differs_since = None;
            self.pulse |= level != self.read;
        } else {
            self.differs_since = Some(since);
        }
    }

    /// What the scan reads.
    pub fn read(&mut self) -> bool {
        if self.pulse {
            self.read = !self.read;
        } else {
            self.read = self.level;
        }
        self.pulse = self.level != self.read;
        self.read
    }
}
