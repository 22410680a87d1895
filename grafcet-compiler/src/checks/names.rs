//! Addresses, and names that are easily mistaken for each other.

use std::collections::BTreeMap;

use crate::compile::Target;
use crate::diagnostic::{Diagnostic, Rule};
use crate::model::{Address, DeclarationKind, GraphId, Model, Variable, VariableId};
use crate::source::Span;

/// Refuses two declarations at one address and, in an image for a board, terminals without one.
pub(super) fn check_addresses(model: &Model, target: Target, diagnostics: &mut Vec<Diagnostic>) {
    let mut taken: BTreeMap<Address, VariableId> = BTreeMap::new();
    for (index, variable) in model.variables.iter().enumerate() {
        match variable.address {
            Some(address) => {
                if let Some(first) = taken.get(&address) {
                    if model[*first].at == variable.at && model[*first].owner == variable.owner {
                        // One declaration with several names, which has been refused.
                        continue;
                    }
                    diagnostics.push(shared(model, address, *first, VariableId(index)));
                } else {
                    taken.insert(address, VariableId(index));
                }
            }
            None if target == Target::Firmware && variable.at.is_none() => {
                diagnostics.extend(without_address(model, variable))
            }
            None => {}
        }
    }
}

fn shared(model: &Model, address: Address, first: VariableId, second: VariableId) -> Diagnostic {
    let place = |id: VariableId| model[id].at.unwrap_or(model[id].span);
    let (mut first_place, mut second_place) = (place(first), place(second));
    if first_place == second_place {
        // Two instances of a template that has the address in its own text.
        let instance =
            |id: VariableId| model[id].owner.map_or(place(id), |owner| model[owner].span);
        (first_place, second_place) = (instance(first), instance(second));
    }
    let message = format!(
        "`{}` and `{}` lie at one address, `{address}`",
        model.qualified(first),
        model.qualified(second)
    );
    Diagnostic::new(Rule::DuplicateAddress, second_place, message)
        .label(first_place, "the first one is here")
}

fn without_address(model: &Model, variable: &Variable) -> Option<Diagnostic> {
    let what = match variable.kind {
        DeclarationKind::Input => "input",
        DeclarationKind::Output => "output",
        _ => return None,
    };
    let in_plant = variable.owner.is_some_and(|owner| model[owner].plant);
    if in_plant || variable.binding.is_alias() {
        return None;
    }
    let message = format!(
        "the {what} `{}` has no address, and no pin can be wired to it",
        variable.name
    );
    let diagnostic = Diagnostic::new(Rule::NoAddress, variable.span, message);
    Some(match variable.example_of_address() {
        Some(example) => diagnostic.help(format!(
            "write an address behind the name, as `at {example}`"
        )),
        None => diagnostic,
    })
}

/// Warns of names that differ only in case: within the application, and inside a graph from what can be named there.
pub(super) fn advise(model: &Model, diagnostics: &mut Vec<Diagnostic>) {
    let mut globals = Similar::new();
    for id in model.declared_by(None) {
        add(&mut [&mut globals], &model[id], diagnostics);
    }
    for graph in (0..model.graphs.len()).map(GraphId) {
        let mut locals = Similar::new();
        for id in model.declared_by(Some(graph)) {
            add(&mut [&mut locals, &mut globals], &model[id], diagnostics);
        }
    }
    let mut graphs: BTreeMap<String, (&str, Span)> = BTreeMap::new();
    for graph in &model.graphs {
        let entry = graphs.entry(graph.name.to_lowercase());
        let (first, place) = *entry.or_insert((&graph.name, graph.span));
        if first != graph.name {
            diagnostics.push(differ(first, place, &graph.name, graph.span));
        }
    }
}

/// Names by their lower case.
type Similar<'m> = BTreeMap<String, Vec<&'m Variable>>;

/// Compares a name with those in all scopes and adds it to the first.
fn add<'m>(
    scopes: &mut [&mut Similar<'m>],
    variable: &'m Variable,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let lower = variable.name.to_lowercase();
    let alike = scopes
        .iter()
        .filter_map(|scope| scope.get(&lower))
        .flatten();
    let mistaken = alike
        .copied()
        .find(|other| other.name != variable.name && !is_convention(other, variable));
    if let Some(other) = mistaken {
        diagnostics.push(differ(
            &other.name,
            other.span,
            &variable.name,
            variable.span,
        ));
    }
    if let Some(scope) = scopes.first_mut() {
        scope.entry(lower).or_default().push(variable);
    }
}

/// A lower-case input beside its upper-case output.
fn is_convention(one: &Variable, other: &Variable) -> bool {
    let (input, output) = match (one.kind, other.kind) {
        (DeclarationKind::Input, DeclarationKind::Output) => (one, other),
        (DeclarationKind::Output, DeclarationKind::Input) => (other, one),
        _ => return false,
    };
    input.name == input.name.to_lowercase() && output.name == output.name.to_uppercase()
}

fn differ(first: &str, first_place: Span, second: &str, place: Span) -> Diagnostic {
    let message = format!("`{second}` and `{first}` differ only in case");
    Diagnostic::new(Rule::CaseOnly, place, message)
        .label(first_place, "the other one is here")
        .help("give one of them another name")
}
