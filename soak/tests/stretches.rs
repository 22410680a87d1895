//! What `script/soak` shows on x86, as much of it as a test command has time for, and that it would see a fault.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

use std::collections::BTreeMap;

use grafcet::machine::Bench;
use grafcet_compiler::source::FileId;
use grafcet_compiler::{Target, compile, parse};
use grafcet_reference::Program;
use grafcet_soak::lockstep::{Failure, Lockstep, Reference};
use grafcet_soak::stretch::{Outcome, Pace, Stretch, YEAR_MS};
use grafcet_soak::subject::Subject;
use grafcet_soak::watch::Fault;

/// With which a year is enough for everything to happen.
const SEED: u64 = 3;
const MINUTE_MS: u64 = 60_000;
const PERIOD_MS: u64 = 10;

fn run(subject: Subject, long_ms: u64, pace: Pace) -> Outcome {
    let stretch = Stretch {
        subject,
        seed: SEED,
        long_ms,
        pace,
    };
    let ended = stretch.run(&mut |_, _| {});
    ended.unwrap_or_else(|broken| panic!("{}, seed {SEED}: {broken}", subject.name()))
}

#[test]
fn both_interpreters_agree_on_every_scan_of_a_busy_machine() {
    for subject in Subject::ALL {
        let outcome = run(subject, 2 * MINUTE_MS, Pace::EveryScan);
        assert_eq!(outcome.scans, 2 * MINUTE_MS / PERIOD_MS);
        assert!(outcome.fired > 25, "{outcome:?}");
        assert!(outcome.idle * 2 > outcome.scans, "{outcome:?}");
    }
}

#[test]
fn both_interpreters_agree_for_a_year_and_no_timer_is_stuck() {
    for subject in Subject::ALL {
        let outcome = run(subject, YEAR_MS, Pace::YEARS);
        assert!(
            (outcome.scans + outcome.leapt) * PERIOD_MS >= YEAR_MS,
            "{outcome:?}"
        );
        assert_eq!(
            outcome.missing,
            Vec::<String>::new(),
            "every step and transition of {} is reached, and every timer runs out",
            subject.name()
        );
    }
}

#[test]
fn a_pause_that_is_leapt_over_changes_nothing() {
    for subject in Subject::ALL {
        let shifts = |leapt| Pace::Shifts {
            pause_ms: (3 * MINUTE_MS, 12 * MINUTE_MS),
            leapt,
        };
        let scanned = run(subject, 60 * MINUTE_MS, shifts(false));
        let leapt = run(subject, 60 * MINUTE_MS, shifts(true));
        assert!(leapt.leapt > 60_000, "{leapt:?}");
        assert_eq!(leapt.scans + leapt.leapt, scanned.scans);
        assert_eq!(leapt.idle + leapt.leapt, scanned.idle);
        assert_eq!(
            (leapt.fired, leapt.timed, leapt.row),
            (scanned.fired, scanned.timed, scanned.row)
        );
    }
}

/// The line switcher, with another time for step 3: in the engine, or for both interpreters.
fn first_failure(wrong_time: &str, wrong_in_the_reference: bool) -> Failure {
    let text = include_str!("../../graphs/line_switcher.grafcet");
    let wrong = text.replace("T/X3/TD", &format!("T/X3/{wrong_time}"));
    assert_ne!(text, wrong);
    let none = |_: &str| Err(std::io::ErrorKind::NotFound.into());
    let compilation = compile("wrong", &wrong, &none, Target::Host);
    let application = compilation.application.expect("it compiles");
    let of_the_reference = if wrong_in_the_reference { &wrong } else { text };
    let tree = parse(FileId(0), of_the_reference, &mut Vec::new());
    let (bench, program) = (Bench::new(), Program::new(&tree, &[]));
    let mut lockstep = Lockstep::new(
        Subject::LineSwitcher,
        &bench,
        &application,
        &program,
        Reference::IdleSpared,
        SEED,
        BTreeMap::new(),
    );
    for _ in 0..200_000 {
        if let Err(failure) = lockstep.scan() {
            return failure;
        }
        if let Err(failure) = lockstep.look_at_timers() {
            return failure;
        }
    }
    panic!("nothing was found");
}

#[test]
fn interpreters_that_differ_are_found() {
    match first_failure("TA", false) {
        Failure::Differs(cells) => assert!(cells[0].starts_with("LineSwitcher is "), "{cells:?}"),
        other => panic!("{other}"),
    }
}

#[test]
fn a_timer_that_is_stuck_in_both_interpreters_is_found() {
    match first_failure("TF", true) {
        Failure::Fault(fault) => assert_eq!(
            fault,
            Fault::StuckTimer {
                step: "3".to_owned(),
                active_ms: 2_010,
                longest_ms: 2_000
            }
        ),
        other => panic!("{other}"),
    }
}

#[test]
fn every_habit_leads_to_something_in_the_program() {
    for subject in Subject::ALL {
        let application = subject.application().expect("it compiles");
        for habit in subject.habits() {
            let place = grafcet_soak::subject::place(&application, habit.what);
            assert!(place.is_some(), "{}: {}", subject.name(), habit.what);
        }
        let steps = &application.controller.symbols.graphs[0].steps;
        for limit in subject.limits() {
            assert!(steps.iter().any(|step| step.id == limit.step), "{limit:?}");
        }
    }
}
