//! `plc.toml` as it is written, each value with its place. Nothing here knows the program yet.

use grafcet_compiler::model::{Address, Area};
use grafcet_compiler::source::{FileId, Span};
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use crate::board::{BOARDS, Board};
use crate::nearest::nearest;
use crate::rule::{Diagnostic, Rule};
use crate::side::Side;
use crate::syntax;
use crate::table::{Placed, Report, Table, listed};

/// The longest input filter in ms.
pub const LONGEST_FILTER_MS: u32 = 1000;
/// The sectors of the retain area when the file names none.
pub const DEFAULT_SECTORS: u32 = 4;
/// The store has two halves of at least two sectors each; more of them wear less.
pub const SECTORS: std::ops::RangeInclusive<u32> = 4..=64;

/// The file.
#[derive(Clone, Debug)]
pub struct PlcFile {
    /// Where a message about the file as a whole points.
    pub head: Span,
    /// Path of the program, relative to the file.
    pub application: Option<Placed<String>>,
    /// The board.
    pub board: Option<&'static Board>,
    /// `[inputs]`.
    pub inputs: Section<InputEntry>,
    /// `[outputs]`.
    pub outputs: Section<OutputEntry>,
    /// Sectors of the retain area.
    pub retain_sectors: u32,
    /// Time in ms after which a scan that does not end resets the board, when the file sets it.
    pub watchdog_ms: Option<Placed<u32>>,
}

/// A table of wires.
#[derive(Clone, Debug)]
pub struct Section<T> {
    /// Its heading, or the head of the file when it is missing.
    pub span: Span,
    /// Its wires, in the order of the file.
    pub wires: Vec<Wire<T>>,
}

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
pub struct InputEntry {
    /// The resistor in the chip.
    pub pull: Pull,
    /// The level at which the input is True.
    pub active: Active,
    /// How long a level must last to be seen, in ms.
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

/// The path of the program, when the file says it in spite of whatever else may be wrong with it.
#[must_use]
pub fn application_path(text: &str) -> Option<String> {
    let (table, _) = DeTable::parse_recoverable(text);
    let path = table.get_ref().get("application")?.get_ref().as_str();
    path.map(str::to_owned)
}

/// Reads the file. What cannot be read is reported and left out; there is no file when TOML itself cannot be read.
#[must_use]
pub fn read(text: &str, file: FileId) -> (Option<PlcFile>, Vec<Diagnostic>) {
    let (table, errors) = DeTable::parse_recoverable(text);
    let mut report = Report {
        file,
        diagnostics: Vec::new(),
    };
    syntax::report_errors(text, table.get_ref(), &errors, &mut report);
    // Behind an error of syntax keys are missing that are there.
    let readable = syntax::are_duplicates_only(&errors);
    let file = readable.then(|| read_tables(&table, &mut report));
    (file, report.diagnostics)
}

fn read_tables(table: &Spanned<DeTable<'_>>, report: &mut Report) -> PlcFile {
    let head = report.span(0..0);
    let top = Table {
        table: table.get_ref(),
        span: head,
        what: "plc.toml",
    };
    top.expect_keys(
        &[
            "application",
            "board",
            "inputs",
            "outputs",
            "retain",
            "watchdog",
        ],
        report,
    );
    let application = top
        .string(
            "application",
            Some("which program is it?"),
            "\"graphs/line_switcher.grafcet\"",
            report,
        )
        .map(Placed::into_owned);
    let board = read_board(&top, report);
    let inputs = read_section(&top, Side::Input, read_input, report);
    let outputs = read_section(&top, Side::Output, read_output, report);
    let retain_sectors = top
        .table("retain", "`[retain]`", report)
        .and_then(|retain| {
            retain.expect_keys(&["sectors"], report);
            let sectors = retain.integer("sectors", SECTORS, "sectors", report)?;
            if !sectors.value.is_multiple_of(2) {
                let message = "`sectors` is odd, and the retain area has two equal halves";
                let help = format!("write `sectors = {}`", sectors.value + 1);
                report.push(Diagnostic::new(Rule::OutOfRange, sectors.span, message).help(help));
            }
            Some(sectors)
        });
    let watchdog_ms = top
        .table("watchdog", "`[watchdog]`", report)
        .and_then(|watchdog| {
            watchdog.expect_keys(&["timeout"], report);
            let limit = board.map_or(u32::MAX, |board| board.watchdog_limit_ms);
            watchdog.duration("timeout", 1..=limit, "\"1 s\"", report)
        });
    PlcFile {
        head,
        application,
        board,
        inputs,
        outputs,
        retain_sectors: retain_sectors.map_or(DEFAULT_SECTORS, |sectors| sectors.value),
        watchdog_ms,
    }
}

fn read_board(top: &Table<'_>, report: &mut Report) -> Option<&'static Board> {
    let name = top.string("board", Some("which board is it?"), "\"pico\"", report)?;
    let board = Board::by_name(name.value);
    if board.is_none() {
        let names: Vec<&str> = BOARDS.iter().map(|board| board.name).collect();
        let message = format!("there is no board `{}`", name.value);
        let help = match nearest(name.value, names.iter().copied()) {
            Some(near) => format!("did you mean `\"{near}\"`?"),
            None => format!("known boards: {}", listed(&names)),
        };
        report.push(Diagnostic::new(Rule::UnknownBoard, name.span, message).help(help));
    }
    board
}

type ReadEntry<T> = fn(&Table<'_>, &mut Report) -> T;

fn read_section<T>(
    top: &Table<'_>,
    side: Side,
    read_entry: ReadEntry<T>,
    report: &mut Report,
) -> Section<T> {
    let Some(section) = top.table(side.table(), "", report) else {
        return Section {
            span: top.span,
            wires: Vec::new(),
        };
    };
    let wires = section.entries().filter_map(|(key, value)| {
        let address = read_address(key, side, report);
        let (pin, entry) = read_wire(value, side, read_entry, report);
        Some(Wire {
            address: address?,
            pin,
            entry,
        })
    });
    Section {
        wires: wires.collect(),
        span: section.span,
    }
}

fn read_address(
    key: &Spanned<DeString<'_>>,
    side: Side,
    report: &mut Report,
) -> Option<Placed<Address>> {
    let span = report.span(key.span());
    let address = match Address::parse(key.get_ref()) {
        Ok(address) => address,
        Err(message) => {
            report.push(
                Diagnostic::new(Rule::BadAddress, span, message).help(
                    "the keys here are the addresses that the program declares: `input start at %IX0.0`",
                ),
            );
            return None;
        }
    };
    if Side::of(address.area) != Some(side) {
        let (letter, message, help) = match address.area {
            Area::Input => ('I', "an input", "move the line to `[inputs]`"),
            Area::Output => ('Q', "an output", "move the line to `[outputs]`"),
            Area::Memory => ('M', "memory", "memory has no pin; take the line out"),
        };
        let message = format!("`%{letter}` is {message}, and this is `[{}]`", side.table());
        report.push(Diagnostic::new(Rule::AddressDirection, span, message).help(help));
        return None;
    }
    Some(Placed {
        value: address,
        span,
    })
}

/// A pin alone, `"%IX0.0" = "GP2"`, or a table with a pin.
fn read_wire<T>(
    value: &Spanned<DeValue<'_>>,
    side: Side,
    read_entry: ReadEntry<T>,
    report: &mut Report,
) -> (Option<Placed<String>>, T) {
    let span = report.span(value.span());
    let what = side.with_article();
    let nothing = DeTable::new();
    let bare = Table {
        table: &nothing,
        span,
        what,
    };
    let (pin, table) = match value.get_ref() {
        DeValue::Table(table) => {
            let table = Table { table, span, what };
            let pin = table.string("pin", Some("which pin is it?"), "\"GP2\"", report);
            (pin, table)
        }
        DeValue::String(pin) => {
            let value = pin.as_ref();
            (Some(Placed { value, span }), bare)
        }
        _ => {
            let message = format!("{what} is a pin or a table with one");
            report.push(
                Diagnostic::new(Rule::BadValue, span, message)
                    .help("write `\"GP2\"`, or `{ pin = \"GP2\" }` with more behind it"),
            );
            (None, bare)
        }
    };
    (pin.map(Placed::into_owned), read_entry(&table, report))
}

const LEVELS: &[(&str, Active)] = &[("high", Active::High), ("low", Active::Low)];

fn read_input(table: &Table<'_>, report: &mut Report) -> InputEntry {
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
    let filter = table.duration("filter", 0..=LONGEST_FILTER_MS, "\"5 ms\"", report);
    InputEntry {
        pull: table.choice("pull", &pulls, report).unwrap_or(toward_false),
        active,
        filter_ms: filter.map_or(0, |filter| u16::try_from(filter.value).unwrap_or(u16::MAX)),
    }
}

fn read_output(table: &Table<'_>, report: &mut Report) -> OutputEntry {
    table.expect_keys(&["pin", "active", "safe"], report);
    OutputEntry {
        active: table
            .choice("active", LEVELS, report)
            .unwrap_or(Active::High),
        safe: table
            .choice("safe", &[("off", false), ("on", true)], report)
            .unwrap_or(false),
    }
}
