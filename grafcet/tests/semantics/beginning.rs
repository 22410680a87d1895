//! `semantics.md`, "Scan 0", where it meets the hierarchy, edges, timers and the count of faults.

use crate::run::{run, run_scans};

#[test]
fn a_number_without_a_declared_value_begins_at_the_bound_nearest_to_0() {
    let program = "
        output above : int in 5 .. 10
        parameter p : int in 3 .. 9
        var below : int in -9 .. -3
        var t : time in 1s .. 2s
        graph G { always { below = -4 IF p = 0; above = 6 IF p = 0; t = 2s IF p = 0 } }
    ";
    let trace = run_scans(program, 2);
    assert_eq!(trace.column("above"), "5,5");
    assert_eq!(trace.column("p"), "3,3");
    assert_eq!(trace.column("below"), "-3,-3");
    assert_eq!(trace.column("t"), "1000,1000");
}

#[test]
fn an_enclosed_graph_begins_only_under_an_initial_step_that_is_active() {
    let program = "
        graph Low { step 7; initial step 8 }
        graph Middle { initial step 5 encloses Low{7}; step 6 }
        graph Top { initial step 1 encloses Middle{6} }

        graph Low2 { step 7; initial step 8 }
        graph Middle2 { step 5 encloses Low2{7} }
        graph Top2 { initial step 1 encloses Middle2{5} }

        graph Low3 { step 7; initial step 8 }
        graph Middle3 { initial step 5 encloses Low3{7} }
        graph Top3 { initial step 1; step 2 encloses Middle3{5}; transition 1: 1 -> 2 }
    ";
    let trace = run_scans(program, 3);
    assert_eq!(trace.column("Middle"), "5,5,5");
    assert_eq!(trace.column("Low"), "8,8,8", "with its own initial steps");
    assert_eq!(trace.column("Middle2"), "5,5,5");
    assert_eq!(trace.column("Low2"), "7,7,7", "5 is no initial step");
    assert_eq!(trace.column("Middle3"), ",5,5");
    assert_eq!(trace.column("Low3"), ",7,7", "5 was not active");
}

#[test]
fn an_enclosed_graph_does_not_begin_under_a_step_that_an_order_removes() {
    let program = "
        var n : int = 0
        graph H { always { F/Top:{2} IF System:first_scan } }
        graph Top { initial step 1 encloses Low{7}; step 2; transition 1: 2 -> 1 }
        graph Low {
            step 7 { on activation: n = n + 1 }
            initial step 8 { on activation: n = n + 10; on deactivation: n = n + 100 }
        }
    ";
    let trace = run_scans(program, 4);
    assert_eq!(trace.column("Top"), "2,2,1,1");
    assert_eq!(trace.column("Low"), ",,7,7");
    assert_eq!(trace.column("n"), "0,0,1,1");
}

#[test]
fn freezing_from_the_start_keeps_what_the_enclosed_graph_begins_with() {
    let program = "
        graph Top {
            always { F/Low:{*} IF System:first_scan }
            initial step 1 encloses Low{5}
        }
        graph Low { step 5; initial step 6; transition 1: 6 -> 5 }
    ";
    assert_eq!(run_scans(program, 4).column("Low"), "6,6,5,5");
}

#[test]
fn triggers_are_primed_before_orders_change_the_situation() {
    let program = "
        graph H { always { F/G:{2} IF System:first_scan } }
        graph G { initial step 1; step 2; step 3; transition 1: 2 -> 3 when ↓X1 }
        graph Falls { initial step 1; step 2; transition 1: 1 -> 2 when ↓G:X1 }
        graph Watched { initial step 1; step 2; transition 1: 1 -> 2 when T/G:X1 AND TRUE/20ms }
        graph Alone { initial step 1; step 2; transition 1: 1 -> 2 when T/G:X1/20ms }
    ";
    let trace = run_scans(program, 4);
    assert_eq!(trace.column("Falls"), "1,2,2,2");
    assert_eq!(
        trace.column("G"),
        "2,2,2,2",
        "its edge is lost as the order ends"
    );
    assert_eq!(
        trace.column("Watched"),
        "1,1,2,2",
        "the enable was True in scan 0"
    );
    assert_eq!(
        trace.column("Alone"),
        "1,1,1,1",
        "the step never was active"
    );
}

#[test]
fn in_scan_0_only_the_rise_of_a_bit_standing_alone_is_an_edge() {
    let program = "
        output Rise, Fall, Inverse, Removed, Edge, EdgeFall
        graph H {
            always {
                F/G:{2} IF System:first_scan
                Rise IF ↑G:X2
                Fall IF ↓G:X1
                Inverse IF ↑NOT G:X1
                Removed IF ↑G:X1
                Edge IF ↑(↑G:X2)
                EdgeFall IF ↓(↑G:X2)
            }
        }
        graph G { initial step 1; step 2 }
    ";
    let trace = run_scans(program, 3);
    assert_eq!(trace.column("Rise"), "1,0,0");
    assert_eq!(trace.column("Fall"), "0,0,0");
    assert_eq!(trace.column("Inverse"), "0,0,0");
    assert_eq!(trace.column("Removed"), "0,0,0");
    assert_eq!(trace.column("Edge"), "0,0,0");
    assert_eq!(trace.column("EdgeFall"), "0,1,0", "its memory is of scan 0");
}

#[test]
fn a_macro_bit_rises_in_scan_0_for_actions_and_orders() {
    let program = "
        output Rise, Timed
        graph H { always { F/L:{2} IF ↑G:XM5 } }
        graph G {
            macro step M5 { entry initial step E5; exit step S5; transition 1: E5 -> S5 }
            step 1
            transition 2: M5 -> 1 when T/XM5/1h
            always { Rise IF ↑XM5; Timed IF T/XM5/10ms }
        }
        graph L { initial step 1; step 2; transition 1: 2 -> 1 }
    ";
    let trace = run_scans(program, 4);
    assert_eq!(trace.column("Rise"), "1,0,0,0");
    assert_eq!(trace.column("Timed"), "0,1,1,1");
    assert_eq!(trace.column("L"), "2,2,1,1");
}

#[test]
fn no_event_and_no_deactivation_happens_in_scan_0() {
    let program = "
        input a
        var n : int = 0
        graph H { always { F/G:{2} IF System:first_scan } }
        graph G {
            initial step 1 { on event ↑X1 OR a: n = n + 1; on deactivation: n = n + 10 }
            step 2 { on event ↓X1: n = n + 100 }
        }
    ";
    let trace = run(program, &[("a", "1 1 1")]);
    assert_eq!(trace.column("n"), "0,100,100");
}

#[test]
fn scan_0_counts_the_faults_of_operands_and_not_of_triggers() {
    let program = "
        var zero : int = 0
        var faults : int = 0
        graph G {
            always { faults = System:arithmetic_faults; zero = 0 }
            initial step 1
            step 2
            step 3
            transition 1: 1 -> 2 when 1 / zero > 0
            transition 2: 2 -> 3 when T/X1/(1s / zero)
        }
    ";
    assert_eq!(run_scans(program, 3).column("faults"), "1,3,5");
}

#[test]
fn an_edge_of_a_step_starts_timers_in_actions_from_scan_0() {
    let program = "
        output A
        graph G { initial step 1; always { A IF T/↑X1/10ms } }
        graph K { initial step 5; step 6; transition 1: 5 -> 6 when T/↑X5/0s }
    ";
    let trace = run_scans(program, 3);
    assert_eq!(trace.column("A"), "0,1,1");
    assert_eq!(trace.column("K"), "5,5,5", "in a trigger it is no edge");
}
