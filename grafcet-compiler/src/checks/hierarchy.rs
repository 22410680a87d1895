//! Forcing and enclosing.

use std::collections::{BTreeMap, BTreeSet};

use crate::diagnostic::{Diagnostic, Rule};
use crate::model::{GraphId, Hierarchy, Model};
use crate::source::Span;

/// Refuses rings, and steps that force their own graph.
pub(super) fn check(model: &Model, diagnostics: &mut Vec<Diagnostic>) {
    let graphs: Vec<GraphId> = (0..model.graphs.len()).map(GraphId).collect();
    let hierarchy = Hierarchy::of(model, &graphs);
    report_rings(model, &graphs, &hierarchy, diagnostics);
    for &graph in &graphs {
        let steps = model[graph].step_ids();
        for step in steps {
            let own = model[step]
                .action
                .orders
                .iter()
                .filter(|order| order.graph == graph);
            for order in own {
                let (id, name) = (&model[step].id, model[graph].own_name());
                let message = format!("step {id} forces its own graph `{name}`");
                let diagnostic = Diagnostic::new(Rule::SelfForcing, order.span, message).help(
                    format!("a stand-alone action may: `always {{ F/{name}:{{..}} IF X{id} }}`"),
                );
                diagnostics.push(diagnostic);
            }
        }
    }
}

fn report_rings(
    model: &Model,
    graphs: &[GraphId],
    hierarchy: &Hierarchy,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let ordered: BTreeSet<GraphId> = hierarchy.order.iter().copied().collect();
    let mut seen = BTreeSet::new();
    for &start in graphs.iter().filter(|graph| !ordered.contains(graph)) {
        let mut walk: Vec<(GraphId, Span)> = Vec::new();
        let mut here = start;
        while seen.insert(here) {
            // A graph without a place in the order has a superior without one.
            let superiors = hierarchy.superiors.get(&here).into_iter().flatten();
            let Some((superior, span)) = superiors
                .into_iter()
                .find(|(superior, _)| !ordered.contains(superior))
            else {
                break;
            };
            walk.push((here, *span));
            here = *superior;
        }
        if let Some(first) = walk.iter().position(|(graph, _)| *graph == here) {
            diagnostics.push(ring(model, &walk[first..]));
        }
    }
}

fn ring(model: &Model, ring: &[(GraphId, Span)]) -> Diagnostic {
    // From superior to inferior, as the statements read.
    let graphs = ring.iter().rev();
    let names: Vec<&str> = graphs
        .map(|(graph, _)| model[*graph].name.as_str())
        .collect();
    if let [name] = names[..] {
        let message = format!("the graph `{name}` encloses itself");
        return Diagnostic::new(Rule::ForcingCycle, ring[0].1, message)
            .help("a step encloses other graphs only");
    }
    let message = format!(
        "graphs force or enclose each other in a ring: {}",
        super::round_trip(&names)
    );
    let mut diagnostic = Diagnostic::new(Rule::ForcingCycle, ring[0].1, message);
    for (_, span) in ring.iter().take(super::MOST_SHOWN).skip(1) {
        diagnostic = diagnostic.label(*span, "part of the ring");
    }
    diagnostic.help("a hierarchy has a top: let one of them be ruled only")
}

/// Warns of graphs that are enclosed and forced.
pub(super) fn advise(model: &Model, diagnostics: &mut Vec<Diagnostic>) {
    let mut enclosed: BTreeMap<GraphId, Span> = BTreeMap::new();
    for encloses in model.steps.iter().flat_map(|step| &step.encloses) {
        enclosed.entry(encloses.graph).or_insert(encloses.span);
    }
    let graphs = (0..model.graphs.len()).map(GraphId);
    let mut told = BTreeSet::new();
    for order in graphs
        .flat_map(|graph| super::actions_of(model, graph))
        .flat_map(|action| &action.orders)
    {
        let Some(by) = enclosed.get(&order.graph) else {
            continue;
        };
        if told.insert(order.graph) {
            let name = &model[order.graph].name;
            let message = format!(
                "the graph `{name}` is enclosed and forced: an order on it is valid only while an enclosing step is active"
            );
            let diagnostic = Diagnostic::new(Rule::HierarchyConflict, order.span, message)
                .label(*by, "enclosed here");
            diagnostics.push(diagnostic);
        }
    }
}
