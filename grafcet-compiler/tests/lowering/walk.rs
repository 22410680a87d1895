//! In which order the image of a small program looks for active steps.

use grafcet_compiler::emit::{Walk, Word};

use crate::graph;

/// Of a graph of up to 32 steps.
fn word(elements: &str) -> Word {
    let mut words = Walk::of(&graph(elements).program()).words;
    assert_eq!(words.len(), 1, "the steps of one word");
    words.remove(0)
}

#[test]
fn behind_the_active_step_of_a_sequence_nobody_looks_for_another() {
    let word = word(
        "initial step 1; step 2; step 3
         transition 1: 1 -> 2 when a; transition 2: 2 -> 3 when b; transition 3: 3 -> 1 when c",
    );
    assert_eq!((word.alone, word.chains), (vec![0, 1, 2], Vec::new()));
}

#[test]
fn of_parallel_branches_each_is_looked_through_once() {
    let word = word(
        "initial step 1; step 2; step 3; step 4
         transition 1: 1 -> 2, 4 when a; transition 2: 2 -> 3 when b; transition 3: 3, 4 -> 1 when c",
    );
    assert_eq!(word.alone, [0]);
    assert_eq!(word.chains, [vec![1, 2], vec![3]]);
}

#[test]
fn steps_that_can_be_active_together_stay_in_the_order_of_the_source() {
    let word = word(
        "initial step 1; step 2; step 3; step 4
         transition 1: 1 -> 2, 3 when a; transition 2: 2 -> 4 when b; transition 3: 3, 4 -> 1 when c",
    );
    assert_eq!(word.alone, [0]);
    assert_eq!(word.chains, [[1], [2], [3]]);
}

#[test]
fn branches_are_apart_only_where_their_triggers_exclude_each_other() {
    let branches = |second: &str| {
        word(&format!(
            "initial step 1; step 2; step 3
             transition 1: 1 -> 2 when a; transition 2: 1 -> 3 when {second}
             transition 3: 2 -> 1 when c; transition 4: 3 -> 1 when c"
        ))
    };
    assert_eq!(branches("b AND NOT a").alone, [0, 1, 2]);
    assert!(branches("b").alone.is_empty());
}

#[test]
fn what_is_forced_together_is_looked_for_together() {
    let word = word("initial step 1; step 2; step 3; always { F/G:{2, 3} IF a }");
    assert_eq!(word.alone, [0]);
    assert_eq!(word.chains, [[1], [2]]);
}

#[test]
fn the_words_of_a_large_graph_are_walked_over_one_by_one() {
    let steps: String = (1..=40)
        .map(|step| format!("initial step {step}\n"))
        .collect();
    let words = Walk::of(&graph(&steps).program()).words;
    let counts = words
        .iter()
        .map(|word| (word.first, word.alone.len(), word.chains.len()));
    assert_eq!(counts.collect::<Vec<_>>(), [(0, 0, 32), (32, 0, 8)]);
}

#[test]
fn firing_exchanges_steps_unless_one_that_is_entered_may_be_active() {
    let exchanges = |elements: &str| word(elements).exchanges;
    let steps = "initial step 1; step 2; step 3\n";
    let both = |one: &str, other: &str| exchanges(&format!("{steps}{one}\n{other}"));
    assert!(both(
        "transition 1: 1 -> 2 when a",
        "transition 2: 2 -> 1 when b"
    ));
    assert!(both(
        "transition 1: 1 -> 2, 3 when a",
        "transition 2: 2, 3 -> 1 when b"
    ));
    // Both can fire at once, and then steps 2 and 3 are active together, but neither leads to the other.
    assert!(both(
        "transition 1: 1 -> 2 when a",
        "transition 2: 1 -> 3 when b"
    ));
    assert!(!both(
        "transition 1: 1 -> 2, 3 when a",
        "transition 2: 2 -> 3 when b"
    ));
    // One that leads back to its own step, alone or beside another that leaves it.
    assert!(exchanges("initial step 1; transition 1: 1 -> 1 when a"));
    assert!(!both(
        "transition 1: 1 -> 1 when a",
        "transition 2: 1 -> 2 when b"
    ));
    // One without entrance.
    assert!(!exchanges("step 1; transition 1: -> 1 when a"));
}
