//! How many firings bring a graph to rest behind the first round, while neither inputs nor superiors change.

use std::collections::{BTreeMap, BTreeSet};

use grafcet_compiler::activity::{Activity, Asks, Firing};
use grafcet_core::program::{Graph, Preset, Program, Timer};

use super::rounds::Steady;

/// Inputs of which all ways are tried in which they can stand.
const MOST_INPUTS: usize = 12;

/// A graph in the rounds of one scan.
pub struct Settling<'a> {
    graph: &'a Activity,
    gates: Vec<Gate<'a>>,
    /// How many inputs tell one way from another.
    inputs: usize,
    /// One step of it is active at most, and no other can leave or enter it at once.
    is_single: bool,
    /// Behind the first round nothing that its triggers depend on changes but itself.
    is_steady: bool,
    /// Nor is any trigger True there that was False in the first round.
    is_prompt: bool,
}

/// A transition that changes something.
struct Gate<'a> {
    firing: &'a Firing,
    /// Its inputs among those that tell.
    inputs: Vec<usize>,
    /// For each way in which they can stand, whether it can fire: in the first round,
    at_first: Vec<bool>,
    /// behind it,
    later: Vec<bool>,
    /// and there behind a step that was entered within the scan.
    once_entered: Vec<bool>,
}

impl<'a> Settling<'a> {
    /// Of a graph.
    pub fn of(program: &Program<'_>, own: &Graph, graph: &'a Activity, steady: &Steady) -> Self {
        let firings = graph.firings.iter();
        let is_single = graph.most <= 1 && firings.clone().all(|firing| !firing.leaves.is_empty());
        let can_be_armed = |firing: &&Firing| {
            let mut leaves = firing.leaves.iter();
            leaves.all(|step| graph.steps.are(*step, *step))
        };
        // A step that is left for itself alone changes nothing.
        let changes = |firing: &&Firing| !is_single || firing.leaves != firing.enters;
        let firings: Vec<&Firing> = firings.filter(can_be_armed).filter(changes).collect();
        let telling = telling(&firings, steady);
        let gates = firings.iter().map(|firing| {
            let own_timers = match is_single {
                true => own_timers(program, firing),
                // A step that is left and entered at once is not timed anew.
                false => BTreeSet::new(),
            };
            Gate::of(firing, &telling, steady, &own_timers)
        });
        let words = own.words().indices();
        let is_steady = firings.iter().all(|firing| {
            let own_timers = own_timers(program, firing);
            firing.trigger.depends_on_none_but(
                |bit| {
                    let is_own = words.contains(&usize::from(bit / 32));
                    is_own || steady.is_input(bit) || steady.is_edge(bit)
                },
                |timer| own_timers.contains(&timer),
            )
        });
        let asks_for_no_edge = |firing: &&Firing| {
            let bits = firing.trigger.bits();
            let mut edges = bits.iter().filter(|(bit, _)| steady.is_edge(**bit));
            edges.any(|(_, asks)| asks.to_be_false)
        };
        Settling {
            graph,
            gates: gates.collect(),
            inputs: telling.len(),
            is_single,
            is_steady,
            is_prompt: is_steady && !firings.iter().any(asks_for_no_edge),
        }
    }

    /// Whether it fires in rounds that follow each other, from the second one on, until it rests.
    pub fn is_steady(&self) -> bool {
        self.is_steady
    }

    /// The most firings, however the inputs stand, of a graph that is free from the first round on or may be freed behind
    /// it; none is known when it can go round.
    pub fn firings(&self, is_free: bool) -> Option<u64> {
        let is_source = |gate: &&Gate<'_>| gate.firing.leaves.is_empty();
        let mut sources = self.gates.iter().filter(is_source);
        if sources.any(|gate| gate.later.contains(&true)) {
            return None;
        }
        // A free graph has fired in the first round, or does not in this scan.
        let has_fired = is_free && self.is_prompt && self.is_single;
        let mut heights = vec![0; self.graph.steps.size()];
        for way in 0..1 << self.inputs {
            let entered = self.entered(way)?;
            let mut reached: Vec<u64> = vec![0; heights.len()];
            for gate in &self.gates {
                let opens = if has_fired {
                    &gate.at_first
                } else {
                    &gate.later
                };
                let first = gate.firing.leaves.first();
                if let Some(reached) = first.and_then(|step| reached.get_mut(*step))
                    && gate.is(opens, way)
                {
                    *reached = self.either(*reached, gate.leads_to(&entered));
                }
            }
            for (height, reached) in heights.iter_mut().zip(reached) {
                *height = reached.saturating_sub(u64::from(has_fired)).max(*height);
            }
        }
        let most = self.graph.steps.heaviest(&heights, self.graph.most);
        Some(most.iter().filter_map(|step| heights.get(*step)).sum())
    }

    /// For each step that is entered, how many firings that can lead to.
    fn entered(&self, way: usize) -> Option<Vec<u64>> {
        let size = self.graph.steps.size();
        let mut leaving: Vec<Vec<&Gate<'_>>> = vec![Vec::new(); size];
        let mut ways_in = vec![0_usize; size];
        let open = self
            .gates
            .iter()
            .filter(|gate| gate.is(&gate.once_entered, way));
        for gate in open {
            leaving.get_mut(*gate.firing.leaves.first()?)?.push(gate);
            for step in &gate.firing.enters {
                *ways_in.get_mut(*step)? += 1;
            }
        }
        let first = (0..size).filter(|step| ways_in.get(*step) == Some(&0));
        let mut order: Vec<usize> = first.collect();
        let mut place = 0;
        while let Some(&step) = order.get(place) {
            place += 1;
            let entered = leaving.get(step)?.iter();
            for next in entered.flat_map(|gate| &gate.firing.enters) {
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
            let leaving = leaving.get(*step)?.iter();
            let height = leaving.fold(0, |height, gate| {
                self.either(height, gate.leads_to(&heights))
            });
            *heights.get_mut(*step)? = height;
        }
        Some(heights)
    }

    /// How many firings a step can lead to that two transitions leave.
    fn either(&self, one: u64, other: u64) -> u64 {
        match self.is_single {
            true => one.max(other),
            // Both can leave it at once.
            false => one.saturating_add(other),
        }
    }
}

impl<'a> Gate<'a> {
    fn of(
        firing: &'a Firing,
        telling: &[u16],
        steady: &Steady,
        own_timers: &BTreeSet<u16>,
    ) -> Self {
        let bits = firing.trigger.bits();
        let asked = telling.iter().enumerate();
        let asked = asked.filter(|(_, bit)| bits.contains_key(bit));
        let (inputs, asked): (Vec<usize>, Vec<u16>) = asked.unzip();
        let edges = bits.keys().filter(|bit| steady.is_edge(**bit));
        let edges: BTreeMap<u16, bool> = edges.map(|bit| (*bit, false)).collect();
        let opens = |edges: &BTreeMap<u16, bool>, running: &BTreeSet<u16>| {
            let ways = 0..1_usize << asked.len();
            let opens = ways.map(|way| {
                let mut stand = edges.clone();
                let asked = asked.iter().enumerate();
                stand.extend(asked.map(|(at, bit)| (*bit, way >> at & 1 != 0)));
                firing.trigger.can_hold(&stand, running)
            });
            opens.collect()
        };
        Gate {
            at_first: opens(&BTreeMap::new(), &BTreeSet::new()),
            later: opens(&edges, &BTreeSet::new()),
            once_entered: opens(&edges, own_timers),
            inputs,
            firing,
        }
    }

    /// Whether it is open in a way in which all inputs that tell can stand.
    fn is(&self, open: &[bool], way: usize) -> bool {
        let own = self.inputs.iter().enumerate();
        let own = own.fold(0, |own, (at, place)| own | (way >> place & 1) << at);
        open.get(own).copied().unwrap_or(true)
    }

    /// Its firing, and those that what it enters can lead to.
    fn leads_to(&self, heights: &[u64]) -> u64 {
        let entered = self.firing.enters.iter();
        let entered = entered.filter_map(|step| heights.get(*step));
        entered.fold(1, |sum, height| sum.saturating_add(*height))
    }
}

/// The inputs of which one transition may ask to be True and another to be False; of too many those that most ask.
fn telling(firings: &[&Firing], steady: &Steady) -> Vec<u16> {
    let mut asked: BTreeMap<u16, (Asks, usize)> = BTreeMap::new();
    for (bit, asks) in firings.iter().flat_map(|firing| firing.trigger.bits()) {
        let (all, times) = asked.entry(bit).or_default();
        all.to_be_true |= asks.to_be_true;
        all.to_be_false |= asks.to_be_false;
        *times += 1;
    }
    asked.retain(|bit, (asks, _)| steady.is_input(*bit) && asks.to_be_true && asks.to_be_false);
    let times = asked.into_iter().map(|(bit, (_, times))| (bit, times));
    let mut telling: Vec<(u16, usize)> = times.collect();
    telling.sort_by_key(|(_, times)| std::cmp::Reverse(*times));
    telling
        .into_iter()
        .map(|(bit, _)| bit)
        .take(MOST_INPUTS)
        .collect()
}

/// The timers of a trigger on its only entrance step: in the scan in which that is entered they do not run out.
fn own_timers(program: &Program<'_>, firing: &Firing) -> BTreeSet<u16> {
    let is_own = |row: &u16| {
        let timer = program.timers.get(usize::from(*row));
        matches!(timer, Some(Timer::Own { preset: Preset::Constant(time), .. }) if *time > 0)
    };
    let timers = firing.trigger.timers().into_iter();
    timers
        .filter(|row| firing.leaves.len() == 1 && is_own(row))
        .collect()
}
