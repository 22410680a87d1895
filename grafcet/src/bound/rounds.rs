//! How many rounds a scan of a program that evolves `stable` takes at most.

use std::collections::BTreeMap;

use grafcet_compiler::activity::Activity;
use grafcet_core::engine::MAX_ROUNDS;
use grafcet_core::program::{Bit, Condition, Evolution, Op, Program, Rest, Watch};

use super::settling::Settling;

/// The rounds of one scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rounds {
    /// It has none: one firing a scan.
    One,
    /// The first, and behind it one for each of so many firings and one in which nothing fires any more.
    Settle {
        /// Firings behind the first round at most.
        firings: u32,
    },
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
        let mut hierarchy = Hierarchy {
            program,
            graphs,
            steady: Steady::of(program),
            changes: vec![Changes::Unknown; graphs.len()],
        };
        let firings: Option<u64> = (0..graphs.len())
            .map(|graph| hierarchy.changes(graph).map(|(firings, _)| firings))
            .try_fold(0, |sum: u64, firings| Some(sum.saturating_add(firings?)));
        let firings = firings.and_then(|firings| u32::try_from(firings).ok());
        match firings.filter(|firings| *firings < MAX_ROUNDS - 2) {
            Some(firings) => Rounds::Settle { firings },
            None => Rounds::Limit,
        }
    }

    /// As a number.
    #[must_use]
    pub fn most(self) -> u32 {
        match self {
            Rounds::One => 1,
            Rounds::Settle { firings } => firings + 2,
            Rounds::Limit => MAX_ROUNDS,
        }
    }
}

/// What no round behind the first one changes: inputs, and edges, which are False then.
pub struct Steady {
    /// Bits of edges, as masks by words of the image.
    pub edges: BTreeMap<u16, u32>,
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

    /// Whether a condition depends on nothing else.
    fn decides(&self, program: &Program<'_>, condition: &Condition) -> bool {
        let steady = |bits: u32, word: u16| {
            let edges = self.edges.get(&word).copied().unwrap_or(0);
            self.is_input(word * 32) || bits & !edges == 0
        };
        let mut terms = condition.terms.of(program.terms).iter();
        let rest = match condition.rest {
            Rest::None => true,
            Rest::Elapsed(_) | Rest::Running(_) => false,
            Rest::Code(row) | Rest::Logic(row) => {
                let code = program.codes.get(usize::from(row)).copied();
                let ops = code.and_then(|code| {
                    let start = code.start as usize;
                    program.ops.get(start..start + usize::from(code.len))
                });
                ops.unwrap_or_default().iter().all(|op| match op {
                    Op::Bit(Bit(bit)) => steady(1 << (bit % 32), bit / 32),
                    Op::Constant(_) | Op::Not | Op::And | Op::Or | Op::Xor => true,
                    _ => false,
                })
            }
        };
        rest && terms.all(|term| steady(term.mask, term.word))
    }
}

/// Graphs, each with what its superiors make it do.
struct Hierarchy<'p> {
    program: &'p Program<'p>,
    graphs: &'p [&'p Activity],
    steady: Steady,
    changes: Vec<Changes>,
}

#[derive(Clone, Copy)]
enum Changes {
    Unknown,
    /// They are being worked out: a graph that comes back here is its own superior.
    Begun,
    Known(Option<(u64, u64)>),
}

impl Hierarchy<'_> {
    /// Of a graph, behind the first round: how often its transitions fire, and how often its situation changes; none is
    /// known when it can go round.
    fn changes(&mut self, graph: usize) -> Option<(u64, u64)> {
        match self.changes.get(graph)? {
            Changes::Known(changes) => return *changes,
            Changes::Begun => return None,
            Changes::Unknown => {}
        }
        *self.changes.get_mut(graph)? = Changes::Begun;
        let changes = self.worked_out(graph);
        *self.changes.get_mut(graph)? = Changes::Known(changes);
        changes
    }

    fn worked_out(&mut self, graph: usize) -> Option<(u64, u64)> {
        let activity = *self.graphs.get(graph)?;
        let settling = Settling::of(self.program, activity, &self.steady);
        let settles = settling.firings()?;
        let superiors = self.superiors(graph)?;
        if superiors.is_empty() {
            return Some((settles, settles));
        }
        // While no superior changes, it is ordered into one situation, or comes to rest on its own.
        let mut stretches: u64 = 1;
        for superior in superiors {
            stretches = stretches.saturating_add(self.changes(superior)?.1);
        }
        let firings = settles.saturating_mul(stretches);
        Some((firings, firings.saturating_add(stretches)))
    }

    /// The graphs that force or enclose one; none are known when an order depends on more than their situations.
    fn superiors(&self, graph: usize) -> Option<Vec<usize>> {
        let mut superiors = Vec::new();
        let orders = self.program.orders.iter();
        for order in orders.filter(|order| usize::from(order.graph) == graph) {
            if !self.steady.decides(self.program, &order.condition) {
                return None;
            }
            superiors.push(usize::from(order.by));
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
