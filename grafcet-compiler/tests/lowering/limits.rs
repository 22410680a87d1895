//! How large a program may be: large ones compile, too large ones are refused with the limit.

use std::fmt::Write as _;

use grafcet_compiler::diagnostic::Rule;
use grafcet_compiler::{MOST_REPORTED, Target, compile};

use crate::tables;

/// The limits that a text is beyond; there is one at least.
fn refused(text: &str) -> Vec<String> {
    let said = refused_if_at_all(text);
    assert!(!said.is_empty(), "nothing is beyond a limit");
    said
}

/// The limits that a text is beyond.
fn refused_if_at_all(text: &str) -> Vec<String> {
    let compilation = compile(
        "large.grafcet",
        text,
        &|path| panic!("{path}"),
        Target::Host,
    );
    assert_eq!(compilation.application.is_none(), compilation.has_errors());
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
    assert_eq!(tables.graphs[0].words().len, 32);
    assert_eq!((tables.layout.stamps, tables.layout.since), (0, 999));
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
    assert_eq!((tables.terms.len(), tables.arms.len()), (2, 9000));
    // What graphs have alike they share.
    assert_eq!((tables.conditions.len(), tables.crossings.len()), (2, 9));
    assert_eq!((tables.momentary.len(), tables.targets.len()), (1000, 1000));
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

/// A part again and again, numbered.
fn so_many(count: usize, part: impl Fn(usize) -> String) -> String {
    (0..count).map(part).collect()
}

/// The largest count of something that compiles, and the next one, which is refused with the limit.
fn up_to(most: usize, program: impl Fn(usize) -> String, limit: &str) {
    assert_eq!(refused_if_at_all(&program(most)), Vec::<String>::new());
    let said = refused(&program(most + 1));
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(said[0].contains(limit), "{said:?}");
}

#[test]
fn booleans_have_a_limit() {
    // One word is the system's, one the situation's, and the next after these would be the 65 536th.
    let most = 65_535 / 32 * 32 - 64;
    let program = |count| {
        let names = so_many(count, |n| format!("var v{n}\n"));
        format!("{names}graph G {{ initial step 1 {{ v0 = TRUE }} }}")
    };
    up_to(most, program, "at most 65535 Booleans");
}

#[test]
fn numbers_have_a_limit() {
    // Two are the system's.
    let program = |count| {
        let names = so_many(count, |n| format!("var v{n} : int\n"));
        format!("{names}graph G {{ initial step 1 {{ v0 = 1 }} }}")
    };
    up_to(
        65_533,
        program,
        "at most 65535 numbers; this one needs 65536",
    );
}

#[test]
fn transitions_have_a_limit() {
    let program = |count| {
        let all = so_many(count, |n| format!("transition {n}: -> 1 when a\n"));
        format!("input a\ngraph G {{ initial step 1\n{all} }}")
    };
    let transitions = "at most 65535 transitions; this one needs 65536";
    assert_eq!(refused_if_at_all(&program(65_535)), Vec::<String>::new());
    let said = refused(&program(65_536));
    assert!(said.iter().any(|it| it.contains(transitions)), "{said:?}");
}

#[test]
fn graphs_have_a_limit() {
    let program = |count| so_many(count, |n| format!("graph G{n} {{}}\n"));
    up_to(
        65_535,
        program,
        "at most 65535 graphs; this one needs 65536",
    );
}

#[test]
fn statements_of_each_kind_have_a_limit() {
    let program = |statement: &str, count| {
        let all = so_many(count, |_| format!("{statement}\n"));
        format!(
            "input a\noutput M\nvar n : int\n\
             graph G {{ initial step 1 {{ {all} }} }}\ngraph H {{ initial step 1 }}"
        )
    };
    for (statement, what) in [
        ("n = n + 1", "stored statements"),
        ("F/H:{1} IF a", "forcing statements"),
    ] {
        let limit = format!("at most 65535 {what}; this one needs 65536");
        up_to(65_535, |count| program(statement, count), &limit);
    }
    let always = |count| {
        let all = so_many(count, |_| "M\n".to_owned());
        format!("output M\ngraph G {{ initial step 1\nalways {{ {all} }} }}")
    };
    up_to(
        65_535,
        always,
        "at most 65535 momentary statements; this one needs 65536",
    );
    up_to(
        255,
        |count| program("M", count),
        "a step has at most 255 momentary statements; this one has 256",
    );
}

#[test]
fn the_transitions_behind_a_step_have_a_limit() {
    let program = |count| {
        let all = so_many(count, |n| format!("transition {n}: 1 -> 1 when a\n"));
        format!("input a\ngraph G {{ initial step 1\n{all} }}")
    };
    up_to(
        255,
        program,
        "a step has at most 255 transitions that have it as their first entrance step; this one has 256",
    );
}

#[test]
fn an_expression_has_a_limit() {
    let program = |operands: usize| {
        let chain = vec!["a"; operands].join(" XOR ");
        format!("input a\ngraph G {{ initial step 1; transition 1: 1 -> 1 when {chain} }}")
    };
    // An operation for each operand and each operator.
    let limit = "an expression becomes at most 65535 operations; this one needs 65537";
    up_to(32_768, program, limit);
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
