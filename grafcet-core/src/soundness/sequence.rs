//! Steps that stand in a sequence.

use crate::program::{Arm, Armed, Course, Crossing, Graph, Program, Step};

impl Program<'_> {
    /// What the only arm of a step of a graph, counted from the graph's first one, says as the other tables have it. The
    /// steps, transitions, terms and crossings must be sound. None when the step arms several transitions or none.
    #[must_use]
    pub const fn arm_of(&self, graph: &Graph, place: u16) -> Option<Arm> {
        let step = self.step_of(graph, place);
        if step.arm_count != 1 {
            return None;
        }
        let transition = self.arms[step.first_arm as usize].transition;
        let Some(enters) = self.step_behind(graph, place) else {
            return Some(Arm::alone(transition));
        };
        Some(Arm {
            transition,
            course: Course::to((enters % 32) as u8, self.shows_else(graph, place, enters)),
            shows: self.shows(step),
            next: self.armed_in(graph, enters),
        })
    }

    /// What is armed while a step of a graph, counted from the graph's first one, is the only active one of its word.
    const fn armed_in(&self, graph: &Graph, place: u16) -> Armed {
        match self.step_behind(graph, place) {
            Some(_) => self.armed_by(self.step_of(graph, place).first_arm),
            None => Armed::UNKNOWN,
        }
    }

    /// What a row of the arms arms; nothing that is known when there is no such row.
    pub(crate) const fn armed_by(&self, row: u16) -> Armed {
        if row as usize >= self.arms.len() {
            return Armed::UNKNOWN;
        }
        let transition = self.arms[row as usize].transition as usize;
        if transition >= self.transitions.len() {
            return Armed::UNKNOWN;
        }
        let transition = &self.transitions[transition];
        if transition.term as usize >= self.terms.len() {
            return Armed::UNKNOWN;
        }
        let first = &self.terms[transition.term as usize];
        Armed::by(row, first, transition.fires > 0)
    }

    /// Whether every arm says how it goes on behind its step.
    pub(super) const fn sequences_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.graphs.len() {
            if !self.arms_are_in_sequence(&self.graphs[i]) {
                return false;
            }
            i += 1;
        }
        true
    }

    const fn arms_are_in_sequence(&self, graph: &Graph) -> bool {
        let mut place = 0;
        while place < graph.steps.len {
            let step = self.step_of(graph, place);
            let sound = match self.arm_of(graph, place) {
                Some(arm) => self.arms[step.first_arm as usize].is(&arm),
                None => self.are_alone(step.first_arm, step.arm_count as u16),
            };
            if !sound {
                return false;
            }
            place += 1;
        }
        let sources = self.roles[graph.role as usize].sources;
        self.are_alone(sources.start, sources.len)
    }

    const fn are_alone(&self, first: u16, arms: u16) -> bool {
        let mut i = first as usize;
        while i < first as usize + arms as usize {
            if !self.arms[i].is(&Arm::alone(self.arms[i].transition)) {
                return false;
            }
            i += 1;
        }
        true
    }

    /// The step behind one that stands in a sequence.
    const fn step_behind(&self, graph: &Graph, place: u16) -> Option<u16> {
        let step = self.step_of(graph, place);
        if step.arm_count != 1 {
            return None;
        }
        let transition = self.arms[step.first_arm as usize].transition as usize;
        match self.crossings[self.transitions[transition].crossing as usize] {
            Crossing::Within { leaves, enters, .. }
                if leaves == 1 << place && enters.is_power_of_two() && enters != leaves =>
            {
                Some(enters.trailing_zeros() as u16)
            }
            Crossing::Across { entrance, exit, .. } if entrance.len == 1 && exit.len == 1 => {
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

    /// Whether a step of a graph may show something else than another.
    const fn shows_else(&self, graph: &Graph, place: u16, other: u16) -> bool {
        let shows = self.shows(self.step_of(graph, place));
        shows == Arm::SHOWS_MORE || shows != self.shows(self.step_of(graph, other))
    }

    const fn shows(&self, step: &Step) -> u8 {
        match step.momentary_count {
            0 => Arm::SHOWS_NOTHING,
            1 => {
                let row = &self.momentary[step.first_momentary as usize];
                let target = row.targets.start as usize + 1;
                let fits = target < Arm::SHOWS_MORE as usize;
                match fits && row.condition == 0 && row.targets.len == 1 {
                    true => target as u8,
                    false => Arm::SHOWS_MORE,
                }
            }
            _ => Arm::SHOWS_MORE,
        }
    }
}

impl Arm {
    /// `==`, which is not const.
    const fn is(&self, other: &Arm) -> bool {
        self.transition == other.transition
            && self.course.0 == other.course.0
            && self.shows == other.shows
            && self.next.0 == other.next.0
    }
}
