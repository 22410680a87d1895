//! Actions: momentary, stored, forcing, on events.

use super::{graph, show, statements, transition, wrong};

fn shown(text: &str) -> String {
    let shown: Vec<_> = statements(text).iter().map(show::statement).collect();
    shown.join("; ")
}

fn wrong_action(text: &str) -> String {
    wrong(&format!("graph G {{ step 1 {{ {text}\n}} }}")).join("\n")
}

#[test]
fn momentary_statements_name_variables_and_a_condition() {
    assert_eq!(shown("A; B, G:C IF NOT d"), "A; B, G:C IF (NOT d)");
}

#[test]
fn stored_statements_have_two_spellings() {
    assert_eq!(
        shown("a = b OR c; n := n + 1 IF ↑d"),
        "a = (OR b c); n = (+ n 1) IF (↑ d)"
    );
}

#[test]
fn a_stored_value_may_be_a_comparison() {
    assert_eq!(shown("a = b = c"), "a = (= b c)");
}

#[test]
fn orders_force_into_a_set_the_initial_the_present_or_the_empty_situation() {
    assert_eq!(
        shown("F/G:{1, E2} IF a; F/G:{I}; F/G:{*}; F/G:{}; F / G : { I }"),
        "F/G:{1 E2} IF a; F/G:{I}; F/G:{*}; F/G:{}; F/G:{I}"
    );
}

#[test]
fn without_a_slash_f_is_a_variable() {
    assert_eq!(
        shown("F; F, A IF b; F = F + 1"),
        "F; F, A IF b; F = (+ F 1)"
    );
    assert_eq!(shown("A IF F/2 > 1"), "A IF (> (/ F 2) 1)");
}

#[test]
fn orders_that_are_not_complete() {
    assert_eq!(
        wrong_action("F/G"),
        "syntax 1: expected `:` behind the name of the graph, found the end of the line"
    );
    assert_eq!(
        wrong_action("F/G:2"),
        "syntax 1: expected a set of steps, found `2`"
    );
    assert_eq!(
        wrong_action("F/:{1}"),
        "syntax 1: expected the name of a graph behind `F/`, found `:`"
    );
}

#[test]
fn stored_statements_run_on_activation_deactivation_and_events() {
    assert_eq!(
        shown(
            "on activation: n = 0\non deactivation { a = 1; b = 2 IF c }\non event ↑d AND e: n = n + 1"
        ),
        "on activation: [n = 0]; on deactivation: [a = 1; b = 2 IF c]; on event (AND (↑ d) e): [n = (+ n 1)]"
    );
}

#[test]
fn a_qualified_name_in_an_event_stands_in_parentheses() {
    assert_eq!(shown("on event ↑(G:a): b = 1"), "on event (↑ G:a): [b = 1]");
    assert_eq!(
        shown("on event ↑a { G:b = 1 }"),
        "on event (↑ a): [G:b = 1]"
    );
    // The first colon ends the event.
    assert_eq!(shown("on event ↑a: G:b = 1"), "on event (↑ a): [G:b = 1]");
}

#[test]
fn an_event_may_compare_a_situation() {
    assert_eq!(
        shown("on event ↑(S(G) = {1}): a = 1"),
        "on event (↑ (S G = {1})): [a = 1]"
    );
    assert_eq!(
        shown("on event ↑S(G) = {1} { a = 1 }"),
        "on event (↑ (S G = {1})): [a = 1]"
    );
}

#[test]
fn on_takes_stored_statements_only() {
    assert_eq!(
        wrong_action("on activation: A"),
        "syntax 1: a momentary statement stands under `on`"
    );
    assert_eq!(
        wrong_action("on activation: F/H:{I}"),
        "syntax 1: a forcing order stands under `on`"
    );
    assert_eq!(
        wrong_action("on activation { on deactivation: a = 1 }"),
        "syntax 1: an `on` stands inside another `on`"
    );
}

#[test]
fn on_belongs_to_a_step() {
    assert_eq!(
        wrong("graph G { always { on event ↑a: b = 1 } }"),
        ["syntax 1: `on` stands in a stand-alone action"]
    );
}

#[test]
fn a_do_block_takes_stored_statements_only() {
    let action = transition("transition 1: 1 -> 2 when a do { n = n + 1; b = True IF c }").action;
    assert_eq!(show::block(&action.unwrap()), "n = (+ n 1); b = true IF c");
    for (statement, said) in [
        ("A", "a momentary statement stands in a `do` block"),
        ("F/H:{I}", "a forcing order stands in a `do` block"),
        (
            "on activation: a = 1",
            "a `do` block holds stored statements without `on`",
        ),
    ] {
        let text = format!("graph G {{ transition 1: 1 -> 2 do {{ {statement} }} }}");
        assert_eq!(wrong(&text), [format!("syntax 1: {said}")]);
    }
}

#[test]
fn a_text_alone_is_a_level_1_statement() {
    assert_eq!(shown("\"lower the gate\"; A"), "\"lower the gate\"; A");
}

#[test]
fn an_action_may_be_empty() {
    assert_eq!(shown(""), "");
    assert_eq!(graph("graph G { always { } }").elements.len(), 1);
}

#[test]
fn a_value_is_stored_in_one_variable() {
    assert_eq!(
        wrong_action("a, b = 1"),
        "syntax 1: a value is stored in several variables at once"
    );
}

#[test]
fn a_reserved_word_at_the_start_of_a_statement_is_reported_as_one() {
    for statement in ["output IF a", "step = 1", "scan", "on = 1", "IF"] {
        let said = wrong_action(statement);
        assert!(said.starts_with("reserved-word 1: "), "{statement}: {said}");
    }
    let on_its_line = wrong("graph G { step 1 {\noutput IF a\n} }");
    assert_eq!(
        on_its_line,
        ["reserved-word 2: `output` is a reserved word and cannot be a name"]
    );
}
