//! Input pins, with the latches that the RP2040 has for their edges.

use core::convert::Infallible;

use embassy_rp::Peri;
use embassy_rp::gpio::{Input, Pin, Pull};
use embassy_rp::pac;
use embassy_rp::pac::io::regs::Int;
use embedded_hal::digital::{ErrorType, InputPin};

use crate::input::Latched;

/// An input pin.
pub struct DigitalInput {
    input: Input<'static>,
    /// Its register of latches, of which there are four.
    register: usize,
    /// The latches of either edge in it.
    edges: u32,
}

impl DigitalInput {
    /// A pin as an input.
    #[must_use]
    pub fn new(pin: Peri<'static, impl Pin>, pull: Pull) -> Self {
        let number = pin.pin();
        DigitalInput {
            input: Input::new(pin, pull),
            register: usize::from(number / 8),
            edges: 0b1100 << (number % 8 * 4),
        }
    }
}

impl Latched for DigitalInput {
    fn take_changed(&mut self) -> Option<bool> {
        let latches = pac::IO_BANK0.intr(self.register % 4);
        let changed = latches.read().0 & self.edges != 0;
        if changed {
            latches.write_value(Int(self.edges));
        }
        Some(changed)
    }
}

impl ErrorType for DigitalInput {
    type Error = Infallible;
}

impl InputPin for DigitalInput {
    fn is_high(&mut self) -> Result<bool, Infallible> {
        Ok(self.input.is_high())
    }

    fn is_low(&mut self) -> Result<bool, Infallible> {
        Ok(self.input.is_low())
    }
}
