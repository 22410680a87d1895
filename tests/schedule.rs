//! Releases are at fixed times; what is late or missed is counted and never made up for.

use embassy_time::{Duration, Instant};
use plc::schedule::{Faults, Schedule};
use proptest::prelude::*;

const PERIOD_MS: u32 = 10;
const LATE_AFTER: Duration = Duration::from_millis(1);

fn at(us: u64) -> Instant {
    Instant::from_micros(us)
}

fn schedule() -> Schedule {
    Schedule::new(at(5_000), PERIOD_MS, LATE_AFTER)
}

#[test]
fn a_scan_bears_the_time_of_its_release_however_it_jitters() {
    let mut schedule = schedule();
    for (release, jitter) in [(10, 0), (20, 900), (30, 20), (40, 1_000)] {
        assert_eq!(schedule.release(), at(5_000 + release * 1_000));
        let served = schedule.serve(schedule.release() + Duration::from_micros(jitter));
        assert_eq!(served.time_ms, release);
        assert_eq!((served.late_by, served.missed), (None, 0));
        assert_eq!(
            schedule.complete(schedule.release() - Duration::from_micros(1)),
            0
        );
    }
    assert_eq!(schedule.faults(), Faults::default());
}

#[test]
fn a_start_behind_the_tolerance_is_late_and_on_it_is_not() {
    let mut schedule = schedule();
    let served = schedule.serve(schedule.release() + LATE_AFTER);
    assert_eq!(served.late_by, None);
    let late = LATE_AFTER + Duration::from_micros(1);
    let served = schedule.serve(schedule.release() + late);
    assert_eq!((served.late_by, served.time_ms), (Some(late), 20));
    assert_eq!(
        schedule.faults(),
        Faults {
            late: 1,
            overruns: 0
        }
    );
}

#[test]
fn an_overrun_skips_the_releases_it_hides_and_waits_for_the_next() {
    let mut schedule = schedule();
    assert_eq!(schedule.serve(at(15_000)).time_ms, 10);
    assert_eq!(schedule.complete(at(48_000)), 3);
    assert_eq!(schedule.release(), at(55_000));
    assert_eq!(schedule.serve(at(55_000)).time_ms, 50);
    assert_eq!(
        schedule.faults(),
        Faults {
            late: 0,
            overruns: 1
        }
    );
}

#[test]
fn a_scan_that_ends_with_the_next_release_is_no_overrun() {
    let mut schedule = schedule();
    schedule.serve(at(15_000));
    assert_eq!(schedule.complete(at(25_000)), 0);
    assert_eq!(schedule.serve(at(25_000)).time_ms, 20);
}

#[test]
fn a_start_that_was_held_up_serves_the_latest_release_that_is_due() {
    let mut schedule = schedule();
    let served = schedule.serve(at(61_500));
    assert_eq!((served.time_ms, served.missed), (50, 4));
    assert_eq!(served.late_by, Some(Duration::from_micros(6_500)));
    assert_eq!(schedule.release(), at(65_000));
    assert_eq!(
        schedule.faults(),
        Faults {
            late: 1,
            overruns: 1
        }
    );
}

#[test]
fn releases_keep_their_times_where_32_bits_of_them_end_and_years_later() {
    const MICROSECONDS: u64 = 1 << 32;
    const MILLISECONDS: u64 = (1 << 32) * 1_000;
    const YEAR: u64 = 365 * 24 * 3_600_000_000;
    for end in [
        MICROSECONDS,
        7 * MICROSECONDS,
        MILLISECONDS,
        9 * MILLISECONDS,
        50 * YEAR,
    ] {
        let mut schedule = schedule();
        // Nothing ran until shortly before.
        let before = end - 1_000_000;
        let mut last = schedule.serve(at(before)).time_ms;
        assert_eq!(last, (before - 5_000) / 10_000 * 10);
        for scan in 1..=300 {
            assert_eq!(schedule.complete(schedule.release()), 0);
            let served = schedule.serve(schedule.release());
            assert_eq!(
                (served.time_ms, served.missed),
                (last + 10, 0),
                "scan {scan}"
            );
            assert_eq!(
                at(5_000) + Duration::from_millis(served.time_ms) + Duration::from_millis(10),
                schedule.release()
            );
            last = served.time_ms;
        }
        assert!(last * 1_000 > end);
        assert_eq!(schedule.faults().overruns, 1);
    }
}

#[test]
fn an_overrun_that_the_program_asked_for_is_counted_and_no_part_of_an_overload() {
    let mut schedule = schedule();
    for _ in 0..50 {
        let served = schedule.serve(schedule.release() + Duration::from_millis(45));
        assert_eq!(served.missed, 4);
        schedule.excuse();
        schedule.complete(schedule.release());
    }
    assert_eq!(schedule.faults().overruns, 50);
    assert_eq!(schedule.recent_overruns(), 0);
    schedule.serve(schedule.release());
    schedule.excuse();
    schedule.complete(schedule.release() + Duration::from_millis(1));
    assert_eq!(
        schedule.recent_overruns(),
        1,
        "the scan itself took too long"
    );
}

proptest! {
    #[test]
    fn times_are_releases_ascend_and_are_never_ahead_of_the_clock(
        period_ms in 1..50_u32,
        scans in proptest::collection::vec((0..80_000_u64, 0..80_000_u64), 1..50),
    ) {
        let start = at(123_456);
        let mut schedule = Schedule::new(start, period_ms, LATE_AFTER);
        let (mut last, mut gaps) = (0, 0);
        for (delay, duration) in scans {
            let now = schedule.release() + Duration::from_micros(delay);
            let served = schedule.serve(now);
            let release = start + Duration::from_millis(served.time_ms);
            let period = u64::from(period_ms);
            prop_assert_eq!(served.time_ms % period, 0);
            prop_assert!(served.time_ms > last);
            prop_assert!(release <= now && now < release + Duration::from_millis(period));
            gaps += u64::from(served.time_ms - last > period);
            last = served.time_ms;
            schedule.complete(now + Duration::from_micros(duration));
            prop_assert!(schedule.release() >= now + Duration::from_micros(duration));
            prop_assert!(u64::from(schedule.faults().overruns) >= gaps);
        }
    }
}
