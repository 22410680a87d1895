//! Traces: one row for each scan, in the one form that every runner gives (`semantics.md`, "The trace").

use std::io;

use grafcet_compiler::application::{Unit, VariableSymbol};
use grafcet_compiler::ast::DeclarationKind;
use grafcet_core::program::Slot;

use crate::images::situation;
use crate::player::Player;
use crate::simulation::Simulation;
use crate::stimulus::Stimulus;
use grafcet_core::images::Images;

/// The columns of a program's trace.
#[derive(Clone, Debug)]
pub struct Columns<'a> {
    unit: &'a Unit,
    values: Vec<&'a VariableSymbol>,
}

impl<'a> Columns<'a> {
    /// The columns for a controller: every graph, every output, every variable and parameter.
    #[must_use]
    pub fn of(unit: &'a Unit) -> Self {
        let variables = &unit.symbols.variables;
        let outputs = variables.iter().filter(|v| is_output(v) && !v.bound);
        let inner = variables.iter().filter(|v| is_inner(v));
        Columns {
            unit,
            values: outputs.chain(inner).collect(),
        }
    }

    /// The header.
    pub fn header(&self) -> impl Iterator<Item = &'a str> {
        let graphs = self.unit.symbols.graphs.iter().map(|g| g.name.as_str());
        let values = self.values.iter().map(|v| v.name.as_str());
        ["time_ms"].into_iter().chain(graphs).chain(values)
    }

    /// The row of a scan at `time_ms` that left these images.
    pub fn row(&self, time_ms: u64, images: Images<'_>) -> impl Iterator<Item = String> {
        let graphs = 0..self.unit.symbols.graphs.len();
        let situations = graphs.map(move |graph| situation(self.unit, graph, images));
        let values = self.values.iter().map(move |v| images.value(v.slot));
        [time_ms.to_string()]
            .into_iter()
            .chain(situations)
            .chain(values.map(|value| value.to_string()))
    }

    /// The variables that have a column, in its order.
    pub fn values(&self) -> impl Iterator<Item = (&'a str, Slot)> {
        self.values.iter().map(|v| (v.name.as_str(), v.slot))
    }
}

fn is_output(variable: &VariableSymbol) -> bool {
    variable.kind == DeclarationKind::Output
}

fn is_inner(variable: &VariableSymbol) -> bool {
    match variable.kind {
        DeclarationKind::Variable { .. } => !variable.bound,
        DeclarationKind::Parameter => true,
        DeclarationKind::Input | DeclarationKind::Output | DeclarationKind::Constant => false,
    }
}

/// Writes a trace as CSV, row by row.
pub struct Writer<'a, W: io::Write> {
    columns: Columns<'a>,
    csv: csv::Writer<W>,
}

impl<'a, W: io::Write> Writer<'a, W> {
    /// Begins a trace with its header.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn new(unit: &'a Unit, to: W) -> io::Result<Self> {
        let columns = Columns::of(unit);
        let mut csv = csv::Writer::from_writer(to);
        csv.write_record(columns.header()).map_err(into_io)?;
        Ok(Writer { columns, csv })
    }

    /// Writes the row of a scan.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn scan(&mut self, time_ms: u64, images: Images<'_>) -> io::Result<()> {
        let row = self.columns.row(time_ms, images);
        self.csv.write_record(row).map_err(into_io)
    }

    /// Ends the trace.
    ///
    /// # Errors
    /// When the last of it cannot be written.
    pub fn finish(mut self) -> io::Result<()> {
        self.csv.flush()
    }
}

/// The error that the stream behind the CSV gave, with its kind.
fn into_io(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}

/// Runs a controller on a stimulus and writes its trace: scans at 0, period, 2 x period, ... up to and including
/// `until_ms`.
///
/// # Errors
/// When it cannot be written.
pub fn write(
    unit: &Unit,
    mut simulation: Simulation<'_>,
    stimulus: &Stimulus,
    until_ms: u64,
    to: impl io::Write,
) -> io::Result<()> {
    let mut writer = Writer::new(unit, to)?;
    let mut player = Player::new(unit, stimulus);
    let period_ms = simulation.period_ms().max(1);
    for scan in 0..=until_ms / period_ms {
        player.give(scan * period_ms, &mut simulation);
        simulation.scan();
        writer.scan(simulation.time_ms(), simulation.images())?;
    }
    writer.finish()
}
