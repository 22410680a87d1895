//! The programs that are run for long.

use std::fmt;

use grafcet_compiler::application::{Application, Place};
use grafcet_compiler::ast::File;
use grafcet_compiler::render::{Style, render};
use grafcet_compiler::source::FileId;
use grafcet_compiler::{Target, compile, parse};

/// One of the programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// The transmission-line switcher of `graphs/line_switcher.grafcet`.
    LineSwitcher,
    /// The station with two drills of the examples.
    DrillingStation,
}

/// Something that happens to the machine now and then, and passes.
#[derive(Clone, Copy, Debug)]
pub struct Habit {
    /// An input of the controller, or a variable of the plant.
    pub what: &'static str,
    /// Who has a say in it otherwise.
    pub kind: Kind,
    /// Its value most of the time; the other one while it lasts.
    pub usual: bool,
    /// Mean time from its end to its beginning, in s.
    pub every_s: u64,
    /// How long it lasts: the shortest and the longest time, in ms.
    pub lasts_ms: (u64, u64),
}

/// Who has a say in a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Nobody else: a button, a switch, a defect of the machine.
    Given,
    /// The plant, whose signal is lost for a while, and reads as False: a broken wire.
    Feedback,
}

/// How long a step can stay active in whatever happens, since a timer ends it: known from the program's text, found by
/// neither interpreter.
#[derive(Clone, Copy, Debug)]
pub struct Limit {
    /// The step.
    pub step: &'static str,
    /// Its longest time, in ms, which some runs reach.
    pub longest_ms: u64,
}

/// A program that does not compile.
#[derive(Debug)]
pub struct Refused(String);

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Refused {}

impl Subject {
    /// Both.
    pub const ALL: [Subject; 2] = [Subject::LineSwitcher, Subject::DrillingStation];

    /// Its name, which is that of its file.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Subject::LineSwitcher => "line_switcher",
            Subject::DrillingStation => "drilling_station",
        }
    }

    fn text(self) -> &'static str {
        match self {
            Subject::LineSwitcher => include_str!("../../graphs/line_switcher.grafcet"),
            Subject::DrillingStation => {
                include_str!("../../graphs/examples/drilling_station/drilling_station.grafcet")
            }
        }
    }

    /// Its tables, with those of its plant.
    ///
    /// # Errors
    /// What the compiler says of it.
    pub fn application(self) -> Result<Application, Refused> {
        let none = |_: &str| Err(std::io::ErrorKind::NotFound.into());
        let compilation = compile(self.name(), self.text(), &none, Target::Host);
        let said = || {
            render(
                &compilation.diagnostics,
                &compilation.sources,
                Style::default(),
            )
        };
        compilation.application.ok_or_else(|| Refused(said()))
    }

    /// Its syntax tree, for the reference.
    #[must_use]
    pub fn tree(self) -> File {
        parse(FileId(0), self.text(), &mut Vec::new())
    }

    /// What happens to its machine.
    #[must_use]
    pub fn habits(self) -> &'static [Habit] {
        match self {
            Subject::LineSwitcher => &LINE_SWITCHER,
            Subject::DrillingStation => &DRILLING_STATION,
        }
    }

    /// The numbers of transitions that fire only after a power cut, which a long run is without.
    #[must_use]
    pub fn only_after_power_cuts(self) -> &'static [u32] {
        match self {
            Subject::LineSwitcher => &[24],
            Subject::DrillingStation => &[],
        }
    }

    /// Its steps that a timer ends. What a plant does is no part of this.
    #[must_use]
    pub fn limits(self) -> &'static [Limit] {
        match self {
            Subject::LineSwitcher => &SWITCHER_LIMITS,
            Subject::DrillingStation => &STATION_LIMITS,
        }
    }
}

/// Where a name of a habit lies: an input of the controller, or a variable of its plant.
#[must_use]
pub fn place(application: &Application, name: &str) -> Option<Place> {
    let inputs = &application.controller.symbols.variables;
    if let Some(input) = inputs.iter().find(|variable| variable.name == name) {
        return Some(Place::Controller(input.slot));
    }
    let plant = application.plants.first()?;
    let variables = &plant.unit.symbols.variables;
    let named = |full: &str| full.rsplit(':').next() == Some(name);
    let variable = variables.iter().find(|variable| named(&variable.name))?;
    Some(Place::Plant(0, variable.slot))
}

const fn given(
    what: &'static str,
    usual: bool,
    every_s: u64,
    shortest_ms: u64,
    longest_ms: u64,
) -> Habit {
    Habit {
        what,
        kind: Kind::Given,
        usual,
        every_s,
        lasts_ms: (shortest_ms, longest_ms),
    }
}

const fn feedback(what: &'static str, every_s: u64, shortest_ms: u64, longest_ms: u64) -> Habit {
    Habit {
        kind: Kind::Feedback,
        ..given(what, true, every_s, shortest_ms, longest_ms)
    }
}

static LINE_SWITCHER: [Habit; 15] = [
    given("Onduty", true, 40, 200, 8_000),
    given("Unlock", false, 6, 100, 600),
    given("line1", true, 12, 300, 8_000),
    given("line2", true, 6, 300, 8_000),
    given("transformer2", true, 60, 300, 5_000),
    given("transformer3", true, 60, 300, 5_000),
    given("bus_fault", false, 15, 300, 8_000),
    given("protection_fails", false, 40, 1_000, 40_000),
    given("breaker1_wont_open", false, 40, 1_000, 20_000),
    given("breaker1_wont_close", false, 40, 1_000, 20_000),
    given("breaker2_wont_open", false, 40, 1_000, 20_000),
    given("breaker2_wont_close", false, 40, 1_000, 20_000),
    given("to_line2_by_hand", false, 15, 100, 400),
    feedback("Breaker_1", 200, 20, 5_000),
    feedback("VT3", 200, 20, 5_000),
];

static DRILLING_STATION: [Habit; 9] = [
    given("start", false, 2, 100, 700),
    given("stop", false, 100, 100, 1_500),
    given("jammed1", false, 30, 500, 25_000),
    given("jammed2", false, 30, 500, 25_000),
    feedback("down1", 60, 1_000, 20_000),
    feedback("up2", 40, 1_000, 25_000),
    feedback("up1", 40, 1_000, 25_000),
    feedback("down2", 100, 20, 20_000),
    feedback("closed", 150, 20, 3_000),
];

const fn limit(step: &'static str, longest_ms: u64) -> Limit {
    Limit { step, longest_ms }
}

/// TD is 2 s, TA 1 s, TF 3 s. In each of these steps some transition is True whatever the inputs are, once the time is
/// over. A fault in which the breaker opens only behind TA has long been found to be one, so nothing lasts TF when the
/// breaker has not opened.
static SWITCHER_LIMITS: [Limit; 8] = [
    limit("3", 2_000),
    limit("4", 2_000),
    limit("5", 1_000),
    limit("6", 1_000),
    limit("7", 1_000),
    limit("8", 1_000),
    limit("9", 3_000),
    limit("10", 3_000),
];

/// A motor spins up for 2 s, a drill moves for 15 s at most.
static STATION_LIMITS: [Limit; 6] = [
    limit("3", 2_000),
    limit("4", 15_000),
    limit("5", 15_000),
    limit("13", 2_000),
    limit("14", 15_000),
    limit("15", 15_000),
];
