//! Who makes things happen to a machine, at random.

use std::collections::VecDeque;
use std::fmt;

use grafcet_compiler::application::{Application, Place};

use crate::subject::{Habit, Kind, place};

/// Of what has happened so many are shown when something is wrong.
const REMEMBERED: usize = 12;

/// Operators, the grid and wear. The same seed does the same.
#[derive(Debug)]
pub struct Operator {
    random: fastrand::Rng,
    things: Vec<Thing>,
    /// When the next of them changes, in ms.
    next_ms: u64,
    done: VecDeque<Done>,
}

/// One habit, and how it stands.
#[derive(Debug)]
struct Thing {
    habit: Habit,
    place: Place,
    away: bool,
    change_ms: u64,
}

/// What is done to one value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Act {
    /// Its name.
    pub what: &'static str,
    /// Where it lies.
    pub place: Place,
    /// The value that it is given; none when it is given back to the plant.
    pub value: Option<bool>,
}

/// An act and its time, for a report.
#[derive(Debug)]
struct Done {
    at_ms: u64,
    act: Act,
}

impl fmt::Display for Done {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Act { what, value, .. } = self.act;
        write!(f, "{} ms: {what} ", self.at_ms)?;
        match value {
            Some(value) => write!(f, "= {value}"),
            None => write!(f, "is the plant's again"),
        }
    }
}

impl Operator {
    /// Begins with everything as usual.
    #[must_use]
    pub fn new(application: &Application, habits: &'static [Habit], seed: u64) -> Self {
        let things = habits.iter().filter_map(|habit| {
            Some(Thing {
                habit: *habit,
                place: place(application, habit.what)?,
                away: false,
                change_ms: 0,
            })
        });
        let mut operator = Operator {
            random: fastrand::Rng::with_seed(seed),
            things: things.collect(),
            next_ms: 0,
            done: VecDeque::new(),
        };
        operator.set_out(0);
        operator
    }

    /// How many of the habits lead somewhere.
    #[must_use]
    pub fn habits(&self) -> usize {
        self.things.len()
    }

    /// Everything as usual: what to do to the machine before scan 0, and at the end of a shift.
    pub fn leave(&mut self, now_ms: u64) -> Vec<Act> {
        let acts: Vec<Act> = self.things.iter_mut().map(Thing::settle).collect();
        self.remember(now_ms, &acts);
        self.next_ms = u64::MAX;
        acts
    }

    /// Begins again, with nothing happening at once.
    pub fn set_out(&mut self, now_ms: u64) {
        for thing in &mut self.things {
            thing.change_ms = now_ms + thing.habit.pause_ms(&mut self.random);
        }
        self.find_next();
    }

    /// What happens just before the scan at this time; mostly nothing.
    pub fn act(&mut self, now_ms: u64) -> Vec<Act> {
        if now_ms < self.next_ms {
            return Vec::new();
        }
        let due = self.things.iter_mut().filter(|it| it.change_ms <= now_ms);
        let acts: Vec<Act> = due.map(|it| it.turn(now_ms, &mut self.random)).collect();
        self.remember(now_ms, &acts);
        self.find_next();
        acts
    }

    /// What happened last, a line each.
    #[must_use]
    pub fn diary(&self) -> Vec<String> {
        self.done.iter().map(ToString::to_string).collect()
    }

    fn find_next(&mut self) {
        let times = self.things.iter().map(|thing| thing.change_ms);
        self.next_ms = times.min().unwrap_or(u64::MAX);
    }

    fn remember(&mut self, at_ms: u64, acts: &[Act]) {
        for act in acts {
            if self.done.len() == REMEMBERED {
                self.done.pop_front();
            }
            self.done.push_back(Done { at_ms, act: *act });
        }
    }
}

impl Habit {
    /// At least 100 ms: longer than a filter, and an edge for each press.
    fn pause_ms(&self, random: &mut fastrand::Rng) -> u64 {
        random.u64(100..=100 + 2_000 * self.every_s)
    }
}

impl Thing {
    fn settle(&mut self) -> Act {
        self.away = false;
        self.change_ms = u64::MAX;
        self.as_usual()
    }

    fn turn(&mut self, now_ms: u64, random: &mut fastrand::Rng) -> Act {
        self.away = !self.away;
        if self.away {
            let (shortest, longest) = self.habit.lasts_ms;
            self.change_ms = now_ms + random.u64(shortest..=longest);
            self.gives(Some(!self.habit.usual))
        } else {
            self.change_ms = now_ms + self.habit.pause_ms(random);
            self.as_usual()
        }
    }

    fn as_usual(&self) -> Act {
        match self.habit.kind {
            Kind::Given => self.gives(Some(self.habit.usual)),
            Kind::Feedback => self.gives(None),
        }
    }

    fn gives(&self, value: Option<bool>) -> Act {
        Act {
            what: self.habit.what,
            place: self.place,
            value,
        }
    }
}
