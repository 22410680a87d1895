//! The front panel of the soft PLC: what stands at its pins, and a line for each change of them.

use std::cell::Cell;

use super::lines;
use super::machine::Machine;
use crate::application::{ANALOGUE_INPUTS, INPUT_LABELS, INPUTS, OUTPUT_LABELS, OUTPUTS};
use crate::wiring::Label;

/// How many Boolean inputs there are.
pub const INPUT_COUNT: usize = INPUTS.len();

/// How many outputs there are.
pub const OUTPUT_COUNT: usize = OUTPUTS.len();

/// How many numeric inputs there are.
pub const ANALOGUE_COUNT: usize = ANALOGUE_INPUTS.len();

/// What stands at the pins, and the values that were shown last.
pub struct Panel {
    /// The input pins, in the order of their wires.
    pub inputs: [Cell<bool>; INPUT_COUNT],
    /// What the converter reads at the analogue inputs, in the order of their wires.
    pub readings: [Cell<u16>; ANALOGUE_COUNT],
    /// The output pins, in the order of their wires.
    pub outputs: [Cell<bool>; OUTPUT_COUNT],
    shown_inputs: Cell<[bool; INPUT_COUNT]>,
    shown_outputs: Cell<[bool; OUTPUT_COUNT]>,
}

impl Default for Panel {
    fn default() -> Self {
        Panel {
            inputs: core::array::from_fn(|_| Cell::default()),
            readings: core::array::from_fn(|_| Cell::default()),
            outputs: core::array::from_fn(|_| Cell::default()),
            shown_inputs: Cell::new([false; INPUT_COUNT]),
            shown_outputs: Cell::new([false; OUTPUT_COUNT]),
        }
    }
}

impl Panel {
    /// What nobody drives is at its safe level.
    pub fn make_safe(&self) {
        for (pin, wire) in self.outputs.iter().zip(&OUTPUTS) {
            pin.set(wire.safe != wire.active_low);
        }
        self.show_outputs();
    }

    /// The values at the outputs.
    #[must_use]
    pub fn outputs(&self) -> [bool; OUTPUT_COUNT] {
        let mut rows = self.outputs.iter().zip(&OUTPUTS);
        core::array::from_fn(|_| {
            rows.next()
                .is_some_and(|(pin, wire)| pin.get() != wire.active_low)
        })
    }

    /// Shows the outputs that have changed.
    pub fn show_outputs(&self) {
        let values = self.outputs();
        show(
            "outputs",
            &OUTPUT_LABELS,
            &self.shown_outputs.replace(values),
            &values,
        );
    }

    /// Connects the inputs to the machine as it stands, and shows those that have changed.
    pub fn connect(&self, machine: &mut Machine) {
        if let Some(moved) = machine.take_moved() {
            lines::print(format_args!("  inputs   {moved}"));
        }
        for (pin, reading) in self.readings.iter().zip(machine.readings()) {
            pin.set(reading);
        }
        let mut inputs = machine.inputs();
        let values: [bool; INPUT_COUNT] = core::array::from_fn(|_| inputs.next().unwrap_or(false));
        for ((pin, wire), value) in self.inputs.iter().zip(&INPUTS).zip(values) {
            pin.set(value != wire.active_low);
        }
        show(
            "inputs ",
            &INPUT_LABELS,
            &self.shown_inputs.replace(values),
            &values,
        );
    }
}

fn show(kind: &str, labels: &[Label], before: &[bool], now: &[bool]) {
    let changed: Vec<String> = labels
        .iter()
        .zip(before.iter().zip(now))
        .filter(|(_, (before, now))| before != now)
        .map(|(label, (_, now))| format!("{} = {}", label.name, u8::from(*now)))
        .collect();
    if !changed.is_empty() {
        lines::print(format_args!("  {kind}  {}", changed.join(", ")));
    }
}
