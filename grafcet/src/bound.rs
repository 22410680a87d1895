//! An upper bound of the instructions of one scan, from the compiled tables.
//!
//! It is a sum: what every scan does, and for each graph the most that can be active in it together. What single rows
//! cost was counted on images of many programs (`docs/src/speed.md`, "Worst case known"); the sum leaves out what never
//! happens together only as far as structure and contradicting triggers show it.

mod graph;
mod report;
mod rounds;
mod rows;
mod settling;
#[cfg(test)]
mod tests;
pub mod work;

use std::collections::BTreeSet;

use grafcet_compiler::activity::Activity;
use grafcet_compiler::application::{Unit, VariableSymbol};
use grafcet_compiler::emit::FEW;
use grafcet_compiler::model::DeclarationKind;
use grafcet_core::program::{Block, Evolution, GROUP, Program, Slot, Step};

use graph::{Acting, Part};
pub use report::{Clocks, json, text};
pub use rounds::Rounds;
use rows::Rows;
use work::{Cpu, Kind, Work};

/// The bound of one processor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bound {
    /// Whose.
    pub cpu: Cpu,
    /// What it is made of: what every scan does, then the graphs in source order.
    pub shares: Vec<Share>,
    /// Rounds of a scan. All shares count in the first one; in those behind it, too, unless it is known how many firings
    /// there are.
    pub rounds: Rounds,
    /// What each round does behind the first one, firings excepted, where it is known how many there are.
    pub quiet: Work,
    /// The most that all firings do there.
    pub firings: Work,
    /// What is done once behind all rounds; nothing unless the program evolves `stable`.
    pub end: Work,
}

/// Part of a bound.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Share {
    /// What it is.
    pub of: Sharer,
    /// Its work in a scan, or in a round.
    pub work: Work,
}

/// Whose a share is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Sharer {
    /// What is done whatever is active.
    Always,
    /// A graph, by its index, with the rows of its steps that are active when it takes the most.
    Graph(usize, Vec<usize>),
}

impl Bound {
    /// Of a controller, on each of [`Cpu::ALL`].
    #[must_use]
    pub fn of(unit: &Unit) -> [Bound; Cpu::ALL.len()] {
        let program = unit.tables.program();
        let rows = Rows::of(&program);
        let graphs = program.graphs.iter().enumerate();
        let graphs = graphs.map(|(index, graph)| Acting {
            rows,
            graph,
            activity: Activity::of(&program, index, graph),
        });
        let graphs: Vec<Acting<'_>> = graphs.collect();
        let activities: Vec<&Activity> = graphs.iter().map(|graph| &graph.activity).collect();
        let lanes = Work::of(Kind::Lane, lanes(&unit.symbols.variables));
        let parts = Parts {
            evolution: program.evolution,
            rounds: Rounds::of(&program, &activities),
            once: once(rows) + lanes + walks(rows, &graphs, Walks::Scan),
            repeated: repeated(rows, marked(rows, &graphs)) + walks(rows, &graphs, Walks::Round),
            graphs,
        };
        Cpu::ALL.map(|cpu| Bound::on(cpu, &parts))
    }

    fn on(cpu: Cpu, parts: &Parts<'_>) -> Self {
        let Parts { graphs, rounds, .. } = parts;
        let (once, repeated) = (parts.once.clone(), parts.repeated.clone());
        let mut quiet = Work::NONE;
        let mut firings = Work::NONE;
        let (part, always, end) = match parts.evolution {
            Evolution::Scan => (Part::Scan, repeated + once, Work::NONE),
            Evolution::Stable => {
                let always = repeated + Work::one(Kind::Round);
                quiet += always.clone();
                for graph in graphs {
                    quiet += graph.most(Part::Quiet, cpu).work + graph.sources(Part::Quiet, cpu);
                }
                if let Rounds::Settle { firings: each, .. } = rounds {
                    let each = graphs.iter().zip(each);
                    firings = each.map(|(graph, times)| graph.later(cpu) * *times).sum();
                }
                let ends = graphs.iter().map(|graph| graph.most(Part::End, cpu).work);
                (Part::Round, always, once + ends.sum())
            }
        };
        let mut shares = vec![Share {
            of: Sharer::Always,
            work: always,
        }];
        for (index, graph) in graphs.iter().enumerate() {
            let most = graph.most(part, cpu);
            let first = usize::from(graph.graph.steps.start);
            let steps = most.steps.iter().map(|step| first + step).collect();
            shares.push(Share {
                of: Sharer::Graph(index, steps),
                work: most.work + graph.sources(part, cpu),
            });
        }
        Bound {
            cpu,
            shares,
            rounds: rounds.clone(),
            quiet,
            firings,
            end,
        }
    }

    /// Instructions of the first round, or of the scan when it has none.
    #[must_use]
    pub fn round(&self) -> u64 {
        let shares = self.shares.iter().map(|share| share.work.clone());
        shares.sum::<Work>().instructions(self.cpu)
    }

    /// All that a scan does.
    #[must_use]
    pub fn work(&self) -> Work {
        let shares = self.shares.iter().map(|share| share.work.clone());
        let first: Work = shares.sum();
        let rounds = u64::from(self.rounds.most());
        let rounds = match self.rounds {
            Rounds::One | Rounds::Limit => first * rounds,
            Rounds::Settle { .. } => {
                first + self.quiet.clone() * (rounds - 1) + self.firings.clone()
            }
        };
        rounds + self.end.clone()
    }

    /// Instructions of a scan at most.
    #[must_use]
    pub fn instructions(&self) -> u64 {
        self.work().instructions(self.cpu)
    }
}

/// What is the same on all processors.
struct Parts<'p> {
    graphs: Vec<Acting<'p>>,
    evolution: Evolution,
    rounds: Rounds,
    /// What is done once in a scan, whatever is active.
    once: Work,
    /// What is done once in a round.
    repeated: Work,
}

/// What is done once in a scan, beside walks over steps.
fn once(rows: Rows<'_>) -> Work {
    let program = rows.program;
    let shown = match program.layout.momentary.len {
        1 => 0,
        words => usize::from(words),
    };
    let dependent = program.dependent.iter();
    let dependent =
        dependent.map(|row| Work::one(Kind::Dependent) + rows.shown(&row.statement, false));
    Work::one(Kind::Scan)
        + rows.watches(program.round_watches, true)
        + rows.watches(program.action_watches, true)
        + rows.stored(program.always_stored)
        + rows.momentary(program.always_momentary)
        + dependent.sum()
        + Work::of(Kind::Shown, shown)
}

/// What is done once in a round, beside walks over steps.
fn repeated(rows: Rows<'_>, marked: usize) -> Work {
    let program = rows.program;
    let marks = match program.layout.fired {
        1 => 0,
        _ => marked,
    };
    let searches = usize::from(program.stores_on_change)
        + 2 * usize::from(!program.links.is_empty())
        + usize::from(program.evolution == Evolution::Stable);
    let inner = program.macros.iter().map(|it| usize::from(it.steps.len));
    let standings = match program.layout.standings {
        0 => Work::NONE,
        _ => program
            .graphs
            .iter()
            .map(|graph| rows.standing(graph))
            .sum(),
    };
    Work::of(Kind::Edges, program.edges.len())
        + rows.watches(program.trigger_watches, true)
        + Work::of(Kind::Marks, marks)
        + Work::of(Kind::Search, marked * searches)
        + Work::of(Kind::Macro, program.macros.len())
        + Work::of(Kind::Inner, inner.sum())
        + standings
}

/// Which walks over steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Walks {
    /// Those of a round.
    Round,
    /// Those of a scan, behind all rounds.
    Scan,
}

impl Walks {
    /// The steps for which each of the walks has something to do; none when it passes every word all the same.
    fn masks(self, program: &Program<'_>, block: &Block) -> Vec<u32> {
        let timed = program.layout.stamps + program.layout.since > 0;
        let does = program.masks(block);
        let masks = match self {
            Walks::Round => [
                (true, arming(program, block)),
                (true, 0),
                (timed, does.timed),
                (!program.events.is_empty(), does.on_event),
                (program.stores_on_change, does.on_deactivation),
                (program.stores_on_change, does.on_activation),
            ]
            .to_vec(),
            Walks::Scan => [
                (program.lasting_in_steps, does.stored),
                (true, block.momentary),
            ]
            .to_vec(),
        };
        let masks = masks.iter().enumerate();
        masks
            .filter(|(place, (walks, mask))| {
                *walks && (*mask != 0 || self == Walks::Round && *place < 2)
            })
            .map(|(_, (_, mask))| *mask)
            .collect()
    }
}

/// The steps of a word that arm transitions.
fn arming(program: &Program<'_>, block: &Block) -> u32 {
    let steps = program.steps.get(usize::from(block.first)..);
    let next = program.blocks.iter().map(|it| it.first);
    let next = next.filter(|first| *first > block.first).min();
    let count = next.map_or(32, |next| usize::from(next - block.first));
    let arms = |(bit, step): (usize, &Step)| u32::from(step.arm_count > 0) << bit;
    let steps = steps.unwrap_or_default().iter().take(count.min(32));
    steps.enumerate().map(arms).sum()
}

/// What passing over all steps takes, whatever they do.
fn walks(rows: Rows<'_>, graphs: &[Acting<'_>], walks: Walks) -> Work {
    let program = rows.program;
    if rows.unrolled {
        let blocks = program.blocks.iter();
        let masks = blocks.flat_map(|block| walks.masks(program, block));
        let groups = |mask: u32| (0..32 / FEW).filter(move |it| mask >> (it * FEW) & 0xf != 0);
        return masks
            .map(|mask| Work::one(Kind::Word) + Work::of(Kind::Sleepers, groups(mask).count()))
            .sum();
    }
    // On one of the walks these are followed.
    let followed = graphs.iter().filter(|graph| graph.is_followed()).count();
    let count = match walks {
        Walks::Scan => 1 + usize::from(program.lasting_in_steps),
        Walks::Round => {
            1 + usize::from(!program.crosses_at_once)
                + usize::from(program.layout.stamps + program.layout.since > 0)
                + usize::from(!program.events.is_empty())
                + 2 * usize::from(program.stores_on_change)
        }
    };
    Work::of(Kind::WordLooped, lively(program, graphs) * count - followed)
        + Work::of(Kind::Sets, usize::from(program.layout.sets) * count)
}

/// Words of situations in groups of which one can hold an active step.
fn lively(program: &Program<'_>, graphs: &[Acting<'_>]) -> usize {
    let first = usize::from(program.layout.situations.start);
    let words = graphs.iter().filter(|graph| graph.can_be_active());
    let words = words.flat_map(|acting| acting.graph.words().indices());
    in_groups(words.map(|word| word - first))
}

/// Words of transitions that are looked at: in a large program those in groups of which one can fire.
fn marked(rows: Rows<'_>, graphs: &[Acting<'_>]) -> usize {
    if rows.unrolled {
        return usize::from(rows.program.layout.fired);
    }
    let transitions = graphs.iter().filter(|graph| graph.can_be_active());
    let transitions = transitions.flat_map(|acting| acting.graph.transitions.indices());
    in_groups(transitions.map(|transition| transition / 32))
}

fn in_groups(words: impl Iterator<Item = usize>) -> usize {
    let groups: BTreeSet<usize> = words.map(|word| word / GROUP).collect();
    groups.len() * GROUP
}

/// Runs of outputs, of the first 32, that are neighbours in a word of the image.
fn lanes(variables: &[VariableSymbol]) -> usize {
    let outputs = variables.iter().filter_map(|variable| match variable.slot {
        Slot::Bit(bit) if variable.kind == DeclarationKind::Output => Some(bit.0),
        _ => None,
    });
    let outputs: Vec<u16> = outputs.take(32).collect();
    let breaks = outputs.windows(2).filter(|pair| match pair {
        [one, next] => *next != one + 1 || next % 32 == 0,
        _ => false,
    });
    usize::from(!outputs.is_empty()) + breaks.count()
}
