//! The canonical layout of a text.

#![allow(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

mod comments;
#[path = "../corpus/mod.rs"]
mod corpus;
mod layout;
mod lines;
mod sameness;

use grafcet_compiler::format::{Unformatted, format};
use grafcet_compiler::source::FileId;

/// A text in its layout, which laid out again stays as it is.
#[track_caller]
fn formatted(text: &str) -> String {
    let formatted = format(FileId(0), text).unwrap_or_else(|reason| panic!("{reason:?}\n{text}"));
    let again =
        format(FileId(0), &formatted).unwrap_or_else(|reason| panic!("{reason:?}\n{formatted}"));
    assert_eq!(again, formatted, "laid out twice");
    formatted
}

/// The action of a step in its layout.
#[track_caller]
fn action(text: &str) -> String {
    let formatted = formatted(&format!("graph G {{\nstep 1 {{\n{text}\n}}\n}}"));
    inside(&formatted, "graph G {\n    step 1 {\n", "    }\n}\n", 8)
}

/// The body of a graph in its layout.
#[track_caller]
fn body(text: &str) -> String {
    inside(
        &formatted(&format!("graph G {{\n{text}\n}}")),
        "graph G {\n",
        "}\n",
        4,
    )
}

#[track_caller]
fn inside(text: &str, before: &str, behind: &str, indent: usize) -> String {
    let inside = text
        .strip_prefix(before)
        .and_then(|it| it.strip_suffix(behind));
    let lines = inside.unwrap_or_else(|| panic!("{text}")).lines();
    lines
        .map(|line| {
            line.strip_prefix(&" ".repeat(indent))
                .unwrap_or(line)
                .to_owned()
                + "\n"
        })
        .collect()
}
