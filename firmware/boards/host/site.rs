//! The site around a controller: plants, and the terminals between them and it (`semantics.md`, "Plants").

use grafcet_core::engine::Engine;
use grafcet_core::images::Images;
use grafcet_core::memory::Memory;
use grafcet_core::program::{Compiled, Program, Slot};
use grafcet_core::vectors::Vectors;

use super::script::Place;
use crate::wiring::{AnalogueWire, InputWire, OutputWire};

/// A plant, as the build lowered it.
#[derive(Debug)]
pub struct PlantTables {
    /// The name.
    pub name: &'static str,
    /// The program.
    pub program: Program<'static>,
    /// From the controller's images to the plant's inputs.
    pub reads: &'static [(Slot, Slot)],
    /// From the plant's outputs to the controller's inputs.
    pub writes: &'static [(Slot, Slot)],
}

/// Plants and terminals.
pub struct Site {
    plants: Vec<Plant>,
    inputs: Vec<Terminal>,
    outputs: &'static [OutputWire],
    /// Scans of the plants since the beginning; they live through power cycles.
    scans: u64,
}

struct Plant {
    index: usize,
    tables: &'static PlantTables,
    engine: HostEngine,
}

/// The terminal of one of the controller's inputs.
struct Terminal {
    slot: Slot,
    /// What stands at it; 0 and 1 for a Boolean.
    value: i32,
    /// What the controller's last scan saw.
    seen: i32,
    /// Set by the script, and not given back.
    overridden: bool,
}

impl Site {
    /// A site of these plants, with their indices, at rest.
    pub fn new(
        plants: impl Iterator<Item = (usize, &'static PlantTables)>,
        inputs: &'static [InputWire],
        analogue: &'static [AnalogueWire],
        outputs: &'static [OutputWire],
    ) -> Self {
        let plants = plants.map(|(index, tables)| Plant {
            index,
            tables,
            engine: new_engine(&tables.program),
        });
        let bits = inputs.iter().map(|wire| Slot::Bit(wire.bit));
        let numbers = analogue.iter().map(|wire| Slot::Number(wire.number));
        let inputs = bits.chain(numbers).map(|slot| Terminal {
            slot,
            value: 0,
            seen: 0,
            overridden: false,
        });
        Site {
            plants: plants.collect(),
            inputs: inputs.collect(),
            outputs,
            scans: 0,
        }
    }

    /// The values at the controller's Boolean inputs, in the order of its wires.
    pub fn inputs(&self) -> impl Iterator<Item = bool> {
        let bits = self.inputs.iter();
        let bits = bits.filter(|terminal| matches!(terminal.slot, Slot::Bit(_)));
        bits.map(|terminal| terminal.value != 0)
    }

    /// The values at the controller's numeric inputs, in the order of its wires.
    pub fn numbers(&self) -> impl Iterator<Item = i32> {
        let numbers = self.inputs.iter();
        let numbers = numbers.filter(|terminal| matches!(terminal.slot, Slot::Number(_)));
        numbers.map(|terminal| terminal.value)
    }

    /// A value of a plant; 0 for one that does not run.
    #[must_use]
    pub fn plant_value(&self, index: usize, slot: Slot) -> i32 {
        let plant = self.plants.iter().find(|plant| plant.index == index);
        plant.map_or(0, |plant| plant.engine.value(slot))
    }

    /// Sets an input, which then overrides the plants, or a variable of a plant. False when it is neither: nothing
    /// else of a controller can be reached from outside.
    pub fn set(&mut self, place: Place, value: i32) -> bool {
        match place {
            Place::Controller(slot) => {
                let terminal = self.inputs.iter_mut().find(|it| it.slot == slot);
                terminal.is_some_and(|terminal| {
                    terminal.put(value);
                    terminal.overridden = true;
                    true
                })
            }
            Place::Plant(index, slot) => {
                let plant = self.plants.iter_mut().find(|plant| plant.index == index);
                plant.is_some_and(|plant| {
                    plant.engine.set_parameter(slot, value);
                    true
                })
            }
        }
    }

    /// Gives an input back to the plant that writes it.
    pub fn release(&mut self, place: Place) {
        for terminal in &mut self.inputs {
            terminal.overridden &= place != Place::Controller(terminal.slot);
        }
    }

    /// One scan of every plant. All of them read before any of them writes. `outputs` is what stands at the
    /// controller's outputs; `view` is none before its scan 0.
    pub fn scan(&mut self, period_ms: u32, outputs: &[bool], view: Option<&Images<'_>>) {
        if let Some(view) = view {
            for terminal in &mut self.inputs {
                terminal.seen = view.value(terminal.slot);
            }
        }
        let time_ms = self.scans.saturating_mul(u64::from(period_ms));
        for plant in &mut self.plants {
            for (from, to) in plant.tables.reads {
                let input = self.inputs.iter().find(|terminal| terminal.slot == *from);
                let output = self
                    .outputs
                    .iter()
                    .position(|wire| Slot::Bit(wire.bit) == *from);
                let value = match (input, output) {
                    (Some(terminal), _) => terminal.seen,
                    (None, Some(place)) => outputs.get(place).copied().map_or(0, i32::from),
                    (None, None) => view.map_or(0, |view| view.value(*from)),
                };
                plant.engine.sample(*to, value);
            }
            run(&mut plant.engine, time_ms);
        }
        for plant in &self.plants {
            for (from, to) in plant.tables.writes {
                let terminals = self.inputs.iter_mut();
                for terminal in terminals.filter(|it| it.slot == *to && !it.overridden) {
                    terminal.put(plant.engine.value(*from));
                }
            }
        }
        self.scans += 1;
    }
}

impl Terminal {
    fn put(&mut self, value: i32) {
        self.value = match self.slot {
            Slot::Bit(_) => i32::from(value != 0),
            Slot::Number(_) => value,
        };
    }
}

/// An engine for a program of the host.
pub(super) type HostEngine = Engine<&'static Program<'static>, Vectors>;

pub(super) fn new_engine(program: &'static Program<'static>) -> HostEngine {
    Engine::new(program, Vectors::new(program))
}

/// Runs scan 0 at time 0, or a later scan.
pub(super) fn run(engine: &mut Engine<impl Compiled, impl Memory>, time_ms: u64) {
    match time_ms {
        0 => engine.start(),
        _ => {
            engine.scan(time_ms);
        }
    }
}
