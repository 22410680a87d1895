//! `semantics.md`, "Edges" and scan 0.

use crate::run::{run, run_scans};

#[test]
fn a_held_button_is_no_edge() {
    let program = "
        input a
        graph G {
            initial step 1
            step 2
            transition 1: 1 -> 2 when ↑a
        }
    ";
    assert_eq!(run(program, &[("a", "1 1 1 1")]).column("G"), "1,1,1,1");
    assert_eq!(run(program, &[("a", "1 0 1 1")]).column("G"), "1,1,2,2");
}

#[test]
fn a_released_button_is_no_falling_edge_at_start() {
    let program = "
        input a
        graph G {
            initial step 1
            step 2
            transition 1: 1 -> 2 when ↓a
        }
    ";
    assert_eq!(run(program, &[("a", "0 0 0")]).column("G"), "1,1,1");
    assert_eq!(run(program, &[("a", "1 0 0")]).column("G"), "1,2,2");
}

#[test]
fn an_edge_passes_while_its_transition_is_not_armed() {
    let program = "
        input a, b
        graph G {
            initial step 1
            step 2
            step 3
            transition 1: 1 -> 2 when b
            transition 2: 2 -> 3 when ↑a
        }
    ";
    let trace = run(program, &[("a", "0 1 1 0 1"), ("b", "0 1 0 0 0")]);
    assert_eq!(trace.column("G"), "1,2,2,2,3");
}

#[test]
fn the_edge_of_an_expression_is_that_of_its_value() {
    let program = "
        input a, b
        output P
        graph G {
            always { P IF ↑(a AND b) }
        }
    ";
    let trace = run(program, &[("a", "0 1 1 0 1"), ("b", "1 1 0 1 1")]);
    assert_eq!(trace.column("P"), "0,1,0,0,1");
}

#[test]
fn the_edge_of_a_step_acts_at_once_and_triggers_a_scan_later() {
    let program = "
        input go
        output P
        graph G {
            always { P IF ↑X3 }
            initial step 1
            step 3
            transition 1: 1 -> 3 when go
        }
        graph H {
            initial step 10
            step 11
            transition 1: 10 -> 11 when ↑G:X3
        }
    ";
    let trace = run(program, &[("go", "0 1 1 1")]);
    assert_eq!(trace.column("G"), "1,3,3,3");
    assert_eq!(trace.column("P"), "0,1,0,0");
    assert_eq!(trace.column("H"), "10,10,11,11");
}

#[test]
fn an_initial_step_rises_in_scan_0_for_actions() {
    let program = "
        input a
        output P, Q, R
        graph G {
            always {
                P IF ↑X1
                Q IF ↑(X1 AND NOT X2)
                R IF ↑a
            }
            initial step 1
            step 2
            transition 1: 1 -> 2 when False AND a
        }
    ";
    let trace = run(program, &[("a", "1 1")]);
    assert_eq!(trace.column("P"), "1,0", "a step standing alone");
    assert_eq!(trace.column("Q"), "0,0", "an expression with steps");
    assert_eq!(trace.column("R"), "0,0", "an input");
}

#[test]
fn an_initial_step_is_no_edge_for_triggers() {
    let program = "
        graph G {
            initial step 1
            step 2
            transition 1: 1 -> 2 when ↑X1
        }
    ";
    assert_eq!(run_scans(program, 4).column("G"), "1,1,1,1");
}

#[test]
fn edges_in_triggers_are_primed_before_the_actions_of_scan_0() {
    let program = "
        var M
        graph G {
            initial step 1 { M }
            step 2
            transition 1: 1 -> 2 when ↑M
        }
    ";
    assert_eq!(run_scans(program, 3).column("G"), "1,2,2");
}

#[test]
fn the_edge_in_an_action_is_followed_while_the_action_sleeps() {
    let program = "
        input a, go
        output P
        graph G {
            initial step 1
            step 2 { P IF ↑a }
            transition 1: 1 -> 2 when go
        }
    ";
    let trace = run(program, &[("a", "0 1 1 0 1"), ("go", "0 0 1 0 0")]);
    assert_eq!(trace.column("G"), "1,1,2,2,2");
    assert_eq!(trace.column("P"), "0,0,0,0,1");
}

#[test]
fn edges_in_actions_are_taken_before_the_stored_statements() {
    let program = "
        var n : int = 0
        output P
        graph G {
            always {
                n = n + 1
                P IF ↑(n = 3)
            }
        }
    ";
    let trace = run_scans(program, 5);
    assert_eq!(trace.column("n"), "1,2,3,4,5");
    assert_eq!(trace.column("P"), "0,0,0,1,0");
}

#[test]
fn an_edge_of_a_momentary_variable_comes_a_scan_later() {
    let program = "
        input a
        var M
        output P
        graph G {
            always {
                M IF a
                P IF ↑M
            }
        }
    ";
    let trace = run(program, &[("a", "0 1 1 1")]);
    assert_eq!(trace.column("M"), "0,1,1,1");
    assert_eq!(trace.column("P"), "0,0,1,0");
}
