//! Plays a stimulus to a simulation, scan by scan.

use std::collections::BTreeMap;

use grafcet_compiler::application::{Place, Unit};

use crate::simulation::Simulation;
use crate::stimulus::{Row, Stimulus};

/// A stimulus and how far it has been played.
pub struct Player<'a> {
    unit: &'a Unit,
    rest: &'a [Row],
    /// What each variable was given last, by its index.
    given: BTreeMap<usize, i32>,
}

impl<'a> Player<'a> {
    /// A stimulus for a controller, from its beginning.
    #[must_use]
    pub fn new(unit: &'a Unit, stimulus: &'a Stimulus) -> Self {
        Player {
            unit,
            rest: stimulus.rows(),
            given: BTreeMap::new(),
        }
    }

    /// Sets what holds from `time_ms` on, before the scan at that time. Rows since the scan before are merged: only
    /// the last value of a column is given, and a value that it has already been given is no new one.
    pub fn give(&mut self, time_ms: u64, simulation: &mut Simulation<'_>) {
        let due = self.rest.iter().take_while(|row| row.time_ms <= time_ms);
        let due = due.count();
        let (rows, rest) = self.rest.split_at(due);
        self.rest = rest;
        let merged: BTreeMap<usize, i32> = rows.iter().flat_map(|row| row.values.clone()).collect();
        for (index, value) in merged {
            if self.given.insert(index, value) != Some(value)
                && let Some(variable) = self.unit.symbols.variables.get(index)
            {
                simulation.set(Place::Controller(variable.slot), value);
            }
        }
    }
}
