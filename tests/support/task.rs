//! The scan task on pins and in simulated time, on a board whose scans take as long as a test wants.

use std::cell::{Cell, RefCell};
use std::convert::Infallible;

use embassy_futures::select::{Either3, select3};
use embassy_time::{Duration, Instant, Timer};
use embedded_hal::digital::{ErrorType, OutputPin};
use grafcet_core::engine::Engine;
use grafcet_core::memory::Memory;
use grafcet_core::program::{Bit, Compiled, Number, Slot};
use plc::analogue::Analogue;
use plc::boards::host::clock::{simulate, work};
use plc::boards::host::lines::{Line, keep};
use plc::boards::host::pins::{Input, Readings};
use plc::input::Inputs;
use plc::link::{Link, Wires};
use plc::log::Observer;
use plc::output::Outputs;
use plc::scan::{Board, Controller, Stop};
use plc::vitals::{Pulse, Task};
use plc::wiring::{InputWire, OutputWire, Overload, Policy};

use super::program::{Leaked, program};

/// Runs while the button is held, and counts.
const PRESS: &str = "
    input start
    output RUN, READY
    retain var count : int
    graph Press {
        initial step 1 { READY }
        step 2 { RUN; on activation: count = count + 1 }
        transition 1: 1 -> 2 when start
        transition 2: 2 -> 1 when NOT start
    }
";

/// An output pin that remembers when it was set to what.
struct Recorder<'a>(&'a RefCell<Vec<(u64, bool)>>);

impl ErrorType for Recorder<'_> {
    type Error = Infallible;
}

impl OutputPin for Recorder<'_> {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.record(false)
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.record(true)
    }
}

impl Recorder<'_> {
    fn record(&mut self, level: bool) -> Result<(), Infallible> {
        self.0.borrow_mut().push((now_ms(), level));
        Ok(())
    }
}

fn now_ms() -> u64 {
    Instant::now().as_millis()
}

/// A board on which scans take time.
struct Bench<'a> {
    /// How long scan k works, in ms.
    cost_ms: fn(usize) -> u64,
    scans: &'a RefCell<Vec<Scan>>,
    stopped: &'a Cell<Option<(u64, Stop)>>,
}

/// A completed scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scan {
    pub at_ms: u64,
    pub overruns: i32,
}

impl Board for Bench<'_> {
    const LATE_AFTER: Duration = Duration::from_millis(1);

    fn stop(&mut self, stop: Stop) {
        self.stopped.set(Some((now_ms(), stop)));
    }

    fn complete(&mut self, engine: &Engine<impl Compiled, impl Memory>) {
        let mut scans = self.scans.borrow_mut();
        scans.push(Scan {
            at_ms: now_ms(),
            overruns: engine.number(Number::OVERRUNS),
        });
        work(Duration::from_millis((self.cost_ms)(scans.len() - 1)));
    }
}

/// What there is to set in a test.
pub struct Case {
    pub filter_ms: u16,
    pub active_low: bool,
    pub cost_ms: fn(usize) -> u64,
    /// Times and levels of the pin of `start`.
    pub levels: &'static [(u64, bool)],
    /// Something that holds up everything else: from when, for how long, in ms.
    pub hog: (u64, u64),
    pub overload: Overload,
    /// When the store shows for the last time that it lives, in ms.
    pub last_beat_ms: u64,
    pub until_ms: u64,
}

pub const CASE: Case = Case {
    filter_ms: 0,
    active_low: false,
    cost_ms: |_| 0,
    levels: &[],
    hog: (u64::MAX / 4_000, 0),
    overload: Overload {
        policy: Policy::SafeStop,
        overruns: 10,
    },
    last_beat_ms: u64::MAX,
    until_ms: 100,
};

pub const KEEP_RUNNING: Overload = Overload {
    policy: Policy::KeepRunning,
    overruns: 10,
};

/// What was seen.
pub struct Seen {
    pub scans: Vec<Scan>,
    pub run: Vec<(u64, bool)>,
    pub ready: Vec<(u64, bool)>,
    pub lines: Vec<Line>,
    pub changes: Option<[i32; 1]>,
    /// When the program was stopped and why, and when it was to be started again.
    pub stop: Option<(u64, Stop)>,
    pub ended_ms: Option<u64>,
}

impl Seen {
    pub fn texts(&self) -> Vec<&str> {
        self.lines.iter().map(|line| line.text.as_str()).collect()
    }

    /// The times at which an output changed.
    pub fn changes(pin: &[(u64, bool)]) -> Vec<(u64, bool)> {
        let mut last = None;
        let changed = |step: &&(u64, bool)| last.replace(step.1) != Some(step.1);
        pin.iter().filter(changed).copied().collect()
    }
}

fn wire(compiled: Leaked, name: &str) -> Bit {
    match compiled.slot(name) {
        Slot::Bit(bit) => bit,
        Slot::Number(_) => panic!("{name} is a number"),
    }
}

pub fn run(case: &Case) -> Seen {
    let press = program(PRESS);
    let inputs = Box::leak(Box::new([InputWire {
        bit: wire(press, "start"),
        address: "%IX0.0",
        active_low: case.active_low,
        filter_ms: case.filter_ms,
    }]));
    let output = |name, active_low, safe| OutputWire {
        bit: wire(press, name),
        address: name,
        active_low,
        safe,
    };
    let outputs = Box::leak(Box::new([
        output("RUN", false, true),
        output("READY", true, false),
    ]));
    let level = Cell::new(case.active_low);
    let (scans, run, ready) = (RefCell::default(), RefCell::default(), RefCell::default());
    let link = Link::new(Wires::default());
    let (stopped, watched) = (Cell::new(None), [Pulse::new(Task::Store, 300)]);
    let (ended_ms, lines) = keep(|| {
        simulate(async {
            let mut controller = Controller {
                engine: press.engine(),
                inputs: Inputs::new([Input(&level)], inputs, Analogue::new(Readings(&[]), &[])),
                outputs: Outputs::new([Recorder(&run), Recorder(&ready)], outputs),
                board: Bench {
                    cost_ms: case.cost_ms,
                    scans: &scans,
                    stopped: &stopped,
                },
                link: &link,
                watched: &watched,
                overload: case.overload,
                observer: Observer::new(press.names),
            };
            let levels = async {
                for (at, high) in case.levels {
                    Timer::at(Instant::from_millis(*at)).await;
                    level.set(*high);
                }
                std::future::pending::<()>().await;
            };
            let hog = async {
                Timer::at(Instant::from_millis(case.hog.0)).await;
                work(Duration::from_millis(case.hog.1));
                std::future::pending::<()>().await;
            };
            let beats = async {
                while now_ms() <= case.last_beat_ms {
                    watched.iter().for_each(Pulse::beat);
                    Timer::after(Duration::from_millis(100)).await;
                }
                std::future::pending::<()>().await;
            };
            let over = Timer::at(Instant::from_millis(case.until_ms));
            let run = async {
                controller.run().await;
                now_ms()
            };
            let around = select3(levels, hog, beats);
            match select3(around, over, run).await {
                Either3::Third(ended_ms) => Some(ended_ms),
                _ => None,
            }
        })
        .expect("a controller always waits for its next scan")
    });
    Seen {
        scans: scans.into_inner(),
        run: run.into_inner(),
        ready: ready.into_inner(),
        lines,
        changes: link.try_changed(),
        stop: stopped.get(),
        ended_ms,
    }
}
