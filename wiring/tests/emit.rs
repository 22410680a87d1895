//! The wiring as Rust source and linker script.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a failed expectation is a failed test"
)]

use grafcet_compiler::application::Application;
use grafcet_compiler::emit::source;
use wiring::{Wiring, emit, load_from};

const PROGRAM: &str = "\
input  start at %IX0.0
input  stop  at %IX0.1
input  level at %IX0.2
input  depth : int at %IW0
input  angle : int at %IW1 in -400 .. 400
output MOTOR at %QX0.0
output BRAKE at %QX0.1
output VALVE at %QX0.2
output HORN  at %QX0.3

graph Saw {
    initial step 1 { BRAKE; VALVE }
    step 2 { MOTOR; HORN IF level }
    transition 1: 1 -> 2 when ↑start AND NOT stop
    transition 2: 2 -> 1 when stop OR depth > angle
}
";

const PLC: &str = r#"application = "saw.grafcet"
board = "pico"
[inputs]
"%IX0.1" = { pin = "GP3", active = "low", filter = "5 ms" }
"%IX0.0" = "GP2"
"%IW1" = { pin = "GP28", low = 200, high = -200, filter = "20 ms" }
"%IX0.2" = { pin = "GP26", pull = "none", filter = "1 s" }
"%IW0" = "GP27"
[outputs]
"%QX0.0" = { pin = "GP16", active = "high", safe = "off" }
"%QX0.1" = { pin = "GP17", active = "high", safe = "on" }
"%QX0.2" = { pin = "GP18", active = "low", safe = "off" }
"%QX0.3" = { pin = "GP25", active = "low", safe = "on" }
[retain]
sectors = 6
"#;

fn wiring() -> Wiring {
    loaded().1
}

fn loaded() -> (Application, Wiring) {
    let read = |path: &str| Ok(if path == "plc.toml" { PLC } else { PROGRAM }.to_owned());
    let loaded = load_from("plc.toml", &read).unwrap();
    let errors = loaded.errors();
    loaded.image.expect(&errors)
}

#[test]
fn the_tables_are_in_the_order_of_the_file() {
    insta::assert_snapshot!(source(emit::tables(&wiring())).unwrap());
}

#[test]
fn pins_are_in_the_order_of_the_tables_and_outputs_begin_safe() {
    insta::assert_snapshot!(source(emit::board_pins(&wiring())).unwrap());
}

#[test]
fn a_host_is_told_what_the_terminals_are_called() {
    let (application, wiring) = loaded();
    insta::assert_snapshot!(source(emit::labels(&wiring, &application)).unwrap());
}

#[test]
fn the_linker_leaves_the_retain_area_alone() {
    let wiring = wiring();
    assert_eq!(wiring.retain, 2 * 1024 * 1024 - 6 * 4096..2 * 1024 * 1024);
    assert_eq!(emit::retain_script(&wiring), "RETAIN_LENGTH = 24576;\n");
}
