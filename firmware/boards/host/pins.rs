//! Pins that are not there: levels and voltages between a controller and the machine on the same host.

use std::cell::Cell;
use std::convert::Infallible;

use embedded_hal::digital::{ErrorType, InputPin, OutputPin};

use crate::analogue::Converter;
use crate::input::Latched;

/// An input pin. Whoever has the cell sets its level.
pub struct Input<'a>(pub &'a Cell<bool>);

/// An output pin. Whoever has the cell reads its level.
pub struct Output<'a>(pub &'a Cell<bool>);

/// A converter. Whoever has the cells sets what it reads.
pub struct Readings<'a>(pub &'a [Cell<u16>]);

impl Converter for Readings<'_> {
    fn convert(&mut self, terminal: usize) -> Option<u16> {
        self.0.get(terminal).map(Cell::get)
    }
}

impl ErrorType for Input<'_> {
    type Error = Infallible;
}

impl InputPin for Input<'_> {
    fn is_high(&mut self) -> Result<bool, Infallible> {
        Ok(self.0.get())
    }

    fn is_low(&mut self) -> Result<bool, Infallible> {
        Ok(!self.0.get())
    }
}

impl Latched for Input<'_> {
    fn take_changed(&mut self) -> Option<bool> {
        None
    }
}

impl ErrorType for Output<'_> {
    type Error = Infallible;
}

impl OutputPin for Output<'_> {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.0.set(false);
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.0.set(true);
        Ok(())
    }
}
