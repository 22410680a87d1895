//! The machine for a controller that runs somewhere else, as on an emulated board: lines of text, one for each scan.
//!
//! The server begins. It says what hangs on the controller, then `ready`:
//!
//! ```text
//! period 10
//! memory 6 5
//! input GP2 high Onduty
//! analogue GP26 level
//! output GP16 high BL10
//! ready
//! ```
//!
//! Then it answers lines until its input ends. `power LEVELS` asks for the inputs before a scan 0;
//! `scan LEVELS IMAGE NUMBERS` for those after a scan. LEVELS are the levels at the output pins in the order above, as
//! `0` and `1`, `-` when there are none. IMAGE and NUMBERS are what the engine's memory begins with: so many words of
//! the image, in hexadecimal, and so many numbers, in decimal, as `memory` says; each separated by commas.
//!
//! The answer is any number of lines `say TEXT` and perhaps a line `moved TEXT`, for people: what the script says, and
//! which numbers have moved. Then comes one of
//!
//! - `inputs LEVELS READINGS`: put these on the input pins and run one scan. READINGS are what the converter is to read
//!   at the analogue inputs, from 0 to 4095 and separated by commas, `-` when there are none;
//! - `power-cycle`: take the power away and give it back, then ask with `power`;
//! - `end held`, or `end failed TEXT`: the script is over.

use std::fmt;
use std::io::{self, BufRead, Write};

use grafcet_core::images::Images;
use grafcet_core::program::Layout;

use super::machine::Machine;
use super::script::{Next, Outcome};
use crate::wiring::{InputWire, Label, OutputWire};

/// The terminals that a server tells of.
#[derive(Clone, Copy, Debug)]
pub struct Terminals {
    /// Scan period in ms.
    pub period_ms: u32,
    /// Where the images lie.
    pub layout: &'static Layout,
    /// The Boolean inputs.
    pub inputs: &'static [InputWire],
    /// What they are called.
    pub input_labels: &'static [Label],
    /// What the numeric inputs are called.
    pub analogue_labels: &'static [Label],
    /// The outputs.
    pub outputs: &'static [OutputWire],
    /// What they are called.
    pub output_labels: &'static [Label],
}

/// Why a server stops.
#[derive(Debug)]
pub enum Error {
    /// A line that is no request.
    Request(String),
    /// The line to the client.
    Line(io::Error),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Request(line) => write!(f, "not a request: `{line}`"),
            Error::Line(error) => write!(f, "the client cannot be reached: {error}"),
        }
    }
}

impl std::error::Error for Error {}

impl From<io::Error> for Error {
    fn from(error: io::Error) -> Self {
        Error::Line(error)
    }
}

/// Answers requests until there are none any more.
///
/// # Errors
/// When a request cannot be read, or the client is gone.
pub fn serve(
    machine: &mut Machine,
    terminals: &Terminals,
    requests: impl BufRead,
    mut answers: impl Write,
) -> Result<(), Error> {
    greet(terminals, &mut answers)?;
    for line in requests.lines() {
        let line = line?;
        let request = Request::read(&line).ok_or_else(|| Error::Request(line.clone()))?;
        let outputs: Vec<bool> = request
            .levels
            .iter()
            .zip(terminals.outputs)
            .map(|(level, wire)| *level != wire.active_low)
            .collect();
        let view = request
            .images
            .as_ref()
            .map(|(image, numbers)| Images { image, numbers });
        let next = machine.step(&outputs, view.as_ref());
        for text in machine.take_said() {
            writeln!(answers, "say {text}")?;
        }
        match next {
            Next::Scan => {
                if let Some(moved) = machine.take_moved() {
                    writeln!(answers, "moved {moved}")?;
                }
                let levels = machine.inputs().zip(terminals.inputs);
                let levels = levels.map(|(value, wire)| value != wire.active_low);
                let levels: String = levels.map(|level| if level { '1' } else { '0' }).collect();
                let readings: Vec<String> = machine.readings().map(|it| it.to_string()).collect();
                let (levels, readings) = (or_dash(levels), or_dash(readings.join(",")));
                writeln!(answers, "inputs {levels} {readings}")?;
            }
            Next::PowerCycle => writeln!(answers, "power-cycle")?,
            Next::End(Outcome::Held) => writeln!(answers, "end held")?,
            Next::End(Outcome::Failed(text)) => writeln!(answers, "end failed {text}")?,
        }
        answers.flush()?;
    }
    Ok(())
}

fn greet(terminals: &Terminals, answers: &mut impl Write) -> io::Result<()> {
    let active = |low| if low { "low" } else { "high" };
    let Layout { words, numbers, .. } = terminals.layout;
    writeln!(answers, "period {}", terminals.period_ms)?;
    writeln!(answers, "memory {words} {numbers}")?;
    for (wire, label) in terminals.inputs.iter().zip(terminals.input_labels) {
        writeln!(
            answers,
            "input {} {} {}",
            label.pin,
            active(wire.active_low),
            label.name
        )?;
    }
    for label in terminals.analogue_labels {
        writeln!(answers, "analogue {} {}", label.pin, label.name)?;
    }
    for (wire, label) in terminals.outputs.iter().zip(terminals.output_labels) {
        writeln!(
            answers,
            "output {} {} {}",
            label.pin,
            active(wire.active_low),
            label.name
        )?;
    }
    writeln!(answers, "ready")?;
    answers.flush()
}

/// A request.
struct Request {
    levels: Vec<bool>,
    /// Image and numbers; none before scan 0.
    images: Option<(Vec<u32>, Vec<i32>)>,
}

impl Request {
    fn read(line: &str) -> Option<Request> {
        let mut words = line.split_whitespace();
        let kind = words.next()?;
        let levels = read_levels(words.next()?)?;
        let images = match kind {
            "power" => None,
            "scan" => {
                let image = words
                    .next()?
                    .split(',')
                    .map(|word| u32::from_str_radix(word, 16).ok());
                let image = image.collect::<Option<Vec<u32>>>()?;
                let numbers = words.next()?.split(',').map(|number| number.parse().ok());
                Some((image, numbers.collect::<Option<Vec<i32>>>()?))
            }
            _ => return None,
        };
        words.next().is_none().then_some(Request { levels, images })
    }
}

fn read_levels(text: &str) -> Option<Vec<bool>> {
    let level = |digit| match digit {
        '0' => Some(false),
        '1' => Some(true),
        _ => None,
    };
    match text {
        "-" => Some(Vec::new()),
        _ => text.chars().map(level).collect(),
    }
}

/// What is nothing is written as a dash.
fn or_dash(text: String) -> String {
    if text.is_empty() {
        "-".to_owned()
    } else {
        text
    }
}
