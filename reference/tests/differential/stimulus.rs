//! What happens to a program from outside.

use std::collections::BTreeMap;

use grafcet_reference::{Program, Qualified};

use crate::random::Random;

/// Everything before one scan, and the scan.
#[derive(Clone, Debug, Default)]
pub struct Scan {
    /// New values of inputs and parameters, by their names in a trace.
    pub given: Vec<(String, i32)>,
    /// Power goes and comes back first.
    pub power_cycle: Option<PowerCycle>,
    /// `System:overruns` from now on.
    pub overruns: Option<i32>,
    /// How many periods after the scan before this one comes.
    pub periods: u64,
}

/// What a loss of power leaves.
#[derive(Clone, Debug, Default)]
pub struct PowerCycle {
    /// The start counts as a recovery.
    pub recovered: bool,
    /// Stored values that are no longer those of the program, as after a change of its declarations.
    pub strange: Vec<(String, i32)>,
}

/// A name as a trace has it.
pub fn full_name((graph, name): Qualified<'_>) -> String {
    if graph.is_empty() {
        name.to_owned()
    } else {
        format!("{graph}:{name}")
    }
}

/// Random scans for a program.
pub fn stimulus(random: &mut Random, program: &Program<'_>, scans: usize) -> Vec<Scan> {
    let restless = *random.pick(&[10, 30, 50]);
    // Scans in which nothing is new, so that the engine has idle ones.
    let calm = *random.pick(&[0, 0, 0, 0, 0, 0, 0, 70]);
    let late = random.chance(30);
    let power_cycles = *random.pick(&[0, 0, 0, 2, 20]);
    let inputs = program.inputs().into_iter().map(|name| (name, restless));
    let parameters = program.parameters().into_iter().map(|name| (name, 3));
    let terminals: Vec<(Qualified<'_>, usize)> = inputs.chain(parameters).collect();
    // A value that has been given is no new one.
    let mut latest = BTreeMap::new();
    let mut overruns = 0;
    let mut stimulus = Vec::new();
    for _ in 0..scans {
        let mut scan = Scan {
            periods: 1,
            ..Scan::default()
        };
        let calm = random.chance(calm);
        for (name, percent) in terminals.iter().filter(|_| !calm) {
            if random.chance(*percent) {
                let value = value(random, program.is_boolean(*name));
                if latest.insert(*name, value) != Some(value) {
                    scan.given.push((full_name(*name), value));
                }
            }
        }
        if late && random.chance(10) {
            // An overrun, or once in a while a very long time.
            scan.periods = *random.pick(&[2, 3, 7, 2, 3, 7, 250_000_000, 1 << 31, 1 << 33]);
            overruns += 1;
            scan.overruns = Some(overruns);
        }
        if random.chance(power_cycles) {
            scan.power_cycle = Some(power_cycle(random, &program.retained()));
        }
        stimulus.push(scan);
    }
    stimulus
}

fn power_cycle(random: &mut Random, retained: &[Qualified<'_>]) -> PowerCycle {
    let recovered = random.chance(50);
    let strange = retained.iter().filter_map(|name| {
        let number = *random.pick(&[-3, 0, 1, 2, 30, 70_000, i32::MIN]);
        random.chance(10).then(|| (full_name(*name), number))
    });
    PowerCycle {
        recovered,
        strange: strange.collect(),
    }
}

fn value(random: &mut Random, boolean: bool) -> i32 {
    if boolean {
        return i32::from(random.chance(50));
    }
    match random.below(20) {
        0..15 => random.below(13) as i32 - 3,
        15..18 => *random.pick(&[20, 30, 100]),
        _ => *random.pick(&[40_000, -40_000, 3_000_000, i32::MAX, i32::MIN]),
    }
}
