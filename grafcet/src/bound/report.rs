//! A bound as people and as programs read it.

use std::fmt::Write;

use grafcet_compiler::application::{Symbols, Unit};
use serde_json::json;

use super::work::{Cpu, Work};
use super::{Bound, Rounds, Sharer};
use crate::table::Table;

/// Cycles of an instruction, on average over a scan, at most.
const CYCLES: u64 = 2;
/// Graphs that are named one by one.
const NAMED: usize = 5;

/// Clocks of the processors, in MHz.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Clocks {
    /// Of the Cortex-M0+.
    pub m0plus: u32,
    /// Of the Cortex-M4.
    pub m4: u32,
}

impl Clocks {
    fn of(self, cpu: Cpu) -> u64 {
        u64::from(match cpu {
            Cpu::M0plusFlashed | Cpu::M0plus => self.m0plus,
            Cpu::M4 => self.m4,
        })
    }

    /// Microseconds that so many instructions take at most, rounded up.
    #[must_use]
    pub fn microseconds(self, cpu: Cpu, instructions: u64) -> u64 {
        (instructions * CYCLES).div_ceil(self.of(cpu).max(1))
    }
}

/// As one JSON object.
#[must_use]
pub fn json(unit: &Unit, clocks: Clocks) -> serde_json::Value {
    let bounds = Bound::of(unit).map(|bound| {
        let cpu = bound.cpu;
        let shares = bound.shares.iter().map(|share| {
            let (name, steps) = names(&unit.symbols, &share.of);
            json!({
                "of": name,
                "steps": steps,
                "instructions": share.work.instructions(cpu),
            })
        });
        let work = bound.work();
        let work = work
            .counts()
            .map(|(kind, count)| (format!("{kind:?}"), count.into()));
        let value = json!({
            "instructions": bound.instructions(),
            "microseconds": clocks.microseconds(cpu, bound.instructions()),
            "mhz": clocks.of(cpu),
            "rounds": bound.rounds.most(),
            "a_round": bound.round(),
            "a_later_round": bound.quiet.instructions(cpu),
            "later_firings": bound.firings.instructions(cpu),
            "shares": shares.collect::<Vec<_>>(),
            "work": work.collect::<serde_json::Map<_, _>>(),
        });
        (cpu.id().to_owned(), value)
    });
    serde_json::Value::Object(bounds.into_iter().collect())
}

/// A small table, and what the figures are made of.
#[must_use]
pub fn text(unit: &Unit, clocks: Clocks) -> String {
    let bounds = Bound::of(unit);
    let period_us = u64::from(unit.tables.period_ms) * 1000;
    let took = |bound: &Bound| clocks.microseconds(bound.cpu, bound.instructions());
    let mut table = Table::default();
    let mut column = |name: &str, cell: &dyn Fn(&Bound) -> String| {
        table.column(name, bounds.iter().map(cell));
    };
    column("CPU", &|bound| bound.cpu.name().to_owned());
    column("instructions", &|bound| bound.instructions().to_string());
    column("MHz", &|bound| clocks.of(bound.cpu).to_string());
    column("us", &|bound| took(bound).to_string());
    column("of the period", &|bound| share(took(bound), period_us));
    let mut text = format!("one scan takes at most\n\n{table}");
    text += "\nof it, in instructions\n\n";
    let mut made = Table::default();
    let rows = rows(unit, &bounds);
    made.column("", rows.iter().map(|(name, _)| name.clone()));
    for (place, cpu) in Cpu::ALL.iter().enumerate() {
        let cells = rows
            .iter()
            .map(|(_, cells)| cells.get(place).map_or(String::new(), u64::to_string));
        made.column(cpu.name(), cells);
    }
    let _ = write!(text, "{made}");
    let [bound, ..] = &bounds;
    text + &rounds(bound)
}

/// What a bound is made of, with instructions on each processor.
fn rows(unit: &Unit, bounds: &[Bound]) -> Vec<(String, Vec<u64>)> {
    let mut rows: Vec<(String, Vec<u64>)> = Vec::new();
    let Some(first) = bounds.first() else {
        return rows;
    };
    for (place, share) in first.shares.iter().enumerate() {
        let of = |bound: &Bound| {
            let share = bound.shares.get(place);
            share.map_or(0, |share| share.work.instructions(bound.cpu))
        };
        let (name, steps) = names(&unit.symbols, &share.of);
        let name = match steps.is_empty() {
            true => name,
            false => format!("{name} in {}", listed(&steps)),
        };
        rows.push((name, bounds.iter().map(of).collect()));
    }
    let (always, graphs) = rows.split_at_mut(1);
    graphs.sort_by_key(|(_, cells)| std::cmp::Reverse(cells.first().copied()));
    let mut shown = always.to_vec();
    shown.extend(graphs.iter().take(NAMED).cloned());
    let rest = graphs.get(NAMED..).unwrap_or_default();
    if !rest.is_empty() {
        let sum = |place: usize| rest.iter().filter_map(|(_, cells)| cells.get(place)).sum();
        let sums = (0..bounds.len()).map(sum).collect();
        shown.push((format!("{} more graphs", rest.len()), sums));
    }
    let mut row = |name: &str, work: fn(&Bound) -> &Work| {
        let cells = bounds.iter().map(|it| work(it).instructions(it.cpu));
        shown.push((name.to_owned(), cells.collect()));
    };
    if let Rounds::Settle { .. } = first.rounds {
        row("a round behind the first", |bound| &bound.quiet);
        row("all firings in those", |bound| &bound.firings);
    }
    if first.rounds != Rounds::One {
        row("behind the last round", |bound| &bound.end);
    }
    shown
}

fn rounds(bound: &Bound) -> String {
    match &bound.rounds {
        Rounds::One => String::new(),
        Rounds::Settle { rounds, .. } => format!(
            "\nThe program evolves stable: {rounds} rounds at most, since what fires behind the first one leads to steps\n\
             that are not left in the same scan. The shares are of the first round.\n"
        ),
        Rounds::Limit => format!(
            "\nThe program evolves stable, and nothing in its structure ends a scan before the {} rounds after which it\n\
             counts as unstable: the figures are of a scan with so many. The shares are of one round.\n",
            bound.rounds.most()
        ),
    }
}

/// What a share is called, and the steps in which it is the most.
fn names(symbols: &Symbols, sharer: &Sharer) -> (String, Vec<String>) {
    match sharer {
        Sharer::Always => ("whatever is active".to_owned(), Vec::new()),
        Sharer::Graph(index, steps) => {
            let before = symbols.graphs.iter().take(*index);
            let before: usize = before.map(|graph| graph.steps.len()).sum();
            let Some(graph) = symbols.graphs.get(*index) else {
                return (String::new(), Vec::new());
            };
            let id = |row: &usize| Some(graph.steps.get(row.checked_sub(before)?)?.id.clone());
            (graph.name.clone(), steps.iter().filter_map(id).collect())
        }
    }
}

/// The first steps of a situation.
fn listed(steps: &[String]) -> String {
    let noun = match steps.len() {
        1 => "step",
        _ => "steps",
    };
    match steps.get(..NAMED) {
        Some(first) if steps.len() > NAMED => {
            format!(
                "{noun} {} and {} more",
                first.join(", "),
                steps.len() - NAMED
            )
        }
        _ => format!("{noun} {}", steps.join(", ")),
    }
}

/// In percent, one figure behind the point.
fn share(part: u64, whole: u64) -> String {
    let tenths = (part * 1000).div_ceil(whole.max(1));
    format!("{}.{} %", tenths / 10, tenths % 10)
}
