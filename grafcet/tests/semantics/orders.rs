//! `semantics.md`, phase 4: what forcing orders see, which of them wins, and when they end.

use crate::run::{run, run_scans};

#[test]
fn of_two_graphs_side_by_side_the_one_taken_first_wins() {
    let program = "
        graph A { initial step 1 { F/Low:{2} } }
        graph B { initial step 1 { F/Low:{3} } }
        graph Low { initial step 1; step 2; step 3 }
    ";
    assert_eq!(run_scans(program, 1).column("Low"), "2");
    let below = "graph Last { initial step 1 { F/A:{1} } }";
    let trace = run_scans(&format!("{program}\n{below}"), 1);
    assert_eq!(trace.column("Low"), "3", "A has to wait for its superior");
}

#[test]
fn orders_go_down_a_chain_in_one_scan() {
    let program = "
        input go
        graph Low { initial step 1; step 2; step 3 }
        graph Middle { initial step 1; step 2 { F/Low:{3} } }
        graph Top { initial step 1; step 2 { F/Middle:{2} }; transition 1: 1 -> 2 when go }
    ";
    let trace = run(program, &[("go", "0 1 0")]);
    assert_eq!(trace.column("Middle"), "1,2,2");
    assert_eq!(trace.column("Low"), "1,3,3");
}

#[test]
fn a_step_that_an_order_keeps_out_gives_no_orders() {
    let program = "
        input a
        graph Top { always { F/Middle:{1} IF a } }
        graph Middle { initial step 1; step 2 { F/Low:{2} }; transition 1: 1 -> 2 when a }
        graph Low { initial step 1; step 2 }
    ";
    let trace = run(program, &[("a", "0 1 0")]);
    assert_eq!(trace.column("Middle"), "1,1,1");
    assert_eq!(trace.column("Low"), "1,1,1");
}

#[test]
fn the_later_statement_wins_whether_of_a_step_or_standing_alone() {
    let program = "
        graph A { initial step 1 { F/C:{2} }; always { F/C:{3} } }
        graph B { always { F/D:{3} }; initial step 1 { F/D:{2} } }
        graph C { initial step 1; step 2; step 3 }
        graph D { initial step 1; step 2; step 3 }
    ";
    let trace = run_scans(program, 1);
    assert_eq!(trace.column("C"), "3");
    assert_eq!(trace.column("D"), "2");
}

#[test]
fn an_order_of_a_graph_on_itself_ranks_last() {
    let program = "
        graph H { always { F/L:{2} IF System:first_scan } }
        graph L { always { F/L:{3} }; initial step 1; step 2; step 3 }
    ";
    assert_eq!(run_scans(program, 3).column("L"), "2,3,3");
}

#[test]
fn a_condition_sees_its_own_graph_as_fired_and_voids_that() {
    let program = "
        var n : int = 0
        graph G {
            always { F/G:{1} IF X2 }
            initial step 1
            step 2 { on activation: n = n + 1 }
            transition 1: 1 -> 2 do { n = n + 10 }
        }
    ";
    let trace = run_scans(program, 4);
    assert_eq!(trace.column("G"), "1,1,1,1");
    assert_eq!(trace.column("n"), "0,0,0,0");
}

#[test]
fn an_edge_in_a_condition_remembers_what_was_fired_and_voided() {
    let own = "
        graph G {
            always { F/G:{1} IF ↑X2 }
            initial step 1
            step 2
            transition 1: 1 -> 2
        }
    ";
    let lower = "
        graph H { always { F/G:{1} IF ↑G:X2 } }
        graph G { initial step 1; step 2; transition 1: 1 -> 2 }
    ";
    for program in [own, lower] {
        assert_eq!(run_scans(program, 5).column("G"), "1,1,1,2,2");
    }
}

#[test]
fn one_text_is_watched_apart_above_and_below_the_graph_it_names() {
    let program = "
        input a
        graph Above { always { F/X:{2} IF L:X2; F/L:{1} IF a } }
        graph L { initial step 1; step 2 { F/Below:{1} }; transition 1: 1 -> 2 }
        graph Below { initial step 1; always { F/Y:{2} IF L:X2 } }
        graph X { initial step 1; step 2 }
        graph Y { initial step 1; step 2 }
    ";
    let trace = run(program, &[("a", "0 1 1")]);
    assert_eq!(trace.column("L"), "1,1,1");
    assert_eq!(trace.column("X"), "1,2,2", "as fired");
    assert_eq!(trace.column("Y"), "1,1,1", "as it came to be");
}

#[test]
fn a_timer_in_a_condition_starts_with_a_step_as_fired() {
    let lower = |condition: &str| {
        format!(
            "input a
             graph H {{ always {{ F/L:{{1}} IF {condition} }} }}
             graph L {{ initial step 1; step 2; transition 1: 1 -> 2 when a }}"
        )
    };
    let always = [("a", "0 1 1 1 1 1 1 1")];
    let trace = run(&lower("T/L:X2/0s"), &always);
    assert_eq!(trace.column("L"), "1,1,1,1,1,1,1,1");
    let trace = run(&lower("T/L:X2/10ms"), &always);
    assert_eq!(trace.column("L"), "1,2,1,1,2,1,1,2");
    let trace = run(&lower("10ms/L:X2"), &always);
    assert_eq!(trace.column("L"), "1,2,1,1,2,1,1,2");
}

#[test]
fn a_void_activation_is_none_for_a_timer_of_a_step_standing_alone() {
    let program = "
        input a
        graph H { always { F/L:{1} IF T/L:X2/10ms } }
        graph L { initial step 1; step 2; transition 1: 1 -> 2 when a }
    ";
    // Scan 3 fires in vain and stays under the order of scan 2; in scan 4 the timer runs from scan 1 again.
    let trace = run(program, &[("a", "0 1 0 1 0 1 1 1")]);
    assert_eq!(trace.column("L"), "1,2,1,1,1,1,2,1");
}

#[test]
fn edges_and_timers_of_conditions_go_on_while_their_step_sleeps() {
    let program = |condition: &str| {
        format!(
            "input a, go
             graph H {{
                 initial step 1
                 step 2 {{ F/L:{{2}} IF {condition} }}
                 transition 1: 1 -> 2 when go
             }}
             graph L {{ initial step 1; step 2 }}"
        )
    };
    let trace = run(
        &program("↑a"),
        &[("a", "0 0 1 1 0 1"), ("go", "0 0 0 1 0 0")],
    );
    assert_eq!(trace.column("L"), "1,1,1,1,1,2");
    let trace = run(
        &program("T/a/20ms"),
        &[("a", "0 1 0 0 0 0"), ("go", "0 0 0 0 1 0")],
    );
    assert_eq!(trace.column("L"), "1,1,1,1,2,2");
}

#[test]
fn the_scan_in_which_an_order_ends_is_void_too() {
    let program = "
        input f
        var n : int = 0
        graph H { always { F/L:{1} IF f } }
        graph L { initial step 1; step 2; transition 1: 1 -> 2 do { n = n + 1 } }
    ";
    let trace = run(program, &[("f", "1 1 0 0")]);
    assert_eq!(trace.column("L"), "1,1,1,2");
    assert_eq!(trace.column("n"), "0,0,0,1");
}

#[test]
fn one_order_follows_another_without_a_free_scan() {
    let program = "
        input a, b
        graph H { always { F/L:{2} IF a }; initial step 1 }
        graph L {
            always { F/L:{3} IF b }
            initial step 1
            step 2
            step 3
            transition 1: 2 -> 1
            transition 2: 3 -> 1
        }
    ";
    let trace = run(program, &[("a", "0 1 0 0 0 0"), ("b", "0 0 1 0 0 0")]);
    assert_eq!(trace.column("L"), "1,2,3,3,1,1");
}

#[test]
fn an_order_activates_and_deactivates_and_events_pass_through_it() {
    let program = "
        input frozen, e
        var n : int = 0
        graph H { always { F/L:{*} IF frozen; F/L:{3} IF e } }
        graph L {
            initial step 1 { on event ↑e: n = n + 1; on deactivation: n = n + 10 }
            step 2
            step 3 { on activation: n = n + 100 }
            transition 1: 1 -> 2 when e do { n = n + 1000 }
        }
    ";
    let trace = run(program, &[("frozen", "1 1 1 1"), ("e", "0 0 1 1")]);
    assert_eq!(trace.column("L"), "1,1,3,3");
    assert_eq!(trace.column("n"), "0,0,111,111");
}

#[test]
fn a_source_of_a_forced_graph_waits() {
    let program = "
        input f
        graph H { always { F/L:{} IF f; F/M:{I} IF f } }
        graph L { step 1; transition 1: -> 1 }
        graph M { step 1; transition 1: -> 1 }
    ";
    let trace = run(program, &[("f", "0 0 1 0 0")]);
    assert_eq!(trace.column("L"), ",1,,,1");
    assert_eq!(trace.column("M"), ",1,,,1", "{{I}} without initial steps");
}

#[test]
fn every_instance_gives_the_orders_of_its_template() {
    let program = "
        input a, b
        template T {
            input i
            initial step 1
            step 2 { F/L:{2} }
            transition 1: 1 -> 2 when i
            transition 2: 2 -> 1 when NOT i
        }
        graph A = T { i = a }
        graph B = T { i = b }
        graph L { initial step 1; step 2; transition 1: 2 -> 1 }
    ";
    let trace = run(program, &[("a", "0 1 0 0 0"), ("b", "0 0 0 1 0")]);
    assert_eq!(trace.column("L"), "1,2,2,2,2");
}
