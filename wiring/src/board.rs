//! What a board offers: its pins, and the flash at the end of which the retain area lies.

use crate::boards::PICO;

/// Every board that an image can be built for.
pub const BOARDS: &[&Board] = &[&PICO];

/// A board.
#[derive(Debug, PartialEq, Eq)]
pub struct Board {
    /// What it is called in `plc.toml`.
    pub name: &'static str,
    /// What people call it.
    pub title: &'static str,
    /// All pins of its chip, reserved ones too, in the order in which they are proposed.
    pub pins: &'static [Pin],
    /// Bytes of flash.
    pub flash_bytes: u32,
    /// Bytes of the smallest part of the flash that can be erased.
    pub sector_bytes: u32,
    /// The longest time in ms that erasing a sector can take; no scan runs meanwhile.
    pub erase_ms: u32,
    /// The longest time in ms that the watchdog can wait.
    pub watchdog_limit_ms: u32,
}

impl Board {
    /// The board of that name.
    #[must_use]
    pub fn by_name(name: &str) -> Option<&'static Board> {
        BOARDS.iter().find(|board| board.name == name).copied()
    }

    /// The pin of that name.
    #[must_use]
    pub fn pin(&self, name: &str) -> Option<&'static Pin> {
        self.pins.iter().find(|pin| pin.name == name)
    }
}

/// A pin of a board.
#[derive(Debug, PartialEq, Eq)]
pub struct Pin {
    /// What is printed beside it: `GP2`.
    pub name: &'static str,
    /// What the hardware abstraction calls it: `PIN_2`.
    pub peripheral: &'static str,
    /// What it can serve as.
    pub purpose: Purpose,
    /// Whether the analogue-to-digital converter can be connected to it.
    pub analogue: bool,
}

/// What a pin can serve as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// An input or an output.
    Free,
    /// An analogue input only, for this reason.
    AnalogueInput(&'static str),
    /// An output only, for this reason.
    Output(&'static str),
    /// Nothing, for this reason.
    Reserved(&'static str),
}
