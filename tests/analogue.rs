//! Analogue inputs in simulated time: sampled in the scan, or averaged between scans.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

mod support;

use std::cell::{Cell, RefCell};

use embassy_futures::select::select;
use embassy_time::{Duration, Instant, Timer};
use grafcet_core::engine::Engine;
use grafcet_core::memory::Memory;
use grafcet_core::program::{Compiled, Number, Slot};
use plc::analogue::{Analogue, Converter};
use plc::boards::host::clock::{simulate, work};
use plc::boards::host::pins::{Input, Output};
use plc::input::Inputs;
use plc::link::{Link, Wires};
use plc::log::Observer;
use plc::output::Outputs;
use plc::scale::Scale;
use plc::scan::{Board, Controller};
use plc::wiring::{AnalogueWire, Overload, Policy};
use support::program::{Leaked, program};

const TANK: &str = "
    input level : int
    output LOW
    graph Tank { always { LOW IF level < 50 } }
";

/// What the converter reads: a function of the time in ms, none where it fails.
struct Voltage(fn(u64) -> Option<u16>);

impl Converter for Voltage {
    fn convert(&mut self, terminal: usize) -> Option<u16> {
        assert_eq!(terminal, 0);
        (self.0)(Instant::now().as_millis())
    }
}

/// Remembers the level that each scan saw.
struct Bench<'a> {
    level: Number,
    seen: &'a RefCell<Vec<(u64, i32)>>,
    faults: &'a Cell<i32>,
}

impl Board for Bench<'_> {
    const LATE_AFTER: Duration = Duration::from_millis(1);

    fn complete(&mut self, engine: &Engine<impl Compiled, impl Memory>) {
        let mut seen = self.seen.borrow_mut();
        seen.push((Instant::now().as_millis(), engine.number(self.level)));
        self.faults.set(engine.number(Number::ARITHMETIC_FAULTS));
    }
}

struct Seen {
    /// Time in ms and level of each scan.
    levels: Vec<(u64, i32)>,
    faults: i32,
}

const RAW: Scale = Scale { low: 0, high: 4095 };

fn level(tank: Leaked) -> Number {
    match tank.slot("level") {
        Slot::Number(number) => number,
        Slot::Bit(_) => panic!("level is a Boolean"),
    }
}

/// Runs to a time, with something that holds up everything else for 45 ms from `hog_ms` on.
fn run(
    scale: Scale,
    filter_ms: u16,
    voltage: fn(u64) -> Option<u16>,
    hog_ms: u64,
    until_ms: u64,
) -> Seen {
    let tank = program(TANK);
    let wires = Box::leak(Box::new([AnalogueWire {
        number: level(tank),
        address: "%IW0",
        scale,
        filter_ms,
    }]));
    let (seen, faults) = (RefCell::default(), Cell::new(0));
    let link = Link::<0>::new(Wires::default());
    simulate(async {
        let mut controller = Controller {
            engine: tank.engine(),
            inputs: Inputs::new(
                [] as [Input<'_>; 0],
                &[],
                Analogue::new(Voltage(voltage), wires),
            ),
            outputs: Outputs::new([] as [Output<'_>; 0], &[]),
            board: Bench {
                level: level(tank),
                seen: &seen,
                faults: &faults,
            },
            link: &link,
            watched: &[],
            overload: Overload {
                policy: Policy::KeepRunning,
                overruns: 10,
            },
            observer: Observer::new(tank.names),
        };
        let hog = async {
            Timer::at(Instant::from_millis(hog_ms)).await;
            work(Duration::from_millis(45));
            std::future::pending::<()>().await;
        };
        let over = Timer::at(Instant::from_millis(until_ms));
        select(select(hog, over), controller.run()).await;
    })
    .expect("a controller always waits for its next scan");
    Seen {
        levels: seen.into_inner(),
        faults: faults.get(),
    }
}

const NEVER: u64 = u64::MAX / 4_000;

#[test]
fn without_a_filter_a_scan_sees_the_voltage_of_its_moment() {
    let seen = run(RAW, 0, |ms| Some(ms as u16 * 3), NEVER, 35);
    assert_eq!(seen.levels, [(0, 0), (10, 30), (20, 60), (30, 90)]);
}

#[test]
fn scan_0_sees_the_voltage_with_a_filter_too() {
    let seen = run(RAW, 20, |_| Some(1234), NEVER, 45);
    assert!(seen.levels.iter().all(|(_, level)| *level == 1234));
    assert_eq!(seen.levels.len(), 5);
}

#[test]
fn a_filter_gives_the_mean_of_its_latest_whole_time() {
    // One millisecond in four at full voltage; the mean of four samples is a quarter of it.
    let seen = run(
        RAW,
        4,
        |ms| Some(if ms % 4 == 1 { 4000 } else { 0 }),
        NEVER,
        25,
    );
    assert_eq!(seen.levels, [(0, 0), (10, 1000), (20, 1000)]);
    // A step at 21 ms is seen when its 20 ms are over, and not before.
    let seen = run(
        RAW,
        20,
        |ms| Some(if ms > 20 { 4000 } else { 0 }),
        NEVER,
        55,
    );
    assert_eq!(
        seen.levels,
        [(0, 0), (10, 0), (20, 0), (30, 0), (40, 4000), (50, 4000)]
    );
}

#[test]
fn twenty_milliseconds_keep_the_hum_of_the_mains_out() {
    fn hum(ms: u64) -> Option<u16> {
        let angle = ms as f64 * 50.0 * std::f64::consts::TAU / 1000.0;
        Some((2000.0 + 300.0 * angle.sin()).round() as u16)
    }
    let clean = run(RAW, 20, hum, NEVER, 205);
    let unsteady = |levels: &[(u64, i32)]| levels.iter().skip(2).any(|(_, level)| *level != 2000);
    assert!(!unsteady(&clean.levels), "{:?}", clean.levels);
    assert!(unsteady(&run(RAW, 3, hum, NEVER, 205).levels));
}

#[test]
fn a_conversion_that_fails_is_left_out() {
    let seen = run(RAW, 0, |ms| (ms != 20).then_some(ms as u16), NEVER, 35);
    assert_eq!(seen.levels, [(0, 0), (10, 10), (20, 10), (30, 30)]);
    let seen = run(RAW, 5, |ms| (ms % 2 == 1).then_some(700), NEVER, 25);
    assert_eq!(seen.levels, [(0, 0), (10, 700), (20, 700)]);
}

#[test]
fn samples_that_an_erase_prevents_are_not_made_up_for() {
    // Five samples up to 5 ms, and another five from 51 ms on.
    let seen = run(RAW, 10, |ms| Some(if ms > 50 { 2000 } else { 1000 }), 5, 65);
    let levels: Vec<i32> = seen.levels.iter().map(|(_, level)| *level).collect();
    assert_eq!(
        seen.levels.iter().map(|(ms, _)| *ms).collect::<Vec<_>>(),
        [0, 50, 60]
    );
    assert_eq!(levels[..2], [1000, 1000]);
    assert!(levels[2] > 1000 && levels[2] < 2000, "{levels:?}");
}

#[test]
fn a_scale_within_the_range_of_its_variable_gives_no_fault() {
    let scale = Scale {
        low: -20,
        high: 250,
    };
    let seen = run(
        scale,
        0,
        |ms| Some(if ms < 15 { 0 } else { 4095 }),
        NEVER,
        25,
    );
    assert_eq!(seen.levels, [(0, -20), (10, -20), (20, 250)]);
    assert_eq!(seen.faults, 0);
}
