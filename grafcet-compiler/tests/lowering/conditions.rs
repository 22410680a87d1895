//! Conjunctions become words, the rest becomes code.

use grafcet_core::program::{Bit, Condition, Op, Term};

use crate::{graph, tables};

/// The trigger of the only transition.
fn trigger(expression: &str) -> (Condition, grafcet_compiler::application::Tables) {
    let tables = graph(&format!(
        "initial step 1\ntransition 1: 1 -> 1 when {expression}"
    ));
    (tables.transitions[0].trigger, tables)
}

fn terms(expression: &str) -> Vec<Term> {
    match trigger(expression) {
        (Condition::All(run), tables) => run.of(&tables.terms).to_vec(),
        (other, _) => panic!("{expression}: {other:?}"),
    }
}

fn ops(expression: &str) -> Vec<Op> {
    match trigger(expression) {
        (Condition::Code(code), tables) => {
            let start = code.start as usize;
            tables.ops[start..start + usize::from(code.len)].to_vec()
        }
        (other, _) => panic!("{expression}: {other:?}"),
    }
}

const A: Bit = Bit(32);
const B: Bit = Bit(33);

#[test]
fn a_conjunction_of_inputs_is_one_comparison() {
    let both = Term {
        word: 1,
        mask: 0b011,
        state: 0b001,
    };
    for same in [
        "a AND NOT b",
        "NOT (NOT a OR b)",
        "a & ¬b & a",
        "a = TRUE AND b = FALSE",
        "a AND (b <> TRUE) AND TRUE",
    ] {
        assert_eq!(terms(same), [both], "{same}");
    }
}

#[test]
fn literals_in_several_words_are_one_term_for_each_word() {
    let words: Vec<u16> = terms("a AND X1 AND NOT System:unstable")
        .iter()
        .map(|term| term.word)
        .collect();
    assert_eq!(words, [0, 1, 2]);
}

#[test]
fn a_disjunction_is_code() {
    assert_eq!(ops("a OR NOT b"), [Op::Bit(A), Op::Bit(B), Op::Not, Op::Or]);
}

#[test]
fn what_is_always_true_costs_nothing() {
    for always in ["a OR TRUE", "NOT FALSE", "1 < 2", "True"] {
        assert_eq!(trigger(always).0, Condition::Always, "{always}");
    }
}

#[test]
fn a_contradiction_is_false() {
    assert_eq!(ops("a AND NOT a"), [Op::Constant(0)]);
}

#[test]
fn a_situation_is_compared_whole() {
    let tables = graph(
        "initial step 1; step 2; step 3; transition 1: 1 -> 2 when S(G) = {1}\n\
         transition 2: 2 -> 3 when S(G) = {}; transition 3: 3 -> 1 when S(G) = {I} AND a",
    );
    let of = |index: usize| match tables.transitions[index].trigger {
        Condition::All(run) => run.of(&tables.terms).to_vec(),
        other => panic!("{other:?}"),
    };
    assert_eq!(
        of(0),
        [Term {
            word: 2,
            mask: 0b111,
            state: 0b001
        }]
    );
    assert_eq!(
        of(1),
        [Term {
            word: 2,
            mask: 0b111,
            state: 0
        }]
    );
    assert_eq!(
        of(2)[1],
        Term {
            word: 2,
            mask: 0b111,
            state: 0b001
        }
    );
}

#[test]
fn another_situation_is_code_unless_there_is_one_step() {
    let tables = tables(
        "graph G { initial step 1; transition 1: 1 -> 1 when S(G) <> {1} }\n\
         graph H { initial step 1; step 2; transition 1: 1 -> 2 when S(H) <> {1} }",
    );
    assert!(matches!(tables.transitions[0].trigger, Condition::All(_)));
    assert!(matches!(tables.transitions[1].trigger, Condition::Code(_)));
}

#[test]
fn constants_are_folded() {
    let tables = tables(
        "const LOW : int = 3\nconst HIGH : int = LOW\nvar n : int\n\
         graph G { initial step 1 { n = n + LOW * 2 }; transition 1: 1 -> 1 when n > HIGH - 1 }",
    );
    let constants = tables.ops.iter().filter(|op| matches!(op, Op::Constant(_)));
    assert_eq!(
        constants.collect::<Vec<_>>(),
        [&Op::Constant(6), &Op::Constant(2)]
    );
    assert!(!tables.ops.contains(&Op::Multiply));
}

#[test]
fn arithmetic_that_would_be_a_fault_is_left_to_the_scan_which_counts_it() {
    let divided = ops("1 / 0 > 2");
    assert!(divided.contains(&Op::Divide));
    let both_sides = ops("FALSE AND n / m > 2");
    assert!(both_sides.contains(&Op::Divide) && both_sides.contains(&Op::And));
    assert!(ops("-(-2147483648) > 2").contains(&Op::Negate));
}

#[test]
fn equal_conditions_share_their_rows() {
    let tables = graph(
        "initial step 1 { M IF a AND b; N IF b AND a; O IF a OR b }\n\
         transition 1: 1 -> 1 when a AND b\ntransition 2: 1 -> 1 when a OR b",
    );
    assert_eq!(tables.terms.len(), 1);
    assert_eq!(tables.ops.len(), 3);
}

#[test]
fn the_stack_is_as_deep_as_the_deepest_code() {
    assert_eq!(graph("initial step 1 { M IF a AND b }").layout.stack, 0);
    assert_eq!(graph("initial step 1 { M IF a OR b }").layout.stack, 2);
    assert_eq!(
        graph("initial step 1 { n = n - (m - (n - (m - 1))) }")
            .layout
            .stack,
        5
    );
    assert_eq!(
        graph("initial step 1 { n = (((n - m) - n) - m) - 1 }")
            .layout
            .stack,
        2
    );
}
