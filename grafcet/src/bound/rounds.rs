//! How many rounds a scan of a program that evolves `stable` takes at most.

use std::collections::BTreeMap;

use grafcet_compiler::activity::{Activity, Firing};
use grafcet_core::engine::MAX_ROUNDS;
use grafcet_core::program::{Bit, Evolution, Program, Watch};

/// The rounds of one scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rounds {
    /// It has none: one firing a scan.
    One,
    /// At most so many: every firing behind the first round brings a graph nearer to a step that it does not leave
    /// within the scan.
    AtMost(u32),
    /// Nothing but the engine's limit ends them for certain.
    Limit,
}

impl Rounds {
    /// Of a program with these graphs.
    #[must_use]
    pub fn of(program: &Program<'_>, graphs: &[&Activity]) -> Self {
        if program.evolution == Evolution::Scan {
            return Rounds::One;
        }
        if !program.orders.is_empty() || !program.enclosings.is_empty() {
            return Rounds::Limit;
        }
        let edges = edges(program);
        // The first, those in which something fires, and the one in which nothing does any more.
        let behind: Option<u64> = graphs.iter().map(|graph| behind(graph, &edges)).sum();
        match behind.and_then(|behind| u32::try_from(behind.saturating_add(2)).ok()) {
            Some(rounds) if rounds < MAX_ROUNDS => Rounds::AtMost(rounds),
            _ => Rounds::Limit,
        }
    }

    /// As a number.
    #[must_use]
    pub fn most(self) -> u32 {
        match self {
            Rounds::One => 1,
            Rounds::AtMost(rounds) => rounds,
            Rounds::Limit => MAX_ROUNDS,
        }
    }
}

/// The bits that are rising and falling edges: False in every round but the first.
fn edges(program: &Program<'_>) -> BTreeMap<u16, u32> {
    let inputs = program.edges.iter();
    let inputs = inputs.flat_map(|row| [row.rises, row.falls].into_iter().flatten());
    let inputs = inputs.map(|seen| (seen.word, seen.bits));
    let watched = program.watches.iter().filter_map(|watch| match watch {
        Watch::Edge {
            result: Bit(bit), ..
        } => Some((bit / 32, 1 << (bit % 32))),
        _ => None,
    });
    let mut edges = BTreeMap::new();
    for (word, bits) in inputs.chain(watched) {
        *edges.entry(word).or_default() |= bits;
    }
    edges
}

/// How many firings of a graph there can be behind the first round; none is known when it can go round.
fn behind(graph: &Activity, edges: &BTreeMap<u16, u32>) -> Option<u64> {
    let later: Vec<&Firing> = graph
        .firings
        .iter()
        .filter(|firing| !firing.trigger.waits_for(edges))
        .collect();
    if later.iter().any(|firing| firing.leaves.is_empty()) {
        return None;
    }
    let mut heights: Vec<Height> = vec![Height::Unknown; graph.steps.size()];
    let heights: Option<Vec<u64>> = (0..graph.steps.size())
        .map(|step| height(step, &later, &mut heights))
        .collect();
    let heights = heights?;
    let most = graph.steps.heaviest(&heights, graph.most);
    Some(most.iter().filter_map(|step| heights.get(*step)).sum())
}

#[derive(Clone, Copy)]
enum Height {
    Unknown,
    /// It is being worked out: who comes back here goes round.
    Begun,
    Known(u64),
}

/// How many firings an active step can lead to.
fn height(step: usize, later: &[&Firing], heights: &mut [Height]) -> Option<u64> {
    match heights.get(step)? {
        Height::Known(height) => return Some(*height),
        Height::Begun => return None,
        Height::Unknown => {}
    }
    *heights.get_mut(step)? = Height::Begun;
    let mut most: u64 = 0;
    for firing in later.iter().filter(|it| it.leaves.first() == Some(&step)) {
        let mut firings: u64 = 1;
        for enters in &firing.enters {
            firings = firings.saturating_add(height(*enters, later, heights)?);
        }
        most = most.saturating_add(firings);
    }
    *heights.get_mut(step)? = Height::Known(most);
    Some(most)
}
