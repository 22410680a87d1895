//! The store task: a write for each change and for nothing else, another try when one fails, erasing in quiet moments,
//! and no more than the flash bears.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

mod support;

use std::cell::{Cell, RefCell};

use embassy_futures::select::{select, select3};
use embassy_time::{Duration, Instant, Timer};
use embedded_storage_async::nor_flash::{ErrorType, NorFlash, ReadNorFlash};
use grafcet_core::program::{Bit, Slot};
use plc::boards::host::clock::simulate;
use plc::boards::host::lines::keep;
use plc::budget::{CYCLES, LIFE_YEARS};
use plc::link::{Link, Wires};
use plc::retain::Store;
use plc::store::{SILENCE_MS, prepare};
use plc::vitals::{Pulse, Task};
use support::nor::{Nor, Refusal};
use support::program::program;

const SECTOR: usize = 256;
const SECTORS: usize = 8;
/// Records of one value in a page: a grain of header, and one more.
const RECORDS: i32 = 8;
const AREA: std::ops::Range<u32> = 0..(SECTOR * SECTORS) as u32;

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
    input low
    output CALM
    graph G {
        initial step 1 { count = count + 1; CALM }
        step 2
        transition 1: 1 -> 2 when T/X1/1s AND NOT low
    }
";

/// The scans are slow, so that days pass quickly.
const SCAN: Duration = Duration::from_secs(1);
/// Changes that are so far apart are written at once whatever the credit, in ms.
const APART: u64 = 200_000;

/// A store task beside what stands for the scans.
struct Bench<'a> {
    link: &'a Link<1>,
    flash: &'a RefCell<Nor<SECTOR>>,
    calm: &'a Cell<bool>,
}

impl Bench<'_> {
    /// Hands on a value, and lets some time pass.
    async fn change(&self, value: i32, ms: u64) {
        self.link.hand([value]);
        Timer::after(Duration::from_millis(ms)).await;
    }

    /// Whether the alarm is an input of the program now.
    fn alarm(&self) -> bool {
        let counter = program(COUNTER);
        let mut engine = counter.engine();
        self.link.sample(&mut engine);
        engine.start();
        engine.bit(bit("low"))
    }

    fn counts(&self) -> (usize, usize) {
        let flash = self.flash.borrow();
        (flash.programmed, flash.erased)
    }
}

fn bit(name: &str) -> Bit {
    match program(COUNTER).slot(name) {
        Slot::Bit(bit) => bit,
        Slot::Number(_) => panic!("{name} is a number"),
    }
}

/// Runs the task on a flash that refuses so many writes, beside some work and the scans. The answer is what was said.
fn beside<W: AsyncFnOnce(&Bench<'_>)>(
    flash: &RefCell<Nor<SECTOR>>,
    refusals: u32,
    declares_quiet: bool,
    work: W,
) -> Vec<String> {
    beside_scans_of(SCAN, flash, refusals, declares_quiet, work)
}

/// The same with another period.
fn beside_scans_of<W: AsyncFnOnce(&Bench<'_>)>(
    period: Duration,
    flash: &RefCell<Nor<SECTOR>>,
    refusals: u32,
    declares_quiet: bool,
    work: W,
) -> Vec<String> {
    let counter = program(COUNTER);
    let ((), lines) = keep(|| {
        simulate(async {
            let shared = Shared { flash, refusals };
            let mut store = Store::new(shared, AREA);
            store.load().await.expect("the flash works");
            prepare(&mut store).await;
            let link = Link::new(Wires {
                quiet: declares_quiet.then(|| bit("CALM")),
                alarm: Some(bit("low")),
            });
            let calm = Cell::new(false);
            let bench = Bench {
                link: &link,
                flash,
                calm: &calm,
            };
            // Step 1 is active after the first scan only when the program is calm.
            let (mut busy, mut quiet) = (counter.engine(), counter.engine());
            quiet.start();
            busy.scan(0);
            let pulse = Pulse::new(Task::Store, SILENCE_MS);
            let watch = async {
                // A task that shows itself four times a second is never silent for one.
                loop {
                    Timer::after(Duration::from_millis(200)).await;
                    assert_eq!(pulse.count(SILENCE_MS / 2), None);
                }
            };
            let scans = async {
                loop {
                    let release = Instant::now() + period;
                    link.lease(if calm.get() { &quiet } else { &busy }, release);
                    Timer::at(release).await;
                }
            };
            let task = plc::store::keep(&mut store, counter.program, &link, [0], &pulse);
            select3(work(&bench), select(scans, watch), task).await;
        })
        .expect("somebody always waits for time to pass");
    });
    lines.into_iter().map(|line| line.text).collect()
}

/// Hands values to the store, 100 ms apart, and waits for 5 s more. The answer is how often the flash was programmed
/// after each, and what was said.
fn programmed(handed: &[i32], refusals: u32) -> (Vec<usize>, Vec<String>) {
    let flash = RefCell::new(Nor::new(SECTORS));
    let counts = RefCell::new(Vec::new());
    let lines = beside(&flash, refusals, false, async |bench| {
        for value in handed {
            bench.change(*value, 100).await;
            counts.borrow_mut().push(bench.counts().0);
        }
        Timer::after(Duration::from_secs(5)).await;
        counts.borrow_mut().push(bench.counts().0);
    });
    (counts.into_inner(), lines)
}

/// What a flash holds at the next start.
fn held(flash: &RefCell<Nor<SECTOR>>) -> Option<i32> {
    let mut store = Store::new(flash.borrow().clone(), AREA);
    let record = embassy_futures::block_on(store.load()).expect("the flash works");
    record.and_then(|record| record.values.iter().next().map(|(_, value)| value))
}

#[test]
fn nothing_is_written_until_something_changes() {
    assert_eq!(programmed(&[0, 0], 0), (vec![0, 0, 0], vec![]));
}

#[test]
fn each_change_is_written_once_with_one_program() {
    let (counts, lines) = programmed(&[1, 1, 2, 2, 1], 0);
    assert_eq!(counts, [1, 1, 2, 2, 3, 3]);
    assert_eq!(lines, Vec::<String>::new());
}

#[test]
fn a_write_that_fails_is_reported_and_tried_again() {
    let (counts, lines) = programmed(&[7], 2);
    assert_eq!(counts, [0, 1]);
    assert_eq!(lines, ["retain store: the flash reports a fault"; 2]);
}

#[test]
fn what_changes_while_a_write_waits_to_be_tried_again_is_written_in_its_place() {
    let flash = RefCell::new(Nor::new(SECTORS));
    beside(&flash, 1, false, async |bench| {
        bench.change(7, 100).await;
        bench.change(8, 5_000).await;
        assert_eq!(bench.counts(), (1, 0));
    });
    assert_eq!(held(&flash), Some(8));
}

#[test]
fn the_alarm_comes_with_a_quarter_left_and_a_quiet_moment_ends_it() {
    let flash = RefCell::new(Nor::new(SECTORS));
    let lines = beside(&flash, 0, true, async |bench| {
        let mut value = 0;
        while !bench.alarm() {
            value += 1;
            bench.change(value, APART).await;
        }
        assert_eq!(value, 4 * RECORDS + 1, "of the stock of six two are left");
        assert_eq!(bench.counts().1, 0, "nothing is erased before");
        bench.calm.set(true);
        Timer::after(10 * SCAN).await;
        assert!(bench.counts().1 > 0);
        assert!(!bench.alarm());
    });
    assert_eq!(
        lines[0],
        "retain store: 2 erased sectors are left, more come with a quiet moment or a start"
    );
}

#[test]
fn a_quiet_scan_is_good_for_one_sector() {
    let flash = RefCell::new(Nor::new(SECTORS));
    beside(&flash, 0, true, async |bench| {
        for value in 1..=5 * RECORDS {
            bench.change(value, APART).await;
        }
        // The last sector of the ring is erased from the beginning, and only looked at.
        for erased in 0..4 {
            bench.calm.set(true);
            Timer::after(SCAN).await;
            bench.calm.set(false);
            assert_eq!(bench.counts().1, erased);
            Timer::after(10 * SCAN).await;
            assert_eq!(bench.counts().1, erased);
        }
    });
}

#[test]
fn with_a_quiet_moment_declared_nothing_is_erased_before_it_and_the_newest_values_wait_for_it() {
    let flash = RefCell::new(Nor::new(SECTORS));
    let lines = beside(&flash, 0, true, async |bench| {
        for value in 1..200 {
            bench.change(value, APART).await;
        }
        let places = (SECTORS as i32 - 1) * RECORDS;
        assert_eq!(bench.counts(), (places as usize, 0));
        assert_eq!(held(bench.flash), Some(places));
        assert!(bench.alarm());
        bench.calm.set(true);
        Timer::after(2 * SCAN).await;
        assert_eq!(held(bench.flash), Some(199));
    });
    let waits = "retain store: no erased sector is left, changes wait for a quiet moment";
    assert_eq!(lines.iter().filter(|line| *line == waits).count(), 1);
}

#[test]
fn without_one_a_sector_is_erased_when_none_is_left_and_it_is_said_each_time() {
    let flash = RefCell::new(Nor::new(SECTORS));
    let lines = beside(&flash, 0, false, async |bench| {
        for value in 1..=100 {
            bench.change(value, APART).await;
            assert_eq!(held(bench.flash), Some(value));
        }
        bench.calm.set(true);
        assert!(bench.alarm());
    });
    let said = "retain store: no erased sector is left, one is erased while the program runs";
    let erased = flash.borrow().erased;
    assert_eq!(
        lines.iter().filter(|line| *line == said).count(),
        erased + 1
    );
    assert!(erased > 0);
}

/// Changes in every scan of so many hours, all of them quiet. The answer is how many sectors were erased.
fn erased_in(hours: u64, flash: &RefCell<Nor<SECTOR>>) -> usize {
    let before = flash.borrow().erased;
    let period = Duration::from_secs(30);
    beside_scans_of(period, flash, 0, true, async |bench| {
        bench.calm.set(true);
        for scan in 0..(hours * 3600 / period.as_secs()) as i32 {
            bench.change(scan, period.as_millis()).await;
        }
    });
    flash.borrow().erased - before
}

#[test]
fn no_program_wears_the_flash_out_before_its_time() {
    let flash = RefCell::new(Nor::new(SECTORS));
    // The credit of the beginning is half the area.
    erased_in(2, &flash);
    let hours = 60;
    let erased = erased_in(hours, &flash);
    let cycles = CYCLES * SECTORS as u64;
    let years = cycles as f64 * hours as f64 / (erased as f64 * 365.25 * 24.0);
    println!("{erased} sectors erased in {hours} hours: {years:.1} years");
    let promised = LIFE_YEARS as f64;
    assert!(
        (0.95 * promised..1.15 * promised).contains(&years),
        "{years} years"
    );
}

#[test]
fn a_restart_is_no_new_credit() {
    let flash = RefCell::new(Nor::new(SECTORS));
    erased_in(2, &flash);
    let before = flash.borrow().programmed;
    for _ in 0..20 {
        let lines = beside(&flash, 0, false, async |bench| {
            bench.change(-1, 50).await;
            bench.change(-2, 50).await;
        });
        assert!(
            lines[0].contains("changes come faster than the flash bears"),
            "{lines:?}"
        );
    }
    assert_eq!(flash.borrow().programmed, before);
}

#[test]
fn a_lone_change_is_written_at_once_and_of_many_the_newest_when_it_may_be() {
    let flash = RefCell::new(Nor::new(SECTORS));
    beside(&flash, 0, true, async |bench| {
        bench.calm.set(true);
        let mut value = 0;
        let mut at_once = 0;
        loop {
            value += 1;
            bench.change(value, 1).await;
            if held(bench.flash) != Some(value) {
                break;
            }
            at_once += 1;
        }
        let half_the_area = SECTORS as i32 * RECORDS / 2;
        assert!(
            (half_the_area..half_the_area + 2).contains(&at_once),
            "{at_once}"
        );
        bench.change(1_000, 1).await;
        bench.change(1_001, 2 * APART).await;
        assert_eq!(held(bench.flash), Some(1_001));
        bench.change(1_002, 1).await;
        assert_eq!(held(bench.flash), Some(1_002), "it has been saved up for");
    });
}
