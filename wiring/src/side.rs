//! The two sides of a controller.

use grafcet_compiler::ast::DeclarationKind;
use grafcet_compiler::model::Area;

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

    pub(crate) fn name(self) -> &'static str {
        match self {
            Side::Input => "input",
            Side::Output => "output",
        }
    }

    pub(crate) fn with_article(self) -> &'static str {
        match self {
            Side::Input => "an input",
            Side::Output => "an output",
        }
    }
}
