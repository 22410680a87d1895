//! `semantics.md`, "Plants".

use crate::run::{run_csv, run_with};

const LIFT: &str = "
    input up
    output RAISE
    graph G {
        initial step 1 { RAISE }
        step 2
        transition 1: 1 -> 2 when up
        transition 2: 2 -> 1 when NOT up
    }
    plant Mast { always { up IF RAISE } }
";

#[test]
fn plants_run_before_phase_1_on_the_outputs_of_the_scan_before() {
    let trace = run_with(LIFT, &["Mast"], 5);
    assert_eq!(trace.column("RAISE"), "1,0,1,0,1");
    assert_eq!(trace.column("G"), "1,2,1,2,1");
}

#[test]
fn no_plant_runs_in_a_trace_unless_told_to() {
    assert_eq!(run_with(LIFT, &[], 3).column("G"), "1,1,1");
}

#[test]
fn what_is_given_overrides_a_plant() {
    let trace = run_csv(LIFT, "time_ms,up\n20,0\n", &["Mast"], Some(40));
    assert_eq!(trace.column("G"), "1,2,1,1,1");
}

#[test]
fn a_momentary_plant_action_writes_false_and_a_stored_one_stays() {
    let program = "
        input momentary, stored
        output M, S, PULSE
        graph G {
            always { M IF momentary; S IF stored; PULSE IF T/X1/10ms AND NOT T/X1/20ms }
            initial step 1
        }
        plant P { always { momentary IF PULSE; stored = True IF PULSE } }
    ";
    let trace = run_with(program, &["P"], 5);
    assert_eq!(trace.column("PULSE"), "0,1,0,0,0");
    assert_eq!(trace.column("M"), "0,0,1,0,0");
    assert_eq!(trace.column("S"), "0,0,1,1,1");
}

#[test]
fn plants_see_each_others_inputs_as_the_last_scan_left_them() {
    let program = "
        input near, far
        output GO, NEAR, FAR
        graph G {
            initial step 1 { GO }
            always { NEAR IF near; FAR IF far }
        }
        plant First { always { near IF GO } }
        plant Second { always { far IF near } }
    ";
    for order in [["First", "Second"], ["Second", "First"]] {
        let trace = run_with(program, &order, 4);
        assert_eq!(trace.column("NEAR"), "0,1,1,1");
        assert_eq!(trace.column("FAR"), "0,0,1,1");
    }
}

#[test]
fn a_plant_has_steps_numbers_and_timers_of_its_own() {
    let program = "
        input up, down
        output RAISE, LOWER
        graph G {
            initial step 1 { RAISE }
            step 2 { LOWER }
            transition 1: 1 -> 2 when up
            transition 2: 2 -> 1 when down
        }
        plant Press {
            var height : int = 0
            always {
                height = height - 1 IF LOWER AND height > 0
                height = height + 1 IF RAISE AND height < 3
                up   IF height >= 3
                down IF height <= 0
            }
        }
    ";
    let trace = run_with(program, &["Press"], 8);
    assert_eq!(trace.column("G"), "1,1,1,2,2,2,1,1");
}

#[test]
fn faults_in_plants_are_not_counted() {
    let program = "
        input i
        output O
        var faults : int = 0
        graph G { always { faults = System:arithmetic_faults; O IF i } }
        plant P {
            var zero : int = 0
            always { i IF 1 / zero = 0 AND NOT O; zero = 0 }
        }
    ";
    assert_eq!(run_with(program, &["P"], 3).column("faults"), "0,0,0");
}
