//! Large files: bounded stack, an answer for everything, and stated limits.

use super::{graph, read, right, transition};
use grafcet_compiler::ast::{Element, Item};
use grafcet_compiler::parser::{MAX_EXPRESSION_DEPTH, MAX_NESTING, MAX_SYNTAX_ERRORS, MAX_WORD};

const MEGABYTE: usize = 1 << 20;

/// A part again and again, so many bytes long.
fn repeated(part: &str, bytes: usize) -> String {
    part.repeat(bytes / part.len())
}

#[test]
fn a_megabyte_of_nesting_gets_an_answer() {
    for (part, said) in [
        (
            "(",
            "expected a declaration, a graph, a plant, a property or a test, found `(`",
        ),
        (
            "{",
            "expected a declaration, a graph, a plant, a property or a test, found `{`",
        ),
        ("(*", "this comment is not closed"),
        ("graph G {\n", "`G` is not closed"),
        (
            "macro step M1 {",
            "expected a declaration, a graph, a plant, a property or a test, found `macro`",
        ),
    ] {
        let (_, diagnostics) = read(&repeated(part, MEGABYTE));
        assert_eq!(diagnostics[0].message, said);
        assert!(diagnostics.len() <= MAX_SYNTAX_ERRORS + 1);
    }
    let (_, diagnostics) = read(&format!(
        "graph G {{ step 1 {{ A IF {}",
        repeated("(", MEGABYTE)
    ));
    assert_eq!(
        diagnostics[0].message,
        "more than 200 levels are nested in each other"
    );
    let (_, diagnostics) = read(&format!(
        "graph G {{ {}",
        repeated("macro step M1 {", MEGABYTE)
    ));
    assert_eq!(
        diagnostics[0].message,
        "more than 200 levels are nested in each other"
    );
}

#[test]
fn everything_again_and_again_gets_an_answer() {
    for part in [
        "(",
        ")",
        "{",
        "}",
        "((",
        "(* *)",
        "//",
        "/*",
        "\"",
        "\n",
        ";",
        "@",
        "@ ",
        "a",
        "a ",
        "a.",
        "9",
        "9 ",
        "1s ",
        "1 s ",
        "NOT ",
        "- ",
        "↑",
        "T/",
        "a AND ",
        "a OR (",
        "F/",
        "on activation {",
        "step ",
        "step 1 {",
        "graph ",
        "graph G {",
        "S(",
        "{1,",
        "input a\n",
        "e\u{301}",
        "%",
        "%a",
        "T#1s",
        "property \"",
        "test \"t\" {",
        "=",
        "= (",
        "->",
        "'",
    ] {
        for head in ["", "graph G { step 1 { A IF ", "test \"t\" { wait "] {
            let (_, diagnostics) = read(&format!("{head}{}", repeated(part, MEGABYTE / 32)));
            assert!(diagnostics.len() <= MAX_SYNTAX_ERRORS + 1, "{head}{part}");
        }
    }
}

#[test]
fn a_hundred_nested_parentheses_are_fine_and_too_many_are_refused() {
    let nested = |depth: usize| {
        format!(
            "graph G {{ transition 1: 1 -> 2 when {}a{}\n}}",
            "(".repeat(depth),
            ")".repeat(depth)
        )
    };
    right(&nested(100));
    right(&nested(MAX_NESTING as usize));
    let (_, diagnostics) = read(&nested(MAX_NESTING as usize + 1));
    assert_eq!(diagnostics.len(), 1);
    assert_eq!(
        diagnostics[0].message,
        "more than 200 levels are nested in each other"
    );
}

#[test]
fn nested_operators_of_every_strength_fit_the_stack() {
    let depth = MAX_NESTING as usize / 2;
    let text = format!(
        "{}a{}",
        "NOT a OR a XOR a AND a = a + a * (".repeat(depth),
        ")".repeat(depth)
    );
    let (_, diagnostics) = read(&format!("graph G {{ transition 1: 1 -> 2 when {text}\n}}"));
    // Every level adds six to the depth of the tree.
    assert_eq!(diagnostics.len(), 1);
    assert!(
        diagnostics[0].message.contains("more than 256 levels"),
        "{diagnostics:?}"
    );
}

#[test]
fn ten_thousand_operands_of_and_are_a_shallow_tree() {
    for operator in [" AND ", " OR ", " XOR "] {
        let operands = vec!["a"; 10_000].join(operator);
        let transition = transition(&format!("transition 1: 1 -> 2 when {operands}"));
        assert!(format!("{:?}", transition.trigger).len() > 10_000);
    }
}

#[test]
fn a_sum_may_be_as_long_as_a_tree_is_deep() {
    let sum = |operands: usize| {
        format!(
            "graph G {{ transition 1: 1 -> 2 when 0 < {}\n}}",
            vec!["a"; operands].join(" + ")
        )
    };
    right(&sum(MAX_EXPRESSION_DEPTH as usize - 1));
    let (_, diagnostics) = read(&sum(10_000));
    assert_eq!(diagnostics.len(), 1);
    assert_eq!(
        diagnostics[0].message,
        "this expression has more than 256 levels"
    );
}

#[test]
fn ten_thousand_steps_in_a_thousand_graphs_are_read() {
    let mut text = String::new();
    for graph in 0..1_000 {
        text += &format!("graph G{graph} {{\n");
        for step in 1..=10 {
            text += &format!(
                "step {step} {{ A }}\ntransition {step}: {step} -> {} when a\n",
                step % 10 + 1
            );
        }
        text += "}\n";
    }
    let file = right(&text);
    let steps: usize = file
        .items
        .iter()
        .map(|item| match item {
            Item::Graph(graph) => graph
                .elements
                .iter()
                .filter(|element| matches!(element, Element::Step(_)))
                .count(),
            _ => 0,
        })
        .sum();
    assert_eq!(steps, 10_000);
}

#[test]
fn a_long_name_and_a_long_text_are_names_and_texts() {
    let name = "a".repeat(MAX_WORD);
    let text = "a".repeat(100_000);
    let graph = graph(&format!("graph {name} \"{text}\" {{ }}"));
    assert_eq!(graph.name.text, name);
}

#[test]
fn after_many_errors_the_rest_is_not_looked_at_and_that_is_said() {
    let (_, diagnostics) = read(&"imput a\n".repeat(10_000));
    assert_eq!(diagnostics.len(), MAX_SYNTAX_ERRORS + 1);
    assert_eq!(
        diagnostics.last().unwrap().message,
        "more than 500 errors in one file; what follows is not looked at"
    );
}
