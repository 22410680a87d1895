//! A `plc.toml` against its board and its program: what is left is a [`Wiring`].

use std::ops::Range;

use grafcet_compiler::application::{Application, Tables, VariableSymbol};
use grafcet_compiler::model::Address;
use grafcet_core::program::{Bit, Slot};

use crate::board::{Board, Pin};
use crate::duration;
use crate::file::{InputEntry, OutputEntry, PlcFile, Section, Wire};
use crate::pins::Pins;
use crate::rule::{Diagnostic, Rule};
use crate::side::Side;

/// The longest record of retained values that the store takes, in bytes.
pub const LONGEST_RECORD: usize = 4000;

/// The watchdog's time in ms when the file sets none and the scan period allows it.
pub const DEFAULT_WATCHDOG_MS: u32 = 1000;

/// A program on a board.
#[derive(Clone, Debug)]
pub struct Wiring {
    /// The board.
    pub board: &'static Board,
    /// The inputs, in the order of the file.
    pub inputs: Vec<Connection<InputEntry>>,
    /// The outputs, in the order of the file.
    pub outputs: Vec<Connection<OutputEntry>>,
    /// Where retained values lie: byte offsets in flash, whole sectors.
    pub retain: Range<u32>,
    /// Bytes of the longest record that the program's retained values can make.
    pub record_bytes: usize,
    /// Time in ms after which a scan that does not end resets the board.
    pub watchdog_ms: u32,
}

/// A variable of the program on a pin.
#[derive(Clone, Debug)]
pub struct Connection<T> {
    /// Where the scan finds it.
    pub bit: Bit,
    /// Its address.
    pub address: Address,
    /// Its pin.
    pub pin: &'static Pin,
    /// The rest.
    pub entry: T,
}

/// Checks the pins of a file and, when the program compiled, every address against it. There is a wiring only when
/// nothing was found.
#[must_use]
pub fn check(
    file: &PlcFile,
    application: Option<&Application>,
) -> (Option<Wiring>, Vec<Diagnostic>) {
    let mut diagnostics = Vec::new();
    let mut pins = Pins::new(file.board);
    let inputs = pins.resolve(&file.inputs, Side::Input, &mut diagnostics);
    let outputs = pins.resolve(&file.outputs, Side::Output, &mut diagnostics);
    report_twice(&file.inputs, &mut diagnostics);
    report_twice(&file.outputs, &mut diagnostics);
    let Some(application) = application else {
        return (None, diagnostics);
    };
    let mut program = Program {
        variables: &application.controller.symbols.variables,
        pins,
    };
    let inputs = program.connect(&file.inputs, inputs, Side::Input, &mut diagnostics);
    let outputs = program.connect(&file.outputs, outputs, Side::Output, &mut diagnostics);
    let record_bytes = longest_record(&application.controller.tables);
    if record_bytes > LONGEST_RECORD {
        diagnostics.push(too_big(file, application, record_bytes));
    }
    let Some(board) = file.board else {
        return (None, diagnostics);
    };
    let period_ms = application.controller.tables.period_ms;
    let watchdog_ms = watchdog(file, board, period_ms, &mut diagnostics);
    let retain_bytes = file.retain_sectors * board.sector_bytes;
    let wiring = Wiring {
        board,
        inputs,
        outputs,
        retain: board.flash_bytes - retain_bytes..board.flash_bytes,
        record_bytes,
        watchdog_ms,
    };
    (diagnostics.is_empty().then_some(wiring), diagnostics)
}

/// The program's side.
struct Program<'a> {
    variables: &'a [VariableSymbol],
    pins: Pins,
}

impl<'a> Program<'a> {
    /// Joins wires and variables; reports addresses that only one side knows.
    fn connect<T: Copy>(
        &mut self,
        section: &Section<T>,
        pins: Vec<Option<&'static Pin>>,
        side: Side,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Vec<Connection<T>> {
        let variables = self.variables_on(side);
        let wired = |address| {
            section
                .wires
                .iter()
                .any(|wire| wire.address.value == address)
        };
        let open: Vec<_> = variables
            .iter()
            .filter(|(address, _)| !wired(*address))
            .collect();
        let mut connections = Vec::new();
        for (wire, pin) in section.wires.iter().zip(pins) {
            let address = wire.address.value;
            let Some((_, variable)) = variables.iter().find(|(known, _)| *known == address) else {
                diagnostics.push(unknown_address(wire, side, &open));
                continue;
            };
            match (variable.slot, pin) {
                (Slot::Bit(bit), Some(pin)) => connections.push(Connection {
                    bit,
                    address,
                    pin,
                    entry: wire.entry,
                }),
                (Slot::Bit(_), None) => {}
                (Slot::Number(_), _) => {
                    let message = format!("the number `{}` cannot be on a pin", variable.name);
                    diagnostics.push(
                        Diagnostic::new(Rule::NumberAtPin, wire.address.span, message)
                            .label(variable.span, "declared here")
                            .help("pins carry Booleans, at `%IX` and `%QX`; numbers are not wired yet"),
                    );
                }
            }
        }
        for (address, variable) in open {
            let pin = self.pins.propose(side, section.span);
            diagnostics.push(not_wired(section, *address, variable, side, pin));
        }
        connections
    }

    /// The program's inputs or outputs, by address.
    fn variables_on(&self, side: Side) -> Vec<(Address, &'a VariableSymbol)> {
        let ours = self
            .variables
            .iter()
            .filter(|variable| variable.kind == side.kind());
        ours.filter_map(|variable| {
            let address = Address::parse(variable.address.as_deref()?).ok()?;
            Some((address, variable))
        })
        .collect()
    }
}

fn report_twice<T>(section: &Section<T>, diagnostics: &mut Vec<Diagnostic>) {
    for (index, wire) in section.wires.iter().enumerate() {
        let earlier = section.wires.iter().take(index);
        if let Some(first) = { earlier }.find(|it| it.address.value == wire.address.value) {
            let message = format!("`{}` is wired twice", wire.address.value);
            diagnostics.push(
                Diagnostic::new(Rule::DuplicateAddress, wire.address.span, message)
                    .label(first.address.span, "first here"),
            );
        }
    }
}

fn unknown_address<T>(
    wire: &Wire<T>,
    side: Side,
    open: &[&(Address, &VariableSymbol)],
) -> Diagnostic {
    let message = format!(
        "the program has no {} at `{}`",
        side.name(),
        wire.address.value
    );
    let diagnostic = Diagnostic::new(Rule::UnknownAddress, wire.address.span, message);
    match open {
        [] => diagnostic.help(format!(
            "take the line out, or declare {} there",
            side.with_article()
        )),
        [(address, variable), ..] => diagnostic
            .label(
                variable.span,
                format!("this one, at `{address}`, has no pin"),
            )
            .help(format!("did you mean `\"{address}\"`?")),
    }
}

fn not_wired<T>(
    section: &Section<T>,
    address: Address,
    variable: &VariableSymbol,
    side: Side,
    pin: Option<&'static Pin>,
) -> Diagnostic {
    let (name, kind) = (&variable.name, side.name());
    if let Slot::Number(_) = variable.slot {
        let message = format!("the number `{name}` at `{address}` cannot be on a pin");
        return Diagnostic::new(Rule::NumberAtPin, section.span, message)
            .label(variable.span, "declared here")
            .help("pins carry Booleans, at `%IX` and `%QX`; numbers are not wired yet");
    }
    let message = format!("the {kind} `{name}` at `{address}` has no pin");
    let diagnostic = Diagnostic::new(Rule::NotWired, section.span, message)
        .label(variable.span, "declared here");
    match pin {
        Some(pin) => diagnostic.help(format!(
            "add under `[{}]`, with a pin of your choice: `\"{address}\" = {{ pin = \"{}\" }}`",
            side.table(),
            pin.name
        )),
        None => diagnostic.help("the board has no free pin left"),
    }
}

/// Sequence and fingerprint, then key and value of each: variable-length integers of `postcard`.
fn longest_record(tables: &Tables) -> usize {
    const LONGEST_INTEGER: usize = 5;
    let lengths = tables.retained.iter().map(|row| {
        let key_bits = (u32::BITS - row.key.leading_zeros()).max(1) as usize;
        key_bits.div_ceil(7) + LONGEST_INTEGER
    });
    2 * LONGEST_INTEGER + lengths.sum::<usize>()
}

fn too_big(file: &PlcFile, application: &Application, bytes: usize) -> Diagnostic {
    let count = application.controller.tables.retained.len();
    let span = file
        .application
        .as_ref()
        .map_or(file.head, |path| path.span);
    let message = format!(
        "the program retains {count} values, {bytes} bytes at most, and one record takes {LONGEST_RECORD}"
    );
    Diagnostic::new(Rule::RetainTooBig, span, message)
        .help("make constants of parameters that nobody sets, and plain variables of what need not survive power")
}

/// The watchdog has to bear a scan period and an erased sector, in which no scan runs.
fn watchdog(
    file: &PlcFile,
    board: &Board,
    period_ms: u32,
    diagnostics: &mut Vec<Diagnostic>,
) -> u32 {
    let least = period_ms.saturating_add(board.erase_ms);
    let chosen = file.watchdog_ms.as_ref();
    let value = chosen.map_or(DEFAULT_WATCHDOG_MS.max(least), |chosen| chosen.value);
    if value < least || least > board.watchdog_limit_ms {
        let span = chosen.map_or(file.head, |chosen| chosen.span);
        let (period, erase) = (duration::shown(period_ms), duration::shown(board.erase_ms));
        let message = format!(
            "the watchdog must wait longer than a scan period of {period} and the {erase} of an erase: {} at least",
            duration::shown(least)
        );
        let diagnostic = Diagnostic::new(Rule::OutOfRange, span, message);
        let limit = duration::shown(board.watchdog_limit_ms);
        diagnostics.push(if least > board.watchdog_limit_ms {
            diagnostic.help(format!(
                "the {} can wait {limit}; shorten the scan",
                board.title
            ))
        } else {
            diagnostic.help(format!("write `timeout = \"{}\"`", duration::shown(least)))
        });
    }
    value
}
