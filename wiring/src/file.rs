//! `plc.toml` as it is written, each value with its place. Nothing here knows the program yet.

use grafcet_compiler::model::{Address, Area, Size};
use grafcet_compiler::source::{FileId, Span};
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use crate::board::{BOARDS, Board};
use crate::nearest::nearest;
use crate::retain::{Retain, read_retain};
use crate::rule::{Diagnostic, Rule};
use crate::side::{Side, Use};
use crate::syntax;
use crate::table::{Placed, Report, Table, listed};
use crate::wire::{InputEntry, OutputEntry, Wire, read_input, read_output};

/// Overruns among the latest 100 scans that are an overload.
pub const OVERRUNS: std::ops::RangeInclusive<u32> = 1..=100;

/// What the controller does about an overload.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Policy {
    /// It says so, and goes on.
    KeepRunning,
    /// It makes the outputs safe and starts again.
    SafeStop,
}

/// `[overload]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Overload {
    /// What is done about it.
    pub policy: Policy,
    /// How many of the latest 100 scans overran, when it is one.
    pub overruns: u32,
}

impl Default for Overload {
    /// A controller that cannot keep its times does not hold what its program was reckoned to do; a scan held up by the
    /// flash, now and then, is none of that.
    fn default() -> Self {
        Overload {
            policy: Policy::SafeStop,
            overruns: 10,
        }
    }
}

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
    /// `[retain]`.
    pub retain: Retain,
    /// Time in ms after which a scan that does not end resets the board, when the file sets it.
    pub watchdog_ms: Option<Placed<u32>>,
    /// What is an overload, and what is done about it.
    pub overload: Overload,
}

/// A table of wires.
#[derive(Clone, Debug)]
pub struct Section<T> {
    /// Its heading, or the head of the file when it is missing.
    pub span: Span,
    /// Its wires, in the order of the file.
    pub wires: Vec<Wire<T>>,
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
            "overload",
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
    let retain = read_retain(&top, report);
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
        retain,
        watchdog_ms,
        overload: read_overload(&top, report),
    }
}

fn read_overload(top: &Table<'_>, report: &mut Report) -> Overload {
    let default = Overload::default();
    let Some(table) = top.table("overload", "`[overload]`", report) else {
        return default;
    };
    table.expect_keys(&["policy", "overruns"], report);
    let policies = [
        ("safe-stop", Policy::SafeStop),
        ("keep-running", Policy::KeepRunning),
    ];
    let policy = table.choice("policy", &policies, report);
    let overruns = table.integer("overruns", OVERRUNS, "10", " of 100 scans", report);
    Overload {
        policy: policy.unwrap_or(default.policy),
        overruns: overruns.map_or(default.overruns, |overruns| overruns.value),
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

type ReadEntry<T> = fn(Use, &Table<'_>, &mut Report) -> T;

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
        let address = read_address(key, report);
        // A key that cannot be read hides nothing that is wrong behind it.
        let size = address.as_ref().map_or(Size::Bit(0), |it| it.value.size);
        let address = address.filter(|address| lies_on(side, address, report));
        let (pin, entry) = read_wire(value, Use::of(side, size), read_entry, report);
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

fn read_address(key: &Spanned<DeString<'_>>, report: &mut Report) -> Option<Placed<Address>> {
    let span = report.span(key.span());
    match Address::parse(key.get_ref()) {
        Ok(value) => Some(Placed { value, span }),
        Err(message) => {
            report.push(
                Diagnostic::new(Rule::BadAddress, span, message).help(
                    "the keys here are the addresses that the program declares: `input start at %IX0.0`",
                ),
            );
            None
        }
    }
}

/// Reports an address of the other side.
fn lies_on(side: Side, address: &Placed<Address>, report: &mut Report) -> bool {
    let area = address.value.area;
    if Side::of(area) == Some(side) {
        return true;
    }
    let (letter, message, help) = match area {
        Area::Input => ('I', "an input", "move the line to `[inputs]`"),
        Area::Output => ('Q', "an output", "move the line to `[outputs]`"),
        Area::Memory => ('M', "memory", "memory has no pin; take the line out"),
    };
    let message = format!("`%{letter}` is {message}, and this is `[{}]`", side.table());
    report.push(Diagnostic::new(Rule::AddressDirection, address.span, message).help(help));
    false
}

/// A pin alone, `"%IX0.0" = "GP2"`, or a table with a pin.
fn read_wire<T>(
    value: &Spanned<DeValue<'_>>,
    service: Use,
    read_entry: ReadEntry<T>,
    report: &mut Report,
) -> (Option<Placed<String>>, T) {
    let span = report.span(value.span());
    let what = service.with_article();
    let nothing = DeTable::new();
    let bare = Table {
        table: &nothing,
        span,
        what,
    };
    let (pin, table) = match value.get_ref() {
        DeValue::Table(table) => {
            let table = Table { table, span, what };
            let pin = table.string("pin", Some("which pin is it?"), service.example(), report);
            (pin, table)
        }
        DeValue::String(pin) => {
            let value = pin.as_ref();
            (Some(Placed { value, span }), bare)
        }
        _ => {
            let message = format!("{what} is a pin or a table with one");
            report.push(Diagnostic::new(Rule::BadValue, span, message).help(format!(
                "write `{0}`, or `{{ pin = {0} }}` with more behind it",
                service.example()
            )));
            (None, bare)
        }
    };
    (
        pin.map(Placed::into_owned),
        read_entry(service, &table, report),
    )
}
