//! Timers and delays: `T/e/d`, `t1/e`, `t1/e/t2`.

use super::constant::a;
use super::resolver::Resolver;
use super::{Expression, ExpressionKind, Type};
use crate::diagnostic::{Diagnostic, Rule};
use crate::source::Span;

/// An `int` preset counts seconds.
const MS_PER_SECOND: i64 = 1000;
/// The longest constant preset: 24 days.
const LONGEST_MS: i64 = 24 * 24 * 3600 * MS_PER_SECOND;

impl Resolver<'_> {
    pub(super) fn timer(
        &mut self,
        enable: Expression,
        preset: Expression,
        span: Span,
    ) -> Expression {
        let preset = match preset.ty {
            Some(Type::Bool) => {
                let diagnostic = Diagnostic::new(
                    Rule::TypeMismatch,
                    preset.span,
                    "the preset of a timer is a time, or an int that counts seconds, and this is a Boolean",
                )
                .help("write `T/enable/preset`, as in `T/X3/2s`");
                self.report(diagnostic);
                Expression::unknown(preset.span)
            }
            _ => self.limited(preset),
        };
        Expression {
            kind: ExpressionKind::Timer {
                enable: Box::new(enable),
                preset: Box::new(preset),
            },
            ty: Some(Type::Bool),
            span,
        }
    }

    /// Refuses a constant preset above [`LONGEST_MS`], and one that cannot be computed.
    fn limited(&mut self, preset: Expression) -> Expression {
        if preset.ty.is_some()
            && preset.is_of_constants(&self.model)
            && preset.constant(&self.model).is_none()
        {
            let message = "this preset goes beyond 32 bits, or divides by zero";
            let diagnostic = Diagnostic::new(Rule::OutOfRange, preset.span, message)
                .help("a preset is at most 24 days");
            self.report(diagnostic);
            return preset;
        }
        let ms = preset.constant(&self.model).map(|value| match preset.ty {
            Some(Type::Int) => i64::from(value) * MS_PER_SECOND,
            _ => i64::from(value),
        });
        if ms.is_some_and(|ms| ms > LONGEST_MS) {
            let diagnostic =
                Diagnostic::new(Rule::OutOfRange, preset.span, "a preset is at most 24 days");
            let seconds = preset.ty == Some(Type::Int);
            let help = seconds.then(|| "an int preset counts seconds".to_owned());
            self.report_with_help(diagnostic, help);
        }
        preset
    }

    pub(super) fn delay(
        &mut self,
        on: Expression,
        enable: Expression,
        off: Option<Expression>,
        span: Span,
    ) -> Expression {
        let on = self.delay_time(on);
        let enable = self.demand_bool(enable, "what a delay follows");
        let off = off.map(|off| Box::new(self.delay_time(off)));
        Expression {
            kind: ExpressionKind::Delay {
                on: Box::new(on),
                enable: Box::new(enable),
                off,
            },
            ty: Some(Type::Bool),
            span,
        }
    }

    fn delay_time(&mut self, time: Expression) -> Expression {
        match time.ty {
            None | Some(Type::Time) => self.limited(time),
            Some(ty) => {
                let message = format!("a delay is a time, and this is {}", a(ty));
                let diagnostic = Diagnostic::new(Rule::TypeMismatch, time.span, message);
                let help = (ty == Type::Int).then(|| "give it a unit, as in `3s/X5`".to_owned());
                self.report_with_help(diagnostic, help);
                Expression::unknown(time.span)
            }
        }
    }

    /// `d/X5` and `d/X5/t2` of names: only types tell them from divisions.
    pub(super) fn divide_as_delay(
        &mut self,
        left: Expression,
        right: Expression,
        span: Span,
    ) -> Expression {
        match left.kind {
            ExpressionKind::Delay {
                on,
                enable,
                off: None,
            } => self.delay(*on, *enable, Some(right), span),
            _ => self.delay(left, right, None, span),
        }
    }
}
