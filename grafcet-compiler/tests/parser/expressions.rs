//! What binds tighter than what.

use super::{tree, wrong_trigger};

#[test]
fn and_binds_tighter_than_xor_and_xor_than_or() {
    assert_eq!(tree("a OR b XOR c AND d"), "(OR a (XOR b (AND c d)))");
    assert_eq!(tree("a AND b XOR c OR d"), "(OR (XOR (AND a b) c) d)");
}

#[test]
fn prefixes_bind_tighter_than_and() {
    assert_eq!(tree("NOT a AND b"), "(AND (NOT a) b)");
    assert_eq!(tree("↑a AND ↓b"), "(AND (↑ a) (↓ b))");
    assert_eq!(tree("NOT ↑a"), "(NOT (↑ a))");
    assert_eq!(tree("↑(a AND b)"), "(↑ (AND a b))");
}

#[test]
fn prefixes_take_a_whole_comparison() {
    assert_eq!(tree("NOT a = b"), "(NOT (= a b))");
    assert_eq!(tree("↑n + 1 > 5 OR b"), "(OR (↑ (> (+ n 1) 5)) b)");
}

#[test]
fn a_comparison_may_have_a_prefix_on_its_right() {
    assert_eq!(tree("a = NOT b AND c"), "(AND (= a (NOT b)) c)");
}

#[test]
fn numbers_bind_tightest() {
    assert_eq!(
        tree("a + b * c = -d MOD e - f"),
        "(= (+ a (* b c)) (- (MOD (- d) e) f))"
    );
    assert_eq!(tree("a - b - c > 0"), "(> (- (- a b) c) 0)");
    assert_eq!(tree("a / b * c > 0"), "(> (* (/ a b) c) 0)");
}

#[test]
fn comparisons_are_joined_from_the_left() {
    assert_eq!(tree("a = b = c"), "(= (= a b) c)");
}

#[test]
fn parentheses_go_first() {
    assert_eq!(tree("(a OR b) AND (c)"), "(AND (OR a b) c)");
    assert_eq!(tree("(a + b) * c > 0"), "(> (* (+ a b) c) 0)");
}

#[test]
fn a_chain_of_one_operator_keeps_its_order_in_a_balanced_tree() {
    assert_eq!(tree("a AND b AND c"), "(AND (AND a b) c)");
    assert_eq!(
        tree("a OR b OR c OR d OR e"),
        "(OR (OR (OR a b) (OR c d)) e)"
    );
}

#[test]
fn a_situation_is_compared_with_a_set() {
    assert_eq!(tree("S(G) = {1, 3} AND a"), "(AND (S G = {1 3}) a)");
    assert_eq!(tree("S(G) <> {}"), "(S G <> {})");
    assert_eq!(tree("NOT S(G) ≠ {I}"), "(NOT (S G <> {I}))");
    assert_eq!(tree("S ( G ) = { E5 }"), "(S G = {E5})");
}

#[test]
fn a_situation_is_compared_with_nothing_else() {
    assert_eq!(
        wrong_trigger("S(G)"),
        "syntax 1: expected `=` or `<>` behind `S(..)`, found the end of the line"
    );
    assert_eq!(
        wrong_trigger("S(G) = 1"),
        "syntax 1: expected a set of steps such as `{1, 3}`, found `1`"
    );
    assert_eq!(
        wrong_trigger("S(G) = {*}"),
        "syntax 1: `{*}` stands only in a forcing order"
    );
    assert_eq!(
        wrong_trigger("S(G) = {1 2}"),
        "syntax 1: expected `,` or `}` in the set, found `2`"
    );
    assert_eq!(
        wrong_trigger("S(G) = {INIT}"),
        "syntax 1: expected steps, found `INIT`"
    );
}

#[test]
fn a_qualified_name_belongs_to_a_graph() {
    assert_eq!(
        tree("Drill:X3 AND System:unstable"),
        "(AND Drill:X3 System:unstable)"
    );
}

#[test]
fn something_is_missing() {
    assert_eq!(
        wrong_trigger("a AND"),
        "syntax 2: expected a name, a number or a condition, found `}`"
    );
    assert_eq!(
        wrong_trigger("(a"),
        "syntax 1: expected `)`, found the end of the line"
    );
    assert_eq!(
        wrong_trigger("a b"),
        "syntax 1: expected the end of the line or `;`, found `b`"
    );
    assert_eq!(
        wrong_trigger("a)"),
        "syntax 1: expected the end of the line or `;`, found `)`"
    );
    assert_eq!(
        wrong_trigger("()"),
        "syntax 1: expected a name, a number or a condition, found `)`"
    );
    assert_eq!(wrong_trigger("f(a)"), "syntax 1: `f` cannot be called");
}

#[test]
fn a_place_is_underlined_without_its_parentheses_and_with_those_inside() {
    let text = "graph G { transition 1: 1 -> 2 when ((a) OR (b)) }";
    let transition = match &super::graph(text).elements[0] {
        grafcet_compiler::ast::Element::Transition(transition) => transition.clone(),
        other => panic!("{other:?}"),
    };
    let grafcet_compiler::ast::Trigger::Expression(expression) = transition.trigger else {
        panic!("an expression")
    };
    let span = expression.span;
    assert_eq!(&text[span.start as usize..span.end as usize], "(a) OR (b)");
}
