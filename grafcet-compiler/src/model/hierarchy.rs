//! Who forces or encloses whom, and the order of phase 4 that follows (`semantics.md`).

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use super::{GraphId, Model};
use crate::source::Span;

/// The order in which graphs are settled.
pub(crate) struct Hierarchy {
    /// Superiors first; among those that may come next the first in the source. Graphs in or below a ring are missing.
    pub order: Vec<GraphId>,
    /// For each graph its superiors, with the place of the first statement that makes them so.
    pub superiors: BTreeMap<GraphId, BTreeMap<GraphId, Span>>,
}

impl Hierarchy {
    /// The hierarchy of some graphs. Forcing oneself makes no superior, enclosing oneself does.
    pub fn of(model: &Model, graphs: &[GraphId]) -> Hierarchy {
        let mut superiors: BTreeMap<GraphId, BTreeMap<GraphId, Span>> = BTreeMap::new();
        for &graph in graphs {
            let mut note = |inferior: GraphId, span: Span| {
                superiors
                    .entry(inferior)
                    .or_default()
                    .entry(graph)
                    .or_insert(span);
            };
            let steps = || model[graph].step_ids().map(|step| &model[step]);
            for step in steps() {
                for enclosed in &step.encloses {
                    note(enclosed.graph, enclosed.span);
                }
            }
            let actions = model[graph]
                .always
                .iter()
                .chain(steps().map(|step| &step.action));
            for order in actions.flat_map(|action| &action.orders) {
                if order.graph != graph {
                    note(order.graph, order.span);
                }
            }
        }
        let order = sorted(graphs, &superiors);
        Hierarchy { order, superiors }
    }
}

fn sorted(
    graphs: &[GraphId],
    superiors: &BTreeMap<GraphId, BTreeMap<GraphId, Span>>,
) -> Vec<GraphId> {
    let mut inferiors: BTreeMap<GraphId, Vec<GraphId>> = BTreeMap::new();
    let mut waiting_for: BTreeMap<GraphId, usize> = BTreeMap::new();
    for (inferior, by) in superiors {
        waiting_for.insert(*inferior, by.len());
        for superior in by.keys() {
            inferiors.entry(*superior).or_default().push(*inferior);
        }
    }
    let free = |graph: &&GraphId| !waiting_for.contains_key(*graph);
    let mut next: BinaryHeap<Reverse<GraphId>> =
        graphs.iter().filter(free).copied().map(Reverse).collect();
    let mut order = Vec::with_capacity(graphs.len());
    while let Some(Reverse(graph)) = next.pop() {
        order.push(graph);
        for inferior in inferiors.get(&graph).into_iter().flatten() {
            if let Some(waiting) = waiting_for.get_mut(inferior) {
                *waiting -= 1;
                if *waiting == 0 {
                    next.push(Reverse(*inferior));
                }
            }
        }
    }
    order
}
