//! Plants: programs of their own, with wires to the controller.

use std::collections::BTreeSet;

use super::atoms::{Atom, collect};
use super::places::{Contents, Places};
use super::symbols;
use super::unit::{Kind, Lowering};
use crate::application::{Plant, Unit, Wire};
use crate::diagnostic::Diagnostic;
use crate::model::{Action, Causality, DeclarationKind, GraphId, Model, Trigger, VariableId};

/// A plant with the places of its things.
pub(super) struct Lowered {
    pub plant: Plant,
    pub graph: GraphId,
    pub places: Places,
}

/// Lowers a plant.
pub(super) fn lower(
    model: &Model,
    plant: GraphId,
    controller: &Places,
) -> Result<Lowered, Vec<Diagnostic>> {
    let own: Vec<VariableId> = model
        .declared_by(Some(plant))
        .filter(|id| model[*id].kind != DeclarationKind::Constant)
        .collect();
    let written = written_inputs(model, plant);
    let reads: Vec<Atom> = read(model, plant)
        .into_iter()
        .filter(|atom| is_foreign(model, plant, *atom))
        .filter(|atom| !matches!(atom, Atom::Variable(id) if written.contains(id)))
        .collect();
    let contents = Contents {
        inputs: reads.clone(),
        graphs: vec![plant],
        variables: own.iter().chain(&written).copied().collect(),
        momentary: Causality::of(model, &[plant]).momentary(),
    };
    let mut lowering = Lowering::new(model, Kind::Graphs, contents);
    lowering.lower_graphs();
    let (tables, places) = lowering.finish()?;
    let wire = |from: &Places, to: &Places, atom: Atom| {
        Some(Wire {
            from: from.slot(atom)?,
            to: to.slot(atom)?,
        })
    };
    let writes = written.iter().map(|id| Atom::Variable(*id));
    let plant_row = Plant {
        name: model[plant].name.clone(),
        reads: reads
            .iter()
            .filter_map(|atom| wire(controller, &places, *atom))
            .collect(),
        writes: writes
            .filter_map(|atom| wire(&places, controller, atom))
            .collect(),
        unit: Unit {
            tables,
            symbols: symbols::of(model, &[plant], &own, &places),
        },
    };
    Ok(Lowered {
        plant: plant_row,
        graph: plant,
        places,
    })
}

/// All actions of a graph.
fn actions(model: &Model, graph: GraphId) -> impl Iterator<Item = &Action> {
    let graph = &model[graph];
    let steps = graph.step_ids().map(|step| &model[step].action);
    let transitions = graph
        .transition_ids()
        .map(|transition| &model[transition].action);
    graph.always.iter().chain(steps).chain(transitions)
}

/// The inputs of the application that a plant writes.
fn written_inputs(model: &Model, plant: GraphId) -> BTreeSet<VariableId> {
    let mut written = BTreeSet::new();
    for action in actions(model, plant) {
        let momentary = action.momentary.iter().flat_map(|it| &it.targets);
        let stored = action.all_stored().map(|it| &it.target);
        written.extend(momentary.chain(stored).map(|target| target.variable));
    }
    written.retain(|id| model[*id].owner != Some(plant));
    written
}

fn read(model: &Model, plant: GraphId) -> BTreeSet<Atom> {
    let mut found = BTreeSet::new();
    for expression in actions(model, plant).flat_map(Action::expressions) {
        collect(model, expression, &mut found);
    }
    for transition in model[plant].transition_ids() {
        if let Trigger::Expression(expression) = &model[transition].trigger {
            collect(model, expression, &mut found);
        }
    }
    found
}

/// Whether something belongs to the controller.
fn is_foreign(model: &Model, plant: GraphId, atom: Atom) -> bool {
    match atom {
        Atom::System(_) => false,
        Atom::Variable(id) => model[id].owner != Some(plant),
        Atom::Step(id) => model[id].graph != plant,
        Atom::Macro(id) => model[id].graph != plant,
    }
}
