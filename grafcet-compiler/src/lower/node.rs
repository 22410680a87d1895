//! Expressions over places, simplified where nothing that counts is lost.

use grafcet_core::program::{Bit, Number, Stamp, Timer, Unit};

use crate::ast::Binary;
use crate::model::combine;

/// An expression over places of one program.
#[derive(Clone, Debug)]
pub(super) enum Node {
    Constant(i32),
    Bit(Bit),
    Number(Number),
    /// All of these bits stand like this.
    Situation(Vec<(Bit, bool)>),
    /// A timer that is asked for only while its step is active.
    Timer(Timer),
    StepTimer {
        step: Bit,
        activated: Stamp,
        unit: Unit,
        preset: Box<Node>,
    },
    Not(Box<Node>),
    Negate(Box<Node>),
    Binary(Binary, Box<Node>, Box<Node>),
}

impl Node {
    /// `NOT`.
    pub fn not(self) -> Node {
        match self {
            Node::Constant(value) => Node::Constant(i32::from(value == 0)),
            Node::Not(inner) => *inner,
            node => Node::Not(Box::new(node)),
        }
    }

    /// Unary minus. One that overflows stays, since it counts.
    pub fn negate(self) -> Node {
        match self {
            Node::Constant(value) if value != i32::MIN => Node::Constant(-value),
            node => Node::Negate(Box::new(node)),
        }
    }

    /// Two operands of which at least one is Boolean if `boolean` is set.
    pub fn binary(operator: Binary, left: Node, right: Node, boolean: bool) -> Node {
        let both = |left, right| Node::Binary(operator, Box::new(left), Box::new(right));
        match (left, right) {
            (Node::Constant(left), Node::Constant(right)) => {
                let value = combine(operator, Some(left), Some(right));
                value.map_or_else(
                    || both(Node::Constant(left), Node::Constant(right)),
                    Node::Constant,
                )
            }
            (Node::Constant(constant), other) if boolean => absorb(operator, constant, other)
                .unwrap_or_else(|other| both(Node::Constant(constant), other)),
            (other, Node::Constant(constant)) if boolean => absorb(operator, constant, other)
                .unwrap_or_else(|other| both(other, Node::Constant(constant))),
            (left, right) => both(left, right),
        }
    }

    /// Whether evaluating it can count an arithmetic fault, so that it must not be left out.
    pub fn can_fault(&self) -> bool {
        match self {
            Node::Constant(_)
            | Node::Bit(_)
            | Node::Number(_)
            | Node::Situation(_)
            | Node::Timer(_) => false,
            Node::StepTimer { preset, .. } => preset.can_fault(),
            Node::Not(inner) => inner.can_fault(),
            Node::Negate(_) => true,
            Node::Binary(operator, left, right) => {
                matches!(
                    operator,
                    Binary::Add
                        | Binary::Subtract
                        | Binary::Multiply
                        | Binary::Divide
                        | Binary::Modulo
                ) || left.can_fault()
                    || right.can_fault()
            }
        }
    }

    /// The operands of the conjunction that the node is: literals, and what is none.
    pub fn conjuncts(&self) -> Conjuncts {
        let mut conjuncts = Conjuncts::default();
        self.split(true, &mut conjuncts);
        conjuncts
    }

    fn split(&self, positive: bool, into: &mut Conjuncts) {
        match self {
            Node::Bit(bit) => into.literals.push((*bit, positive)),
            Node::Constant(value) if (*value != 0) == positive => {}
            Node::Not(inner) => inner.split(!positive, into),
            Node::Situation(steps) if positive => into.literals.extend(steps),
            Node::Situation(steps) if steps.len() == 1 => {
                into.literals
                    .extend(steps.iter().map(|(bit, value)| (*bit, !value)));
            }
            Node::Binary(Binary::And, left, right) if positive => {
                left.split(true, into);
                right.split(true, into);
            }
            Node::Binary(Binary::Or, left, right) if !positive => {
                left.split(false, into);
                right.split(false, into);
            }
            node if positive => into.others.push(node.clone()),
            node => into.others.push(node.clone().not()),
        }
    }
}

/// The operands of a conjunction.
#[derive(Default)]
pub(super) struct Conjuncts {
    /// Bits, and how they must stand.
    pub literals: Vec<(Bit, bool)>,
    /// Everything else.
    pub others: Vec<Node>,
}

/// A Boolean operator on a constant and something else, which is given back when it has to stay.
fn absorb(operator: Binary, constant: i32, other: Node) -> Result<Node, Node> {
    let truth = constant != 0;
    match (operator, truth) {
        (Binary::And, true) | (Binary::Or, false) | (Binary::Xor, false) => Ok(other),
        (Binary::Equal, true) | (Binary::NotEqual, false) => Ok(other),
        (Binary::Xor, true) | (Binary::Equal, false) | (Binary::NotEqual, true) => Ok(other.not()),
        (Binary::And, false) | (Binary::Or, true) if !other.can_fault() => {
            Ok(Node::Constant(constant))
        }
        _ => Err(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bit(number: u16) -> Node {
        Node::Bit(Bit(number))
    }

    #[test]
    fn a_negated_disjunction_is_a_conjunction() {
        let node = Node::binary(Binary::Or, bit(1), bit(2).not(), true).not();
        let conjuncts = node.conjuncts();
        assert_eq!(conjuncts.literals, [(Bit(1), false), (Bit(2), true)]);
        assert_eq!(conjuncts.others.len(), 0);
    }

    #[test]
    fn a_disjunction_is_no_conjunction() {
        let conjuncts = Node::binary(Binary::Or, bit(1), bit(2), true).conjuncts();
        assert_eq!(conjuncts.literals, []);
        assert_eq!(conjuncts.others.len(), 1);
    }

    #[test]
    fn what_can_fault_is_never_left_out() {
        let number = || Box::new(Node::Number(Number(2)));
        let faulty = Node::Binary(Binary::Divide, number(), number());
        let compared = Node::binary(Binary::Greater, faulty, Node::Constant(0), false);
        let node = Node::binary(Binary::And, Node::Constant(0), compared, true);
        assert!(matches!(node, Node::Binary(Binary::And, ..)));
        let overflow = Node::binary(Binary::Divide, Node::Constant(1), Node::Constant(0), false);
        assert!(matches!(overflow, Node::Binary(Binary::Divide, ..)));
    }
}
