//! Where a statement ends, and where it goes on over the end of a line.

use super::{graph, right, show, statements, transition, tree, wrong};

fn shown(text: &str) -> String {
    let shown: Vec<_> = statements(text).iter().map(show::statement).collect();
    shown.join("; ")
}

#[test]
fn a_statement_ends_at_its_line() {
    assert_eq!(shown("A\nB IF c\nd = 1"), "A; B IF c; d = 1");
}

#[test]
fn a_statement_ends_at_a_semicolon() {
    assert_eq!(shown("A; B IF c;; d = 1;"), "A; B IF c; d = 1");
}

#[test]
fn a_statement_goes_on_behind_a_binary_operator() {
    for operator in [
        "AND", "OR", "XOR", "=", "<>", "<", "<=", ">", ">=", "+", "-", "*", "MOD",
    ] {
        assert_eq!(
            statements(&format!("A IF b {operator}\n c")).len(),
            1,
            "{operator}"
        );
    }
    assert_eq!(shown("a =\n 1"), "a = 1");
    assert_eq!(shown("a :=\n 1"), "a = 1");
}

#[test]
fn a_statement_goes_on_when_the_next_line_begins_with_a_binary_operator() {
    for operator in [
        "AND", "&", "·", "OR", "|", "XOR", "=", "≠", "<", "≤", ">", "≥", "+", "-", "*", "/", "mod",
    ] {
        assert_eq!(
            statements(&format!("A IF b\n {operator} c")).len(),
            1,
            "{operator}"
        );
    }
    assert_eq!(shown("a\n = 1\n + 2\n IF b"), "a = (+ 1 2) IF b");
    assert_eq!(shown("a\n := 1"), "a = 1");
}

#[test]
fn a_statement_goes_on_behind_a_comma() {
    assert_eq!(shown("A,\nB IF c\nD"), "A, B IF c; D");
}

#[test]
fn line_breaks_mean_nothing_inside_parentheses_and_sets() {
    assert_eq!(tree("(\na\nAND b\n)"), "(AND a b)");
    assert_eq!(tree("S(\nG\n) = {\n1,\n3\n}"), "(S G = {1 3})");
    assert_eq!(shown("F/G:{\nI\n} IF a"), "F/G:{I} IF a");
}

#[test]
fn a_transition_goes_on_at_its_arrow_trigger_and_action() {
    let transition = transition("transition 1: 1,\n2 ->\n3\nwhen a\nAND b\ndo\n{ c = 1 }");
    assert_eq!(show::names(&transition.entrance), "1 2");
    assert_eq!(show::names(&transition.exit), "3");
    assert_eq!(show::trigger(&transition.trigger), "(AND a b)");
    assert_eq!(show::block(&transition.action.unwrap()), "c = 1");
}

#[test]
fn the_arrow_may_begin_a_line() {
    assert_eq!(show::names(&transition("transition 1: 1\n-> 2").exit), "2");
}

#[test]
fn a_brace_may_begin_a_line() {
    let graph = graph("graph G\n{\n step 1\n {\n A\n }\n}");
    assert_eq!(graph.elements.len(), 1);
    right("test \"t\"\n{\n expect a\n}");
}

#[test]
fn a_line_does_not_break_behind_when_if_not_or_a_colon() {
    for (text, found) in [
        (
            "graph G { transition 1: 1 -> 2 when\na\n}",
            "expected a trigger behind `when`, found the end of the line",
        ),
        (
            "graph G { transition 1: 1 -> 2 when NOT\na\n}",
            "expected a name, a number or a condition, found the end of the line",
        ),
        (
            "graph G { step 1 { A IF\na } }",
            "expected a name, a number or a condition, found the end of the line",
        ),
        (
            "property \"p\":\nnever a",
            "expected `never`, `always`, `reachable`, `recoverable` or `after`, found the end of the line",
        ),
    ] {
        assert_eq!(wrong(text)[0], format!("syntax 1: {found}"), "{text}");
    }
}

#[test]
fn a_sink_transition_may_end_its_line_with_the_arrow() {
    let graph = graph("graph G {\ntransition 1: 4 ->\ntransition 2: 5 -> when a\n}");
    assert_eq!(graph.elements.len(), 2);
}

#[test]
fn two_statements_on_a_line_need_a_semicolon() {
    assert_eq!(
        wrong("graph G { step 1 { A B } }"),
        ["syntax 1: expected the end of the line or `;`, found `B`"]
    );
    assert_eq!(
        wrong("input a input b"),
        ["syntax 1: expected the end of the line or `;`, found `input`"]
    );
}

#[test]
fn behind_a_block_no_semicolon_is_needed() {
    assert_eq!(
        graph("graph G { step 1 { A } step 2 { on activation { a = 1 } B } }")
            .elements
            .len(),
        2
    );
}

#[test]
fn behind_a_set_a_semicolon_is_needed() {
    assert_eq!(
        wrong("graph G { step 1 { F/H:{1} A } }"),
        ["syntax 1: expected the end of the line or `;`, found `A`"]
    );
}

#[test]
fn a_program_may_stand_on_one_line() {
    let graph = graph(
        "input a; graph G { initial step 1; step 2 { A; B IF c }; transition 1: 1 -> 2 when a; transition 2: 2 -> 1 }",
    );
    assert_eq!(graph.elements.len(), 4);
}
