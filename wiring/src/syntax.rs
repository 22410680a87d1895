//! What TOML itself has to say.

use grafcet_compiler::source::Span;
use toml::de::{DeTable, DeValue, Error};

use crate::rule::{Diagnostic, Rule};
use crate::table::Report;

/// Reports the errors of a parse: every key that is there twice, and the first error of every line, which is seldom
/// wrong while its successors often are.
pub(crate) fn report_errors(
    text: &str,
    table: &DeTable<'_>,
    errors: &[Error],
    report: &mut Report,
) {
    let mut errors: Vec<_> = errors
        .iter()
        .map(|error| (error.span().unwrap_or(0..0), error.message()))
        .collect();
    errors.sort_by_key(|(range, _)| range.start);
    let mut last_line = None;
    for (range, message) in errors {
        let line = line_of(text, range.start);
        if last_line.replace(line) == Some(line) {
            continue;
        }
        let span = report.span(range.clone());
        let mut diagnostic = Diagnostic::new(Rule::Toml, span, message);
        if message == DUPLICATE {
            let key = text.get(range.clone()).unwrap_or_default();
            diagnostic.message = format!("{key} is written twice");
            if let Some(first) = first_of(key, table, range.start, text, report) {
                diagnostic = diagnostic.label(first, "first here");
            }
        } else if line.1.trim_start().starts_with('%') {
            diagnostic = diagnostic.help("an address stands in quotes: `\"%IX0.0\" = ..`");
        }
        report.push(diagnostic);
    }
}

/// True when the errors leave the tree as it was meant.
pub(crate) fn are_duplicates_only(errors: &[Error]) -> bool {
    errors.iter().all(|error| error.message() == DUPLICATE)
}

/// How the library calls a key that is there twice.
const DUPLICATE: &str = "duplicate key";

/// The line's first byte and its text.
fn line_of(text: &str, at: usize) -> (usize, &str) {
    let before = text.get(..at).unwrap_or(text);
    let start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let line = text.get(start..).unwrap_or_default();
    (start, line.lines().next().unwrap_or_default())
}

/// The last key before `at` that is spelt so: the one that is repeated there.
fn first_of(
    key: &str,
    table: &DeTable<'_>,
    at: usize,
    text: &str,
    report: &Report,
) -> Option<Span> {
    let mut found = None;
    visit(table, &mut |range| {
        if range.start < at && text.get(range.clone()) == Some(key) {
            found = found.max(Some((range.start, range.end)));
        }
    });
    found.map(|(start, end)| report.span(start..end))
}

fn visit(table: &DeTable<'_>, see: &mut impl FnMut(std::ops::Range<usize>)) {
    for (key, value) in table {
        see(key.span());
        if let DeValue::Table(table) = value.get_ref() {
            visit(table, see);
        }
    }
}
