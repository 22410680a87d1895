//! Analogue inputs: scales, and the pins that measure.

use wiring::rule::Rule;
use wiring::wire::AnalogueInput;

use crate::{loaded_with, shown};

/// A tank whose level is measured at GP26.
const TANK: &str = "\
application saw

input  start at %IX0.0
input  level : int at %IW0 in 0 .. 250
output VALVE at %QX0.0

graph Tank {
    initial step 1
    step 2 { VALVE }
    transition 1: 1 -> 2 when ↑start
    transition 2: 2 -> 1 when level > 200
}
";

const TANK_WIRED: &str = r#"application = "saw.grafcet"
board = "pico"

[inputs]
"%IX0.0" = "GP2"
"%IW0" = { pin = "GP26", low = 0, high = 250, filter = "20 ms" }

[outputs]
"%QX0.0" = "GP16"
"#;

/// The tank's file with a change, and the rules that are broken by it.
fn tank(from: &str, to: &str) -> (Vec<Rule>, String) {
    assert!(TANK_WIRED.contains(from), "{from}");
    shown(&loaded_with(TANK, &TANK_WIRED.replacen(from, to, 1)))
}

fn analogue(plc: &str) -> AnalogueInput {
    let loaded = loaded_with(&TANK.replace(" in 0 .. 250", ""), plc);
    let errors = loaded.errors();
    let (_, wiring) = loaded.image.expect(&errors);
    wiring.analogue_inputs[0].entry
}

#[test]
fn an_analogue_input_has_a_scale_and_a_filter() {
    let entry = analogue(TANK_WIRED);
    assert_eq!((entry.low.value, entry.high.value), (0, 250));
    assert_eq!(entry.filter_ms, 20);
}

#[test]
fn a_scale_may_be_negative_and_may_fall() {
    let falling = TANK_WIRED.replace("low = 0, high = 250", "low = 1_000, high = -0x80");
    let entry = analogue(&TANK_WIRED.replace("low = 0, high = 250", "low = 1_000, high = -128"));
    assert_eq!((entry.low.value, entry.high.value), (1000, -128));
    // TOML itself has no negative hexadecimal.
    let (rules, _) = shown(&loaded_with(TANK, &falling));
    assert_eq!(rules, [Rule::Toml]);
}

#[test]
fn without_a_scale_an_analogue_input_is_what_the_converter_reads() {
    let short = TANK_WIRED.replace(
        "{ pin = \"GP26\", low = 0, high = 250, filter = \"20 ms\" }",
        "\"GP28\"",
    );
    let entry = analogue(&short);
    assert_eq!((entry.low.value, entry.high.value), (0, 4095));
    assert_eq!(entry.filter_ms, 0);
}

#[test]
fn a_scale_lies_within_the_range_of_its_variable() {
    assert_shown!(tank("high = 250", "high = 300"), BadScale);
    let (rules, _) = tank("low = 0", "low = -1");
    assert_eq!(rules, [Rule::BadScale]);
    let (rules, text) = tank("low = 0, high = 250", "low = 200, high = 10");
    assert_eq!(rules, [], "{text}");
}

#[test]
fn the_readings_of_the_converter_may_not_fit_the_range_either() {
    assert_shown!(tank("low = 0, high = 250, ", ""), BadScale);
}

#[test]
fn a_scale_has_a_length() {
    assert_shown!(tank("low = 0", "low = 250"), BadScale);
}

#[test]
fn an_end_of_a_scale_is_a_whole_number_of_a_word() {
    assert_shown!(tank("high = 250", "high = 2.5"), BadValue);
    assert_shown!(tank("low = 0", "low = -40000"), OutOfRange);
    let (rules, _) = tank("high = 250", "high = 99999999999999999999");
    assert_eq!(rules, [Rule::OutOfRange]);
}

#[test]
fn a_voltage_is_measured_where_the_converter_reaches() {
    assert_shown!(tank("GP26", "GP22"), ReservedPin);
}

#[test]
fn the_supply_can_be_measured_but_is_no_boolean() {
    let (rules, text) = tank("GP26", "GP29");
    assert_eq!(rules, [], "{text}");
    assert_shown!(tank("GP2\"", "GP29\""), ReservedPin);
}

#[test]
fn a_pin_does_not_measure_and_switch_at_once() {
    assert_shown!(tank("GP16", "GP26"), PinUsedTwice);
}

#[test]
fn an_analogue_input_has_no_active_level() {
    assert_shown!(tank("filter", "active"), UnknownKey);
}

#[test]
fn a_number_without_a_pin_is_told_one_with_its_scale() {
    let unwired = TANK_WIRED.replace("\"%IW0\"", "# \"%IW0\"");
    assert_shown!(shown(&loaded_with(TANK, &unwired)), NotWired);
}

#[test]
fn a_fifth_number_finds_no_pin() {
    let names = ["a", "b", "c", "d"];
    let inputs = (1..=4)
        .zip(names)
        .map(|(word, name)| format!("input {name} : int at %IW{word}\n"));
    let program = TANK.replace("output", &format!("{}output", inputs.collect::<String>()));
    let program = program.replace("> 200", "+ a + b + c + d > 200");
    let (rules, text) = shown(&loaded_with(&program, TANK_WIRED));
    assert_eq!(rules, [Rule::NotWired; 4], "{text}");
    assert_eq!(
        text.matches("no pin left that can be an analogue input")
            .count(),
        2,
        "{text}"
    );
}

#[test]
fn a_bit_for_a_word_is_told_what_is_there() {
    assert_shown!(
        tank("%IW0", "%IX0.1"),
        UnknownKey,
        UnknownKey,
        UnknownAddress,
        NotWired
    );
}

#[test]
fn a_number_leaves_by_no_pin_yet() {
    let program = TANK.replace("VALVE at %QX0.0", "VALVE : int at %QW0");
    let program = program.replace("{ VALVE }", "{ on activation: VALVE = 5 }");
    let plc = TANK_WIRED.replace("%QX0.0", "%QW0");
    assert_shown!(shown(&loaded_with(&program, &plc)), NumberAtPin);
    let (rules, _) = shown(&loaded_with(
        &program,
        plc.split("[outputs]").next().unwrap(),
    ));
    assert_eq!(rules, [Rule::NumberAtPin]);
}
