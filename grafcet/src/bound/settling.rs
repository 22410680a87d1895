//! How many firings bring a graph to rest behind the first round, while neither inputs nor superiors change.

use std::collections::{BTreeMap, BTreeSet};

use grafcet_compiler::activity::{Activity, Firing};
use grafcet_core::program::{Preset, Program, Timer};

use super::rounds::Steady;

/// Inputs of which all ways are tried in which they can stand.
const MOST_INPUTS: usize = 12;

/// A graph in rounds behind the first one.
pub struct Settling<'a> {
    graph: &'a Activity,
    gates: Vec<Gate<'a>>,
    /// How many inputs tell one way from another.
    inputs: usize,
}

/// A transition that can fire in such a round.
struct Gate<'a> {
    firing: &'a Firing,
    /// Its inputs among those that tell.
    inputs: Vec<usize>,
    /// For each way in which they can stand, whether it can fire.
    opens: Vec<bool>,
    /// The same where its entrance step was entered within the scan.
    opens_at_once: Vec<bool>,
}

impl<'a> Settling<'a> {
    /// Of a graph.
    pub fn of(program: &Program<'_>, graph: &'a Activity, steady: &Steady) -> Self {
        let can_fire = |firing: &&Firing| {
            let mut leaves = firing.leaves.iter();
            leaves.all(|step| graph.steps.are(*step, *step))
                && firing.trigger.can_hold(&edges(firing, steady), &BTreeSet::new())
                // A step that is left for itself alone changes nothing.
                && (graph.most > 1 || firing.leaves != firing.enters)
        };
        let later: Vec<&Firing> = graph.firings.iter().filter(can_fire).collect();
        let telling = telling(&later, steady);
        let gates = later.into_iter().map(|firing| {
            let bits = firing.trigger.bits();
            let asked = telling.iter().enumerate();
            let asked: Vec<(usize, u16)> = asked
                .filter(|(_, bit)| bits.contains_key(bit))
                .map(|(place, bit)| (place, *bit))
                .collect();
            let opens = |running: &BTreeSet<u16>| {
                let ways = 0..1_usize << asked.len();
                let opens = ways.map(|way| {
                    let mut stand = edges(firing, steady);
                    let asked = asked.iter().enumerate();
                    stand.extend(asked.map(|(at, (_, bit))| (*bit, way >> at & 1 != 0)));
                    firing.trigger.can_hold(&stand, running)
                });
                opens.collect()
            };
            Gate {
                opens: opens(&BTreeSet::new()),
                opens_at_once: opens(&own_timers(program, graph, firing)),
                inputs: asked.iter().map(|(place, _)| *place).collect(),
                firing,
            }
        });
        Settling {
            graph,
            gates: gates.collect(),
            inputs: telling.len(),
        }
    }

    /// The most firings, however the inputs stand; none is known when the graph can go round.
    pub fn firings(&self) -> Option<u64> {
        if self.gates.iter().any(|gate| gate.firing.leaves.is_empty()) {
            return None;
        }
        let mut most = 0;
        for way in 0..1 << self.inputs {
            most = most.max(self.firings_in(way)?);
        }
        Some(most)
    }

    fn firings_in(&self, way: usize) -> Option<u64> {
        let entered = self.heights(way)?;
        let mut heights = vec![0; entered.len()];
        for gate in self
            .gates
            .iter()
            .filter(|gate| gate.is_open(way, &gate.opens))
        {
            let first = gate.firing.leaves.first();
            if let Some(height) = first.and_then(|step| heights.get_mut(*step)) {
                *height = self.with(*height, gate.leads_to(&entered));
            }
        }
        let most = self.graph.steps.heaviest(&heights, self.graph.most);
        Some(most.iter().filter_map(|step| heights.get(*step)).sum())
    }

    /// For each step that is entered, how many firings that can lead to.
    fn heights(&self, way: usize) -> Option<Vec<u64>> {
        let size = self.graph.steps.size();
        let mut behind: Vec<Vec<&Gate<'_>>> = vec![Vec::new(); size];
        let mut ways_in = vec![0_usize; size];
        for gate in self
            .gates
            .iter()
            .filter(|gate| gate.is_open(way, &gate.opens_at_once))
        {
            behind.get_mut(*gate.firing.leaves.first()?)?.push(gate);
            for step in &gate.firing.enters {
                *ways_in.get_mut(*step)? += 1;
            }
        }
        let mut order: Vec<usize> = (0..size)
            .filter(|step| ways_in.get(*step) == Some(&0))
            .collect();
        let mut place = 0;
        while let Some(&step) = order.get(place) {
            place += 1;
            for next in behind
                .get(step)?
                .iter()
                .flat_map(|gate| &gate.firing.enters)
            {
                let left = ways_in.get_mut(*next)?;
                *left -= 1;
                if *left == 0 {
                    order.push(*next);
                }
            }
        }
        // Steps that are missing stand in a ring.
        if order.len() < size {
            return None;
        }
        let mut heights = vec![0; size];
        for step in order.iter().rev() {
            let height = behind
                .get(*step)?
                .iter()
                .fold(0, |height, gate| self.with(height, gate.leads_to(&heights)));
            *heights.get_mut(*step)? = height;
        }
        Some(heights)
    }

    /// The height of a step that one more transition leaves.
    fn with(&self, height: u64, firings: u64) -> u64 {
        match self.graph.most > 1 {
            // Several can leave it at once.
            true => height.saturating_add(firings),
            false => height.max(firings),
        }
    }
}

impl Gate<'_> {
    /// Its firing, and those that what it enters can lead to.
    fn leads_to(&self, heights: &[u64]) -> u64 {
        let entered = self.firing.enters.iter();
        let entered = entered.filter_map(|step| heights.get(*step));
        entered.fold(1, |sum, height| sum.saturating_add(*height))
    }

    fn is_open(&self, way: usize, opens: &[bool]) -> bool {
        let own = self.inputs.iter().enumerate();
        let own = own.fold(0, |own, (at, place)| own | (way >> place & 1) << at);
        opens.get(own).copied().unwrap_or(true)
    }
}

/// The inputs of which one transition may ask to be True and another to be False; of too many those that most ask.
fn telling(firings: &[&Firing], steady: &Steady) -> Vec<u16> {
    let mut asked: BTreeMap<u16, (bool, bool, usize)> = BTreeMap::new();
    for (bit, asks) in firings.iter().flat_map(|firing| firing.trigger.bits()) {
        let (to_be_true, to_be_false, times) = asked.entry(bit).or_default();
        *to_be_true |= asks.to_be_true;
        *to_be_false |= asks.to_be_false;
        *times += 1;
    }
    let tells = |(bit, (to_be_true, to_be_false, _)): &(u16, (bool, bool, usize))| {
        steady.is_input(*bit) && *to_be_true && *to_be_false
    };
    let mut telling: Vec<(u16, (bool, bool, usize))> = asked.into_iter().filter(tells).collect();
    telling.sort_by_key(|(_, (_, _, times))| std::cmp::Reverse(*times));
    telling
        .into_iter()
        .map(|(bit, _)| bit)
        .take(MOST_INPUTS)
        .collect()
}

/// The edges in a trigger, which are False.
fn edges(firing: &Firing, steady: &Steady) -> BTreeMap<u16, bool> {
    let bits = firing.trigger.bits().into_keys();
    bits.filter(|bit| steady.is_edge(*bit))
        .map(|bit| (bit, false))
        .collect()
}

/// The timers of a trigger that have not run out in the scan in which its entrance step is entered. Where several steps
/// can be active there may be none: one that is left and entered at once is not timed anew.
fn own_timers(program: &Program<'_>, graph: &Activity, firing: &Firing) -> BTreeSet<u16> {
    let is_own = |row: &u16| {
        let timer = program.timers.get(usize::from(*row));
        matches!(timer, Some(Timer::Own { preset: Preset::Constant(time), .. }) if *time > 0)
    };
    let timers = firing.trigger.timers().into_iter();
    timers
        .filter(|row| graph.most <= 1 && is_own(row))
        .collect()
}
