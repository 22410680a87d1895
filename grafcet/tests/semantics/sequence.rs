//! `semantics.md`, phase 6: the order of stored statements between graphs, expansions and instances.

use crate::run::run;

#[test]
fn each_group_runs_through_all_graphs_in_source_order() {
    let program = "
        input go
        var n : int = 0
        graph B {
            initial step 1 { on deactivation: n = n * 10 + 4 }
            step 2
            transition 9: 1 -> 2 when go do { n = n * 10 + 1 }
            always { n = n * 10 + 7 IF ↑go }
        }
        graph A {
            initial step 1 { on deactivation: n = n * 10 + 5 }
            step 2 { on activation: n = n * 10 + 6 }
            step 3
            transition 2: 1 -> 2 when go do { n = n * 10 + 2 }
            transition 1: 1 -> 3 when go do { n = n * 10 + 3 }
            always { n = n * 10 + 8 IF ↑go }
        }
    ";
    let trace = run(program, &[("go", "0 1 1")]);
    assert_eq!(trace.column("n"), "0,12345678,12345678");
}

#[test]
fn an_expansion_stands_in_the_place_of_its_macro_step() {
    let program = "
        input go
        var n : int = 0
        graph A {
            step 3 { on activation: n = n * 10 + 1 }
            macro step M4 {
                entry step E4 { on activation: n = n * 10 + 2 }
                exit step S4
                transition 7: E4 -> S4
            }
            step 5 { on activation: n = n * 10 + 3 }
            initial step 1
            transition 1: 1 -> 5, M4, 3 when go
        }
    ";
    let trace = run(program, &[("go", "0 1 1")]);
    assert_eq!(trace.column("n"), "0,123,123");
    assert_eq!(trace.column("A"), "1,3 E4 5,3 S4 5");
}

#[test]
fn an_instance_stands_where_it_is_written() {
    let graph = |name: &str, digit: u8| {
        format!(
            "graph {name} {{
                 initial step 1
                 step 2 {{ on activation: n = n * 10 + {digit} }}
                 transition 1: 1 -> 2 when go
             }}\n"
        )
    };
    let program = format!(
        "input go
         var n : int = 0
         template T {{
             input g
             initial step 1
             step 2 {{ on activation: n = n * 10 + 1 }}
             transition 1: 1 -> 2 when g
         }}
         {}
         graph Middle = T {{ g = go }}
         {}",
        graph("First", 2),
        graph("Last", 3)
    );
    assert_eq!(run(&program, &[("go", "0 1")]).column("n"), "0,213");
}

#[test]
fn an_event_sees_what_a_trigger_sees_and_its_statement_what_is_newest() {
    let program = "
        input go
        output Event, Late
        var v : int = 0
        graph G {
            initial step 1 {
                on event ↑go AND v = 1 AND X1 AND NOT X2: Event = True
                on event ↑go: Late = True IF v = 7 AND X2
            }
            step 2
            always { v = v + 1 IF NOT go }
            transition 1: 1 -> 2 when go do { v = 7 }
        }
    ";
    let trace = run(program, &[("go", "0 1 1")]);
    assert_eq!(trace.column("Event"), "0,1,1");
    assert_eq!(trace.column("Late"), "0,1,1");
}

#[test]
fn statements_on_activation_and_deactivation_see_momentary_variables_of_the_scan_before() {
    let program = "
        input go
        output M
        var n : int = 0
        graph B {
            initial step 1
            step 2 { M; on activation: n = n + 1 IF M; on deactivation: n = n + 10 IF M }
            transition 1: 1 -> 2 when go
            transition 2: 2 -> 1 when M
        }
    ";
    let trace = run(program, &[("go", "0 1 0 0")]);
    assert_eq!(trace.column("B"), "1,2,1,1");
    assert_eq!(trace.column("n"), "0,0,10,10");
}

#[test]
fn the_edge_in_a_value_is_that_of_the_action() {
    let program = "
        input a, go
        var v : bool
        graph G { initial step 1; step 2 { v = ↑a }; transition 1: 1 -> 2 when go }
    ";
    let trace = run(program, &[("a", "0 1 1 0 1 1"), ("go", "0 0 1 0 0 0")]);
    assert_eq!(trace.column("v"), "0,0,0,0,1,0");
}

#[test]
fn momentary_variables_do_not_depend_on_what_edges_and_timers_name() {
    let program = "
        input a
        output A, B, C, D
        graph G { always { A IF B OR ↑A; B IF C AND NOT T/B/0s; C IF a; D IF ↓A } }
    ";
    let trace = run(program, &[("a", "0 1 1 0 0 1")]);
    assert_eq!(trace.column("C"), "0,1,1,0,0,1");
    assert_eq!(trace.column("B"), "0,1,0,0,0,0");
    assert_eq!(trace.column("A"), "0,1,1,0,0,0");
    assert_eq!(trace.column("D"), "0,0,0,0,1,0");
}
