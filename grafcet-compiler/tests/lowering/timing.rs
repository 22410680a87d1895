//! Timers on steps: which are asked for only while their step is active, and that these tell the same.

use grafcet_core::Engine;
use grafcet_core::program::{Preset, Timer};
use grafcet_core::vectors::Vectors;

use crate::graph;

const HOUR_MS: u64 = 60 * 60 * 1000;
/// Inputs.
const A: u32 = 0b01;
const B: u32 = 0b10;

/// The presets of the timers that are asked for only while their step is active.
fn own(elements: &str) -> Vec<Preset> {
    let tables = graph(elements);
    let own = |timer: &Timer| match timer {
        Timer::Own { preset, .. } => Some(*preset),
        Timer::Any { .. } => None,
    };
    tables.timers.iter().filter_map(own).collect()
}

#[test]
fn a_timer_in_an_action_of_its_step_or_behind_it_is_its_own() {
    let second = [Preset::Constant(1000)];
    assert_eq!(own("initial step 1 { M IF NOT T/X1/1s }"), second);
    assert_eq!(own("initial step 1 { n = n + 1 IF T/X1/1s AND a }"), second);
    assert_eq!(own("initial step 1 { M; N IF M AND 1s/X1 }"), second);
    assert_eq!(
        own("initial step 1; transition 1: 1 -> 1 when T/X1/1s OR a"),
        second
    );
    let both = "initial step 1; initial step 2; transition 1: 1, 2 -> 1, 2 when T/X2/1s";
    assert_eq!(own(both), second);
    assert!(matches!(
        own("initial step 1 { M IF T/X1/p }")[..],
        [Preset::Number(..)]
    ));
}

#[test]
fn a_timer_that_is_asked_for_at_other_times_too_is_not() {
    for elements in [
        "initial step 1; step 2 { M IF T/X1/1s }",
        "initial step 1; always { M IF T/X1/1s }",
        "initial step 1 { on deactivation: n = 1 IF T/X1/1s }",
        "initial step 1 { on event ↑a AND T/X1/1s: n = 1 }",
        "initial step 1; always { F/G:{1} IF T/X1/1s }",
        "initial step 1 { M IF ↑(a AND T/X1/1s) }",
        "initial step 1 { M IF T/(a AND T/X1/1s)/1s }",
        "initial step 1; transition 1: 1 -> 1 when a do { n = 1 IF T/X1/1s }",
        "initial step 1; step 2; transition 1: 1 -> 2 when T/X2/1s",
    ] {
        assert_eq!(own(elements), [], "{elements}");
    }
}

#[test]
fn a_timer_with_a_preset_that_may_change_within_a_scan_is_not() {
    for preset in ["t", "n", "(2s + t)", "m"] {
        assert_eq!(
            own(&format!("initial step 1 {{ M IF T/X1/{preset} }}")),
            [],
            "{preset}"
        );
    }
}

#[test]
fn a_timer_runs_out_on_time_and_stays_so_however_long_its_step_is_active() {
    let tables = graph("initial step 1 { M IF T/X1/2s; N IF T/X1/575h; O IF NOT T/X1/576h }");
    let program = tables.program();
    let momentary = usize::from(program.layout.momentary.start);
    let mut engine = Engine::new(&program, Vectors::new(&program));
    engine.start();
    let mut shown = |time_ms| {
        engine.scan(time_ms);
        let word = engine.image()[momentary];
        [word & 1 != 0, word & 2 != 0, word & 4 != 0]
    };
    assert_eq!(shown(1_999), [false, false, true]);
    assert_eq!(shown(2_000), [true, false, true]);
    assert_eq!(shown(575 * HOUR_MS - 1), [true, false, true]);
    assert_eq!(shown(575 * HOUR_MS), [true, true, true]);
    assert_eq!(shown(576 * HOUR_MS - 1), [true, true, true]);
    assert_eq!(shown(576 * HOUR_MS), [true, true, false]);
    // Some years, in days and in leaps.
    let (day, year) = (24 * HOUR_MS, 365 * 24 * HOUR_MS);
    for time_ms in (25 * day..year).step_by(7_654_321) {
        assert_eq!(shown(time_ms), [true, true, false], "after {time_ms} ms");
    }
    for leap in [1 << 31, (1 << 32) - 1, 1 << 32, (1 << 32) + 1, 1 << 40] {
        assert_eq!(shown(year + leap), [true, true, false], "after {leap} ms");
    }
}

#[test]
fn a_step_is_timed_anew_each_time_however_long_it_was_left() {
    let tables = graph(
        "initial step 1; step 2 { M IF T/X2/2s }
         transition 1: 1 -> 2 when a; transition 2: 2 -> 1 when b",
    );
    let program = tables.program();
    let momentary = usize::from(program.layout.momentary.start);
    let mut engine = Engine::new(&program, Vectors::new(&program));
    engine.start();
    let mut now_ms = 0;
    for away_ms in [
        10,
        2_000,
        1 << 30,
        1 << 31,
        (1 << 32) - 2_000,
        1 << 32,
        1 << 40,
    ] {
        let mut shown = |after_ms, inputs| {
            now_ms += after_ms;
            engine.set_inputs(0, inputs);
            engine.scan(now_ms);
            engine.image()[momentary] != 0
        };
        assert!(!shown(away_ms, A), "{away_ms}");
        assert!(!shown(1_999, 0) && shown(1, 0), "{away_ms}");
        assert!(!shown(10, B), "{away_ms}");
    }
}
