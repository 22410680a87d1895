//! Table by table, row by row.

use crate::program::{
    Assignment, Bit, Duties, Edges, Evolution, Forced, Momentary, Order, Program, Role, Run, Seen,
    Watch,
};

impl Program<'_> {
    pub(super) const fn numbers_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.numbers.len() {
            let row = &self.numbers[i];
            if row.min > row.initial || row.initial > row.max {
                return false;
            }
            i += 1;
        }
        self.numbers.len() == self.layout.numbers as usize
    }

    /// Whether roles stay within their tables, and the first is none.
    pub(super) const fn roles_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.roles.len() {
            let role = &self.roles[i];
            let sound = role.sources.is_within(self.arms.len())
                && role.enclosings.is_within(self.enclosings.len())
                && role.orders.is_within(self.orders.len())
                && role.self_orders.is_within(self.orders.len())
                && role.watches.is_within(self.watches.len())
                && role.self_watches.is_within(self.watches.len());
            if !sound || (i == 0 && is_one(role)) {
                return false;
            }
            i += 1;
        }
        true
    }

    pub(super) const fn steps_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.steps.len() {
            let step = &self.steps[i];
            let sound = step.arms().is_within(self.arms.len())
                && step.momentary().is_within(self.momentary.len())
                && (step.duties as usize) < self.duties.len();
            if !sound {
                return false;
            }
            i += 1;
        }
        let mut g = 0;
        while g < self.graphs.len() {
            let graph = &self.graphs[g];
            if !self.blocks_name_what_acts(graph) {
                return false;
            }
            g += 1;
        }
        true
    }

    pub(super) const fn duties_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.duties.len() {
            let row = &self.duties[i];
            let sound = row.stored.is_within(self.stored.len())
                && (row.stored.len == 0 || self.lasting_in_steps)
                && ((row.on_activation.len == 0 && row.on_deactivation.len == 0)
                    || self.stores_on_change)
                && row.on_activation.is_within(self.stored.len())
                && row.on_deactivation.is_within(self.stored.len())
                && row.on_event.is_within(self.events.len())
                && row.orders.is_within(self.orders.len())
                && self.optional_stamp_is_sound(row.activated)
                && match row.since {
                    Some(since) => since.0 < self.layout.since,
                    None => true,
                };
            // Row 0 is never looked at.
            if !sound || (i == 0 && does_something(row)) {
                return false;
            }
            i += 1;
        }
        true
    }

    pub(super) const fn macros_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.macros.len() {
            let row = &self.macros[i];
            if row.graph as usize >= self.graphs.len() {
                return false;
            }
            let steps = self.graphs[row.graph as usize].steps;
            let sound = self.layout.macros.holds(row.bit.word())
                && row.steps.start >= steps.start
                && row.steps.end() <= steps.end()
                && self.optional_stamp_is_sound(row.activated);
            if !sound {
                return false;
            }
            i += 1;
        }
        true
    }

    pub(super) const fn enclosings_are_sound(&self) -> bool {
        let mut g = 0;
        while g < self.graphs.len() {
            let graph = &self.graphs[g];
            let enclosings = self.roles[graph.role as usize].enclosings;
            let mut i = enclosings.start as usize;
            while i < enclosings.end() {
                let enclosing = &self.enclosings[i];
                let at_start = match enclosing.at_start {
                    Some(set) => self.situation_is_sound(graph, set),
                    None => true,
                };
                let sound = self.bit_is_step(enclosing.step)
                    && self.situation_is_sound(graph, enclosing.situation);
                if !at_start || !sound {
                    return false;
                }
                i += 1;
            }
            g += 1;
        }
        true
    }

    pub(super) const fn orders_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.orders.len() {
            if !self.order_is_sound(&self.orders[i]) {
                return false;
            }
            i += 1;
        }
        let mut g = 0;
        while g < self.graphs.len() {
            let graph = &self.graphs[g];
            let role = &self.roles[graph.role as usize];
            if !self.orders_are_by(role.orders, g) || !self.orders_are_by(role.self_orders, g) {
                return false;
            }
            let mut i = graph.steps.start as usize;
            while i < graph.steps.end() {
                let duties = self.steps[i].duties as usize;
                if !self.orders_are_by(self.duties[duties].orders, g) {
                    return false;
                }
                i += 1;
            }
            let own = role.self_orders;
            let mut i = own.start as usize;
            while i < own.end() {
                if self.orders[i].graph as usize != g {
                    return false;
                }
                i += 1;
            }
            g += 1;
        }
        true
    }

    const fn orders_are_by(&self, orders: Run, graph: usize) -> bool {
        let mut i = orders.start as usize;
        while i < orders.end() {
            if self.orders[i].by as usize != graph {
                return false;
            }
            i += 1;
        }
        true
    }

    const fn order_is_sound(&self, order: &Order) -> bool {
        if order.graph as usize >= self.graphs.len() || !self.condition_is_sound(order.condition) {
            return false;
        }
        match order.situation {
            Forced::Set(set) => self.situation_is_sound(&self.graphs[order.graph as usize], set),
            Forced::Current => true,
        }
    }

    pub(super) const fn stored_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.stored.len() {
            let row = &self.stored[i];
            let assigned = match row.assignment {
                Assignment::Bit(bit, value) => {
                    self.bit_is_stored(bit) && self.condition_is_sound(value)
                }
                Assignment::Number(number, value) => {
                    self.number_is_stored(number) && self.code_is_sound(value)
                }
            };
            if !assigned || !self.condition_is_sound(row.condition) {
                return false;
            }
            i += 1;
        }
        true
    }

    /// Whether the first `do` block is none, and the others are statements that run when a situation changes.
    pub(super) const fn do_blocks_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.do_blocks.len() {
            let run = self.do_blocks[i];
            if !run.is_within(self.stored.len())
                || (run.len > 0 && (i == 0 || !self.stores_on_change))
            {
                return false;
            }
            i += 1;
        }
        true
    }

    pub(super) const fn events_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.events.len() {
            let row = &self.events[i];
            if !self.bit_is_sound(row.event) || !row.stored.is_within(self.stored.len()) {
                return false;
            }
            i += 1;
        }
        true
    }

    pub(super) const fn momentary_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.momentary.len() {
            if !self.statement_is_sound(&self.momentary[i]) {
                return false;
            }
            i += 1;
        }
        let mut i = 0;
        while i < self.dependent.len() {
            let row = &self.dependent[i];
            let owned = match row.owner {
                Some(step) => self.bit_is_step(step),
                None => true,
            };
            if !owned || !self.statement_is_sound(&row.statement) {
                return false;
            }
            i += 1;
        }
        true
    }

    const fn statement_is_sound(&self, statement: &Momentary) -> bool {
        if (statement.condition > 0 && !self.momentary_varies)
            || !statement.targets.is_within(self.targets.len())
            || !self.condition_row_is_sound(statement.condition)
        {
            return false;
        }
        let mut i = statement.targets.start as usize;
        while i < statement.targets.end() {
            if !self.layout.momentary.holds(self.targets[i].word as usize) {
                return false;
            }
            i += 1;
        }
        true
    }

    pub(super) const fn edges_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.edges.len() {
            let row = &self.edges[i];
            let sound = self.layout.inputs.holds(row.word as usize)
                && self.word_is_stored(row.last)
                && self.seen_is_sound(&row.rises, row)
                && self.seen_is_sound(&row.falls, row)
                && match (&row.rises, &row.falls) {
                    (Some(rises), Some(falls)) => rises.word != falls.word,
                    _ => true,
                };
            if !sound {
                return false;
            }
            i += 1;
        }
        // The rounds of a scan need edges that are False in the later ones.
        self.edges.is_empty() || matches!(self.evolution, Evolution::Scan)
    }

    pub(super) const fn watches_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.watches.len() {
            if !self.watch_is_sound(&self.watches[i]) {
                return false;
            }
            i += 1;
        }
        true
    }

    const fn watch_is_sound(&self, watch: &Watch) -> bool {
        match *watch {
            Watch::Edge {
                operand,
                last,
                result,
                ..
            } => self.condition_is_sound(operand) && self.memory_is_sound(last, result),
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
                self.condition_is_sound(condition)
                    && self.code_is_sound(time)
                    && self.stamp_is_sound(stamp)
                    && self.memory_is_sound(last, result)
            }
            Watch::Value {
                condition,
                gate,
                result,
            } => {
                let gated = match gate {
                    Some(step) => self.bit_is_sound(step),
                    None => true,
                };
                gated && self.condition_is_sound(condition) && self.bit_is_stored(result)
            }
        }
    }

    const fn seen_is_sound(&self, seen: &Option<Seen>, row: &Edges) -> bool {
        match seen {
            Some(Seen { word, bits }) => {
                self.word_is_stored(*word)
                    && *word != row.last
                    && *bits != 0
                    && self.notes_reading(row.word, *bits)
            }
            None => true,
        }
    }

    /// Whether the edges of inputs may fill the whole word.
    const fn word_is_stored(&self, word: u16) -> bool {
        word > 0 && word < 1 << 11 && self.bit_is_stored(Bit(word << 5 | 31))
    }

    const fn memory_is_sound(&self, last: Bit, result: Bit) -> bool {
        self.bit_is_stored(last) && self.bit_is_stored(result) && last.0 != result.0
    }

    pub(super) const fn first_values_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.initially_true.len() {
            if !self.bit_is_stored(self.initially_true[i]) {
                return false;
            }
            i += 1;
        }
        let mut i = 0;
        while i < self.retained.len() {
            if !self.slot_is_written(self.retained[i].slot) {
                return false;
            }
            i += 1;
        }
        true
    }
}

const fn is_one(role: &Role) -> bool {
    role.sources.len > 0
        || role.enclosings.len > 0
        || role.orders.len > 0
        || role.self_orders.len > 0
        || role.watches.len > 0
        || role.self_watches.len > 0
}

const fn does_something(row: &Duties) -> bool {
    row.stored.len > 0
        || row.on_activation.len > 0
        || row.on_deactivation.len > 0
        || row.on_event.len > 0
        || row.orders.len > 0
        || row.activated.is_some()
        || row.since.is_some()
}
