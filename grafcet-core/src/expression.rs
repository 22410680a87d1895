//! Conditions and values: conjunctions as mask and state words, everything else as postfix code.

use crate::engine::Engine;
use crate::memory::NEVER;
use crate::program::{Bit, Code, Condition, Op, Stamp, Unit};

impl Engine<'_, '_> {
    /// Whether a condition holds now. Arithmetic that goes wrong on the way is counted.
    pub(crate) fn holds(&mut self, condition: Condition) -> bool {
        match condition {
            Condition::Always => true,
            Condition::All(terms) => terms
                .of(self.program.terms)
                .iter()
                .all(|term| self.memory.word(usize::from(term.word)) & term.mask == term.state),
            Condition::Code(code) => self.value_of(code) != 0,
        }
    }

    /// The value that a piece of code leaves.
    pub(crate) fn value_of(&mut self, code: Code) -> i32 {
        let start = code.start as usize;
        let ops = self
            .program
            .ops
            .get(start..start + usize::from(code.len))
            .unwrap_or(&[]);
        let mut depth = 0;
        for op in ops {
            self.execute(*op, &mut depth);
        }
        self.pop(&mut depth)
    }

    fn execute(&mut self, op: Op, depth: &mut usize) {
        let value = match op {
            Op::Constant(value) => value,
            Op::Bit(bit) => i32::from(self.memory.bit(bit)),
            Op::Number(number) => self.memory.number(number),
            Op::Not => i32::from(self.pop(depth) == 0),
            Op::Negate => {
                let operand = self.pop(depth);
                self.counted(operand.checked_neg(), i32::MAX)
            }
            Op::StepTimer {
                step,
                activated,
                unit,
            } => {
                let preset = self.pop(depth);
                let risen = self.activation(step, activated);
                i32::from(self.elapsed(risen, preset, unit))
            }
            binary => {
                let right = self.pop(depth);
                let left = self.pop(depth);
                self.combine(binary, left, right)
            }
        };
        self.push(depth, value);
    }

    fn combine(&mut self, op: Op, left: i32, right: i32) -> i32 {
        match op {
            Op::And => left & right,
            Op::Or => left | right,
            Op::Xor => left ^ right,
            Op::Add => self.counted(left.checked_add(right), left.saturating_add(right)),
            Op::Subtract => self.counted(left.checked_sub(right), left.saturating_sub(right)),
            Op::Multiply => self.counted(left.checked_mul(right), left.saturating_mul(right)),
            Op::Divide if right == 0 => self.counted(None, 0),
            Op::Divide => self.counted(left.checked_div(right), i32::MAX),
            Op::Modulo if right == 0 => self.counted(None, 0),
            // The one overflow, -2^31 MOD -1, has the exact remainder 0.
            Op::Modulo => left.checked_rem(right).unwrap_or(0),
            Op::Equal => i32::from(left == right),
            Op::NotEqual => i32::from(left != right),
            Op::Less => i32::from(left < right),
            Op::LessOrEqual => i32::from(left <= right),
            Op::Greater => i32::from(left > right),
            Op::GreaterOrEqual => i32::from(left >= right),
            // Operations with fewer operands never come here.
            _ => 0,
        }
    }

    /// The exact result, or the stand-in for it and one arithmetic fault more.
    fn counted(&mut self, exact: Option<i32>, otherwise: i32) -> i32 {
        exact.unwrap_or_else(|| {
            self.count_arithmetic_fault();
            otherwise
        })
    }

    fn push(&mut self, depth: &mut usize, value: i32) {
        if let Some(top) = self.memory.stack.get_mut(*depth) {
            *top = value;
        }
        *depth += 1;
    }

    fn pop(&mut self, depth: &mut usize) -> i32 {
        *depth = depth.saturating_sub(1);
        self.memory.stack.get(*depth).copied().unwrap_or(0)
    }

    /// When a step or macro step was last activated. One that is activated in this very round counts from now,
    /// before and after phase 5 has written it down.
    fn activation(&self, step: Bit, activated: Stamp) -> u64 {
        let layout = &self.program.layout;
        if self.memory.bit(step) && !self.memory.was_active(layout, step) {
            self.now_ms
        } else {
            self.memory.stamp(activated)
        }
    }

    /// Whether the preset has passed since a rise. A rise that never was has no elapsed time.
    pub(crate) fn elapsed(&self, risen_ms: u64, preset: i32, unit: Unit) -> bool {
        if risen_ms == NEVER {
            return false;
        }
        let preset_ms = match unit {
            Unit::Milliseconds => i64::from(preset),
            Unit::Seconds => i64::from(preset) * 1000,
        };
        // A preset below zero has always passed.
        u64::try_from(preset_ms).map_or(true, |preset_ms| {
            self.now_ms.saturating_sub(risen_ms) >= preset_ms
        })
    }
}
