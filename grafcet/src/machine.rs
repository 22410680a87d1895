//! One program on its engine, from power-on to power-off and on again.

use grafcet_compiler::application::Tables;
use grafcet_core::engine::Engine;
use grafcet_core::program::{Program, Slot};
use typed_arena::Arena;

use grafcet_core::images::Images;
use grafcet_core::vectors::Vectors;

/// Where the programs of machines live.
#[derive(Default)]
pub struct Bench<'t> {
    programs: Arena<Program<'t>>,
}

impl<'t> Bench<'t> {
    /// An empty bench.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets up a program on the bench.
    pub fn machine<'b>(&'b self, tables: &'t Tables) -> Machine<'b> {
        let program: &'b Program<'b> = self.programs.alloc(tables.program());
        Machine {
            program,
            engine: power_on(program),
            started: false,
        }
    }
}

/// An engine over vectors, for a program of any size.
pub type HostEngine<'b> = Engine<&'b Program<'b>, Vectors>;

fn power_on<'b>(program: &'b Program<'b>) -> HostEngine<'b> {
    Engine::new(program, Vectors::new(program))
}

/// A program and its engine.
pub struct Machine<'b> {
    program: &'b Program<'b>,
    engine: HostEngine<'b>,
    started: bool,
}

impl<'b> Machine<'b> {
    /// The engine.
    #[must_use]
    pub fn engine(&self) -> &HostEngine<'b> {
        &self.engine
    }

    /// Whether scan 0 has run since power came.
    #[must_use]
    pub fn started(&self) -> bool {
        self.started
    }

    /// The images as the latest scan left them.
    #[must_use]
    pub fn images(&self) -> Images<'_> {
        self.engine.images()
    }

    /// Gives an input its sample for the next scan.
    pub fn sample(&mut self, slot: Slot, value: i32) {
        self.engine.sample(slot, value);
    }

    /// Gives a parameter or variable a new value between two scans, clamped to its range and counted when it lies
    /// outside.
    pub fn set(&mut self, slot: Slot, value: i32) {
        self.engine.set_parameter(slot, value);
    }

    /// Runs scan 0, or a later one at that time in ms since scan 0. False when it was an idle one, as
    /// [`Engine::scan`] says.
    pub fn scan(&mut self, time_ms: u64) -> bool {
        if self.started {
            return self.engine.scan(time_ms);
        }
        self.engine.start();
        self.started = true;
        true
    }

    /// Loses power and gets it back: all is forgotten but what is retained. The next scan is scan 0.
    pub fn power_cycle(&mut self) {
        let before = std::mem::replace(&mut self.engine, power_on(self.program));
        self.started = false;
        for retained in self.program.retained {
            self.engine
                .restore(retained.slot, before.value(retained.slot));
        }
    }
}
