//! Compiles a text and runs it on a stimulus.

use grafcet::machine::Bench;
use grafcet::simulation::Simulation;
use grafcet::stimulus::Stimulus;
use grafcet::trace;
use grafcet_compiler::Target;
use grafcet_compiler::application::Application;
use grafcet_compiler::render::{Style, render};

/// A trace, by columns.
pub struct Trace {
    header: csv::StringRecord,
    rows: Vec<csv::StringRecord>,
}

impl Trace {
    /// The names of the columns, separated by commas.
    pub fn header(&self) -> String {
        let names: Vec<&str> = self.header.iter().collect();
        names.join(",")
    }

    /// The cells of a column, separated by commas: what one thing was in scan 0, 1, 2, ...
    pub fn column(&self, name: &str) -> String {
        let column = self.header.iter().position(|column| column == name);
        let column = column.unwrap_or_else(|| panic!("no column {name} in {:?}", self.header));
        let cells: Vec<&str> = self.rows.iter().map(|row| &row[column]).collect();
        cells.join(",")
    }
}

/// Compiles a text that has to be accepted.
pub fn application(text: &str) -> Application {
    let compilation = grafcet_compiler::compile(
        "test.grafcet",
        text,
        &|path| Err(std::io::Error::other(format!("no import of {path} here"))),
        Target::Host,
    );
    let said = render(
        &compilation.diagnostics,
        &compilation.sources,
        Style::default(),
    );
    compilation
        .application
        .unwrap_or_else(|| panic!("refused:\n{said}"))
}

/// Runs a program with these inputs: for each name its values in scan 0, 1, 2, ..., at a period of 10 ms. It runs
/// until the last of them.
pub fn run(text: &str, inputs: &[(&str, &str)]) -> Trace {
    let values: Vec<Vec<&str>> = inputs
        .iter()
        .map(|(_, values)| values.split_whitespace().collect())
        .collect();
    let names: Vec<&str> = inputs.iter().map(|(name, _)| *name).collect();
    let mut stimulus = format!("time_ms,{}\n", names.join(","));
    for scan in 0..values.iter().map(Vec::len).max().unwrap_or(0) {
        let cells = values.iter().map(|v| v.get(scan).copied().unwrap_or(""));
        let cells: Vec<&str> = cells.collect();
        stimulus.push_str(&format!("{},{}\n", scan * 10, cells.join(",")));
    }
    run_csv(text, &stimulus, &[], None)
}

/// Runs a program without inputs for so many scans, scan 0 included.
pub fn run_scans(text: &str, scans: u64) -> Trace {
    run_with(text, &[], scans)
}

/// Runs a program with these plants for so many scans of 10 ms, scan 0 included.
pub fn run_with(text: &str, plants: &[&str], scans: u64) -> Trace {
    run_csv(text, "time_ms\n", plants, Some((scans - 1) * 10))
}

/// Runs a program on a stimulus, as `grafcet trace` does.
pub fn run_csv(text: &str, stimulus: &str, plants: &[&str], until_ms: Option<u64>) -> Trace {
    let application = application(text);
    let unit = &application.controller;
    let plants: Vec<usize> = plants
        .iter()
        .map(|name| {
            let found = application.plants.iter().position(|p| p.name == *name);
            found.unwrap_or_else(|| panic!("no plant {name}"))
        })
        .collect();
    let stimulus = Stimulus::read(stimulus.as_bytes(), &unit.symbols)
        .unwrap_or_else(|error| panic!("line {}: {error}", error.line));
    let bench = Bench::new();
    let simulation = Simulation::new(&bench, &application, &plants);
    let until_ms = until_ms.unwrap_or(stimulus.end_ms());
    let mut csv = Vec::new();
    trace::write(unit, simulation, &stimulus, until_ms, &mut csv).expect("memory takes it all");
    let mut reader = csv::Reader::from_reader(csv.as_slice());
    Trace {
        header: reader.headers().expect("a header").clone(),
        rows: reader.records().map(|row| row.expect("a row")).collect(),
    }
}
