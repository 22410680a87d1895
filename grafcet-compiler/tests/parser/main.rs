//! What the parser makes of a text, and what it says of a wrong one.

mod declarations;
mod expressions;
mod graphs;
mod lexical;
mod limits;
mod line_breaks;
mod literals;
mod recovery;
mod show;
mod statements;
mod tests_and_properties;
mod timers;
mod wrong_programs;

use grafcet_compiler::ast::{Element, File, Graph, Item, Statement, Step, Transition};
use grafcet_compiler::diagnostic::Diagnostic;
use grafcet_compiler::parser::parse;
use grafcet_compiler::source::FileId;

/// Reads a text that may be wrong.
fn read(text: &str) -> (File, Vec<Diagnostic>) {
    let mut diagnostics = Vec::new();
    let file = parse(FileId(0), text, &mut diagnostics);
    (file, diagnostics)
}

/// Reads a text that is right.
#[track_caller]
fn right(text: &str) -> File {
    let (file, diagnostics) = read(text);
    assert_eq!(diagnostics, [], "{text}");
    file
}

/// Each diagnostic of a wrong text as `rule line: message`, in the order of their places.
#[track_caller]
fn wrong(text: &str) -> Vec<String> {
    let (_, mut diagnostics) = read(text);
    assert!(!diagnostics.is_empty(), "nothing is wrong with {text:?}");
    diagnostics.sort_by_key(|diagnostic| diagnostic.span);
    let line =
        |diagnostic: &Diagnostic| text[..diagnostic.span.start as usize].matches('\n').count() + 1;
    diagnostics
        .iter()
        .map(|diagnostic| {
            format!(
                "{} {}: {}",
                diagnostic.rule.name(),
                line(diagnostic),
                diagnostic.message
            )
        })
        .collect()
}

/// The only graph of a text that is right.
#[track_caller]
fn graph(text: &str) -> Graph {
    let graph = right(text).items.into_iter().find_map(|item| match item {
        Item::Graph(graph) | Item::Plant(graph) | Item::Template(graph) => Some(graph),
        _ => None,
    });
    graph.unwrap_or_else(|| panic!("no graph in {text:?}"))
}

/// The only transition of `graph G { .. }`.
#[track_caller]
fn transition(text: &str) -> Transition {
    let elements = graph(&format!("graph G {{\n{text}\n}}")).elements;
    let transition = elements.into_iter().find_map(|element| match element {
        Element::Transition(transition) => Some(transition),
        _ => None,
    });
    transition.unwrap_or_else(|| panic!("no transition in {text:?}"))
}

/// The first step of `graph G { .. }`.
#[track_caller]
fn step(text: &str) -> Step {
    let elements = graph(&format!("graph G {{\n{text}\n}}")).elements;
    let step = elements.into_iter().find_map(|element| match element {
        Element::Step(step) => Some(step),
        _ => None,
    });
    step.unwrap_or_else(|| panic!("no step in {text:?}"))
}

/// The statements of a step's action.
#[track_caller]
fn statements(text: &str) -> Vec<Statement> {
    step(&format!("step 1 {{ {text} }}"))
        .block
        .unwrap_or_default()
        .statements
}

/// A trigger as a tree: `(AND a b)`.
#[track_caller]
fn tree(trigger: &str) -> String {
    show::trigger(&transition(&format!("transition 1: 1 -> 2 when {trigger}")).trigger)
}

/// What is wrong with a trigger.
#[track_caller]
fn wrong_trigger(trigger: &str) -> String {
    wrong(&format!(
        "graph G {{ transition 1: 1 -> 2 when {trigger}\n}}"
    ))
    .join("\n")
}

/// The example of the language's description.
#[test]
fn the_drill_press_reads_without_a_diagnostic() {
    let file = right(include_str!("drill_press.grafcet"));
    assert_eq!(file.items.len(), 12);
}
