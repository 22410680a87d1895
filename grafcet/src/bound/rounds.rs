//! How many rounds a scan of a program that evolves `stable` takes at most.

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use grafcet_compiler::activity::{Activity, Trigger};
use grafcet_core::engine::MAX_ROUNDS;
use grafcet_core::program::{Bit, Condition, Evolution, Program, Watch};

use super::settling::Settling;

/// The rounds of one scan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Rounds {
    /// It has none: one firing a scan.
    One,
    /// They end by themselves.
    Settle {
        /// How many there are at most: the first, those in which something fires behind it, and one in which nothing does.
        rounds: u32,
        /// Firings of each graph behind the first at most.
        firings: Vec<u64>,
    },
    /// Nothing but the engine's limit ends them for certain.
    Limit,
}

impl Rounds {
    /// Of a program.
    #[must_use]
    pub fn of_program(program: &Program<'_>) -> Self {
        let graphs = program.graphs.iter().enumerate();
        let activities = graphs.map(|(index, graph)| Activity::of(program, index, graph));
        let activities: Vec<Activity> = activities.collect();
        Rounds::of(program, &activities.iter().collect::<Vec<_>>())
    }

    /// Of a program with these graphs.
    #[must_use]
    pub(super) fn of(program: &Program<'_>, graphs: &[&Activity]) -> Self {
        if program.evolution == Evolution::Scan {
            return Rounds::One;
        }
        let mut hierarchy = Hierarchy {
            program,
            graphs,
            steady: Steady::of(program),
            known: vec![None; graphs.len()],
        };
        let moves: Vec<Moves> = (0..graphs.len())
            .map(|graph| hierarchy.moves(graph))
            .collect();
        let firings: Option<Vec<u64>> = moves.iter().map(|it| it.firings).collect();
        // Graphs that go on in every round do so at once, others maybe one behind the other.
        let of = |at_once| {
            let moves = moves.iter().filter(move |it| it.at_once == at_once);
            moves.filter_map(|it| it.firings)
        };
        let rounds = of(true).max().unwrap_or(0);
        let rounds = of(false)
            .fold(rounds, u64::saturating_add)
            .saturating_add(2);
        match (firings, u32::try_from(rounds)) {
            (Some(firings), Ok(rounds)) if rounds < MAX_ROUNDS => {
                Rounds::Settle { rounds, firings }
            }
            _ => Rounds::Limit,
        }
    }

    /// As a number.
    #[must_use]
    pub fn most(&self) -> u32 {
        match self {
            Rounds::One => 1,
            Rounds::Settle { rounds, .. } => *rounds,
            Rounds::Limit => MAX_ROUNDS,
        }
    }
}

/// What no round behind the first one changes: inputs, and edges, which are False then.
pub struct Steady {
    /// Bits of edges, as masks by words of the image.
    edges: BTreeMap<u16, u32>,
    inputs: std::ops::Range<usize>,
}

impl Steady {
    /// Of a program.
    pub fn of(program: &Program<'_>) -> Self {
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
        Steady {
            edges,
            inputs: program.layout.inputs.indices(),
        }
    }

    /// Whether a bit is an input.
    pub fn is_input(&self, bit: u16) -> bool {
        self.inputs.contains(&usize::from(bit / 32))
    }

    /// Whether a bit is an edge.
    pub fn is_edge(&self, bit: u16) -> bool {
        let edges = self.edges.get(&(bit / 32));
        edges.is_some_and(|edges| edges >> (bit % 32) & 1 != 0)
    }

    /// Whether a condition depends on nothing else.
    fn decides(&self, program: &Program<'_>, condition: &Condition) -> bool {
        let is_steady = |bit| self.is_input(bit) || self.is_edge(bit);
        Trigger::when(program, condition).depends_on_none_but(is_steady, |_| false)
    }
}

/// Graphs, each with what its superiors make it do.
struct Hierarchy<'p> {
    program: &'p Program<'p>,
    graphs: &'p [&'p Activity],
    steady: Steady,
    known: Vec<Option<Moves>>,
}

/// What a graph does behind the first round; nothing is known of one that can go round.
#[derive(Clone, Copy)]
struct Moves {
    /// How often its transitions fire at most.
    firings: Option<u64>,
    /// How often its situation changes at most.
    changes: Option<u64>,
    /// Whether they fire in rounds that follow each other, from the second one on.
    at_once: bool,
}

impl Moves {
    const UNKNOWN: Moves = Moves {
        firings: None,
        changes: None,
        at_once: false,
    };
}

impl Hierarchy<'_> {
    fn moves(&mut self, graph: usize) -> Moves {
        if let Some(moves) = self.known.get(graph).copied().flatten() {
            return moves;
        }
        // Who comes back here while this is worked out is its own superior.
        self.note(graph, Moves::UNKNOWN);
        let moves = self.worked_out(graph).unwrap_or(Moves::UNKNOWN);
        self.note(graph, moves);
        moves
    }

    fn note(&mut self, graph: usize, moves: Moves) {
        if let Some(known) = self.known.get_mut(graph) {
            *known = Some(moves);
        }
    }

    fn worked_out(&mut self, graph: usize) -> Option<Moves> {
        let activity = *self.graphs.get(graph)?;
        let own = self.program.graphs.get(graph)?;
        let is_free = self.is_free(graph);
        let settling = Settling::of(self.program, own, activity, &self.steady);
        let settles = settling.firings(is_free)?;
        let stretches = self.stretches(graph);
        let firings = match settles {
            0 => Some(0),
            _ => stretches.map(|stretches| settles.saturating_mul(stretches)),
        };
        // In each stretch it may be ordered once.
        let ordered = if is_free { Some(0) } else { stretches };
        let changes = firings.zip(ordered);
        Some(Moves {
            firings,
            changes: changes.map(|(firings, ordered)| firings.saturating_add(ordered)),
            at_once: stretches == Some(1) && settling.is_steady(),
        })
    }

    /// Whether a graph is neither forced nor enclosed, ever.
    fn is_free(&self, graph: usize) -> bool {
        let mut orders = self.program.orders.iter();
        let own = self.program.graphs.get(graph);
        !orders.any(|order| usize::from(order.graph) == graph)
            && own.is_some_and(|own| self.program.role(own).enclosings.len == 0)
    }

    /// The stretches of rounds in which no superior of a graph changes: in each it is ordered into one situation, or comes
    /// to rest on its own.
    fn stretches(&mut self, graph: usize) -> Option<u64> {
        let mut stretches: u64 = 1;
        for superior in self.superiors(graph)? {
            stretches = stretches.saturating_add(self.moves(superior).changes?);
        }
        Some(stretches)
    }

    /// The graphs on whose situations it depends whether one is forced or enclosed; none are known when it depends on
    /// more.
    fn superiors(&self, graph: usize) -> Option<Vec<usize>> {
        let mut superiors = Vec::new();
        let orders = self.program.orders.iter().enumerate();
        for (row, order) in orders.filter(|(_, order)| usize::from(order.graph) == graph) {
            if !self.steady.decides(self.program, &order.condition) {
                return None;
            }
            let by = usize::from(order.by);
            let role = self.program.role(self.program.graphs.get(by)?);
            let stands_alone = [role.orders, role.self_orders];
            if !stands_alone.iter().any(|run| run.indices().contains(&row)) {
                superiors.push(by);
            }
        }
        let role = self.program.role(self.program.graphs.get(graph)?);
        for enclosing in role.enclosings.of(self.program.enclosings) {
            let word = enclosing.step.word();
            let mut graphs = self.program.graphs.iter();
            superiors.push(graphs.position(|graph| graph.words().indices().contains(&word))?);
        }
        superiors.sort_unstable();
        superiors.dedup();
        Some(superiors)
    }
}
