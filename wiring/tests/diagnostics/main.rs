//! What a person sees who has miswired a board: every rule, with its line and the mend.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a failed expectation is a failed test"
)]

/// Expects the rules and compares what is shown. Stands before the modules, which use it.
macro_rules! assert_shown {
    ($shown:expr, $($rule:ident),+ $(,)?) => {{
        let (rules, text) = $shown;
        assert_eq!(rules, [$(Rule::$rule),+], "{text}");
        insta::assert_snapshot!(text);
    }};
}

mod addresses;
mod analogue;
mod file;
mod lateness;
mod pins;
mod store;

use std::io;

use wiring::rule::{Diagnostic, Rule};
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

#[test]
fn a_good_file_is_taken() {
    let loaded = loaded_with(PROGRAM, GOOD);
    assert_eq!(loaded.errors(), "");
    assert!(loaded.image.is_some());
}

#[test]
fn a_program_that_is_not_there_is_missed() {
    assert_shown!(changed("saw.grafcet", "graphs/saw.grafcet"), NoApplication);
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
