//! A short search, the same one every time: everything that is kept, then mutations of it.
//!
//! `FUZZ_CASE=n cargo test -p grafcet-fuzz TARGET` tries one mutation alone, as a failure names it.

#![allow(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

use grafcet_fuzz::corpus;
use grafcet_fuzz::target::Target;

/// Tries an input; one that fails is shown with what it takes to try it again.
fn attempt(target: Target, called: &str, input: &[u8]) {
    if let Err(panic) = catch_unwind(AssertUnwindSafe(|| target.run(input))) {
        let name = target.name();
        eprintln!("{name}: {called} fails on this input, which belongs into fuzz/corpus/{name}:");
        eprintln!("{}", input.escape_ascii());
        resume_unwind(panic);
    }
}

fn smoke(target: Target, cases: u64) {
    let kept = corpus::kept(target).unwrap();
    assert!(!kept.is_empty(), "the corpus is missing");
    let only = std::env::var("FUZZ_CASE").ok();
    let only: Option<u64> = only.map(|case| case.parse().unwrap());
    let seeds = target.seeds();
    assert!(seeds.len() > 3, "the seeds are missing");
    if only.is_none() {
        for (name, input) in &kept {
            attempt(target, name, input);
        }
        for (index, seed) in seeds.iter().enumerate() {
            attempt(target, &format!("seed {index}"), seed);
        }
    }
    let inputs: Vec<&[u8]> = kept.iter().map(|(_, input)| input.as_slice()).collect();
    let inputs: Vec<&[u8]> = inputs
        .into_iter()
        .chain(seeds.iter().map(Vec::as_slice))
        .collect();
    for case in only.map_or(0..cases, |case| case..case + 1) {
        let mut random = fastrand::Rng::with_seed(case);
        let input = random.choice(&inputs).unwrap();
        let other = random.choice(&inputs).unwrap();
        let input = target.mutated(input, other, &mut random);
        attempt(target, &format!("FUZZ_CASE={case}"), &input);
    }
}

#[test]
fn any_graph_text_is_answered() {
    smoke(Target::Graph, 700);
}

#[test]
fn any_plc_toml_is_answered() {
    smoke(Target::Wiring, 400);
}

#[test]
fn any_stimulus_is_answered() {
    smoke(Target::Stimulus, 5_000);
}

#[test]
fn any_flash_content_leaves_a_store_that_works() {
    smoke(Target::Flash, 2_000);
}

#[test]
fn every_target_is_found_by_its_name() {
    for target in Target::ALL {
        assert_eq!(Target::named(target.name()), Some(target));
    }
    assert_eq!(Target::named("nothing"), None);
}
