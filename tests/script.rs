//! A script is played on a controller elsewhere as `grafcet test` runs it: every test of the line switcher holds.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

mod support;

use grafcet_compiler::application::{self, Application, Claim, Test, TestStepKind};
use grafcet_compiler::{Target, compile};
use grafcet_core::engine::Engine;
use grafcet_core::program::Program;
use plc::application::{
    ANALOGUE_INPUTS, ANALOGUE_LABELS, INPUTS, OUTPUTS, PLANTS, PROGRAM, Storage, ThisProgram,
};
use plc::boards::host::machine::{Machine, Parts};
use plc::boards::host::script::{Next, Outcome, Place, Script, Step, StepKind};

fn leak<T>(items: impl IntoIterator<Item = T>) -> &'static [T] {
    Vec::leak(items.into_iter().collect())
}

fn place(place: &application::Place) -> Place {
    match *place {
        application::Place::Controller(slot) => Place::Controller(slot),
        application::Place::Plant(index, slot) => Place::Plant(index, slot),
    }
}

fn kind(kind: &TestStepKind) -> StepKind {
    let result = |claim: &Claim| claim.result;
    match kind {
        TestStepKind::Set(values) => {
            StepKind::Set(leak(values.iter().map(|(at, value)| (place(at), *value))))
        }
        TestStepKind::Release(places) => StepKind::Release(leak(places.iter().map(place))),
        TestStepKind::Pulse { place: at, ms } => StepKind::Pulse {
            place: place(at),
            ms: *ms,
        },
        TestStepKind::Wait { ms } => StepKind::Wait { ms: *ms },
        TestStepKind::WaitScans(scans) => StepKind::WaitScans(*scans),
        TestStepKind::WaitUntil { claim, within_ms } => StepKind::WaitUntil {
            result: result(claim),
            within_ms: *within_ms,
        },
        TestStepKind::Expect(claim) => StepKind::Expect(result(claim)),
        TestStepKind::Never(claim) => StepKind::Never(result(claim)),
        TestStepKind::Always(claim) => StepKind::Always(result(claim)),
        TestStepKind::PowerCycle => StepKind::PowerCycle,
    }
}

fn script(test: &Test, sources: &grafcet_compiler::source::Sources) -> &'static Script {
    let steps = test.steps.iter().map(|step| Step {
        comment: "",
        text: String::leak(sources.text(step.span).to_owned()),
        kind: kind(&step.kind),
    });
    let tables = Box::leak(Box::new(test.observer.tables.clone()));
    let observer: Program<'static> = tables.program();
    let reads = test
        .observer
        .reads
        .iter()
        .map(|(from, to)| (place(from), *to));
    Box::leak(Box::new(Script {
        plants: leak(test.plants.clone()),
        steps: leak(steps),
        observer,
        reads: leak(reads),
    }))
}

/// Plays the tests of the line switcher whose text is changed first, and gives each name with its outcome.
fn played(change: impl Fn(String) -> String) -> Vec<(String, Outcome)> {
    let path = "graphs/line_switcher.grafcet";
    let text = change(std::fs::read_to_string(path).expect("the program is there"));
    let none = |_: &str| Err(std::io::ErrorKind::NotFound.into());
    let compilation = compile(path, &text, &none, Target::Firmware);
    let application: Application = compilation.application.expect("the program is in order");
    assert_eq!(
        application.controller.tables.fingerprint,
        PROGRAM.fingerprint
    );
    let outcome = |test: &Test| (test.name.clone(), play(script(test, &compilation.sources)));
    application.tests.iter().map(outcome).collect()
}

fn play(script: &'static Script) -> Outcome {
    let mut machine = Machine::new(Parts {
        period_ms: PROGRAM.period_ms,
        inputs: &INPUTS,
        analogue: &ANALOGUE_INPUTS,
        analogue_labels: &ANALOGUE_LABELS,
        outputs: &OUTPUTS,
        plants: &PLANTS,
        script: Some(script),
    });
    let mut retained = Vec::new();
    loop {
        match run(&mut machine, &mut retained) {
            Next::End(outcome) => return outcome,
            Next::PowerCycle | Next::Scan => {}
        }
    }
}

/// Runs a controller without filters from power-on until the machine asks for something else than a scan.
fn run(machine: &mut Machine, retained: &mut Vec<i32>) -> Next {
    let mut engine = Engine::new(ThisProgram, Storage::new());
    for (row, value) in PROGRAM.retained.iter().zip(retained.iter()) {
        engine.restore(row.slot, *value);
    }
    let off = OUTPUTS.map(|wire| wire.safe);
    let mut next = machine.step(&off, None);
    let mut time_ms = 0;
    while next == Next::Scan {
        for (wire, value) in INPUTS.iter().zip(machine.inputs()) {
            engine.set_input(wire.bit, value);
        }
        match time_ms {
            0 => engine.start(),
            _ => {
                engine.scan(time_ms);
            }
        }
        time_ms += u64::from(PROGRAM.period_ms);
        let view = engine.images();
        next = machine.step(&OUTPUTS.map(|wire| engine.bit(wire.bit)), Some(&view));
    }
    *retained = PROGRAM
        .retained
        .iter()
        .map(|row| engine.value(row.slot))
        .collect();
    next
}

#[test]
fn every_test_of_the_line_switcher_holds() {
    let outcomes = played(|text| text);
    assert!(outcomes.len() > 20);
    for (name, outcome) in outcomes {
        // What sets a parameter cannot be played: nothing but inputs can be reached from outside a controller.
        let unreachable = matches!(outcome, Outcome::Failed(step) if step.starts_with("set ") && step.contains("TD ="));
        assert!(
            outcome == Outcome::Held || unreachable,
            "{name}: {outcome:?}"
        );
    }
}

#[test]
fn a_claim_that_is_not_so_fails_with_the_step_that_makes_it() {
    let broken = [
        (
            "expect VT2 AND VT3 AND NOT Breaker_1",
            "expect VT2 AND VT3 AND Breaker_1",
        ),
        ("wait until X11 within 5 s", "wait until X11 within 1 s"),
    ];
    for (from, to) in broken {
        let outcomes = played(|text| text.replace(from, to));
        let (_, outcome) = outcomes
            .iter()
            .find(|(name, _)| name == "demonstration")
            .expect("it is there");
        assert_eq!(*outcome, Outcome::Failed(to));
    }
    let outcomes = played(|text| text.replace("never BL1C OR BL20", "never BL10"));
    assert!(
        outcomes
            .iter()
            .any(|(_, outcome)| *outcome == Outcome::Failed("never BL10"))
    );
}
