//! From reset to scan 0: the cause is told from what the reset left, and what still fits is restored.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

mod support;

use embassy_futures::block_on;
use plc::boards::host::clock::simulate;
use plc::boards::host::lines::keep;
use plc::boot::{Cause, Evidence, Mark, boot};
use plc::record::Values;
use plc::retain::Store;
use plc::scan::snapshot;
use plc::store::prepare;
use plc::vitals::Task;
use support::nor::Nor;
use support::program::{Leaked, program};

const SECTOR: usize = 256;
const SECTORS: usize = 4;

type TestStore = Store<Nor<SECTOR>>;

fn store(flash: Nor<SECTOR>) -> TestStore {
    let mut store = Store::new(flash, 0..(SECTOR * SECTORS) as u32);
    block_on(store.load()).expect("the flash works");
    block_on(prepare(&mut store));
    store
}

/// A flash with the values of a program's retained variables and parameters.
fn stored(by: Leaked, values: &[i32]) -> Nor<SECTOR> {
    let mut store = store(Nor::new(SECTORS));
    let values = Values::Running(by.program.retained, values);
    block_on(store.save(by.program.fingerprint, values, 0)).expect("there is room");
    store.into_flash()
}

/// Boots a program. The answer is its retained values and what it said.
fn booted<const R: usize>(
    what: Leaked,
    flash: Nor<SECTOR>,
    cause: Cause,
) -> ([i32; R], Vec<String>) {
    let ((values, recovered), lines) = keep(|| {
        simulate(async {
            let mut engine = what.engine();
            let mut store = Store::new(flash, 0..(SECTOR * SECTORS) as u32);
            boot(&mut engine, what.names, &mut store, cause).await;
            let recovered = engine.bit(grafcet_core::program::Bit::RECOVERED);
            (snapshot(&engine), recovered)
        })
        .expect("nothing waits for anything")
    });
    assert_eq!(recovered, cause.is_recovery());
    (values, lines.into_iter().map(|line| line.text).collect())
}

const OLD: &str = "
    retain var locked
    retain var count : int
    parameter delay : time = 2 s in 1 s .. 10 s
    parameter gone : int = 5
    graph G { initial step 1 { locked = TRUE; count = count + gone } step 2
        transition 1: 1 -> 2 when T/X1/delay }
";

const NEW: &str = "
    retain var locked
    retain var count : int
    parameter delay : time = 3 s in 1 s .. 5 s
    graph G { initial step 1 { locked = TRUE; count = count + 1 } step 2
        transition 1: 1 -> 2 when T/X1/delay AND locked }
";

#[test]
fn the_same_program_gets_everything_back() {
    let old = program(OLD);
    let flash = stored(old, &[1, 42, 7_000, 9]);
    let (values, lines) = booted::<4>(old, flash, Cause::PowerOn);
    assert_eq!(values, [1, 42, 7_000, 9]);
    let fingerprint = format!("{:08x}", old.program.fingerprint);
    let boot_line = format!(
        "test {fingerprint}, scan 10 ms, reset: power-on, restored: 4 of 4 retained values"
    );
    assert_eq!(lines, [boot_line]);
}

#[test]
fn a_changed_program_keeps_what_fits_and_names_what_it_drops() {
    let (old, new) = (program(OLD), program(NEW));
    let flash = stored(old, &[1, 42, 7_000, 9]);
    let (values, lines) = booted::<3>(new, flash, Cause::PowerOn);
    assert_eq!(
        values,
        [1, 42, 3_000],
        "the delay has another range, so it is another parameter"
    );
    let dropped = lines
        .iter()
        .filter(|line| line.contains("is dropped"))
        .count();
    assert_eq!(dropped, 2, "{lines:?}");
    assert!(lines[0].contains("another program"), "{lines:?}");
    assert!(
        lines[3].ends_with("restored: 2 of 3 retained values"),
        "{lines:?}"
    );
}

#[test]
fn a_value_that_its_variable_cannot_have_is_dropped_by_name() {
    let old = program(OLD);
    let flash = stored(old, &[2, 42, 70_000, 9]);
    let (values, lines) = booted::<4>(old, flash, Cause::PowerOn);
    assert_eq!(values, [0, 42, 2_000, 9]);
    assert_eq!(
        lines[0],
        "retain store: locked = 2 does not fit and is dropped"
    );
    assert_eq!(
        lines[1],
        "retain store: delay = 70000 does not fit and is dropped"
    );
}

#[test]
fn without_a_record_the_declared_values_hold() {
    let (values, lines) = booted::<4>(program(OLD), Nor::new(SECTORS), Cause::BrownOut);
    assert_eq!(values, [0, 0, 2_000, 5]);
    assert!(
        lines[0].contains("reset: brown-out, restored: 0 of 4"),
        "{lines:?}"
    );
}

#[test]
fn an_area_that_holds_no_record_is_no_obstacle_and_the_program_starts() {
    let alien = Nor::holding(vec![0; SECTOR * SECTORS]);
    let (values, lines) = booted::<4>(program(OLD), alien, Cause::PowerOn);
    assert_eq!(values, [0, 0, 2_000, 5]);
    assert_eq!(lines.len(), 1, "{lines:?}");
    assert!(lines[0].contains("restored: 0 of 4"), "{lines:?}");
}

#[test]
fn a_flash_that_fails_does_not_keep_the_program_from_starting() {
    let flash = Nor::new(1);
    let (values, lines) = booted::<4>(program(OLD), flash, Cause::PowerOn);
    assert_eq!(values, [0, 0, 2_000, 5]);
    assert_eq!(lines[0], "retain store: the flash reports a fault");
}

#[test]
fn the_cause_of_a_reset_is_told_from_what_it_left() {
    let power = Evidence {
        by_watchdog: false,
        mark: Mark::None,
        suspect: Task::Scan,
        by_debug_port: false,
        by_run_pin: false,
        memory_kept: false,
    };
    let cases = [
        (power, Cause::PowerOn),
        (
            Evidence {
                memory_kept: true,
                ..power
            },
            Cause::BrownOut,
        ),
        (
            Evidence {
                by_run_pin: true,
                memory_kept: true,
                ..power
            },
            Cause::RunPin,
        ),
        (
            Evidence {
                by_debug_port: true,
                memory_kept: true,
                ..power
            },
            Cause::Debugger,
        ),
        (
            Evidence {
                mark: Mark::Running,
                memory_kept: true,
                ..power
            },
            Cause::Debugger,
        ),
        (
            Evidence {
                by_watchdog: true,
                mark: Mark::Running,
                ..power
            },
            Cause::Watchdog(Task::Scan),
        ),
        (
            Evidence {
                by_watchdog: true,
                mark: Mark::Running,
                suspect: Task::Store,
                ..power
            },
            Cause::Watchdog(Task::Store),
        ),
        (
            Evidence {
                by_watchdog: true,
                mark: Mark::Overloaded,
                ..power
            },
            Cause::Overload,
        ),
        (
            Evidence {
                by_watchdog: true,
                mark: Mark::Panicked,
                ..power
            },
            Cause::Panic,
        ),
        (
            Evidence {
                by_watchdog: true,
                ..power
            },
            Cause::Reboot,
        ),
    ];
    for (evidence, cause) in cases {
        assert_eq!(evidence.cause(), cause, "{evidence:?}");
    }
    let recoveries = cases
        .iter()
        .filter(|(_, cause)| cause.is_recovery())
        .count();
    assert_eq!(recoveries, 5);
}

#[test]
fn what_an_image_leaves_is_read_by_the_next_one_and_noise_is_not() {
    for mark in [Mark::None, Mark::Running, Mark::Panicked, Mark::Overloaded] {
        assert_eq!(Mark::read(mark.word()), mark);
    }
    for task in Task::ALL {
        assert_eq!(Task::read(task.word()), task);
    }
    for noise in [1, 0x706c_6330, u32::MAX] {
        assert_eq!(Mark::read(noise), Mark::None);
    }
    assert_eq!(Task::read(u32::MAX), Task::Scan);
}

#[test]
fn the_boot_line_names_what_hung() {
    let causes = Task::ALL.map(|task| Cause::Watchdog(task).name());
    for (cause, task) in causes.into_iter().zip(Task::ALL) {
        assert_eq!(cause, format!("watchdog: {} hung", task.name()));
    }
}
