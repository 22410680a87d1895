//! Triggers as Boolean functions, and whether two of them can be True at once.

use std::collections::{BTreeMap, BTreeSet};

use grafcet_core::program::{Code, Condition, Op, Program, Rest, Term, Transition};

/// Ways in which things can stand that are tried; where there are more, two triggers are taken to be True together.
const MOST_WAYS: usize = 1 << 14;

/// When a transition fires that is armed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trigger {
    terms: Vec<Term>,
    rest: Formula,
}

/// A Boolean function.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Formula {
    Constant(bool),
    /// Something is True.
    Is(Thing),
    /// Two values compare in one of these ways, by the order of the ways: less, equal, greater.
    Compares(Thing, [bool; 3]),
    Not(Box<Formula>),
    /// An operation on two Booleans.
    Both(Op, Box<Formula>, Box<Formula>),
}

/// What a function depends on. Nothing is assumed of how two of them go together.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Thing {
    Bit(u16),
    /// A row of the timers.
    Timer(u16),
    /// How the values of two pieces of code compare.
    Pair(String, String),
    /// What a piece of code leaves.
    Value(String),
}

impl Thing {
    fn ways(&self) -> usize {
        match self {
            Thing::Pair(..) => 3,
            _ => 2,
        }
    }
}

impl Trigger {
    /// Of a transition.
    #[must_use]
    pub fn of(program: &Program<'_>, transition: &Transition) -> Self {
        let first = program.terms.get(usize::from(transition.term)).copied();
        let mut trigger = Trigger::when(program, &program.condition(transition.fires));
        trigger.terms.extend(first);
        trigger
    }

    /// Of what happens when a condition is True.
    #[must_use]
    pub fn when(program: &Program<'_>, condition: &Condition) -> Self {
        let code = |row: u16| program.codes.get(usize::from(row));
        let rest = match condition.rest {
            Rest::None => Formula::Constant(true),
            Rest::Elapsed(timer) => Formula::Is(Thing::Timer(timer)),
            Rest::Running(timer) => Formula::Not(Box::new(Formula::Is(Thing::Timer(timer)))),
            Rest::Code(row) | Rest::Logic(row) => {
                code(row).map_or(Formula::Constant(true), |code| formula(program, *code))
            }
        };
        Trigger {
            terms: condition.terms.of(program.terms).to_vec(),
            rest,
        }
    }

    /// Whether it is True whatever stands how.
    #[must_use]
    pub fn is_certain(&self) -> bool {
        self.terms.iter().all(|term| term.mask == 0) && self.rest == Formula::Constant(true)
    }

    /// Whether two can never be True at once.
    #[must_use]
    pub fn excludes(&self, other: &Trigger) -> bool {
        let contradict = |one: &Term| {
            let against = |other: &Term| {
                one.word == other.word && one.mask & other.mask & (one.state ^ other.state) != 0
            };
            other.terms.iter().any(against)
        };
        self.terms.iter().any(contradict) || !self.meets(other)
    }

    /// The bits that it depends on, each with what it may ask of it.
    #[must_use]
    pub fn bits(&self) -> BTreeMap<u16, Asks> {
        let mut bits = BTreeMap::new();
        for (thing, is) in self.terms.iter().flat_map(literals) {
            ask(&mut bits, &thing, is != 0);
        }
        self.rest.bits(false, &mut bits);
        bits
    }

    /// The timers that it depends on, by their rows.
    #[must_use]
    pub fn timers(&self) -> Vec<u16> {
        let timers = self.things().into_iter().filter_map(|thing| match thing {
            Thing::Timer(row) => Some(row),
            _ => None,
        });
        timers.collect()
    }

    /// Whether it depends on nothing but such bits and such timers, by their rows.
    #[must_use]
    pub fn depends_on_none_but(
        &self,
        such_bits: impl Fn(u16) -> bool,
        such_timers: impl Fn(u16) -> bool,
    ) -> bool {
        self.things().into_iter().all(|thing| match thing {
            Thing::Bit(bit) => such_bits(bit),
            Thing::Timer(timer) => such_timers(timer),
            Thing::Pair(..) | Thing::Value(_) => false,
        })
    }

    /// Whether it can be True while some bits stand as given and some timers, by their rows, have not run out.
    #[must_use]
    pub fn can_hold(&self, bits: &BTreeMap<u16, bool>, running: &BTreeSet<u16>) -> bool {
        let bits = bits.iter();
        let bits = bits.map(|(bit, is)| (Thing::Bit(*bit), usize::from(*is)));
        let timers = running.iter().map(|timer| (Thing::Timer(*timer), 0));
        let mut stand: BTreeMap<Thing, usize> = bits.chain(timers).collect();
        let mut literals = self.terms.iter().flat_map(literals);
        literals.all(|(thing, is)| *stand.entry(thing).or_insert(is) == is)
            && hold_at_once(&[&self.rest], stand)
    }

    /// All that it depends on.
    fn things(&self) -> BTreeSet<Thing> {
        let literals = self.terms.iter().flat_map(literals);
        let mut things = literals.map(|(thing, _)| thing).collect();
        self.rest.things(&mut things);
        things
    }

    /// Tries all ways in which what the two depend on can stand.
    fn meets(&self, other: &Trigger) -> bool {
        let literals = [self, other]
            .into_iter()
            .flat_map(|trigger| trigger.terms.iter().flat_map(literals));
        hold_at_once(&[&self.rest, &other.rest], literals.collect())
    }
}

/// What a trigger may ask of a bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Asks {
    /// That it is True.
    pub to_be_true: bool,
    /// That it is False.
    pub to_be_false: bool,
}

fn ask(bits: &mut BTreeMap<u16, Asks>, thing: &Thing, to_be: bool) {
    if let Thing::Bit(bit) = thing {
        let asks = bits.entry(*bit).or_default();
        asks.to_be_true |= to_be;
        asks.to_be_false |= !to_be;
    }
}

/// Whether functions can be True at once when some things stand as given: all ways are tried in which the others can
/// stand.
fn hold_at_once(functions: &[&Formula], mut stand: BTreeMap<Thing, usize>) -> bool {
    let mut things = BTreeSet::new();
    for function in functions {
        function.things(&mut things);
    }
    things.retain(|thing| !stand.contains_key(thing));
    let ways = things.iter().map(Thing::ways);
    let ways = ways.fold(1, usize::saturating_mul);
    if ways > MOST_WAYS {
        return true;
    }
    (0..ways).any(|way| {
        let mut way = way;
        for thing in &things {
            stand.insert(thing.clone(), way % thing.ways());
            way /= thing.ways();
        }
        functions.iter().all(|function| function.holds(&stand))
    })
}

/// The bits of a term, and how they must stand.
fn literals(term: &Term) -> impl Iterator<Item = (Thing, usize)> + '_ {
    let bits = (0..32).filter(|bit| term.mask >> bit & 1 != 0);
    bits.map(|bit| {
        let is = term.state >> bit & 1;
        (Thing::Bit(term.word * 32 + bit), is as usize)
    })
}

impl Formula {
    fn things(&self, things: &mut BTreeSet<Thing>) {
        match self {
            Formula::Constant(_) => {}
            Formula::Is(thing) | Formula::Compares(thing, _) => {
                things.insert(thing.clone());
            }
            Formula::Not(inner) => inner.things(things),
            Formula::Both(_, left, right) => {
                left.things(things);
                right.things(things);
            }
        }
    }

    /// Adds what it may ask of bits, or its negation.
    fn bits(&self, negated: bool, bits: &mut BTreeMap<u16, Asks>) {
        match self {
            Formula::Constant(_) | Formula::Compares(..) => {}
            Formula::Is(thing) => ask(bits, thing, !negated),
            Formula::Not(inner) => inner.bits(!negated, bits),
            Formula::Both(op, left, right) => {
                let both_ways = !matches!(op, Op::And | Op::Or);
                for inner in [left, right] {
                    inner.bits(negated, bits);
                    if both_ways {
                        inner.bits(!negated, bits);
                    }
                }
            }
        }
    }

    fn holds(&self, stand: &BTreeMap<Thing, usize>) -> bool {
        let way = |thing| stand.get(thing).copied().unwrap_or(0);
        match self {
            Formula::Constant(value) => *value,
            Formula::Is(thing) => way(thing) != 0,
            Formula::Compares(thing, ways) => ways.get(way(thing)).copied().unwrap_or(false),
            Formula::Not(inner) => !inner.holds(stand),
            Formula::Both(op, left, right) => {
                let (left, right) = (left.holds(stand), right.holds(stand));
                match op {
                    Op::And => left && right,
                    Op::Or => left || right,
                    _ => left != right,
                }
            }
        }
    }
}

/// What stands on the stack while code is read.
#[derive(Clone)]
struct Read {
    /// As code, which is the same for the same value.
    text: String,
    /// As a function, for what is known to be Boolean.
    formula: Option<Formula>,
}

impl Read {
    fn formula(self) -> Formula {
        let text = self.text;
        self.formula.unwrap_or(Formula::Is(Thing::Value(text)))
    }
}

/// Code whose value is a condition, as a function.
fn formula(program: &Program<'_>, code: Code) -> Formula {
    let start = code.start as usize;
    let ops = program.ops.get(start..start + usize::from(code.len));
    let mut stack: Vec<Read> = Vec::new();
    for op in ops.unwrap_or_default() {
        let read = read(*op, &mut stack);
        stack.push(read);
    }
    stack.pop().map_or(Formula::Constant(true), Read::formula)
}

fn read(op: Op, stack: &mut Vec<Read>) -> Read {
    let nothing = Read {
        text: String::new(),
        formula: None,
    };
    let mut pop = || stack.pop().unwrap_or(nothing.clone());
    let (text, formula) = match op {
        Op::Constant(value @ (0 | 1)) => (format!("{value}"), Some(Formula::Constant(value == 1))),
        Op::Constant(value) => (format!("{value}"), None),
        Op::Bit(bit) => (format!("b{}", bit.0), Some(Formula::Is(Thing::Bit(bit.0)))),
        Op::Number(number) => (format!("n{}", number.0), None),
        Op::Elapsed(timer) => (format!("t{timer}"), Some(Formula::Is(Thing::Timer(timer)))),
        Op::AndElapsed(timer) => {
            let inner = pop();
            let text = format!("({}) t{timer} And", inner.text);
            let elapsed = Formula::Is(Thing::Timer(timer));
            let both = Formula::Both(Op::And, Box::new(inner.formula()), Box::new(elapsed));
            (text, Some(both))
        }
        Op::Not => {
            let inner = pop();
            let text = format!("({}) Not", inner.text);
            (text, Some(Formula::Not(Box::new(inner.formula()))))
        }
        Op::Negate | Op::StepTimer { .. } => (format!("({}) {op:?}", pop().text), None),
        _ => {
            let (right, left) = (pop(), pop());
            let text = format!("({}) ({}) {op:?}", left.text, right.text);
            (text, binary(op, left, right))
        }
    };
    Read { text, formula }
}

/// An operation on two values, as a function if it leaves a Boolean.
fn binary(op: Op, left: Read, right: Read) -> Option<Formula> {
    let ways = match op {
        Op::And | Op::Or | Op::Xor => {
            let (left, right) = (Box::new(left.formula()), Box::new(right.formula()));
            return Some(Formula::Both(op, left, right));
        }
        Op::Less => [true, false, false],
        Op::LessOrEqual => [true, true, false],
        Op::Equal => [false, true, false],
        Op::NotEqual => [true, false, true],
        Op::GreaterOrEqual => [false, true, true],
        Op::Greater => [false, false, true],
        _ => return None,
    };
    Some(Formula::Compares(Thing::Pair(left.text, right.text), ways))
}
