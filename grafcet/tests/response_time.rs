//! The response time of `graphs/examples/response_time`, measured from its traces: an input that changes at each ms
//! between two scans. *Grafcet Step-by-Step*, ch. 9 claims almost one scan at best and almost two at worst.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

use std::path::Path;

use grafcet::machine::Bench;
use grafcet::simulation::Simulation;
use grafcet::stimulus::Stimulus;
use grafcet::trace;
use grafcet_compiler::Target;
use grafcet_compiler::application::Application;

/// The scan period of the example.
const SCAN_MS: u64 = 100;

/// A scan far enough from the first.
const SAMPLE_MS: u64 = 1000;

#[test]
fn the_response_takes_from_one_scan_to_almost_two() {
    let application = application();
    let of = |offset: u64| {
        let change = SAMPLE_MS + offset;
        let stimulus = format!("time_ms,a\n0,0\n{change},1\n");
        let lit = lit(&application, &stimulus);
        // As in the book: the outputs of a scan are written at its end.
        lit.first().expect("it answers") + SCAN_MS - change
    };
    let responses: Vec<u64> = (0..SCAN_MS).map(of).collect();
    // A change just before the sample, or with it.
    assert_eq!(responses.iter().min(), Some(&SCAN_MS));
    assert_eq!(responses[0], SCAN_MS);
    // A change just behind the sample.
    assert_eq!(responses.iter().max(), Some(&(2 * SCAN_MS - 1)));
    assert_eq!(responses[1], 2 * SCAN_MS - 1);
}

#[test]
fn a_pulse_as_long_as_a_scan_is_seen_once_wherever_it_falls() {
    let application = application();
    for offset in 0..SCAN_MS {
        let lit = lit(&application, &pulse(SAMPLE_MS + offset, SCAN_MS));
        assert_eq!(lit.len(), 1, "{offset} ms behind a sample");
    }
}

#[test]
fn a_shorter_pulse_is_missed_when_it_falls_between_two_samples() {
    let application = application();
    let missed = |offset: u64| {
        let stimulus = pulse(SAMPLE_MS + offset, SCAN_MS - 1);
        lit(&application, &stimulus).is_empty()
    };
    let missed: Vec<u64> = (0..SCAN_MS).filter(|offset| missed(*offset)).collect();
    assert_eq!(missed, [1]);
}

fn pulse(from_ms: u64, length_ms: u64) -> String {
    let to_ms = from_ms + length_ms;
    format!("time_ms,a\n0,0\n{from_ms},1\n{to_ms},0\n")
}

fn application() -> Application {
    let path = "../graphs/examples/response_time/response_time.grafcet";
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    let compiled = grafcet::source::compile(&path, Target::Host).expect("it can be read");
    let application = compiled.application.expect("it is accepted");
    assert_eq!(u64::from(application.controller.tables.period_ms), SCAN_MS);
    application
}

/// The times of the scans that leave OUT on.
fn lit(application: &Application, stimulus: &str) -> Vec<u64> {
    let unit = &application.controller;
    let stimulus = Stimulus::read(stimulus.as_bytes(), &unit.symbols).expect("it is well formed");
    let bench = Bench::new();
    let simulation = Simulation::new(&bench, application, &[]);
    let mut csv = Vec::new();
    let until = SAMPLE_MS + 4 * SCAN_MS;
    trace::write(unit, simulation, &stimulus, until, &mut csv).expect("memory takes it all");
    let mut reader = csv::Reader::from_reader(csv.as_slice());
    let header = reader.headers().expect("a header").clone();
    let out = header.iter().position(|name| name == "OUT");
    let out = out.expect("a column for the output");
    let rows = reader.records().map(|row| row.expect("a row"));
    rows.filter(|row| &row[out] == "1")
        .map(|row| row[0].parse().expect("a time"))
        .collect()
}
