//! What people call the things in a program.

use super::atoms::Atom;
use super::places::Places;
use crate::application::{GraphSymbol, StepSymbol, Symbols, TransitionSymbol, VariableSymbol};
use crate::model::{Binding, GraphId, Model, VariableId};

/// The names of some graphs and variables.
pub(super) fn of(
    model: &Model,
    graphs: &[GraphId],
    variables: &[VariableId],
    places: &Places,
) -> Symbols {
    Symbols {
        graphs: graphs
            .iter()
            .map(|graph| graph_symbol(model, *graph, places))
            .collect(),
        variables: variables
            .iter()
            .filter_map(|id| variable_symbol(model, graphs, *id, places))
            .collect(),
    }
}

fn graph_symbol(model: &Model, id: GraphId, places: &Places) -> GraphSymbol {
    let graph = &model[id];
    let steps = graph.step_ids().map(|step| StepSymbol {
        id: model[step].id.clone(),
        bit: places.bit(Atom::Step(step)),
        text: model[step].text.clone(),
        span: model[step].span,
    });
    let transitions = graph.transition_ids().map(|transition| TransitionSymbol {
        number: model[transition].number,
        span: model[transition].span,
    });
    GraphSymbol {
        name: graph.name.clone(),
        text: graph.text.clone(),
        steps: steps.collect(),
        transitions: transitions.collect(),
        span: graph.span,
    }
}

fn variable_symbol(
    model: &Model,
    graphs: &[GraphId],
    id: VariableId,
    places: &Places,
) -> Option<VariableSymbol> {
    let variable = &model[id];
    Some(VariableSymbol {
        name: model.qualified(id),
        graph: variable
            .owner
            .and_then(|owner| graphs.binary_search(&owner).ok()),
        kind: variable.kind,
        ty: variable.ty,
        slot: places.slot(Atom::Variable(id))?,
        address: variable.address.map(|address| address.to_string()),
        range: variable.range,
        initial: variable.first_value(),
        text: variable.text.clone(),
        bound: !matches!(variable.binding, Binding::None),
        span: variable.span,
    })
}
