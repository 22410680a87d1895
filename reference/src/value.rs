//! Values and calculation (`semantics.md`, "Numbers").

use grafcet_compiler::ast::{Binary, Type};

/// A value with its type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    /// `bool`.
    Bool(bool),
    /// `int`.
    Int(i32),
    /// `time` in ms.
    Time(i32),
}

impl Value {
    /// The value of a type that is written as this number in a trace.
    #[must_use]
    pub fn of(ty: Type, number: i32) -> Value {
        match ty {
            Type::Bool => Value::Bool(number != 0),
            Type::Int => Value::Int(number),
            Type::Time => Value::Time(number),
        }
    }

    /// The value as a trace shows it.
    #[must_use]
    pub fn number(self) -> i32 {
        match self {
            Value::Bool(value) => i32::from(value),
            Value::Int(value) | Value::Time(value) => value,
        }
    }

    /// The type.
    #[must_use]
    pub fn ty(self) -> Type {
        match self {
            Value::Bool(_) => Type::Bool,
            Value::Int(_) => Type::Int,
            Value::Time(_) => Type::Time,
        }
    }

    /// The truth of a Boolean.
    #[must_use]
    pub fn truth(self) -> bool {
        matches!(self, Value::Bool(true))
    }

    /// The value as a duration in ms: an `int` counts seconds, exactly, whatever its size.
    #[must_use]
    pub fn duration_ms(self) -> i64 {
        match self {
            Value::Int(seconds) => i64::from(seconds) * 1000,
            Value::Time(ms) => i64::from(ms),
            Value::Bool(_) => panic!("a Boolean is no duration"),
        }
    }
}

/// A result, and whether it could not be had as it should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Calculated {
    /// The result.
    pub value: Value,
    /// It was saturated, or something was divided by 0.
    pub fault: bool,
}

/// The type of `left operator right`.
pub fn result_type(operator: Binary, left: Type, right: Type) -> Type {
    match operator {
        Binary::Add | Binary::Subtract | Binary::Multiply | Binary::Divide | Binary::Modulo => {
            if left == Type::Time || right == Type::Time {
                Type::Time
            } else {
                Type::Int
            }
        }
        _ => Type::Bool,
    }
}

/// `left operator right`.
pub fn binary(operator: Binary, left: Value, right: Value) -> Calculated {
    let (a, b) = (i64::from(left.number()), i64::from(right.number()));
    let truth = |value| Calculated {
        value: Value::Bool(value),
        fault: false,
    };
    let number = |exact| saturated(result_type(operator, left.ty(), right.ty()), exact);
    match operator {
        Binary::And => truth(left.truth() & right.truth()),
        Binary::Or => truth(left.truth() | right.truth()),
        Binary::Xor => truth(left.truth() ^ right.truth()),
        Binary::Equal => truth(a == b),
        Binary::NotEqual => truth(a != b),
        Binary::Less => truth(a < b),
        Binary::LessOrEqual => truth(a <= b),
        Binary::Greater => truth(a > b),
        Binary::GreaterOrEqual => truth(a >= b),
        Binary::Add => number(a + b),
        Binary::Subtract => number(a - b),
        Binary::Multiply => number(a * b),
        Binary::Divide | Binary::Modulo if b == 0 => Calculated {
            fault: true,
            ..number(0)
        },
        // Rust's division truncates toward zero and its remainder takes the sign of the dividend, as the law has it.
        Binary::Divide => number(a / b),
        Binary::Modulo => number(a % b),
    }
}

/// `- operand`.
pub fn negated(operand: Value) -> Calculated {
    saturated(operand.ty(), -i64::from(operand.number()))
}

fn saturated(ty: Type, exact: i64) -> Calculated {
    let fits = i32::try_from(exact);
    let nearest = if exact < 0 { i32::MIN } else { i32::MAX };
    Calculated {
        value: Value::of(ty, fits.unwrap_or(nearest)),
        fault: fits.is_err(),
    }
}
