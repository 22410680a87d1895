//! One line of `[inputs]` or `[outputs]`: an address, its pin, and what is particular to the kind of signal.
//!
//! The width of the address decides the kind: a Boolean lies at a bit and stands on a level, a number lies at a word
//! and stands on a voltage.

use grafcet_compiler::model::Address;

use crate::rule::{Diagnostic, Rule};
use crate::side::Use;
use crate::table::{Placed, Report, Table};

/// The longest input filter in ms.
pub const LONGEST_FILTER_MS: u32 = 1000;
/// What an analogue input gives at the lowest and at the highest voltage when no scale is written: the readings of the
/// converter.
pub const RAW_SCALE: (i32, i32) = (0, 4095);
/// What a word can hold, with sign or without.
const WORD: std::ops::RangeInclusive<i32> = -32_768..=65_535;

/// One line of a table: an address and what hangs there.
#[derive(Clone, Debug)]
pub struct Wire<T> {
    /// The address.
    pub address: Placed<Address>,
    /// The pin's name.
    pub pin: Option<Placed<String>>,
    /// The rest.
    pub entry: T,
}

/// What is particular to an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputEntry {
    /// At a bit.
    Digital(DigitalInput),
    /// At a word.
    Analogue(AnalogueInput),
    /// At a word, with a scale that cannot be read, which has been reported.
    Unreadable,
}

/// What is particular to a Boolean input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DigitalInput {
    /// The resistor in the chip.
    pub pull: Pull,
    /// The level at which the input is True.
    pub active: Active,
    /// How long a level must last to be seen, in ms.
    pub filter_ms: u16,
}

/// What is particular to a numeric input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AnalogueInput {
    /// The value at 0 V.
    pub low: Placed<i32>,
    /// The value at the supply, 3.3 V. It may lie below `low`.
    pub high: Placed<i32>,
    /// The time in ms of which the value is the mean; 0: one conversion a scan.
    pub filter_ms: u16,
}

/// What is particular to an output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutputEntry {
    /// The level at which the output is True.
    pub active: Active,
    /// The value that it has until the program drives it.
    pub safe: bool,
}

/// The resistor that holds an open input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pull {
    /// To the supply.
    Up,
    /// To ground.
    Down,
    /// None: something outside holds the level.
    None,
}

/// The level at which a wire is True.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Active {
    /// At the supply.
    High,
    /// At ground.
    Low,
}

const LEVELS: &[(&str, Active)] = &[("high", Active::High), ("low", Active::Low)];

/// The keys behind an input's address.
pub(crate) fn read_input(service: Use, table: &Table<'_>, report: &mut Report) -> InputEntry {
    match service {
        Use::AnalogueInput => {
            read_analogue_input(table, report).map_or(InputEntry::Unreadable, InputEntry::Analogue)
        }
        _ => InputEntry::Digital(read_digital_input(table, report)),
    }
}

fn read_digital_input(table: &Table<'_>, report: &mut Report) -> DigitalInput {
    table.expect_keys(&["pin", "pull", "active", "filter"], report);
    let active = table
        .choice("active", LEVELS, report)
        .unwrap_or(Active::High);
    let pulls = [("up", Pull::Up), ("down", Pull::Down), ("none", Pull::None)];
    // An open wire reads as False.
    let toward_false = match active {
        Active::High => Pull::Down,
        Active::Low => Pull::Up,
    };
    DigitalInput {
        pull: table.choice("pull", &pulls, report).unwrap_or(toward_false),
        active,
        filter_ms: read_filter(table, report),
    }
}

fn read_analogue_input(table: &Table<'_>, report: &mut Report) -> Option<AnalogueInput> {
    table.expect_keys(&["pin", "low", "high", "filter"], report);
    let (low, high) = RAW_SCALE;
    let low = read_end(table, "low", low, report);
    let high = read_end(table, "high", high, report);
    let filter_ms = read_filter(table, report);
    let (low, high) = (low?, high?);
    if low.value == high.value {
        let message = format!("the scale has no length: both ends are {}", low.value);
        report.push(
            Diagnostic::new(Rule::BadScale, high.span, message)
                .help("`low` is the value at 0 V, `high` the one at 3.3 V"),
        );
    }
    Some(AnalogueInput {
        low,
        high,
        filter_ms,
    })
}

/// An end of a scale; none when what is written cannot be one.
fn read_end(table: &Table<'_>, key: &str, raw: i32, report: &mut Report) -> Option<Placed<i32>> {
    if table.has(key) {
        table.integer(key, WORD, "200", "", report)
    } else {
        Some(Placed {
            value: raw,
            span: table.span,
        })
    }
}

fn read_filter(table: &Table<'_>, report: &mut Report) -> u16 {
    let filter = table.duration("filter", 0..=LONGEST_FILTER_MS, "\"5 ms\"", report);
    filter.map_or(0, |filter| u16::try_from(filter.value).unwrap_or(u16::MAX))
}

/// The keys behind an output's address.
pub(crate) fn read_output(service: Use, table: &Table<'_>, report: &mut Report) -> OutputEntry {
    // A number at an output is refused as a whole.
    if service == Use::Output {
        table.expect_keys(&["pin", "active", "safe"], report);
    }
    OutputEntry {
        active: table
            .choice("active", LEVELS, report)
            .unwrap_or(Active::High),
        safe: table
            .choice("safe", &[("off", false), ("on", true)], report)
            .unwrap_or(false),
    }
}
