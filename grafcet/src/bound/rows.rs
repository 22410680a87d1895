//! The work of single rows of the tables.

use grafcet_compiler::emit;
use grafcet_core::program::{
    Armed, Assignment, Code, Condition, Crossing, Duties, Evolution, Graph, Momentary, Op, Order,
    Program, Rest, Run, Step, Stored, Timer, Transition, Watch,
};

use super::work::{Kind, Work};

/// Rows of a run that the image of a small program has one by one (`grafcet-core`, `walk.rs`).
const KNOWN: usize = 4;

/// The tables, and how much of them the compiler of an image knows.
#[derive(Clone, Copy)]
pub struct Rows<'p> {
    /// The tables.
    pub program: &'p Program<'p>,
    /// Whether walks go row by row: the program is a small one.
    pub unrolled: bool,
    /// Whether there is only one piece of code on numbers.
    one_code: bool,
}

impl<'p> Rows<'p> {
    /// Of a program.
    pub fn of(program: &'p Program<'p>) -> Self {
        Rows {
            program,
            unrolled: emit::is_unrolled(program),
            one_code: codes(program) == 1,
        }
    }

    /// The work of a run, whose first rows are known if it is.
    fn each<T>(self, run: Run, table: &[T], known: bool, work: impl Fn(&T, bool) -> Work) -> Work {
        let known = known && self.unrolled;
        let rows = run.of(table).iter().enumerate();
        rows.map(|(place, row)| work(row, known && place < KNOWN))
            .sum()
    }

    /// A condition, all of it.
    pub fn condition(self, condition: &Condition, known: bool) -> Work {
        let known = known && self.unrolled;
        let term = |_: &_, known| Work::one(either(known, Kind::Term, Kind::TermLooped));
        let terms = self.each(condition.terms, self.program.terms, known, term);
        let code = |row: u16| self.program.codes.get(usize::from(row)).copied();
        let rest = match condition.rest {
            Rest::None => Work::NONE,
            Rest::Elapsed(row) | Rest::Running(row) => self.timer(row, known),
            Rest::Code(row) => code(row).map_or(Work::NONE, |code| self.code(code)),
            Rest::Logic(row) => code(row).map_or(Work::NONE, |code| self.logic(code, known)),
        };
        terms + rest
    }

    /// Code on numbers.
    fn code(self, code: Code) -> Work {
        let op = |op: &Op| {
            let beside = match op {
                Op::Elapsed(row) | Op::AndElapsed(row) => self.timer(*row, false),
                Op::StepTimer { .. } => Work::one(Kind::TimerLooped),
                Op::Multiply | Op::Divide | Op::Modulo => Work::one(Kind::Product),
                _ => Work::NONE,
            };
            Work::one(either(
                self.one_code,
                Kind::Operation,
                Kind::OperationLooped,
            )) + beside
        };
        Work::one(Kind::Code) + self.operations(code).iter().map(op).sum()
    }

    /// Code on Booleans.
    fn logic(self, code: Code, known: bool) -> Work {
        let ops = self.operations(code).iter().enumerate();
        ops.map(|(place, op)| {
            let in_known = known && self.unrolled;
            let known = known && place < KNOWN;
            let beside = match op {
                Op::Elapsed(row) | Op::AndElapsed(row) => self.timer(*row, known),
                _ => Work::NONE,
            };
            let kind = match (known, in_known) {
                (true, _) => Kind::Logic,
                (false, true) => Kind::LogicBehind,
                (false, false) => Kind::LogicLooped,
            };
            Work::one(kind) + beside
        })
        .sum()
    }

    /// A timer on a step.
    fn timer(self, row: u16, known: bool) -> Work {
        let kind = match self.program.timers.get(usize::from(row)) {
            Some(Timer::Own { .. }) => either(known, Kind::OwnTimer, Kind::OwnTimerLooped),
            _ => either(known, Kind::Timer, Kind::TimerLooped),
        };
        Work::one(kind)
    }

    fn operations(self, code: Code) -> &'p [Op] {
        let start = code.start as usize;
        let ops = self.program.ops.get(start..start + usize::from(code.len));
        ops.unwrap_or_default()
    }

    /// The transitions that a step arms, or a graph always does.
    pub fn arms(self, run: Run, known: bool) -> Work {
        self.each(run, self.program.arms, known, |arm, known| {
            let transition = self.program.transitions.get(usize::from(arm.transition));
            let condition =
                transition.map(|it| self.condition(&self.program.condition(it.fires), known));
            Work::one(either(known, Kind::Arm, Kind::ArmLooped)) + condition.unwrap_or(Work::NONE)
        })
    }

    /// What it takes to look whether transitions fire of which it is known that they are armed.
    pub fn followed(self, run: Run) -> Work {
        let arms = run.of(self.program.arms).iter();
        let transitions = arms.map(|arm| self.program.transitions.get(usize::from(arm.transition)));
        let look = |transition: &Transition| {
            let first = self.program.terms.get(usize::from(transition.term));
            let armed = first.map(|first| Armed::by(0, first, transition.fires > 0));
            match armed.is_some_and(Armed::is_plain) {
                true => Work::one(Kind::Followed),
                false => {
                    Work::one(Kind::FollowedCloser)
                        + self.condition(&self.program.condition(transition.fires), false)
                }
            }
        };
        transitions.flatten().map(look).sum()
    }

    /// What the firing of a transition takes itself.
    pub fn firing(self, transition: &Transition) -> Work {
        let links = match self.program.crossing(transition) {
            Crossing::Within { .. } => 0,
            // Their graph is searched for by halves, which takes less for both than a link.
            Crossing::Across { entrance, exit, .. } => {
                let halves = self.program.graphs.len().max(1).ilog2() as usize + 1;
                usize::from(entrance.len + exit.len) + halves
            }
        };
        Work::one(self.fire())
            + Work::of(Kind::Link, links)
            + self.stored(self.program.do_block(transition))
    }

    /// The same, where it is known what is armed.
    pub fn followed_firing(self, transition: &Transition) -> Work {
        let marks = usize::from(self.program.asks_what_fired());
        Work::one(Kind::FollowedFire)
            + Work::of(Kind::FollowedMark, marks)
            + self.stored(self.program.do_block(transition))
    }

    /// The kind of a firing.
    pub fn fire(self) -> Kind {
        either(self.unrolled, Kind::Fire, Kind::FireLooped)
    }

    /// Momentary statements.
    pub fn momentary(self, run: Run) -> Work {
        self.each(run, self.program.momentary, true, |row, known| {
            Work::one(either(known, Kind::Momentary, Kind::MomentaryLooped))
                + self.shown(row, known)
        })
    }

    /// The condition and the variables of a momentary statement.
    pub fn shown(self, row: &Momentary, known: bool) -> Work {
        let target = |_: &_, known| Work::one(either(known, Kind::Target, Kind::TargetLooped));
        self.condition(&self.program.condition(row.condition), known)
            + self.each(row.targets, self.program.targets, known, target)
    }

    /// Stored statements.
    pub fn stored(self, run: Run) -> Work {
        self.storing(run, false)
    }

    /// Those of a step that is active, of which one is known.
    pub fn lasting(self, run: Run) -> Work {
        self.storing(run, run.len == 1)
    }

    fn storing(self, run: Run, known: bool) -> Work {
        self.each(run, self.program.stored, known, |row: &Stored, known| {
            let value = match &row.assignment {
                Assignment::Bit(_, value) => {
                    Work::one(either(known, Kind::Bit, Kind::BitLooped))
                        + self.condition(value, known)
                }
                Assignment::Number(_, value) => {
                    Work::one(either(known, Kind::Number, Kind::NumberLooped)) + self.code(*value)
                }
            };
            Work::one(either(known, Kind::Stored, Kind::StoredLooped))
                + self.condition(&row.condition, known)
                + value
        })
    }

    /// Edges and timers with memories of their own.
    pub fn watches(self, run: Run, known: bool) -> Work {
        self.each(run, self.program.watches, known, |watch, known| {
            let delay = Work::one(either(known, Kind::Delay, Kind::DelayLooped));
            match watch {
                Watch::Edge { operand, .. } => {
                    Work::one(either(known, Kind::Edge, Kind::EdgeLooped))
                        + self.condition(operand, known)
                }
                Watch::Timer { enable, preset, .. }
                | Watch::OnDelay {
                    enable,
                    delay: preset,
                    ..
                }
                | Watch::OffDelay {
                    on: enable,
                    hold: preset,
                    ..
                } => delay + self.condition(enable, known) + self.code(*preset),
                Watch::Value { condition, .. } => {
                    Work::one(either(known, Kind::Value, Kind::ValueLooped))
                        + self.condition(condition, known)
                }
            }
        })
    }

    /// Orders.
    pub fn orders(self, run: Run) -> Work {
        let known = self.has_one_graph();
        self.each(run, self.program.orders, known, |order: &Order, known| {
            Work::one(either(known, Kind::Order, Kind::OrderLooped))
                + self.condition(&order.condition, known)
        })
    }

    /// What a graph has to do in the hierarchy whatever it is in.
    pub fn standing(self, graph: &Graph) -> Work {
        // Of a graph without steps little is left, even in a loop.
        let (words, role) = (graph.words().len, self.program.role(graph));
        let known = self.has_one_graph() || words == 0;
        Work::one(either(known, Kind::Graph, Kind::GraphLooped))
            + Work::of(Kind::Ordered, usize::from(words))
            + Work::of(Kind::Enclosing, usize::from(role.enclosings.len))
            + self.watches(role.self_watches, self.has_one_graph())
            + self.watches(role.watches, self.has_one_graph())
            + self.orders(role.self_orders)
            + self.orders(role.orders)
    }

    fn has_one_graph(self) -> bool {
        self.unrolled && self.program.graphs.len() == 1
    }

    /// Statements `on event`.
    pub fn events(self, duties: &Duties) -> Work {
        self.each(duties.on_event, self.program.events, false, |event, _| {
            Work::one(Kind::Event) + self.stored(event.stored)
        })
    }

    /// A visit to a step on a walk on which something is to be done for it.
    pub fn visit(self, what: Work) -> Work {
        match what == Work::NONE {
            true => what,
            false => Work::one(self.visited()) + what,
        }
    }

    fn visited(self) -> Kind {
        match (self.unrolled, self.program.evolution) {
            (false, _) => Kind::VisitLooped,
            (true, Evolution::Scan) => Kind::Visit,
            (true, Evolution::Stable) => Kind::VisitInRounds,
        }
    }

    /// What a step does beside momentary actions.
    pub fn duties(self, step: &Step) -> Option<&'p Duties> {
        match step.duties {
            0 => None,
            row => self.program.duties.get(usize::from(row)),
        }
    }
}

/// Pieces of code on numbers.
fn codes(program: &Program<'_>) -> usize {
    let conditions = program.codes.len();
    let stored = program.stored.iter();
    let stored = stored.filter(|row| matches!(row.assignment, Assignment::Number(..)));
    let delays = program
        .watches
        .iter()
        .filter(|watch| !matches!(watch, Watch::Edge { .. } | Watch::Value { .. }));
    conditions + stored.count() + delays.count()
}

fn either(known: bool, one: Kind, looped: Kind) -> Kind {
    if known { one } else { looped }
}
