//! Timers and delays: `T/enable/preset`, `t1/e`, `t1/e/t2`.

use crate::ast::{Binary, ExpressionKind, Unary};
use crate::lexer::token::TokenKind;

use super::cursor::{Context, Parsed, Parser};
use super::expressions::{PRODUCT, Tree};
use super::names::is_step_bit;

/// An on-delay to which a second `/` would add the off-delay.
fn lacks_off_delay(tree: &Tree) -> bool {
    !tree.parenthesised
        && matches!(
            tree.expression.kind,
            ExpressionKind::Delay { off: None, .. }
        )
}

/// Whether an operand behind `/` is Boolean whatever is declared: a step bit, or such an expression in parentheses.
fn is_boolean(tree: &Tree) -> bool {
    match &tree.expression.kind {
        ExpressionKind::Ref(reference) => is_step_bit(&reference.name.text),
        ExpressionKind::Bool(_)
        | ExpressionKind::Situation { .. }
        | ExpressionKind::Timer { .. }
        | ExpressionKind::Delay { .. } => tree.parenthesised,
        ExpressionKind::Unary { operator, .. } => tree.parenthesised && *operator != Unary::Negate,
        ExpressionKind::Binary { operator, .. } => {
            tree.parenthesised
                && !matches!(
                    operator,
                    Binary::Add
                        | Binary::Subtract
                        | Binary::Multiply
                        | Binary::Divide
                        | Binary::Modulo
                )
        }
        ExpressionKind::Integer(_) | ExpressionKind::Duration(_) | ExpressionKind::Unreadable => {
            false
        }
    }
}

impl Parser<'_> {
    /// `T/enable/preset`. The enable runs to the next `/` outside parentheses.
    pub(super) fn timer(&mut self) -> Parsed<Tree> {
        const SHAPE: &str = "a timer is written `T/enable/preset`: `T/X3/2s`";
        let start = self.bump();
        self.bump();
        let context = Context {
            slash_ends: true,
            ..self.context
        };
        let enable = self.within(context, Self::tree)?;
        if !self.eat(TokenKind::Slash) {
            return Err(self.expected_help("`/` and the preset of the timer", SHAPE));
        }
        let preset = self.preset()?;
        let span = self.span_of(start).to(preset.outer);
        let depth = Tree::deepest([&enable, &preset]);
        let preset_is_number = matches!(preset.expression.kind, ExpressionKind::Integer(_));
        let kind = ExpressionKind::Timer {
            enable: enable.expression,
            preset: preset.expression,
        };
        let help = match self.peek() {
            TokenKind::Slash => {
                "a timer, a delay or a division inside an enable stands in parentheses: `T/(a/2)/3s`"
            }
            kind if kind.is_arithmetic() => {
                "a preset that is computed stands in parentheses: `T/X3/(a + b)`"
            }
            kind if kind.is_comparison() && preset_is_number => {
                "a division inside an enable stands in parentheses: `T/(a/2 > 3)/2s`"
            }
            kind if kind.is_comparison() => "put the timer in parentheses to compare it",
            _ => return self.bounded(Tree::over(kind, span, depth)),
        };
        Err(self.expected_help("the end of the timer", help))
    }

    /// A duration, an integer, a name, or an expression in parentheses.
    fn preset(&mut self) -> Parsed<Tree> {
        match self.peek() {
            TokenKind::Duration | TokenKind::Number | TokenKind::LeftParenthesis => self.operand(),
            TokenKind::Name => self.variable(),
            _ => Err(self.expected_help(
                "the preset of the timer",
                "a preset is a duration, an integer (seconds), a name, or an expression in parentheses",
            )),
        }
    }

    /// `left / ..`: a delay where the right side is Boolean by its very form, else a division.
    pub(super) fn quotient(&mut self, left: Tree) -> Parsed<Tree> {
        let operator_span = self.take_operator();
        self.refuse_bare_enable();
        let right = self.binary(PRODUCT + 1)?;
        if lacks_off_delay(&left) {
            return self.off_delay(left, right);
        }
        if is_boolean(&right) {
            return self.on_delay(left, right);
        }
        self.join(Binary::Divide, operator_span, left, right)
    }

    /// Reports what may stand behind the `/` of a delay only in parentheses.
    fn refuse_bare_enable(&mut self) {
        let second = self.peek_second();
        let bare = match self.peek() {
            TokenKind::Not
            | TokenKind::Rising
            | TokenKind::Falling
            | TokenKind::True
            | TokenKind::False => true,
            TokenKind::Name => match self.text_of(self.next_token()) {
                "T" => second == TokenKind::Slash,
                "S" => second == TokenKind::LeftParenthesis,
                _ => false,
            },
            _ => false,
        };
        if bare {
            let span = self.span_here();
            self.error(
                span,
                format!("{} behind `/` stands in parentheses", self.found()),
                "only a name or a step bit is delayed without them: `3s/X5`, `3s/(NOT a)`",
            );
        }
    }

    /// `t1/e`.
    fn on_delay(&mut self, on: Tree, enable: Tree) -> Parsed<Tree> {
        let span = on.outer.to(enable.outer);
        let depth = Tree::deepest([&on, &enable]);
        let kind = ExpressionKind::Delay {
            on: on.expression,
            enable: enable.expression,
            off: None,
        };
        self.bounded(Tree::over(kind, span, depth))
    }

    /// `t1/e/t2` from `t1/e` and `t2`.
    fn off_delay(&mut self, mut delay: Tree, off_delay: Tree) -> Parsed<Tree> {
        let span = delay.outer.to(off_delay.outer);
        let depth = delay.depth().max(off_delay.depth());
        if let ExpressionKind::Delay { off, .. } = &mut delay.expression.kind {
            *off = Some(off_delay.expression);
        }
        self.bounded(Tree::over(delay.expression.kind, span, depth))
    }
}
