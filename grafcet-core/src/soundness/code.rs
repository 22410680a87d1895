//! Conditions, and the stack that their code needs.

use crate::program::{Bit, Code, Condition, Op, Preset, Program, Rest, Term, Timer};

impl Program<'_> {
    pub(super) const fn terms_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.terms.len() {
            if !self.term_is_sound(&self.terms[i]) {
                return false;
            }
            i += 1;
        }
        true
    }

    pub(super) const fn term_is_sound(&self, term: &Term) -> bool {
        term.word < self.layout.words
            && term.state & !term.mask == 0
            && self.notes_reading(term.word, term.mask)
    }

    /// Whether inputs and `System:first_scan` count as read when they are read there.
    pub(super) const fn notes_reading(&self, word: u16, mask: u32) -> bool {
        let inputs = &self.layout.inputs;
        if inputs.holds(word as usize) {
            mask & !self.read_inputs[word as usize - inputs.start as usize] == 0
        } else {
            let first_scan = word as usize == Bit::FIRST_SCAN.word();
            !first_scan || mask & Bit::FIRST_SCAN.mask() == 0 || self.reads_first_scan
        }
    }

    pub(super) const fn condition_is_sound(&self, condition: Condition) -> bool {
        condition.terms.is_within(self.terms.len())
            && match condition.rest {
                Rest::None => true,
                Rest::Elapsed(timer) | Rest::Running(timer) => (timer as usize) < self.timers.len(),
                Rest::Code(code) => (code as usize) < self.codes.len(),
                Rest::Logic(code) => {
                    (code as usize) < self.codes.len() && self.is_logic(self.codes[code as usize])
                }
            }
    }

    /// Whether the first condition always holds, and the others ask for what is there.
    pub(super) const fn conditions_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.conditions.len() {
            let condition = self.conditions[i];
            if !self.condition_is_sound(condition) || (i == 0 && condition.asks()) {
                return false;
            }
            i += 1;
        }
        true
    }

    pub(super) const fn condition_row_is_sound(&self, row: u16) -> bool {
        (row as usize) < self.conditions.len()
    }

    pub(super) const fn timers_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.timers.len() {
            let sound = match self.timers[i] {
                Timer::Own { since, preset } => {
                    since.0 < self.layout.since && self.preset_is_sound(preset)
                }
                Timer::Any {
                    step,
                    activated,
                    preset,
                } => {
                    self.bit_is_sound(step)
                        && self.stamp_is_sound(activated)
                        && self.preset_is_sound(preset)
                }
            };
            if !sound {
                return false;
            }
            i += 1;
        }
        true
    }

    const fn preset_is_sound(&self, preset: Preset) -> bool {
        match preset {
            Preset::Constant(_) => true,
            Preset::Number(number, _) => number.0 < self.layout.numbers,
        }
    }

    pub(super) const fn codes_are_sound(&self) -> bool {
        let mut i = 0;
        while i < self.codes.len() {
            if !self.code_is_sound(self.codes[i]) {
                return false;
            }
            i += 1;
        }
        true
    }

    /// Follows the code with nothing but the depth of the stack: it never takes what is not there, never needs more
    /// than the layout has and leaves one value.
    pub(super) const fn code_is_sound(&self, code: Code) -> bool {
        let start = code.start as usize;
        let end = start + code.len as usize;
        if end > self.ops.len() {
            return false;
        }
        let mut depth = 0;
        let mut i = start;
        while i < end {
            let op = &self.ops[i];
            let (taken, left) = op.effect();
            if depth < taken || !self.op_is_sound(op) {
                return false;
            }
            depth = depth - taken + left;
            if depth > self.layout.stack {
                return false;
            }
            i += 1;
        }
        depth == 1
    }

    /// Whether code works on nothing but Booleans, and not on more of them than a word holds.
    const fn is_logic(&self, code: Code) -> bool {
        let mut depth = 0;
        let mut i = code.start as usize;
        while i < code.start as usize + code.len as usize {
            let op = &self.ops[i];
            let boolean = matches!(
                op,
                Op::Bit(_)
                    | Op::Elapsed(_)
                    | Op::AndElapsed(_)
                    | Op::Constant(0 | 1)
                    | Op::Not
                    | Op::And
                    | Op::Or
                    | Op::Xor
            );
            let (taken, left) = op.effect();
            depth = depth + left - taken;
            if !boolean || depth > 32 {
                return false;
            }
            i += 1;
        }
        true
    }

    const fn op_is_sound(&self, op: &Op) -> bool {
        match op {
            Op::Bit(bit) => self.bit_is_sound(*bit) && self.notes_reading(bit.0 >> 5, bit.mask()),
            Op::Number(number) => number.0 < self.layout.numbers,
            Op::Elapsed(timer) | Op::AndElapsed(timer) => (*timer as usize) < self.timers.len(),
            Op::StepTimer {
                step, activated, ..
            } => self.bit_is_sound(*step) && self.stamp_is_sound(*activated),
            _ => true,
        }
    }
}

impl Condition {
    /// Whether it asks for anything.
    const fn asks(self) -> bool {
        self.terms.len > 0 || !matches!(self.rest, Rest::None)
    }
}

impl Op {
    /// How many values it takes from the stack, and how many it leaves there.
    const fn effect(&self) -> (u16, u16) {
        match self {
            Op::Constant(_) | Op::Bit(_) | Op::Number(_) | Op::Elapsed(_) => (0, 1),
            Op::Not | Op::Negate | Op::AndElapsed(_) | Op::StepTimer { .. } => (1, 1),
            Op::And
            | Op::Or
            | Op::Xor
            | Op::Add
            | Op::Subtract
            | Op::Multiply
            | Op::Divide
            | Op::Modulo
            | Op::Equal
            | Op::NotEqual
            | Op::Less
            | Op::LessOrEqual
            | Op::Greater
            | Op::GreaterOrEqual => (2, 1),
        }
    }
}
