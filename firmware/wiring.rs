//! What hangs on which pin, as the build read it from `plc.toml`.
//!
//! The generated `application` module fills these rows; their order is the order of the board's pins.

use grafcet_core::program::{Bit, Number};

use crate::scale::Scale;

/// What people call a terminal; kept for hosts only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Label {
    /// The variable of the program.
    pub name: &'static str,
    /// The pin of the board.
    pub pin: &'static str,
}

/// A Boolean input of the program and the pin that it reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InputWire {
    /// Where the scan finds it.
    pub bit: Bit,
    /// Its address, `%IX0.0`.
    pub address: &'static str,
    /// The pin is low when the input is True.
    pub active_low: bool,
    /// How long a level must last to be seen, in ms; 0 samples the pin in the scan and nowhere else.
    pub filter_ms: u16,
}

/// A numeric input of the program and the pin whose voltage it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AnalogueWire {
    /// Where the scan finds it.
    pub number: Number,
    /// Its address, `%IW0`.
    pub address: &'static str,
    /// What the voltages mean; its ends lie within the range of the variable.
    pub scale: Scale,
    /// The time in ms of which the value is the mean; 0 takes one sample in the scan.
    pub filter_ms: u16,
}

/// An output of the program and the pin that it drives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutputWire {
    /// Where the scan leaves it.
    pub bit: Bit,
    /// Its address, `%QX0.0`.
    pub address: &'static str,
    /// The pin is low when the output is True.
    pub active_low: bool,
    /// The value that is safe: what the pin shows until scan 0 has ended, and from when the program is stopped.
    pub safe: bool,
}

/// When scans take too long too often, and what is done about it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Overload {
    /// What is done about it.
    pub policy: Policy,
    /// So many of the latest scans overran, when it is one; 1 to [`crate::schedule::LATEST`].
    pub overruns: u32,
}

/// What the controller does about an overload.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Policy {
    /// It says so, and goes on.
    KeepRunning,
    /// It makes the outputs safe and starts again.
    SafeStop,
}
