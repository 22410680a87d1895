//! Large programs run as small ones do.

#![allow(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use std::fmt::Write as _;

use grafcet::machine::Bench;
use grafcet::simulation::Simulation;
use grafcet::stimulus::Stimulus;
use grafcet::trace;
use grafcet_compiler::application::{Application, Place};
use grafcet_compiler::{Target, compile};

fn application(text: &str) -> Application {
    let none = |_: &str| Err(std::io::ErrorKind::NotFound.into());
    let compilation = compile("large.grafcet", text, &none, Target::Host);
    let said = compilation.diagnostics;
    let refused = || panic!("refused: {:?}", said.first());
    compilation.application.unwrap_or_else(refused)
}

/// The rows of a trace without its header.
fn traced(application: &Application, stimulus: &str, until_ms: u64) -> Vec<Vec<String>> {
    let unit = &application.controller;
    let stimulus = Stimulus::read(stimulus.as_bytes(), &unit.symbols).unwrap();
    let bench = Bench::new();
    let simulation = Simulation::new(&bench, application, &[]);
    let mut csv = Vec::new();
    trace::write(unit, simulation, &stimulus, until_ms, &mut csv).unwrap();
    let mut reader = csv::Reader::from_reader(csv.as_slice());
    let rows = reader.records().map(Result::unwrap);
    rows.map(|row| row.iter().map(str::to_owned).collect())
        .collect()
}

/// The value of an output or variable.
fn value(application: &Application, simulation: &Simulation, name: &str) -> i32 {
    let variables = &application.controller.symbols.variables;
    let variable = variables.iter().find(|it| it.name == name).unwrap();
    simulation.value(Place::Controller(variable.slot))
}

#[test]
fn a_token_walks_through_a_chain_of_a_thousand_steps_one_in_a_scan() {
    let mut text = "var passed : int\ngraph G {\ninitial step 1\n".to_owned();
    for step in 2..=1000 {
        let before = step - 1;
        let _ = writeln!(text, "step {step} {{ on activation: passed = passed + 1 }}");
        let _ = writeln!(text, "transition {step}: {before} -> {step} when X{before}");
    }
    let application = application(&(text + "}"));
    let rows = traced(&application, "time_ms\n", 10_100);
    assert_eq!(rows.len(), 1011);
    for (scan, row) in rows.iter().enumerate() {
        let step = (scan + 1).min(1000);
        let expected = [
            (scan * 10).to_string(),
            step.to_string(),
            (step - 1).to_string(),
        ];
        assert_eq!(*row, expected);
    }
}

#[test]
fn ten_thousand_steps_in_a_thousand_graphs_all_move() {
    let mut text = "input a\n".to_owned();
    for graph in 0..1000 {
        let _ = writeln!(text, "graph G{graph} {{ output M; initial step 1");
        for step in 1..=10 {
            let next = step % 10 + 1;
            let _ = writeln!(text, "transition {step}: {step} -> {next} when a");
            if step > 1 {
                let _ = writeln!(text, "step {step} {{ M IF X{step} }}");
            }
        }
        text += "}\n";
    }
    let application = application(&text);
    let rows = traced(&application, "time_ms,a\n0,0\n20,1\n150,0\n", 200);
    for (scan, row) in rows.iter().enumerate() {
        // The input is True in scans 2 to 14; every graph moves in each of them.
        let moves = scan.clamp(1, 14) - 1;
        let step = moves % 10 + 1;
        let (situations, outputs) = row[1..].split_at(1000);
        assert!(
            situations.iter().all(|it| *it == step.to_string()),
            "scan {scan}: {row:?}"
        );
        let on = if step > 1 { "1" } else { "0" };
        assert!(outputs.iter().all(|it| it == on), "scan {scan}");
        assert_eq!(outputs.len(), 1000);
    }
}

#[test]
fn a_thousand_graphs_that_force_each_other_follow_in_one_scan() {
    let mut text = "input a\n".to_owned();
    for graph in 0..1000 {
        let _ = writeln!(text, "graph G{graph} {{ initial step 1\nstep 2 {{");
        if graph + 1 < 1000 {
            let _ = writeln!(text, "F/G{}:{{2}}", graph + 1);
        }
        text += "}\n";
        if graph == 0 {
            text += "transition 1: 1 -> 2 when a\n";
        }
        text += "}\n";
    }
    let application = application(&text);
    let rows = traced(&application, "time_ms,a\n0,0\n20,1\n", 30);
    for (scan, row) in rows.iter().enumerate() {
        let step = if scan < 2 { "1" } else { "2" };
        assert!(row[1..].iter().all(|it| it == step), "scan {scan}");
    }
}

#[test]
fn an_expression_a_hundred_deep_is_calculated() {
    // A hundred contraries are none; with b the outermost one is False.
    let deep = (0..100).fold("a".to_owned(), |inner, _| format!("NOT ({inner} OR b)"));
    let text = format!("input a, b\noutput M\ngraph G {{ initial step 1 {{ M IF {deep} }} }}");
    let rows = traced(
        &application(&text),
        "time_ms,a,b\n0,0,0\n10,1,\n20,,1\n30,0,\n40,,0\n",
        40,
    );
    let outputs: Vec<&str> = rows.iter().map(|row| row[2].as_str()).collect();
    assert_eq!(outputs, ["0", "1", "0", "0", "0"]);
}

#[test]
fn ten_thousand_operands_are_all_looked_at() {
    let names: Vec<String> = (0..10_000).map(|n| format!("v{n}")).collect();
    for (operator, idle, others) in [("AND", 0, 1), ("OR", 1, 0), ("XOR", 0, 0)] {
        let text = format!(
            "input {}\noutput M\ngraph G {{ initial step 1 {{ M IF {} }} }}",
            names.join(", "),
            names.join(&format!(" {operator} "))
        );
        let application = application(&text);
        let bench = Bench::new();
        let mut simulation = Simulation::new(&bench, &application, &[]);
        let inputs: Vec<Place> = {
            let variables = application.controller.symbols.variables.iter();
            let inputs = variables.filter(|it| it.name.starts_with('v'));
            inputs.map(|it| Place::Controller(it.slot)).collect()
        };
        assert_eq!(inputs.len(), 10_000);
        for input in &inputs {
            simulation.set(*input, others);
        }
        simulation.scan();
        let rest = value(&application, &simulation, "M");
        assert_eq!(rest, others, "{operator} of equal operands");
        for operand in [0, 1, 31, 4_999, 9_998, 9_999] {
            let lone = if operator == "XOR" { 1 } else { idle };
            simulation.set(inputs[operand], lone);
            simulation.scan();
            assert_eq!(
                value(&application, &simulation, "M"),
                lone,
                "{operator} {operand}"
            );
            simulation.set(inputs[operand], others);
            simulation.scan();
            assert_eq!(value(&application, &simulation, "M"), others);
        }
    }
}
