//! A `plc.toml` against its board and its program: what is left is a [`Wiring`].

use std::ops::Range;

use grafcet_compiler::application::{Application, Tables};
use grafcet_compiler::model::Address;
use grafcet_core::program::{Bit, Number, Slot};

use crate::board::{Board, Pin};
use crate::duration;
use crate::file::{Overload, PlcFile};
use crate::join::{Program, bad_scale, number_at_pin, report_twice};
use crate::pins::Pins;
use crate::retain::StoreWires;
use crate::rule::{Diagnostic, Rule};
use crate::side::Side;
use crate::wire::{AnalogueInput, DigitalInput, InputEntry, OutputEntry};

/// The longest record of retained values that the store takes, in bytes.
pub const LONGEST_RECORD: usize = 4000;

/// The watchdog's time in ms when the file sets none and the scan period allows it.
pub const DEFAULT_WATCHDOG_MS: u32 = 1000;

/// A program on a board.
#[derive(Clone, Debug)]
pub struct Wiring {
    /// The board.
    pub board: &'static Board,
    /// The Boolean inputs, in the order of the file.
    pub inputs: Vec<Connection<Bit, DigitalInput>>,
    /// The numeric inputs, in the order of the file.
    pub analogue_inputs: Vec<Connection<Number, AnalogueInput>>,
    /// The outputs, in the order of the file.
    pub outputs: Vec<Connection<Bit, OutputEntry>>,
    /// Where retained values lie: byte offsets in flash, whole sectors.
    pub retain: Range<u32>,
    /// What of the program the store of retained values is wired to.
    pub store: StoreWires,
    /// Bytes of the longest record that the program's retained values can make.
    pub record_bytes: usize,
    /// Time in ms after which a scan that does not end resets the board.
    pub watchdog_ms: u32,
    /// What is an overload, and what is done about it.
    pub overload: Overload,
}

/// A variable of the program on a pin.
#[derive(Clone, Debug)]
pub struct Connection<P, T> {
    /// Where the scan finds it.
    pub place: P,
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
    let input_pins = pins.resolve(&file.inputs, Side::Input, &mut diagnostics);
    let output_pins = pins.resolve(&file.outputs, Side::Output, &mut diagnostics);
    report_twice(&file.inputs, &mut diagnostics);
    report_twice(&file.outputs, &mut diagnostics);
    let Some(application) = application else {
        return (None, diagnostics);
    };
    let mut program = Program {
        variables: &application.controller.symbols.variables,
        elsewhere: file.retain.addresses().collect(),
        pins,
    };
    let store = file
        .retain
        .join(program.variables, &file.inputs, &mut diagnostics);
    let joined = program.join(&file.inputs, input_pins, Side::Input, &mut diagnostics);
    let (mut inputs, mut analogue_inputs) = (Vec::new(), Vec::new());
    for joined in joined {
        match (joined.wire.entry, joined.variable.slot) {
            (InputEntry::Digital(entry), Slot::Bit(bit)) => inputs.extend(joined.at(bit, entry)),
            (InputEntry::Analogue(entry), Slot::Number(number)) => {
                diagnostics.extend(bad_scale(&entry, joined.variable));
                analogue_inputs.extend(joined.at(number, entry));
            }
            // The scale could not be read. Otherwise the two agree: Booleans lie at bits and numbers at words.
            _ => {}
        }
    }
    let joined = program.join(&file.outputs, output_pins, Side::Output, &mut diagnostics);
    let mut outputs = Vec::new();
    for joined in joined {
        match joined.variable.slot {
            Slot::Bit(bit) => outputs.extend(joined.at(bit, joined.wire.entry)),
            Slot::Number(_) => {
                diagnostics.push(number_at_pin(joined.wire.address.span, joined.variable));
            }
        }
    }
    let record_bytes = longest_record(&application.controller.tables);
    if record_bytes > LONGEST_RECORD {
        diagnostics.push(too_big(file, application, record_bytes));
    }
    let Some(board) = file.board else {
        return (None, diagnostics);
    };
    let period_ms = application.controller.tables.period_ms;
    let watchdog_ms = watchdog(file, board, period_ms, &mut diagnostics);
    let retain_bytes = file.retain.sectors * board.sector_bytes;
    let wiring = Wiring {
        board,
        inputs,
        analogue_inputs,
        outputs,
        retain: board.flash_bytes - retain_bytes..board.flash_bytes,
        store,
        record_bytes,
        watchdog_ms,
        overload: file.overload,
    };
    (diagnostics.is_empty().then_some(wiring), diagnostics)
}

/// A header, then key and value of each: variable-length integers of `postcard`.
fn longest_record(tables: &Tables) -> usize {
    const HEADER: usize = 16;
    const LONGEST_INTEGER: usize = 5;
    let lengths = tables.retained.iter().map(|row| {
        let key_bits = (u32::BITS - row.key.leading_zeros()).max(1) as usize;
        key_bits.div_ceil(7) + LONGEST_INTEGER
    });
    HEADER + lengths.sum::<usize>()
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
