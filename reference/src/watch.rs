//! Edges and timers (`semantics.md`, "Edges" and "Timers").

use grafcet_compiler::ast::{Expression, ExpressionKind, Unary};

use crate::expression::{Delay, Scope};
use crate::machine::Machine;
use crate::name::{Named, Qualified};

/// Which evaluation of an edge this is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pass {
    /// Triggers in scan 0: every edge is False, its memory is set.
    Prime,
    /// The one of a scan, or the first of several rounds.
    Compare,
    /// In a later round: edges are False and keep their memory; timers run.
    Later,
}

/// What an edge or timer remembers.
#[derive(Clone, Copy, Debug, Default)]
pub struct Memory {
    /// The operand of an edge, the enable of a timer, when it was evaluated last; none before scan 0.
    last: Option<bool>,
    /// The latest rise of the enable.
    rise: Option<u64>,
    /// `t1/e` when it was evaluated last.
    was_on: bool,
    /// When `t1/e` last became False.
    fall: Option<u64>,
}

impl<'a> Machine<'a> {
    /// Evaluates the edges and timers in an expression, the innermost first, each once.
    pub(crate) fn watch(&mut self, expression: &'a Expression, scope: &Scope<'a>, pass: Pass) {
        if let Some(delay) = self.delay(expression, scope) {
            return self.watch_delay(expression, delay, scope, pass);
        }
        match &expression.kind {
            ExpressionKind::Timer { enable, preset } => {
                self.watch(enable, scope, pass);
                self.watch(preset, scope, pass);
                let memory = self.enable(expression, enable, scope);
                let preset_ms = self.evaluate(preset, scope).duration_ms();
                let value = memory
                    .rise
                    .is_some_and(|rise| self.elapsed(rise) >= preset_ms.into());
                self.watched.insert(scope.place(expression.span), value);
            }
            ExpressionKind::Unary {
                operator: operator @ (Unary::Rising | Unary::Falling),
                operand,
            } => {
                self.watch(operand, scope, pass);
                let value = self.edge(*operator, expression, operand, scope, pass);
                self.watched.insert(scope.place(expression.span), value);
            }
            ExpressionKind::Unary { operand, .. } => self.watch(operand, scope, pass),
            ExpressionKind::Binary { left, right, .. } => {
                self.watch(left, scope, pass);
                self.watch(right, scope, pass);
            }
            ExpressionKind::Ref(reference) => {
                if let Named::Bound(bound) = self.program.resolve(scope.graph, reference) {
                    self.watch(bound, &scope.bound(expression.span), pass);
                }
            }
            _ => {}
        }
    }

    fn edge(
        &mut self,
        operator: Unary,
        expression: &'a Expression,
        operand: &'a Expression,
        scope: &Scope<'a>,
        pass: Pass,
    ) -> bool {
        let now = self.evaluate(operand, scope).truth();
        let alone = self.step_alone(operand, scope).is_some();
        let memory = self
            .memories
            .entry(scope.place(expression.span))
            .or_default();
        if pass == Pass::Later {
            return false;
        }
        let last = memory.last.replace(now);
        match (operator, last) {
            (Unary::Rising, Some(last)) => now && !last,
            (_, Some(last)) => last && !now,
            // Scan 0: an input's past is unknown, a step's is not.
            (Unary::Rising, None) => alone && now && pass != Pass::Prime,
            (_, None) => false,
        }
    }

    fn watch_delay(
        &mut self,
        expression: &'a Expression,
        delay: Delay<'a>,
        scope: &Scope<'a>,
        pass: Pass,
    ) {
        let times = [Some(delay.on), delay.off];
        for operand in times.into_iter().flatten().chain([delay.enable]) {
            self.watch(operand, scope, pass);
        }
        let memory = self.enable(expression, delay.enable, scope);
        let on_ms = self.evaluate(delay.on, scope).duration_ms();
        let off_ms = delay.off.map(|off| self.evaluate(off, scope).duration_ms());
        let enabled = memory.last == Some(true);
        let on = enabled
            && memory
                .rise
                .is_some_and(|rise| self.elapsed(rise) >= on_ms.into());
        let fall = if memory.was_on && !on {
            Some(self.now_ms)
        } else {
            memory.fall
        };
        let held = match (fall, off_ms) {
            (Some(fall), Some(off_ms)) => self.elapsed(fall) < off_ms.into(),
            _ => false,
        };
        let memory = Memory {
            was_on: on,
            fall,
            ..memory
        };
        self.memories.insert(scope.place(expression.span), memory);
        self.watched
            .insert(scope.place(expression.span), on || held);
    }

    /// Follows the enable of a timer. A step bit standing alone rises when its step is activated; anything else is
    /// watched where it stands.
    fn enable(
        &mut self,
        timer: &'a Expression,
        enable: &'a Expression,
        scope: &Scope<'a>,
    ) -> Memory {
        let now = self.evaluate(enable, scope).truth();
        let step: Option<Qualified<'a>> = self.step_alone(enable, scope);
        let activated = step.and_then(|step| self.activated_at(step));
        let now_ms = self.now_ms;
        let memory = self.memories.entry(scope.place(timer.span)).or_default();
        if step.is_some() {
            memory.rise = activated;
        } else if now && memory.last != Some(true) {
            memory.rise = Some(now_ms);
        }
        memory.last = Some(now);
        *memory
    }

    fn elapsed(&self, since: u64) -> i128 {
        i128::from(self.now_ms) - i128::from(since)
    }
}
