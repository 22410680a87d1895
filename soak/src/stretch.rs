//! Runs of days with every scan in both interpreters, and of years whose pauses are leapt over.

use std::collections::BTreeMap;
use std::fmt;

use grafcet::machine::Bench;
use grafcet_reference::Program;

use crate::lockstep::{Failure, Lockstep, Reference};
use crate::subject::{Refused, Subject};
use crate::watch::Watch;

const SECOND_MS: u64 = 1_000;
const HOUR_MS: u64 = 3_600_000;
/// A day in ms.
pub const DAY_MS: u64 = 24 * HOUR_MS;
/// A year in ms.
pub const YEAR_MS: u64 = 365 * DAY_MS;

/// How long operators are at work between two pauses of a run of years, in ms.
const SHIFT_MS: (u64, u64) = (60 * SECOND_MS, 180 * SECOND_MS);
/// A machine in which nothing has changed for so long rests until somebody comes: no timer of the programs or the
/// plants is set to more than 15 s.
const REST_MS: u64 = 20 * SECOND_MS;
/// A machine that is left alone rests after so long.
const RESTLESS_MS: u64 = 600 * SECOND_MS;
/// How often timers are looked at that have not ended.
const LOOK_MS: u64 = SECOND_MS;
/// A run in which so many transitions have fired has reached everything, and each timer has run out.
const FIRED_ENOUGH: u64 = 5_000;

/// What is run.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    /// The program.
    pub subject: Subject,
    /// What happens.
    pub seed: u64,
    /// For how long, in ms of simulated time.
    pub long_ms: u64,
    /// What is spared.
    pub pace: Pace,
}

/// What a run does with the time in which nothing happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// No pauses; the reference runs every scan.
    EveryScan,
    /// Operators work for some minutes and are away for some time. The engine scans through it, or leaps to its end as
    /// soon as the machine rests; the reference is spared idle scans.
    Shifts {
        /// The shortest and the longest time that operators are away, in ms.
        pause_ms: (u64, u64),
        /// Whether the engine leaps.
        leapt: bool,
    },
}

impl Pace {
    /// That of a run of years: pauses from an hour to twenty days, leapt over.
    pub const YEARS: Pace = Pace::Shifts {
        pause_ms: (HOUR_MS, 20 * DAY_MS),
        leapt: true,
    };
}

/// What came of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// Scans of the engine.
    pub scans: u64,
    /// Those that were idle.
    pub idle: u64,
    /// Scans that were leapt over.
    pub leapt: u64,
    /// How often transitions fired.
    pub fired: u64,
    /// How often each step that a timer ends has been left, and its longest stay in ms.
    pub timed: Vec<(&'static str, u64, u64)>,
    /// What has never happened, as [`Watch::missing`] says.
    pub missing: Vec<String>,
    /// The last row.
    pub row: String,
}

/// Why a run did not come to its end.
#[derive(Debug)]
pub enum Broken {
    /// A program does not compile.
    Refused(Refused),
    /// It failed; what a person needs to see.
    Failed(String),
}

impl fmt::Display for Broken {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Broken::Refused(refused) => write!(f, "{refused}"),
            Broken::Failed(report) => f.write_str(report),
        }
    }
}

impl std::error::Error for Broken {}

impl Stretch {
    /// Runs it. `progress` is told now and then how far it has come, in ms of simulated time and in scans.
    ///
    /// # Errors
    /// When the interpreters differ, a timer is stuck, or something has never happened in a run that is long enough.
    pub fn run(&self, progress: &mut dyn FnMut(u64, u64)) -> Result<Outcome, Broken> {
        let application = self.subject.application().map_err(Broken::Refused)?;
        let (bench, tree) = (Bench::new(), self.subject.tree());
        let program = Program::new(&tree, &[]);
        let mode = match self.pace {
            Pace::EveryScan => Reference::EveryScan,
            Pace::Shifts { .. } => Reference::IdleSpared,
        };
        let mut run = Run {
            lockstep: Lockstep::new(
                self.subject,
                &bench,
                &application,
                &program,
                mode,
                self.seed,
                BTreeMap::new(),
            ),
            end_ms: self.long_ms,
            leapt: 0,
            progress,
        };
        let ended = run.go_on(self.pace, self.seed);
        ended.map_err(|failure| Broken::Failed(run.lockstep.report(&failure)))?;
        Ok(run.outcome())
    }
}

struct Run<'a, 'p> {
    lockstep: Lockstep<'a>,
    end_ms: u64,
    leapt: u64,
    progress: &'p mut dyn FnMut(u64, u64),
}

impl Run<'_, '_> {
    fn go_on(&mut self, pace: Pace, seed: u64) -> Result<(), Failure> {
        match pace {
            Pace::EveryScan => self.scan_until(self.end_ms)?,
            Pace::Shifts { pause_ms, leapt } => self.work_in_shifts(pause_ms, leapt, seed)?,
        }
        let watch = &self.lockstep.watch;
        let missing = watch.missing();
        if missing.is_empty() || total(watch) < FIRED_ENOUGH {
            Ok(())
        } else {
            Err(Failure::Missing(missing))
        }
    }

    fn work_in_shifts(
        &mut self,
        (shortest, longest): (u64, u64),
        leapt: bool,
        seed: u64,
    ) -> Result<(), Failure> {
        // Of its own, so that operators do the same whether pauses are leapt over or not.
        let mut shifts = fastrand::Rng::with_seed(!seed);
        while self.lockstep.next_ms() < self.end_ms {
            let begin_ms = self.lockstep.next_ms();
            let leave_ms = begin_ms + self.whole(shifts.u64(SHIFT_MS.0..=SHIFT_MS.1));
            let back_ms = leave_ms + self.whole(shifts.u64(shortest..=longest));
            self.scan_until(leave_ms)?;
            self.lockstep.leave();
            self.come_to_rest(leave_ms)?;
            if leapt {
                let left_ms = back_ms.saturating_sub(self.lockstep.next_ms());
                let scans = left_ms / self.lockstep.period_ms();
                self.lockstep.leap(scans);
                self.leapt += scans;
            }
            self.scan_until(back_ms)?;
            self.lockstep.set_out();
        }
        Ok(())
    }

    fn whole(&self, ms: u64) -> u64 {
        ms - ms % self.lockstep.period_ms()
    }

    fn scan_until(&mut self, end_ms: u64) -> Result<(), Failure> {
        while self.lockstep.next_ms() < end_ms {
            self.scan()?;
        }
        Ok(())
    }

    fn come_to_rest(&mut self, since_ms: u64) -> Result<(), Failure> {
        let mut moved_ms = since_ms;
        while self.lockstep.next_ms() < moved_ms + REST_MS {
            if self.lockstep.next_ms() > since_ms + RESTLESS_MS {
                return Err(Failure::Restless);
            }
            if self.scan()? {
                moved_ms = self.lockstep.next_ms();
            }
        }
        Ok(())
    }

    fn scan(&mut self) -> Result<bool, Failure> {
        let now_ms = self.lockstep.next_ms();
        let (full, _) = self.lockstep.scan()?;
        if now_ms.is_multiple_of(LOOK_MS) {
            self.lockstep.look_at_timers()?;
            (self.progress)(now_ms, self.lockstep.scans);
        }
        Ok(full)
    }

    fn outcome(&self) -> Outcome {
        let watch = &self.lockstep.watch;
        let left: BTreeMap<&str, u64> = watch.left().collect();
        let timed = watch.longest().map(|(step, stay, _)| {
            let count = left.get(step).copied().unwrap_or(0);
            (step, count, stay)
        });
        Outcome {
            scans: self.lockstep.scans,
            idle: self.lockstep.idle,
            leapt: self.leapt,
            fired: total(watch),
            timed: timed.collect(),
            missing: watch.missing(),
            row: self.lockstep.row(),
        }
    }
}

fn total(watch: &Watch<'_>) -> u64 {
    watch.fired().map(|(_, count)| count).sum()
}
