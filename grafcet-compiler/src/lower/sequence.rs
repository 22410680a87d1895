//! Sequences: steps with one way on, which an image follows without a look at anything else.

use grafcet_core::program::Arm;

use crate::application::Tables;

/// Notes in the arms of all steps how it goes on behind them, when all else is known.
pub(super) fn join(tables: &mut Tables) {
    let program = tables.program();
    let arms: Vec<(u16, Arm)> = program
        .graphs
        .iter()
        .flat_map(|graph| {
            let places = graph.steps.of(program.steps).iter().zip(0..);
            places.filter_map(move |(step, place)| {
                Some((step.first_arm, program.arm_of(graph, place)?))
            })
        })
        .collect();
    for (row, arm) in arms {
        if let Some(place) = tables.arms.get_mut(usize::from(row)) {
            *place = arm;
        }
    }
}
