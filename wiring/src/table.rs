//! Reading one table of a TOML file: every value with its place, everything wrong with it reported.

use std::fmt::Display;
use std::ops::{Range, RangeInclusive};

use grafcet_compiler::source::{FileId, Span};
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use crate::duration;
use crate::nearest::nearest;
use crate::rule::{Diagnostic, Rule};

/// A value and where it is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Placed<T> {
    /// The value.
    pub value: T,
    /// Its place.
    pub span: Span,
}

impl Placed<&str> {
    pub(crate) fn into_owned(self) -> Placed<String> {
        Placed {
            value: self.value.to_owned(),
            span: self.span,
        }
    }
}

/// What is found wrong in one file.
#[derive(Debug)]
pub(crate) struct Report {
    pub(crate) file: FileId,
    pub(crate) diagnostics: Vec<Diagnostic>,
}

impl Report {
    pub(crate) fn span(&self, range: Range<usize>) -> Span {
        let offset = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
        Span {
            file: self.file,
            start: offset(range.start),
            end: offset(range.end),
        }
    }

    pub(crate) fn push(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }
}

/// A table with a description of itself for messages: `an input`, `[retain]`.
#[derive(Clone, Copy)]
pub(crate) struct Table<'t> {
    pub(crate) table: &'t DeTable<'t>,
    pub(crate) span: Span,
    pub(crate) what: &'static str,
}

impl<'t> Table<'t> {
    /// Reports every key but the known ones.
    pub(crate) fn expect_keys(&self, known: &[&str], report: &mut Report) {
        for (key, _) in self.table {
            if known.contains(&key.get_ref().as_ref()) {
                continue;
            }
            let message = format!("{} has no key `{}`", self.what, key.get_ref());
            let span = report.span(key.span());
            let help = match nearest(key.get_ref(), known.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("the keys here are {}", listed(known)),
            };
            report.push(Diagnostic::new(Rule::UnknownKey, span, message).help(help));
        }
    }

    /// The keys and values of the table.
    pub(crate) fn entries(
        &self,
    ) -> impl Iterator<Item = (&'t Spanned<DeString<'t>>, &'t Spanned<DeValue<'t>>)> + use<'t> {
        self.table.iter()
    }

    /// Whether the key is there.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.table.contains_key(key)
    }

    /// A table within the table; none when it is missing or no table.
    pub(crate) fn table(
        &self,
        key: &str,
        what: &'static str,
        report: &mut Report,
    ) -> Option<Table<'t>> {
        let value = self.table.get(key)?;
        let span = report.span(value.span());
        match value.get_ref() {
            DeValue::Table(table) => Some(Table { table, span, what }),
            _ => {
                let message = format!("`{key}` is a table");
                report.push(Diagnostic::new(Rule::BadValue, span, message).help(format!(
                    "write `[{key}]` on a line of its own and its keys below it"
                )));
                None
            }
        }
    }

    /// A text; none when it is missing or no text. A missing one is reported only if it is `required`.
    pub(crate) fn string(
        &self,
        key: &str,
        required: Option<&str>,
        example: &str,
        report: &mut Report,
    ) -> Option<Placed<&'t str>> {
        let Some(value) = self.table.get(key) else {
            if let Some(reason) = required {
                let message = format!("{} has no `{key}`: {reason}", self.what);
                report.push(
                    Diagnostic::new(Rule::MissingKey, self.span, message)
                        .help(format!("write `{key} = {example}`")),
                );
            }
            return None;
        };
        let span = report.span(value.span());
        match value.get_ref() {
            DeValue::String(text) => Some(Placed { value: text, span }),
            _ => {
                let message = format!("`{key}` is a text in quotes");
                report.push(
                    Diagnostic::new(Rule::BadValue, span, message)
                        .help(format!("write `{key} = {example}`")),
                );
                None
            }
        }
    }

    /// One of a few words; the default when it is missing or none of them.
    pub(crate) fn choice<T: Copy>(
        &self,
        key: &str,
        words: &[(&str, T)],
        report: &mut Report,
    ) -> Option<T> {
        let names: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        let example = names
            .first()
            .map(|word| format!("\"{word}\""))
            .unwrap_or_default();
        let text = self.string(key, None, &example, report)?;
        let found = words.iter().find(|(word, _)| *word == text.value);
        if found.is_none() {
            let message = format!("`{key}` is {}, not `{}`", alternatives(&names), text.value);
            let mut diagnostic = Diagnostic::new(Rule::BadValue, text.span, message);
            if let Some(near) = nearest(text.value, names.iter().copied()) {
                diagnostic = diagnostic.help(format!("did you mean `\"{near}\"`?"));
            }
            report.push(diagnostic);
        }
        found.map(|(_, value)| *value)
    }

    /// A duration in ms within a range; none when it is missing or none.
    pub(crate) fn duration(
        &self,
        key: &str,
        range: RangeInclusive<u32>,
        example: &str,
        report: &mut Report,
    ) -> Option<Placed<u32>> {
        let text = self.string(key, None, example, report)?;
        let bad = |rule, message: String, help: String| {
            Diagnostic::new(rule, text.span, message).help(help)
        };
        match duration::milliseconds(text.value) {
            Err(fault) => {
                report.push(bad(Rule::BadDuration, fault.message, fault.help));
                None
            }
            Ok(ms) => match u32::try_from(ms).ok().filter(|ms| range.contains(ms)) {
                Some(value) => Some(Placed {
                    value,
                    span: text.span,
                }),
                None => {
                    let message = format!("`{key}` is out of range");
                    let (low, high) = (
                        duration::shown(*range.start()),
                        duration::shown(*range.end()),
                    );
                    let help = format!("it lies from {low} to {high}");
                    report.push(bad(Rule::OutOfRange, message, help));
                    None
                }
            },
        }
    }

    /// A whole number within a range; none when it is missing or none.
    pub(crate) fn integer<T: TryFrom<i64> + PartialOrd + Display>(
        &self,
        key: &str,
        range: RangeInclusive<T>,
        example: &str,
        unit: &str,
        report: &mut Report,
    ) -> Option<Placed<T>> {
        let value = self.table.get(key)?;
        let span = report.span(value.span());
        let DeValue::Integer(integer) = value.get_ref() else {
            let message = format!("`{key}` is a whole number");
            report.push(
                Diagnostic::new(Rule::BadValue, span, message)
                    .help(format!("write `{key} = {example}`")),
            );
            return None;
        };
        let value = i64::from_str_radix(integer.as_str(), integer.radix()).ok();
        let value = value.and_then(|value| T::try_from(value).ok());
        match value.filter(|value| range.contains(value)) {
            Some(value) => Some(Placed { value, span }),
            None => {
                let message = format!("`{key}` is out of range");
                let help = format!("it lies from {} to {}{unit}", range.start(), range.end());
                report.push(Diagnostic::new(Rule::OutOfRange, span, message).help(help));
                None
            }
        }
    }
}

/// `a, b and c`, each in backticks.
pub(crate) fn listed(names: &[&str]) -> String {
    joined(names, "and", |name| format!("`{name}`"))
}

/// `"a", "b" or "c"`.
fn alternatives(words: &[&str]) -> String {
    joined(words, "or", |word| format!("`\"{word}\"`"))
}

fn joined(words: &[&str], last: &str, quoted: impl Fn(&str) -> String) -> String {
    let words: Vec<String> = words.iter().map(|word| quoted(word)).collect();
    match words.as_slice() {
        [] => String::new(),
        [word] => word.clone(),
        [words @ .., word] => format!("{} {last} {word}", words.join(", ")),
    }
}
