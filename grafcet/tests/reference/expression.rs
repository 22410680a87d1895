//! Expressions, edges and timers, as `semantics.md` says them.

use std::collections::BTreeMap;

use crate::machine::{Machine, T};
use crate::program::{Boolean, Number, Preset, Time};

/// What an edge or a timer remembers. Each stands at one place of the program, which is its name.
#[derive(Clone, Debug, Default)]
pub struct Operator {
    /// The operand in the evaluation before.
    last: bool,
    /// When the operand rose (of an off-delay: when the on-delay fell).
    stamp: Option<T>,
    /// The on-delay within an on-and-off-delay in the evaluation before.
    last_on: bool,
    fallen: Option<T>,
    result: bool,
}

pub type Operators = BTreeMap<usize, Operator>;

/// Where an edge or a timer stands.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Place {
    Trigger,
    /// An action or a forcing condition.
    Action,
}

/// Which evaluation it is.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Pass {
    Scan0,
    /// The only evaluation of a scan, or the one in the first round.
    First,
    LaterRound,
}

fn name(expression: &Boolean) -> usize {
    std::ptr::from_ref(expression) as usize
}

impl Machine<'_> {
    /// Evaluates the edges and timers in an expression, from the inside out.
    pub fn watch(&mut self, expression: &Boolean, place: Place, pass: Pass) {
        match expression {
            Boolean::Not(e) => self.watch(e, place, pass),
            Boolean::And(left, right) | Boolean::Or(left, right) | Boolean::Xor(left, right) => {
                self.watch(left, place, pass);
                self.watch(right, place, pass);
            }
            Boolean::Rising(e) | Boolean::Falling(e) => {
                self.watch(e, place, pass);
                let rising = matches!(expression, Boolean::Rising(_));
                self.watch_edge(name(expression), e, rising, place, pass);
            }
            Boolean::Timer(enable, preset) => {
                self.watch(enable, place, pass);
                let preset = self.preset_ms(preset);
                let risen = match &**enable {
                    Boolean::Step(..) | Boolean::Macro(_) => self.activation(enable),
                    _ => self.latest_rise(name(expression), enable),
                };
                let passed = risen.is_some_and(|risen| self.now - risen >= preset);
                self.operators.entry(name(expression)).or_default().result = passed;
            }
            Boolean::OnDelay(on, e) => {
                self.watch(e, place, pass);
                let held = self.true_for(name(expression), e, on);
                self.operators.entry(name(expression)).or_default().result = held;
            }
            Boolean::OnOffDelay(on, e, off) => {
                self.watch(e, place, pass);
                let held = self.true_for(name(expression), e, on);
                let off = i64::from(self.time(off));
                let now = self.now;
                let operator = self.operators.entry(name(expression)).or_default();
                if operator.last_on && !held {
                    operator.fallen = Some(now);
                }
                operator.last_on = held;
                operator.result = held || operator.fallen.is_some_and(|fallen| now - fallen < off);
            }
            Boolean::Constant(_)
            | Boolean::Input(_)
            | Boolean::Stored(_)
            | Boolean::Momentary(_)
            | Boolean::Step(..)
            | Boolean::Macro(_)
            | Boolean::FirstScan
            | Boolean::Unstable
            | Boolean::InSituation(..)
            | Boolean::Compare(..) => {}
        }
    }

    fn watch_edge(&mut self, name: usize, e: &Boolean, rising: bool, place: Place, pass: Pass) {
        let now = self.holds(e);
        let alone = matches!(e, Boolean::Step(..) | Boolean::Macro(_));
        let operator = self.operators.entry(name).or_default();
        operator.result = match pass {
            // A step was inactive before scan 0; what anything else was is unknown.
            Pass::Scan0 => rising && alone && place == Place::Action && now,
            Pass::First if rising => now && !operator.last,
            Pass::First => !now && operator.last,
            Pass::LaterRound => false,
        };
        if pass != Pass::LaterRound {
            operator.last = now;
        }
    }

    /// When the operand of a timer rose last.
    fn latest_rise(&mut self, name: usize, e: &Boolean) -> Option<T> {
        let value = self.holds(e);
        let now = self.now;
        let operator = self.operators.entry(name).or_default();
        if value && !operator.last {
            operator.stamp = Some(now);
        }
        operator.last = value;
        operator.stamp
    }

    /// `t1/e`.
    fn true_for(&mut self, name: usize, e: &Boolean, on: &Time) -> bool {
        let value = self.holds(e);
        let on = i64::from(self.time(on));
        let since = match e {
            Boolean::Step(..) | Boolean::Macro(_) => self.activation(e),
            _ => self.latest_rise_of(name, value),
        };
        value && since.is_some_and(|since| self.now - since >= on)
    }

    fn latest_rise_of(&mut self, name: usize, value: bool) -> Option<T> {
        let now = self.now;
        let operator = self.operators.entry(name).or_default();
        if value && !operator.last {
            operator.stamp = Some(now);
        }
        operator.last = value;
        operator.stamp
    }

    /// The time of the latest activation of a step or macro step; one activated in this very round starts now.
    fn activation(&self, bit: &Boolean) -> Option<T> {
        let (since, before) = match bit {
            Boolean::Step(graph, step) => (
                self.since.get(&(*graph, *step)),
                self.before[*graph].contains(step),
            ),
            Boolean::Macro(graph) => (
                self.macro_since.get(graph),
                self.macro_active(*graph, &self.before),
            ),
            _ => (None, false),
        };
        if self.in_hierarchy && self.reads(bit) && !before {
            return Some(self.now);
        }
        since.copied()
    }

    fn preset_ms(&mut self, preset: &Preset) -> T {
        match preset {
            Preset::Time(time) => i64::from(self.time(time)),
            Preset::Number(number) => i64::from(self.number(number)) * 1000,
        }
    }

    /// The value of a Boolean; edges and timers as they were evaluated last.
    pub fn holds(&mut self, expression: &Boolean) -> bool {
        match expression {
            Boolean::Compare(operator, left, right) => {
                let (left, right) = (self.number(left), self.number(right));
                match *operator {
                    "=" => left == right,
                    "<>" => left != right,
                    "<" => left < right,
                    "<=" => left <= right,
                    ">" => left > right,
                    ">=" => left >= right,
                    other => unreachable!("{other}"),
                }
            }
            Boolean::Not(e) => !self.holds(e),
            // Both sides, always: each may count a fault.
            Boolean::And(left, right) => self.holds(left) & self.holds(right),
            Boolean::Or(left, right) => self.holds(left) | self.holds(right),
            Boolean::Xor(left, right) => self.holds(left) ^ self.holds(right),
            Boolean::Rising(_)
            | Boolean::Falling(_)
            | Boolean::Timer(..)
            | Boolean::OnDelay(..)
            | Boolean::OnOffDelay(..) => self.operators[&name(expression)].result,
            leaf => self.reads(leaf),
        }
    }

    /// A condition behind `IF`; without one it holds.
    pub fn condition(&mut self, condition: &Option<Boolean>) -> bool {
        match condition {
            Some(condition) => self.holds(condition),
            None => true,
        }
    }

    fn reads(&self, leaf: &Boolean) -> bool {
        match leaf {
            Boolean::Constant(value) => *value,
            Boolean::Input(index) => self.given[*index] != 0,
            Boolean::Stored(index) => self.stored[*index],
            Boolean::Momentary(index) => self.momentary[*index],
            Boolean::Step(graph, step) => self.x[*graph].contains(step),
            Boolean::Macro(graph) => self.macro_active(*graph, &self.x),
            Boolean::FirstScan => self.first_scan,
            Boolean::Unstable => self.unstable,
            Boolean::InSituation(graph, set, equal) => (self.x[*graph] == *set) == *equal,
            operator => unreachable!("{operator}"),
        }
    }

    pub fn time(&self, time: &Time) -> i32 {
        match time {
            Time::Milliseconds(ms) => *ms,
            Time::Variable => self.w,
            Time::Parameter => self.d,
        }
    }

    pub fn number(&mut self, number: &Number) -> i32 {
        match number {
            Number::Constant(value) => *value,
            Number::Input => self.given[3],
            Number::Variable(index) => self.numbers[*index],
            Number::Parameter => self.p,
            Number::Negate(value) => {
                let value = -i64::from(self.number(value));
                self.saturated(value)
            }
            Number::Arithmetic(operator, left, right) => {
                let left = i64::from(self.number(left));
                let right = i64::from(self.number(right));
                match *operator {
                    "+" => self.saturated(left + right),
                    "-" => self.saturated(left - right),
                    "*" => self.saturated(left * right),
                    "/" if right != 0 => self.saturated(left / right),
                    "MOD" if right != 0 => self.saturated(left % right),
                    _ => {
                        self.faults += 1;
                        0
                    }
                }
            }
        }
    }

    fn saturated(&mut self, value: i64) -> i32 {
        self.clamped(value, i32::MIN, i32::MAX)
    }

    /// The value within limits; one outside is a fault.
    pub fn clamped(&mut self, value: i64, min: i32, max: i32) -> i32 {
        let clamped = value.clamp(i64::from(min), i64::from(max));
        self.faults += i32::from(clamped != value);
        i32::try_from(clamped).expect("within 32 bits")
    }
}
