//! Conditions and code: the tables of terms and operations, in which equal ones share their rows.

use std::collections::{BTreeMap, HashMap};

use grafcet_core::program::{Bit, Code, Condition, Op, Run, Term, Watch};

use super::limits::{self, index};
use super::node::Node;
use crate::ast::Binary;
use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// Terms and operations.
#[derive(Default)]
pub(super) struct Pool {
    pub terms: Vec<Term>,
    pub ops: Vec<Op>,
    /// Depth of the stack that the deepest code needs.
    pub stack: usize,
    /// Expressions that are too long.
    pub too_long: Vec<Diagnostic>,
    known_terms: HashMap<Vec<Term>, Run>,
    known_ops: HashMap<Vec<Op>, Code>,
}

impl Pool {
    /// When a Boolean holds.
    pub fn condition(&mut self, node: &Node, span: Span) -> Condition {
        match node.literals().map(|literals| merged(&literals)) {
            Some(Some(terms)) if terms.is_empty() => Condition::Always,
            Some(Some(terms)) => Condition::All(self.run(terms)),
            // `a AND NOT a`.
            Some(None) => Condition::Code(self.code(&Node::Constant(0), span)),
            None => Condition::Code(self.code(node, span)),
        }
    }

    /// Whether evaluating the operands of a watch can count an arithmetic fault.
    pub fn can_fault(&self, watch: &Watch) -> bool {
        let of = |condition: &Condition| match condition {
            Condition::Code(code) => Some(*code),
            Condition::Always | Condition::All(_) => None,
        };
        let codes = match watch {
            Watch::Edge { operand, .. } => [of(operand), None],
            Watch::Timer { enable, preset, .. } => [of(enable), Some(*preset)],
            Watch::OnDelay { enable, delay, .. } => [of(enable), Some(*delay)],
            Watch::OffDelay { on, hold, .. } => [of(on), Some(*hold)],
            Watch::Value { condition, .. } => [of(condition), None],
        };
        let mut codes = codes.into_iter().flatten();
        codes.any(|code| self.ops_of(code).iter().any(can_fault))
    }

    fn ops_of(&self, code: Code) -> &[Op] {
        let start = code.start as usize;
        let ops = self.ops.get(start..start + usize::from(code.len));
        ops.unwrap_or_default()
    }

    fn run(&mut self, terms: Vec<Term>) -> Run {
        if let Some(run) = self.known_terms.get(&terms) {
            return *run;
        }
        let run = Run {
            start: index(self.terms.len()),
            len: index(terms.len()),
        };
        self.terms.extend(&terms);
        self.known_terms.insert(terms, run);
        run
    }

    /// Code that leaves a value.
    pub fn code(&mut self, node: &Node, span: Span) -> Code {
        let mut ops = Vec::new();
        let depth = push(node, &mut ops);
        self.stack = self.stack.max(depth);
        if let Some(code) = self.known_ops.get(&ops) {
            return *code;
        }
        if ops.len() > limits::MOST {
            self.too_long.push(limits::too_long(ops.len(), span));
        }
        let code = Code {
            start: u32::try_from(self.ops.len()).unwrap_or(u32::MAX),
            len: index(ops.len()),
        };
        self.ops.extend(&ops);
        self.known_ops.insert(ops, code);
        code
    }
}

fn can_fault(op: &Op) -> bool {
    matches!(
        op,
        Op::Negate | Op::Add | Op::Subtract | Op::Multiply | Op::Divide | Op::Modulo
    )
}

/// One term for each word; nothing when a bit must be both True and False.
fn merged(literals: &[(Bit, bool)]) -> Option<Vec<Term>> {
    let mut words: BTreeMap<u16, (u32, u32)> = BTreeMap::new();
    for (bit, value) in literals {
        let (mask, state) = words.entry(index(bit.word())).or_default();
        let wanted = if *value { bit.mask() } else { 0 };
        if *mask & bit.mask() != 0 && *state & bit.mask() != wanted {
            return None;
        }
        *mask |= bit.mask();
        *state |= wanted;
    }
    let term = |(word, (mask, state))| Term { word, mask, state };
    Some(words.into_iter().map(term).collect())
}

/// Appends the operations of a node and tells how deep the stack gets.
fn push(node: &Node, ops: &mut Vec<Op>) -> usize {
    match node {
        Node::Constant(value) => ops.push(Op::Constant(*value)),
        Node::Bit(bit) => ops.push(Op::Bit(*bit)),
        Node::Number(number) => ops.push(Op::Number(*number)),
        Node::Situation(steps) => return push_situation(steps, ops),
        Node::StepTimer {
            step,
            activated,
            unit,
            preset,
        } => {
            let depth = push(preset, ops);
            ops.push(Op::StepTimer {
                step: *step,
                activated: *activated,
                unit: *unit,
            });
            return depth;
        }
        Node::Not(inner) => {
            let depth = push(inner, ops);
            ops.push(Op::Not);
            return depth;
        }
        Node::Negate(inner) => {
            let depth = push(inner, ops);
            ops.push(Op::Negate);
            return depth;
        }
        Node::Binary(operator, left, right) => {
            let depth = push(left, ops);
            let depth = depth.max(push(right, ops) + 1);
            ops.push(operation(*operator));
            return depth;
        }
    }
    1
}

fn push_situation(steps: &[(Bit, bool)], ops: &mut Vec<Op>) -> usize {
    for (place, (bit, active)) in steps.iter().enumerate() {
        ops.push(Op::Bit(*bit));
        if !active {
            ops.push(Op::Not);
        }
        if place > 0 {
            ops.push(Op::And);
        }
    }
    if steps.is_empty() {
        ops.push(Op::Constant(1));
    }
    steps.len().clamp(1, 2)
}

fn operation(operator: Binary) -> Op {
    match operator {
        Binary::And => Op::And,
        Binary::Or => Op::Or,
        Binary::Xor => Op::Xor,
        Binary::Equal => Op::Equal,
        Binary::NotEqual => Op::NotEqual,
        Binary::Less => Op::Less,
        Binary::LessOrEqual => Op::LessOrEqual,
        Binary::Greater => Op::Greater,
        Binary::GreaterOrEqual => Op::GreaterOrEqual,
        Binary::Add => Op::Add,
        Binary::Subtract => Op::Subtract,
        Binary::Multiply => Op::Multiply,
        Binary::Divide => Op::Divide,
        Binary::Modulo => Op::Modulo,
    }
}
