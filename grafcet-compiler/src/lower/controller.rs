//! The controller: the graphs of the application.

use std::collections::BTreeSet;

use grafcet_core::program::Retained;

use super::atoms::Atom;
use super::fingerprint;
use super::places::{Contents, Places};
use super::symbols;
use super::unit::{Kind, Lowering};
use crate::application::{Tables, Unit};
use crate::diagnostic::Diagnostic;
use crate::model::{Causality, DeclarationKind, GraphId, Model, VariableId};

/// The controller with the places of its things.
pub(super) struct Lowered {
    pub unit: Unit,
    pub places: Places,
}

/// Lowers the controller.
pub(super) fn lower(model: &Model) -> Result<Lowered, Vec<Diagnostic>> {
    let graphs: Vec<GraphId> = model.controller().collect();
    let variables = placed(model, &graphs);
    let is_input = |id: &VariableId| model[*id].kind == DeclarationKind::Input;
    let (inputs, others): (Vec<VariableId>, Vec<VariableId>) =
        variables.iter().partition(|id| is_input(id));
    let contents = Contents {
        inputs: inputs.into_iter().map(Atom::Variable).collect(),
        momentary: Causality::of(model, &graphs).momentary(),
        graphs: graphs.clone(),
        variables: others,
    };
    let mut lowering = Lowering::new(model, Kind::Graphs, contents);
    lowering.lower_graphs();
    let (mut tables, places) = lowering.finish()?;
    retain(model, &variables, &places, &mut tables);
    let symbols = symbols::of(model, &graphs, &variables, &places);
    Ok(Lowered {
        unit: Unit { tables, symbols },
        places,
    })
}

/// What the application and its graphs declare, constants and names that stand for others left out.
fn placed(model: &Model, graphs: &[GraphId]) -> Vec<VariableId> {
    let owners = std::iter::once(None).chain(graphs.iter().copied().map(Some));
    owners
        .flat_map(|owner| model.declared_by(owner))
        .filter(|id| model[*id].kind != DeclarationKind::Constant && !model[*id].binding.is_alias())
        .collect()
}

/// Notes what survives power, and makes it part of the fingerprint.
fn retain(model: &Model, variables: &[VariableId], places: &Places, tables: &mut Tables) {
    let mut keys = BTreeSet::new();
    for id in variables {
        let variable = &model[*id];
        let retained = matches!(
            variable.kind,
            DeclarationKind::Variable { retain: true } | DeclarationKind::Parameter
        );
        let Some(slot) = places.slot(Atom::Variable(*id)).filter(|_| retained) else {
            continue;
        };
        let (low, high) = variable.limits();
        let mut name = format!("{} {:?} {low}..{high}", model.qualified(*id), variable.ty);
        let mut key = fingerprint::of_text(&name);
        while !keys.insert(key) {
            name.push('+');
            key = fingerprint::of_text(&name);
        }
        tables.retained.push(Retained { slot, key });
    }
    tables.fingerprint = fingerprint::of(tables);
}
