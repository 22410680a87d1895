//! Graphs that the documents call identical, on random inputs.

use std::collections::BTreeSet;

use grafcet::machine::Bench;
use grafcet::simulation::Simulation;
use grafcet::stimulus::Stimulus;
use grafcet::trace::{self, Columns};
use grafcet_compiler::application::Application;

use crate::directory::application;

const RUNS: u64 = 10;
const RUN_MS: u64 = 60_000;

#[test]
fn a_macro_step_and_its_flat_graph_leave_the_same_trace() {
    let seen = compare(
        "macro_step",
        &["start", "a", "b", "more"],
        &["Graph1", "Graph2"],
    );
    let all = ["1", "E2", "20 22", "20 23", "21 22", "21 23", "S2", "3"];
    assert_eq!(seen, all.map(str::to_owned).into());
}

#[test]
fn a_graph_is_the_same_however_its_links_are_written() {
    let graphs = ["Graph1", "Graph2", "Graph3"];
    let seen = compare(
        "labelled_links",
        &["start", "next", "again", "skip"],
        &graphs,
    );
    assert_eq!(seen, ["1", "2", "3", "4"].map(str::to_owned).into());
}

/// Step 1 of `drill_press` lasts a scan here; a start that ends with it is a difference that the examples' own tests show.
#[test]
fn graph_5_and_its_reduced_form_drill_alike() {
    let (full, reduced) = (
        application("drill_press"),
        application("drill_press_reduced"),
    );
    let mut holes = 0;
    for seed in 1..=RUNS {
        let stimulus = random_inputs(&["start"], 20, seed);
        let (full, reduced) = (run(&full, &stimulus), run(&reduced, &stimulus));
        for output in ["SPIN", "RAISE", "LOWER"] {
            assert_eq!(
                full.column(output),
                reduced.column(output),
                "seed {seed}, {output}"
            );
        }
        holes += full
            .column("LOWER")
            .windows(2)
            .filter(|it| it[0] < it[1])
            .count();
    }
    assert!(holes > 50, "only {holes} holes");
}

/// Asserts that graphs of an example, with outputs of the same names, do the same; gives the situations seen.
fn compare(example: &str, inputs: &[&str], graphs: &[&str]) -> BTreeSet<String> {
    let application = application(example);
    let header: Vec<&str> = Columns::of(&application.controller).header().collect();
    let of_first = format!("{}:", graphs[0]);
    let locals = header
        .iter()
        .filter_map(|name| name.strip_prefix(&of_first));
    let locals: Vec<&str> = locals.collect();
    assert!(!locals.is_empty());
    let mut seen = BTreeSet::new();
    for seed in 1..=RUNS {
        let trace = run(&application, &random_inputs(inputs, 10, seed));
        seen.extend(trace.column(graphs[0]));
        for other in &graphs[1..] {
            assert_eq!(trace.column(graphs[0]), trace.column(other), "seed {seed}");
            for local in &locals {
                let of = |graph: &str| trace.column(&format!("{graph}:{local}"));
                assert_eq!(of(graphs[0]), of(other), "seed {seed}, {local}");
            }
        }
    }
    seen
}

/// A stimulus in which one of the inputs changes every 0 to 500 ms.
fn random_inputs(inputs: &[&str], from_ms: u64, seed: u64) -> String {
    let mut random = Random(seed);
    let mut stimulus = format!("time_ms,{}\n", inputs.join(","));
    let mut values = vec![0; inputs.len()];
    let mut time_ms = from_ms;
    while time_ms < RUN_MS {
        let input = random.below(inputs.len() as u64) as usize;
        values[input] = 1 - values[input];
        let cells: Vec<String> = values.iter().map(u8::to_string).collect();
        stimulus += &format!("{time_ms},{}\n", cells.join(","));
        time_ms += 10 * random.below(50);
    }
    stimulus
}

/// Knuth's linear congruential generator (MMIX): the same numbers everywhere, without a crate.
struct Random(u64);

impl Random {
    fn below(&mut self, end: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % end
    }
}

/// A trace, by columns.
struct Trace {
    header: csv::StringRecord,
    rows: Vec<csv::StringRecord>,
}

impl Trace {
    fn column(&self, name: &str) -> Vec<String> {
        let column = self.header.iter().position(|it| it == name);
        let column = column.unwrap_or_else(|| panic!("no column {name}"));
        self.rows.iter().map(|row| row[column].to_owned()).collect()
    }
}

/// Runs an application with all its plants on a stimulus.
fn run(application: &Application, stimulus: &str) -> Trace {
    let unit = &application.controller;
    let stimulus = Stimulus::read(stimulus.as_bytes(), &unit.symbols).expect("it is well formed");
    let plants: Vec<usize> = (0..application.plants.len()).collect();
    let bench = Bench::new();
    let simulation = Simulation::new(&bench, application, &plants);
    let mut csv = Vec::new();
    trace::write(unit, simulation, &stimulus, RUN_MS, &mut csv).expect("memory takes it all");
    let mut reader = csv::Reader::from_reader(csv.as_slice());
    Trace {
        header: reader.headers().expect("a header").clone(),
        rows: reader.records().map(|row| row.expect("a row")).collect(),
    }
}
