//! What the log says of a scan: one line for each change of a situation and for each fault counted.

mod support;

use grafcet_core::program::Slot;
use plc::boards::host::lines::keep;
use plc::log::Observer;
use support::program::{Leaked, program};

/// Runs scans of 10 ms, each after setting inputs, and keeps what each says.
fn said(what: Leaked, scans: &[&[(&str, bool)]]) -> Vec<Vec<String>> {
    let mut engine = what.engine();
    let mut observer = Observer::new(what.names);
    let mut scan = |(k, inputs): (usize, &&[(&str, bool)])| {
        for (name, value) in inputs.iter() {
            if let Slot::Bit(bit) = what.slot(name) {
                engine.set_input(bit, *value);
            }
        }
        match k {
            0 => engine.start(),
            _ => {
                engine.scan(k as u64 * 10);
            }
        }
        let ((), lines) = keep(|| observer.observe(&engine));
        lines.into_iter().map(|line| line.text).collect()
    };
    scans.iter().enumerate().map(&mut scan).collect()
}

#[test]
fn transitions_are_named_with_the_steps_they_leave_and_enter() {
    let parallel = program(
        "input a, b, c
         graph Fork {
             initial step 1; step 2; step 3; step 4
             transition 1: 1 -> 2, 3 when a
             transition 2: 2 -> 4 when b
             transition 3: 3 -> 2 when b
             transition 4: 2, 4 -> 1 when c
             transition 5: -> 3 when ↑c
         }",
    );
    let lines = said(
        parallel,
        &[&[], &[("a", true)], &[("b", true)], &[("c", true)], &[]],
    );
    assert_eq!(lines[0], ["Fork starts in {1}"]);
    assert_eq!(lines[1], ["Fork T1: {1} -> {2, 3}"]);
    assert_eq!(lines[2], ["Fork T2: {2} -> {4}", "Fork T3: {3} -> {2}"]);
    assert_eq!(
        lines[3][..2],
        ["Fork T2: {2} -> {4}", "Fork T4: {2, 4} -> {1}"]
    );
    assert_eq!(lines[3][2], "Fork T5: {} -> {3}");
}

#[test]
fn a_scan_that_changes_nothing_says_nothing() {
    let ring = program("input a; graph G { initial step 1; transition 1: 1 -> 1 when a }");
    assert_eq!(
        said(ring, &[&[("a", true)], &[], &[]])[1..],
        [vec![] as Vec<String>, vec![]]
    );
}

#[test]
fn a_forced_change_is_called_forced_with_both_situations() {
    let drill = program(
        "input stop, go
         graph Emergency { initial step 1; step 2 { F/Work:{} }
             transition 1: 1 -> 2 when stop
             transition 2: 2 -> 1 when NOT stop }
         graph Work { initial step 1; initial step 2; step 3
             transition 1: 1, 2 -> 3 when go }",
    );
    let lines = said(drill, &[&[], &[("stop", true)]]);
    assert_eq!(
        lines[0],
        ["Emergency starts in {1}", "Work starts in {1, 2}"]
    );
    assert_eq!(
        lines[1],
        ["Emergency T1: {1} -> {2}", "Work forced: {1, 2} -> {}"]
    );
}

#[test]
fn a_graph_that_its_enclosing_step_starts_and_ends_is_called_enclosed() {
    let cell = program(
        "input go
         graph Line { initial step 1; step 2 encloses Cell {3}
             transition 1: 1 -> 2 when go
             transition 2: 2 -> 1 when NOT go }
         graph Cell { step 3; step 4; transition 1: 3 -> 4 when go }",
    );
    let lines = said(cell, &[&[], &[("go", true)], &[], &[("go", false)]]);
    assert_eq!(lines[0], ["Line starts in {1}"]);
    assert_eq!(
        lines[1],
        ["Line T1: {1} -> {2}", "Cell enclosed: {} -> {3}"]
    );
    assert_eq!(lines[2], ["Cell T1: {3} -> {4}"]);
    assert_eq!(
        lines[3],
        ["Line T2: {2} -> {1}", "Cell enclosed: {4} -> {}"]
    );
}

#[test]
fn arithmetic_faults_are_counted_in_the_log() {
    let divide = program(
        "var n : int = 1; var zero : int = 0
         graph G { initial step 1 { n = n / zero }; step 2; transition 1: 1 -> 2 when T/X1/20ms }",
    );
    let lines = said(divide, &[&[], &[], &[], &[]]);
    assert_eq!(
        lines[0],
        ["G starts in {1}", "arithmetic fault (1 since start)"]
    );
    assert_eq!(lines[1], ["arithmetic fault (2 since start)"]);
    assert_eq!(lines[3], Vec::<String>::new());
}

#[test]
fn an_unstable_scan_is_reported_when_it_begins() {
    let ring = program(
        "evolution stable
         input a
         graph G { initial step 1; step 2
             transition 1: 1 -> 2 when a
             transition 2: 2 -> 1 when a }",
    );
    let lines = said(
        ring,
        &[&[], &[("a", true)], &[], &[("a", false)], &[("a", true)]],
    );
    let unstable = |lines: &[String]| lines.iter().any(|line| line.starts_with("unstable"));
    let told: Vec<bool> = lines.iter().map(|lines| unstable(lines)).collect();
    assert_eq!(told, [false, true, false, false, true]);
}
