//! The engine and the reference run the same random programs on the same random stimuli and must leave the same
//! traces.
//!
//! - `PROGRAMS=20000 cargo test -p grafcet-reference` compares more of them;
//! - `SEED=17 cargo test -p grafcet-reference` replays one: a failure names its seed.

mod claims;
mod compare;
mod generate;
mod program;
mod random;
mod render;
mod shrink;
mod stimulus;

use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use compare::{Failure, Tally, compare};
use generate::Features;
use random::Random;
use shrink::{Case, shrunk};

/// How many programs are compared unless the environment says otherwise.
const PROGRAMS: u64 = 500;
const SCANS: usize = 120;

#[test]
fn the_engine_and_the_reference_leave_the_same_traces() {
    let (first, programs) = match number("SEED") {
        Some(seed) => (seed, 1),
        None => (0, number("PROGRAMS").unwrap_or(PROGRAMS)),
    };
    let tally = Mutex::new(Tally::default());
    let failed: Mutex<Option<u64>> = Mutex::new(None);
    let next = AtomicU64::new(first);
    std::panic::set_hook(Box::new(|_| {}));
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                loop {
                    let seed = next.fetch_add(1, Ordering::Relaxed);
                    let lower_failed = failed
                        .lock()
                        .is_ok_and(|failed| failed.is_some_and(|f| f < seed));
                    if seed >= first + programs || lower_failed {
                        return;
                    }
                    match try_seed(seed) {
                        Ok(seen) => tally.lock().expect("a lock").add(seen),
                        Err(_) => {
                            let mut failed = failed.lock().expect("a lock");
                            *failed = Some(failed.map_or(seed, |other| other.min(seed)));
                        }
                    }
                }
            });
        }
    });
    let failed = failed.into_inner().expect("a lock");
    let report = failed.map(report);
    drop(std::panic::take_hook());
    if let Some(report) = report {
        panic!("{report}");
    }
    let tally = tally.into_inner().expect("a lock");
    println!("{tally:?}");
    if programs >= PROGRAMS {
        assert_worth_something(tally);
    }
}

/// Programs in which nothing happens would agree too.
fn assert_worth_something(tally: Tally) {
    assert!(
        tally.fired * 10 > tally.transitions * 7,
        "most transitions fire: {tally:?}"
    );
    assert!(
        tally.active * 10 > tally.steps * 8,
        "most steps become active: {tally:?}"
    );
    assert!(tally.forced > tally.programs, "orders are given: {tally:?}");
    assert!(
        tally.with_faults * 10 > tally.programs,
        "calculations go wrong: {tally:?}"
    );
}

fn number(variable: &str) -> Option<u64> {
    let text = std::env::var(variable).ok()?;
    Some(
        text.parse()
            .unwrap_or_else(|_| panic!("{variable} is no number: `{text}`")),
    )
}

fn case(seed: u64) -> Result<Case, Failure> {
    let mut random = Random::new(seed);
    let program = generate::program(&mut random, Features::ALL);
    let text = program.to_string();
    compare::application(&text)?;
    let tree = compare::tree(&text);
    let stimulus = stimulus::stimulus(
        &mut random,
        &grafcet_reference::Program::new(&tree, &[]),
        SCANS,
    );
    Ok(Case { program, stimulus })
}

fn try_seed(seed: u64) -> Result<Tally, Failure> {
    let case = case(seed)?;
    compare(&case.program.to_string(), &case.stimulus)
}

/// What a person needs to find the fault behind a seed.
fn report(seed: u64) -> String {
    let mut case = match case(seed) {
        Ok(case) => case,
        Err(failure) => {
            let text = generate::program(&mut Random::new(seed), Features::ALL);
            return format!("SEED={seed}: {failure}\n{text}");
        }
    };
    let fails = |case: &Case| compare(&case.program.to_string(), &case.stimulus).err();
    let Some(failure) = fails(&case) else {
        return format!("SEED={seed} failed only once");
    };
    if let Failure::Row { scan, .. } = failure {
        case.stimulus.truncate(scan + 1);
    }
    let small = shrunk(case, |case| {
        fails(case).is_some_and(|other| failure.is_like(&other))
    });
    let failure = fails(&small).map(|failure| failure.to_string());
    let scans: Vec<String> = small
        .stimulus
        .iter()
        .map(|scan| format!("{scan:?}"))
        .collect();
    format!(
        "SEED={seed}: {}\n{}\n{}",
        failure.unwrap_or_default(),
        small.program,
        scans.join("\n")
    )
}
