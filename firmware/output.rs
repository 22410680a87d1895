//! Output pins: safe until the program drives them, then what the output image says, and safe again when it stops.

use embedded_hal::digital::{OutputPin, PinState};
use grafcet_core::engine::Engine;
use grafcet_core::memory::Memory;
use grafcet_core::program::Compiled;

use crate::wiring::OutputWire;

/// The outputs of the program on their pins.
pub struct Outputs<P, const N: usize> {
    pins: [P; N],
    wires: &'static [OutputWire; N],
}

impl<P: OutputPin, const N: usize> Outputs<P, N> {
    /// The pins of the wires, in their order, driven to their safe levels.
    pub fn new(pins: [P; N], wires: &'static [OutputWire; N]) -> Self {
        let mut outputs = Outputs { pins, wires };
        outputs.make_safe();
        outputs
    }

    /// Drives the pins to their safe levels.
    pub fn make_safe(&mut self) {
        self.drive(|wire| wire.safe);
    }

    /// Drives the pins with the output image (`semantics.md`, phase 8).
    pub fn write(&mut self, engine: &Engine<impl Compiled, impl Memory>) {
        self.drive(|wire| engine.bit(wire.bit));
    }

    fn drive(&mut self, value: impl Fn(&OutputWire) -> bool) {
        for (pin, wire) in self.pins.iter_mut().zip(self.wires) {
            // A pin of a microcontroller cannot fail to be set; the type of its error says so.
            let _ = pin.set_state(PinState::from(value(wire) != wire.active_low));
        }
    }
}
