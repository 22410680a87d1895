//! Conditions and values: conjunctions as mask and state words, everything else as postfix code.

use crate::engine::Engine;
use crate::memory::Memory;
use crate::program::{Code, Compiled, Condition, Op, Rest, Run, Term};
use crate::timing::Timers;
use crate::walk::{Visit, each};

impl<P: Compiled, M: Memory> Engine<P, M> {
    /// Whether a condition holds now. Arithmetic that goes wrong on the way is counted.
    #[inline(always)]
    pub(crate) fn holds(&mut self, condition: &Condition) -> bool {
        self.terms_hold(condition.terms) && self.rest_holds(condition.rest, Timers::Apart)
    }

    /// The same, for a row of the conditions.
    #[inline(always)]
    pub(crate) fn holds_row(&mut self, row: u16) -> bool {
        let tables = self.tables;
        let Condition { terms, rest } = tables.program().condition(row);
        row == 0 || self.terms_hold(terms) && self.rest_holds(rest, Timers::InPlace)
    }

    /// Whether all terms hold now.
    #[inline(always)]
    fn terms_hold(&self, terms: Run) -> bool {
        let tables = self.tables;
        let Some(terms) = terms.some(tables.program().terms) else {
            return true;
        };
        let mut asking = Asking {
            image: self.memory.store.image(),
            holds: true,
        };
        each::<P, Term>(terms, &mut asking);
        asking.holds
    }

    /// Whether what a condition asks for beside its terms holds now.
    #[inline(always)]
    fn rest_holds(&mut self, rest: Rest, timers: Timers) -> bool {
        let tables = self.tables;
        let program = tables.program();
        match rest {
            Rest::None => true,
            Rest::Elapsed(timer) => self.has_elapsed(timer, timers),
            Rest::Running(timer) => !self.has_elapsed(timer, timers),
            Rest::Code(code) => {
                let code = program.codes.get(usize::from(code));
                code.is_some_and(|code| self.value_of(*code) != 0)
            }
            Rest::Logic(code) => {
                let code = program.codes.get(usize::from(code));
                code.is_some_and(|code| self.logic_of(*code, timers))
            }
        }
    }

    /// What a piece of code on Booleans leaves.
    #[inline(always)]
    fn logic_of(&mut self, code: Code, timers: Timers) -> bool {
        let tables = self.tables;
        let ops = code.of(tables.program().ops);
        let mut thinking = Thinking {
            engine: self,
            timers,
            stack: 0,
        };
        each::<P, Op>(ops, &mut thinking);
        thinking.stack & 1 != 0
    }

    /// The value that a piece of code leaves.
    pub(crate) fn value_of(&mut self, code: Code) -> i32 {
        let tables = self.tables;
        let mut depth = 0;
        for op in code.of(tables.program().ops) {
            self.execute(*op, &mut depth);
        }
        self.pop(&mut depth)
    }

    fn execute(&mut self, op: Op, depth: &mut usize) {
        let value = match op {
            Op::Constant(value) => value,
            Op::Bit(bit) => i32::from(self.memory.bit(bit)),
            Op::Number(number) => self.memory.number(number),
            Op::Elapsed(timer) => i32::from(self.has_elapsed_apart(timer)),
            Op::AndElapsed(timer) => {
                let holds = self.pop(depth) != 0 && self.has_elapsed_apart(timer);
                i32::from(holds)
            }
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
        if let Some(top) = self.memory.store.stack_mut().get_mut(*depth) {
            *top = value;
        }
        *depth += 1;
    }

    fn pop(&mut self, depth: &mut usize) -> i32 {
        *depth = depth.saturating_sub(1);
        self.memory.store.stack().get(*depth).copied().unwrap_or(0)
    }
}

/// Executes code on Booleans.
struct Thinking<'e, P, M> {
    engine: &'e mut Engine<P, M>,
    timers: Timers,
    /// The stack is a word, its top the lowest bit.
    stack: u32,
}

impl<P: Compiled, M: Memory> Visit<Op> for Thinking<'_, P, M> {
    #[inline(always)]
    fn row(&mut self, op: &Op) {
        let stack = self.stack;
        self.stack = match op {
            Op::Bit(bit) => stack << 1 | u32::from(self.engine.memory.bit(*bit)),
            Op::Elapsed(timer) => {
                stack << 1 | u32::from(self.engine.has_elapsed(*timer, self.timers))
            }
            Op::AndElapsed(timer) => {
                let holds = stack & 1 != 0 && self.engine.has_elapsed(*timer, self.timers);
                stack & !1 | u32::from(holds)
            }
            Op::Not => stack ^ 1,
            Op::And => stack >> 1 & (stack | !1),
            Op::Or => stack >> 1 | stack & 1,
            Op::Xor => stack >> 1 ^ stack & 1,
            Op::Constant(value) => stack << 1 | u32::from(*value != 0),
            // Operations on numbers never come here.
            _ => stack,
        };
    }
}

/// Asks whether all of some terms hold.
struct Asking<'a> {
    image: &'a [u32],
    holds: bool,
}

impl Visit<Term> for Asking<'_> {
    #[inline(always)]
    fn row(&mut self, term: &Term) {
        self.holds = self.holds && term.holds(self.image);
    }
}

impl Term {
    /// Whether the bits of the image stand as they must.
    #[inline(always)]
    pub(crate) fn holds(&self, image: &[u32]) -> bool {
        let word = image.get(usize::from(self.word));
        word.is_some_and(|word| word & self.mask == self.state)
    }
}
