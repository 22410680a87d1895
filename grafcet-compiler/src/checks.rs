//! Rules over the model (`language.md`, "Static rules") that need more than one place of the text.
//!
//! One module for each kind of evidence: what actions write, constants, the hierarchy, names, structure, use. The rules
//! of [`Rule::DECIDED`](crate::diagnostic::Rule::DECIDED), and what `reach` and `constants` leave open of
//! `unreachable-step`, `never-fires` and `always-fires`, need a search through all runs instead. Such a module stands
//! beside these and speaks from [`warnings`], of a settled model only; [`hierarchy`] and [`reach`] already know who
//! rules whom and which transitions enter what.

mod actions;
mod constants;
mod hierarchy;
mod names;
mod reach;
mod usage;

use crate::compile::Target;
use crate::diagnostic::Diagnostic;
use crate::model::{Action, Expression, GraphId, Model, Trigger};
use crate::source::Sources;

/// What refuses a program.
pub(crate) fn errors(model: &Model, sources: &Sources, target: Target) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    actions::check(model, sources, &mut diagnostics);
    hierarchy::check(model, &mut diagnostics);
    names::check_addresses(model, target, &mut diagnostics);
    diagnostics
}

/// What is worth a look. `settled` says that the model is whole: without that, what seems unused or unreachable may
/// only have been lost with an error.
pub(crate) fn warnings(model: &Model, settled: bool) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    hierarchy::advise(model, &mut diagnostics);
    names::advise(model, &mut diagnostics);
    if settled {
        constants::advise(model, &mut diagnostics);
        usage::advise(model, &mut diagnostics);
        reach::advise(model, &mut diagnostics);
    }
    diagnostics
}

/// The actions of a graph: stand-alone ones, those of steps and those of transitions.
fn actions_of(model: &Model, graph: GraphId) -> impl Iterator<Item = &Action> {
    let graph = &model[graph];
    let steps = graph.step_ids().map(|step| &model[step].action);
    let transitions = graph
        .transition_ids()
        .map(|transition| &model[transition].action);
    graph.always.iter().chain(steps).chain(transitions)
}

/// The expressions of a graph: in triggers and in actions.
fn expressions_of(model: &Model, graph: GraphId) -> impl Iterator<Item = &Expression> {
    let triggers =
        model[graph]
            .transition_ids()
            .filter_map(|transition| match &model[transition].trigger {
                Trigger::Expression(trigger) => Some(trigger),
                Trigger::Always | Trigger::Unknown => None,
            });
    triggers.chain(actions_of(model, graph).flat_map(Action::expressions))
}

/// The expressions of all graphs and plants.
fn expressions(model: &Model) -> impl Iterator<Item = &Expression> {
    (0..model.graphs.len()).flat_map(|graph| expressions_of(model, GraphId(graph)))
}

/// So many parts of a ring are shown.
const MOST_SHOWN: usize = 8;

/// The names of a ring, back to the first.
fn round_trip(names: &[&str]) -> String {
    let first = names.first().copied().unwrap_or_default();
    let mut shown = names[..names.len().min(MOST_SHOWN)].join("` -> `");
    if names.len() > MOST_SHOWN {
        shown += "` -> .. -> `";
    } else {
        shown += "` -> `";
    }
    format!("`{shown}{first}`")
}
