//! Scales: exact at their ends, even in between, and back again.

use plc::scale::{FULL_SCALE, Scale};
use proptest::prelude::*;

/// What a `plc.toml` can say: two values of a word.
fn scales() -> impl Strategy<Value = Scale> {
    let end = -32_768..=65_535_i32;
    (end.clone(), end)
        .prop_filter("a scale has a length", |(low, high)| low != high)
        .prop_map(|(low, high)| Scale { low, high })
}

fn length(scale: Scale) -> i64 {
    i64::from(scale.high) - i64::from(scale.low)
}

/// Twice the numerator of what the value lies away from the line between the ends, in units of 1 / (2 * 4095 * n).
fn off_the_line(scale: Scale, sum: u32, readings: u16) -> i64 {
    let full = i64::from(FULL_SCALE) * i64::from(readings);
    let value = i64::from(scale.value(sum, readings)) - i64::from(scale.low);
    2 * (value * full - i64::from(sum) * length(scale))
}

#[test]
fn a_tank_of_250_cm_is_read_in_cm() {
    let tank = Scale { low: 0, high: 250 };
    let values = [0, 8, 9, 1638, 2047, 2048, 4086, 4087, 4095].map(|it| tank.value(it, 1));
    assert_eq!(values, [0, 0, 1, 100, 125, 125, 249, 250, 250]);
}

#[test]
fn a_scale_may_fall_and_pass_zero() {
    let falling = Scale {
        low: 400,
        high: -400,
    };
    let values = [0, 1024, 2047, 2048, 4095].map(|it| falling.value(it, 1));
    assert_eq!(values, [400, 200, 0, 0, -400]);
    assert_eq!(falling.reading(-400), FULL_SCALE);
}

#[test]
fn of_two_values_that_are_as_near_the_one_toward_high_is_taken() {
    // Two readings, 0 and 4095, of a scale of one step: the mean lies in the middle.
    assert_eq!(Scale { low: 0, high: 1 }.value(4095, 2), 1);
    assert_eq!(Scale { low: 1, high: 0 }.value(4095, 2), 0);
    assert_eq!(Scale { low: -1, high: 0 }.value(4095, 2), 0);
}

#[test]
fn a_mean_is_finer_than_one_reading() {
    let whole_word = Scale {
        low: 0,
        high: 65_535,
    };
    assert_eq!(whole_word.value(1000, 1), 16_004);
    assert_eq!(whole_word.value(1000 + 1001, 2), 16_012);
    assert_eq!(whole_word.value(1001, 1), 16_020);
}

#[test]
fn what_no_plc_toml_says_is_answered_too() {
    let pointless = Scale { low: 7, high: 7 };
    assert_eq!((pointless.value(2000, 1), pointless.reading(9)), (7, 0));
    let widest = Scale {
        low: i32::MIN,
        high: i32::MAX,
    };
    assert_eq!(widest.value(4095, 1), i32::MAX);
    assert_eq!(widest.value(u32::MAX, u16::MAX), i32::MAX);
    assert_eq!(
        (widest.reading(i32::MIN), widest.reading(i32::MAX)),
        (0, FULL_SCALE)
    );
    assert_eq!(widest.value(0, 0), i32::MIN);
}

proptest! {
    #[test]
    fn the_ends_are_exact(scale in scales(), readings in 1..=1000_u16) {
        prop_assert_eq!(scale.value(0, readings), scale.low);
        let full = u32::from(FULL_SCALE) * u32::from(readings);
        prop_assert_eq!(scale.value(full, readings), scale.high);
        prop_assert_eq!((scale.reading(scale.low), scale.reading(scale.high)), (0, FULL_SCALE));
    }

    #[test]
    fn a_value_is_the_nearest_to_the_line(scale in scales(), readings in 1..=1000_u16, mean in 0..=FULL_SCALE, odd in 0..1000_u32) {
        let full = u32::from(FULL_SCALE) * u32::from(readings);
        let sum = (u32::from(mean) * u32::from(readings) + odd).min(full);
        prop_assert!(off_the_line(scale, sum, readings).unsigned_abs() <= u64::from(full));
    }

    #[test]
    fn more_voltage_never_turns_the_value_back(scale in scales(), reading in 0..FULL_SCALE) {
        let step = scale.value(u32::from(reading) + 1, 1) - scale.value(reading.into(), 1);
        prop_assert!(step == 0 || (step > 0) == (length(scale) > 0));
    }

    #[test]
    fn a_value_comes_back_through_a_reading_if_there_are_enough_of_them(low in -32_768..=61_440_i32, length in 1..=4095_i32, falls: bool, at in 0..=4095_i32) {
        let (low, high) = if falls { (low + length, low) } else { (low, low + length) };
        let scale = Scale { low, high };
        let value = low.min(high) + at.min(length);
        prop_assert_eq!(scale.value(scale.reading(value).into(), 1), value);
    }

    #[test]
    fn a_reading_comes_back_through_a_value_within_one(scale in scales(), reading in 0..=FULL_SCALE) {
        prop_assume!(length(scale).unsigned_abs() >= u64::from(FULL_SCALE));
        let back = scale.reading(scale.value(reading.into(), 1));
        prop_assert!(back.abs_diff(reading) <= 1);
    }

    #[test]
    fn the_reading_of_a_value_is_the_nearest(scale in scales(), value in -70_000..=70_000_i32) {
        let reading = scale.reading(value);
        let (least, most) = (scale.low.min(scale.high), scale.low.max(scale.high));
        let aim = i64::from(value.clamp(least, most)) - i64::from(scale.low);
        let off = (i64::from(reading) * length(scale) - aim * i64::from(FULL_SCALE)).abs();
        prop_assert!(2 * off <= length(scale).abs());
    }
}
