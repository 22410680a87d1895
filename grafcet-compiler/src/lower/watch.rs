//! Edges and timers with a memory: each stands in the list of the phase in which it is evaluated.

use std::collections::{BTreeMap, HashMap};

use grafcet_core::program::{Bit, Edge, Edges, Run, Seen, Stamp, Watch};

use super::limits::index;

/// Where an expression stands, which decides when its edges and timers are evaluated. In the order of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Context {
    /// Triggers and events: phase 2.
    Trigger,
    /// The forcing conditions of a graph, by its index: phase 4.
    Forcing(usize),
    /// The conditions of the forcing of a graph by its own stand-alone actions.
    SelfForcing(usize),
    /// `do` and `on` statements under `evolution stable`: the end of the first round.
    Round,
    /// All other actions: before phase 6.
    Action,
}

/// The watches of a program, phase by phase.
#[derive(Default)]
pub(super) struct Watches {
    lists: BTreeMap<Context, Vec<Watch>>,
    inputs: BTreeMap<u16, Edges>,
    known: HashMap<(Context, Watch), Bit>,
}

/// A supply of bits and time stamps.
pub(super) struct Memories {
    pub bits: usize,
    pub stamps: usize,
}

impl Memories {
    fn bit(&mut self) -> Bit {
        self.bits += 1;
        Bit(index(self.bits - 1))
    }

    /// A new word of bits.
    pub fn word(&mut self) -> u16 {
        let start = self.bits.next_multiple_of(32);
        self.bits = start + 32;
        index(start / 32)
    }

    /// A new time stamp.
    pub fn stamp(&mut self) -> Stamp {
        self.stamps += 1;
        Stamp(index(self.stamps - 1))
    }
}

/// A bit or stamp that is not given out yet.
pub(super) const NO_BIT: Bit = Bit(0);
/// A stamp that is not given out yet.
pub(super) const NO_STAMP: Stamp = Stamp(0);

impl Watches {
    /// The result of a watch given without memories of its own.
    pub fn result(&mut self, context: Context, watch: Watch, memories: &mut Memories) -> Bit {
        let (filled, bit) = fill(watch, memories);
        self.lists.entry(context).or_default().push(filled);
        bit
    }

    /// The same, but the same watch in the same place is made once. Only for what cannot fault: faults are counted
    /// for each operator that is written.
    pub fn shared(&mut self, context: Context, watch: Watch, memories: &mut Memories) -> Bit {
        if let Some(result) = self.known.get(&(context, watch)) {
            return *result;
        }
        let bit = self.result(context, watch, memories);
        self.known.insert((context, watch), bit);
        bit
    }

    /// The bit with an edge of an input, whose whole word is watched in phase 2 for all phases.
    pub fn input_edge(&mut self, input: Bit, edge: Edge, memories: &mut Memories) -> Bit {
        let word = index(input.word());
        let edges = self.inputs.entry(word).or_insert_with(|| Edges {
            word,
            last: memories.word(),
            rises: None,
            falls: None,
        });
        let seen = match edge {
            Edge::Rising => &mut edges.rises,
            Edge::Falling => &mut edges.falls,
        };
        let seen = seen.get_or_insert_with(|| Seen {
            word: memories.word(),
            bits: 0,
        });
        seen.bits |= input.mask();
        Bit(index(
            usize::from(seen.word) * 32 + usize::from(input.0 % 32),
        ))
    }

    /// The edges of inputs.
    pub fn edges(&self) -> Vec<Edges> {
        self.inputs.values().copied().collect()
    }

    /// All lists as one table, and where each begins.
    pub fn table(self) -> (Vec<Watch>, BTreeMap<Context, Run>) {
        let mut table = Vec::new();
        let mut runs = BTreeMap::new();
        for (context, list) in self.lists {
            let run = Run {
                start: index(table.len()),
                len: index(list.len()),
            };
            runs.insert(context, run);
            table.extend(list);
        }
        (table, runs)
    }
}

/// Gives a watch its memories.
fn fill(mut watch: Watch, memories: &mut Memories) -> (Watch, Bit) {
    match &mut watch {
        Watch::Edge { last, .. } => *last = memories.bit(),
        Watch::Timer { last, risen, .. } | Watch::OnDelay { last, risen, .. } => {
            *last = memories.bit();
            *risen = memories.stamp();
        }
        Watch::OffDelay { last, fallen, .. } => {
            *last = memories.bit();
            *fallen = memories.stamp();
        }
        Watch::Value { .. } => {}
    }
    let bit = memories.bit();
    match &mut watch {
        Watch::Edge { result, .. }
        | Watch::Timer { result, .. }
        | Watch::OnDelay { result, .. }
        | Watch::OffDelay { result, .. }
        | Watch::Value { result, .. } => *result = bit,
    }
    (watch, bit)
}
