//! `semantics.md`, "Timers": the instants at which they turn, presets that change, and enables that are not plain.

use crate::run::{run, run_csv, run_scans};

/// How `P` follows an expression over `a`, given scan by scan of 10 ms, with these declarations.
fn follow(declarations: &str, expression: &str, a: &str) -> String {
    let program = format!(
        "input a
         output P
         {declarations}
         graph G {{ always {{ P IF {expression} }} }}"
    );
    run(&program, &[("a", a)]).column("P")
}

#[test]
fn each_pulse_of_an_edge_starts_its_timer_anew() {
    assert_eq!(
        follow("", "T/↑a/20ms", "0 1 1 1 0 1 1 1"),
        "0,0,0,1,1,0,0,1"
    );
}

#[test]
fn a_constant_enable_has_risen_in_scan_0() {
    assert_eq!(follow("", "T/TRUE/20ms", "0 0 0 0"), "0,0,1,1");
    assert_eq!(follow("", "T/NOT a/10ms", "0 0 1 1 0 0"), "0,1,1,1,0,1");
}

#[test]
fn a_negative_preset_has_run_out_with_the_rise() {
    for n in ["var n : int = -5", "var n : time = -5s"] {
        assert_eq!(follow(n, "T/a/n", "0 0 1 0"), "0,0,1,1");
    }
    let n = "var n : time = -5s";
    assert_eq!(follow(n, "n/a", "0 1 0 1"), "0,1,0,1");
    assert_eq!(follow(n, "10ms/a/n", "0 1 1 0 0"), "0,0,1,0,0");
}

#[test]
fn a_preset_between_two_scans_is_up_at_the_second() {
    assert_eq!(follow("", "T/a/15ms", "0 1 1 1 0"), "0,0,0,1,1");
    assert_eq!(follow("", "15ms/a", "0 1 1 1 0"), "0,0,0,1,0");
}

#[test]
fn an_off_delay_ends_at_the_instant_that_t2_has_passed() {
    assert_eq!(follow("", "10ms/a/0s", "0 1 1 0 0"), "0,0,1,0,0");
    assert_eq!(
        follow("", "10ms/a/20ms", "0 1 1 0 1 0 0 0"),
        "0,0,1,1,1,0,0,0"
    );
    assert_eq!(follow("", "0ms/a/10ms", "1 0 0 0 1 0 0"), "1,1,0,0,1,1,0");
}

#[test]
fn an_off_delay_does_not_run_before_the_on_delay_has_been_true() {
    assert_eq!(follow("", "10ms/a/20ms", "1 0 0 0"), "0,0,0,0");
}

#[test]
fn an_off_delay_runs_also_when_its_on_delay_grows_past_the_elapsed_time() {
    let program = "
        input a
        output On, OnOff
        parameter t1 : time = 20ms
        graph G { always { On IF t1/a; OnOff IF t1/a/20ms } }
    ";
    let trace = run(
        program,
        &[("a", "1 1 1 1 1 1 1"), ("t1", "20 20 20 60 60 60 60")],
    );
    assert_eq!(trace.column("On"), "0,0,1,0,0,0,1");
    assert_eq!(trace.column("OnOff"), "0,0,1,1,1,0,1");
}

#[test]
fn an_off_delay_reads_its_time_at_each_evaluation() {
    let program = "
        input a
        output P
        parameter t2 : time = 20ms
        graph G { always { P IF 0ms/a/t2 } }
    ";
    let trace = run(
        program,
        &[("a", "0 1 0 0 0 0 0"), ("t2", "20 20 20 20 20 50 50")],
    );
    assert_eq!(trace.column("P"), "0,1,1,1,0,1,1");
}

#[test]
fn an_integer_preset_is_read_at_each_evaluation() {
    let program = "
        scan 500 ms
        input a, up
        output P
        var n : int = 1
        graph G { always { n = 2 IF up; P IF T/a/(n + 0) } }
    ";
    let stimulus = "time_ms,a,up\n0,1,0\n1000,,1\n1500,,0\n2500,,\n";
    let trace = run_csv(program, stimulus, &[], None);
    assert_eq!(trace.column("P"), "0,0,1,0,1,1");
}

#[test]
fn no_integer_preset_is_too_large() {
    let program = "
        scan 24 h
        input a
        output Month, Lifetime, Negative
        var month : int = 2592000
        var most : int = 2147483647
        var least : int = -2147483648
        graph G { always { Month IF T/a/month; Lifetime IF T/a/most; Negative IF T/a/least } }
    ";
    let day = 24 * 3_600_000;
    let trace = run_csv(program, "time_ms,a\n1,1\n", &[], Some(32 * day));
    let rises = |name| trace.column(name).split(',').position(|cell| cell == "1");
    assert_eq!(rises("Month"), Some(31), "30 days behind the rise on day 1");
    assert_eq!(rises("Lifetime"), None);
    assert_eq!(rises("Negative"), Some(1));
}

#[test]
fn only_a_bit_standing_alone_is_timed_from_its_activation() {
    let graph = |name: &str, timer: &str| {
        format!(
            "graph {name} {{
                 initial step 1
                 step 2
                 step 3
                 transition 1: 1 -> 2 when go
                 transition 2: 2 -> 3 when {timer}
             }}\n"
        )
    };
    let program = "input go\n".to_owned()
        + &graph("Alone", "T/X2/20ms")
        + &graph("Parenthesised", "T/(X2)/20ms")
        + &graph("Delay", "20ms/X2")
        + &graph("Negated", "T/NOT Alone:X1/20ms")
        + &graph("Twice", "T/NOT NOT X2/20ms");
    let trace = run(&program, &[("go", "0 1 1 1 1 1")]);
    assert_eq!(trace.column("Alone"), "1,2,2,3,3,3");
    assert_eq!(trace.column("Parenthesised"), "1,2,2,3,3,3");
    assert_eq!(trace.column("Delay"), "1,2,2,3,3,3");
    assert_eq!(trace.column("Negated"), "1,2,2,2,3,3");
    assert_eq!(trace.column("Twice"), "1,2,2,2,3,3");
}

#[test]
fn a_delay_of_a_step_rises_with_its_activation_and_falls_where_it_is_read() {
    let program = "
        input go, back
        output Action
        graph G {
            always { Action IF 10ms/X2/20ms }
            initial step 1
            step 2
            transition 1: 1 -> 2 when go
            transition 2: 2 -> 1 when back
        }
        graph K {
            initial step 7
            step 8
            transition 1: 7 -> 8 when 10ms/G:X2/20ms
            transition 2: 8 -> 7 when NOT (10ms/G:X2/20ms)
        }
    ";
    let trace = run(
        program,
        &[("go", "0 1 0 0 0 0 0"), ("back", "0 0 0 1 0 0 0")],
    );
    assert_eq!(trace.column("G"), "1,2,2,1,1,1,1");
    assert_eq!(trace.column("Action"), "0,0,1,1,1,0,0");
    assert_eq!(trace.column("K"), "7,7,8,8,8,8,7");
}

#[test]
fn a_delay_of_a_step_begins_anew_with_each_activation() {
    let program = "
        input go, back
        graph G {
            initial step 1
            step 2
            transition 1: 1 -> 2 when go
            transition 2: 2 -> 1 when back
        }
        graph K { initial step 7; step 8; transition 1: 7 -> 8 when 20ms/G:X2 }
    ";
    let trace = run(program, &[("go", "0 1 0 1 0 0"), ("back", "0 0 1 0 0 0")]);
    assert_eq!(trace.column("G"), "1,2,1,2,2,2");
    assert_eq!(trace.column("K"), "7,7,7,7,7,8");
}

#[test]
fn a_timer_goes_on_after_its_step_is_left_and_never_runs_for_one_that_never_was_active() {
    let program = "
        output Never
        graph G {
            always { Never IF T/X9/0s }
            initial step 1
            step 2
            step 3
            step 9
            transition 1: 1 -> 2
            transition 2: 2 -> 3 when T/X1/50ms
        }
    ";
    let trace = run_scans(program, 6);
    assert_eq!(trace.column("G"), "1,2,2,2,2,3");
    assert_eq!(trace.column("Never"), "0,0,0,0,0,0");
}

#[test]
fn a_macro_step_entered_as_it_is_left_is_not_timed_anew() {
    let program = "
        output Rise, Timed
        graph G {
            always { Rise IF ↑XM5; Timed IF T/XM5/50ms }
            macro step M5 {
                entry step E5
                exit step S5
                transition 1: E5 -> S5 when T/XE5/20ms
            }
            initial step 1
            transition 2: 1 -> M5
            transition 3: M5 -> M5 when T/XS5/10ms
        }
    ";
    let trace = run_scans(program, 8);
    assert_eq!(trace.column("G"), "1,E5,E5,S5,E5,E5,S5,E5");
    assert_eq!(trace.column("Rise"), "0,1,0,0,0,0,0,0");
    assert_eq!(trace.column("Timed"), "0,0,0,0,0,0,1,1");
}

#[test]
fn a_macro_bit_lasts_while_any_step_of_its_expansion_is_active() {
    let program = "
        output P
        graph G {
            always { P IF XM5 }
            macro step M5 {
                entry step E5
                step 6
                exit step S5
                transition 1: E5 -> 6, S5
                transition 4: 6 -> when T/X6/20ms
            }
            initial step 1
            step 2
            transition 2: 1 -> M5
            transition 3: M5 -> 2
        }
    ";
    let trace = run_scans(program, 5);
    assert_eq!(trace.column("G"), "1,E5,6 S5,6 2,2");
    assert_eq!(trace.column("P"), "0,1,1,1,0");
}
