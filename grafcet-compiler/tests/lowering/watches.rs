//! Edges and timers: which have a memory, and when they are evaluated.

use grafcet_compiler::application::Tables;
use grafcet_core::program::{Edge, Op, Run, Unit, Watch};

use crate::{graph, tables};

fn of(tables: &Tables, run: Run) -> Vec<Watch> {
    run.of(&tables.watches).to_vec()
}

fn step_timers(tables: &Tables) -> usize {
    tables
        .ops
        .iter()
        .filter(|op| matches!(op, Op::StepTimer { .. }))
        .count()
}

#[test]
fn a_step_is_timed_by_its_activation_and_others_are_not_timed() {
    let tables = graph(
        "initial step 1; step 2\ntransition 1: 1 -> 2 when T/X1/2s AND a\ntransition 2: 2 -> 1 when p/X1 OR T/X1/p",
    );
    assert!(tables.watches.is_empty());
    assert_eq!(step_timers(&tables), 3);
    assert_eq!(tables.layout.stamps, 1);
    assert!(tables.steps[0].activated.is_some() && tables.steps[1].activated.is_none());
}

#[test]
fn an_integer_preset_counts_seconds() {
    let tables = graph("initial step 1\ntransition 1: 1 -> 1 when T/X1/3 AND T/X1/n");
    let units: Vec<Unit> = tables
        .ops
        .iter()
        .filter_map(|op| match op {
            Op::StepTimer { unit, .. } => Some(*unit),
            _ => None,
        })
        .collect();
    assert_eq!(units, [Unit::Milliseconds, Unit::Seconds]);
    assert!(tables.ops.contains(&Op::Constant(3000)));
}

#[test]
fn any_other_enable_is_watched_where_it_stands() {
    let tables = graph(
        "initial step 1 { M IF T/a AND b/2s }\ntransition 1: 1 -> 1 when 1s/a/2s\nalways { F/G:{} IF T/NOT X1/2s }",
    );
    assert!(matches!(
        of(&tables, tables.action_watches)[..],
        [Watch::Timer { .. }]
    ));
    assert!(matches!(
        of(&tables, tables.trigger_watches)[..],
        [Watch::OnDelay { .. }, Watch::OffDelay { .. }]
    ));
    assert!(matches!(
        of(&tables, tables.graphs[0].self_watches)[..],
        [Watch::Timer { .. }]
    ));
}

#[test]
fn an_off_delay_of_a_step_watches_its_on_delay() {
    let tables = graph("initial step 1\ntransition 1: 1 -> 1 when 1s/X1/2s");
    assert!(matches!(
        of(&tables, tables.trigger_watches)[..],
        [Watch::OffDelay { .. }]
    ));
    assert_eq!(step_timers(&tables), 1);
}

#[test]
fn a_preset_that_an_action_may_change_is_read_before_the_actions() {
    let tables = graph("initial step 1 { t = t + 1s; M IF T/X1/t; N IF T/X1/p; O IF T/X1/2s }");
    assert!(matches!(
        of(&tables, tables.action_watches)[..],
        [Watch::Value { gate: None, .. }]
    ));
    let tables = graph("initial step 1 { t = t + 1s }\ntransition 1: 1 -> 1 when T/X1/t");
    assert!(tables.watches.is_empty());
}

#[test]
fn a_preset_that_can_fault_is_read_in_every_scan() {
    let tables = graph("initial step 1\ntransition 1: 1 -> 1 when T/X1/(t * n)");
    assert!(matches!(
        of(&tables, tables.trigger_watches)[..],
        [Watch::Value { gate: None, .. }]
    ));
}

#[test]
fn one_edge_is_watched_once_in_each_phase() {
    let tables = graph(
        "initial step 1 { M IF ↑a; N IF ↑a AND b; O IF ↓a }\n\
         transition 1: 1 -> 1 when ↑a\ntransition 2: 1 -> 1 when ↑a AND b OR RE a\n\
         always { F/G:{} IF ↑a }",
    );
    assert_eq!(tables.trigger_watches.len, 1);
    assert_eq!(tables.action_watches.len, 2);
    assert_eq!(tables.graphs[0].self_watches.len, 1);
}

#[test]
fn the_forcing_of_a_graph_has_watches_of_its_own() {
    let tables = tables(
        "input a\ngraph A { initial step 1 { F/B:{1} IF ↑a }; always { F/B:{} IF ↓a; F/A:{} IF ↑a } }\n\
         graph B { initial step 1 { F/C:{*} IF ↑a } }\ngraph C { initial step 1 }",
    );
    let lengths = tables
        .graphs
        .iter()
        .map(|graph| (graph.watches.len, graph.self_watches.len));
    assert_eq!(lengths.collect::<Vec<_>>(), [(2, 1), (1, 0), (0, 0)]);
}

#[test]
fn only_a_rising_step_bit_in_an_action_counts_from_false() {
    let from_false = |tables: &Tables, run: Run| -> Vec<bool> {
        let edges = of(tables, run).into_iter();
        edges
            .filter_map(|watch| match watch {
                Watch::Edge { from_false, .. } => Some(from_false),
                _ => None,
            })
            .collect()
    };
    let tables = graph(
        "initial step 1 { M IF ↑X1; N IF ↓X1 OR ↑(X1 AND a) OR ↑a }\ntransition 1: 1 -> 1 when ↑X1\n\
         always { F/G:{} IF ↑X1 }",
    );
    assert_eq!(
        from_false(&tables, tables.action_watches),
        [true, false, false, false]
    );
    assert_eq!(from_false(&tables, tables.trigger_watches), [false]);
    assert_eq!(from_false(&tables, tables.graphs[0].self_watches), [true]);
}

#[test]
fn an_operator_inside_another_stands_before_it() {
    let tables = graph("initial step 1\ntransition 1: 1 -> 1 when ↑(T/(↓a)/2s)");
    assert!(matches!(
        of(&tables, tables.trigger_watches)[..],
        [
            Watch::Edge {
                edge: Edge::Falling,
                ..
            },
            Watch::Timer { .. },
            Watch::Edge {
                edge: Edge::Rising,
                ..
            }
        ]
    ));
}

#[test]
fn an_event_is_its_edge_or_a_value_while_its_step_is_active() {
    let tables = graph(
        "initial step 1 { on event ↑a: n = n + 1; on event ↑a AND b: n = n + 1; on event ↑(a AND b): n = 0 }",
    );
    let watches = of(&tables, tables.trigger_watches);
    let [
        Watch::Edge { result: first, .. },
        Watch::Value {
            gate: Some(_),
            result: second,
            ..
        },
        Watch::Edge { result: third, .. },
    ] = watches[..]
    else {
        panic!("{watches:?}");
    };
    let events: Vec<_> = tables.events.iter().map(|event| event.event).collect();
    assert_eq!(events, [first, second, third]);
}

#[test]
fn statements_of_a_change_are_watched_in_the_rounds_of_a_stable_evolution() {
    let text = "input a\nvar n : int\ngraph G { initial step 1 { on activation: n = n + 1 IF ↑a; n = n + 1 IF ↓a }\n\
                transition 1: 1 -> 1 when a do { n = 0 IF T/X1/2s } }";
    let scan = tables(text);
    assert_eq!((scan.round_watches.len, scan.action_watches.len), (0, 2));
    let stable = tables(&format!("evolution stable\n{text}"));
    // The timer too: it is evaluated once, at the end of the first round.
    assert_eq!(
        (stable.round_watches.len, stable.action_watches.len),
        (2, 1)
    );
}
