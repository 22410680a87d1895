//! What a run has reached, and for how long.

use std::collections::BTreeMap;

use grafcet::machine::HostEngine;
use grafcet_compiler::application::Unit;

use crate::subject::{Limit, Subject};

/// What has happened in a program of one graph.
#[derive(Debug)]
pub struct Watch<'a> {
    steps: Vec<&'a str>,
    /// The active steps, and since when, in ms.
    active: BTreeMap<usize, u64>,
    /// For each step how often it was activated, and the longest time it stayed active, in ms.
    stays: Vec<(u64, u64)>,
    /// For each transition how often it fired.
    fired: Vec<u64>,
    numbers: Vec<u32>,
    limits: &'static [Limit],
    impossible: &'static [u32],
}

/// The program does not do what it should, whatever the interpreters agree on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// A step has been active for longer than its timer lets it.
    StuckTimer {
        /// The step.
        step: String,
        /// How long it has been active, in ms.
        active_ms: u64,
        /// The longest time it can be, in ms.
        longest_ms: u64,
    },
}

impl std::fmt::Display for Fault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Fault::StuckTimer {
            step,
            active_ms,
            longest_ms,
        } = self;
        write!(
            f,
            "step {step} has been active for {active_ms} ms, and a timer ends it after {longest_ms} ms"
        )
    }
}

impl<'a> Watch<'a> {
    /// Nothing has happened.
    #[must_use]
    pub fn new(unit: &'a Unit, subject: Subject) -> Self {
        let graphs = || unit.symbols.graphs.iter();
        let steps: Vec<&str> = graphs()
            .flat_map(|graph| graph.steps.iter().map(|step| step.id.as_str()))
            .collect();
        let numbers: Vec<u32> = graphs()
            .flat_map(|graph| graph.transitions.iter().map(|it| it.number))
            .collect();
        Watch {
            stays: vec![(0, 0); steps.len()],
            fired: vec![0; numbers.len()],
            active: BTreeMap::new(),
            steps,
            numbers,
            limits: subject.limits(),
            impossible: subject.only_after_power_cuts(),
        }
    }

    /// Looks at what a scan has left.
    ///
    /// # Errors
    /// When a step is still active behind its longest time.
    pub fn look(&mut self, engine: &HostEngine<'_>, now_ms: u64) -> Result<(), Fault> {
        for transition in engine.fired() {
            if let Some(count) = self.fired.get_mut(transition) {
                *count += 1;
            }
        }
        let active = engine.active_steps(0);
        let active: BTreeMap<usize, u64> = active
            .map(|step| (step, self.active.get(&step).copied().unwrap_or(now_ms)))
            .collect();
        let before = std::mem::replace(&mut self.active, active);
        let left = before
            .iter()
            .filter(|(step, _)| !self.active.contains_key(step));
        let left: Vec<(usize, u64)> = left.map(|(step, since)| (*step, *since)).collect();
        left.into_iter()
            .try_for_each(|(step, since_ms)| self.end(step, now_ms - since_ms))
    }

    /// Of steps that are still active, too: to be called now and then, since a timer that is stuck gives nothing to
    /// look at.
    ///
    /// # Errors
    /// When one is active behind its longest time.
    pub fn look_at_timers(&self, now_ms: u64) -> Result<(), Fault> {
        let mut active = self.active.iter();
        active.try_for_each(|(step, since_ms)| self.check(*step, now_ms - since_ms))
    }

    fn end(&mut self, step: usize, active_ms: u64) -> Result<(), Fault> {
        if let Some((count, longest_ms)) = self.stays.get_mut(step) {
            *count += 1;
            *longest_ms = active_ms.max(*longest_ms);
        }
        self.check(step, active_ms)
    }

    fn check(&self, step: usize, active_ms: u64) -> Result<(), Fault> {
        let id = self.steps.get(step).copied().unwrap_or_default();
        match self.limits.iter().find(|limit| limit.step == id) {
            Some(limit) if active_ms > limit.longest_ms => Err(Fault::StuckTimer {
                step: id.to_owned(),
                active_ms,
                longest_ms: limit.longest_ms,
            }),
            _ => Ok(()),
        }
    }

    /// How often each step was left, by its identifier.
    pub fn left(&self) -> impl Iterator<Item = (&'a str, u64)> {
        self.steps
            .iter()
            .copied()
            .zip(self.stays.iter().map(|it| it.0))
    }

    /// How often each transition fired, by its number.
    pub fn fired(&self) -> impl Iterator<Item = (u32, u64)> {
        self.numbers.iter().copied().zip(self.fired.iter().copied())
    }

    /// The steps that a timer ends, their longest stay so far and the longest that can be, in ms.
    pub fn longest(&self) -> impl Iterator<Item = (&'static str, u64, u64)> {
        self.limits.iter().map(|limit| {
            let at = self.steps.iter().position(|step| *step == limit.step);
            let stay = at.and_then(|at| self.stays.get(at));
            (limit.step, stay.map_or(0, |it| it.1), limit.longest_ms)
        })
    }

    /// What a run that is long enough has reached and this one has not: steps never left, transitions that never fired,
    /// timers that never ran out. Empty when nothing is missing.
    #[must_use]
    pub fn missing(&self) -> Vec<String> {
        let left = self.left().filter(|(_, count)| *count == 0);
        let never = |(number, count): &(u32, u64)| *count == 0 && !self.impossible.contains(number);
        let fired = self.fired().filter(never);
        let short = self.longest().filter(|(_, stay, longest)| stay < longest);
        let left = left.map(|(step, _)| format!("step {step} was never left"));
        let fired = fired.map(|(number, _)| format!("transition {number} never fired"));
        let short = short.map(|(step, stay, longest)| {
            format!("step {step} lasted {stay} ms at most, never {longest} ms")
        });
        left.chain(fired).chain(short).collect()
    }
}
