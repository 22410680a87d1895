//! `semantics.md`, "Numbers": what is evaluated, so what counts in `System:arithmetic_faults`.

use crate::run::{run, run_csv, run_scans};

/// Runs a program that divides by `zero` and shows the count of faults as `faults`.
fn faults(program: &str, inputs: &[(&str, &str)]) -> String {
    run(&counting(program), inputs).column("faults")
}

fn counting(program: &str) -> String {
    format!(
        "{program}
         input a
         var zero : int = 0
         var faults : int = 0
         graph Count {{ always {{ faults = System:arithmetic_faults; zero = 0 }} }}"
    )
}

#[test]
fn the_triggers_of_a_frozen_graph_count_and_those_of_one_forced_away_do_not() {
    let program = |set: &str| {
        format!(
            "graph H {{ always {{ F/L:{set} IF a }} }}
             graph L {{ initial step 1; step 2; transition 1: 1 -> 2 when 1 / zero > 0 }}"
        )
    };
    assert_eq!(faults(&program("{*}"), &[("a", "0 1 1 1")]), "0,1,2,3");
    assert_eq!(faults(&program("{2}"), &[("a", "0 1 1 1")]), "0,1,1,1");
}

#[test]
fn conditions_of_on_and_do_count_when_they_happen() {
    let program = "
        var n : int = 0
        graph G {
            initial step 1 {
                on activation: n = 1 IF 1 / zero = 0
                on event ↑a: n = 2 IF 1 / zero = 0
                on deactivation: n = n + 1 / zero IF 1 / zero = 1
            }
            step 2
            transition 1: 1 -> 2 when a do { n = n + 1 IF 1 / zero > 0 }
        }
    ";
    assert_eq!(faults(program, &[("a", "0 0 1 1")]), "1,1,4,4");
}

#[test]
fn a_void_do_counts_nothing() {
    let program = "
        var n : int = 0
        graph H { always { F/L:{1} IF a } }
        graph L {
            initial step 1
            step 2
            transition 1: 1 -> 2 when a do { n = 0 IF 1 / zero > 0 }
        }
    ";
    assert_eq!(faults(program, &[("a", "0 1 1 0")]), "0,0,0,0");
}

#[test]
fn an_event_counts_while_its_step_was_active_and_its_edge_always() {
    let program = |event: &str| {
        format!(
            "var n : int = 0
             graph G {{
                 initial step 1
                 step 2 {{ on event {event}: n = 1 }}
                 transition 1: 1 -> 2 when a
             }}"
        )
    };
    let given = [("a", "0 1 1 1")];
    assert_eq!(faults(&program("↑a AND 1 / zero > 0"), &given), "0,0,1,2");
    assert_eq!(faults(&program("↑(1 / zero > 0)"), &given), "1,2,3,4");
}

#[test]
fn the_edge_in_a_sleeping_action_counts_and_the_rest_does_not() {
    let program = "
        var n : int = 0
        graph G {
            initial step 1
            step 2 { n = 1 IF ↑(1 / zero > 0) OR 1 / zero > 0 }
            transition 1: 1 -> 2 when a
        }
    ";
    assert_eq!(faults(program, &[("a", "0 0 1 1")]), "1,2,3,5");
}

#[test]
fn a_condition_of_a_step_counts_while_the_step_is_active() {
    let momentary = "
        output P, Q
        graph G { initial step 1; step 2 { P, Q IF 1 / zero = 0 }; transition 1: 1 -> 2 when a }
    ";
    assert_eq!(faults(momentary, &[("a", "0 1 1 1")]), "0,0,1,2");
    let forcing = "
        graph G {
            initial step 1
            step 2 { F/L:{1} IF 1 / zero > 0 }
            transition 1: 1 -> 2 when a
        }
        graph L { initial step 1 }
    ";
    assert_eq!(faults(forcing, &[("a", "0 1 1 1")]), "0,1,2,3");
}

#[test]
fn the_edge_in_a_sleeping_order_counts_in_every_scan() {
    let program = "
        graph G {
            initial step 1
            step 2 { F/L:{1} IF ↑(1 / zero > 0) }
            transition 1: 1 -> 2 when a
        }
        graph L { initial step 1 }
    ";
    assert_eq!(faults(program, &[("a", "0 0 1")]), "1,2,3");
}

#[test]
fn a_stand_alone_action_of_an_empty_enclosed_graph_counts() {
    let program = "
        output P
        graph H { initial step 1; step 2 encloses L{1}; transition 1: 1 -> 2 when a }
        graph L { always { P IF 1 / zero = 0 }; step 1 }
    ";
    assert_eq!(faults(program, &[("a", "0 0 0")]), "0,1,2");
}

#[test]
fn both_times_of_a_delay_and_what_is_nested_count_once_each() {
    let delay = "output P\n graph G { always { P IF (1s / zero)/a/(1s / zero) } }";
    assert_eq!(faults(delay, &[("a", "0 0 1")]), "2,4,6");
    let nested = "output P\n graph G { always { P IF T/(10ms/(1 / zero > 0))/20ms } }";
    assert_eq!(faults(nested, &[("a", "0 0 1")]), "1,2,3");
}

#[test]
fn or_and_xor_evaluate_both_sides() {
    let program = "
        output P, Q
        graph G { always { P IF a OR 1 / zero > 0; Q IF a XOR 1 / zero > 0 } }
    ";
    assert_eq!(faults(program, &[("a", "1 1 1")]), "0,2,4");
}

#[test]
fn saturating_and_clamping_count_apart() {
    let program = "
        var n : int in 0 .. 9
        var t : time = 20d
        var big : int = 2147483647
        graph G { always { n = big + 1 IF a; t = t + t - 1ms IF NOT a } }
    ";
    assert_eq!(faults(program, &[("a", "1 0 0")]), "2,3,4");
}

#[test]
fn numbers_at_words_have_the_range_of_the_word() {
    let program = "
        input i : int at %IW0
        output o : int at %QW0
        output unsigned : int at %QW1 in 0 .. 40000
        var m : int at %MW0
        var d : int at %MD4
        graph G { always { o = i + 1; m = i - 100000; d = i + 100000; unsigned = i + 10000 } }
    ";
    let given = [("i", "32767 40000 -40000 0")];
    let trace = run(&counting(program), &given);
    assert_eq!(trace.column("o"), "32767,32767,-32767,1");
    assert_eq!(trace.column("m"), "-32768,-32768,-32768,-32768");
    assert_eq!(trace.column("d"), "132767,132767,67232,100000");
    assert_eq!(trace.column("unsigned"), "40000,40000,0,10000");
    assert_eq!(trace.column("faults"), "3,7,9,10");
}

#[test]
fn an_input_that_is_outside_as_power_comes_has_gone_out_then() {
    let program = "
        input level : int at %IW0 in 4 .. 20
        var n : int = 0
        graph G {
            always { n = level }
            initial step 1
            step 2
            transition 1: 1 -> 2 when System:arithmetic_faults > 1
        }
    ";
    let trace = run(&counting(program), &[("level", "0 21 20 21 20 0")]);
    assert_eq!(trace.column("n"), "4,20,20,20,20,4");
    assert_eq!(trace.column("faults"), "1,1,1,2,2,3");
    assert_eq!(
        trace.column("G"),
        "1,1,1,2,2,2",
        "triggers see the count of the sample"
    );
}

#[test]
fn each_new_value_of_a_parameter_outside_its_range_counts() {
    let program = counting(
        "parameter p : int = 5 in 0 .. 9
         var n : int = 0
         graph G { always { n = p } }",
    );
    let stimulus = "time_ms,p\n10,12\n20,13\n23,99\n27,4\n40,12\n50,12\n60,3\n70,12\n";
    let trace = run_csv(&program, stimulus, &[], None);
    assert_eq!(trace.column("p"), "5,9,9,4,9,9,3,9");
    assert_eq!(trace.column("faults"), "0,1,2,2,3,3,3,4");
}

#[test]
fn under_stable_operands_and_armed_triggers_count_in_every_round() {
    let program = |third: &str| {
        format!(
            "evolution stable
             var n : int = 0
             graph G {{
                 initial step 1
                 step 2
                 step 3 {third}
                 transition 1: 1 -> 2 when a do {{ n = 1 IF ↑(n > 9) }}
                 transition 2: 2 -> 3
             }}"
        )
    };
    let given = [("a", "0 1 1")];
    let event = "{ on event ↑(1 / zero > 0): n = 1 }";
    assert_eq!(
        faults(&program(event), &given),
        "1,4,5",
        "an event, as a trigger"
    );
    let after = "{ on activation: n = 1 IF ↑(1 / zero > 0) }";
    assert_eq!(
        faults(&program(after), &given),
        "1,2,3",
        "a statement, once"
    );
    let armed = program("") + "graph K { initial step 1; transition 1: 1 -> when 1 / zero > 0 }";
    assert_eq!(faults(&armed, &given), "0,3,4");
}

#[test]
fn scan_0_evaluates_the_edges_of_actions_once_under_stable() {
    let program = "
        evolution stable
        output P
        var n : int = 0
        graph G { initial step 1 { on activation: n = 1 }; always { P IF ↑(n = 1) } }
    ";
    assert_eq!(run_scans(program, 3).column("P"), "0,1,0");
}
