//! The store task: a write for each change and for nothing else, and another try when one fails.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

mod support;

use std::cell::RefCell;

use embassy_futures::select::select3;
use embassy_time::{Duration, Timer};
use embedded_storage_async::nor_flash::{ErrorType, NorFlash, ReadNorFlash};
use plc::boards::host::clock::simulate;
use plc::boards::host::lines::keep;
use plc::retain::Store;
use plc::scan::Changes;
use plc::store::SILENCE_MS;
use plc::vitals::{Pulse, Task};
use support::nor::{Nor, Refusal};
use support::program::program;

const SECTOR: usize = 256;
const SECTORS: usize = 4;

/// A flash that others look at, and that refuses so many writes.
struct Shared<'a> {
    flash: &'a RefCell<Nor<SECTOR>>,
    refusals: u32,
}

impl ErrorType for Shared<'_> {
    type Error = Refusal;
}

impl ReadNorFlash for Shared<'_> {
    const READ_SIZE: usize = 1;

    async fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Refusal> {
        // Nothing else is polled while this future runs: those of the model never wait.
        embassy_futures::block_on(self.flash.borrow_mut().read(offset, bytes))
    }

    fn capacity(&self) -> usize {
        SECTOR * SECTORS
    }
}

impl NorFlash for Shared<'_> {
    const WRITE_SIZE: usize = 1;
    const ERASE_SIZE: usize = SECTOR;

    async fn erase(&mut self, from: u32, to: u32) -> Result<(), Refusal> {
        embassy_futures::block_on(self.flash.borrow_mut().erase(from, to))
    }

    async fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Refusal> {
        if self.refusals > 0 {
            self.refusals -= 1;
            return Err(Refusal::Off);
        }
        embassy_futures::block_on(self.flash.borrow_mut().write(offset, bytes))
    }
}

const COUNTER: &str = "
    retain var count : int
    graph G { initial step 1 { count = count + 1 }; step 2; transition 1: 1 -> 2 when T/X1/1s }
";

/// Hands values to the store, 100 ms apart, and waits for 5 s more. The answer is how often the flash was programmed
/// after each, and what was said.
fn programmed(handed: &[i32], refusals: u32) -> (Vec<usize>, Vec<String>) {
    let counter = program(COUNTER);
    let flash = RefCell::new(Nor::new(SECTORS));
    let (counts, lines) = keep(|| {
        simulate(async {
            let shared = Shared {
                flash: &flash,
                refusals,
            };
            let mut store = Store::new(shared, 0..(SECTOR * SECTORS) as u32);
            store.load().await.expect("the flash works");
            let changes = Changes::<1>::new();
            let pulse = Pulse::new(Task::Store, SILENCE_MS);
            let scans = async {
                // A task that shows itself four times a second is never silent for half of one.
                loop {
                    Timer::after(Duration::from_millis(10)).await;
                    assert_eq!(pulse.count(10 * SILENCE_MS / 500), None);
                }
            };
            let mut counts = Vec::new();
            let hand = async {
                for value in handed {
                    changes.signal([*value]);
                    Timer::after(Duration::from_millis(100)).await;
                    counts.push(flash.borrow().programmed);
                }
                Timer::after(Duration::from_secs(5)).await;
                counts.push(flash.borrow().programmed);
            };
            select3(
                hand,
                scans,
                plc::store::keep(&mut store, counter.program, &changes, [0], &pulse),
            )
            .await;
            counts
        })
        .expect("somebody always waits for time to pass")
    });
    (counts, lines.into_iter().map(|line| line.text).collect())
}

#[test]
fn nothing_is_written_until_something_changes() {
    assert_eq!(programmed(&[0, 0], 0), (vec![0, 0, 0], vec![]));
}

#[test]
fn each_change_is_written_once() {
    let (counts, lines) = programmed(&[1, 1, 2, 2, 1], 0);
    let writes: Vec<bool> = counts.windows(2).map(|pair| pair[0] != pair[1]).collect();
    assert!(counts[0] > 0);
    assert_eq!(writes, [false, true, false, true, false]);
    assert_eq!(lines, Vec::<String>::new());
}

#[test]
fn a_write_that_fails_is_reported_and_tried_again() {
    let (counts, lines) = programmed(&[7], 2);
    assert_eq!(counts[0], 0);
    assert!(counts[1] > 0);
    // The half that holds no record that counts is formatted, in case what stands there is why.
    assert_eq!(
        lines,
        [
            "retain store: unreadable half of the area formatted (1 since start)",
            "retain store: the flash reports a fault"
        ]
    );
}
