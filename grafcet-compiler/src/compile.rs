//! From the text of an application to what runs: every step, with everything that is wrong on the way.

use std::collections::BTreeSet;
use std::io;

use crate::application::Application;
use crate::diagnostic::{Diagnostic, Level, Rule};
use crate::model::{self, Model};
use crate::source::{Sources, Span};
use crate::{checks, lower};

/// So many errors, and so many warnings, are reported one by one.
pub const MOST_REPORTED: usize = 1000;

/// What an application is compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// Simulation, tests, traces: inputs and outputs need no address.
    Host,
    /// An image for a board: every input and output of the application has an address or a binding.
    Firmware,
    /// A drawing: what is only a text (level 1) is accepted, and nothing is made that could run.
    Drawing,
}

/// What compiling gives.
#[derive(Clone, Debug)]
pub struct Compilation {
    /// The main file and the libraries, for showing diagnostics.
    pub sources: Sources,
    /// Everything there is to say, by its place: the main file first.
    pub diagnostics: Vec<Diagnostic>,
    /// The program; none when there is an error, and none of a drawing.
    pub application: Option<Application>,
}

impl Compilation {
    /// Whether the program is refused.
    #[must_use]
    pub fn has_errors(&self) -> bool {
        has_errors(&self.diagnostics)
    }
}

/// Compiles an application. `path` is shown in diagnostics, and its stem names an application without a name; `load`
/// reads a library, whose path is relative to the directory of `path`.
pub fn compile(
    path: &str,
    text: &str,
    load: &dyn Fn(&str) -> io::Result<String>,
    target: Target,
) -> Compilation {
    let (sources, model, mut diagnostics) = analyse(path, text, load, target);
    let mut application = None;
    if !has_errors(&diagnostics) && target != Target::Drawing {
        match lower::lower(&model) {
            Ok(lowered) => application = Some(lowered),
            Err(beyond) => diagnostics.extend(beyond),
        }
    }
    sort(&mut diagnostics);
    Compilation {
        sources,
        diagnostics: limited(diagnostics),
        application,
    }
}

/// Everything but lowering: the model and what there is to say about it.
fn analyse(
    path: &str,
    text: &str,
    load: &dyn Fn(&str) -> io::Result<String>,
    target: Target,
) -> (Sources, Model, Vec<Diagnostic>) {
    let mut sources = Sources::default();
    let mut diagnostics = Vec::new();
    let files = model::load(path, text, load, &mut sources, &mut diagnostics);
    let (model, found) = model::resolve(&files, stem(path));
    take_fresh(&sources, &mut diagnostics, found);
    diagnostics.extend(checks::errors(&model, &sources, target));
    let settled = !has_errors(&diagnostics);
    diagnostics.extend(checks::warnings(&model, settled));
    if target == Target::Drawing {
        // Only now: what a text of level 1 uses is not known, so nothing can be said to be unused.
        diagnostics.retain(|it| it.rule != Rule::Level1Only);
    }
    (sources, model, diagnostics)
}

/// Adds what has been found, but no unknown name that stands, other than where it is used, in a line which the parser
/// could not read: what is declared there is not known.
fn take_fresh(sources: &Sources, diagnostics: &mut Vec<Diagnostic>, found: Vec<Diagnostic>) {
    const UNKNOWN: [Rule; 3] = [Rule::UnknownName, Rule::UnknownGraph, Rule::UnknownStep];
    let lines: BTreeSet<Span> = diagnostics
        .iter()
        .map(|it| line(sources, it.span))
        .collect();
    let unknown = found.iter().filter(|it| UNKNOWN.contains(&it.rule));
    let used: BTreeSet<Span> = unknown.map(|it| it.span).collect();
    let words = lines.iter().flat_map(|line| words(sources, *line));
    let unread: BTreeSet<&str> = words
        .filter(|word| !used.contains(word))
        .map(|word| sources.text(word))
        .collect();
    let may_be_declared = |name: &str| {
        let step = name.strip_prefix('X').unwrap_or(name);
        unread.contains(name) || unread.contains(step)
    };
    diagnostics.extend(
        found
            .into_iter()
            .filter(|it| !(UNKNOWN.contains(&it.rule) && may_be_declared(sources.text(it.span)))),
    );
}

/// The line in which a span begins.
fn line(sources: &Sources, span: Span) -> Span {
    let text = sources.get(span.file).map_or("", |source| &source.text);
    let (before, behind) = text
        .split_at_checked(span.start as usize)
        .unwrap_or((text, ""));
    let start = before.rfind('\n').map_or(0, |end| end + 1);
    let end = before.len() + behind.find('\n').unwrap_or(behind.len());
    let offset = |at| u32::try_from(at).unwrap_or(u32::MAX);
    Span {
        start: offset(start),
        end: offset(end),
        ..span
    }
}

/// The places of the names and numbers in a line.
fn words(sources: &Sources, line: Span) -> impl Iterator<Item = Span> {
    let mut start = line.start;
    let parts = sources
        .text(line)
        .split_inclusive(|c: char| !(c.is_alphanumeric() || c == '_'));
    parts.filter_map(move |part| {
        let length = |text: &str| u32::try_from(text.len()).unwrap_or(u32::MAX);
        let word = part.trim_end_matches(|c: char| !(c.is_alphanumeric() || c == '_'));
        let span = Span {
            start,
            end: start.saturating_add(length(word)),
            ..line
        };
        start = start.saturating_add(length(part));
        (!word.is_empty()).then_some(span)
    })
}

fn has_errors(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|it| it.level() == Level::Error)
}

/// By place; what two instances of one template have in common is said once.
fn sort(diagnostics: &mut Vec<Diagnostic>) {
    diagnostics.sort_by(|a, b| (a.span, a.rule, &a.message).cmp(&(b.span, b.rule, &b.message)));
    diagnostics.dedup_by(|a, b| a.span == b.span && a.rule == b.rule && a.message == b.message);
}

/// The first [`MOST_REPORTED`] errors and as many warnings, each with a remark when there are more.
fn limited(diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let count = |level| diagnostics.iter().filter(|it| it.level() == level).count();
    let totals = [Level::Error, Level::Warning].map(|level| (level, count(level)));
    let (mut errors, mut warnings) = (0, 0);
    let mut kept = Vec::with_capacity(diagnostics.len().min(2 * MOST_REPORTED));
    for diagnostic in diagnostics {
        let seen = match diagnostic.level() {
            Level::Error => &mut errors,
            Level::Warning => &mut warnings,
        };
        *seen += 1;
        if *seen <= MOST_REPORTED {
            kept.push(diagnostic);
        } else if *seen == MOST_REPORTED + 1 {
            kept.push(and_more(&diagnostic, totals));
        }
    }
    kept
}

/// The remark that stands for the first diagnostic that is left out and all behind it.
fn and_more(first: &Diagnostic, totals: [(Level, usize); 2]) -> Diagnostic {
    let level = first.level();
    let total = totals.iter().find(|it| it.0 == level).map_or(0, |it| it.1);
    let word = match level {
        Level::Error => "errors",
        Level::Warning => "warnings",
    };
    let more = total - MOST_REPORTED;
    let message = format!("and so on: {more} more {word} from here on are not shown");
    Diagnostic::new(first.rule, first.span, message)
}

/// `lib/saw.grafcet` is called `saw`.
fn stem(path: &str) -> &str {
    let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
    name.strip_suffix(".grafcet").unwrap_or(name)
}
