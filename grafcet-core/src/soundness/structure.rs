//! Graphs, what arms their transitions, and where these lead.

use crate::program::{Crossing, Graph, Program, Run, Step};

impl Program<'_> {
    pub(super) const fn graphs_are_sound(&self) -> bool {
        let situations = self.layout.situations;
        let (mut steps, mut transitions, mut word) = (0, 0, situations.start as usize);
        let mut sources = 0;
        let mut i = 0;
        while i < self.graphs.len() {
            let graph = &self.graphs[i];
            let shared_out = graph.steps.start as usize == steps
                && graph.transitions.start as usize == transitions
                && (graph.words().len == 0 || graph.first_word as usize >= word);
            if !shared_out || !self.graph_is_sound(graph) {
                return false;
            }
            if self.roles[graph.role as usize].sources.len > 0 {
                if sources >= self.sources.len() || self.sources[sources] as usize != i {
                    return false;
                }
                sources += 1;
            }
            steps = graph.steps.end();
            transitions = graph.transitions.end();
            if graph.words().len > 0 {
                word = graph.words().end();
            }
            i += 1;
        }
        steps == self.steps.len()
            && sources == self.sources.len()
            && transitions == self.transitions.len()
            && word <= situations.end()
    }

    const fn graph_is_sound(&self, graph: &Graph) -> bool {
        (graph.role as usize) < self.roles.len()
            && graph.steps.is_within(self.steps.len())
            && graph.transitions.is_within(self.transitions.len())
            && self.blocks_are_sound(graph)
            && self.situation_is_sound(graph, graph.initial)
    }

    /// Whether the words of a graph lead to its own steps.
    const fn blocks_are_sound(&self, graph: &Graph) -> bool {
        let mut i = 0;
        while i < graph.words().len as usize {
            let word = graph.first_word as usize + i - self.layout.situations.start as usize;
            if word >= self.blocks.len()
                || self.blocks[word].first as usize != graph.steps.start as usize + i * 32
                || self.blocks[word].masks as usize >= self.masks.len()
            {
                return false;
            }
            i += 1;
        }
        true
    }

    /// Whether the words of a graph name all steps that act, and no other.
    pub(super) const fn blocks_name_what_acts(&self, graph: &Graph) -> bool {
        let mut i = 0;
        while i < graph.steps.len as usize {
            let word = graph.first_word as usize + i / 32 - self.layout.situations.start as usize;
            let step = &self.steps[graph.steps.start as usize + i];
            let mask = 1 << (i % 32);
            let block = &self.blocks[word];
            let masks = &self.masks[block.masks as usize];
            let duties = &self.duties[step.duties as usize];
            if (step.momentary_count > 0) != (block.momentary & mask != 0)
                || (duties.activated.is_some() || duties.since.is_some())
                    != (masks.timed & mask != 0)
                || (duties.stored.len > 0) != (masks.stored & mask != 0)
                || (duties.on_activation.len > 0) != (masks.on_activation & mask != 0)
                || (duties.on_deactivation.len > 0) != (masks.on_deactivation & mask != 0)
                || (duties.on_event.len > 0) != (masks.on_event & mask != 0)
                || (duties.orders.len > 0) != (masks.forcing & mask != 0)
                || self.shows_on_conditions(step) != (masks.varying & mask != 0)
            {
                return false;
            }
            i += 1;
        }
        true
    }

    /// Whether a step has a momentary action with a condition.
    const fn shows_on_conditions(&self, step: &Step) -> bool {
        let momentary = step.momentary();
        let mut i = momentary.start as usize;
        while i < momentary.end() {
            if i < self.momentary.len() && self.momentary[i].condition > 0 {
                return true;
            }
            i += 1;
        }
        false
    }

    pub(super) const fn hierarchy_is_sound(&self) -> bool {
        if self.hierarchy.len() != self.graphs.len() {
            return false;
        }
        let mut seen = [0u32; 1 << 11];
        let mut i = 0;
        while i < self.hierarchy.len() {
            let graph = self.hierarchy[i] as usize;
            let mask = 1 << (graph & 31);
            if graph >= self.graphs.len() || seen[graph >> 5] & mask != 0 {
                return false;
            }
            seen[graph >> 5] |= mask;
            i += 1;
        }
        true
    }

    /// Whether the words from there are a set of steps of the graph.
    pub(super) const fn situation_is_sound(&self, graph: &Graph, start: u16) -> bool {
        let set = Run {
            start,
            len: graph.words().len,
        };
        if !set.is_within(self.situations.len()) {
            return false;
        }
        let mut i = 0;
        while i < set.len as usize {
            let steps = (graph.steps.len as usize).saturating_sub(i * 32);
            let unused = if steps >= 32 { 0 } else { u32::MAX << steps };
            if self.situations[set.start as usize + i] & unused != 0 {
                return false;
            }
            i += 1;
        }
        true
    }

    pub(super) const fn arms_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.arms.len() {
            let arm = &self.arms[i];
            if arm.transition as usize >= self.transitions.len() {
                return false;
            }
            i += 1;
        }
        true
    }

    /// Whether every step arms transitions that leave it, and every graph itself those that leave none.
    pub(super) const fn arms_are_of_their_steps(&self) -> bool {
        let mut g = 0;
        while g < self.graphs.len() {
            let graph = &self.graphs[g];
            let mut place = 0;
            while place < graph.steps.len {
                let arms = self.steps[graph.steps.start as usize + place as usize].arms();
                if !self.arms_are_of(graph, arms, Some(place)) {
                    return false;
                }
                place += 1;
            }
            if !self.arms_are_of(graph, self.roles[graph.role as usize].sources, None) {
                return false;
            }
            g += 1;
        }
        true
    }

    const fn arms_are_of(&self, graph: &Graph, arms: Run, step: Option<u16>) -> bool {
        let mut i = arms.start as usize;
        while i < arms.end() {
            let row = self.arms[i].transition as usize;
            if !graph.transitions.holds(row) {
                return false;
            }
            let crossing = self.crossings[self.transitions[row].crossing as usize];
            if !self.is_armed_by(crossing, step) {
                return false;
            }
            i += 1;
        }
        true
    }

    const fn is_armed_by(&self, crossing: Crossing, step: Option<u16>) -> bool {
        match (crossing, step) {
            (Crossing::Within { leaves, .. }, Some(step)) => leaves & 1 << step != 0,
            (Crossing::Within { leaves, .. }, None) => leaves == 0,
            (Crossing::Across { entrance, .. }, Some(step)) => {
                let mut i = entrance.start as usize;
                while i < entrance.end() {
                    if self.links[i] == step {
                        return true;
                    }
                    i += 1;
                }
                false
            }
            (Crossing::Across { entrance, .. }, None) => entrance.len == 0,
        }
    }

    pub(super) const fn transitions_are_sound(&self) -> bool {
        let mut g = 0;
        while g < self.graphs.len() {
            let graph = &self.graphs[g];
            let mut i = graph.transitions.start as usize;
            while i < graph.transitions.end() {
                let transition = &self.transitions[i];
                let sound = (transition.crossing as usize) < self.crossings.len()
                    && self.crossing_is_sound(graph, self.crossings[transition.crossing as usize])
                    && self.condition_row_is_sound(transition.fires)
                    && (transition.term as usize) < self.terms.len();
                if !sound {
                    return false;
                }
                i += 1;
            }
            g += 1;
        }
        true
    }

    const fn crossing_is_sound(&self, graph: &Graph, crossing: Crossing) -> bool {
        if crossing.actions() >= self.do_blocks.len() {
            return false;
        }
        match crossing {
            Crossing::Within { leaves, enters, .. } => {
                let unused = if graph.steps.len >= 32 {
                    0
                } else {
                    u32::MAX << graph.steps.len
                };
                graph.words().len <= 1 && (leaves | enters) & unused == 0
            }
            Crossing::Across { entrance, exit, .. } => {
                graph.words().len > 1
                    && self.links_are_steps_of(graph, entrance)
                    && self.links_are_steps_of(graph, exit)
            }
        }
    }

    const fn links_are_steps_of(&self, graph: &Graph, links: Run) -> bool {
        if !links.is_within(self.links.len()) {
            return false;
        }
        let mut i = links.start as usize;
        while i < links.end() {
            if self.links[i] >= graph.steps.len {
                return false;
            }
            i += 1;
        }
        true
    }
}
