//! A controller and plants in lock step (`semantics.md`, "Plants" and "Tests").

use std::collections::BTreeMap;

use grafcet_compiler::application::{Application, Place, Plant, VariableSymbol};
use grafcet_compiler::ast::DeclarationKind;
use grafcet_core::program::Slot;

use crate::machine::{Bench, Machine};
use grafcet_core::images::Images;

/// The controller of an application, with some of its plants.
///
/// In each scan the plants run first: they read the outputs that the controller wrote in the previous scan, and the
/// inputs as that scan left them. Then the controller reads what the plants wrote, except where an input is
/// overridden.
pub struct Simulation<'b> {
    controller: Machine<'b>,
    plants: Vec<Running<'b>>,
    terminals: Vec<Terminal>,
    terminal_of: BTreeMap<Slot, usize>,
    period_ms: u64,
    /// Scans since the controller's latest start.
    scans: u64,
    /// Scans since the beginning, which the plants live through.
    plant_scans: u64,
}

/// A plant at work.
struct Running<'b> {
    /// Its index in [`Application::plants`].
    index: usize,
    machine: Machine<'b>,
    reads: Vec<(Source, Slot)>,
    /// From its image to the index of a terminal.
    writes: Vec<(Slot, usize)>,
}

/// Where a plant reads a value of the controller's.
#[derive(Clone, Copy)]
enum Source {
    /// The terminal of an input, by index: as the last scan saw it, also across a power cycle.
    Input(usize),
    /// An output: off while the controller has not completed scan 0 (`semantics.md`, "Outside the scans").
    Output(Slot),
    /// Anything else.
    Inner(Slot),
}

/// The terminal of one of the controller's inputs.
struct Terminal {
    slot: Slot,
    /// What stands at it.
    value: i32,
    /// What the last scan saw.
    sampled: i32,
    /// Set by a test or a stimulus, and not given back.
    overridden: bool,
}

impl<'b> Simulation<'b> {
    /// Sets up the controller of an application with the plants that have these indices. Nothing has run yet.
    pub fn new<'t>(bench: &'b Bench<'t>, application: &'t Application, plants: &[usize]) -> Self {
        let controller = bench.machine(&application.controller.tables);
        let kinds: BTreeMap<Slot, DeclarationKind> = application
            .controller
            .symbols
            .variables
            .iter()
            .filter(|variable| has_place_of_its_own(variable))
            .map(|variable| (variable.slot, variable.kind))
            .collect();
        let inputs = kinds
            .iter()
            .filter(|(_, kind)| **kind == DeclarationKind::Input);
        let terminals: Vec<Terminal> = inputs.map(|(slot, _)| Terminal::new(*slot)).collect();
        let terminal_of: BTreeMap<Slot, usize> = terminals
            .iter()
            .enumerate()
            .map(|(index, terminal)| (terminal.slot, index))
            .collect();
        let source = |slot: Slot| match (terminal_of.get(&slot), kinds.get(&slot)) {
            (Some(index), _) => Source::Input(*index),
            (None, Some(DeclarationKind::Output)) => Source::Output(slot),
            (None, _) => Source::Inner(slot),
        };
        let running = |(index, plant): (usize, &'t Plant)| Running {
            index,
            machine: bench.machine(&plant.unit.tables),
            reads: plant
                .reads
                .iter()
                .map(|wire| (source(wire.from), wire.to))
                .collect(),
            writes: plant
                .writes
                .iter()
                .filter_map(|wire| Some((wire.from, *terminal_of.get(&wire.to)?)))
                .collect(),
        };
        let chosen = application.plants.iter().enumerate();
        Simulation {
            controller,
            plants: chosen
                .filter(|(index, _)| plants.contains(index))
                .map(running)
                .collect(),
            terminals,
            terminal_of,
            period_ms: u64::from(application.controller.tables.period_ms),
            scans: 0,
            plant_scans: 0,
        }
    }

    /// Whether scan 0 has run since power came.
    #[must_use]
    pub fn started(&self) -> bool {
        self.controller.started()
    }

    /// The time stamp of the latest scan in ms since scan 0; 0 before it.
    #[must_use]
    pub fn time_ms(&self) -> u64 {
        self.scans.saturating_sub(1).saturating_mul(self.period_ms)
    }

    /// The time of the latest scan in ms since the beginning, power cycles included.
    #[must_use]
    pub fn elapsed_ms(&self) -> u64 {
        let scans = self.plant_scans.saturating_sub(1);
        scans.saturating_mul(self.period_ms)
    }

    /// The scan period in ms.
    #[must_use]
    pub fn period_ms(&self) -> u64 {
        self.period_ms
    }

    /// The controller.
    #[must_use]
    pub fn controller(&self) -> &Machine<'b> {
        &self.controller
    }

    /// The images of the controller as the latest scan left them.
    #[must_use]
    pub fn images(&self) -> Images<'_> {
        self.controller.images()
    }

    /// The value at a place as the latest scan left it; 0 for a plant that does not run.
    #[must_use]
    pub fn value(&self, place: Place) -> i32 {
        match place {
            Place::Controller(slot) => self.images().value(slot),
            Place::Plant(index, slot) => self
                .plants
                .iter()
                .find(|plant| plant.index == index)
                .map_or(0, |plant| plant.machine.images().value(slot)),
        }
    }

    /// Sets an input, which then overrides the plants; a parameter; or a variable of a plant.
    pub fn set(&mut self, place: Place, value: i32) {
        match place {
            Place::Controller(slot) => match self.terminal(slot) {
                Some(terminal) => {
                    terminal.value = value;
                    terminal.overridden = true;
                }
                None => self.controller.set(slot, value),
            },
            Place::Plant(index, slot) => {
                let mut plants = self.plants.iter_mut();
                if let Some(plant) = plants.find(|plant| plant.index == index) {
                    plant.machine.set(slot, value);
                }
            }
        }
    }

    /// Gives an input back to the plant that writes it; without one it keeps its value.
    pub fn release(&mut self, place: Place) {
        if let Place::Controller(slot) = place
            && let Some(terminal) = self.terminal(slot)
        {
            terminal.overridden = false;
        }
    }

    /// Runs one scan: scan 0, or the one that is due a period after the latest. False when it was an idle one of the
    /// controller.
    pub fn scan(&mut self) -> bool {
        self.scan_plants();
        for terminal in &self.terminals {
            self.controller.sample(terminal.slot, terminal.value);
        }
        let time_ms = self.scans.saturating_mul(self.period_ms);
        let full = self.controller.scan(time_ms);
        self.scans += 1;
        let images = self.controller.images();
        for terminal in &mut self.terminals {
            terminal.sampled = images.value(terminal.slot);
        }
        full
    }

    /// Lets so many scans pass without running them, neither the controller nor the plants.
    pub fn leap(&mut self, scans: u64) {
        self.scans += scans;
        self.plant_scans += scans;
    }

    /// The controller loses power and gets it back: what is retained is kept, the plants live on, and what is set
    /// stays set. Its next scan is scan 0.
    pub fn power_cycle(&mut self) {
        self.controller.power_cycle();
        self.scans = 0;
    }

    /// One scan of every plant. All of them read before any of them writes.
    fn scan_plants(&mut self) {
        let time_ms = self.plant_scans.saturating_mul(self.period_ms);
        let started = self.controller.started();
        let images = self.controller.images();
        for plant in &mut self.plants {
            for (source, to) in &plant.reads {
                let value = match *source {
                    Source::Input(index) => self.terminals.get(index).map_or(0, |t| t.sampled),
                    Source::Output(_) if !started => 0,
                    Source::Output(slot) | Source::Inner(slot) => images.value(slot),
                };
                plant.machine.sample(*to, value);
            }
            plant.machine.scan(time_ms);
        }
        for plant in &self.plants {
            let written = plant.machine.images();
            for (from, to) in &plant.writes {
                if let Some(terminal) = self.terminals.get_mut(*to)
                    && !terminal.overridden
                {
                    terminal.value = written.value(*from);
                }
            }
        }
        self.plant_scans += 1;
    }

    fn terminal(&mut self, slot: Slot) -> Option<&mut Terminal> {
        self.terminals.get_mut(*self.terminal_of.get(&slot)?)
    }
}

/// False for an interface name that an instance binds to an expression or a variable: what it shares or stands for
/// is no terminal of its own.
pub(crate) fn has_place_of_its_own(variable: &VariableSymbol) -> bool {
    !variable.bound || variable.address.is_some()
}

impl Terminal {
    fn new(slot: Slot) -> Self {
        Terminal {
            slot,
            value: 0,
            sampled: 0,
            overridden: false,
        }
    }
}
