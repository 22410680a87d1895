//! The scan task on pins and in simulated time: safe until scan 0 has ended, never in a burst, every fault counted.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

mod support;

use support::task::{CASE, Case, KEEP_RUNNING, Seen, run};

#[test]
fn outputs_are_safe_until_scan_0_writes_them() {
    let seen = run(&CASE);
    assert_eq!(
        seen.run[..2],
        [(0, true), (0, false)],
        "safe is on, and step 1 does not run"
    );
    assert_eq!(
        seen.ready[..2],
        [(0, true), (0, false)],
        "active low: off is high"
    );
}

#[test]
fn scans_come_with_the_period_and_the_log_names_what_they_change() {
    let seen = run(&Case {
        levels: &[(15, true), (42, false)],
        ..CASE
    });
    let times: Vec<u64> = seen.scans.iter().map(|scan| scan.at_ms).collect();
    assert_eq!(times, (0..10).map(|k| k * 10).collect::<Vec<_>>());
    assert_eq!(
        Seen::changes(&seen.run),
        [(0, true), (0, false), (20, true), (50, false)]
    );
    assert_eq!(
        seen.texts(),
        [
            "Press starts in {1}",
            "Press T1: {1} -> {2}",
            "Press T2: {2} -> {1}"
        ]
    );
    assert_eq!(seen.lines[1].time_ms, 20);
}

#[test]
fn retained_values_are_handed_on_when_they_change_and_only_then() {
    assert_eq!(run(&CASE).changes, None);
    let seen = run(&Case {
        levels: &[(15, true), (42, false), (65, true)],
        ..CASE
    });
    assert_eq!(
        seen.changes,
        Some([2]),
        "the newest snapshot takes the place of older ones"
    );
}

#[test]
fn an_overrun_is_counted_and_followed_by_the_next_release_not_by_a_burst() {
    let seen = run(&Case {
        cost_ms: |scan| if scan == 2 { 37 } else { 0 },
        ..CASE
    });
    let times: Vec<(u64, i32)> = seen
        .scans
        .iter()
        .map(|scan| (scan.at_ms, scan.overruns))
        .collect();
    assert_eq!(
        times,
        [(0, 0), (10, 0), (20, 0), (60, 1), (70, 1), (80, 1), (90, 1)]
    );
    assert_eq!(
        seen.texts()[1],
        "overrun: releases missed: 3 (1 overruns since start)"
    );
}

#[test]
fn scans_that_always_overrun_leave_time_for_the_tasks_below() {
    let seen = run(&Case {
        cost_ms: |_| 13,
        overload: KEEP_RUNNING,
        ..CASE
    });
    let times: Vec<u64> = seen.scans.iter().map(|scan| scan.at_ms).collect();
    assert_eq!(times, [0, 20, 40, 60, 80]);
}

#[test]
fn a_late_scan_is_counted_and_bears_the_time_of_its_release() {
    let seen = run(&Case {
        hog: (18, 5),
        levels: &[(15, true)],
        ..CASE
    });
    assert_eq!(seen.scans[2].at_ms, 23);
    assert_eq!(seen.scans[3].at_ms, 30, "what comes after is on time again");
    assert_eq!(
        seen.texts()[1],
        "late scan: 3000 us behind its release (1 since start)"
    );
    assert_eq!(seen.scans.last().map(|scan| scan.overruns), Some(0));
}

#[test]
fn a_scan_held_up_for_several_periods_serves_the_latest_release() {
    // As when a sector of the flash is erased.
    let seen = run(&Case {
        hog: (18, 45),
        ..CASE
    });
    let times: Vec<u64> = seen.scans.iter().map(|scan| scan.at_ms).collect();
    assert_eq!(times, [0, 10, 63, 70, 80, 90]);
    assert_eq!(seen.scans[2].overruns, 1);
    assert!(
        seen.texts()
            .contains(&"overrun: releases missed: 4 (1 overruns since start)")
    );
}

#[test]
fn scans_go_on_beyond_2_to_the_32_ms() {
    const ROLL_OVER_MS: u64 = 1 << 32;
    let seen = run(&Case {
        // Seven weeks in which nothing runs, up to 46 ms before.
        hog: (18, ROLL_OVER_MS - 64),
        levels: &[(15, true), (ROLL_OVER_MS + 5, false)],
        until_ms: ROLL_OVER_MS + 50,
        ..CASE
    });
    let times: Vec<u64> = seen.scans.iter().map(|scan| scan.at_ms).collect();
    // The releases are whole periods, of which 2^32 is none.
    let late = ROLL_OVER_MS - 46;
    let after = (1..=9).map(|k| late + 10 * k);
    let expected: Vec<u64> = [0, 10, late].into_iter().chain(after).collect();
    assert_eq!(times, expected);
    assert!(seen.scans[2..].iter().all(|scan| scan.overruns == 1));
    assert_eq!(seen.texts().last(), Some(&"Press T2: {2} -> {1}"));
    let last = seen.lines.last().map(|line| line.time_ms);
    assert_eq!(last, Some(ROLL_OVER_MS + 14));
}

#[test]
fn what_is_shorter_than_the_filter_never_reaches_the_program() {
    let seen = run(&Case {
        filter_ms: 5,
        levels: &[(18, true), (22, false), (33, true), (38, false), (41, true)],
        ..CASE
    });
    assert_eq!(
        Seen::changes(&seen.run),
        [(0, true), (0, false), (50, true)]
    );
}

#[test]
fn a_pulse_between_two_scans_is_seen_if_it_is_longer_than_the_filter() {
    let pulse: &[(u64, bool)] = &[(21, true), (28, false)];
    let changes = |filter_ms| {
        let seen = run(&Case {
            filter_ms,
            levels: pulse,
            ..CASE
        });
        Seen::changes(&seen.run)
    };
    assert_eq!(changes(3), [(0, true), (0, false), (30, true), (40, false)]);
    assert_eq!(
        changes(0),
        [(0, true), (0, false)],
        "without a filter only the scan looks"
    );
}

#[test]
fn a_level_longer_by_two_slow_scans_is_always_seen() {
    const FILTER_MS: u16 = 7;
    for (from, cost_ms) in (100..120).flat_map(|from| [(from, 3), (from, 6)]) {
        let costs: [fn(usize) -> u64; 2] = [|_| 3, |_| 6];
        let to = from + u64::from(FILTER_MS) + 2 + 2 * cost_ms;
        let seen = run(&Case {
            filter_ms: FILTER_MS,
            cost_ms: costs[cost_ms as usize / 3 - 1],
            levels: Box::leak(Box::new([(from, true), (to, false)])),
            until_ms: 300,
            ..CASE
        });
        let changes = Seen::changes(&seen.run);
        assert_eq!(changes.len(), 4, "from {from} to {to}: {changes:?}");
    }
}

#[test]
fn an_input_that_is_active_low_is_true_at_ground() {
    let seen = run(&Case {
        active_low: true,
        levels: &[(15, false)],
        ..CASE
    });
    assert_eq!(
        Seen::changes(&seen.run),
        [(0, true), (0, false), (20, true)]
    );
}
