//! The pins of a file on its board: known, free, and used once.

use std::collections::BTreeMap;

use grafcet_compiler::source::Span;

use crate::board::{Board, Pin, Purpose};
use crate::file::Section;
use crate::nearest::nearest;
use crate::rule::{Diagnostic, Rule};
use crate::side::{Side, Use};
use crate::table::Placed;

/// The pins that are taken so far.
pub(crate) struct Pins {
    board: Option<&'static Board>,
    taken: BTreeMap<&'static str, Span>,
}

impl Pins {
    pub(crate) fn new(board: Option<&'static Board>) -> Self {
        Pins {
            board,
            taken: BTreeMap::new(),
        }
    }

    /// The pin of each wire, where it has one that it can have.
    pub(crate) fn resolve<T>(
        &mut self,
        section: &Section<T>,
        side: Side,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Vec<Option<&'static Pin>> {
        let pins = section.wires.iter().map(|wire| {
            let name = wire.pin.as_ref()?;
            match self.take(name, Use::of(side, wire.address.value.size))? {
                Ok(pin) => Some(pin),
                Err(diagnostic) => {
                    diagnostics.push(diagnostic);
                    None
                }
            }
        });
        pins.collect()
    }

    /// The pins that are left to serve as this, in the order of the board.
    pub(crate) fn free(&self, service: Use) -> impl Iterator<Item = &'static Pin> {
        let pins = self.board.map_or(&[][..], |board| board.pins).iter();
        pins.filter(move |pin| refusal(pin, service).is_none())
            // What is measured there is not for the program to choose.
            .filter(|pin| !matches!(pin.purpose, Purpose::AnalogueInput(_)))
            .filter(|pin| !self.taken.contains_key(pin.name))
    }

    /// Proposes a free pin, another one each time.
    pub(crate) fn propose(&mut self, service: Use, place: Span) -> Option<&'static Pin> {
        let pin = self.free(service).next()?;
        self.taken.insert(pin.name, place);
        Some(pin)
    }

    /// Without a board, which has been reported, there are no pins to be right or wrong.
    fn take(
        &mut self,
        name: &Placed<String>,
        service: Use,
    ) -> Option<Result<&'static Pin, Diagnostic>> {
        let board = self.board?;
        let Some(pin) = board.pin(&name.value) else {
            return Some(Err(unknown(board, name)));
        };
        if let Some(reason) = refusal(pin, service) {
            let message = format!(
                "`{}` cannot be {}: {reason}",
                pin.name,
                service.with_article()
            );
            let diagnostic = Diagnostic::new(Rule::ReservedPin, name.span, message);
            return Some(Err(match self.free(service).next() {
                Some(free) => diagnostic.help(format!("`{}` is free", free.name)),
                None => diagnostic,
            }));
        }
        if let Some(first) = self.taken.get(pin.name) {
            let message = format!("`{}` is used twice", pin.name);
            let diagnostic = Diagnostic::new(Rule::PinUsedTwice, name.span, message);
            return Some(Err(diagnostic.label(*first, "first here")));
        }
        self.taken.insert(pin.name, name.span);
        Some(Ok(pin))
    }
}

/// Why the pin cannot serve as this.
fn refusal(pin: &Pin, service: Use) -> Option<&'static str> {
    match (pin.purpose, service) {
        (_, Use::AnalogueInput) if !pin.analogue => {
            Some("the analogue-to-digital converter does not reach it")
        }
        (Purpose::Free, _)
        | (Purpose::Output(_), Use::Output | Use::AnalogueOutput)
        | (Purpose::AnalogueInput(_), Use::AnalogueInput) => None,
        (
            Purpose::Output(reason) | Purpose::AnalogueInput(reason) | Purpose::Reserved(reason),
            _,
        ) => Some(reason),
    }
}

/// `gp2`, `GPIO2`, `PIN_2` and `2` mean `GP2`; other words mean what they resemble.
fn unknown(board: &Board, name: &Placed<String>) -> Diagnostic {
    let message = format!("the {} has no pin `{}`", board.title, name.value);
    let diagnostic = Diagnostic::new(Rule::UnknownPin, name.span, message);
    let digits = name.value.trim_start_matches(|c: char| !c.is_ascii_digit());
    let names = || board.pins.iter().map(|pin| pin.name);
    let same_number = names().find(|known| {
        known.trim_start_matches(|c: char| !c.is_ascii_digit()) == digits && !digits.is_empty()
    });
    match same_number.or_else(|| nearest(&name.value, names())) {
        Some(meant) => diagnostic.help(format!("did you mean `\"{meant}\"`?")),
        None => diagnostic.help("pins are named as on the board: `\"GP0\"` to `\"GP28\"`"),
    }
}
