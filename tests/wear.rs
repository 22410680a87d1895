//! What a change costs the flash, and how long it lasts: `cargo test -p plc --test wear -- --nocapture` prints the table of
//! the manual.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

mod support;

use plc::budget::CYCLES;
use plc::retain::Error;
use support::nor::{Nor, Operation};
use support::records::{save, start};

/// As on the Pico, and as many as it has when nobody asks for more.
const SECTOR: usize = 4096;
const SECTORS: usize = 16;

/// How often each sector is erased while it is counted.
const TURNS: usize = 5;

const MINUTES_A_YEAR: f64 = 60.0 * 24.0 * 365.25;

/// What so many retained values cost, of which every change is another number of any size.
fn row(count: usize) -> String {
    let mut random = fastrand::Rng::with_seed(count as u64);
    let mut flash = Nor::<SECTOR>::new(SECTORS);
    let mut changes = 0;
    // The first turns of the area begin with a flash that is erased.
    while flash.erased < (TURNS + 1) * SECTORS {
        let mut store = start(flash).1;
        loop {
            let values: Vec<i32> = (0..count).map(|_| random.i32(..)).collect();
            match save(&mut store, &values) {
                Ok(()) => changes += 1,
                Err(Error::NoStock) => break,
                Err(error) => panic!("{error:?}"),
            }
        }
        flash = store.into_flash();
        if flash.erased < SECTORS {
            (changes, flash.programmed) = (0, 0);
            flash.done.clear();
        }
    }
    let erased = flash
        .done
        .iter()
        .filter(|it| matches!(it, Operation::Erase(_)));
    let erases = erased.count() as f64 / f64::from(changes);
    let bytes = flash.done.iter().map(|it| match it {
        Operation::Program(bytes) => *bytes,
        Operation::Erase(_) => 0,
    });
    let bytes = bytes.sum::<usize>() as f64 / f64::from(changes);
    let programs = flash.programmed as f64 / f64::from(changes);
    let (most, least) = (flash.wear.iter().max(), flash.wear.iter().min());
    assert!(most <= least.map(|it| it + 1).as_ref(), "{:?}", flash.wear);
    let years = (SECTORS as u64 * CYCLES) as f64 / erases / MINUTES_A_YEAR;
    format!("| {count} | {bytes:.0} | {programs:.1} | {erases:.4} | {years:.0} |")
}

#[test]
fn the_manual_says_what_a_change_costs_and_how_long_the_flash_lasts() {
    let manual = std::fs::read_to_string("docs/src/operation.md").expect("the manual is there");
    let rows: Vec<String> = [1, 4, 20, 100, 390].into_iter().map(row).collect();
    println!("{}", rows.join("\n"));
    for row in rows {
        assert!(manual.contains(&row), "the manual has no row {row}");
    }
}
