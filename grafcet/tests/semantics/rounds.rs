//! `semantics.md`, `evolution stable`: where rounds meet orders, edges, timers, enclosing and their own number.

use crate::run::{run, run_with};

fn stable(program: &str, inputs: &[(&str, &str)]) -> crate::run::Trace {
    run(&format!("evolution stable\n{program}"), inputs)
}

#[test]
fn a_round_in_which_only_an_order_acts_is_the_last() {
    let program = "
        input f
        graph H { always { F/L:{3} IF f } }
        graph L { initial step 1; step 2; step 3 }
        graph M { initial step 1; step 2; transition 1: 1 -> 2 when L:X3 }
    ";
    let trace = stable(program, &[("f", "0 1 1")]);
    assert_eq!(trace.column("L"), "1,3,3");
    assert_eq!(trace.column("M"), "1,1,2");
}

#[test]
fn a_transition_that_fires_in_vain_asks_for_no_round() {
    let program = "
        input f
        output U
        graph H { always { F/L:{*} IF f; U IF System:unstable } }
        graph L { initial step 1; step 2; transition 1: 1 -> 2 }
    ";
    let trace = stable(program, &[("f", "1 1 1 0 0")]);
    assert_eq!(trace.column("L"), "1,1,1,1,2");
    assert_eq!(trace.column("U"), "0,0,0,0,0");
}

/// A graph `L` held by an edge of `go`, and a graph `M` whose transitions make so many rounds.
fn held_by_an_edge(rounds: usize) -> String {
    let chain = ["", "transition 2: 2 -> 3", "transition 3: 3 -> 4"];
    format!(
        "input go
         var n : int = 0
         graph H {{ always {{ F/L:{{1}} IF ↑go }} }}
         graph L {{ initial step 1; step 2; transition 1: 1 -> 2 when n = 1 }}
         graph M {{
             initial step 1
             step 2
             step 3
             step 4
             transition 1: 1 -> 2 when ↑go do {{ n = 1 }}
             {}
         }}",
        chain[..rounds].join("\n")
    )
}

#[test]
fn an_order_holds_through_the_round_in_which_it_ends() {
    let given = [("go", "0 1 1 1")];
    let trace = stable(&held_by_an_edge(1), &given);
    assert_eq!(trace.column("L"), "1,1,2,2", "free in the next scan");
    let trace = stable(&held_by_an_edge(3), &given);
    assert_eq!(trace.column("M"), "1,4,4,4");
    assert_eq!(trace.column("L"), "1,2,2,2", "free in the third round");
}

#[test]
fn an_order_of_the_only_round_holds_through_the_next_scan() {
    let program = "
        input go
        graph H { always { F/L:{1} IF ↑go } }
        graph L { initial step 1; step 2; transition 1: 1 -> 2 when go }
    ";
    assert_eq!(stable(program, &[("go", "0 1 1 1")]).column("L"), "1,1,1,2");
}

#[test]
fn orders_see_what_the_round_before_stored() {
    let program = "
        input a
        var n : int = 0
        graph H { always { F/L:{3} IF n = 1 } }
        graph L { initial step 1; step 2; step 3 }
        graph K { initial step 1; step 2; transition 1: 1 -> 2 when a do { n = 1 } }
    ";
    let given = [("a", "0 1 1")];
    assert_eq!(stable(program, &given).column("L"), "1,3,3");
    assert_eq!(
        run(program, &given).column("L"),
        "1,1,3",
        "a scan later without rounds"
    );
}

#[test]
fn edges_of_triggers_keep_the_memory_of_the_first_round() {
    let program = "
        input a
        var n : int = 0
        graph G {
            initial step 1
            step 2
            step 3
            transition 1: 1 -> 2 when a do { n = 1 }
            transition 2: 2 -> 3
        }
        graph Passed { initial step 1; step 2; transition 1: 1 -> 2 when ↑G:X2 }
        graph Reached { initial step 1; step 2; transition 1: 1 -> 2 when ↑G:X3 }
        graph Stored { initial step 1; step 2; transition 1: 1 -> 2 when ↑(n = 1) }
        graph Timed { initial step 1; step 2; transition 1: 1 -> 2 when ↑(T/G:X2/0s) }
    ";
    let trace = stable(program, &[("a", "0 1 1 1")]);
    assert_eq!(trace.column("G"), "1,3,3,3");
    assert_eq!(trace.column("Passed"), "1,1,1,1");
    assert_eq!(trace.column("Reached"), "1,1,2,2");
    assert_eq!(trace.column("Stored"), "1,1,2,2");
    assert_eq!(trace.column("Timed"), "1,1,2,2");
}

#[test]
fn a_step_passed_through_is_timed() {
    let program = "
        input a
        output Alone, Watched
        graph G {
            always { Alone IF T/X2/20ms; Watched IF T/X2 AND TRUE/20ms }
            initial step 1
            step 2
            step 3
            transition 1: 1 -> 2 when a
            transition 2: 2 -> 3
        }
        graph K { initial step 1; step 2; transition 1: 1 -> 2 when T/G:X2/20ms }
        graph L { initial step 1; step 2; transition 1: 1 -> 2 when T/G:X2 AND TRUE/20ms }
    ";
    let trace = stable(program, &[("a", "0 1 1 1 1")]);
    assert_eq!(trace.column("Alone"), "0,0,0,1,1");
    assert_eq!(
        trace.column("Watched"),
        "0,0,0,0,0",
        "after the last round it is over"
    );
    assert_eq!(trace.column("K"), "1,1,1,2,2");
    assert_eq!(
        trace.column("L"),
        "1,1,1,2,2",
        "a trigger watches in every round"
    );
}

#[test]
fn an_edge_inside_an_enable_falls_in_the_second_round() {
    let program = "
        input a, go
        graph G { initial step 1; step 2; transition 1: 1 -> 2 when T/NOT ↑a/20ms }
        graph K {
            initial step 1
            step 2
            transition 1: 1 -> 2 when go
        }
    ";
    let two = stable(program, &[("a", "0 1 1 1 1"), ("go", "0 1 1 1 1")]);
    assert_eq!(two.column("G"), "1,1,1,2,2", "risen in scan 1");
    let one = stable(program, &[("a", "0 1 1 1 1"), ("go", "0 0 0 0 0")]);
    assert_eq!(one.column("G"), "1,1,1,1,2", "risen in scan 2");
}

#[test]
fn edges_in_do_and_on_are_those_of_the_end_of_the_first_round() {
    let program = "
        input a
        var n : int = 0
        graph G {
            initial step 1
            step 2 { on deactivation: n = n + 1 IF ↑X2 }
            step 3 { on activation: n = n + 10 IF ↑a; on activation: n = n + 100 IF ↑X3 }
            transition 1: 1 -> 2 when a
            transition 2: 2 -> 3 do { n = n + 1000 IF ↑X2 }
        }
    ";
    assert_eq!(
        stable(program, &[("a", "0 1 1")]).column("n"),
        "0,1011,1011"
    );
}

#[test]
fn edges_and_timers_in_plain_actions_see_what_the_rounds_stored() {
    let program = "
        input a
        output P, Q
        var n : int = 0
        graph G {
            always { P IF ↑(n = 1); Q IF T/n = 1/0s AND NOT T/n = 1/10ms }
            initial step 1
            step 2
            transition 1: 1 -> 2 when a do { n = 1 }
        }
    ";
    let given = [("a", "0 1 1 1")];
    let trace = stable(program, &given);
    assert_eq!(trace.column("P"), "0,1,0,0");
    assert_eq!(trace.column("Q"), "0,1,0,0");
    let trace = run(program, &given);
    assert_eq!(trace.column("P"), "0,0,1,0", "a scan later without rounds");
    assert_eq!(trace.column("Q"), "0,0,1,0");
}

#[test]
fn a_step_left_and_entered_in_one_scan_is_activated_and_timed_anew_but_is_no_edge() {
    let program = "
        input a
        output Rise, Fall, Timed
        var n : int = 0
        graph G {
            always { Rise IF ↑X1; Fall IF ↓X1; Timed IF T/X1/20ms }
            initial step 1 { on activation: n = n + 1; on deactivation: n = n + 10 }
            step 2
            transition 1: 1 -> 2 when ↑a
            transition 2: 2 -> 1
        }
    ";
    let trace = stable(program, &[("a", "0 0 0 1 0 0")]);
    assert_eq!(trace.column("G"), "1,1,1,1,1,1");
    assert_eq!(trace.column("n"), "1,1,1,12,12,12");
    assert_eq!(trace.column("Rise"), "1,0,0,0,0,0");
    assert_eq!(trace.column("Fall"), "0,0,0,0,0,0");
    assert_eq!(trace.column("Timed"), "0,0,1,0,0,1");
}

#[test]
fn an_event_runs_in_the_first_round_for_the_steps_active_before_it() {
    let program = "
        input a
        var n : int = 0
        graph G {
            initial step 1 { on event ↑a: n = n + 1 }
            step 2 { on event ↑a: n = n + 10; on event ↓X1: n = n + 100 }
            step 3
            transition 1: 1 -> 2 when ↑a
            transition 2: 2 -> 3 when ↑a
        }
    ";
    let trace = stable(program, &[("a", "0 1 1 0 1")]);
    assert_eq!(trace.column("G"), "1,2,2,2,3");
    assert_eq!(trace.column("n"), "0,1,101,101,111");
}

#[test]
fn statements_run_round_by_round() {
    let program = "
        input a
        var n : int = 0
        graph A {
            initial step 1
            step 2 { on activation: n = n * 10 + 2 }
            step 3 { on activation: n = n * 10 + 4 }
            transition 1: 1 -> 2 when a do { n = n * 10 + 1 }
            transition 2: 2 -> 3 do { n = n * 10 + 3 }
        }
        graph B {
            always { n = n * 10 + 7 IF ↑A:X3 }
            initial step 1
            step 2 { on activation: n = n * 10 + 6 }
            transition 1: 1 -> 2 when A:X3 do { n = n * 10 + 5 }
        }
    ";
    assert_eq!(
        stable(program, &[("a", "0 1 1")]).column("n"),
        "0,1234567,1234567"
    );
}

#[test]
fn an_enclosed_graph_begins_and_ends_with_a_step_passed_through() {
    let program = "
        input a
        var n : int = 0
        graph Outer {
            initial step 1
            step 2 encloses Inner{5}
            step 3
            transition 1: 1 -> 2 when a
            transition 2: 2 -> 3
        }
        graph Inner {
            step 5 { on activation: n = n + 1; on deactivation: n = n + 10 }
            step 6 { on activation: n = n + 100 }
            transition 1: 5 -> 6 do { n = n + 1000 }
        }
    ";
    let trace = stable(program, &[("a", "0 1 1")]);
    assert_eq!(trace.column("Outer"), "1,3,3");
    assert_eq!(trace.column("Inner"), ",,");
    assert_eq!(trace.column("n"), "0,11,11");
}

#[test]
fn an_enclosing_step_entered_again_in_a_later_round_gives_its_set_again() {
    let program = "
        input a
        graph Outer {
            initial step 1 encloses Inner{5}
            step 2
            transition 1: 1 -> 2 when ↑a
            transition 2: 2 -> 1
        }
        graph Inner { step 5; step 6; step 7; transition 1: 5 -> 6 when a; transition 2: 6 -> 7 when NOT a }
    ";
    let trace = stable(program, &[("a", "0 1 0 1")]);
    assert_eq!(trace.column("Inner"), "5,6,7,6");
}

/// A chain of so many transitions that `a` starts, shown with `System:unstable` and who sees it.
fn chain(transitions: usize) -> crate::run::Trace {
    let steps: String = (2..=transitions + 1)
        .map(|step| {
            let last = step - 1;
            let when = if last == 1 { "when a" } else { "" };
            format!(
                "step {step} {{ on activation: seen = seen + 1 IF System:unstable }}
                 transition {last}: {last} -> {step} {when}\n"
            )
        })
        .collect();
    let program = format!(
        "input a
         output U
         var seen : int = 0
         graph G {{ always {{ U IF System:unstable }}; initial step 1; {steps} }}
         graph K {{ initial step 1; step 2; transition 1: 1 -> 2 when System:unstable }}"
    );
    stable(&program, &[("a", "0 1 1 1")])
}

#[test]
fn the_hundredth_round_has_to_change_nothing() {
    let trace = chain(99);
    assert_eq!(trace.column("G"), "1,100,100,100");
    assert_eq!(trace.column("U"), "0,0,0,0");
    assert_eq!(trace.column("K"), "1,1,1,1");
    let trace = chain(100);
    assert_eq!(trace.column("G"), "1,101,101,101");
    assert_eq!(trace.column("U"), "0,1,0,0");
    assert_eq!(trace.column("K"), "1,1,2,2", "triggers see it a scan later");
}

#[test]
fn an_evolution_stopped_as_unstable_goes_on_in_the_next_scan() {
    let trace = chain(150);
    assert_eq!(trace.column("G"), "1,101,151,151");
    assert_eq!(trace.column("U"), "0,1,0,0");
    assert_eq!(trace.column("seen"), "0,0,50,50", "until a scan settles");
}

#[test]
fn plants_have_rounds_too_and_are_never_the_unstable_program() {
    let program = "
        evolution stable
        input i
        output O, U
        graph G { initial step 1 { O }; always { U IF System:unstable OR i } }
        plant P { initial step 1; step 2; transition 1: 1 -> 2 when O; transition 2: 2 -> 1 when O }
    ";
    assert_eq!(run_with(program, &["P"], 3).column("U"), "0,0,0");
}
