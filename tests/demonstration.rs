//! The soft PLC plays the demonstration of the line switcher, power cycle included.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

use std::path::Path;

use plc::application::{
    ANALOGUE_INPUTS, ANALOGUE_LABELS, DEMONSTRATION, INPUTS, OUTPUTS, PLANTS, PROGRAM,
};
use plc::boards::host::clock::simulate;
use plc::boards::host::lines::{Line, keep};
use plc::boards::host::machine::{Machine, Parts};
use plc::boards::host::script::Outcome;
use plc::boards::host::soft_plc;

fn machine() -> Machine {
    Machine::new(Parts {
        period_ms: PROGRAM.period_ms,
        inputs: &INPUTS,
        analogue: &ANALOGUE_INPUTS,
        analogue_labels: &ANALOGUE_LABELS,
        outputs: &OUTPUTS,
        plants: &PLANTS,
        script: DEMONSTRATION.as_ref(),
    })
}

fn played(retain: &Path) -> (Outcome, Vec<Line>) {
    let (outcome, lines) = keep(|| {
        simulate(soft_plc::run(machine(), retain)).expect("a PLC always waits for its next scan")
    });
    (outcome.expect("the file can be made"), lines)
}

/// The lines, in the order given, each with its time in ms.
fn times(lines: &[Line], wanted: &[&str]) -> Vec<u64> {
    let mut rest = lines.iter();
    let mut find = |text: &&str| {
        let line = rest.find(|line| line.text.trim() == *text);
        line.unwrap_or_else(|| panic!("`{text}` is missing, or comes too early"))
            .time_ms
    };
    wanted.iter().map(&mut find).collect()
}

#[test]
fn it_switches_over_locks_survives_the_power_cycle_and_unlocks() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (outcome, lines) = played(&folder.path().join("retained"));
    assert_eq!(outcome, Outcome::Held);
    let times = times(
        &lines,
        &[
            "LineSwitcher starts in {1}",
            "LineSwitcher T1: {1} -> {2}",
            "LineSwitcher T3: {2} -> {3}",
            "LineSwitcher T7: {3} -> {5}",
            "outputs  BL10 = 1",
            "LineSwitcher T8: {5} -> {7}",
            "LineSwitcher T10: {7} -> {2}",
            "LineSwitcher T16: {4} -> {6}",
            "LineSwitcher T18: {6} -> {11}",
            "-- Power fails.",
            "LineSwitcher starts in {1}",
            "LineSwitcher T24: {1} -> {11}",
            "-- The operator unlocks.",
            "LineSwitcher T23: {11} -> {2}",
            "LineSwitcher T19: {8} -> {2}",
        ],
    );
    assert_eq!(times[3] - times[2], 2_000, "TD after the loss of line 1");
    assert_eq!(
        times[8] - times[7],
        1_000,
        "TA after the command that was not obeyed"
    );
    assert_eq!(times[11] - times[10], 10, "locked again in the second scan");
    let restored: Vec<&str> = lines
        .iter()
        .filter_map(|line| line.text.split_once("restored: "))
        .map(|(_, restored)| restored)
        .collect();
    assert_eq!(
        restored,
        ["0 of 4 retained values", "4 of 4 retained values"]
    );
}

#[test]
fn it_is_the_same_to_the_millisecond_every_time() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let first = played(&folder.path().join("first"));
    assert_eq!(first, played(&folder.path().join("second")));
}

#[test]
fn what_the_file_retains_is_there_the_next_time() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("retained");
    played(&file);
    let (_, lines) = played(&file);
    assert!(
        lines
            .iter()
            .any(|line| line.text.ends_with("restored: 4 of 4 retained values"))
    );
    assert!(
        lines
            .iter()
            .all(|line| !line.text.ends_with("restored: 0 of 4 retained values"))
    );
}

#[test]
fn a_file_that_cannot_be_made_is_an_error() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("missing/retained");
    let ended = simulate(soft_plc::run(machine(), &file)).expect("it ends at once");
    assert!(ended.is_err());
}
