//! What stands for an interface name: the expression that an instance binds it to.
//!
//! Such an expression is put in place of the name wherever that is used, in the bindings of other instances too. So
//! a short text can make a long program; what that may come to is limited, and the limit is told.

use super::resolver::Resolver;
use super::{Binding, Expression, ExpressionKind, VariableId};
use crate::diagnostic::{Diagnostic, Rule};
use crate::source::Span;

/// How many levels an expression may have, those of what its names are bound to included.
pub const MAX_BOUND_DEPTH: u32 = 384;

/// How many names and operators all that stands for interface names may come to in one application.
pub const MAX_BOUND_SIZE: usize = 500_000;

/// How large an expression is.
#[derive(Clone, Copy)]
pub(super) struct Extent {
    depth: u32,
    size: usize,
}

/// What has been put in place of names.
#[derive(Default)]
pub(super) struct Substituted {
    /// Levels of expressions that are being looked up, one in the other.
    pub depth: u32,
    /// All so far.
    size: usize,
    told: bool,
}

impl Extent {
    /// Of a name.
    pub(super) const ONE: Extent = Extent { depth: 1, size: 1 };

    pub(super) fn of(expression: &Expression) -> Extent {
        let mut extent = Extent { depth: 0, size: 0 };
        let mut waiting = vec![(expression, 1)];
        while let Some((expression, depth)) = waiting.pop() {
            extent.depth = extent.depth.max(depth);
            extent.size += 1;
            let operands = expression.operands().into_iter();
            waiting.extend(operands.map(|operand| (operand, depth + 1)));
        }
        extent
    }
}

impl Resolver<'_> {
    /// A declared name as an expression: what it is bound to, if it is.
    pub(super) fn variable(&mut self, id: VariableId, span: Span) -> Expression {
        if self.substituted.depth >= MAX_BOUND_DEPTH && self.is_waiting(id) {
            return self.too_deep(id, span);
        }
        self.settle_binding(id, span);
        let variable = &self.model[id];
        let Binding::Expression(to) = &variable.binding else {
            let (kind, ty) = (ExpressionKind::Variable(id), Some(variable.ty));
            return Expression { kind, ty, span };
        };
        let Extent { depth, size } = self.extent_of(id);
        if self.substituted.depth + depth > MAX_BOUND_DEPTH {
            return self.too_deep(id, span);
        }
        self.substituted.size += size;
        if self.substituted.size > MAX_BOUND_SIZE {
            return self.too_much(span);
        }
        Expression {
            ty: to.ty,
            kind: ExpressionKind::Bound(id, to.clone()),
            span,
        }
    }

    fn too_deep(&mut self, id: VariableId, span: Span) -> Expression {
        let message = format!(
            "with what `{}` stands for, this expression has more than {MAX_BOUND_DEPTH} levels",
            self.model[id].name
        );
        let diagnostic = Diagnostic::new(Rule::OutOfRange, span, message)
            .help("store a part of it in a variable, and bind the name to that");
        self.report(diagnostic);
        Expression::unknown(span)
    }

    fn too_much(&mut self, span: Span) -> Expression {
        if !std::mem::replace(&mut self.substituted.told, true) {
            let message = format!(
                "what interface names stand for comes to more than {MAX_BOUND_SIZE} names and operators"
            );
            let diagnostic = Diagnostic::new(Rule::OutOfRange, span, message)
                .help("store it in a variable, and bind the name to that");
            self.report(diagnostic);
        }
        Expression::unknown(span)
    }
}
