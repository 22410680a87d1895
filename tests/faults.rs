//! What the scan task does about scans that take too long too often, and about a task that hangs, in simulated time.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

mod support;

use plc::scan::{STANDSTILL, Stop};
use plc::vitals::{Pulse, Task};
use plc::wiring::{Overload, Policy};
use support::task::{CASE, Case, KEEP_RUNNING, Seen, run};

/// The button is held, so that RUN is on, whose safe level is on too, and READY is off, with its safe level.
const HELD: &[(u64, bool)] = &[(5, true)];

fn safe_stop(overruns: u32) -> Overload {
    Overload {
        policy: Policy::SafeStop,
        overruns,
    }
}

#[test]
fn beyond_the_limit_the_outputs_are_safe_at_once_and_the_controller_starts_again() {
    let seen = run(&Case {
        // Scans are released every 10 ms; from the fourth on each hides the next release.
        cost_ms: |scan| if scan > 3 { 14 } else { 0 },
        until_ms: 5_000,
        ..CASE
    });
    let last = seen.scans.last().expect("there were scans");
    assert_eq!((seen.scans.len(), last.at_ms), (14, 220));
    assert_eq!(seen.stop, Some((234, Stop::Overload)), "behind its tenth");
    assert_eq!(seen.run.last(), Some(&(234, true)), "safe is on");
    assert_eq!(
        seen.ready.last(),
        Some(&(234, true)),
        "active low: safe is off"
    );
    let said = "overload: 10 of the latest 100 scans overran: safe stop";
    assert!(seen.texts().contains(&said));
    assert_eq!(seen.ended_ms, Some(234 + STANDSTILL.as_millis()));
    assert!(Stop::Overload.cause().is_recovery());
}

#[test]
fn one_overrun_less_than_the_limit_is_no_overload() {
    let scan_costs = |scan| if scan > 3 && scan <= 12 { 14 } else { 0 };
    let seen = run(&Case {
        cost_ms: scan_costs,
        until_ms: 3_000,
        ..CASE
    });
    assert_eq!((seen.stop, seen.ended_ms), (None, None));
    let overruns = seen.scans.last().map(|scan| scan.overruns);
    assert_eq!(overruns, Some(9));
}

#[test]
fn overruns_count_for_a_hundred_scans() {
    // One in eleven is nine or ten in a hundred, one in twelve eight or nine.
    let seen = run(&Case {
        cost_ms: |scan| if scan % 11 == 5 { 14 } else { 0 },
        until_ms: 20_000,
        ..CASE
    });
    assert_eq!(seen.stop.map(|(_, stop)| stop), Some(Stop::Overload));
    assert_eq!(seen.scans.len(), 6 + 9 * 11);
    let seen = run(&Case {
        cost_ms: |scan| if scan % 12 == 5 { 14 } else { 0 },
        until_ms: 20_000,
        ..CASE
    });
    assert_eq!(seen.stop, None);
}

#[test]
fn a_limit_of_one_stops_at_the_first_overrun_and_one_of_a_hundred_when_none_is_in_time() {
    let cost_ms = |scan| if scan >= 7 { 37 } else { 0 };
    let until_ms = 20_000;
    let first = run(&Case {
        cost_ms,
        overload: safe_stop(1),
        until_ms,
        ..CASE
    });
    assert_eq!(
        (first.scans.len(), first.stop),
        (8, Some((107, Stop::Overload)))
    );
    let all = run(&Case {
        cost_ms,
        overload: safe_stop(100),
        until_ms,
        ..CASE
    });
    assert_eq!(all.scans.len(), 107);
    assert!(all.stop.is_some());
}

#[test]
fn a_stall_is_one_overrun_however_long_it_lasts() {
    // As when a sector of the flash is erased, at its slowest.
    let seen = run(&Case {
        hog: (18, 400),
        overload: safe_stop(2),
        until_ms: 2_000,
        ..CASE
    });
    assert_eq!(seen.stop, None);
    let stalled = run(&Case {
        hog: (18, 400),
        overload: safe_stop(1),
        until_ms: 2_000,
        ..CASE
    });
    assert_eq!(stalled.stop, Some((418, Stop::Overload)));
}

#[test]
fn a_controller_that_is_to_keep_running_says_so_once_and_runs() {
    let seen = run(&Case {
        cost_ms: |_| 13,
        overload: KEEP_RUNNING,
        levels: HELD,
        until_ms: 10_000,
        ..CASE
    });
    assert_eq!((seen.stop, seen.ended_ms), (None, None));
    assert_eq!(seen.scans.len(), 500, "every second release");
    let said = seen.texts();
    let overloads = said.iter().filter(|text| text.starts_with("overload"));
    assert_eq!(
        overloads.collect::<Vec<_>>(),
        [&"overload: 10 of the latest 100 scans overran: kept running"]
    );
    assert_eq!(Seen::changes(&seen.run).last(), Some(&(20, true)));
}

#[test]
fn an_overload_that_comes_again_after_a_hundred_scans_in_time_is_said_again() {
    let seen = run(&Case {
        cost_ms: |scan| if scan % 200 < 20 { 13 } else { 0 },
        overload: KEEP_RUNNING,
        until_ms: 5_000,
        ..CASE
    });
    let said = seen.texts();
    let overloads = said.iter().filter(|text| text.starts_with("overload"));
    assert_eq!(overloads.count(), 3);
}

#[test]
fn a_task_that_falls_silent_stops_the_controller_with_safe_outputs() {
    let seen = run(&Case {
        last_beat_ms: 450,
        until_ms: 5_000,
        ..CASE
    });
    // Its last beat is at 400 ms, before the scan then; 300 ms and two scans are allowed.
    assert_eq!(seen.stop, Some((720, Stop::Hung(Task::Store))));
    assert_eq!(seen.ended_ms, Some(720), "there is nothing to wait for");
    assert_eq!(seen.run.last(), Some(&(720, true)), "safe is on");
    assert_eq!(seen.texts().last(), Some(&"retain store hung: safe stop"));
    let fed = seen.scans.last().map(|scan| scan.at_ms);
    assert_eq!(fed, Some(710), "the scan that found it feeds no watchdog");
    assert!(Stop::Hung(Task::Store).cause().is_recovery());
}

#[test]
fn nobody_is_blamed_for_a_time_in_which_nothing_ran() {
    let seen = run(&Case {
        hog: (18, 60_000),
        until_ms: 61_000,
        ..CASE
    });
    assert_eq!(seen.stop, None);
}

#[test]
fn a_slow_scan_gives_a_task_two_scans_of_time() {
    let pulse = Pulse::new(Task::Store, 300);
    pulse.beat();
    assert_eq!(pulse.count(2_000), None);
    assert_eq!(pulse.count(2_000), None);
    assert_eq!(pulse.count(2_000), Some(Task::Store));
    pulse.beat();
    assert_eq!(pulse.count(2_000), None);
    assert_eq!(pulse.count(u32::MAX), None, "nor does a sum run over");
}
