//! Expressions: names looked up, types checked.

use super::constant::a;
use super::names::{Found, View};
use super::resolver::Resolver;
use super::{Edge, Expression, ExpressionKind, GraphId, Situation, Type};
use crate::ast::{self, Binary, Unary};
use crate::diagnostic::{Diagnostic, Rule};
use crate::source::Span;

/// How many steps all comparisons `S(G) = {..}` of an application may look at: the steps of `G`, each time.
pub const MAX_COMPARED: usize = 200_000;

impl Resolver<'_> {
    /// An expression that must be Boolean; `what` says what it is.
    pub(super) fn condition(
        &mut self,
        text: &ast::Expression,
        what: &str,
        view: View,
    ) -> Expression {
        let expression = self.expression(text, view);
        self.demand_bool(expression, what)
    }

    /// Reports a number where a Boolean must stand.
    pub(super) fn demand_bool(&mut self, expression: Expression, what: &str) -> Expression {
        match expression.ty {
            None | Some(Type::Bool) => expression,
            Some(ty) => {
                let message = format!("{what} is a Boolean, and this is {}", a(ty));
                let diagnostic = Diagnostic::new(Rule::TypeMismatch, expression.span, message)
                    .help("compare it with something, as in `n > 0`");
                self.report(diagnostic);
                Expression::unknown(expression.span)
            }
        }
    }

    /// An expression of any type. The parser has seen to it that it is not too deep, [`super::bound`] does so for what
    /// its names stand for.
    pub(super) fn expression(&mut self, text: &ast::Expression, view: View) -> Expression {
        self.substituted.depth += 1;
        let expression = self.of_kind(text, view);
        self.substituted.depth -= 1;
        expression
    }

    fn of_kind(&mut self, text: &ast::Expression, view: View) -> Expression {
        let span = text.span;
        match &text.kind {
            ast::ExpressionKind::Bool(value) => constant(i32::from(*value), Type::Bool, span),
            ast::ExpressionKind::Integer(value) => self.literal(*value, Type::Int, span),
            ast::ExpressionKind::Duration(value) => self.literal(*value, Type::Time, span),
            ast::ExpressionKind::Unreadable => Expression::unknown(span),
            ast::ExpressionKind::Ref(name) => self.name(name, view),
            ast::ExpressionKind::Situation {
                graph,
                situation,
                equal,
            } => self.situation(graph, situation, *equal, span, view),
            ast::ExpressionKind::Timer { enable, preset } => {
                let enable = self.condition(enable, "what starts a timer", view);
                let preset = self.expression(preset, view);
                self.timer(enable, preset, span)
            }
            ast::ExpressionKind::Delay { on, enable, off } => {
                let on = self.expression(on, view);
                let enable = self.expression(enable, view);
                let off = off.as_ref().map(|off| self.expression(off, view));
                self.delay(on, enable, off, span)
            }
            ast::ExpressionKind::Unary { operator, operand } => {
                let operand = self.expression(operand, view);
                self.unary(*operator, operand, span)
            }
            ast::ExpressionKind::Binary {
                operator,
                operator_span,
                left,
                right,
            } => {
                let left = self.expression(left, view);
                let right = self.expression(right, view);
                self.binary(*operator, *operator_span, left, right, span)
            }
        }
    }

    fn literal(&mut self, value: i64, ty: Type, span: Span) -> Expression {
        match self.fits(value, ty, span) {
            Some(value) => constant(value, ty, span),
            None => Expression::unknown(span),
        }
    }

    fn name(&mut self, name: &ast::Ref, view: View) -> Expression {
        let Some(found) = self.find_read(name, view) else {
            return Expression::unknown(name.span);
        };
        let (kind, ty) = match found {
            Found::Step(id) => (ExpressionKind::Step(id), Some(Type::Bool)),
            Found::Macro(id) => (ExpressionKind::Macro(id), Some(Type::Bool)),
            Found::System(system) => (ExpressionKind::System(system), Some(system.ty())),
            Found::Variable(id) => return self.variable(id, name.span),
        };
        Expression {
            kind,
            ty,
            span: name.span,
        }
    }

    fn situation(
        &mut self,
        graph: &ast::Name,
        situation: &ast::Situation,
        equal: bool,
        span: Span,
        view: View,
    ) -> Expression {
        let Some(id) = self.find_graph(graph, view) else {
            return Expression::unknown(span);
        };
        if matches!(view, View::Plant(home) if home != id) {
            let message = format!("a plant cannot see the situation of `{}`", graph.text);
            let diagnostic = Diagnostic::new(Rule::UnknownGraph, graph.span, message)
                .help("a plant reads outputs, inputs, parameters and constants");
            self.report(diagnostic);
            return Expression::unknown(span);
        }
        let situation = match situation {
            ast::Situation::Steps(set) => Situation::Steps(self.set(id, set)),
            ast::Situation::Initial(_) => Situation::Initial,
            ast::Situation::Current(_) => return Expression::unknown(span),
        };
        if !self.may_compare(id, span) {
            return Expression::unknown(span);
        }
        Expression {
            kind: ExpressionKind::Situation {
                graph: id,
                situation,
                equal,
            },
            ty: Some(Type::Bool),
            span,
        }
    }

    /// Every comparison looks at all steps of its graph; all comparisons together at [`MAX_COMPARED`] steps.
    fn may_compare(&mut self, graph: GraphId, span: Span) -> bool {
        let within = self.compared <= MAX_COMPARED;
        self.compared += self.model[graph].steps.len();
        if within && self.compared > MAX_COMPARED {
            let message = format!(
                "the situations that the program compares come to more than {MAX_COMPARED} steps"
            );
            let diagnostic = Diagnostic::new(Rule::OutOfRange, span, message)
                .help("ask for the steps that count, as in `X3 AND NOT X4`");
            self.report(diagnostic);
        }
        self.compared <= MAX_COMPARED
    }

    fn unary(&mut self, operator: Unary, operand: Expression, span: Span) -> Expression {
        let (kind, ty): (fn(Box<Expression>) -> ExpressionKind, _) = match operator {
            Unary::Not => (ExpressionKind::Not, Type::Bool),
            Unary::Rising => (|it| ExpressionKind::Edge(Edge::Rising, it), Type::Bool),
            Unary::Falling => (|it| ExpressionKind::Edge(Edge::Falling, it), Type::Bool),
            Unary::Negate => {
                if operand.ty == Some(Type::Bool) {
                    let diagnostic =
                        Diagnostic::new(Rule::TypeMismatch, span, "a Boolean is not a number")
                            .help("its contrary is `NOT`");
                    self.report(diagnostic);
                    return Expression::unknown(span);
                }
                let ty = operand.ty;
                return Expression {
                    kind: ExpressionKind::Negate(Box::new(operand)),
                    ty,
                    span,
                };
            }
        };
        let what = if operator == Unary::Not {
            "the operand of `NOT`"
        } else {
            "what an edge watches"
        };
        let operand = self.demand_bool(operand, what);
        Expression {
            kind: kind(Box::new(operand)),
            ty: Some(ty),
            span,
        }
    }

    fn binary(
        &mut self,
        operator: Binary,
        operator_span: Span,
        left: Expression,
        right: Expression,
        span: Span,
    ) -> Expression {
        if operator == Binary::Divide && is_delay(&left, &right) {
            return self.divide_as_delay(left, right, span);
        }
        let mut types = (left.ty, right.ty);
        if matches!(operator, Binary::And | Binary::Or | Binary::Xor) {
            // Whatever was wrong in an operand, a number beside it is wrong too.
            types = (types.0.or(Some(Type::Bool)), types.1.or(Some(Type::Bool)));
        }
        let ty = match types {
            (Some(left), Some(right)) => match result(operator, left, right) {
                Some(ty) => Some(ty),
                None => {
                    self.report_operands(operator, operator_span, (left, right), span);
                    return Expression::unknown(span);
                }
            },
            // Something inside was wrong: the operator still tells a Boolean from a number.
            _ if is_boolean(operator) => Some(Type::Bool),
            _ => None,
        };
        Expression {
            kind: ExpressionKind::Binary(operator, Box::new(left), Box::new(right)),
            ty,
            span,
        }
    }

    fn report_operands(
        &mut self,
        operator: Binary,
        place: Span,
        (left, right): (Type, Type),
        span: Span,
    ) {
        let sign = sign(operator);
        let both_bool = left == Type::Bool && right == Type::Bool;
        let message = if both_bool && !matches!(operator, Binary::And | Binary::Or | Binary::Xor) {
            format!("`{sign}` is not for Booleans")
        } else {
            format!("`{sign}` does not go between {} and {}", a(left), a(right))
        };
        let advice = match operator {
            Binary::Add if both_bool => Some("the Boolean sum is `OR`"),
            Binary::Multiply if both_bool => Some("the Boolean product is `AND`"),
            Binary::Subtract if both_bool => Some("write `AND NOT`"),
            Binary::And | Binary::Or | Binary::Xor => {
                Some("a number is compared first, as in `n > 0`")
            }
            Binary::Less | Binary::LessOrEqual | Binary::Greater | Binary::GreaterOrEqual
                if both_bool =>
            {
                Some("Booleans are equal, `=`, or not, `<>`")
            }
            _ if left == Type::Bool || right == Type::Bool => Some("a Boolean is never a number"),
            Binary::Multiply => Some("a time is multiplied by an int"),
            Binary::Divide => Some("a time is divided by an int"),
            _ if left != right => Some("give the int a unit, as in `2s`, or declare both alike"),
            _ => None,
        };
        let diagnostic = Diagnostic::new(Rule::TypeMismatch, place, message)
            .label(span, format!("{} and {}", a(left), a(right)));
        self.report_with_help(diagnostic, advice.map(str::to_owned));
    }
}

/// `/` with a Boolean behind it delays, and so does a second `/` with a time behind it.
fn is_delay(left: &Expression, right: &Expression) -> bool {
    let half_delay = matches!(left.kind, ExpressionKind::Delay { off: None, .. });
    right.ty == Some(Type::Bool) && left.ty != Some(Type::Bool) || half_delay
}

fn constant(value: i32, ty: Type, span: Span) -> Expression {
    Expression {
        kind: ExpressionKind::Constant(value),
        ty: Some(ty),
        span,
    }
}

fn is_boolean(operator: Binary) -> bool {
    !matches!(
        operator,
        Binary::Add | Binary::Subtract | Binary::Multiply | Binary::Divide | Binary::Modulo
    )
}

/// The type of a result; nothing when the operands do not go together.
fn result(operator: Binary, left: Type, right: Type) -> Option<Type> {
    use Type::{Bool, Int, Time};
    match operator {
        Binary::And | Binary::Or | Binary::Xor => (left == Bool && right == Bool).then_some(Bool),
        Binary::Equal | Binary::NotEqual => (left == right).then_some(Bool),
        Binary::Less | Binary::LessOrEqual | Binary::Greater | Binary::GreaterOrEqual => {
            (left == right && left != Bool).then_some(Bool)
        }
        Binary::Add | Binary::Subtract => (left == right && left != Bool).then_some(left),
        Binary::Multiply => match (left, right) {
            (Int, Int) => Some(Int),
            (Time, Int) | (Int, Time) => Some(Time),
            _ => None,
        },
        Binary::Divide => match (left, right) {
            (Int, Int) => Some(Int),
            (Time, Int) => Some(Time),
            _ => None,
        },
        Binary::Modulo => (left == Int && right == Int).then_some(Int),
    }
}

fn sign(operator: Binary) -> &'static str {
    match operator {
        Binary::And => "AND",
        Binary::Or => "OR",
        Binary::Xor => "XOR",
        Binary::Equal => "=",
        Binary::NotEqual => "<>",
        Binary::Less => "<",
        Binary::LessOrEqual => "<=",
        Binary::Greater => ">",
        Binary::GreaterOrEqual => ">=",
        Binary::Add => "+",
        Binary::Subtract => "-",
        Binary::Multiply => "*",
        Binary::Divide => "/",
        Binary::Modulo => "MOD",
    }
}
