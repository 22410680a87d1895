//! Sequences: steps with one way on, which an image follows without a look at anything else.

use grafcet_core::program::Sequel;

use crate::application::Tables;

/// Notes in the arms of all steps how it goes on behind them.
pub(super) fn join(tables: &mut Tables) {
    let program = tables.program();
    let sequels: Vec<(u16, Sequel)> = program
        .graphs
        .iter()
        .flat_map(|graph| {
            let places = graph.steps.of(program.steps).iter().zip(0..);
            places.map(move |(step, place)| (step.first_arm, program.sequel_of(graph, place)))
        })
        .filter(|(_, sequel)| *sequel != Sequel::NONE)
        .collect();
    for (row, sequel) in sequels {
        if let Some(arm) = tables.arms.get_mut(usize::from(row)) {
            arm.sequel = sequel;
        }
    }
}
