//! How large a program may be: large ones compile, too large ones are refused with the limit.

use std::fmt::Write as _;

use grafcet_compiler::diagnostic::Rule;
use grafcet_compiler::{MOST_REPORTED, Target, compile};

use crate::tables;

fn refused(text: &str) -> Vec<String> {
    let compilation = compile(
        "large.grafcet",
        text,
        &|path| panic!("{path}"),
        Target::Host,
    );
    assert!(compilation.application.is_none());
    let errors = compilation
        .diagnostics
        .into_iter()
        .filter(|it| it.rule == Rule::OutOfRange);
    errors.map(|it| it.message).collect()
}

#[test]
fn a_chain_of_a_thousand_steps_compiles() {
    let mut text = "input a\ngraph G {\ninitial step 1\n".to_owned();
    for step in 2..=1000 {
        let _ = writeln!(
            text,
            "step {step}\ntransition {step}: {} -> {step} when ↑a AND T/X{}/1s",
            step - 1,
            step - 1
        );
    }
    let tables = tables(&(text + "}"));
    assert_eq!(tables.steps.len(), 1000);
    assert_eq!(tables.graphs[0].words.len, 32);
    assert_eq!(tables.layout.stamps, 999);
    // The edges of all inputs at once, and each timer where it is asked for.
    assert_eq!((tables.edges.len(), tables.watches.len()), (1, 0));
    assert_eq!((tables.timers.len(), tables.ops.len()), (999, 0));
}

#[test]
fn ten_thousand_steps_in_a_thousand_graphs_compile() {
    let mut text = "input a, b\n".to_owned();
    for graph in 0..1000 {
        let _ = writeln!(text, "graph G{graph} {{ output M; initial step 1");
        for step in 2..=10 {
            let _ = writeln!(
                text,
                "step {step} {{ M IF a }}\ntransition {step}: {} -> {step} when a AND NOT b",
                step - 1
            );
        }
        text += "}\n";
    }
    let tables = tables(&text);
    assert_eq!((tables.graphs.len(), tables.steps.len()), (1000, 10_000));
    assert_eq!((tables.terms.len(), tables.arms.len()), (1, 9000));
}

#[test]
fn a_hundred_deep_expression_compiles() {
    let deep = (0..100).fold("a".to_owned(), |inner, _| {
        format!("NOT ({inner} OR b XOR a)")
    });
    let tables = tables(&format!(
        "input a, b\ngraph G {{ initial step 1; transition 1: 1 -> 1 when {deep} }}"
    ));
    assert!(tables.ops.len() > 400);
}

#[test]
fn too_many_booleans_are_refused_with_the_limit() {
    let names: Vec<String> = (0..66_000).map(|index| format!("v{index}")).collect();
    let text = format!(
        "input a\nvar {}\ngraph G {{ initial step 1 {{ v0 = a }} }}",
        names.join(", ")
    );
    let said = refused(&text);
    assert_eq!(said.len(), 1);
    assert!(
        said[0].contains("at most 65535 Booleans") && said[0].contains("needs 66"),
        "{said:?}"
    );
}

#[test]
fn too_many_transitions_are_refused_with_the_limit() {
    let mut text = "input a\ngraph G {\ninitial step 1\n".to_owned();
    for number in 0..65_536 {
        let _ = writeln!(text, "transition {number}: 1 -> 1 when a");
    }
    let said = refused(&(text + "}"));
    assert!(
        said.iter()
            .any(|it| it.contains("at most 65535 transitions; this one needs 65536")),
        "{said:?}"
    );
}

#[test]
fn too_long_an_expression_is_refused_with_the_limit() {
    let long = vec!["(a OR NOT b)"; 20_000].join(" AND ");
    let said = refused(&format!(
        "input a, b\ngraph G {{ initial step 1; transition 1: 1 -> 1 when {long} }}"
    ));
    assert_eq!(
        said,
        ["an expression becomes at most 65535 operations; this one needs 99999"]
    );
}

#[test]
fn a_flood_of_errors_is_reported_as_far_as_anyone_reads() {
    let names: Vec<String> = (0..3000).map(|index| format!("v{index}")).collect();
    let text = format!("graph G {{ initial step 1 {{ {} }} }}", names.join("; "));
    let compilation = compile(
        "flood.grafcet",
        &text,
        &|path| panic!("{path}"),
        Target::Host,
    );
    assert_eq!(compilation.diagnostics.len(), MOST_REPORTED + 1);
    let last = compilation.diagnostics.last().unwrap();
    assert_eq!(last.rule, Rule::UnknownName);
    assert_eq!(
        last.message,
        "and so on: 2000 more errors from here on are not shown"
    );
}
