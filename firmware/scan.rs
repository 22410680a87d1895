//! The scan task: sample, scan, write, at every release.

use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::signal::Signal;
use embassy_time::{Duration, Instant};
use embedded_hal::digital::{InputPin, OutputPin};
use grafcet_core::engine::Engine;
use grafcet_core::memory::Memory;
use grafcet_core::program::Compiled;

use crate::analogue::Converter;
use crate::input::Inputs;
use crate::log::{Observer, fault};
use crate::output::Outputs;
use crate::schedule::{Schedule, Served};

/// The newest values of everything retained, on their way to the store. A newer snapshot takes the place of one that
/// has not been fetched, so that the scan never waits for the flash.
pub type Changes<const R: usize> = Signal<CriticalSectionRawMutex, [i32; R]>;

/// What is special to a board in a scan.
pub trait Board {
    /// How far behind its release a scan may start without being counted as late.
    const LATE_AFTER: Duration;

    /// A scan has been completed, its outputs written and its changes handed on. Nothing else feeds a watchdog.
    fn complete(&mut self, engine: &Engine<impl Compiled, impl Memory>);
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
    pub changes: &'a Changes<R>,
    /// The log.
    pub observer: Observer,
}

impl<E, S, I, C, O, B, const N: usize, const A: usize, const M: usize, const R: usize>
    Controller<'_, E, S, I, C, O, B, N, A, M, R>
where
    E: Compiled,
    S: Memory,
    I: InputPin,
    C: Converter,
    O: OutputPin,
    B: Board,
{
    /// Runs the program for as long as there is power.
    pub async fn run(mut self) -> ! {
        let mut retained = snapshot(&self.engine);
        let period_ms = self.engine.program().period_ms;
        let mut schedule = Schedule::new(Instant::now(), period_ms, B::LATE_AFTER);
        self.inputs.read(&mut self.engine);
        self.engine.start();
        self.finish(&mut retained);
        log_missed(schedule.complete(Instant::now()), &schedule);
        loop {
            self.inputs.watch_until(schedule.release()).await;
            let served = schedule.serve(Instant::now());
            log_served(&served, &schedule);
            self.engine.set_overruns(schedule.faults().overruns);
            self.inputs.read(&mut self.engine);
            if self.engine.scan(served.time_ms) {
                self.finish(&mut retained);
            } else {
                self.board.complete(&self.engine);
            }
            log_missed(schedule.complete(Instant::now()), &schedule);
        }
    }

    /// All that follows the program's part of a scan.
    fn finish(&mut self, retained: &mut [i32; R]) {
        self.outputs.write(&self.engine);
        let values = snapshot(&self.engine);
        if values != *retained {
            *retained = values;
            self.changes.signal(values);
        }
        self.observer.observe(&self.engine);
        self.board.complete(&self.engine);
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
