//! How far a long run has come.

use std::io::{self, IsTerminal, Write};
use std::time::{Duration, Instant};

/// How often it is shown: on a terminal, where one line is written over, and elsewhere, where each takes a line.
const EVERY: (Duration, Duration) = (Duration::from_millis(200), Duration::from_secs(30));

/// Shows progress on standard error.
pub struct Progress<'a> {
    name: &'a str,
    long_ms: u64,
    unit: (&'a str, u64),
    begun: Instant,
    next: Instant,
    terminal: bool,
}

impl<'a> Progress<'a> {
    /// Of a run of so many ms, shown in this unit.
    pub fn new(name: &'a str, long_ms: u64, unit: (&'a str, u64)) -> Self {
        let terminal = io::stderr().is_terminal();
        let begun = Instant::now();
        Progress {
            name,
            long_ms,
            unit,
            begun,
            next: begun + every(terminal),
            terminal,
        }
    }

    /// It has come so far.
    pub fn show(&mut self, now_ms: u64, scans: u64) {
        let now = Instant::now();
        if now < self.next {
            return;
        }
        self.next = now + every(self.terminal);
        let (unit, unit_ms) = self.unit;
        let in_units = |ms: u64| ms as f64 / unit_ms as f64;
        let gone = now.duration_since(self.begun).as_secs_f64();
        let part = now_ms as f64 / self.long_ms as f64;
        let left = gone / part.max(1e-9) - gone;
        let (start, end) = if self.terminal {
            ("\r\x1b[K", "")
        } else {
            ("", "\n")
        };
        let text = format!(
            "{start}{}: {:.2} of {:.2} {unit}, {scans} scans, {left:.0} s to go{end}",
            self.name,
            in_units(now_ms),
            in_units(self.long_ms),
        );
        self.write(&text);
    }

    /// Nothing follows.
    pub fn end(&mut self) {
        if self.terminal {
            self.write("\r\x1b[K");
        }
    }

    /// Who does not want to see it closes it.
    fn write(&self, text: &str) {
        let mut out = io::stderr();
        let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    }
}

fn every(terminal: bool) -> Duration {
    if terminal { EVERY.0 } else { EVERY.1 }
}
