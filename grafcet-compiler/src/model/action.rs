//! Bodies of graphs: triggers, actions, enclosing steps.

use super::names::View;
use super::resolver::Resolver;
use super::{
    Action, Encloses, Expression, GraphId, Momentary, OnEvent, Order, Situation, Stored, Trigger,
};
use crate::ast::{self, StatementKind};
use crate::diagnostic::{Diagnostic, Rule};
use crate::source::Span;

impl Resolver<'_> {
    /// Looks up everything in a graph whose names are known.
    pub(super) fn take_body(&mut self, graph: GraphId) {
        let view = self.inside(graph);
        let always = std::mem::take(&mut self.bodies[graph.0].always);
        for text in &always {
            let action = self.block(&text.block, view);
            self.model[graph].always.push(action);
        }
        let steps = std::mem::take(&mut self.bodies[graph.0].steps);
        for (id, text) in self.model[graph].step_ids().zip(&steps) {
            let encloses = text.encloses.iter();
            self.model[id].encloses = encloses
                .filter_map(|(name, set)| self.encloses(name, set, view))
                .collect();
            if let Some(block) = &text.block {
                self.model[id].action = self.block(block, view);
            }
        }
        let transitions = std::mem::take(&mut self.bodies[graph.0].transitions);
        for (id, text) in self.model[graph].transition_ids().zip(&transitions) {
            self.model[id].trigger = self.trigger(&text.trigger, view);
            if let Some(block) = &text.action {
                self.model[id].action = self.block(block, view);
            }
        }
    }

    fn trigger(&mut self, trigger: &ast::Trigger, view: View) -> Trigger {
        match trigger {
            ast::Trigger::AlwaysTrue => Trigger::Always,
            ast::Trigger::Expression(text) => match text.kind {
                ast::ExpressionKind::Bool(true) => Trigger::Always,
                _ => Trigger::Expression(self.condition(text, "a trigger", view)),
            },
            ast::Trigger::Text(text) => {
                let message = "a trigger that is only a text cannot be executed";
                let diagnostic = Diagnostic::new(Rule::Level1Only, text.span, message)
                    .help("write a Boolean expression behind `when`");
                self.report(diagnostic);
                Trigger::Unknown
            }
        }
    }

    fn encloses(&mut self, name: &ast::Name, set: &ast::Set, view: View) -> Option<Encloses> {
        let graph = self.subordinate(name, view)?;
        let steps = self.set(graph, set);
        Some(Encloses {
            graph,
            steps,
            span: name.span,
        })
    }

    /// A graph that is forced or enclosed: by the controller one of its own, by a plant itself only.
    fn subordinate(&mut self, name: &ast::Name, view: View) -> Option<GraphId> {
        let graph = self.find_graph(name, view)?;
        if matches!(view, View::Plant(home) if home != graph) {
            let message = format!(
                "a plant has no power over `{}`: it stands in for the machine",
                name.text
            );
            self.report(Diagnostic::new(Rule::UnknownGraph, name.span, message));
            return None;
        }
        Some(graph)
    }

    fn block(&mut self, block: &ast::Block, view: View) -> Action {
        if is_text_only(&block.statements) {
            let diagnostic = Diagnostic::new(
                Rule::Level1Only,
                block.span,
                "an action that is only a text cannot be executed",
            )
            .help("write statements; a text may stand beside them");
            self.report(diagnostic);
        }
        let mut action = Action::default();
        for statement in &block.statements {
            self.statement(statement, view, &mut action);
        }
        action
    }

    /// A statement. The parser has seen to it that it may stand where it stands.
    fn statement(&mut self, statement: &ast::Statement, view: View, action: &mut Action) {
        match &statement.kind {
            StatementKind::Momentary { targets, condition } => {
                let momentary = self.momentary(targets, condition.as_ref(), statement.span, view);
                action.momentary.extend(momentary);
            }
            StatementKind::Stored { .. } => action.stored.extend(self.stored(statement, view)),
            StatementKind::On { event, statements } => self.on(event, statements, view, action),
            StatementKind::Force { .. } => action.orders.extend(self.order(statement, view)),
            StatementKind::Text(_) => {}
        }
    }

    fn momentary(
        &mut self,
        targets: &[ast::Ref],
        condition: Option<&ast::Expression>,
        span: Span,
        view: View,
    ) -> Option<Momentary> {
        let mut found = Vec::with_capacity(targets.len());
        for name in targets {
            if let Some(target) = self.target(name, view)
                && self.check_momentary(target)
            {
                found.push(target);
            }
        }
        let condition = self.optional_condition(condition, view);
        (!found.is_empty()).then_some(Momentary {
            targets: found,
            condition,
            span,
        })
    }

    fn optional_condition(
        &mut self,
        condition: Option<&ast::Expression>,
        view: View,
    ) -> Option<Expression> {
        condition.map(|condition| self.condition(condition, "a condition", view))
    }

    fn stored(&mut self, statement: &ast::Statement, view: View) -> Option<Stored> {
        let StatementKind::Stored {
            target,
            value,
            condition,
        } = &statement.kind
        else {
            return None;
        };
        let target = self.target(target, view);
        let value = self.expression(value, view);
        let condition = self.optional_condition(condition.as_ref(), view);
        let target = target?;
        if self.check_assigned(target, &value) {
            self.check_stored(target, &value);
        }
        Some(Stored {
            target,
            value,
            condition,
            span: statement.span,
        })
    }

    fn on(
        &mut self,
        event: &ast::Event,
        statements: &[ast::Statement],
        view: View,
        action: &mut Action,
    ) {
        let mut stored = Vec::new();
        for statement in statements {
            stored.extend(self.stored(statement, view));
        }
        match event {
            ast::Event::Activation => action.on_activation.extend(stored),
            ast::Event::Deactivation => action.on_deactivation.extend(stored),
            ast::Event::Expression(text) => {
                let event = self.event(text, view);
                action.on_event.push(OnEvent { event, stored });
            }
        }
    }

    fn event(&mut self, text: &ast::Expression, view: View) -> Expression {
        let event = self.condition(text, "an event", view);
        let wrong = event.contains(|it| it.ty.is_none());
        if !wrong && !event.contains(Expression::is_edge) {
            let diagnostic = Diagnostic::new(
                Rule::EventWithoutEdge,
                event.span,
                "an event is an edge, and there is none in this expression",
            )
            .help("write `↑` or `↓` before what rises or falls");
            self.report(diagnostic);
        }
        event
    }

    fn order(&mut self, statement: &ast::Statement, view: View) -> Option<Order> {
        let StatementKind::Force {
            graph,
            situation,
            condition,
        } = &statement.kind
        else {
            return None;
        };
        let graph = self.subordinate(graph, view);
        let situation = match situation {
            ast::Situation::Steps(set) => graph.map(|graph| Situation::Steps(self.set(graph, set))),
            ast::Situation::Initial(_) => Some(Situation::Initial),
            ast::Situation::Current(_) => Some(Situation::Current),
        };
        let condition = self.optional_condition(condition.as_ref(), view);
        Some(Order {
            graph: graph?,
            situation: situation?,
            condition,
            span: statement.span,
        })
    }
}

/// Whether a block says something, but only in words.
fn is_text_only(statements: &[ast::Statement]) -> bool {
    !statements.is_empty()
        && statements.iter().all(|statement| match &statement.kind {
            StatementKind::Text(_) => true,
            StatementKind::On { statements, .. } => is_text_only(statements),
            _ => false,
        })
}
