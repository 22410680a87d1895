//! `semantics.md`, `evolution stable`.

use crate::run::{run, run_scans};

#[test]
fn a_stable_program_runs_until_nothing_fires() {
    let program = "
        evolution stable
        input a, b
        graph G {
            initial step 1
            step 2
            step 3
            step 4
            transition 1: 1 -> 2 when a
            transition 2: 2 -> 3
            transition 3: 3 -> 4 when b
        }
    ";
    let trace = run(program, &[("a", "0 1 0 0"), ("b", "0 0 0 1")]);
    assert_eq!(trace.column("G"), "1,3,3,4");
}

#[test]
fn scan_0_shows_the_initial_situation_even_if_it_is_transient() {
    let program = "
        evolution stable
        graph G { initial step 1; step 2; transition 1: 1 -> 2 }
    ";
    assert_eq!(run_scans(program, 2).column("G"), "1,2");
}

#[test]
fn an_edge_fires_in_the_first_round_only() {
    let program = "
        evolution stable
        input a
        graph G {
            initial step 1
            step 2
            step 3
            transition 1: 1 -> 2 when ↑a
            transition 2: 2 -> 3 when ↑a
        }
    ";
    let trace = run(program, &[("a", "0 1 1 0 1")]);
    assert_eq!(trace.column("G"), "1,2,2,2,3");
}

#[test]
fn steps_passed_through_change_what_on_says_and_nothing_else() {
    let program = "
        evolution stable
        input a
        output M
        graph G {
            var changes : int = 0
            var plain : int = 0
            initial step 1
            step 2 {
                M
                plain = plain + 1
                on activation: changes = changes * 10 + 2
                on deactivation: changes = changes * 10 + 3
            }
            step 3 { on activation: changes = changes * 10 + 5 }
            transition 1: 1 -> 2 when a do { changes = changes * 10 + 1 }
            transition 2: 2 -> 3 do { changes = changes * 10 + 4 }
        }
    ";
    let trace = run(program, &[("a", "0 1 1")]);
    assert_eq!(trace.column("G"), "1,3,3");
    assert_eq!(trace.column("G:changes"), "0,12435,12435");
    assert_eq!(trace.column("G:plain"), "0,0,0");
    assert_eq!(trace.column("M"), "0,0,0");
}

#[test]
fn the_next_round_sees_what_a_round_has_stored() {
    let program = "
        evolution stable
        input a
        var n : int = 0
        graph G {
            initial step 1
            step 2
            step 3
            transition 1: 1 -> 2 when a do { n = n + 1 }
            transition 2: 2 -> 3 when n = 1
        }
    ";
    assert_eq!(run(program, &[("a", "0 1")]).column("G"), "1,3");
}

#[test]
fn a_round_that_changes_no_situation_is_the_last() {
    let program = "
        evolution stable
        input a
        graph G {
            var n : int = 0
            initial step 1
            step 2
            transition 1: 1 -> 1 when a AND n < 1 do { n = n + 1 }
            transition 2: 1 -> 2 when n = 1
        }
    ";
    let trace = run(program, &[("a", "0 1 1")]);
    assert_eq!(trace.column("G"), "1,1,2");
    assert_eq!(trace.column("G:n"), "0,1,1");
}

#[test]
fn a_ring_that_never_settles_is_unstable_until_it_does() {
    let program = "
        evolution stable
        input a
        output U
        graph G {
            initial step 1
            step 2
            transition 1: 1 -> 2 when a
            transition 2: 2 -> 1 when a
            always { U IF System:unstable }
        }
    ";
    let trace = run(program, &[("a", "0 1 1 0")]);
    assert_eq!(trace.column("G"), "1,1,1,1", "an even number of rounds");
    assert_eq!(trace.column("U"), "0,1,1,0");
}

#[test]
fn in_scan_mode_a_ring_moves_one_transition_a_scan() {
    let program = "
        input a
        output U
        graph G {
            initial step 1
            step 2
            transition 1: 1 -> 2 when a
            transition 2: 2 -> 1 when a
            always { U IF System:unstable }
        }
    ";
    let trace = run(program, &[("a", "0 1 1 0")]);
    assert_eq!(trace.column("G"), "1,2,1,1");
    assert_eq!(trace.column("U"), "0,0,0,0");
}

#[test]
fn timers_run_in_every_round_and_a_step_entered_in_one_counts_from_now() {
    let program = "
        evolution stable
        input a
        graph G {
            initial step 1
            step 2
            step 3
            step 4
            transition 1: 1 -> 2 when a
            transition 2: 2 -> 3 when T/X2/0s
            transition 3: 3 -> 4 when T/X3/20ms
        }
    ";
    let trace = run(program, &[("a", "0 1 0 0")]);
    assert_eq!(trace.column("G"), "1,3,3,4");
}

#[test]
fn triggers_see_momentary_variables_of_the_scan_before_in_every_round() {
    let program = "
        evolution stable
        input a
        output M
        graph G {
            initial step 1
            step 2 { M }
            step 3
            transition 1: 1 -> 2 when a
            transition 2: 2 -> 3 when M
        }
    ";
    let trace = run(program, &[("a", "0 1 0 0")]);
    assert_eq!(trace.column("G"), "1,2,3,3");
    assert_eq!(trace.column("M"), "0,1,0,0");
}

#[test]
fn star_is_the_situation_before_the_round() {
    let program = "
        evolution stable
        input a, freeze
        graph H { always { F/L:{*} IF freeze }; initial step 1 }
        graph L {
            initial step 1
            step 2
            step 3
            transition 1: 1 -> 2 when a
            transition 2: 2 -> 3
        }
    ";
    let trace = run(program, &[("a", "0 1 1 1"), ("freeze", "0 1 0 0")]);
    assert_eq!(trace.column("L"), "1,1,1,3");
}
