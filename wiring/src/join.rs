//! The wires of a file and the variables of a program, joined by their addresses.

use grafcet_compiler::application::VariableSymbol;
use grafcet_compiler::model::Address;
use grafcet_compiler::source::Span;
use grafcet_core::program::Slot;

use crate::board::Pin;
use crate::check::Connection;
use crate::file::Section;
use crate::pins::Pins;
use crate::rule::{Diagnostic, Rule};
use crate::side::{Side, Use};
use crate::wire::{AnalogueInput, RAW_SCALE, Wire};

/// The program's side.
pub(crate) struct Program<'a> {
    pub(crate) variables: &'a [VariableSymbol],
    /// What needs no pin, being wired to something else.
    pub(crate) elsewhere: Vec<Address>,
    pub(crate) pins: Pins,
}

/// A wire, its variable, and its pin where it has one that it can have.
pub(crate) struct Joined<'a, T> {
    pub(crate) wire: &'a Wire<T>,
    pub(crate) variable: &'a VariableSymbol,
    pin: Option<&'static Pin>,
}

impl<T> Joined<'_, T> {
    /// The connection, if there is a pin.
    pub(crate) fn at<P, E>(&self, place: P, entry: E) -> Option<Connection<P, E>> {
        Some(Connection {
            place,
            address: self.wire.address.value,
            pin: self.pin?,
            entry,
        })
    }
}

impl<'a> Program<'a> {
    /// Joins wires and variables; reports addresses that only one side knows.
    pub(crate) fn join<T>(
        &mut self,
        section: &'a Section<T>,
        pins: Vec<Option<&'static Pin>>,
        side: Side,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Vec<Joined<'a, T>> {
        let variables = self.variables_on(side);
        let wired = |address| {
            section
                .wires
                .iter()
                .any(|wire| wire.address.value == address)
        };
        let open: Vec<_> = variables
            .iter()
            .filter(|(address, _)| !wired(*address) && !self.elsewhere.contains(address))
            .copied()
            .collect();
        let mut joined = Vec::new();
        for (wire, pin) in section.wires.iter().zip(pins) {
            let address = wire.address.value;
            match variables.iter().find(|(known, _)| *known == address) {
                Some((_, variable)) => joined.push(Joined {
                    wire,
                    variable,
                    pin,
                }),
                None => diagnostics.push(unknown_address(wire, side, &open)),
            }
        }
        for (address, variable) in open {
            diagnostics.push(self.not_wired(section, address, variable, side));
        }
        joined
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

    fn not_wired<T>(
        &mut self,
        section: &Section<T>,
        address: Address,
        variable: &VariableSymbol,
        side: Side,
    ) -> Diagnostic {
        let service = Use::of(side, address.size);
        if service == Use::AnalogueOutput {
            return number_at_pin(section.span, variable);
        }
        let (name, kind) = (&variable.name, service.name());
        let message = format!("the {kind} `{name}` at `{address}` has no pin");
        let diagnostic = Diagnostic::new(Rule::NotWired, section.span, message)
            .label(variable.span, "declared here");
        let Some(pin) = self.pins.propose(service, section.span) else {
            return diagnostic.help(format!(
                "the board has no pin left that can be {}",
                service.with_article()
            ));
        };
        let scale = match variable.slot {
            Slot::Bit(_) => String::new(),
            Slot::Number(_) => {
                let (low, high) = sensible_scale(variable);
                format!(", low = {low}, high = {high}")
            }
        };
        diagnostic.help(format!(
            "add under `[{}]`, with a pin of your choice: `\"{address}\" = {{ pin = \"{}\"{scale} }}`",
            side.table(),
            pin.name
        ))
    }
}

/// Reports every address that an earlier wire has.
pub(crate) fn report_twice<T>(section: &Section<T>, diagnostics: &mut Vec<Diagnostic>) {
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

/// A number at an output.
pub(crate) fn number_at_pin(place: Span, variable: &VariableSymbol) -> Diagnostic {
    let message = format!("the number `{}` cannot leave by a pin", variable.name);
    Diagnostic::new(Rule::NumberAtPin, place, message)
        .label(variable.span, "declared here")
        .help("outputs are Booleans, at `%QX`; analogue outputs are not there yet")
}

/// What is wrong when a scale gives values that the variable cannot have. The scale could never be meant so.
pub(crate) fn bad_scale(entry: &AnalogueInput, variable: &VariableSymbol) -> Option<Diagnostic> {
    let (least, most) = variable.range?;
    let outside = [("low", entry.low), ("high", entry.high)]
        .into_iter()
        .find(|(_, end)| !(least..=most).contains(&end.value));
    let (key, end) = outside?;
    let message = format!(
        "`{key}` is {}, and `{}` lies from {least} to {most}",
        end.value, variable.name
    );
    let (low, high) = sensible_scale(variable);
    Some(
        Diagnostic::new(Rule::BadScale, end.span, message)
            .label(variable.span, "declared here")
            .help(format!(
                "write the values at 0 V and at 3.3 V, `low = {low}, high = {high}` or less, or declare a wider range"
            )),
    )
}

/// A scale to propose: the range that is declared, or what the converter reads when that is the whole word.
fn sensible_scale(variable: &VariableSymbol) -> (i32, i32) {
    match variable.range {
        Some(range) if range != (i16::MIN.into(), i16::MAX.into()) => range,
        _ => RAW_SCALE,
    }
}

fn unknown_address<T>(
    wire: &Wire<T>,
    side: Side,
    open: &[(Address, &VariableSymbol)],
) -> Diagnostic {
    let address = wire.address.value;
    let service = Use::of(side, address.size);
    let message = format!("the program has no {} at `{address}`", service.name());
    let diagnostic = Diagnostic::new(Rule::UnknownAddress, wire.address.span, message);
    let alike = |other: &&(Address, _)| Use::of(side, other.0.size) == service;
    match open.iter().find(alike).or(open.first()) {
        None => diagnostic.help(format!(
            "take the line out, or declare {} there",
            service.with_article()
        )),
        Some((address, variable)) => diagnostic
            .label(
                variable.span,
                format!("this one, at `{address}`, has no pin"),
            )
            .help(format!("did you mean `\"{address}\"`?")),
    }
}
