//! What can be active together, and that a bound is made of it.

#![allow(clippy::unwrap_used, reason = "a test whose scene cannot be set fails")]

use std::io;

use grafcet_compiler::activity::Activity;
use grafcet_compiler::application::Unit;
use grafcet_compiler::{Target, compile};

use super::rounds::Rounds;
use super::work::Kind;
use super::{Bound, Sharer};

pub fn unit(text: &str) -> Unit {
    let load = |_: &str| Err(io::ErrorKind::NotFound.into());
    let compiled = compile("bound.grafcet", text, &load, Target::Host);
    let errors = compiled.diagnostics;
    compiled
        .application
        .unwrap_or_else(|| panic!("{errors:?}"))
        .controller
}

fn activities(unit: &Unit) -> Vec<Activity> {
    let program = unit.tables.program();
    let graphs = program.graphs.iter().enumerate();
    graphs
        .map(|(index, graph)| Activity::of(&program, index, graph))
        .collect()
}

const INPUTS: &str = "
    input a at %IX0.0; input b at %IX0.1; input c at %IX0.2; input d at %IX0.3
    output Q at %QX0.0
";

/// The pairs of steps of the first graph that can be active together.
fn pairs(graphs: &str) -> Vec<(String, String)> {
    let unit = unit(&format!("{INPUTS}{graphs}"));
    let activity = activities(&unit).remove(0);
    let steps = &unit.symbols.graphs[0].steps;
    let mut pairs = Vec::new();
    for left in 0..steps.len() {
        for right in left + 1..steps.len() {
            if activity.steps.are(left, right) {
                pairs.push((steps[left].id.clone(), steps[right].id.clone()));
            }
        }
    }
    pairs
}

fn pair(left: &str, right: &str) -> (String, String) {
    (left.to_owned(), right.to_owned())
}

#[test]
fn of_a_sequence_one_step_is_active() {
    let graph = "graph G {
        initial step 1; step 2 { Q }; step 3
        transition 1: 1 -> 2 when a; transition 2: 2 -> 3 when b; transition 3: 3 -> 1 when c
    }";
    assert_eq!(pairs(graph), []);
}

#[test]
fn branches_whose_triggers_exclude_each_other_are_not_active_together() {
    let selection = |first: &str, second: &str| {
        format!(
            "var n : int in 0 .. 9
            graph G {{
                initial step 1; step 2 {{ Q }}; step 3; step 4 {{ on activation {{ n = n + 1 }} }}
                transition 1: 1 -> 2 when {first}; transition 2: 1 -> 3 when {second}
                transition 3: 2 -> 4 when d; transition 4: 3 -> 4 when d; transition 5: 4 -> 1 when NOT d
            }}"
        )
    };
    for (first, second) in [
        ("a", "NOT a"),
        ("a AND b", "NOT a OR NOT b"),
        ("a AND (b OR c)", "a AND NOT b AND NOT c"),
        ("a XOR b", "a AND b"),
        ("n < 3", "n >= 3 AND a"),
        ("T/X1/2s AND a", "NOT (T/X1/2s)"),
    ] {
        assert_eq!(pairs(&selection(first, second)), [], "{first} | {second}");
    }
    for (first, second) in [("a", "b"), ("n < 4", "n > 2"), ("a OR b", "NOT a OR c")] {
        let both = pairs(&selection(first, second));
        assert!(
            both.contains(&pair("2", "3")),
            "{first} | {second}: {both:?}"
        );
        // One arrives before the other.
        assert!(
            both.contains(&pair("3", "4")),
            "{first} | {second}: {both:?}"
        );
    }
}

#[test]
fn branches_that_run_in_parallel_are_active_together_and_no_others() {
    let graph = "graph G {
        initial step 1; step 2 { Q }; step 3; step 4; step 5
        transition 1: 1 -> 2, 4 when a; transition 2: 2 -> 3 when b; transition 3: 4 -> 5 when c
        transition 4: 3, 5 -> 1 when d
    }";
    let expected = [("2", "4"), ("2", "5"), ("3", "4"), ("3", "5")];
    assert_eq!(
        pairs(graph),
        expected.map(|(left, right)| pair(left, right))
    );
}

#[test]
fn steps_that_go_round_do_not_become_more() {
    let unit = unit(&format!(
        "{INPUTS}
        graph G {{
            initial step 1; initial step 2 {{ Q }}; step 3; step 4
            transition 1: 1 -> 2 when a; transition 2: 2 -> 3 when b
            transition 3: 3 -> 4 when c; transition 4: 4 -> 1 when d
        }}"
    ));
    let activity = activities(&unit).remove(0);
    assert_eq!(activity.most, 2);
    assert_eq!(
        activity.steps.heaviest(&[1, 3, 1, 2], activity.most),
        [1, 3]
    );
}

#[test]
fn what_is_forced_is_active_together() {
    let graphs = "graph G {
        initial step 1; step 2 { Q }; step 3
        transition 1: 1 -> 2 when a; transition 2: 2 -> 3 when b; transition 3: 3 -> 1 when c
    }
    graph Above {
        initial step 1; step 2 { F/G:{2,3} }
        transition 1: 1 -> 2 when d; transition 2: 2 -> 1 when NOT d
    }";
    let together = pairs(graphs);
    assert!(together.contains(&pair("2", "3")), "{together:?}");
}

#[test]
fn a_step_that_nothing_leads_to_is_never_active() {
    let unit = unit(&format!(
        "{INPUTS}
 graph G {{ initial step 1 {{ Q }}; step 2; transition 1: 2 -> 1 when a }}"
    ));
    let steps = activities(&unit).remove(0).steps;
    assert!(steps.are(0, 0) && !steps.are(1, 1));
}

#[test]
fn what_empties_a_graph_lets_its_steps_do_what_they_do_when_they_are_left() {
    let superior = |step: &str| {
        format!(
            "graph Superior {{
                initial step 1; {step}
                transition 1: 1 -> 2 when a; transition 2: 2 -> 1 when b
            }}"
        )
    };
    let inferior = |initial: &str, action: &str| {
        format!("var n : int\ngraph Inferior {{ {initial}step 1 {{ {action}: n = n + 1 }} }}")
    };
    let stored = |superior: &str, inferior: &str| {
        let unit = unit(&format!("{INPUTS}{inferior}\n{superior}"));
        let [.., bound] = Bound::of(&unit);
        let work = bound.work();
        work.counts()
            .any(|(kind, _)| matches!(kind, Kind::Stored | Kind::StoredLooped))
    };
    let enclosing = superior("step 2 encloses Inferior{1}");
    let emptying = superior("step 2 { F/Inferior:{} }");
    for action in ["on activation", "on deactivation"] {
        assert!(stored(&enclosing, &inferior("", action)), "{action}");
    }
    assert!(stored(&emptying, &inferior("initial ", "on deactivation")));
    // It is active from the start, and nothing but the start activates it.
    assert!(!stored(&emptying, &inferior("initial ", "on activation")));
}

#[test]
fn a_program_that_evolves_once_a_scan_has_no_rounds() {
    let graph = "graph G { initial step 1 { Q }; transition 1: 1 -> 1 when a }";
    let [.., bound] = Bound::of(&unit(&format!("{INPUTS}{graph}")));
    assert_eq!(
        (&bound.rounds, bound.round()),
        (&Rounds::One, bound.instructions())
    );
}

/// Four steps in a ring, the third of which stores a number.
fn ring() -> String {
    format!(
        "{INPUTS}
        var n : int in 0 .. 9
        graph G {{
            initial step 1; step 2 {{ Q }}; step 3 {{ n = n + 1 IF n < 9 }}; step 4
            transition 1: 1 -> 2 when a; transition 2: 2 -> 3 when b
            transition 3: 3 -> 4 when c; transition 4: 4 -> 1 when d
        }}"
    )
}

#[test]
fn of_a_sequence_the_step_that_takes_the_most_counts() {
    let unit = unit(&ring());
    for bound in Bound::of(&unit) {
        let Sharer::Graph(0, steps) = &bound.shares[1].of else {
            panic!("{:?}", bound.shares);
        };
        // It is left for the third, or is the third: in one step, and the number is stored once.
        assert_eq!(steps.len(), 1);
        let stored = bound
            .work()
            .counts()
            .find(|(kind, _)| *kind == Kind::Stored);
        assert_eq!(stored, Some((Kind::Stored, 1)));
        assert!(bound.instructions() > bound.shares[0].work.instructions(bound.cpu));
    }
}
