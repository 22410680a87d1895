//! `semantics.md`, phase 4: enclosing and forcing.

use crate::run::{run, run_scans};

/// A graph `L` below, which counts its activations and goes round with `b`.
const LOWER: &str = "
    graph L {
        var n : int = 0
        initial step 1
        step 2 { on activation: n = n + 1 }
        step 3
        transition 1: 1 -> 2 when b do { fired = fired + 1 }
        transition 2: 2 -> 3 when b
        transition 3: 3 -> 1 when b
    }
";

/// Runs `L` under a stand-alone forcing statement of a graph above it.
fn force(order: &str, inputs: &[(&str, &str)]) -> crate::run::Trace {
    let program = format!(
        "input a, b
         var fired : int = 0
         graph H {{ always {{ {order} }}; initial step 1 }}
         {LOWER}"
    );
    run(&program, inputs)
}

#[test]
fn an_order_acts_in_the_scan_that_gives_it_and_voids_what_fired() {
    let trace = force("F/L:{3} IF a", &[("a", "0 0 1 0 0"), ("b", "0 0 1 0 0")]);
    assert_eq!(trace.column("L"), "1,1,3,3,3");
    assert_eq!(
        trace.column("fired"),
        "0,0,0,0,0",
        "its transition has not fired"
    );
    assert_eq!(trace.column("L:n"), "0,0,0,0,0");
}

#[test]
fn a_graph_is_free_from_the_scan_after_the_order_ends() {
    let trace = force("F/L:{1} IF a", &[("a", "0 1 0 0 0"), ("b", "0 1 1 1 1")]);
    assert_eq!(trace.column("L"), "1,1,1,2,3");
}

#[test]
fn edges_pass_and_are_lost_under_an_order() {
    let program = "
        input a, b
        graph H { always { F/L:{*} IF a }; initial step 1 }
        graph L {
            initial step 1
            step 2
            transition 1: 1 -> 2 when ↑b
        }
    ";
    let trace = run(program, &[("a", "0 1 1 0 0 0"), ("b", "0 0 1 1 0 1")]);
    assert_eq!(trace.column("L"), "1,1,1,1,1,2");
}

#[test]
fn forcing_what_is_already_active_is_no_activation_and_no_new_time() {
    let program = "
        input a
        graph H { always { F/L:{2} IF a }; initial step 1 }
        graph L {
            var n : int = 0
            initial step 1
            step 2 { on activation: n = n + 1; n = n + 100 IF T/X2/30ms AND NOT T/X2/40ms }
        }
    ";
    let trace = run(program, &[("a", "0 1 1 1 1 1")]);
    assert_eq!(trace.column("L"), "1,2,2,2,2,2");
    assert_eq!(trace.column("L:n"), "0,1,1,1,101,101");
}

#[test]
fn star_keeps_the_situation_before_the_scan() {
    let trace = force(
        "F/L:{*} IF a",
        &[("a", "0 0 1 1 0 0"), ("b", "0 1 1 1 1 1")],
    );
    assert_eq!(trace.column("L"), "1,2,2,2,2,3");
}

#[test]
fn the_empty_set_empties_and_i_initialises() {
    let trace = force(
        "F/L:{} IF a AND NOT b; F/L:{I} IF a AND b",
        &[("a", "0 0 1 1 0"), ("b", "0 1 0 1 0")],
    );
    assert_eq!(trace.column("L"), "1,2,,1,1");
}

#[test]
fn a_forced_graph_executes_the_actions_of_its_active_steps() {
    let program = "
        input a
        output M
        graph H { always { F/L:{2} IF a }; initial step 1 }
        graph L { initial step 1; step 2 { M } }
    ";
    assert_eq!(run(program, &[("a", "0 1 1 0")]).column("M"), "0,1,1,1");
}

#[test]
fn an_initial_step_that_an_order_removes_never_was_active() {
    let program = "
        output M
        graph H { initial step 1 { F/L:{2} } }
        graph L {
            var n : int = 0
            initial step 1 { M; on activation: n = n + 1; on deactivation: n = n + 10 }
            step 2 { on activation: n = n + 100 }
        }
    ";
    let trace = run_scans(program, 2);
    assert_eq!(trace.column("L"), "2,2");
    assert_eq!(trace.column("M"), "0,0");
    assert_eq!(trace.column("L:n"), "100,100");
}

#[test]
fn of_two_orders_the_higher_graph_and_in_one_graph_the_later_statement_wins() {
    let program = "
        input a
        graph Top {
            initial step 1 { F/Middle:{1} }
            always { F/Low:{2} IF a }
        }
        graph Middle { initial step 1 { F/Low:{1} } }
        graph Low { initial step 1; step 2; step 3 }
        graph Twice { initial step 1 { F/Other:{3}; F/Other:{2} } }
        graph Other { initial step 1; step 2; step 3 }
    ";
    let trace = run(program, &[("a", "0 1 0")]);
    assert_eq!(trace.column("Low"), "1,2,1");
    assert_eq!(trace.column("Other"), "2,2,2");
}

#[test]
fn superiors_are_taken_first_wherever_they_stand_in_the_source() {
    let program = "
        input go
        graph Low { initial step 1; step 2; transition 1: 1 -> 2 when False AND go }
        graph Top {
            initial step 1
            step 2 { F/Low:{2} }
            transition 1: 1 -> 2 when go
        }
    ";
    let trace = run(program, &[("go", "0 1 0")]);
    assert_eq!(trace.column("Top"), "1,2,2");
    assert_eq!(trace.column("Low"), "1,2,2");
}

#[test]
fn a_stand_alone_action_may_force_its_own_graph() {
    let program = "
        input stop, go
        graph G {
            always { F/G:{1} IF stop }
            initial step 1
            step 2
            transition 1: 1 -> 2 when go
        }
    ";
    let trace = run(program, &[("stop", "0 0 1 0 0"), ("go", "0 1 1 1 1")]);
    assert_eq!(trace.column("G"), "1,2,1,1,2");
}

#[test]
fn the_edge_of_a_step_in_a_forcing_condition_is_that_of_this_scan() {
    let program = "
        input go
        graph H {
            always { F/L:{2} IF ↑X2 }
            initial step 1
            step 2
            transition 1: 1 -> 2 when go
        }
        graph L { initial step 1; step 2; transition 1: 2 -> 1 }
    ";
    let trace = run(program, &[("go", "0 1 0 0")]);
    assert_eq!(trace.column("L"), "1,2,2,1");
}

const ENCLOSED: &str = "
    input go, b
    output M
    graph Outer {
        initial step 1
        step 2 encloses Inner{5}
        transition 1: 1 -> 2 when go
        transition 2: 2 -> 1 when NOT go
    }
    graph Inner {
        step 5 { M }
        step 6
        transition 1: 5 -> 6 when b
    }
";

#[test]
fn an_enclosed_graph_takes_its_set_and_is_emptied_with_its_step() {
    let trace = run(ENCLOSED, &[("go", "0 1 1 1 0 1"), ("b", "0 1 0 1 0 0")]);
    assert_eq!(trace.column("Outer"), "1,2,2,2,1,2");
    assert_eq!(trace.column("Inner"), ",5,5,6,,5");
    assert_eq!(trace.column("M"), "0,1,1,0,0,1");
}

#[test]
fn an_initial_step_that_encloses_begins_with_the_graphs_own_initial_steps() {
    let program = "
        input go
        graph Outer {
            initial step 1 encloses Own{6}, Set{6}
            step 2
            transition 1: 1 -> 2 when go
            transition 2: 2 -> 1 when NOT go
        }
        graph Own { initial step 5; step 6 }
        graph Set { step 5; step 6 }
    ";
    let trace = run(program, &[("go", "0 1 0 0")]);
    assert_eq!(trace.column("Own"), "5,,6,6");
    assert_eq!(trace.column("Set"), "6,,6,6");
}

#[test]
fn a_source_in_an_enclosed_graph_sleeps_with_it() {
    let program = "
        input go
        graph Outer {
            initial step 1
            step 2 encloses Inner{}
            transition 1: 1 -> 2 when go
            transition 2: 2 -> 1 when NOT go
        }
        graph Inner { step 5; transition 1: -> 5 }
    ";
    let trace = run(program, &[("go", "0 1 1 1 0 0")]);
    assert_eq!(trace.column("Inner"), ",,5,5,,");
}

#[test]
fn stand_alone_actions_of_an_enclosed_graph_run_while_it_is_empty() {
    let program = "
        output M
        graph Outer { initial step 1; step 2 encloses Inner{5} }
        graph Inner { always { M }; step 5 }
    ";
    assert_eq!(run_scans(program, 2).column("M"), "1,1");
}

#[test]
fn a_macro_step_is_entered_and_left_through_its_entry_and_exit() {
    let program = "
        input go, b
        output P
        graph G {
            var n : int = 0
            initial step 1
            macro step M5 {
                entry step E5
                step 7
                exit step S5
                transition 1: E5 -> 7 when b
                transition 2: 7 -> S5 when b
            }
            transition 3: 1 -> M5 when go
            transition 4: M5 -> 1 when NOT go
            always { P IF XM5; n = n + 1 IF ↑XM5 }
        }
    ";
    let trace = run(program, &[("go", "0 1 1 0 0 0"), ("b", "0 0 1 0 1 0")]);
    assert_eq!(trace.column("G"), "1,E5,7,7,S5,1");
    assert_eq!(trace.column("P"), "0,1,1,1,1,0");
    assert_eq!(trace.column("G:n"), "0,1,1,1,1,1");
}

#[test]
fn a_macro_step_is_timed_like_a_step() {
    let program = "
        graph G {
            initial step 1
            macro step M5 {
                entry step E5
                exit step S5
                transition 1: E5 -> S5
            }
            step 9
            transition 2: 1 -> M5
            transition 3: M5 -> 9 when T/XM5/30ms
        }
    ";
    assert_eq!(run_scans(program, 5).column("G"), "1,E5,S5,S5,9");
}
