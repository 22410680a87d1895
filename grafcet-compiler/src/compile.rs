//! From the text of an application to what runs: every step, with everything that is wrong on the way.

use std::collections::BTreeSet;
use std::io;

use crate::application::Application;
use crate::diagnostic::{Diagnostic, Level, Rule};
use crate::model::{self, Model};
use crate::source::{Sources, Span};
use crate::{checks, lower};

/// What an application is compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// Simulation, tests, traces: inputs and outputs need no address.
    Host,
    /// An image for a board: every input and output of the application has an address or a binding.
    Firmware,
}

/// What compiling gives.
#[derive(Clone, Debug)]
pub struct Compilation {
    /// The main file and the libraries, for showing diagnostics.
    pub sources: Sources,
    /// Everything there is to say, by its place: the main file first.
    pub diagnostics: Vec<Diagnostic>,
    /// The program; none when there is an error.
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
    if !has_errors(&diagnostics) {
        match lower::lower(&model) {
            Ok(lowered) => application = Some(lowered),
            Err(beyond) => diagnostics.extend(beyond),
        }
    }
    sort(&mut diagnostics);
    Compilation {
        sources,
        diagnostics,
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
    take_fresh(&mut diagnostics, found);
    diagnostics.extend(checks::errors(&model, &sources, target));
    let settled = !has_errors(&diagnostics);
    diagnostics.extend(checks::warnings(&model, settled));
    (sources, model, diagnostics)
}

/// Adds what has been found, but no unknown name in a place where the parser has already refused one.
fn take_fresh(diagnostics: &mut Vec<Diagnostic>, found: Vec<Diagnostic>) {
    let refused: BTreeSet<Span> = diagnostics.iter().map(|it| it.span).collect();
    let unknown = [Rule::UnknownName, Rule::UnknownGraph, Rule::UnknownStep];
    diagnostics.extend(
        found
            .into_iter()
            .filter(|it| !(unknown.contains(&it.rule) && refused.contains(&it.span))),
    );
}

fn has_errors(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|it| it.level() == Level::Error)
}

/// By place; what two instances of one template have in common is said once.
fn sort(diagnostics: &mut Vec<Diagnostic>) {
    diagnostics.sort_by(|a, b| (a.span, a.rule, &a.message).cmp(&(b.span, b.rule, &b.message)));
    diagnostics.dedup_by(|a, b| a.span == b.span && a.rule == b.rule && a.message == b.message);
}

/// `lib/saw.grafcet` is called `saw`.
fn stem(path: &str) -> &str {
    let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
    name.strip_suffix(".grafcet").unwrap_or(name)
}
