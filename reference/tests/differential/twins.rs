//! The engine three times: as it walks over small programs; with what it keeps of large ones, the sets of words and what
//! is armed in each; and without what it keeps for whoever looks on.

use grafcet_core::Engine;
use grafcet_core::program::{Layout, Program, Slot};
use grafcet_core::vectors::Vectors;

/// The same tables, as they are, with sets, and with sets for an image in which nobody looks on.
pub struct Tables<'t>([Program<'t>; 3]);

impl<'t> Tables<'t> {
    pub fn of(tables: Program<'t>) -> Self {
        let sets = u16::try_from(tables.layout.set_words()).unwrap_or(0);
        let layout = Layout {
            sets,
            armed: tables.layout.situations.len,
            ..tables.layout
        };
        let large = Program { layout, ..tables };
        Tables([tables, large, large.unwatched()])
    }
}

/// Three engines that are given the same.
pub struct Twins<'t>([Engine<&'t Program<'t>, Vectors>; 3]);

impl<'t> Twins<'t> {
    pub fn new(tables: &'t Tables<'t>) -> Self {
        Twins(
            tables
                .0
                .each_ref()
                .map(|tables| Engine::new(tables, Vectors::new(tables))),
        )
    }

    /// The one whose traces are compared.
    pub fn first(&self) -> &Engine<&'t Program<'t>, Vectors> {
        &self.0[0]
    }

    /// Whether the latest scan left the same in all.
    pub fn agree(&self) -> bool {
        let [one, other, unwatched] = &self.0;
        one.image() == other.image()
            && one.numbers() == other.numbers()
            && one.image() == unwatched.image()
            && one.numbers() == unwatched.numbers()
            && one.fired().eq(other.fired())
            && (0..one.program().graphs.len()).all(|graph| {
                one.graph_changed(graph) == other.graph_changed(graph)
                    && one.steps_before(graph).eq(other.steps_before(graph))
                    && one.graph_forced(graph) == other.graph_forced(graph)
            })
    }

    pub fn restore(&mut self, slot: Slot, value: i32) -> bool {
        self.0
            .each_mut()
            .map(|engine| engine.restore(slot, value))
            .contains(&true)
    }

    pub fn set_recovered(&mut self, recovered: bool) {
        for engine in &mut self.0 {
            engine.set_recovered(recovered);
        }
    }

    pub fn set_overruns(&mut self, overruns: u32) {
        for engine in &mut self.0 {
            engine.set_overruns(overruns);
        }
    }

    pub fn set_parameter(&mut self, slot: Slot, value: i32) {
        for engine in &mut self.0 {
            engine.set_parameter(slot, value);
        }
    }

    pub fn sample(&mut self, slot: Slot, value: i32) {
        for engine in &mut self.0 {
            engine.sample(slot, value);
        }
    }

    pub fn start(&mut self) {
        for engine in &mut self.0 {
            engine.start();
        }
    }

    /// False when it was an idle scan for all.
    pub fn scan(&mut self, time_ms: u64) -> bool {
        self.0
            .each_mut()
            .map(|engine| engine.scan(time_ms))
            .contains(&true)
    }
}
