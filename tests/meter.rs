//! What people are shown of a numeric input.

use grafcet_core::program::Number;
use plc::boards::host::meter::Meter;
use plc::scale::Scale;
use plc::wiring::{AnalogueWire, Label};

static LABELS: [Label; 1] = [Label {
    name: "level",
    pin: "GP26",
}];

/// What is shown of these values.
fn shown(low: i32, high: i32, values: impl IntoIterator<Item = i32>) -> Vec<String> {
    let wires = Box::leak(Box::new([AnalogueWire {
        number: Number(2),
        address: "%IW0",
        scale: Scale { low, high },
        filter_ms: 0,
    }]));
    let mut meters = Meter::each(wires, &LABELS);
    let values = values.into_iter();
    values.filter_map(|value| meters[0].show(value)).collect()
}

#[test]
fn a_tank_that_fills_and_empties_is_shown_in_eighths_and_at_its_ends() {
    let values = (0..=200).chain((0..200).rev());
    let expected = [32, 64, 96, 128, 160, 192, 160, 128, 96, 64, 32, 0];
    let expected: Vec<String> = expected.iter().map(|it| format!("level = {it}")).collect();
    assert_eq!(shown(0, 250, values), expected);
    assert_eq!(shown(0, 250, [249, 250]), ["level = 249", "level = 250"]);
}

#[test]
fn small_waves_and_what_stays_are_not_shown() {
    assert_eq!(
        shown(0, 2000, [700, 900, 700, 900, 900, 1000]),
        ["level = 700", "level = 1000"]
    );
}

#[test]
fn what_lies_beyond_the_scale_is_shown_as_the_controller_sees_it() {
    assert_eq!(
        shown(-50, 200, [0, 400, -400]),
        ["level = 200", "level = -50"]
    );
}

#[test]
fn nothing_at_the_terminal_is_where_it_begins() {
    assert_eq!(shown(100, 500, [0, 100]), Vec::<String>::new());
    assert_eq!(shown(100, -100, [0, 1]), Vec::<String>::new());
}
