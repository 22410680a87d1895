//! The input filter: a level shorter than its time is never seen, a longer one always.

use plc::filter::{Filter, SAMPLE_US};
use proptest::prelude::*;

/// Samples a pin every millisecond from `phase_us` on, and reads the filter at each scan, every ten samples. The pin
/// shows the opposite of its first level during the given stretches of µs.
fn seen(filter_ms: u16, phase_us: u32, stretches: &[(u32, u32)], until_us: u32) -> Vec<bool> {
    let start = u32::MAX - 7_000; // The clock wraps around early on.
    let level = |at: u32| {
        stretches
            .iter()
            .any(|(from, to)| (*from..*to).contains(&at))
    };
    let mut filter = Filter::new(filter_ms, false, start);
    let mut seen = Vec::new();
    let mut samples = 0;
    let mut at = phase_us;
    let mut last = 0;
    while at < until_us {
        let edges = stretches.iter().flat_map(|(from, to)| [*from, *to]);
        let changed = edges.into_iter().any(|edge| last < edge && edge <= at);
        last = at;
        filter.sample(level(at), Some(changed), start.wrapping_add(at));
        samples += 1;
        if samples % 10 == 0 {
            seen.push(filter.read());
        }
        at += SAMPLE_US;
    }
    seen
}

#[test]
fn a_contact_that_bounces_gives_one_edge() {
    let bounce = [
        (20_000, 20_700),
        (21_300, 22_900),
        (23_100, 24_000),
        (24_200, 90_000),
    ];
    let seen = seen(5, 0, &bounce, 90_000);
    let edges = seen.windows(2).filter(|pair| pair[0] != pair[1]).count();
    assert_eq!((edges, seen[2], seen[3]), (1, false, true));
}

#[test]
fn the_level_at_power_on_is_taken_as_it_is() {
    assert!(Filter::new(20, true, 0).read());
}

#[test]
fn a_pulse_longer_than_the_filter_and_shorter_than_the_scan_period_is_seen_once() {
    let seen = seen(3, 0, &[(31_500, 36_900)], 100_000);
    assert_eq!(seen.iter().filter(|level| **level).count(), 1);
}

#[test]
fn two_glimpses_with_a_long_gap_between_are_not_one_long_level() {
    let mut filter = Filter::new(5, false, 0);
    filter.sample(true, None, 1_000);
    filter.sample(true, None, 46_000);
    assert!(!filter.read());
    filter.sample(true, None, 47_000);
    filter.sample(true, None, 52_000);
    assert!(filter.read());
}

proptest! {
    #[test]
    fn what_is_shorter_than_the_filter_time_is_never_seen(
        filter_ms in 1..60_u16,
        phase_us in 0..SAMPLE_US,
        lengths in proptest::collection::vec((0.0..1.0_f64, 1_u32..30_000), 1..40),
        // Noise between two samples is noticed by its edges.
        hum in any::<bool>(),
    ) {
        let mut at = 1_000;
        let mut stretches = Vec::new();
        for (part, pause) in lengths {
            at += if hum { 1 + pause % 500 } else { pause };
            let length = (f64::from(filter_ms) * 1000.0 * part) as u32;
            stretches.push((at, at + length));
            at += length;
        }
        let seen = seen(filter_ms, phase_us, &stretches, at + 100_000);
        prop_assert!(seen.iter().all(|level| !level), "{stretches:?}");
    }

    #[test]
    fn samples_may_fail_to_come_where_the_pin_tells_of_its_edges(
        filter_ms in 1..20_u16,
        gaps in proptest::collection::vec(1..30_000_u32, 1..200),
        lengths in proptest::collection::vec(1..60_000_u32, 1..60),
    ) {
        let filter_us = u32::from(filter_ms) * 1000;
        let mut edges = Vec::new();
        lengths.iter().fold(0, |at, length| { edges.push(at + length); at + length });
        let mut filter = Filter::new(filter_ms, false, 0);
        let (mut last, mut accepted) = (0, false);
        for gap in gaps {
            let at = last + gap;
            let passed = edges.partition_point(|edge| *edge <= at);
            let level = passed % 2 == 1;
            let changed = edges.iter().any(|edge| last < *edge && *edge <= at);
            filter.sample(level, Some(changed), at);
            let lasts = at - passed.checked_sub(1).map_or(0, |edge| edges[edge]);
            // Two gaps at most, before the first sample that shows it and before the one that is late enough.
            if filter.read() != accepted {
                accepted = level;
                prop_assert!(lasts >= filter_us, "{lasts} us");
            }
            if level != accepted {
                prop_assert!(lasts < filter_us + 2 * 30_000, "{lasts} us");
            }
            last = at;
        }
    }

    #[test]
    fn what_is_longer_by_two_samples_is_always_seen(
        filter_ms in 1..60_u16,
        phase_us in 0..SAMPLE_US,
        from in 2_000..40_000_u32,
        longer_us in 0..50_000_u32,
    ) {
        let to = from + u32::from(filter_ms) * 1000 + 2 * SAMPLE_US + longer_us;
        let seen = seen(filter_ms, phase_us, &[(from, to)], to + 200_000);
        prop_assert!(seen.contains(&true));
        prop_assert_eq!(seen.last(), Some(&false));
        let edges = seen.windows(2).filter(|pair| pair[0] != pair[1]).count();
        prop_assert_eq!(edges, 1 + usize::from(!seen[0]));
    }
}
