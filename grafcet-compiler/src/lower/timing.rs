//! Timers on steps: those that are asked for only while their step is active, and all others.

use std::collections::BTreeMap;

use grafcet_core::program::{Preset, Since, Timer, Unit};

use super::atoms::Atom;
use super::limits::index;
use super::node::Node;
use super::unit::Lowering;
use super::watch::Context;
use crate::model::{DeclarationKind, Expression, ExpressionKind, StepId};

/// Which steps have timers that are asked for only while they are active.
#[derive(Default)]
pub(super) struct Timing {
    /// The steps that are active whenever what is being lowered counts.
    active: Vec<StepId>,
    since: BTreeMap<StepId, Since>,
}

impl Timing {
    /// Where it is kept since when a step is active, if it has such a timer.
    pub fn since(&self, step: StepId) -> Option<Since> {
        self.since.get(&step).copied()
    }

    /// How many steps have one.
    pub fn steps(&self) -> usize {
        self.since.len()
    }

    fn new_since(&mut self, step: StepId) -> Since {
        let next = Since(index(self.since.len()));
        *self.since.entry(step).or_insert(next)
    }
}

impl Lowering<'_> {
    /// Lowers what counts only while all of these steps are active.
    pub(super) fn while_active<T>(
        &mut self,
        steps: Vec<StepId>,
        lower: impl FnOnce(&mut Self) -> T,
    ) -> T {
        let around = std::mem::replace(&mut self.timing.active, steps);
        let lowered = lower(self);
        self.timing.active = around;
        lowered
    }

    /// Lowers what is looked at in every scan, whatever is active.
    pub(super) fn at_any_time<T>(&mut self, lower: impl FnOnce(&mut Self) -> T) -> T {
        self.while_active(Vec::new(), lower)
    }

    /// The timer of a step that is asked for only while the step is active, and in a phase in which the times of
    /// activation are noted already.
    pub(super) fn own_timer(
        &mut self,
        of: Atom,
        preset: &Expression,
        context: Context,
    ) -> Option<Timer> {
        let Atom::Step(step) = of else {
            return None;
        };
        let in_time = matches!(context, Context::Trigger | Context::Action);
        let is_active = self.timing.active.contains(&step);
        if !in_time || !is_active || !self.is_steady(preset, context) {
            return None;
        }
        let preset = self.own_preset(preset, context)?;
        let since = self.timing.new_since(step);
        Some(Timer::Own { since, preset })
    }

    /// A preset that does not change within a scan and is never too long.
    fn own_preset(&mut self, preset: &Expression, context: Context) -> Option<Preset> {
        let (node, unit) = self.preset(preset, context);
        let (longest, preset) = match (node, &preset.bare().kind) {
            (Node::Constant(value), _) => (value, Preset::Constant(value)),
            (Node::Number(number), ExpressionKind::Variable(id))
                if self.model[*id].kind == DeclarationKind::Parameter =>
            {
                (self.model[*id].limits().1, Preset::Number(number, unit))
            }
            _ => return None,
        };
        let milliseconds = match unit {
            Unit::Milliseconds => 1,
            Unit::Seconds => 1000,
        };
        let longest_ms = i64::from(longest) * milliseconds;
        (longest_ms <= i64::from(Timer::LONGEST_OWN_MS)).then_some(preset)
    }
}
