//! How large a program may be: tables are indexed by 16 bits.

use crate::application::Tables;
use crate::diagnostic::{Diagnostic, Rule};
use crate::source::Span;

/// Rows of a table, and bits of an image, at most.
pub(super) const MOST: usize = 65_535;

/// Rows of a table that one step has, at most.
pub(super) const MOST_OF_A_STEP: usize = 255;

/// An index as tables hold it. One that is too large becomes the largest, and the program is refused in the end.
pub(super) fn index(value: usize) -> u16 {
    u16::try_from(value).unwrap_or(u16::MAX)
}

/// A number of rows that one step has. One that is too large becomes the largest, and the program is refused.
pub(super) fn count(value: usize) -> u8 {
    u8::try_from(value).unwrap_or(u8::MAX)
}

/// Reports what a program has too much of.
pub(super) fn check(tables: &Tables, bits: usize, stamps: usize, whole: Span) -> Vec<Diagnostic> {
    let counts = [
        (
            bits,
            "Booleans: steps, variables, and the memories of edges and timers",
        ),
        (stamps, "timers"),
        (tables.steps.len(), "steps"),
        (tables.transitions.len(), "transitions"),
        (tables.graphs.len(), "graphs"),
        (
            tables.crossings.len(),
            "ways in which transitions join steps",
        ),
        (tables.do_blocks.len(), "`do` blocks"),
        (tables.links.len(), "entrances and exits of transitions"),
        (
            tables.situations.len(),
            "words of situations that are initial, forced or enclosed",
        ),
        (tables.enclosings.len(), "enclosed graphs"),
        (tables.orders.len(), "forcing statements"),
        (tables.stored.len(), "stored statements"),
        (tables.events.len(), "event statements"),
        (tables.momentary.len(), "momentary statements"),
        (
            tables.dependent.len(),
            "momentary statements that depend on others",
        ),
        (tables.watches.len(), "edges and timers"),
        (tables.targets.len(), "sets of momentary variables"),
        (tables.conditions.len(), "conditions"),
        (tables.terms.len(), "parts of conditions"),
        (tables.timers.len(), "timers on steps"),
        (tables.codes.len(), "calculated conditions"),
        (tables.numbers.len(), "numbers"),
        (tables.retained.len(), "retained variables"),
    ];
    let beyond = counts.into_iter().filter(|(count, _)| *count > MOST);
    beyond
        .map(|(count, what)| {
            let message = format!("a program holds at most {MOST} {what}; this one needs {count}");
            Diagnostic::new(Rule::OutOfRange, whole, message)
        })
        .collect()
}

/// Reports an expression that is too long.
pub(super) fn too_long(operations: usize, span: Span) -> Diagnostic {
    let message =
        format!("an expression becomes at most {MOST} operations; this one needs {operations}");
    Diagnostic::new(Rule::OutOfRange, span, message).help("store a part of it in a variable")
}

/// Reports a step that has too much of something.
pub(super) fn too_many(count: usize, what: &str, span: Span) -> Diagnostic {
    let message = format!("a step has at most {MOST_OF_A_STEP} {what}; this one has {count}");
    Diagnostic::new(Rule::OutOfRange, span, message)
}
