//! `semantics.md`, phases 2 and 3.

use crate::run::{run, run_scans};

#[test]
fn nothing_fires_in_scan_0() {
    let program = "
        graph G {
            initial step 1
            step 2
            transition 1: 1 -> 2
        }
    ";
    assert_eq!(run_scans(program, 2).column("G"), "1,2");
}

#[test]
fn activation_has_priority_and_is_no_re_activation() {
    let program = "
        input a
        output P
        graph G {
            var n : int = 0
            always { P IF ↑X2 }
            initial step 1
            initial step 2 { on activation: n = n + 1; on deactivation: n = n + 100 }
            step 3
            transition 1: 1 -> 2 when a
            transition 2: 2 -> 3 when a
            transition 3: 2 -> 1 when T/X2/30ms
        }
    ";
    let trace = run(program, &[("a", "0 1 0 0")]);
    assert_eq!(trace.column("G"), "1 2,2 3,2 3,1 3", "timed from scan 0");
    assert_eq!(trace.column("G:n"), "1,1,1,101");
    assert_eq!(trace.column("P"), "1,0,0,0");
}

#[test]
fn an_or_divergence_is_inclusive() {
    let program = "
        input a, b
        graph G {
            initial step 1
            step 2
            step 3
            transition 1: 1 -> 2 when a
            transition 2: 1 -> 3 when b
        }
    ";
    let trace = run(program, &[("a", "0 1 1"), ("b", "0 1 1")]);
    assert_eq!(trace.column("G"), "1,2 3,2 3");
}

#[test]
fn parallel_branches_wait_for_each_other() {
    let program = "
        input a, b, c
        graph G {
            initial step 1
            step 2
            step 3
            step 4
            step 5
            transition 1: 1 -> 2, 3 when a
            transition 2: 3 -> 4 when b
            transition 3: 2, 4 -> 5 when c
        }
    ";
    let trace = run(
        program,
        &[("a", "0 1 0 0 0"), ("b", "0 0 0 1 0"), ("c", "0 0 1 1 1")],
    );
    assert_eq!(trace.column("G"), "1,2 3,2 3,2 4,5");
}

#[test]
fn a_source_transition_is_always_armed_and_a_sink_empties() {
    let program = "
        input a, b
        graph G {
            step 1
            transition 1: -> 1 when ↑a
            transition 2: 1 -> when b
        }
    ";
    let trace = run(program, &[("a", "0 1 1 1 0"), ("b", "0 0 0 1 0")]);
    assert_eq!(trace.column("G"), ",1,1,,");
}

#[test]
fn triggers_see_the_situation_of_the_scan_before() {
    let program = "
        input a
        graph G {
            initial step 1
            step 2
            transition 1: 1 -> 2 when a
        }
        graph H {
            initial step 1
            step 2
            transition 1: 1 -> 2 when G:X2
        }
    ";
    let trace = run(program, &[("a", "0 1 0")]);
    assert_eq!(trace.column("G"), "1,2,2");
    assert_eq!(trace.column("H"), "1,1,2");
}

#[test]
fn triggers_see_momentary_variables_of_the_scan_before() {
    let program = "
        input a
        output M
        graph G {
            always { M IF a }
            initial step 1
            step 2
            transition 1: 1 -> 2 when M
        }
    ";
    assert_eq!(run(program, &[("a", "0 1 0")]).column("G"), "1,1,2");
}

#[test]
fn the_columns_are_graphs_outputs_and_the_rest_globals_first() {
    let program = "
        input a
        var v
        output O
        const c : int = 3
        graph G {
            output P
            parameter p : int = 7
            always { O IF a; P IF a; v IF a AND p > c }
            initial step 1
        }
        graph H { initial step 1 }
    ";
    let trace = run(program, &[("a", "1 0")]);
    assert_eq!(trace.header(), "time_ms,G,H,O,G:P,v,G:p");
    assert_eq!(trace.column("G:p"), "7,7");
}
