//! The engine against a second interpreter of `semantics.md`: random programs and stimuli give equal traces.
//!
//! `GRAFCET_PROGRAMS=100000 cargo test -p grafcet --test reference` compares more of them. A failure is shrunk; the
//! program and the stimulus that are left are printed, and their seed is kept for the next run.

#![allow(clippy::expect_used, reason = "a test whose scene cannot be set fails")]

mod expression;
mod fit;
mod generate;
mod hierarchy;
mod machine;
mod program;

use std::cell::Cell;
use std::fmt::Write as _;

use grafcet::machine::Bench;
use grafcet::simulation::Simulation;
use grafcet::stimulus::Stimulus;
use grafcet::trace;
use grafcet_compiler::Target;
use grafcet_compiler::render::{Style, render};
use proptest::test_runner::{Config, TestCaseError, TestError, TestRunner};

use generate::Given;
use machine::{Machine, T};
use program::{GIVEN, Program};

const PERIOD_MS: T = 1000;

#[test]
fn engine_and_reference_give_equal_traces() {
    let cases = std::env::var("GRAFCET_PROGRAMS").ok();
    let cases = cases.and_then(|cases| cases.parse().ok()).unwrap_or(2000);
    let mut runner = TestRunner::new(Config {
        cases,
        ..Config::with_source_file(file!())
    });
    let inputs = (generate::program(), generate::stimulus());
    // Transitions in all, and those that fired.
    let fired = Cell::new([0, 0]);
    let verdict = runner.run(&inputs, |(program, stimulus)| {
        let text = program.to_string();
        let csv = csv(&stimulus);
        let engine = by_engine(&text, &csv).map_err(TestCaseError::fail)?;
        let reference = by_reference(&program, &stimulus, &fired);
        if engine == reference {
            return Ok(());
        }
        let story = differences(&engine, &reference);
        Err(TestCaseError::fail(format!("{text}\n{csv}\n{story}")))
    });
    match verdict {
        Ok(()) => {
            let [all, some] = fired.get();
            println!("{some} of {all} transitions fired");
            assert!(2 * some > all, "most transitions fire: {some} of {all}");
        }
        Err(TestError::Fail(reason, _)) => panic!("{reason}"),
        Err(TestError::Abort(reason)) => panic!("no comparison: {reason}"),
    }
}

/// The stimulus as `grafcet trace` reads it.
fn csv(stimulus: &[Given]) -> String {
    let mut csv = format!("time_ms,{}\n", GIVEN.join(","));
    let cell = |value: Option<i32>| value.map_or_else(String::new, |value| value.to_string());
    for (scan, given) in (0..).zip(stimulus) {
        let (a, b, c) = (i32::from(given.a), i32::from(given.b), i32::from(given.c));
        let (p, d) = (cell(given.p), cell(given.d));
        // Writing to a string does not fail.
        let _ = writeln!(csv, "{},{a},{b},{c},{},{p},{d}", scan * PERIOD_MS, given.n);
    }
    csv
}

/// The rows of the trace that the compiled program gives.
fn by_engine(text: &str, csv: &str) -> Result<Vec<Vec<String>>, String> {
    let none = |_: &str| Err(std::io::ErrorKind::NotFound.into());
    let compilation = grafcet_compiler::compile("random.grafcet", text, &none, Target::Host);
    let said = render(
        &compilation.diagnostics,
        &compilation.sources,
        Style::default(),
    );
    let application = compilation
        .application
        .ok_or(format!("refused:\n{text}\n{said}"))?;
    let unit = &application.controller;
    let stimulus =
        Stimulus::read(csv.as_bytes(), &unit.symbols).map_err(|error| format!("{error}\n{csv}"))?;
    let bench = Bench::new();
    let simulation = Simulation::new(&bench, &application, &[]);
    let mut trace = Vec::new();
    trace::write(unit, simulation, &stimulus, stimulus.end_ms(), &mut trace)
        .map_err(|error| error.to_string())?;
    let mut reader = csv::Reader::from_reader(trace.as_slice());
    let rows = reader.records().map(|row| {
        let row = row.map_err(|error| error.to_string())?;
        Ok(row.iter().map(str::to_owned).collect())
    });
    rows.collect()
}

/// The rows of the trace that the second interpreter gives.
fn by_reference(
    program: &Program,
    stimulus: &[Given],
    fired: &Cell<[usize; 2]>,
) -> Vec<Vec<String>> {
    let mut machine = Machine::new(program);
    let (mut p, mut d) = (None, None);
    let mut rows = Vec::new();
    for (scan, given) in (0..).zip(stimulus) {
        if let Some(new) = given.p.filter(|new| p.replace(*new) != Some(*new)) {
            machine.set_p(new);
        }
        if let Some(new) = given.d.filter(|new| d.replace(*new) != Some(*new)) {
            machine.set_d(new);
        }
        machine.sample(given.a, given.b, given.c, given.n);
        match scan {
            0 => machine.start(),
            _ => machine.scan(scan * PERIOD_MS),
        }
        rows.push(machine.row());
    }
    let [all, some] = fired.get();
    let transitions: usize = program.graphs.iter().map(|g| g.transitions.len()).sum();
    fired.set([all + transitions, some + machine.ever_fired.len()]);
    rows
}

fn differences(engine: &[Vec<String>], reference: &[Vec<String>]) -> String {
    let mut story = String::new();
    for (engine, reference) in engine.iter().zip(reference) {
        let (ours, theirs) = (engine.join(","), reference.join(","));
        let mark = if ours == theirs { ' ' } else { '!' };
        let _ = writeln!(story, "{mark} engine    {ours}");
        if ours != theirs {
            let _ = writeln!(story, "{mark} reference {theirs}");
        }
    }
    story
}
