//! `semantics.md`, "Timers".

use crate::run::{run, run_csv, run_scans};

/// A program whose output `P` follows an expression over `a`, with `a` given scan by scan.
fn follow(expression: &str, a: &str) -> String {
    let program = format!(
        "input a
         output P
         graph G {{ always {{ P IF {expression} }} }}"
    );
    run(&program, &[("a", a)]).column("P")
}

#[test]
fn a_timer_stays_true_after_its_enable_has_fallen_until_the_next_rise() {
    assert_eq!(
        follow("T/a/30ms", "0 1 0 0 0 0 1 1 0 0"),
        "0,0,0,0,1,1,0,0,0,1"
    );
}

#[test]
fn a_timer_without_a_rise_never_ends() {
    assert_eq!(follow("T/a/0ms", "0 0 0"), "0,0,0");
}

#[test]
fn a_preset_of_nothing_is_true_in_the_scan_of_the_rise() {
    assert_eq!(follow("T/a/0s", "0 1 0 1"), "0,1,1,1");
}

#[test]
fn an_enable_that_is_true_in_scan_0_has_risen_then() {
    assert_eq!(follow("T/a/20ms", "1 1 1 1"), "0,0,1,1");
    assert_eq!(follow("20ms/a", "1 1 1 1"), "0,0,1,1");
}

#[test]
fn an_on_delay_needs_its_enable_without_a_break() {
    assert_eq!(
        follow("20ms/a", "0 1 1 0 1 1 1 1 0 0"),
        "0,0,0,0,0,0,1,1,0,0"
    );
}

#[test]
fn an_on_and_off_delay_holds_after_the_fall() {
    assert_eq!(follow("10ms/a/20ms", "0 1 1 1 0 0 0 0"), "0,0,1,1,1,1,0,0");
}

#[test]
fn an_off_delay_begins_anew_with_every_fall() {
    assert_eq!(follow("0ms/a/20ms", "0 1 0 1 0 0 0 0"), "0,1,1,1,1,1,0,0");
}

#[test]
fn an_initial_step_is_timed_from_scan_0() {
    let program = "
        graph G {
            initial step 1
            step 2
            transition 1: 1 -> 2 when T/X1/20ms
        }
    ";
    assert_eq!(run_scans(program, 4).column("G"), "1,1,2,2");
}

#[test]
fn a_step_left_and_entered_in_one_scan_is_not_re_timed() {
    let program = "
        input a
        graph G {
            initial step 1
            step 2
            transition 1: 1 -> 1 when a
            transition 2: 1 -> 2 when T/X1/30ms
        }
    ";
    assert_eq!(run(program, &[("a", "0 1 1 0")]).column("G"), "1,1,1,2");
}

#[test]
fn a_step_in_an_action_is_timed_from_the_scan_that_activates_it() {
    let program = "
        input go
        output P, Q
        graph G {
            initial step 1
            step 2 { P IF T/X2/0s; Q IF T/X2/10ms }
            transition 1: 1 -> 2 when go
        }
    ";
    let trace = run(program, &[("go", "0 1 1 1")]);
    assert_eq!(trace.column("P"), "0,1,1,1");
    assert_eq!(trace.column("Q"), "0,0,1,1");
}

#[test]
fn an_expression_in_a_trigger_sees_steps_as_the_scan_before_left_them() {
    let program = "
        input go
        graph Alone {
            initial step 1
            step 2
            step 3
            transition 1: 1 -> 2 when go
            transition 2: 2 -> 3 when T/X2/20ms
        }
        graph Expression {
            initial step 1
            step 2
            step 3
            transition 1: 1 -> 2 when go
            transition 2: 2 -> 3 when T/X2 AND NOT X1/20ms
        }
    ";
    let trace = run(program, &[("go", "0 1 0 0 0 0")]);
    assert_eq!(trace.column("Alone"), "1,2,2,3,3,3");
    assert_eq!(trace.column("Expression"), "1,2,2,2,3,3");
}

#[test]
fn a_timer_in_a_trigger_runs_while_its_transition_is_not_armed() {
    let program = "
        input a, go
        graph G {
            initial step 1
            step 2
            step 3
            transition 1: 1 -> 2 when go
            transition 2: 2 -> 3 when T/a/20ms
        }
    ";
    let trace = run(program, &[("a", "0 1 0 0 0 0"), ("go", "0 0 0 0 1 0")]);
    assert_eq!(trace.column("G"), "1,1,1,1,2,3");
}

#[test]
fn an_integer_preset_counts_seconds() {
    let program = "
        input a
        output P, Q
        var n : int = 2
        graph G {
            always { n = 3 IF ↑a }
            always { P IF T/a/1; Q IF T/a/n }
        }
    ";
    let trace = run_csv(program, "time_ms,a\n0,0\n10,1\n", &[], Some(3020));
    let rises = |name| trace.column(name).split(',').position(|cell| cell == "1");
    assert_eq!(rises("P"), Some(101));
    assert_eq!(rises("Q"), Some(301));
}

#[test]
fn a_parameter_that_grows_past_the_elapsed_time_takes_the_timer_back() {
    let program = "
        input a
        output P
        parameter d : time = 20 ms
        graph G { always { P IF T/a/d } }
    ";
    let trace = run(
        program,
        &[("a", "1 1 1 1 1 1 1"), ("d", "20 20 20 50 50 50 50")],
    );
    assert_eq!(trace.column("P"), "0,0,1,0,0,1,1");
}

#[test]
fn an_expression_in_parentheses_is_a_preset() {
    let program = "
        input a
        output P
        const t : time = 10 ms
        graph G { always { P IF T/a/(t * 2 + 10ms) } }
    ";
    assert_eq!(
        run(program, &[("a", "0 1 1 1 1 1")]).column("P"),
        "0,0,0,0,1,1"
    );
}

#[test]
fn a_comparison_can_start_a_timer() {
    let program = "
        input temperature : int
        output P
        graph G { always { P IF T/temperature>300/20ms } }
    ";
    let trace = run(program, &[("temperature", "0 300 301 302 303 0")]);
    assert_eq!(trace.column("P"), "0,0,0,0,1,1");
}

#[test]
fn nested_timers_and_edges_work_from_the_inside_out() {
    assert_eq!(follow("↑(T/a/20ms)", "0 1 1 1 1"), "0,0,0,1,0");
    assert_eq!(follow("T/(20ms/a)/10ms", "0 1 1 1 1 1"), "0,0,0,0,1,1");
}

#[test]
fn a_fired_timer_stays_true_past_2_to_the_32_milliseconds() {
    let program = "
        scan 1 h
        input a
        output P, Q, R
        graph G {
            always { P IF T/a/1h; Q IF 1h/a; R IF T/X1/1h }
            initial step 1
        }
    ";
    // 60 days of scans; the 32-bit milliseconds wrap after 49.7.
    let until = 60 * 24 * 3_600_000;
    let trace = run_csv(program, "time_ms,a\n0,1\n", &[], Some(until));
    let expected = format!("0{}", ",1".repeat(60 * 24));
    for column in ["P", "Q", "R"] {
        assert_eq!(trace.column(column), expected, "{column}");
    }
}
