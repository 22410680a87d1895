//! The engine and the reference run the same random programs on the same random stimuli and must leave the same
//! traces.
//!
//! - `PROGRAMS=20000 cargo test -p grafcet-reference` compares more of them;
//! - `SEED=17 cargo test -p grafcet-reference` replays one: a failure names its seed.

mod board;
mod claims;
mod compare;
mod generate;
mod large;
mod outcome;
mod program;
mod random;
mod render;
mod rounds;
mod shrink;
mod stimulus;
mod tool;
mod twins;

use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use compare::{Trees, compare};
use generate::Features;
use outcome::{Failure, Tally};
use random::Random;
use shrink::{Case, shrunk};

/// How many programs are compared unless the environment says otherwise.
const PROGRAMS: u64 = 2000;
const SCANS: usize = 60;

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
                    match outcome(&case(seed)) {
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
        tally.fired * 3 > tally.transitions * 2,
        "most transitions fire: {tally:?}"
    );
    assert!(
        tally.active * 4 > tally.steps * 3,
        "most steps become active: {tally:?}"
    );
    assert!(tally.idle * 60 > tally.scans, "scans are idle: {tally:?}");
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

fn case(seed: u64) -> Case {
    let mut random = Random::new(seed);
    let program = generate::program(&mut random, Features::ALL);
    let trees = Trees::of(&program.text());
    let stimulus = stimulus::stimulus(&mut random, &trees.program(), SCANS);
    Case { program, stimulus }
}

fn outcome(case: &Case) -> Result<Tally, Failure> {
    compare(&case.program.text(), &case.stimulus)
}

/// What a person needs to find the fault behind a seed.
fn report(seed: u64) -> String {
    let mut case = case(seed);
    let failure = match outcome(&case) {
        Ok(_) => return format!("SEED={seed} failed only once"),
        Err(Failure::Refused(why)) => return format!("SEED={seed}: {}", Failure::Refused(why)),
        Err(failure) => failure,
    };
    if let Failure::Row { scan, .. } | Failure::Walks { scan } | Failure::Rounds { scan, .. } =
        failure
    {
        case.stimulus.truncate(scan + 1);
    }
    let small = shrunk(case, |case| {
        outcome(case).is_err_and(|other| failure.is_like(&other))
    });
    let failure = outcome(&small).map_or_else(|failure| failure.to_string(), |_| String::new());
    let scans: Vec<String> = small
        .stimulus
        .iter()
        .map(|scan| format!("{scan:?}"))
        .collect();
    let text = small.program.text();
    format!("SEED={seed}: {failure}\n{text}\n{}", scans.join("\n"))
}
