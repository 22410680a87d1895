//! The scan task: sample, scan, write, at every release.

use embassy_time::{Duration, Instant, Timer};
use embedded_hal::digital::OutputPin;
use grafcet_core::engine::Engine;
use grafcet_core::memory::Memory;
use grafcet_core::program::Compiled;

use crate::analogue::Converter;
use crate::boot::Cause;
use crate::input::{Inputs, Latched};
use crate::link::Link;
use crate::log::{Observer, fault};
use crate::output::Outputs;
use crate::schedule::{LATEST, Schedule, Served};
use crate::vitals::{Pulse, Task};
use crate::wiring::{Overload, Policy};

/// What is special to a board in a scan.
pub trait Board {
    /// How far behind its release a scan may start without being counted as late.
    const LATE_AFTER: Duration;

    /// A scan begins.
    fn begin(&mut self) {}

    /// A scan has been completed, its outputs written and its changes handed on, and every task lives. Nothing else
    /// feeds a watchdog.
    fn complete(&mut self, engine: &Engine<impl Compiled, impl Memory>);

    /// The program has been stopped and will be started again, after [`STANDSTILL`] at most.
    fn stop(&mut self, _: Stop) {}
}

/// How long outputs stay safe after an overload, before the controller starts again: time for the store to write what
/// has changed last, and for a person to see that something is wrong.
pub const STANDSTILL: Duration = Duration::from_secs(1);

/// Why a program is stopped. Its outputs are at their safe levels then.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// Scans took too long too often, and the policy is to stop.
    Overload,
    /// A task below the scan has shown no sign of life for too long.
    Hung(Task),
}

impl Stop {
    /// Why the controller starts again behind it.
    #[must_use]
    pub const fn cause(self) -> Cause {
        match self {
            Stop::Overload => Cause::Overload,
            Stop::Hung(task) => Cause::Watchdog(task),
        }
    }
}

/// A controller with all that its scan needs.
pub struct Controller<
    'a,
    E,
    S,
    I,
    C,
    O,
    B,
    const N: usize,
    const A: usize,
    const M: usize,
    const R: usize,
> {
    /// The program, restored and not started.
    pub engine: Engine<E, S>,
    /// The input pins.
    pub inputs: Inputs<I, C, N, A>,
    /// The output pins, at their safe levels.
    pub outputs: Outputs<O, M>,
    /// The board.
    pub board: B,
    /// Where changed retained values go.
    pub link: &'a Link<R>,
    /// The tasks below the scan, each with its sign of life.
    pub watched: &'a [Pulse],
    /// When scans take too long too often, and what is done about it.
    pub overload: Overload,
    /// The log.
    pub observer: Observer,
}

impl<E, S, I, C, O, B, const N: usize, const A: usize, const M: usize, const R: usize>
    Controller<'_, E, S, I, C, O, B, N, A, M, R>
where
    E: Compiled,
    S: Memory,
    I: Latched,
    C: Converter,
    O: OutputPin,
    B: Board,
{
    /// Runs the program for as long as there is power, or until it has to be stopped. What is behind that is up to the
    /// board; it must be a new start.
    pub async fn run(&mut self) -> Stop {
        let mut retained = snapshot(&self.engine);
        let period_ms = self.engine.program().period_ms;
        let mut schedule = Schedule::new(Instant::now(), period_ms, B::LATE_AFTER);
        let mut overloaded = false;
        self.board.begin();
        self.inputs.read(&mut self.engine);
        self.link.sample(&mut self.engine);
        self.engine.start();
        self.finish(&mut retained);
        self.board.complete(&self.engine);
        log_missed(schedule.complete(Instant::now()), &schedule);
        self.link.lease(&self.engine, schedule.release());
        loop {
            self.inputs.watch_until(schedule.release()).await;
            self.board.begin();
            let served = schedule.serve(Instant::now());
            if self.link.has_erased() {
                schedule.excuse();
            }
            log_served(&served, &schedule);
            self.engine.set_overruns(schedule.faults().overruns);
            self.inputs.read(&mut self.engine);
            self.link.sample(&mut self.engine);
            if self.engine.scan(served.time_ms) {
                self.finish(&mut retained);
            }
            if let Some(task) = self.hung(period_ms) {
                self.outputs.make_safe();
                self.board.stop(Stop::Hung(task));
                fault!("{} hung: safe stop", task.name());
                return Stop::Hung(task);
            }
            self.board.complete(&self.engine);
            let missed = schedule.complete(Instant::now());
            let ends = self.is_overload_to_end(&schedule, &mut overloaded);
            log_missed(missed, &schedule);
            if ends {
                Timer::at(Instant::now().saturating_add(STANDSTILL)).await;
                return Stop::Overload;
            }
            self.link.lease(&self.engine, schedule.release());
        }
    }

    /// All that follows the program's part of a scan; a function of its own in every image, so that a search for panics
    /// finds the calls through pointers where it expects them.
    #[inline(never)]
    fn finish(&mut self, retained: &mut [i32; R]) {
        self.outputs.write(&self.engine);
        let values = snapshot(&self.engine);
        if values != *retained {
            *retained = values;
            self.link.hand(values);
        }
        self.observer.observe(&self.engine);
    }

    /// Whether an overload begins with this scan that ends the program; the outputs are safe then. One is said once: it
    /// lasts until [`LATEST`] scans were in time.
    fn is_overload_to_end(&mut self, schedule: &Schedule, overloaded: &mut bool) -> bool {
        // Counting takes its time, which nearly every scan can save.
        if !schedule.overran() && !*overloaded {
            return false;
        }
        let overruns = schedule.recent_overruns();
        let begins = !*overloaded && overruns >= self.overload.overruns;
        *overloaded = overruns > 0 && (*overloaded || begins);
        if !begins {
            return false;
        }
        let (stops, outcome) = match self.overload.policy {
            Policy::SafeStop => (true, "safe stop"),
            Policy::KeepRunning => (false, "kept running"),
        };
        if stops {
            self.outputs.make_safe();
            self.board.stop(Stop::Overload);
        }
        fault!(
            "overload: {} of the latest {} scans overran: {}",
            overruns,
            LATEST,
            outcome
        );
        stops
    }

    /// Another scan has run; a task that has not shown for too long that it lives.
    fn hung(&self, period_ms: u32) -> Option<Task> {
        let pulses = self.watched.iter();
        pulses.fold(None, |hung, pulse| pulse.count(period_ms).or(hung))
    }
}

/// The retained values, in the order of the program's rows.
#[must_use]
pub fn snapshot<const R: usize>(engine: &Engine<impl Compiled, impl Memory>) -> [i32; R] {
    let mut values = engine
        .program()
        .retained
        .iter()
        .map(|row| engine.value(row.slot));
    core::array::from_fn(|_| values.next().unwrap_or(0))
}

fn log_served(served: &Served, schedule: &Schedule) {
    if let Some(late_by) = served.late_by {
        fault!(
            "late scan: {} us behind its release ({} since start)",
            micros(late_by),
            schedule.faults().late
        );
    }
    log_missed(served.missed, schedule);
}

fn log_missed(missed: u64, schedule: &Schedule) {
    if missed > 0 {
        let count = schedule.faults().overruns;
        fault!(
            "overrun: releases missed: {} ({} overruns since start)",
            missed,
            count
        );
    }
}

fn micros(duration: Duration) -> u64 {
    duration.as_micros()
}
