//! `semantics.md`, phase 4: enclosed graphs, where it meets orders, activation and sources.

use crate::run::{run, run_scans};

#[test]
fn a_graph_frozen_as_its_step_begins_stays_empty() {
    let program = "
        input go, hold
        graph Outer {
            always { F/Inner:{*} IF hold }
            initial step 1
            step 2 encloses Inner{5}
            transition 1: 1 -> 2 when go
            transition 2: 2 -> 1 when NOT go
        }
        graph Inner { step 5; step 6; transition 1: 5 -> 6 }
    ";
    let trace = run(
        program,
        &[("go", "0 1 1 1 1 0 1 1"), ("hold", "0 1 1 0 0 0 0 0")],
    );
    assert_eq!(trace.column("Inner"), ",,,,,,5,6");
}

#[test]
fn an_order_goes_before_the_set_and_not_before_the_enclosing_step() {
    let program = "
        input go, f
        graph Outer {
            always { F/Inner:{I} IF f }
            initial step 1
            step 2 encloses Inner{5}
            transition 1: 1 -> 2 when go
            transition 2: 2 -> 1 when NOT go
        }
        graph Inner { step 5; initial step 6; step 7; transition 1: 6 -> 7 when go }
    ";
    let trace = run(program, &[("go", "0 1 1 1 0"), ("f", "1 1 0 0 1")]);
    assert_eq!(trace.column("Inner"), ",6,6,7,");
}

#[test]
fn an_order_given_while_no_step_encloses_leaves_nothing_behind() {
    let program = "
        input go, f
        graph Outer {
            always { F/Inner:{6} IF f }
            initial step 1
            step 2 encloses Inner{5}
            transition 1: 1 -> 2 when go
        }
        graph Inner { step 5; step 6; transition 1: 5 -> 6 }
    ";
    let trace = run(program, &[("go", "0 0 1 0 0"), ("f", "1 1 0 0 0")]);
    assert_eq!(trace.column("Inner"), ",,5,6,6");
}

#[test]
fn each_enclosing_step_that_begins_gives_its_set_though_another_is_active() {
    let program = "
        input go
        graph Outer {
            initial step 1 encloses Inner{5}
            initial step 2
            step 3 encloses Inner{6}
            transition 1: 2 -> 3 when go
            transition 2: 3 -> 2 when NOT go
        }
        graph Inner {
            step 5
            step 6
            step 7
            transition 1: 5 -> 7
            transition 2: 6 -> 7
        }
    ";
    let trace = run(program, &[("go", "0 0 1 0 0")]);
    assert_eq!(trace.column("Inner"), "5,7,6,7,7");
}

#[test]
fn of_several_steps_that_begin_the_last_in_the_source_gives_the_set() {
    let program = "
        input go
        graph Outer {
            initial step 1
            step 2 encloses Inner{6}
            step 3 encloses Inner{5}
            transition 1: 1 -> 3, 2 when go
        }
        graph Inner { step 5; step 6 }
    ";
    assert_eq!(run(program, &[("go", "0 1")]).column("Inner"), ",5");
}

#[test]
fn an_enclosing_step_left_and_entered_at_once_does_not_begin() {
    let program = "
        input a
        graph Outer { initial step 1 encloses Inner{5}; transition 1: 1 -> 1 when a }
        graph Inner { step 5; step 6; transition 1: 5 -> 6 }
    ";
    assert_eq!(run(program, &[("a", "0 1 1")]).column("Inner"), "5,6,6");
}

#[test]
fn a_set_that_is_active_already_activates_nothing_and_voids_what_fired() {
    let program = "
        input a
        var n : int = 0
        graph Outer {
            initial step 1 encloses Inner{5}
            step 2 encloses Inner{5}
            transition 1: 1 -> 2 when a
        }
        graph Inner {
            step 5 { on activation: n = n + 1; on deactivation: n = n + 10 }
            step 6
            transition 1: 5 -> 6 when a do { n = n + 100 }
        }
    ";
    let trace = run(program, &[("a", "0 1 0")]);
    assert_eq!(trace.column("Inner"), "5,5,5");
    assert_eq!(trace.column("n"), "1,1,1");
}

#[test]
fn a_source_that_fires_as_its_graph_is_emptied_has_not_fired() {
    let program = "
        input go
        var n : int = 0
        var zero : int = 0
        var faults : int = 0
        graph Outer {
            always { faults = System:arithmetic_faults; zero = 0 }
            initial step 1
            step 2 encloses Inner{}
            transition 1: 1 -> 2 when go
            transition 2: 2 -> 1 when NOT go
        }
        graph Inner { step 5; transition 1: -> 5 when 1 / zero = 0 do { n = n + 1 } }
    ";
    let trace = run(program, &[("go", "0 1 1 1 0 0")]);
    assert_eq!(trace.column("Inner"), ",,5,5,,");
    assert_eq!(trace.column("n"), "0,0,1,2,2,2");
    assert_eq!(trace.column("faults"), "0,0,1,2,3,3", "but it was armed");
}

#[test]
fn events_and_deactivations_of_an_emptied_graph_run() {
    let program = "
        input go
        var n : int = 0
        graph Outer { initial step 1 encloses Inner{5}; step 2; transition 1: 1 -> 2 when go }
        graph Inner {
            step 5 { on event ↑go: n = n + 1; on deactivation: n = n + 10 IF n = 1 }
            step 6
            transition 1: 5 -> 6 when go do { n = n + 100 }
        }
    ";
    assert_eq!(run(program, &[("go", "0 1 1")]).column("n"), "0,11,11");
}

#[test]
fn an_order_into_an_enclosing_step_starts_what_it_encloses() {
    let program = "
        input a
        graph H { always { F/Outer:{2} IF a } }
        graph Outer { initial step 1; step 2 encloses Inner{5}; transition 1: 2 -> 1 }
        graph Inner { step 5; step 6; transition 1: 5 -> 6 }
    ";
    let trace = run(program, &[("a", "0 1 1 0 0")]);
    assert_eq!(trace.column("Outer"), "1,2,2,2,1");
    assert_eq!(trace.column("Inner"), ",5,6,6,");
}

#[test]
fn an_empty_enclosed_graph_gives_the_orders_of_its_stand_alone_actions() {
    let program = "
        input a
        graph Outer { initial step 1; step 2 encloses Inner{5} }
        graph Inner { always { F/Low:{2} IF a; F/Inner:{5} IF a }; step 5 }
        graph Low { initial step 1; step 2 }
    ";
    let trace = run(program, &[("a", "0 1 0")]);
    assert_eq!(trace.column("Inner"), ",,");
    assert_eq!(trace.column("Low"), "1,2,2");
}

#[test]
fn steps_of_an_expansion_enclose_like_others() {
    let program = "
        graph Outer {
            initial step 1
            macro step M2 {
                entry step E2 encloses A{1}, B{2}
                exit step S2 encloses A{2}
                transition 1: E2 -> S2 when T/XE2/20ms
            }
            transition 2: 1 -> M2
            transition 3: M2 -> 1 when T/XS2/20ms
        }
        graph A { step 1; step 2; step 3; transition 1: 1 -> 3; transition 2: 2 -> 3 }
        graph B { step 2 }
    ";
    let trace = run_scans(program, 7);
    assert_eq!(trace.column("A"), ",1,3,2,3,,1");
    assert_eq!(trace.column("B"), ",2,2,,,,2");
}
