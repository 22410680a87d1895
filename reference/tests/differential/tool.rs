//! The same through the tool: stimulus and trace as CSV.

use grafcet::machine::Bench;
use grafcet::simulation::Simulation;
use grafcet::stimulus::Stimulus;
use grafcet::trace;
use grafcet_compiler::application::Application;

use crate::outcome::Failure;
use crate::stimulus::Scan;

/// The stimulus as CSV; none when something happens to the program that a file cannot say.
pub fn csv(stimulus: &[Scan], period_ms: u64) -> Option<String> {
    let plain =
        |scan: &Scan| scan.power_cycle.is_none() && scan.overruns.is_none() && scan.periods == 1;
    if !stimulus.iter().all(plain) {
        return None;
    }
    let mut names: Vec<&str> = Vec::new();
    for (name, _) in stimulus.iter().flat_map(|scan| &scan.given) {
        if !names.contains(&name.as_str()) {
            names.push(name);
        }
    }
    let mut csv = format!(
        "time_ms{}\n",
        names
            .iter()
            .map(|name| format!(",{name}"))
            .collect::<String>()
    );
    for (scan, time_ms) in stimulus.iter().zip((0..).step_by(period_ms as usize)) {
        let cell = |name: &&str| {
            let given = scan.given.iter().find(|(given, _)| given == name);
            given.map_or(",".to_owned(), |(_, value)| format!(",{value}"))
        };
        csv += &format!("{time_ms}{}\n", names.iter().map(cell).collect::<String>());
    }
    Some(csv)
}

/// Runs the controller on a stimulus in CSV and compares its trace with these rows, the header first.
pub fn compare(application: &Application, csv: &str, rows: &[Vec<String>]) -> Result<(), Failure> {
    let unit = &application.controller;
    let unreadable = |error: String| Failure::Tool(format!("{error}\n{csv}"));
    let stimulus = Stimulus::read(csv.as_bytes(), &unit.symbols);
    let stimulus = stimulus.map_err(|error| unreadable(error.problem.to_string()))?;
    let bench = Bench::new();
    let simulation = Simulation::new(&bench, application, &[]);
    let mut written = Vec::new();
    trace::write(unit, simulation, &stimulus, stimulus.end_ms(), &mut written)
        .map_err(|error| unreadable(error.to_string()))?;
    let written = String::from_utf8_lossy(&written);
    let expected = rows.iter().map(|row| row.join(","));
    for (number, (written, expected)) in written.lines().zip(expected).enumerate() {
        if written != expected {
            return Err(Failure::Tool(format!(
                "line {number}\n{written}\n{expected}\n{csv}"
            )));
        }
    }
    if written.lines().count() == rows.len() {
        Ok(())
    } else {
        Err(Failure::Tool(format!("{} lines", written.lines().count())))
    }
}
