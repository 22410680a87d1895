//! Steps that stand in a sequence.

use crate::program::{Arm, Armed, Course, Crossing, Graph, Program, Sequel, Step};

impl Program<'_> {
    /// How it goes on behind a step of a graph, counted from the graph's first one, as the other tables have it. It is
    /// what the step's arm says in [`Arm::sequel`]; the steps, arms, transitions and crossings must be sound.
    #[must_use]
    pub const fn sequel_of(&self, graph: &Graph, place: u16) -> Sequel {
        let Some(enters) = self.step_behind(graph, place) else {
            return Sequel::NONE;
        };
        let step = self.step_of(graph, place);
        let behind = self.step_of(graph, enters);
        let next = match self.step_behind(graph, enters) {
            Some(_) => behind.first_arm,
            None => Sequel::NO_NEXT,
        };
        let transition = self.only_arm(step).transition as usize;
        Sequel {
            next,
            shows: self.shows(step),
            course: Course::to((enters % 32) as u8, self.transitions[transition].fires > 0),
        }
    }

    /// Whether every arm says how it goes on behind its step, and what is not known is no row.
    pub(super) const fn sequences_are_sound(&self) -> bool {
        if self.terms.len() > Armed::UNKNOWN.term() || self.arms.len() > Armed::UNKNOWN.row() {
            return false;
        }
        let mut i = 0;
        while i < self.graphs.len() {
            if !self.sequels_are_sound(&self.graphs[i]) {
                return false;
            }
            i += 1;
        }
        true
    }

    const fn sequels_are_sound(&self, graph: &Graph) -> bool {
        let mut place = 0;
        while place < graph.steps.len {
            let step = self.step_of(graph, place);
            let sequel = self.sequel_of(graph, place);
            if !self.are_sequels(step.first_arm, step.arm_count as u16, &sequel) {
                return false;
            }
            place += 1;
        }
        let sources = self.roles[graph.role as usize].sources;
        self.are_sequels(sources.start, sources.len, &Sequel::NONE)
    }

    const fn are_sequels(&self, first: u16, arms: u16, sequel: &Sequel) -> bool {
        let mut i = first as usize;
        while i < first as usize + arms as usize {
            let own = &self.arms[i].sequel;
            if own.next != sequel.next
                || own.shows != sequel.shows
                || own.course.0 != sequel.course.0
            {
                return false;
            }
            i += 1;
        }
        true
    }

    /// The step behind one that stands in a sequence.
    const fn step_behind(&self, graph: &Graph, place: u16) -> Option<u16> {
        let step = self.step_of(graph, place);
        // The last row stands for what is not known.
        if step.arm_count != 1 || step.first_arm == u16::MAX {
            return None;
        }
        let transition = self.only_arm(step).transition as usize;
        match self.crossings[self.transitions[transition].crossing as usize] {
            Crossing::Within { leaves, enters }
                if leaves == 1 << place && enters.is_power_of_two() && enters != leaves =>
            {
                Some(enters.trailing_zeros() as u16)
            }
            Crossing::Across { entrance, exit } if entrance.len == 1 && exit.len == 1 => {
                let enters = self.links[exit.start as usize];
                if enters / 32 == place / 32 && enters != place {
                    Some(enters)
                } else {
                    None
                }
            }
            _ => None,
        }
    }

    const fn step_of(&self, graph: &Graph, place: u16) -> &Step {
        &self.steps[graph.steps.start as usize + place as usize]
    }

    const fn only_arm(&self, step: &Step) -> &Arm {
        &self.arms[step.first_arm as usize]
    }

    const fn shows(&self, step: &Step) -> u8 {
        match step.momentary_count {
            0 => Sequel::SHOWS_NOTHING,
            1 => {
                let row = &self.momentary[step.first_momentary as usize];
                let target = row.targets.start as usize + 1;
                let fits = target < Sequel::SHOWS_MORE as usize;
                match fits && row.condition == 0 && row.targets.len == 1 {
                    true => target as u8,
                    false => Sequel::SHOWS_MORE,
                }
            }
            _ => Sequel::SHOWS_MORE,
        }
    }
}
