//! Enclosing and forcing: graphs from the top of the hierarchy down (`semantics.md`, phase 4; IEC 60848, 9.2).

use crate::bits::set_bits_of;
use crate::engine::Engine;
use crate::memory::{Memory, Standing};
use crate::program::{Armed, Bit, Compiled, Enclosing, Forced, Graph, Order, Program, Role, Run};
use crate::walk::{Visit, each};
use crate::watch::Pass;

/// Graphs of a hierarchy for each of which there is code of its own.
const FEW: usize = 4;

impl<P: Compiled, M: Memory> Engine<P, M> {
    /// Gives every graph its initial situation, an enclosed one only when an initial step encloses it.
    pub(crate) fn take_initial_situations(&mut self) {
        let tables = self.tables;
        let program = tables.program();
        for &index in program.hierarchy {
            let Some(graph) = program.graphs.get(usize::from(index)) else {
                continue;
            };
            let enclosings = program.role(graph).enclosings.of(program.enclosings);
            if enclosings.is_empty() {
                self.take(graph, graph.initial);
            } else if let Some(situation) = at_start(enclosings, |step| self.memory.bit(step)) {
                self.take(graph, situation);
            }
        }
        self.refresh_macros();
        self.memory.mark_start(&program.layout);
    }

    /// Whether a graph keeps in scan 0 what it has taken: a step that gave it was active as the scan began, and is.
    fn keeps_start(&self, enclosings: &[Enclosing]) -> bool {
        let tables = self.tables;
        let program = tables.program();
        let layout = &program.layout;
        let initially = |step| self.memory.was_initially_active(layout, step);
        at_start(enclosings, initially).is_some_and(|taken| {
            let active = |step| self.memory.bit(step) && initially(step);
            let mut steps = enclosings.iter();
            steps.any(|by| by.at_start == Some(taken) && active(by.step))
        })
    }

    /// Phase 4. False when every graph has kept to its own evolution.
    #[inline(always)]
    pub(crate) fn settle_hierarchy(&mut self, pass: Pass) -> bool {
        let tables = self.tables;
        let program = tables.program();
        let apart = program.hierarchy.len() > FEW;
        let mut bound = false;
        for index in program.hierarchy {
            bound |= if apart {
                self.settle_apart(*index, pass)
            } else {
                self.settle_and_order(*index, pass)
            };
        }
        bound
    }

    /// One graph of many, for each of which code of its own would be long.
    #[inline(never)]
    fn settle_apart(&mut self, index: u16, pass: Pass) -> bool {
        self.settle_and_order(index, pass)
    }

    /// Settles a graph and gives its orders. False when it keeps to its own evolution.
    #[inline(always)]
    fn settle_and_order(&mut self, index: u16, pass: Pass) -> bool {
        let tables = self.tables;
        let program = tables.program();
        let Some(graph) = program.graphs.get(usize::from(index)) else {
            return false;
        };
        let role = program.role(graph);
        self.watch(role.self_watches, pass);
        // An order of a superior stands against these, whose conditions are evaluated all the same.
        self.give_orders(role.self_orders);
        let bound = self.settle(graph, role, index, pass);
        self.watch(role.watches, pass);
        self.give_orders(role.orders);
        self.give_orders_of_steps(graph);
        bound
    }

    /// False when the graph keeps to its own evolution.
    #[inline(always)]
    fn settle(&mut self, graph: &Graph, role: &Role, index: u16, pass: Pass) -> bool {
        let standing = self.standing(index);
        if standing == Standing::FREE && role.enclosings.len == 0 {
            return false;
        }
        self.bind(graph, index, standing, pass)
    }

    /// Gives a graph that an order or an enclosing step may bind its situation. Kept apart, since most graphs are free.
    #[inline(never)]
    fn bind(&mut self, graph: &Graph, index: u16, standing: Standing, pass: Pass) -> bool {
        let void = self.give(graph, standing, pass);
        if void {
            self.void_fired(graph.transitions);
            self.refresh_macros_of(|graph| graph == index);
        }
        let held = standing.order() != 0 && self.is_alive(graph);
        let new = Standing::behind_round(held, void);
        if new != standing.under(0) {
            self.note_change();
        }
        self.put_standing(index, new);
        void
    }

    /// Does what the first line of phase 4 says that applies. False when the graph keeps to its own evolution, or in scan
    /// 0 to what it has taken.
    #[inline(always)]
    fn give(&mut self, graph: &Graph, standing: Standing, pass: Pass) -> bool {
        let tables = self.tables;
        let program = tables.program();
        let enclosings = program.role(graph).enclosings.of(program.enclosings);
        if !self.is_alive(graph) {
            self.empty(graph);
            return true;
        }
        if let Some(order) = tables.program().order(standing.order()) {
            match order.situation {
                Forced::Set(situation) => self.take(graph, situation),
                Forced::Current => self.take_before(graph, pass),
            }
            return true;
        }
        let keeps_start = pass == Pass::Start && self.keeps_start(enclosings);
        if !keeps_start && let Some(by) = enclosings.iter().rfind(|by| self.is_activated(by)) {
            self.take(graph, by.situation);
            return true;
        }
        if standing.is_held() {
            self.take_before(graph, pass);
            return true;
        }
        false
    }

    /// An enclosed graph is alive only while an enclosing step is active: otherwise it is empty, no order on it is
    /// valid, and none of its transitions is armed.
    pub(crate) fn is_alive(&self, graph: &Graph) -> bool {
        let tables = self.tables;
        let program = tables.program();
        let enclosings = program.role(graph).enclosings.of(program.enclosings);
        enclosings.is_empty() || enclosings.iter().any(|by| self.memory.bit(by.step))
    }

    fn is_activated(&self, by: &Enclosing) -> bool {
        let tables = self.tables;
        let program = tables.program();
        self.memory.bit(by.step) && !self.memory.was_active(&program.layout, by.step)
    }

    fn empty(&mut self, graph: &Graph) {
        for word in graph.words().indices() {
            self.set_word(word, 0);
        }
    }

    fn take(&mut self, graph: &Graph, situation: u16) {
        let tables = self.tables;
        let program = tables.program();
        for (offset, word) in graph.words().indices().enumerate() {
            let set = program.situations.get(usize::from(situation) + offset);
            self.set_word(word, set.copied().unwrap_or(0));
        }
    }

    /// `{*}` and a held graph: the situation before this scan (round); in scan 0 the initial one, which it still has.
    fn take_before(&mut self, graph: &Graph, pass: Pass) {
        let tables = self.tables;
        let program = tables.program();
        if pass == Pass::Start {
            return;
        }
        let first = graph.first_word;
        let offset = usize::from(first.saturating_sub(program.layout.situations.start));
        for (index, word) in graph.words().indices().enumerate() {
            let steps = self
                .memory
                .store
                .before()
                .get(offset + index)
                .copied()
                .unwrap_or(0);
            self.set_word(word, steps);
        }
    }

    fn set_word(&mut self, word: usize, value: u32) {
        let tables = self.tables;
        let first = usize::from(tables.program().layout.situations.start);
        let place = word.saturating_sub(first);
        if value != 0 {
            self.memory.enliven(place);
        }
        if self.memory.put_word(word, value) {
            self.memory.put_armed(place, Armed::UNKNOWN);
        }
    }

    fn give_orders_of_steps(&mut self, graph: &Graph) {
        let tables = self.tables;
        let program = tables.program();
        let steps = graph.steps.of(program.steps);
        for (offset, word) in graph.words().indices().enumerate() {
            let place = word.saturating_sub(usize::from(program.layout.situations.start));
            let forcing = program.blocks.get(place);
            let forcing = forcing.map_or(0, |block| program.masks(block).forcing);
            for bit in set_bits_of(self.memory.word(word) & forcing) {
                let step = steps.get(offset * 32 + bit);
                if let Some(duties) = step.and_then(|step| program.duties_of(step)) {
                    self.give_orders(duties.orders);
                }
            }
        }
    }

    /// Of two valid orders that of the graph taken first wins, within one graph the later statement.
    fn give_orders(&mut self, orders: Run) {
        let tables = self.tables;
        if let Some(rows) = orders.some(tables.program().orders) {
            let first = orders.start.saturating_add(1);
            each::<P, Order>(
                rows,
                &mut Giving {
                    engine: self,
                    row: first,
                },
            );
        }
    }

    fn standing(&self, graph: u16) -> Standing {
        self.memory
            .store
            .standings()
            .get(usize::from(graph))
            .copied()
            .unwrap_or(Standing::FREE)
    }

    fn put_standing(&mut self, graph: u16, standing: Standing) {
        let standings = self.memory.store.standings_mut();
        if let Some(place) = standings.get_mut(usize::from(graph)) {
            *place = standing;
        }
    }

    /// Brings the macro step bits up to date.
    pub(crate) fn refresh_macros(&mut self) {
        self.refresh_macros_of(|_| true);
    }

    /// Brings the macro step bits of some graphs up to date.
    fn refresh_macros_of(&mut self, wanted: impl Fn(u16) -> bool) {
        let tables = self.tables;
        let program = tables.program();
        for row in program.macros.iter().filter(|row| wanted(row.graph)) {
            let active = program
                .graphs
                .get(usize::from(row.graph))
                .is_some_and(|graph| self.any_active(graph, row.steps));
            self.memory.put_bit(row.bit, active);
        }
    }

    fn any_active(&self, graph: &Graph, steps: Run) -> bool {
        let first = usize::from(graph.steps.start);
        steps.indices().any(|step| {
            let place = step.saturating_sub(first);
            let word = self.memory.word(usize::from(graph.first_word) + place / 32);
            word & (1 << (place % 32)) != 0
        })
    }
}

impl Program<'_> {
    /// A row of the orders, counted from 1.
    fn order(&self, row: u16) -> Option<&Order> {
        let row = usize::from(row).checked_sub(1)?;
        self.orders.get(row)
    }
}

/// Gives orders whose conditions hold.
struct Giving<'e, P, M> {
    engine: &'e mut Engine<P, M>,
    /// The next one, counted from 1.
    row: u16,
}

impl<P: Compiled, M: Memory> Visit<Order> for Giving<'_, P, M> {
    #[inline(always)]
    fn row(&mut self, order: &Order) {
        let row = self.row;
        self.row = row.saturating_add(1);
        if !self.engine.holds(&order.condition) {
            return;
        }
        let standing = self.engine.standing(order.graph);
        let tables = self.engine.tables;
        let wins = match tables.program().order(standing.order()) {
            Some(best) => best.by == order.by && best.rank <= order.rank,
            None => true,
        };
        if wins {
            self.engine.put_standing(order.graph, standing.under(row));
        }
    }
}

/// What an active initial step gives to the graph that it encloses; of several the last in the source.
fn at_start(enclosings: &[Enclosing], active: impl Fn(Bit) -> bool) -> Option<u16> {
    let gives = |by: &&Enclosing| by.at_start.is_some() && active(by.step);
    enclosings.iter().rfind(gives).and_then(|by| by.at_start)
}
