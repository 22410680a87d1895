//! Stimuli: what inputs and parameters are given, and when (`semantics.md`, "The trace").

use std::collections::BTreeMap;
use std::{fmt, io};

use grafcet_compiler::application::Symbols;
use grafcet_compiler::ast::{DeclarationKind, Type};
use unicode_normalization::UnicodeNormalization;

use crate::simulation::has_place_of_its_own;

/// A stimulus, read and checked against the names of a program.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Stimulus {
    rows: Vec<Row>,
}

/// What is given from one time on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// From then on, in ms since scan 0.
    pub time_ms: u64,
    /// Indices in [`Symbols::variables`] with the values they take; cells left empty are left out.
    pub values: Vec<(usize, i32)>,
}

/// What is wrong with a stimulus.
#[derive(Debug)]
pub struct StimulusError {
    /// The line of the file, counted from 1.
    pub line: u64,
    /// What is wrong there.
    pub problem: Problem,
}

/// The ways in which a stimulus can be wrong.
#[derive(Debug)]
pub enum Problem {
    /// The file cannot be read, or not as CSV.
    Csv(csv::Error),
    /// A row has more or fewer cells than the header.
    Cells {
        /// Cells of the row.
        found: u64,
        /// Cells of the header.
        expected: u64,
    },
    /// The first column is not `time_ms`.
    NoTime,
    /// Nothing by that name.
    UnknownName {
        /// The name in the header.
        name: String,
        /// The nearest name that would do.
        nearest: Option<String>,
    },
    /// A name that is neither an input nor a parameter, or an input that an instance binds to something else.
    NotGiven {
        /// The name in the header.
        name: String,
        /// What it is.
        is: &'static str,
    },
    /// A name twice in the header.
    Twice(String),
    /// A time that is not a whole number of milliseconds.
    BadTime(String),
    /// A time before the one above it.
    Descending {
        /// The time of the row.
        time_ms: u64,
        /// The time of the row above.
        above_ms: u64,
    },
    /// A cell of a Boolean that is neither 0 nor 1.
    BadBoolean {
        /// The column.
        name: String,
        /// The cell.
        cell: String,
    },
    /// A cell of a number that is not a whole number of 32 bits.
    BadNumber {
        /// The column.
        name: String,
        /// The cell.
        cell: String,
    },
}

impl Stimulus {
    /// Reads a stimulus in CSV for a program with these names.
    ///
    /// # Errors
    /// The first thing that is wrong, with its line.
    pub fn read(reader: impl io::Read, symbols: &Symbols) -> Result<Stimulus, StimulusError> {
        let mut csv = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .from_reader(reader);
        let columns = columns(csv.headers()?, symbols)?;
        let mut rows: Vec<Row> = Vec::new();
        for record in csv.into_records() {
            let record = record?;
            let line = record.position().map_or(1, csv::Position::line);
            let row = row(&record, &columns, symbols).map_err(|problem| problem.at(line))?;
            if let Some(above) = rows.last().filter(|above| above.time_ms > row.time_ms) {
                return Err(Problem::Descending {
                    time_ms: row.time_ms,
                    above_ms: above.time_ms,
                }
                .at(line));
            }
            rows.push(row);
        }
        Ok(Stimulus { rows })
    }

    /// The rows, times ascending.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// The time of the last row in ms; 0 without rows.
    #[must_use]
    pub fn end_ms(&self) -> u64 {
        self.rows.last().map_or(0, |row| row.time_ms)
    }
}

/// The variable of each column behind `time_ms`.
fn columns(header: &csv::StringRecord, symbols: &Symbols) -> Result<Vec<usize>, StimulusError> {
    let line = header.position().map_or(1, csv::Position::line);
    let mut names = header.iter();
    if names.next() != Some("time_ms") {
        return Err(Problem::NoTime.at(line));
    }
    let known: BTreeMap<&str, usize> = symbols
        .variables
        .iter()
        .enumerate()
        .map(|(index, variable)| (variable.name.as_str(), index))
        .collect();
    let mut columns = Vec::new();
    for name in names {
        let name: String = name.nfc().collect();
        let column =
            given(&name, known.get(name.as_str()).copied(), symbols).map_err(|p| p.at(line))?;
        if columns.contains(&column) {
            return Err(Problem::Twice(name).at(line));
        }
        columns.push(column);
    }
    Ok(columns)
}

/// The variable by that name, if a stimulus may give it.
fn given(name: &str, index: Option<usize>, symbols: &Symbols) -> Result<usize, Problem> {
    let refuse = |is| {
        Err(Problem::NotGiven {
            name: name.to_owned(),
            is,
        })
    };
    let Some((index, variable)) = index.and_then(|i| Some((i, symbols.variables.get(i)?))) else {
        return Err(Problem::UnknownName {
            name: name.to_owned(),
            nearest: nearest(name, symbols),
        });
    };
    match variable.kind {
        DeclarationKind::Parameter => Ok(index),
        DeclarationKind::Input if !has_place_of_its_own(variable) => {
            refuse("an input bound by its instance")
        }
        DeclarationKind::Input => Ok(index),
        DeclarationKind::Output => refuse("an output"),
        DeclarationKind::Variable { .. } => refuse("a variable"),
        DeclarationKind::Constant => refuse("a constant"),
    }
}

/// The input or parameter whose name is most like this one, if any is like it at all.
fn nearest(name: &str, symbols: &Symbols) -> Option<String> {
    symbols
        .variables
        .iter()
        .enumerate()
        .filter(|(index, variable)| given(&variable.name, Some(*index), symbols).is_ok())
        .map(|(_, variable)| {
            // Who writes `start` may mean `Drill:start`.
            let local = variable.name.rsplit(':').next().unwrap_or_default();
            let distance = strsim::damerau_levenshtein(name, &variable.name);
            (
                distance.min(strsim::damerau_levenshtein(name, local)),
                variable,
            )
        })
        .filter(|(distance, _)| *distance <= 1 + name.chars().count() / 3)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, variable)| variable.name.clone())
}

fn row(record: &csv::StringRecord, columns: &[usize], symbols: &Symbols) -> Result<Row, Problem> {
    let mut cells = record.iter();
    let time = cells.next().unwrap_or_default();
    let time_ms = time
        .parse()
        .map_err(|_| Problem::BadTime(time.to_owned()))?;
    let mut values = Vec::new();
    for (&column, cell) in columns.iter().zip(cells) {
        if let (false, Some(variable)) = (cell.is_empty(), symbols.variables.get(column)) {
            values.push((column, value(cell, &variable.name, variable.ty)?));
        }
    }
    Ok(Row { time_ms, values })
}

fn value(cell: &str, name: &str, ty: Type) -> Result<i32, Problem> {
    let name = name.to_owned();
    match (ty, cell) {
        (Type::Bool, "0") => Ok(0),
        (Type::Bool, "1") => Ok(1),
        (Type::Bool, _) => Err(Problem::BadBoolean {
            name,
            cell: cell.to_owned(),
        }),
        (Type::Int | Type::Time, _) => cell.parse().map_err(|_| Problem::BadNumber {
            name,
            cell: cell.to_owned(),
        }),
    }
}

impl Problem {
    fn at(self, line: u64) -> StimulusError {
        StimulusError {
            line,
            problem: self,
        }
    }
}

impl From<csv::Error> for StimulusError {
    fn from(error: csv::Error) -> Self {
        let line = error.position().map_or(1, csv::Position::line);
        match *error.kind() {
            csv::ErrorKind::UnequalLengths {
                expected_len, len, ..
            } => Problem::Cells {
                found: len,
                expected: expected_len,
            }
            .at(line),
            _ => Problem::Csv(error).at(line),
        }
    }
}

impl std::error::Error for StimulusError {}

impl fmt::Display for StimulusError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.problem.fmt(f)
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Problem::Csv(error) => match error.kind() {
                csv::ErrorKind::Utf8 { .. } => f.write_str("the text is not UTF-8"),
                csv::ErrorKind::Io(error) => error.fmt(f),
                _ => error.fmt(f),
            },
            Problem::Cells { found, expected } => {
                write!(f, "a row of {found} cells under a header of {expected}")
            }
            Problem::NoTime => f.write_str("the first column has to be `time_ms`"),
            Problem::UnknownName { name, nearest } => {
                write!(f, "no input or parameter is called `{name}`")?;
                match nearest {
                    Some(nearest) => write!(f, "; is `{nearest}` meant?"),
                    None => Ok(()),
                }
            }
            Problem::NotGiven { name, is } => write!(
                f,
                "`{name}` is {is}; a stimulus gives inputs and parameters"
            ),
            Problem::Twice(name) => write!(f, "the column `{name}` stands twice in the header"),
            Problem::BadTime(cell) => {
                write!(f, "`{cell}` is no time: whole milliseconds from 0 on")
            }
            Problem::Descending { time_ms, above_ms } => write!(
                f,
                "times have to ascend: {time_ms} ms stands below {above_ms} ms"
            ),
            Problem::BadBoolean { name, cell } => {
                write!(f, "`{cell}` is no value for the Boolean `{name}`: 0 or 1")
            }
            Problem::BadNumber { name, cell } => write!(
                f,
                "`{cell}` is no value for the number `{name}`: a whole number of 32 bits"
            ),
        }
    }
}
