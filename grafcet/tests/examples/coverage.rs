//! Every transition of every example fires in one of its tests.

use std::collections::BTreeSet;

use grafcet::testing;
use grafcet_compiler::application::Application;

use crate::directory::{application, names};

/// Transitions that no test can let fire: example, graph, number, and why.
const NEVER_FIRES: [(&str, &str, u32, &str); 0] = [];

#[test]
fn every_transition_of_every_example_fires_in_one_of_its_tests() {
    let mut idle = Vec::new();
    for example in names() {
        let application = application(&example);
        let fired = fired(&application);
        let graphs = application.controller.symbols.graphs.iter();
        for (graph, row) in graphs.zip(&application.controller.tables.graphs) {
            for (transition, index) in graph.transitions.iter().zip(row.transitions.indices()) {
                if !fired.contains(&index) {
                    idle.push((example.clone(), graph.name.clone(), transition.number));
                }
            }
        }
    }
    let by_design =
        NEVER_FIRES.map(|(example, graph, number, _)| (example.into(), graph.into(), number));
    assert_eq!(idle, Vec::from(by_design));
}

/// The transitions that fire in some test, as indices in the tables.
fn fired(application: &Application) -> BTreeSet<usize> {
    let mut fired = BTreeSet::new();
    for test in &application.tests {
        let verdict = testing::run(application, test, |simulation| {
            fired.extend(simulation.controller().engine().fired());
        });
        assert!(verdict.is_ok(), "{}: {}", application.name, test.name);
    }
    fired
}
