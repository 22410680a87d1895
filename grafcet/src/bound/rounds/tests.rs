//! How many rounds there are at most. That no scan takes more is held by `reference/tests/differential/rounds.rs`.

use super::super::tests::unit;
use super::Rounds;

/// Of graphs that evolve `stable`.
fn rounds(graphs: &str) -> Rounds {
    let declarations = "evolution stable
        input a; input b; input c; input d
        output Q
        var v : bool";
    let unit = unit(&format!("{declarations}\n{graphs}"));
    Rounds::of_program(&unit.tables.program())
}

/// Their number, when it is known.
fn most(graphs: &str) -> Option<u32> {
    match rounds(graphs) {
        Rounds::Settle { rounds, .. } => Some(rounds),
        Rounds::One | Rounds::Limit => None,
    }
}

/// A graph of three steps in a ring.
fn ring(name: &str, triggers: [&str; 3]) -> String {
    let [first, second, third] = triggers;
    format!(
        "graph {name} {{
            initial step 1; step 2; step 3
            transition 1: 1 -> 2 when {first}
            transition 2: 2 -> 3 when {second}
            transition 3: 3 -> 1 when {third}
        }}\n"
    )
}

#[test]
fn rounds_end_where_a_way_round_waits_for_an_edge() {
    // From 3, by the edge, to 1, 2 and 3; and a round that finds that nothing fires.
    let expected = Rounds::Settle {
        rounds: 4,
        firings: vec![2],
    };
    assert_eq!(rounds(&ring("G", ["a", "b", "↑c"])), expected);
    assert_eq!(rounds(&ring("G", ["a", "b", "c"])), Rounds::Limit);
    assert_eq!(Rounds::Limit.most(), 100);
    // Which one would have to be False.
    assert_eq!(most(&ring("G", ["a", "b", "NOT ↑c"])), None);
}

#[test]
fn rounds_end_where_triggers_of_a_ring_ask_opposites_of_an_input() {
    assert_eq!(most(&ring("G", ["a", "b", "NOT a"])), Some(3));
    assert_eq!(most(&ring("G", ["a AND b", "b XOR c", "b AND c"])), Some(3));
    assert_eq!(most(&ring("G", ["a OR b", "NOT b", "a"])), None);
    // An edge may hold it up in the first round alone.
    let held_up = ring("G", ["a AND NOT ↑d", "b", "NOT a"]);
    assert_eq!(most(&held_up), Some(4));
    // A variable may change in every round.
    assert_eq!(most(&ring("G", ["v", "b", "NOT v"])), None);
}

#[test]
fn rounds_end_where_a_step_of_a_ring_takes_its_time() {
    assert_eq!(most(&ring("G", ["a", "T/X2/1s", "b"])), Some(4));
    assert_eq!(most(&ring("G", ["a", "T/X2/0s", "b"])), None);
    // It may have run out in a step that is active when the scan begins, and that another graph holds up.
    let other = ring("H", ["a", "NOT a", "d"]);
    let held = ring("G", ["a", "T/X2/1s AND H:X2", "b"]);
    assert_eq!(most(&format!("{other}{held}")), Some(6));
}

#[test]
fn a_timer_ends_no_rounds_where_its_step_can_be_left_and_entered_at_once() {
    let two = "graph G {
        initial step 1; initial step 2; step 3
        transition 1: 1 -> 2 when a; transition 2: 2 -> 3 when T/X2/1s; transition 3: 3 -> 1 when b
    }";
    assert_eq!(most(two), None);
}

#[test]
fn a_step_that_is_left_for_itself_ends_rounds_unless_another_transition_leaves_it_at_once() {
    let graph = |second: &str| {
        format!(
            "graph G {{
                initial step 1; step 2
                transition 1: 1 -> 1 when a; transition 2: 1 -> 2 when {second}; transition 3: 2 -> when c
            }}"
        )
    };
    assert_eq!(most(&graph("NOT a AND b")), Some(3));
    assert_eq!(most(&graph("b")), None);
}

#[test]
fn branches_of_an_or_that_begin_at_once_count_both() {
    let graph = |second: &str| {
        format!(
            "graph G {{
                initial step 1; step 2; step 3; step 4
                transition 1: 1 -> 2 when a; transition 2: 1 -> 3 when {second}
                transition 3: 2 -> 4 when c; transition 4: 3 -> 4 when c; transition 5: 4 -> 1 when ↑d
            }}"
        )
    };
    assert_eq!(most(&graph("NOT a")), Some(4));
    // Two from 1, each with one behind it, and one each from 2 and 3, which may still be active: they count one by one.
    assert_eq!(most(&graph("b")), Some(8));
}

#[test]
fn graphs_that_depend_on_nothing_but_inputs_come_to_rest_at_once() {
    let one = ring("G", ["a", "b", "↑c"]);
    assert_eq!(
        most(&format!("{one}{}", ring("H", ["c", "a", "↑d"]))),
        Some(4)
    );
    // One behind the other, and each may have waited for the other at first.
    assert_eq!(
        most(&format!("{one}{}", ring("H", ["c", "G:X3", "↑d"]))),
        Some(6)
    );
}

#[test]
fn a_superior_that_moves_lets_its_inferior_begin_anew() {
    let inferior = ring("Main", ["a", "b", "↑c"]);
    let superior = |order: &str, back: &str| {
        format!(
            "graph Superior {{
                initial step 1; step 2 {{ {order} }}
                transition 1: 1 -> 2 when a; transition 2: 2 -> 1 when {back}
            }}"
        )
    };
    let with = |order: &str| most(&format!("{inferior}{}", superior(order, "NOT a")));
    // It has moved in the first round, or does not; behind that two firings.
    assert_eq!(with("F/Main:{}"), Some(4));
    assert_eq!(with("F/Main:{} IF d"), Some(4));
    assert_eq!(with("F/Main:{} IF v"), None);
    // It can move once behind the first round: two firings before, two behind it, and its own.
    let moves = superior("F/Main:{}", "↑c OR b AND v");
    assert_eq!(most(&format!("{inferior}{moves}")), None);
    let moves = superior("F/Main:{}", "↑c");
    let waits = moves.replace("2 when a", "2 when a AND Main:X3");
    assert_eq!(most(&format!("{inferior}{waits}")), Some(7));
}

#[test]
fn what_is_ordered_counts_as_a_move_of_a_superior() {
    let graphs = format!(
        "graph Top {{
            initial step 1; step 2 {{ F/Middle:{{2}} }}
            transition 1: 1 -> 2 when a AND Main:X3; transition 2: 2 -> 1 when ↑c
        }}
        graph Middle {{ initial step 1; step 2 {{ F/Main:{{}} }}; transition 1: 2 -> 1 when ↑d }}
        {}",
        ring("Main", ["a", "b", "↑c"])
    );
    // Top moves once; Middle never fires, and is ordered in two stretches; Main has two firings in each of three.
    let firings = vec![1, 0, 6];
    assert_eq!(rounds(&graphs), Rounds::Settle { rounds: 9, firings });
}

#[test]
fn an_order_of_a_moment_may_free_what_has_been_active_before() {
    let main = ring("Main", ["a", "b", "↑c"]);
    let order = |condition: &str| format!("graph G {{ always {{ F/Main:{{*}} IF {condition} }} }}");
    assert_eq!(most(&format!("{main}{}", order("↑d"))), Some(4));
    let main = ring("Main", ["a", "b", "NOT a"]);
    assert_eq!(most(&main), Some(3));
    assert_eq!(most(&format!("{main}{}", order("↑d"))), Some(4));
}
