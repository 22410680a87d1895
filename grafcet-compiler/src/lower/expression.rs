//! Expressions to nodes, edges and timers to watches.

use grafcet_core::program::{Bit, Code, Condition, Edge, Slot, Unit, Watch};

use super::atoms::Atom;
use super::node::Node;
use super::unit::{Kind, Lowering};
use super::watch::{Context, NO_BIT, NO_STAMP};
use crate::ast::Binary;
use crate::model::{DeclarationKind, Expression, ExpressionKind, GraphId, Situation, Type};

/// Milliseconds in a second.
const MS_PER_SECOND: i32 = 1000;

impl Lowering<'_> {
    /// When a Boolean expression holds that stands there.
    pub fn condition(&mut self, expression: &Expression, context: Context) -> Condition {
        let node = self.node(expression, context);
        self.pool.condition(&node, expression.span)
    }

    /// The condition behind an `IF` that may be missing.
    pub fn optional(&mut self, condition: Option<&Expression>, context: Context) -> Condition {
        condition.map_or(Condition::ALWAYS, |condition| {
            self.condition(condition, context)
        })
    }

    /// Code for a number.
    pub fn code(&mut self, expression: &Expression, context: Context) -> Code {
        let node = self.node(expression, context);
        self.pool.code(&node, expression.span)
    }

    /// The bit that tells that an event has come: an edge standing alone, or a value taken while its step is active.
    pub fn event(&mut self, event: &Expression, step: Bit) -> Bit {
        // In whichever situation, for an edge as for a value.
        let node = self.at_any_time(|unit| unit.node(event, Context::Trigger));
        match node {
            Node::Bit(bit) if event.bare().is_edge() => bit,
            node => {
                let condition = self.pool.condition(&node, event.span);
                self.watch(Context::Trigger, value(condition, Some(step)))
            }
        }
    }

    /// The bit with the value of a claim.
    pub fn claim(&mut self, claim: &Expression) -> Bit {
        let condition = self.condition(claim, Context::Action);
        self.watch(Context::Action, value(condition, None))
    }

    fn watch(&mut self, context: Context, watch: Watch) -> Bit {
        if self.pool.can_fault(&watch) {
            self.watches.result(context, watch, &mut self.memories)
        } else {
            self.watches.shared(context, watch, &mut self.memories)
        }
    }

    pub(super) fn node(&mut self, expression: &Expression, context: Context) -> Node {
        match &expression.kind {
            ExpressionKind::Unknown => Node::Constant(0),
            ExpressionKind::Constant(value) => Node::Constant(*value),
            ExpressionKind::Variable(id) if self.model[*id].kind == DeclarationKind::Constant => {
                Node::Constant(self.model[*id].initial.unwrap_or(0))
            }
            ExpressionKind::Variable(id) => self.place(Atom::Variable(*id)),
            ExpressionKind::Bound(_, inner) => self.node(inner, context),
            ExpressionKind::Step(id) => self.place(Atom::Step(*id)),
            ExpressionKind::Macro(id) => self.place(Atom::Macro(*id)),
            ExpressionKind::System(system) => self.place(Atom::System(*system)),
            ExpressionKind::Situation {
                graph,
                situation,
                equal,
            } => {
                let node = self.situation(*graph, situation);
                if *equal { node } else { node.not() }
            }
            ExpressionKind::Timer { enable, preset } => self.timer(enable, preset, context),
            ExpressionKind::Delay { on, enable, off } => {
                self.delay(on, enable, off.as_deref(), context)
            }
            ExpressionKind::Edge(edge, operand) => self.edge(*edge, operand, context),
            ExpressionKind::Not(inner) => self.node(inner, context).not(),
            ExpressionKind::Negate(inner) => self.node(inner, context).negate(),
            ExpressionKind::Binary(operator, left, right) => {
                let boolean = left.ty == Some(Type::Bool);
                let left = self.node(left, context);
                let right = self.node(right, context);
                Node::binary(*operator, left, right, boolean)
            }
        }
    }

    fn place(&self, atom: Atom) -> Node {
        match self.places.slot(atom) {
            Some(Slot::Bit(bit)) => Node::Bit(bit),
            Some(Slot::Number(number)) => Node::Number(number),
            None => Node::Constant(0),
        }
    }

    fn situation(&self, graph: GraphId, situation: &Situation) -> Node {
        let active = self.model.steps_of(graph, situation).unwrap_or_default();
        let active: std::collections::BTreeSet<_> = active.into_iter().collect();
        let steps = self.model[graph].step_ids();
        Node::Situation(
            steps
                .map(|step| (self.places.bit(Atom::Step(step)), active.contains(&step)))
                .collect(),
        )
    }

    fn edge(&mut self, edge: Edge, operand: &Expression, context: Context) -> Node {
        // Edges are looked at in every scan.
        let node = self.at_any_time(|unit| unit.node(operand, context));
        let lone_step = operand.is_step() && edge == Edge::Rising;
        let from_false = lone_step && context != Context::Trigger && self.kind != Kind::Observer;
        if let Node::Bit(input) = node
            && self.has_input_edges(input)
        {
            let bit = self.watches.input_edge(input, edge, &mut self.memories);
            return Node::Bit(bit);
        }
        let operand = self.pool.condition(&node, operand.span);
        Node::Bit(self.watch(
            context,
            Watch::Edge {
                operand,
                edge,
                last: NO_BIT,
                result: NO_BIT,
                from_false,
            },
        ))
    }

    /// Whether the edges of a bit are the same in all phases of a scan, so that its whole word can be watched at once.
    fn has_input_edges(&self, bit: Bit) -> bool {
        let inputs = self.places.layout.inputs.indices();
        self.kind == Kind::Graphs && !self.model.stable && inputs.contains(&bit.word())
    }

    fn timer(&mut self, enable: &Expression, preset: &Expression, context: Context) -> Node {
        if let Some(timer) = self.step_timer(enable, preset, context) {
            return self.settled(timer, preset, context);
        }
        let enable = self.at_any_time(|unit| unit.condition(enable, context));
        let (node, unit) = self.preset(preset, context);
        let preset = self.pool.code(&node, preset.span);
        Node::Bit(self.watch(
            context,
            Watch::Timer {
                enable,
                preset,
                unit,
                last: NO_BIT,
                risen: NO_STAMP,
                result: NO_BIT,
            },
        ))
    }

    fn delay(
        &mut self,
        on: &Expression,
        enable: &Expression,
        off: Option<&Expression>,
        context: Context,
    ) -> Node {
        let delayed = match self.step_timer(enable, on, context) {
            Some(timer) => {
                let step = self.node(enable, context);
                let both = Node::binary(Binary::And, timer, step, true);
                self.settled(both, on, context)
            }
            None => {
                let condition = self.at_any_time(|unit| unit.condition(enable, context));
                let delay = self.code(on, context);
                Node::Bit(self.watch(
                    context,
                    Watch::OnDelay {
                        enable: condition,
                        delay,
                        last: NO_BIT,
                        risen: NO_STAMP,
                        result: NO_BIT,
                    },
                ))
            }
        };
        let Some(off) = off else {
            return delayed;
        };
        let on = self.pool.condition(&delayed, enable.span);
        let hold = self.code(off, context);
        Node::Bit(self.watch(
            context,
            Watch::OffDelay {
                on,
                hold,
                last: NO_BIT,
                fallen: NO_STAMP,
                result: NO_BIT,
            },
        ))
    }

    /// The timer of a step or macro bit standing alone, which the time of activation serves. An observer sees other
    /// programs' steps and knows no such times: it watches the bit.
    fn step_timer(
        &mut self,
        enable: &Expression,
        preset: &Expression,
        context: Context,
    ) -> Option<Node> {
        if self.kind == Kind::Observer {
            return None;
        }
        let atom = match enable.bare().kind {
            ExpressionKind::Step(id) => Atom::Step(id),
            ExpressionKind::Macro(id) => Atom::Macro(id),
            _ => return None,
        };
        // A plant may be given a bit of the controller by an instance's binding.
        if !self.is_own(atom) {
            return None;
        }
        if let Some(timer) = self.own_timer(atom, preset, context) {
            return Some(Node::Timer(timer));
        }
        let (node, unit) = self.preset(preset, context);
        Some(Node::StepTimer {
            step: self.places.bit(atom),
            activated: self.activation(atom),
            unit,
            preset: Box::new(node),
        })
    }

    /// A timer as it is, where it may be evaluated any time in its phase; else its value when its phase begins.
    fn settled(&mut self, timer: Node, preset: &Expression, context: Context) -> Node {
        if self.is_steady(preset, context) {
            return timer;
        }
        let condition = self.pool.condition(&timer, preset.span);
        Node::Bit(self.watch(context, value(condition, None)))
    }

    /// Whether a timer with that preset cannot fault and gives the same value throughout the phase.
    pub(super) fn is_steady(&self, preset: &Expression, context: Context) -> bool {
        let constant = preset.constant(self.model).is_some();
        match (context, &preset.bare().kind) {
            (Context::Round, _) => false,
            _ if constant => true,
            (Context::Action, ExpressionKind::Variable(id)) => matches!(
                self.model[*id].kind,
                DeclarationKind::Input | DeclarationKind::Parameter
            ),
            (_, ExpressionKind::Variable(_)) => true,
            _ => false,
        }
    }

    /// A preset and its unit; a constant one in ms.
    pub(super) fn preset(&mut self, preset: &Expression, context: Context) -> (Node, Unit) {
        let seconds = preset.ty == Some(Type::Int);
        match preset.constant(self.model) {
            Some(value) if seconds => (
                Node::Constant(value.saturating_mul(MS_PER_SECOND)),
                Unit::Milliseconds,
            ),
            Some(value) => (Node::Constant(value), Unit::Milliseconds),
            None if seconds => (self.node(preset, context), Unit::Seconds),
            None => (self.node(preset, context), Unit::Milliseconds),
        }
    }
}

fn value(condition: Condition, gate: Option<Bit>) -> Watch {
    Watch::Value {
        condition,
        gate,
        result: NO_BIT,
    }
}
