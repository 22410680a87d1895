//! How many scans a second one core of this computer does.

use std::hint::black_box;
use std::time::{Duration, Instant};

use super::program::{PROGRAM, Storage, ThisProgram};
use super::{Controller, outputs};

/// Scans between two looks at the clock.
const BATCH: u64 = 100_000;
/// How long each figure is measured.
const MEASURED: Duration = Duration::from_millis(500);

/// Prints, for each kind of scan, a name and how many a second there are.
pub fn measure() {
    println!("idle {}", scans_a_second(|_| 0, Controller::scan));
    let look = |engine: &mut Controller, time_ms| {
        engine.full_scan(time_ms);
        true
    };
    println!("steady {}", scans_a_second(|_| 0, look));
    // Every input changes now and then, as a counter's bits do, so that transitions fire as well.
    println!(
        "busy {}",
        scans_a_second(|scan| (scan / 3) as u32, Controller::scan)
    );
}

/// With inputs made of the number of the scan.
fn scans_a_second(inputs: impl Fn(u64) -> u32, scan: impl Fn(&mut Controller, u64) -> bool) -> u64 {
    let mut engine = Controller::new(ThisProgram, Storage::new());
    engine.start();
    let period_ms = u64::from(PROGRAM.period_ms);
    let mut scans = 0;
    let begun = Instant::now();
    loop {
        for _ in 0..BATCH {
            scans += 1;
            engine.set_inputs(0, black_box(inputs(scans)));
            if scan(&mut engine, scans * period_ms) {
                black_box(outputs(&engine));
            }
        }
        let elapsed = begun.elapsed();
        if elapsed >= MEASURED {
            let a_second = u128::from(scans) * 1_000_000_000 / elapsed.as_nanos();
            return u64::try_from(a_second).unwrap_or(u64::MAX);
        }
    }
}
