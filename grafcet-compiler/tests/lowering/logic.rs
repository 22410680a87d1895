//! Logic in one word is what code on a stack is, and what the expression says.

use grafcet_compiler::application::Tables;
use grafcet_core::Engine;
use grafcet_core::program::{Bit, Condition, Rest};
use grafcet_core::vectors::Vectors;
use proptest::prelude::*;

use crate::tables;

/// A Boolean expression over five inputs and how long the only step is active.
#[derive(Clone, Debug)]
enum Expression {
    Input(u16),
    Elapsed(u64),
    Not(Box<Expression>),
    And(Box<Expression>, Box<Expression>),
    Or(Box<Expression>, Box<Expression>),
    Xor(Box<Expression>, Box<Expression>),
}

impl Expression {
    fn text(&self) -> String {
        match self {
            Expression::Input(index) => format!("i{index}"),
            Expression::Elapsed(ms) => format!("T/X1/{ms}ms"),
            Expression::Not(inner) => format!("NOT ({})", inner.text()),
            Expression::And(left, right) => format!("({} AND {})", left.text(), right.text()),
            Expression::Or(left, right) => format!("({} OR {})", left.text(), right.text()),
            Expression::Xor(left, right) => format!("({} XOR {})", left.text(), right.text()),
        }
    }

    fn holds(&self, inputs: u32, now_ms: u64) -> bool {
        let holds = |inner: &Expression| inner.holds(inputs, now_ms);
        match self {
            Expression::Input(index) => inputs & 1 << index != 0,
            Expression::Elapsed(ms) => now_ms >= *ms,
            Expression::Not(inner) => !holds(inner),
            Expression::And(left, right) => holds(left) && holds(right),
            Expression::Or(left, right) => holds(left) || holds(right),
            Expression::Xor(left, right) => holds(left) != holds(right),
        }
    }
}

fn expression() -> impl Strategy<Value = Expression> {
    let leaf = prop_oneof![
        4 => (0_u16..5).prop_map(Expression::Input),
        1 => (1_u64..5).prop_map(|scans| Expression::Elapsed(scans * 10)),
    ];
    leaf.prop_recursive(8, 60, 2, |inner| {
        let two = || {
            (
                inner.clone().prop_map(Box::new),
                inner.clone().prop_map(Box::new),
            )
        };
        prop_oneof![
            inner.clone().prop_map(|it| Expression::Not(Box::new(it))),
            two().prop_map(|(left, right)| Expression::And(left, right)),
            two().prop_map(|(left, right)| Expression::Or(left, right)),
            two().prop_map(|(left, right)| Expression::Xor(left, right)),
        ]
    })
}

/// The same tables with the logic as code.
fn as_code(tables: &Tables) -> Tables {
    let mut tables = tables.clone();
    let change = |condition: &mut Condition| {
        if let Rest::Logic(row) = condition.rest {
            condition.rest = Rest::Code(row);
        }
    };
    tables.conditions.iter_mut().for_each(change);
    tables
}

/// What the output is in each scan.
fn outputs(tables: &Tables, scans: &[u32]) -> Vec<bool> {
    let program = tables.program();
    assert_eq!(program.unsoundness(), None);
    let mut engine = Engine::new(&program, Vectors::new(&program));
    let output = Bit(tables.layout.momentary.start * 32);
    let mut scan = |(number, inputs): (u64, &u32)| {
        engine.set_inputs(0, *inputs);
        match number {
            0 => engine.start(),
            _ => {
                engine.scan(number * 10);
            }
        }
        engine.bit(output)
    };
    (0..).zip(scans).map(&mut scan).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn logic_is_code_and_what_the_expression_says(
        expression in expression(),
        scans in proptest::collection::vec(0_u32..32, 8),
    ) {
        let tables = tables(&format!(
            "input i0, i1, i2, i3, i4\noutput M\ngraph G {{ initial step 1 {{ M IF {} }} }}",
            expression.text()
        ));
        let expected: Vec<bool> = (0..)
            .zip(&scans)
            .map(|(scan, inputs)| expression.holds(*inputs, scan * 10))
            .collect();
        prop_assert_eq!(outputs(&tables, &scans), expected.clone());
        prop_assert_eq!(outputs(&as_code(&tables), &scans), expected);
    }
}

#[test]
fn logic_on_32_booleans_at_once_keeps_them_all() {
    // `i0` 31 times: it and `i1` are exclusive.
    let nested = format!("{}i1{}", "(i0 XOR ".repeat(31), ")".repeat(31));
    let tables = tables(&format!(
        "input i0, i1\noutput M\ngraph G {{ initial step 1 {{ M IF {nested} }} }}"
    ));
    assert_eq!(tables.layout.stack, 32);
    assert!(matches!(
        tables.conditions[usize::from(tables.momentary[0].condition)].rest,
        Rest::Logic(_)
    ));
    let expected = [false, true, true, false];
    assert_eq!(outputs(&tables, &[0b00, 0b01, 0b10, 0b11]), expected);
    assert_eq!(
        outputs(&as_code(&tables), &[0b00, 0b01, 0b10, 0b11]),
        expected
    );
}
