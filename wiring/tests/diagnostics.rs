//! What a person sees who has miswired a board: every rule, with its line and the mend.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a failed expectation is a failed test"
)]

use std::io;

use wiring::file::{Overload, Policy};
use wiring::rule::{Diagnostic, Rule};
use wiring::wire::AnalogueInput;
use wiring::{Loaded, load_from};

const PROGRAM: &str = "\
application saw

input  start at %IX0.0
input  stop  at %IX0.1
output MOTOR at %QX0.0

graph Saw {
    initial step 1
    step 2 { MOTOR }
    transition 1: 1 -> 2 when ↑start AND NOT stop
    transition 2: 2 -> 1 when stop
}
";

const GOOD: &str = r#"application = "saw.grafcet"
board = "pico"

[inputs]
"%IX0.0" = "GP2"
"%IX0.1" = { pin = "GP3", pull = "up", active = "low", filter = "5 ms" }

[outputs]
"%QX0.0" = { pin = "GP16", safe = "off" }

[retain]
sectors = 4

[watchdog]
timeout = "1 s"
"#;

/// Loads a `plc.toml` beside a program.
fn loaded_with(program: &str, plc: &str) -> Loaded {
    let read = |path: &str| match path {
        "plc.toml" => Ok(plc.to_owned()),
        "saw.grafcet" => Ok(program.to_owned()),
        _ => Err(io::ErrorKind::NotFound.into()),
    };
    load_from("plc.toml", &read).unwrap()
}

/// The good file with a change, and the rules that are broken by it.
fn changed(from: &str, to: &str) -> (Vec<Rule>, String) {
    assert!(GOOD.contains(from), "{from}");
    shown(&loaded_with(PROGRAM, &GOOD.replacen(from, to, 1)))
}

fn shown(loaded: &Loaded) -> (Vec<Rule>, String) {
    assert!(loaded.wiring.is_empty() || loaded.image.is_none());
    let rules = loaded
        .wiring
        .iter()
        .map(|it: &Diagnostic| it.rule)
        .collect();
    (rules, loaded.errors())
}

/// Expects the rules and compares what is shown.
macro_rules! assert_shown {
    ($shown:expr, $($rule:ident),+ $(,)?) => {{
        let (rules, text) = $shown;
        assert_eq!(rules, [$(Rule::$rule),+], "{text}");
        insta::assert_snapshot!(text);
    }};
}

#[test]
fn a_good_file_is_taken() {
    let loaded = loaded_with(PROGRAM, GOOD);
    assert_eq!(loaded.errors(), "");
    assert!(loaded.image.is_some());
}

#[test]
fn a_key_without_meaning_is_unknown() {
    assert_shown!(changed("pull =", "pul ="), UnknownKey);
}

#[test]
fn an_unknown_table_is_told_the_known_ones() {
    assert_shown!(changed("[retain]", "[flash]"), UnknownKey);
}

#[test]
fn a_file_has_to_name_program_and_board() {
    let nothing = loaded_with(PROGRAM, "");
    assert_shown!(shown(&nothing), MissingKey, MissingKey);
}

#[test]
fn an_input_has_to_have_a_pin() {
    assert_shown!(changed("pin = \"GP3\", ", ""), MissingKey);
}

#[test]
fn a_pull_is_one_of_three_words() {
    assert_shown!(changed("\"up\"", "\"upp\""), BadValue);
}

#[test]
fn a_filter_is_a_text() {
    assert_shown!(changed("\"5 ms\"", "5"), BadValue);
}

#[test]
fn an_input_is_no_number() {
    assert_shown!(changed("\"GP2\"", "2"), BadValue);
}

#[test]
fn a_duration_has_a_unit() {
    assert_shown!(changed("5 ms", "5 msec"), BadDuration);
}

#[test]
fn a_filter_lasts_a_second_at_most() {
    assert_shown!(changed("5 ms", "1001 ms"), OutOfRange);
}

#[test]
fn the_retain_area_has_four_sectors_at_least() {
    assert_shown!(changed("sectors = 4", "sectors = 3"), OutOfRange);
    let (rules, _) = changed("sectors = 4", "sectors = 66");
    assert_eq!(rules, [Rule::OutOfRange]);
    assert_eq!(changed("sectors = 4", "sectors = 5").0, []);
}

#[test]
fn a_quiet_moment_is_an_output_or_in_memory() {
    assert_shown!(
        changed("sectors = 4", "quiet = \"%IX0.0\""),
        AddressDirection
    );
    let (rules, _) = changed("sectors = 4", "quiet = \"%QW0\"");
    assert_eq!(rules, [Rule::AddressDirection]);
    assert_eq!(changed("sectors = 4", "quiet = \"%QX0.0\"").0, []);
}

#[test]
fn the_ends_of_the_store_have_addresses_of_the_program() {
    assert_shown!(changed("sectors = 4", "quiet = \"%QX1.0\""), UnknownAddress);
    assert_shown!(changed("sectors = 4", "alarm = \"%IX1.0\""), UnknownAddress);
    let (rules, _) = changed("sectors = 4", "quiet = \"quiet\"");
    assert_eq!(rules, [Rule::BadAddress]);
}

#[test]
fn the_alarm_of_the_store_has_no_pin() {
    assert_shown!(
        changed("sectors = 4", "alarm = \"%IX0.1\""),
        DuplicateAddress
    );
    let (rules, _) = changed("sectors = 4", "alarm = \"%QX0.0\"");
    assert_eq!(rules, [Rule::AddressDirection]);
}

#[test]
fn what_is_wired_to_the_store_needs_no_pin() {
    let program = PROGRAM.replace(
        "graph Saw",
        "input low at %IX1.0\noutput CALM at %QX1.0\n\ngraph Saw",
    );
    let program = program.replace("initial step 1", "initial step 1 { CALM IF NOT low }");
    let plc = GOOD.replace("sectors = 4", "quiet = \"%QX1.0\"\nalarm = \"%IX1.0\"");
    let loaded = loaded_with(&program, &plc);
    let errors = loaded.errors();
    let (_, wiring) = loaded.image.expect(&errors);
    assert!(wiring.store.quiet.is_some() && wiring.store.alarm.is_some());
    assert_eq!((wiring.inputs.len(), wiring.outputs.len()), (2, 1));
    let unwired = loaded_with(&program, GOOD).errors();
    assert!(unwired.contains("has no pin"), "{unwired}");
}

#[test]
fn the_watchdog_bears_a_scan_and_an_erase() {
    assert_shown!(changed("1 s", "400 ms"), OutOfRange);
}

#[test]
fn the_watchdog_waits_no_longer_than_it_can() {
    assert_shown!(changed("1 s", "9 s"), OutOfRange);
}

#[test]
fn a_scan_is_shorter_than_the_watchdog_can_wait() {
    let slow = PROGRAM.replace("application saw", "application saw\nscan 9 s");
    let unset = GOOD.replace("[watchdog]\ntimeout = \"1 s\"\n", "");
    assert_shown!(shown(&loaded_with(&slow, &unset)), OutOfRange);
}

#[test]
fn the_watchdog_follows_a_slow_scan_by_itself() {
    let slow = PROGRAM.replace("application saw", "application saw\nscan 2 s");
    let unset = GOOD.replace("[watchdog]\ntimeout = \"1 s\"\n", "");
    let (_, wiring) = loaded_with(&slow, &unset).image.unwrap();
    assert_eq!(wiring.watchdog_ms, 2400);
}

#[test]
fn an_overload_is_an_overrun_in_ten_scans_and_stops_unless_the_file_says_otherwise() {
    let overload = |table: &str| {
        let loaded = loaded_with(PROGRAM, &format!("{GOOD}{table}"));
        let (_, wiring) = loaded.image.expect("the file is good");
        wiring.overload
    };
    let (stop, go_on) = (Policy::SafeStop, Policy::KeepRunning);
    let cases = [
        ("", stop, 10),
        ("[overload]\n", stop, 10),
        ("[overload]\noverruns = 1\n", stop, 1),
        ("[overload]\npolicy = \"keep-running\"\n", go_on, 10),
        (
            "[overload]\npolicy = \"safe-stop\"\noverruns = 100\n",
            stop,
            100,
        ),
    ];
    for (table, policy, overruns) in cases {
        assert_eq!(overload(table), Overload { policy, overruns }, "{table}");
    }
}

#[test]
fn a_policy_for_overload_is_one_of_two_words() {
    assert_shown!(
        changed(
            "[watchdog]",
            "[overload]\npolicy = \"keep-runing\"\n\n[watchdog]"
        ),
        BadValue
    );
    assert_shown!(
        changed("[watchdog]", "[overload]\npolicy = true\n\n[watchdog]"),
        BadValue
    );
}

#[test]
fn an_overload_is_counted_among_a_hundred_scans() {
    for wrong in ["0", "101", "-1"] {
        let table = format!("[overload]\noverruns = {wrong}\n\n[watchdog]");
        let (rules, text) = changed("[watchdog]", &table);
        assert_eq!(rules, [Rule::OutOfRange], "{text}");
    }
    assert_shown!(
        changed("[watchdog]", "[overload]\noverruns = 101\n\n[watchdog]"),
        OutOfRange
    );
    assert_shown!(
        changed("[watchdog]", "[overload]\noverruns = \"10\"\n\n[watchdog]"),
        BadValue
    );
}

#[test]
fn an_overload_is_spelled_as_it_is() {
    assert_shown!(
        changed(
            "[watchdog]",
            "[overlaod]\npolicy = \"safe-stop\"\n\n[watchdog]"
        ),
        UnknownKey
    );
    assert_shown!(
        changed("[watchdog]", "[overload]\noverrun = 3\n\n[watchdog]"),
        UnknownKey
    );
    assert_shown!(
        changed("board =", "overload = \"safe-stop\"\nboard ="),
        BadValue
    );
}

#[test]
fn a_program_that_is_not_there_is_missed() {
    assert_shown!(changed("saw.grafcet", "graphs/saw.grafcet"), NoApplication);
}

#[test]
fn an_unknown_board_is_told_its_nearest() {
    assert_shown!(changed("\"pico\"", "\"picoo\""), UnknownBoard);
}

#[test]
fn a_board_of_another_kind_is_told_what_there_is() {
    assert_shown!(changed("\"pico\"", "\"esp32\""), UnknownBoard);
}

#[test]
fn a_pin_is_called_as_on_the_board() {
    assert_shown!(changed("\"GP2\"", "\"PIN_2\""), UnknownPin);
}

#[test]
fn a_pin_that_the_board_needs_is_refused_with_the_reason() {
    assert_shown!(changed("GP2", "GP23"), ReservedPin);
}

#[test]
fn the_led_is_no_input() {
    assert_shown!(changed("GP2", "GP25"), ReservedPin);
    let (rules, text) = changed("GP16", "GP25");
    assert_eq!(rules, [], "{text}");
}

#[test]
fn a_pin_serves_one_address() {
    assert_shown!(changed("GP16", "GP3"), PinUsedTwice);
}

#[test]
fn a_key_has_to_be_an_address() {
    assert_shown!(changed("\"%IX0.0\"", "\"start\""), BadAddress, NotWired);
}

#[test]
fn two_spellings_of_an_address_are_one() {
    assert_shown!(
        changed("[outputs]", "\"%I0.1\" = \"GP4\"\n\n[outputs]"),
        DuplicateAddress
    );
}

#[test]
fn a_key_twice_shows_both() {
    assert_shown!(
        changed("[outputs]", "\"%IX0.0\" = \"GP4\"\n\n[outputs]"),
        Toml
    );
}

#[test]
fn an_output_is_no_input() {
    assert_shown!(
        changed("[outputs]", "\"%QX0.1\" = \"GP4\"\n\n[outputs]"),
        AddressDirection
    );
}

#[test]
fn memory_is_on_no_pin() {
    assert_shown!(
        changed("[outputs]", "\"%MX0.1\" = \"GP4\"\n\n[outputs]"),
        AddressDirection
    );
}

#[test]
fn an_address_that_the_program_does_not_use_is_refused() {
    assert_shown!(
        changed("[outputs]", "\"%IX0.2\" = \"GP4\"\n\n[outputs]"),
        UnknownAddress
    );
}

#[test]
fn a_mistyped_address_is_told_which_was_meant() {
    assert_shown!(changed("%IX0.1", "%IX1.0"), UnknownAddress, NotWired);
}

#[test]
fn every_input_and_output_of_the_program_needs_a_pin() {
    let unwired = loaded_with(
        PROGRAM,
        "application = \"saw.grafcet\"\nboard = \"pico\"\n[inputs]\n",
    );
    assert_shown!(shown(&unwired), NotWired, NotWired, NotWired);
}

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

#[test]
fn more_retained_values_than_a_record_takes_are_refused() {
    let names = (0..450).map(|index| format!("parameter P{index} : int = 1\n"));
    let reads = (0..450)
        .map(|index| format!("P{index} > 5"))
        .collect::<Vec<_>>();
    let program = PROGRAM.replace("\ngraph", &format!("{}\ngraph", names.collect::<String>()));
    let program = program.replace("when stop", &format!("when stop OR {}", reads.join(" OR ")));
    assert_shown!(shown(&loaded_with(&program, GOOD)), RetainTooBig);
}

#[test]
fn an_address_needs_its_quotes() {
    assert_shown!(changed("\"%IX0.0\"", "%IX0.0"), Toml);
}

#[test]
fn what_is_no_toml_is_told_once_a_line() {
    assert_shown!(changed("board = \"pico\"", "board = pico"), Toml);
}

#[test]
fn a_value_in_place_of_a_table_is_refused() {
    assert_shown!(
        shown(&loaded_with(
            PROGRAM,
            &format!("watchdog = 5\n{}", GOOD.split("[watchdog]").next().unwrap())
        )),
        BadValue
    );
}

#[test]
fn everything_wrong_is_told_in_one_run() {
    let plc = r#"application = "saw.grafcet"
board = "pico"
colour = "grey"

[inputs]
"%IX0.0" = { pin = "GP99", filter = "soon" }
"%IX0.1" = { pin = "GP3", active = "up" }
"%IX0.2" = "GP3"

[retain]
sectors = 100
"#;
    assert_shown!(
        shown(&loaded_with(PROGRAM, plc)),
        UnknownKey,
        BadDuration,
        BadValue,
        OutOfRange,
        UnknownPin,
        PinUsedTwice,
        UnknownAddress,
        NotWired,
    );
}

#[test]
fn a_program_with_errors_does_not_hide_those_of_the_wiring() {
    let program = PROGRAM.replace("when stop", "when stopp");
    let loaded = loaded_with(&program, &GOOD.replace("GP2", "GP32"));
    let text = loaded.errors();
    assert!(text.contains("error[unknown-pin]"), "{text}");
    assert!(text.contains("error[unknown-name]"), "{text}");
    assert!(loaded.image.is_none());
}
