//! Whatever stands in a `plc.toml`: an answer, never a panic, and no image from a file with errors.

#![allow(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use proptest::prelude::*;
use wiring::load_from;

const PROGRAM: &str = "\
input  start at %IX0.0
input  level : int at %IW0
output MOTOR at %QX0.0
graph Saw {
    initial step 1
    step 2 { MOTOR }
    transition 1: 1 -> 2 when start
    transition 2: 2 -> 1 when level > 5
}
";

const GOOD: &str = r#"application = "säge.grafcet"
board = "pico"
[inputs]
"%IX0.0" = { pin = "GP3", pull = "up", active = "low", filter = "5 ms" }
"%IW0" = { pin = "GP27", low = -20, high = 400 }
[outputs]
"%QX0.0" = "GP16"
[retain]
sectors = 4
[watchdog]
timeout = "1 s"
"#;

/// Loads the file; an image and errors exclude each other.
fn answered(plc: &str) -> bool {
    let read = |path: &str| Ok(if path == "plc.toml" { plc } else { PROGRAM }.to_owned());
    let loaded = load_from("plc.toml", &read).unwrap();
    assert_eq!(loaded.image.is_some(), loaded.errors().is_empty(), "{plc}");
    loaded.image.is_some()
}

#[test]
fn the_file_is_good_as_it_stands() {
    assert!(answered(GOOD));
}

proptest! {
    #[test]
    fn a_damaged_file_is_answered(at in 0..GOOD.len(), cut in 0..20_usize, put in "[\\[\\]\"=#{},.%\\n0-9a-zé ]{0,6}") {
        let start = GOOD.floor_char_boundary(at);
        let end = GOOD.ceil_char_boundary((at + cut).min(GOOD.len()));
        let mut damaged = GOOD.to_owned();
        damaged.replace_range(start..end, &put);
        answered(&damaged);
    }

    #[test]
    fn noise_is_answered(noise in "\\PC{0,200}") {
        prop_assert!(!answered(&noise));
    }
}

#[test]
fn deep_nesting_is_answered() {
    let nested = format!("a = {}{}", "[".repeat(100_000), "]".repeat(100_000));
    assert!(!answered(&nested));
    let tables = format!("{}b = 1", "a.".repeat(100_000));
    assert!(!answered(&tables));
}
