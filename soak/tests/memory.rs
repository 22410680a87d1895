//! A scan asks for no memory, on x86 too, where the engine's lies in vectors.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

use std::alloc::System;

use grafcet::machine::Bench;
use grafcet::simulation::Simulation;
use grafcet_soak::subject::{Subject, place};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

// One test alone: what is counted is what the whole process asks for.
#[test]
fn no_scan_asks_for_memory() {
    for (subject, inputs) in [
        (
            Subject::LineSwitcher,
            ["Onduty", "line1", "Unlock", "line2"],
        ),
        (
            Subject::DrillingStation,
            ["stop", "start", "jammed1", "jammed2"],
        ),
    ] {
        let application = subject.application().expect("it compiles");
        let bench = Bench::new();
        let mut simulation = Simulation::new(&bench, &application, &[0]);
        let places = inputs.map(|name| place(&application, name).expect("it is there"));
        simulation.scan();
        let mut full = 0;
        let region = Region::new(ALLOCATOR);
        for scan in 0..100_000_u32 {
            // Each half as often as the one before.
            for (bit, place) in places.into_iter().enumerate() {
                let on = scan >> (6 + bit) & 1 != 0;
                simulation.set(place, i32::from(on != (bit == 0)));
            }
            full += u32::from(simulation.scan());
        }
        let asked = region.change();
        assert!(full > 3_000, "{full} scans in which something was new");
        assert_eq!(
            (asked.allocations, asked.reallocations),
            (0, 0),
            "{asked:?}"
        );
    }
}
