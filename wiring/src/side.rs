//! The two sides of a controller, and what a pin does there.

use grafcet_compiler::ast::DeclarationKind;
use grafcet_compiler::model::{Area, Size};

/// What comes in or what goes out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Input,
    Output,
}

impl Side {
    /// The side of an address; memory has none.
    pub(crate) fn of(area: Area) -> Option<Side> {
        match area {
            Area::Input => Some(Side::Input),
            Area::Output => Some(Side::Output),
            Area::Memory => None,
        }
    }

    /// What a program declares on this side.
    pub(crate) fn kind(self) -> DeclarationKind {
        match self {
            Side::Input => DeclarationKind::Input,
            Side::Output => DeclarationKind::Output,
        }
    }

    /// The table in `plc.toml`.
    pub(crate) fn table(self) -> &'static str {
        match self {
            Side::Input => "inputs",
            Side::Output => "outputs",
        }
    }
}

/// What a pin is to serve as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Use {
    /// A Boolean input.
    Input,
    /// A Boolean output.
    Output,
    /// A numeric input.
    AnalogueInput,
    /// A numeric output.
    AnalogueOutput,
}

impl Use {
    /// What the pin of an address serves as: Booleans lie at bits, numbers at words.
    pub(crate) fn of(side: Side, size: Size) -> Use {
        match (side, size) {
            (Side::Input, Size::Bit(_)) => Use::Input,
            (Side::Output, Size::Bit(_)) => Use::Output,
            (Side::Input, Size::Word | Size::Double) => Use::AnalogueInput,
            (Side::Output, Size::Word | Size::Double) => Use::AnalogueOutput,
        }
    }

    pub(crate) fn name(self) -> &'static str {
        match self {
            Use::Input => "input",
            Use::Output => "output",
            Use::AnalogueInput => "analogue input",
            Use::AnalogueOutput => "analogue output",
        }
    }

    pub(crate) fn with_article(self) -> &'static str {
        match self {
            Use::Input => "an input",
            Use::Output => "an output",
            Use::AnalogueInput => "an analogue input",
            Use::AnalogueOutput => "an analogue output",
        }
    }

    /// A pin for examples in messages, in quotes.
    pub(crate) fn example(self) -> &'static str {
        match self {
            Use::AnalogueInput => "\"GP26\"",
            _ => "\"GP2\"",
        }
    }
}
