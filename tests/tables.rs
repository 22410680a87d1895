//! What the build put into the image is what the compiler makes of the sources.

#![allow(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use plc::application::{
    ANALOGUE_INPUTS, INPUTS, NAMES, OUTPUTS, OVERLOAD, PROGRAM, RETAIN, Storage, WATCHDOG_MS,
};
use wiring::Loaded;

/// The sources of this very image.
fn loaded() -> Loaded {
    wiring::load(option_env!("PLC").unwrap_or("plc.toml")).unwrap()
}

#[test]
fn the_tables_are_those_of_the_compiler() {
    let (application, _) = loaded().image.unwrap();
    assert_eq!(PROGRAM, application.controller.tables.program());
    assert!(Storage::is_sized_for(&PROGRAM));
}

#[test]
fn the_names_are_those_of_the_program() {
    let (application, _) = loaded().image.unwrap();
    let symbols = &application.controller.symbols;
    assert_eq!(NAMES.application, application.name);
    let graphs: Vec<_> = symbols.graphs.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(NAMES.graphs, graphs);
    assert_eq!(NAMES.steps.len(), PROGRAM.steps.len());
    assert_eq!(NAMES.transitions.len(), PROGRAM.transitions.len());
    assert_eq!(NAMES.retained.len(), PROGRAM.retained.len());
}

#[test]
fn the_wires_are_those_of_the_file() {
    let (_, wiring) = loaded().image.unwrap();
    let inputs = wiring
        .inputs
        .iter()
        .map(|it| (it.place, it.address.to_string(), it.entry.filter_ms));
    let built = INPUTS
        .iter()
        .map(|it| (it.bit, it.address.to_owned(), it.filter_ms));
    assert!(inputs.eq(built));
    let numbers = wiring.analogue_inputs.iter();
    let numbers = numbers.map(|it| (it.place, it.address.to_string(), it.entry.filter_ms));
    let built = ANALOGUE_INPUTS
        .iter()
        .map(|it| (it.number, it.address.to_owned(), it.filter_ms));
    assert!(numbers.eq(built));
    let outputs = wiring
        .outputs
        .iter()
        .map(|it| (it.place, it.address.to_string(), it.entry.safe));
    let built = OUTPUTS
        .iter()
        .map(|it| (it.bit, it.address.to_owned(), it.safe));
    assert!(outputs.eq(built));
    assert_eq!((RETAIN, WATCHDOG_MS), (wiring.retain, wiring.watchdog_ms));
    assert_eq!(OVERLOAD.overruns, wiring.overload.overruns);
    let stops = [
        OVERLOAD.policy == plc::wiring::Policy::SafeStop,
        wiring.overload.policy == wiring::file::Policy::SafeStop,
    ];
    assert_eq!(stops[0], stops[1]);
}
