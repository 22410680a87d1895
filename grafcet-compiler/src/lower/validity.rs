//! What every set of tables keeps: indices in range, bits within the image, the stack deep enough.

use grafcet_core::program::{
    Assignment, Bit, Code, Condition, Forced, Momentary, Number, Op, Run, Slot, Stamp, Watch,
};

use crate::application::Tables;

/// A table that breaks its own rules: a defect of the compiler.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Which table or field.
    pub table: &'static str,
    /// Which row.
    pub row: usize,
}

/// Checks tables; the engine relies on what is checked here.
pub fn check(tables: &Tables) -> Result<(), Fault> {
    let checker = Checker { tables };
    checker.layout()?;
    checker.structure()?;
    checker.actions()?;
    checker.watches()?;
    checker.values()
}

struct Checker<'t> {
    tables: &'t Tables,
}

fn demand(right: bool, table: &'static str, row: usize) -> Result<(), Fault> {
    if right {
        Ok(())
    } else {
        Err(Fault { table, row })
    }
}

fn within(run: Run, len: usize) -> bool {
    run.indices().end <= len
}

impl Checker<'_> {
    fn layout(&self) -> Result<(), Fault> {
        let layout = &self.tables.layout;
        let words = usize::from(layout.words);
        let runs = [
            layout.inputs,
            layout.situations,
            layout.macros,
            layout.momentary,
            layout.outside,
        ];
        for (row, run) in runs.into_iter().enumerate() {
            demand(
                within(run, words) && (run.len == 0 || run.start > 0),
                "layout",
                row,
            )?;
        }
        let mut ends: Vec<_> = runs
            .iter()
            .filter(|run| run.len > 0)
            .map(|run| run.indices())
            .collect();
        ends.sort_by_key(|range| range.start);
        let apart = ends.windows(2).all(|pair| pair[0].end <= pair[1].start);
        demand(apart, "layout", runs.len())?;
        let numbers = self.tables.numbers.len();
        demand(
            usize::from(layout.numbers) == numbers && within(layout.number_inputs, numbers),
            "numbers",
            0,
        )?;
        demand(
            usize::from(layout.outside.len) * 32 >= usize::from(layout.number_inputs.len),
            "outside",
            0,
        )?;
        demand(
            usize::from(layout.fired) * 32 >= self.tables.transitions.len(),
            "fired",
            0,
        )
    }

    fn structure(&self) -> Result<(), Fault> {
        let tables = self.tables;
        for (row, graph) in tables.graphs.iter().enumerate() {
            let own = usize::from(graph.words.len) * 32 >= usize::from(graph.steps.len)
                && graph
                    .words
                    .indices()
                    .all(|word| tables.layout.situations.indices().contains(&word));
            let right = own
                && within(graph.steps, tables.steps.len())
                && within(graph.transitions, tables.transitions.len())
                && within(graph.sources, tables.armed_by.len())
                && within(graph.enclosings, tables.enclosings.len())
                && within(graph.orders, tables.orders.len())
                && within(graph.self_orders, tables.orders.len())
                && within(graph.watches, tables.watches.len())
                && within(graph.self_watches, tables.watches.len())
                && self.situation(graph.initial, row);
            demand(right, "graphs", row)?;
            for enclosing in graph.enclosings.of(&tables.enclosings) {
                let right = self.step(enclosing.step)
                    && self.situation(enclosing.situation, row)
                    && enclosing
                        .at_start
                        .is_none_or(|situation| self.situation(situation, row));
                demand(right, "enclosings", row)?;
            }
        }
        let mut hierarchy = tables.hierarchy.clone();
        hierarchy.sort_unstable();
        let every_graph = hierarchy
            .iter()
            .map(|graph| usize::from(*graph))
            .eq(0..tables.graphs.len());
        demand(every_graph, "hierarchy", 0)?;
        for (row, step) in tables.steps.iter().enumerate() {
            let right = within(step.transitions, tables.armed_by.len())
                && within(step.momentary, tables.momentary.len())
                && within(step.stored, tables.stored.len())
                && within(step.on_activation, tables.stored.len())
                && within(step.on_deactivation, tables.stored.len())
                && within(step.on_event, tables.events.len())
                && within(step.orders, tables.orders.len())
                && step.activated.is_none_or(|stamp| self.stamp(stamp));
            demand(right, "steps", row)?;
        }
        for (row, outer) in tables.macros.iter().enumerate() {
            let right = tables.layout.macros.indices().contains(&outer.bit.word())
                && usize::from(outer.graph) < tables.graphs.len()
                && within(outer.steps, tables.steps.len())
                && outer.activated.is_none_or(|stamp| self.stamp(stamp));
            demand(right, "macros", row)?;
        }
        for (row, transition) in tables.transitions.iter().enumerate() {
            let links = [transition.entrance, transition.exit];
            let right = links.into_iter().all(|run| {
                within(run, tables.links.len())
                    && run.of(&tables.links).iter().all(|bit| self.step(*bit))
            });
            demand(
                right && self.condition(transition.trigger),
                "transitions",
                row,
            )?;
            demand(
                within(transition.actions, tables.stored.len()),
                "transitions",
                row,
            )?;
        }
        for (row, transition) in tables.armed_by.iter().enumerate() {
            demand(
                usize::from(*transition) < tables.transitions.len(),
                "armed_by",
                row,
            )?;
        }
        Ok(())
    }

    fn actions(&self) -> Result<(), Fault> {
        let tables = self.tables;
        for (row, order) in tables.orders.iter().enumerate() {
            let graph = usize::from(order.graph);
            let situation = match order.situation {
                Forced::Set(first) => self.situation(first, graph),
                Forced::Current => true,
            };
            let right = graph < tables.graphs.len() && situation && self.condition(order.condition);
            demand(right, "orders", row)?;
        }
        for (row, stored) in tables.stored.iter().enumerate() {
            let right = match stored.assignment {
                Assignment::Bit(bit, value) => self.bit(bit) && self.condition(value),
                Assignment::Number(number, value) => self.number(number) && self.code(value),
            };
            demand(right && self.condition(stored.condition), "stored", row)?;
        }
        for (row, event) in tables.events.iter().enumerate() {
            let right = self.bit(event.event) && within(event.stored, tables.stored.len());
            demand(right, "events", row)?;
        }
        for (row, momentary) in tables.momentary.iter().enumerate() {
            demand(self.momentary(momentary), "momentary", row)?;
        }
        for (row, dependent) in tables.dependent.iter().enumerate() {
            let owner = dependent.owner.is_none_or(|owner| self.step(owner));
            demand(
                owner && self.momentary(&dependent.statement),
                "dependent",
                row,
            )?;
        }
        demand(
            within(tables.always_stored, tables.stored.len()),
            "always_stored",
            0,
        )?;
        demand(
            within(tables.always_momentary, tables.momentary.len()),
            "always_momentary",
            0,
        )
    }

    fn momentary(&self, momentary: &Momentary) -> bool {
        let tables = self.tables;
        let targets = momentary.targets.of(&tables.links);
        let cleared = tables.layout.momentary.indices();
        within(momentary.targets, tables.links.len())
            && targets.iter().all(|bit| cleared.contains(&bit.word()))
            && self.condition(momentary.condition)
    }

    fn watches(&self) -> Result<(), Fault> {
        let tables = self.tables;
        let runs = [
            tables.trigger_watches,
            tables.round_watches,
            tables.action_watches,
        ];
        for (row, run) in runs.into_iter().enumerate() {
            demand(within(run, tables.watches.len()), "watch runs", row)?;
        }
        for (row, watch) in tables.watches.iter().enumerate() {
            let right = match *watch {
                Watch::Edge {
                    operand,
                    last,
                    result,
                    ..
                } => self.condition(operand) && self.bit(last) && self.bit(result),
                Watch::Timer {
                    enable: condition,
                    preset: time,
                    last,
                    risen: stamp,
                    result,
                    ..
                }
                | Watch::OnDelay {
                    enable: condition,
                    delay: time,
                    last,
                    risen: stamp,
                    result,
                }
                | Watch::OffDelay {
                    on: condition,
                    hold: time,
                    last,
                    fallen: stamp,
                    result,
                } => {
                    self.condition(condition)
                        && self.code(time)
                        && self.bit(last)
                        && self.stamp(stamp)
                        && self.bit(result)
                }
                Watch::Value {
                    condition,
                    gate,
                    result,
                } => {
                    self.condition(condition)
                        && gate.is_none_or(|gate| self.step(gate))
                        && self.bit(result)
                }
            };
            demand(right, "watches", row)?;
        }
        Ok(())
    }

    fn values(&self) -> Result<(), Fault> {
        let tables = self.tables;
        for (row, term) in tables.terms.iter().enumerate() {
            let right = term.word < tables.layout.words && term.state & !term.mask == 0;
            demand(right, "terms", row)?;
        }
        for (row, number) in tables.numbers.iter().enumerate() {
            let right = number.min <= number.initial && number.initial <= number.max;
            demand(right, "numbers", row)?;
        }
        for (row, bit) in tables.initially_true.iter().enumerate() {
            demand(self.bit(*bit), "initially_true", row)?;
        }
        for (row, retained) in tables.retained.iter().enumerate() {
            let right = match retained.slot {
                Slot::Bit(bit) => self.bit(bit),
                Slot::Number(number) => self.number(number),
            };
            demand(right, "retained", row)?;
        }
        Ok(())
    }

    fn bit(&self, bit: Bit) -> bool {
        bit.word() < usize::from(self.tables.layout.words)
    }

    fn step(&self, bit: Bit) -> bool {
        self.tables
            .layout
            .situations
            .indices()
            .contains(&bit.word())
    }

    fn number(&self, number: Number) -> bool {
        usize::from(number.0) < self.tables.numbers.len()
    }

    fn stamp(&self, stamp: Stamp) -> bool {
        stamp.0 < self.tables.layout.stamps
    }

    /// Whether a situation of a graph lies within the table.
    fn situation(&self, first: u16, graph: usize) -> bool {
        let words = self
            .tables
            .graphs
            .get(graph)
            .map_or(usize::MAX, |graph| usize::from(graph.words.len));
        usize::from(first).saturating_add(words) <= self.tables.situations.len()
    }

    fn condition(&self, condition: Condition) -> bool {
        match condition {
            Condition::Always => true,
            Condition::All(run) => run.len > 0 && within(run, self.tables.terms.len()),
            Condition::Code(code) => self.code(code),
        }
    }

    /// Whether code stays within its table, its operands and its stack, and leaves one value.
    fn code(&self, code: Code) -> bool {
        let start = code.start as usize;
        let Some(ops) = self.tables.ops.get(start..start + usize::from(code.len)) else {
            return false;
        };
        let mut depth = 0_usize;
        for op in ops {
            let (taken, right) = match *op {
                Op::Constant(_) => (0, true),
                Op::Bit(bit) => (0, self.bit(bit)),
                Op::Number(number) => (0, self.number(number)),
                Op::Not | Op::Negate => (1, true),
                Op::StepTimer {
                    step, activated, ..
                } => (1, self.bit(step) && self.stamp(activated)),
                _ => (2, true),
            };
            if !right || depth < taken {
                return false;
            }
            depth = depth - taken + 1;
            if depth > usize::from(self.tables.layout.stack) {
                return false;
            }
        }
        depth == 1
    }
}
