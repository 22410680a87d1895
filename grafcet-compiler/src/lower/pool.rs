//! Conditions and code: tables in which equal rows are shared.

use std::collections::{BTreeMap, HashMap};
use std::hash::Hash;

use grafcet_core::program::{
    Bit, Code, Condition, Op, Preset, Rest, Run, Target, Term, Timer, Unit, Watch,
};

use super::limits::{self, index};
use super::node::Node;
use crate::ast::Binary;
use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// Conditions, terms and operations.
pub(super) struct Pool {
    pub conditions: Shared<Condition>,
    pub terms: Shared<Term>,
    pub targets: Shared<Target>,
    pub timers: Shared<Timer>,
    pub codes: Shared<Code>,
    pub ops: Vec<Op>,
    /// Depth of the stack that the deepest code needs.
    pub stack: usize,
    /// What is too large for its place: expressions, and what a step does.
    pub beyond: Vec<Diagnostic>,
    known_ops: HashMap<Vec<Op>, Code>,
}

/// A table in which a run of rows that is asked for again is found again.
pub(super) struct Shared<T> {
    pub rows: Vec<T>,
    known: HashMap<Vec<T>, Run>,
}

impl<T> Default for Shared<T> {
    fn default() -> Self {
        Shared {
            rows: Vec::new(),
            known: HashMap::new(),
        }
    }
}

impl<T: Clone + Eq + Hash> Shared<T> {
    /// A table with that first row.
    pub fn behind(first: T) -> Self {
        let mut shared = Shared::default();
        shared.row(first);
        shared
    }

    /// Where these rows stand one behind the other.
    pub fn run(&mut self, rows: Vec<T>) -> Run {
        if rows.is_empty() {
            return Run::EMPTY;
        }
        if let Some(run) = self.known.get(&rows) {
            return *run;
        }
        let run = Run {
            start: index(self.rows.len()),
            len: index(rows.len()),
        };
        self.rows.extend(rows.iter().cloned());
        self.known.insert(rows, run);
        run
    }

    /// Where this row stands.
    pub fn row(&mut self, row: T) -> u16 {
        self.run(vec![row]).start
    }
}

/// A condition whose first term stands apart.
pub(super) struct Headed {
    /// Row of the terms.
    pub first: u16,
    /// Row of the conditions.
    pub condition: u16,
}

/// What always holds, as a term.
const NO_TERM: Term = Term {
    word: 0,
    mask: 0,
    state: 0,
};

impl Default for Pool {
    fn default() -> Self {
        Pool {
            conditions: Shared::behind(Condition::ALWAYS),
            terms: Shared::default(),
            targets: Shared::default(),
            timers: Shared::default(),
            codes: Shared::default(),
            ops: Vec::new(),
            stack: 0,
            beyond: Vec::new(),
            known_ops: HashMap::new(),
        }
    }
}

impl Pool {
    /// When a Boolean holds.
    pub fn condition(&mut self, node: &Node, span: Span) -> Condition {
        let (terms, rest) = self.conjunction(&[], node, span);
        Condition {
            terms: self.terms.run(terms),
            rest,
        }
    }

    /// When a Boolean holds and all these bits are True; whether they are is looked at first.
    pub fn headed(&mut self, bits: &[Bit], node: &Node, span: Span) -> Headed {
        let (mut terms, rest) = self.conjunction(bits, node, span);
        let first = if terms.is_empty() {
            NO_TERM
        } else {
            terms.remove(0)
        };
        let condition = Condition {
            terms: self.terms.run(terms),
            rest,
        };
        Headed {
            first: self.terms.row(first),
            condition: self.conditions.row(condition),
        }
    }

    fn conjunction(&mut self, bits: &[Bit], node: &Node, span: Span) -> (Vec<Term>, Rest) {
        let mut literals: Vec<(Bit, bool)> = bits.iter().map(|bit| (*bit, true)).collect();
        // What can fault is evaluated whole, whatever its other operands are.
        let others = if node.can_fault() {
            vec![node.clone()]
        } else {
            let mut conjuncts = node.conjuncts();
            literals.append(&mut conjuncts.literals);
            conjuncts.others
        };
        match merged(&literals) {
            Some(terms) => (terms, self.rest(others, span)),
            // `a AND NOT a`.
            None => (Vec::new(), self.rest(vec![Node::Constant(0)], span)),
        }
    }

    fn rest(&mut self, others: Vec<Node>, span: Span) -> Rest {
        if let [only] = others.as_slice() {
            let (node, negated) = match only {
                Node::Not(inner) => (inner.as_ref(), true),
                node => (node, false),
            };
            if let Some(timer) = timer(node) {
                let row = self.timers.row(timer);
                return if negated {
                    Rest::Running(row)
                } else {
                    Rest::Elapsed(row)
                };
            }
        }
        if others.is_empty() {
            return Rest::None;
        }
        let code = self.conjunction_code(&others, span);
        let row = self.codes.row(code);
        if self.is_logic(code) {
            Rest::Logic(row)
        } else {
            Rest::Code(row)
        }
    }

    /// Whether evaluating the operands of a watch can count an arithmetic fault.
    pub fn can_fault(&self, watch: &Watch) -> bool {
        let of = |condition: &Condition| match condition.rest {
            Rest::Code(code) => self.codes.rows.get(usize::from(code)).copied(),
            Rest::None | Rest::Elapsed(_) | Rest::Running(_) | Rest::Logic(_) => None,
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

    /// Whether code works on nothing but Booleans, and not on more of them at once than a word holds.
    fn is_logic(&self, code: Code) -> bool {
        let mut depth = 0;
        self.ops_of(code).iter().all(|op| {
            match op {
                Op::Bit(_) | Op::Elapsed(_) | Op::Constant(0 | 1) => depth += 1,
                Op::And | Op::Or | Op::Xor => depth -= 1,
                Op::Not | Op::AndElapsed(_) => {}
                _ => return false,
            }
            depth <= 32
        })
    }

    /// Code that leaves a value.
    pub fn code(&mut self, node: &Node, span: Span) -> Code {
        self.conjunction_code(std::slice::from_ref(node), span)
    }

    /// Code that leaves the value of the one operand, or the conjunction of several: one behind the other and not as
    /// a tree, which would be as deep as they are many. Timers are asked for behind all others, and only where those hold.
    fn conjunction_code(&mut self, operands: &[Node], span: Span) -> Code {
        let mut ops = Vec::new();
        let (timers, others): (Vec<_>, Vec<_>) = operands
            .iter()
            .partition(|operand| operands.len() > 1 && timer(operand).is_some());
        for (place, operand) in others.into_iter().chain(timers).enumerate() {
            if place > 0
                && let Some(timer) = timer(operand)
            {
                ops.push(Op::AndElapsed(self.timers.row(timer)));
                continue;
            }
            let depth = push(operand, &mut self.timers, &mut ops);
            self.stack = self.stack.max(depth + place.min(1));
            if place > 0 {
                ops.push(Op::And);
            }
        }
        if let Some(code) = self.known_ops.get(&ops) {
            return *code;
        }
        if ops.len() > limits::MOST {
            self.beyond.push(limits::too_long(ops.len(), span));
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

/// The timer on a step that a node is, unless its preset is calculated.
fn timer(node: &Node) -> Option<Timer> {
    match node {
        Node::Timer(timer) => Some(*timer),
        Node::StepTimer {
            step,
            activated,
            unit,
            preset,
        } => {
            let preset = match (preset.as_ref(), unit) {
                (Node::Constant(ms), Unit::Milliseconds) => Preset::Constant(*ms),
                (Node::Number(number), unit) => Preset::Number(*number, *unit),
                _ => return None,
            };
            Some(Timer::Any {
                step: *step,
                activated: *activated,
                preset,
            })
        }
        _ => None,
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
fn push(node: &Node, timers: &mut Shared<Timer>, ops: &mut Vec<Op>) -> usize {
    match node {
        Node::Constant(value) => ops.push(Op::Constant(*value)),
        Node::Bit(bit) => ops.push(Op::Bit(*bit)),
        Node::Number(number) => ops.push(Op::Number(*number)),
        Node::Situation(steps) => return push_situation(steps, ops),
        Node::Timer(timer) => ops.push(Op::Elapsed(timers.row(*timer))),
        Node::StepTimer {
            step,
            activated,
            unit,
            preset,
        } => {
            if let Some(timer) = timer(node) {
                ops.push(Op::Elapsed(timers.row(timer)));
                return 1;
            }
            let depth = push(preset, timers, ops);
            ops.push(Op::StepTimer {
                step: *step,
                activated: *activated,
                unit: *unit,
            });
            return depth;
        }
        Node::Not(inner) => {
            let depth = push(inner, timers, ops);
            ops.push(Op::Not);
            return depth;
        }
        Node::Negate(inner) => {
            let depth = push(inner, timers, ops);
            ops.push(Op::Negate);
            return depth;
        }
        Node::Binary(operator, left, right) => {
            let depth = push(left, timers, ops);
            let depth = depth.max(push(right, timers, ops) + 1);
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
