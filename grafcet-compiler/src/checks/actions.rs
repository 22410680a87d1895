//! Momentary actions: not on stored variables, without initial values, not in a ring.

use std::collections::{BTreeMap, BTreeSet};

use crate::diagnostic::{Diagnostic, Rule};
use crate::model::{Action, Causality, GraphId, Model, Momentary, VariableId};
use crate::source::{Sources, Span};

/// Checks the actions of the controller and of each plant.
pub(super) fn check(model: &Model, sources: &Sources, diagnostics: &mut Vec<Diagnostic>) {
    let controller: Vec<GraphId> = model.controller().collect();
    check_side(model, sources, &controller, diagnostics);
    for plant in model.plants() {
        check_side(model, sources, &[plant], diagnostics);
    }
}

fn check_side(
    model: &Model,
    sources: &Sources,
    graphs: &[GraphId],
    diagnostics: &mut Vec<Diagnostic>,
) {
    let (mut momentary, mut stored) = (BTreeMap::new(), BTreeMap::new());
    for action in graphs
        .iter()
        .flat_map(|graph| super::actions_of(model, *graph))
    {
        note(action, &mut momentary, &mut stored);
    }
    for (variable, place) in &momentary {
        if let Some(other) = stored.get(variable) {
            diagnostics.push(both(model, *variable, *place, *other));
        }
        let declared = &model[*variable];
        if let (Some(initial), true) = (declared.initial_span, declared.initial.is_some()) {
            let message = format!(
                "`{}` is the object of a momentary action: no initial value outlives scan 0",
                declared.name
            );
            let diagnostic = Diagnostic::new(Rule::MomentaryInitial, initial, message)
                .label(*place, "the momentary action")
                .help("leave the initial value out");
            diagnostics.push(diagnostic);
        }
    }
    report_rings(model, sources, &Causality::of(model, graphs), diagnostics);
}

/// Notes the first place where each variable is written, momentary and stored.
fn note(
    action: &Action,
    momentary: &mut BTreeMap<VariableId, Span>,
    stored: &mut BTreeMap<VariableId, Span>,
) {
    for target in action
        .momentary
        .iter()
        .flat_map(|statement| &statement.targets)
    {
        momentary.entry(target.variable).or_insert(target.span);
    }
    for statement in action.all_stored() {
        stored
            .entry(statement.target.variable)
            .or_insert(statement.target.span);
    }
}

fn both(model: &Model, variable: VariableId, momentary: Span, stored: Span) -> Diagnostic {
    let name = &model[variable].name;
    let message = format!("`{name}` is the object of a momentary and of a stored action");
    let (place, label, other) = if momentary < stored {
        (stored, "the momentary action", momentary)
    } else {
        (momentary, "the stored action", stored)
    };
    Diagnostic::new(Rule::MomentaryAndStored, place, message)
        .label(other, label)
        .help(format!(
            "choose one kind: `{name} IF ..` everywhere, or `{name} = ..` everywhere"
        ))
}

/// Reports momentary statements that depend on each other in a ring.
fn report_rings(
    model: &Model,
    sources: &Sources,
    causality: &Causality,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let sorted: BTreeSet<usize> = causality.dependent.iter().copied().collect();
    let caught: Vec<usize> = (0..causality.statements.len())
        .filter(|index| !causality.statements[*index].reads.is_empty() && !sorted.contains(index))
        .collect();
    let mut writers: BTreeMap<VariableId, usize> = BTreeMap::new();
    for index in caught.iter().rev() {
        for target in &causality.statements[*index].statement.targets {
            writers.insert(target.variable, *index);
        }
    }
    let mut seen = BTreeSet::new();
    for start in caught {
        let mut walk: Vec<(usize, VariableId)> = Vec::new();
        let mut here = start;
        while seen.insert(here) {
            // Of what this statement waits for, something is in or behind the ring.
            let reads = causality.statements[here].reads.iter();
            let Some((read, writer)) = reads
                .filter_map(|read| Some((*read, *writers.get(read)?)))
                .next()
            else {
                break;
            };
            walk.push((here, read));
            here = writer;
        }
        if let Some(first) = walk.iter().position(|(index, _)| *index == here) {
            diagnostics.push(ring(model, sources, causality, &walk[first..]));
        }
    }
}

fn ring(
    model: &Model,
    sources: &Sources,
    causality: &Causality,
    ring: &[(usize, VariableId)],
) -> Diagnostic {
    let statement = |index: usize| causality.statements[index].statement;
    let first = statement(ring[0].0);
    if let [(_, read)] = ring {
        let name = &model[*read].name;
        let message =
            format!("the momentary action on `{name}` depends on `{name}` within one scan");
        let writes = |statement: &&Momentary| {
            let mut targets = statement.targets.iter();
            targets.any(|target| target.variable == *read)
        };
        let all = causality.statements.iter().map(|it| it.statement);
        let help = if all.filter(writes).count() > 1 {
            format!("store it, and gather what sets it in one statement: `{name} = .. OR ..`")
        } else {
            let condition = first.condition.as_ref();
            let condition = condition.map_or("..", |condition| sources.text(condition.span));
            format!("store it: `{name} = {condition}`")
        };
        return Diagnostic::new(Rule::CausalityLoop, first.span, message).help(help);
    }
    let names: Vec<&str> = ring
        .iter()
        .map(|(_, read)| model[*read].name.as_str())
        .collect();
    let message = format!(
        "momentary actions depend on each other in a ring within one scan: {}",
        super::round_trip(&names)
    );
    let mut diagnostic = Diagnostic::new(Rule::CausalityLoop, first.span, message);
    for (index, _) in ring.iter().take(super::MOST_SHOWN).skip(1) {
        let place = statement(*index).span;
        if place != first.span {
            diagnostic = diagnostic.label(place, "part of the ring");
        }
    }
    diagnostic.help(format!(
        "store one of them, as in `{} = ..`: what is stored may depend on itself",
        model[ring[0].1].name
    ))
}
