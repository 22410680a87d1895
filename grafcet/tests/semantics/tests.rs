//! `semantics.md`, "Tests".

use grafcet::testing::{self, Claimed};

use crate::run::application;

const COUNTER: &str = "
    input a, b
    output A, B
    parameter p : int = 5 in 0 .. 9
    graph G {
        var n : int = -1
        always { n = n + 1; A IF a; B IF b }
        initial step 1
        step 2
        transition 1: 1 -> 2 when ↑a AND p > 0
    }
    plant P {
        var held = TRUE
        always { a IF held }
    }
";

/// Runs a test of the counter, whose `n` is the number of the latest scan.
fn run(plants: &str, steps: &str) -> Result<(), Box<testing::Failure>> {
    let application = application(&format!("{COUNTER}\ntest \"it\" {plants} {{\n{steps}\n}}"));
    testing::run(&application, &application.tests[0], |_| {})
}

#[track_caller]
fn passes(steps: &str) {
    if let Err(failure) = run("", steps) {
        panic!("{}\n{}", failure.diagnostic().message, failure.details());
    }
}

#[track_caller]
fn fails(steps: &str, claimed: Claimed, time_ms: u64) {
    let failure = run("", steps).expect_err("a claim that does not hold");
    assert_eq!(failure.claimed, claimed);
    assert_eq!(failure.time_ms, time_ms);
}

#[test]
fn the_first_step_that_needs_a_scan_runs_scan_0_with_what_was_set() {
    passes("set a\n expect A AND n = 0 AND X1\n");
    passes("wait 1 scans\n expect n = 1");
    passes("wait until n = 0 within 0 ms");
    passes("never n <> 0\n");
    passes("set a\n clear a\n expect NOT A AND n = 0");
}

#[test]
fn wait_runs_as_many_scans_as_fit_rounded_up() {
    passes("wait 100 ms\n expect n = 10");
    passes("wait 91 ms\n expect n = 10");
    passes("wait 1 s\n expect n = 100");
    passes("wait 7 scans\n expect n = 7");
}

#[test]
fn a_pulse_sets_runs_and_clears() {
    passes(
        "wait 1 scans\n pulse a for 50 ms\n expect n = 6 AND A AND X2\n wait 1 scans\n expect NOT A",
    );
}

#[test]
fn a_pulse_that_comes_first_lets_scan_0_pass_without_it() {
    passes("never ↑A AND n = 0\n pulse a for 10 ms\n expect n = 1 AND A AND X2");
    passes("pulse a for 10 ms\n expect n = 1 AND X2");
}

#[test]
fn wait_until_looks_first_and_then_after_each_scan() {
    passes("wait 3 scans\n wait until n = 3 within 10 ms\n expect n = 3");
    passes("wait until n = 5 within 50 ms\n expect n = 5");
    fails(
        "wait until n = 6 within 50 ms",
        Claimed::WaitUntil { within_ms: 50 },
        50,
    );
}

#[test]
fn expect_looks_at_the_latest_scan() {
    fails("wait 20 ms\n expect n = 3", Claimed::Expect, 20);
}

#[test]
fn never_and_always_hold_from_there_to_the_end() {
    passes("wait 3 scans\n never n < 3\n always n >= 3\n wait 10 scans");
    fails("never n = 4\n wait 10 scans", Claimed::Never, 40);
    fails("always n < 4\n wait 10 scans", Claimed::Always, 40);
    fails("wait 4 scans\n never n = 4", Claimed::Never, 40);
}

#[test]
fn edges_in_claims_compare_with_the_scan_before() {
    passes(
        "set a\n expect NOT ↑A\n clear a\n wait 1 scans\n expect ↓A\n wait 1 scans\n expect NOT ↓A",
    );
    passes("wait until ↑(n = 4) within 1 s\n expect n = 4");
}

#[test]
fn true_and_1_are_the_same_to_set_on_a_boolean() {
    passes(
        "set a = TRUE, b = 1\n expect A AND B\n set a = FALSE, b = 0\n wait 1 scans\n expect NOT A AND NOT B",
    );
}

#[test]
fn a_parameter_is_set_before_scan_0() {
    passes("set p = 0\n pulse a for 10 ms\n expect X1 AND p = 0");
}

#[test]
fn a_variable_of_a_plant_is_set_before_scan_0_and_later() {
    run(
        "with P",
        "set held = FALSE\n expect NOT A\n set held\n wait 1 scans\n expect A",
    )
    .unwrap();
}

#[test]
fn what_is_set_overrides_the_plant_until_it_is_released() {
    run(
        "with P",
        "expect A\n clear a\n wait 3 scans\n expect NOT A\n release a\n wait 1 scans\n expect A",
    )
    .unwrap();
}

#[test]
fn without_a_plant_a_released_input_keeps_its_value() {
    passes("set a\n expect A\n release a\n wait 3 scans\n expect A");
}

#[test]
fn a_failure_tells_the_values_and_the_last_scans() {
    let failure = run("", "set b\n wait 20 scans\n expect n = 3 OR NOT B").expect_err("it fails");
    assert_eq!(failure.time_ms, 200);
    assert!(
        failure.values.contains(&("B".to_owned(), 1)),
        "{:?}",
        failure.values
    );
    assert!(
        failure.values.contains(&("G:n".to_owned(), 20)),
        "{:?}",
        failure.values
    );
    let details = failure.details();
    let last = details.lines().last().expect("a table");
    let cells: Vec<&str> = last.split_whitespace().collect();
    assert_eq!(cells, ["200", "1", "1", "20"], "{details}");
}
