//! Conjunctions become words, the rest becomes code.

use grafcet_compiler::application::Tables;
use grafcet_core::program::{Bit, Op, Preset, Rest, Term, Timer};

use crate::{condition, graph, ops_of, tables, terms_of};

/// The trigger of the only transition: its terms and what is no term.
fn trigger(expression: &str) -> (Vec<Term>, Rest, Tables) {
    let tables = graph(&format!(
        "initial step 1\ntransition 1: 1 -> 1 when {expression}"
    ));
    let terms = terms_of(&tables, 0);
    (
        terms,
        condition(&tables, tables.transitions[0].fires).rest,
        tables,
    )
}

fn terms(expression: &str) -> Vec<Term> {
    let (terms, rest, _) = trigger(expression);
    assert_eq!(rest, Rest::None, "{expression}");
    terms
}

/// The code of a trigger that has no terms.
fn ops(expression: &str) -> Vec<Op> {
    let (terms, rest, tables) = trigger(expression);
    assert_eq!(terms, [], "{expression}");
    ops_of(&tables, rest)
}

fn is_logic(expression: &str) -> bool {
    match trigger(expression).1 {
        Rest::Logic(_) => true,
        Rest::Code(_) => false,
        rest => panic!("{expression}: {rest:?}"),
    }
}

/// The timers of a program, by their presets.
fn presets(tables: &Tables) -> Vec<Preset> {
    tables.timers.iter().map(|timer| timer.preset()).collect()
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
        assert_eq!(terms(always), [], "{always}");
    }
}

#[test]
fn a_contradiction_is_false() {
    assert_eq!(ops("a AND NOT a"), [Op::Constant(0)]);
    assert_eq!(ops("a AND NOT a AND (b OR c)"), [Op::Constant(0)]);
    assert!(is_logic("a AND NOT a"));
}

#[test]
fn a_situation_is_compared_whole() {
    let tables = graph(
        "initial step 1; step 2; step 3; transition 1: 1 -> 2 when S(G) = {1}\n\
         transition 2: 2 -> 3 when S(G) = {}; transition 3: 3 -> 1 when S(G) = {I} AND a",
    );
    let of = |transition| terms_of(&tables, transition);
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
    assert_eq!(
        condition(&tables, tables.transitions[0].fires).rest,
        Rest::None
    );
    assert_eq!(terms_of(&tables, 0).len(), 1);
    assert!(matches!(
        condition(&tables, tables.transitions[1].fires).rest,
        Rest::Logic(_)
    ));
    assert_eq!(terms_of(&tables, 1), []);
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
fn what_can_fault_is_behind_no_term() {
    for faulting in [
        "a AND n / m > 2",
        "n / m > 2 AND a",
        "NOT (a OR n + 1 > 2)",
        "a AND (b OR -n > 2)",
    ] {
        assert!(ops(faulting).contains(&Op::Bit(A)), "{faulting}");
        assert!(!is_logic(faulting), "{faulting}");
    }
    // What cannot stands behind them.
    let (terms, rest, tables) = trigger("n > 2 AND a");
    assert_eq!(terms.len(), 1);
    assert_eq!(ops_of(&tables, rest).len(), 3);
}

#[test]
fn the_entrance_steps_behind_the_first_are_looked_at_before_the_trigger() {
    let tables = graph(
        "initial step 1; initial step 2; step 3\ntransition 1: 1, 2, 3 -> 1 when a AND X1 AND (b OR c)\n\
         transition 2: 2, 3 -> 1 when n / m > 2 AND a",
    );
    let [inputs, steps] = [(1, 0b001), (2, 0b111)].map(|(word, bits)| Term {
        word,
        mask: bits,
        state: bits,
    });
    assert_eq!(terms_of(&tables, 0), [inputs, steps]);
    let logic = condition(&tables, tables.transitions[0].fires).rest;
    assert_eq!(
        ops_of(&tables, logic),
        [Op::Bit(B), Op::Bit(Bit(34)), Op::Or]
    );
    // What can fault does so in an armed transition, whatever else its trigger says.
    let third = Term {
        word: 2,
        mask: 0b100,
        state: 0b100,
    };
    assert_eq!(terms_of(&tables, 1), [third]);
    let code = ops_of(
        &tables,
        condition(&tables, tables.transitions[1].fires).rest,
    );
    assert!(code.contains(&Op::Bit(A)) && code.contains(&Op::Divide));
}

#[test]
fn a_trigger_that_needs_an_entrance_step_to_be_inactive_never_fires() {
    let tables = graph(
        "initial step 1; initial step 2\ntransition 1: 1, 2 -> 1, 2 when NOT X2\ntransition 2: 1 -> 2 when a",
    );
    assert_eq!(terms_of(&tables, 0), []);
    let rest = condition(&tables, tables.transitions[0].fires).rest;
    assert_eq!(ops_of(&tables, rest), [Op::Constant(0)]);
}

#[test]
fn a_timer_on_a_step_alone_or_behind_terms_is_no_code() {
    let (terms, rest, tables) = trigger("T/X1/2s");
    assert_eq!((terms.len(), rest), (0, Rest::Elapsed(0)));
    let timer = Timer::Own {
        since: tables.duties[1].since.unwrap(),
        preset: Preset::Constant(2000),
    };
    assert_eq!(tables.timers, [timer]);
    assert!(tables.ops.is_empty() && tables.codes.is_empty());

    let (terms, rest, tables) = trigger("a AND NOT T/X1/p AND NOT b");
    assert_eq!((terms.len(), rest), (1, Rest::Running(0)));
    assert!(matches!(presets(&tables)[..], [Preset::Number(..)]));
    assert!(tables.ops.is_empty());
}

#[test]
fn a_timer_among_others_is_one_operation_of_their_logic() {
    assert!(is_logic("T/X1/2s OR a"));
    assert_eq!(ops("T/X1/2s OR a"), [Op::Elapsed(0), Op::Bit(A), Op::Or]);
    let (terms, rest, tables) = trigger("T/X1/2s AND a AND NOT T/X1/3s");
    assert_eq!(terms.len(), 1);
    assert_eq!(
        ops_of(&tables, rest),
        [Op::Elapsed(0), Op::Not, Op::AndElapsed(1)]
    );
    assert_eq!(
        presets(&tables),
        [Preset::Constant(3000), Preset::Constant(2000)]
    );
}

#[test]
fn a_timer_is_asked_for_only_where_all_else_holds() {
    let either = "T/X1/2s AND NOT (a AND b)";
    let all = [Op::Bit(A), Op::Bit(B), Op::And, Op::Not, Op::AndElapsed(0)];
    assert_eq!(ops(either), all);
    assert!(is_logic(either));
    assert!(is_logic("T/X1/2s AND T/X1/p AND (a OR b)"));
    assert_eq!(
        ops(&format!("{either} AND n > 2"))[7..],
        [Op::And, Op::AndElapsed(0)]
    );
    // What can fault is counted whatever else holds.
    let faulty = ops("T/X1/2s AND n + 1 > 2");
    assert_eq!(faulty[0], Op::Elapsed(0));
}

#[test]
fn code_on_nothing_but_booleans_is_logic() {
    for logic in ["a OR b", "a XOR NOT b", "a OR (b AND X1)", "NOT (a AND b)"] {
        assert!(is_logic(logic), "{logic}");
    }
    for code in ["n > 2", "a OR n > 2", "a = b", "NOT (a AND n = m)"] {
        assert!(!is_logic(code), "{code}");
    }
}

/// `(a OR (a OR ... b))` on so many Booleans at once.
fn nested(depth: usize) -> String {
    let opened = "(a OR ".repeat(depth - 1);
    let closed = ")".repeat(depth - 1);
    format!("{opened}b{closed}")
}

#[test]
fn logic_deeper_than_a_word_is_code() {
    assert_eq!(trigger(&nested(32)).2.layout.stack, 32);
    assert!(is_logic(&nested(32)));
    assert_eq!(trigger(&nested(33)).2.layout.stack, 33);
    assert!(!is_logic(&nested(33)));
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
    let many = ["(a OR b)"; 100].join(" AND ");
    assert_eq!(trigger(&many).2.layout.stack, 3);
}
