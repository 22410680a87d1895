//! `semantics.md`, phases 5 to 7.

use crate::run::{run, run_scans};

#[test]
fn stored_statements_run_in_the_order_of_phase_6() {
    let program = "
        input go
        var log : int = 0
        graph G {
            always { log = log * 10 + 5 IF ↑go }
            initial step 1 {
                on deactivation: log = log * 10 + 3
                on event ↑go: log = log * 10 + 2
            }
            step 2 {
                log = log * 10 + 6 IF ↑go
                on activation: log = log * 10 + 4
            }
            transition 1: 1 -> 2 when go do { log = log * 10 + 1 }
        }
    ";
    let trace = run(program, &[("go", "0 1 1")]);
    assert_eq!(trace.column("log"), "0,123456,123456");
}

#[test]
fn an_edge_counts_in_the_step_it_activates_and_an_event_in_the_step_it_leaves() {
    let program = "
        input start
        graph G {
            var left : int = 0
            var entered : int = 0
            var left_event : int = 0
            var entered_event : int = 0
            initial step 1 {
                left = left + 1 IF ↑start
                on event ↑start: left_event = left_event + 1
            }
            step 2 {
                entered = entered + 1 IF ↑start
                on event ↑start: entered_event = entered_event + 1
            }
            transition 1: 1 -> 2 when ↑start
        }
    ";
    let trace = run(program, &[("start", "0 1 1")]);
    assert_eq!(trace.column("G"), "1,2,2");
    assert_eq!(trace.column("G:left"), "0,0,0");
    assert_eq!(trace.column("G:entered"), "0,1,1");
    assert_eq!(trace.column("G:left_event"), "0,1,1");
    assert_eq!(trace.column("G:entered_event"), "0,0,0");
}

#[test]
fn a_stored_statement_in_a_step_runs_in_every_scan() {
    let program = "
        input go
        graph G {
            var n : int = 0
            initial step 1 { n = n + 1 }
            step 2
            transition 1: 1 -> 2 when go
        }
    ";
    let trace = run(program, &[("go", "0 0 0 1 1")]);
    assert_eq!(trace.column("G:n"), "1,2,3,3,3");
}

#[test]
fn each_stored_statement_sees_those_before_it() {
    let program = "
        graph G {
            var a : int = 0
            var b : int = 0
            always { b = a; a = a + 1; b = b * 10 + a }
        }
    ";
    let trace = run_scans(program, 3);
    assert_eq!(trace.column("G:a"), "1,2,3");
    assert_eq!(trace.column("G:b"), "1,12,23");
}

#[test]
fn steps_store_in_source_order_and_behind_stand_alone_actions() {
    let program = "
        output A, B
        graph G {
            initial step 1 { A = True }
            initial step 2 { A = False; B = True }
            always { B = False }
        }
    ";
    let trace = run_scans(program, 2);
    assert_eq!(trace.column("A"), "0,0");
    assert_eq!(trace.column("B"), "1,1");
}

#[test]
fn a_momentary_action_ends_with_its_step_and_a_stored_one_does_not() {
    let program = "
        input go
        output M, S
        graph G {
            initial step 1 { M; S = True }
            step 2
            step 3 { S = False }
            transition 1: 1 -> 2 when go
            transition 2: 2 -> 3 when T/X2/20ms
        }
    ";
    let trace = run(program, &[("go", "0 1 1 1")]);
    assert_eq!(trace.column("M"), "1,0,0,0");
    assert_eq!(trace.column("S"), "1,1,1,0");
}

#[test]
fn a_momentary_variable_is_the_or_of_its_statements() {
    let program = "
        input a, b
        output M
        graph G {
            always { M IF a }
            initial step 1 { M IF b }
        }
    ";
    let trace = run(program, &[("a", "0 0 1 1"), ("b", "0 1 0 1")]);
    assert_eq!(trace.column("M"), "0,1,1,1");
}

#[test]
fn an_interlock_sees_the_requests_of_this_very_scan() {
    let program = "
        input go, gate
        output OUT, LAMP
        var request
        graph G {
            always {
                LAMP IF OUT
                OUT IF request AND NOT gate
            }
            initial step 1
            step 2 { request }
            transition 1: 1 -> 2 when go
        }
    ";
    let trace = run(program, &[("go", "0 1 0 0"), ("gate", "0 0 1 0")]);
    assert_eq!(trace.column("request"), "0,1,1,1");
    assert_eq!(trace.column("OUT"), "0,1,0,1");
    assert_eq!(trace.column("LAMP"), "0,1,0,1");
}

#[test]
fn a_stored_statement_sees_momentary_variables_of_the_scan_before() {
    let program = "
        input a
        output M, S
        graph G {
            always {
                M IF a
                S = M
            }
        }
    ";
    let trace = run(program, &[("a", "0 1 1 0 0")]);
    assert_eq!(trace.column("M"), "0,1,1,0,0");
    assert_eq!(trace.column("S"), "0,0,1,1,0");
}

#[test]
fn momentary_variables_see_the_newest_stored_values() {
    let program = "
        output M
        graph G {
            var n : int = 0
            always {
                M IF n > 1
                n = n + 1
            }
        }
    ";
    assert_eq!(run_scans(program, 3).column("M"), "0,1,1");
}

#[test]
fn do_runs_once_for_each_firing_and_reads_what_the_scan_before_left() {
    let program = "
        input go
        graph G {
            var n : int = 0
            initial step 1
            step 2
            transition 1: 1 -> 2 when go do { n = n + 1 }
            transition 2: 2 -> 1 when NOT go
        }
    ";
    let trace = run(program, &[("go", "1 1 1 0 1")]);
    assert_eq!(trace.column("G"), "1,2,2,1,2");
    assert_eq!(trace.column("G:n"), "0,1,1,1,2");
}

#[test]
fn initial_steps_are_activated_in_scan_0() {
    let program = "
        output M
        graph G {
            var n : int = 10
            initial step 1 { M; on activation: n = n + 1 }
        }
    ";
    let trace = run_scans(program, 2);
    assert_eq!(trace.column("M"), "1,1");
    assert_eq!(trace.column("G:n"), "11,11");
}

#[test]
fn variables_begin_with_their_declared_values() {
    let program = "
        input go
        output S = True
        var n : int = 5
        var low : int in 3 .. 9
        var d : time = 1.5 s
        graph G {
            always { S = False IF go; n = 6 IF go; low = 4 IF go; d = 2s IF go }
        }
    ";
    let trace = run(program, &[("go", "0 1")]);
    assert_eq!(trace.column("S"), "1,0");
    assert_eq!(trace.column("n"), "5,6");
    assert_eq!(trace.column("low"), "3,4", "the bound nearest to 0");
    assert_eq!(trace.column("d"), "1500,2000");
}

#[test]
fn the_first_scan_is_known_to_actions() {
    let program = "
        output P
        graph G { always { P IF System:first_scan } }
    ";
    assert_eq!(run_scans(program, 3).column("P"), "1,0,0");
}
