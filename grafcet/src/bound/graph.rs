//! The most that one graph takes, and the situation in which it does.

use grafcet_compiler::activity::{Activity, Firing};
use grafcet_core::program::{Arm, Armed, Graph, Step};

use super::rows::Rows;
use super::work::{Cpu, Kind, Work};

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// All of a scan with one firing.
    Scan,
    /// A round of a scan that evolves `stable`: all but what follows no change.
    Round,
    /// A round in which no firing changes anything.
    Quiet,
    /// What is left for the end of such a scan.
    End,
}

/// A graph with what can be active in it.
pub struct Acting<'p> {
    /// The tables.
    pub rows: Rows<'p>,
    /// The graph.
    pub graph: &'p Graph,
    /// What can be active.
    pub activity: Activity,
}

/// The most that a graph takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Most {
    /// What it does.
    pub work: Work,
    /// In which steps, counted from the graph's first one.
    pub steps: Vec<usize>,
}

impl Acting<'_> {
    /// Whether it ever does anything but look whether it is alive.
    pub fn can_be_active(&self) -> bool {
        let steps = &self.activity.steps;
        self.rows.program.role(self.graph).sources.len > 0
            || (0..steps.size()).any(|step| steps.are(step, step))
    }

    /// Whether it is always known what it arms: one step is active, and wherever it goes, that stands in a sequence.
    pub fn is_followed(&self) -> bool {
        let program = self.rows.program;
        let active = &self.activity.steps;
        let goes_on = |place| {
            self.only_arm(place)
                .is_some_and(|it| it.next != Armed::UNKNOWN)
        };
        program.layout.armed > 0
            && self.can_be_active()
            && self.activity.most <= 1
            && self.activity.given.is_empty()
            && !self.is_held()
            && program.role(self.graph).sources.len == 0
            && (0..active.size()).all(|place| !active.are(place, place) || goes_on(place))
    }

    /// What a step arms that stands in a sequence.
    fn only_arm(&self, place: usize) -> Option<&Arm> {
        let arms = self.step(place)?.arms().of(self.rows.program.arms);
        arms.first()
    }

    /// The most that it takes on a processor.
    pub fn most(&self, part: Part, cpu: Cpu) -> Most {
        let own = self.heaviest(cpu, |place| self.own(place, part, cpu));
        if self.activity.given.is_empty() && !self.is_held() {
            return own;
        }
        // When its own evolution is void, it stays what it was or takes what it is given.
        let stays = self.heaviest(cpu, |place| self.void(place, part) + self.stay(place, part));
        let role = self.rows.program.role(self.graph);
        // What encloses it empties it when that is left.
        let emptied = (role.enclosings.len > 0).then_some(&[][..]);
        let sets = self.activity.given.iter().map(Vec::as_slice);
        let given = sets.chain(emptied).map(|set| self.given(set, part, cpu));
        given.chain([stays]).fold(own, |most, other| {
            match other.work.tenths(cpu) > most.work.tenths(cpu) {
                true => other,
                false => most,
            }
        })
    }

    /// It is given a set of steps.
    fn given(&self, set: &[usize], part: Part, cpu: Cpu) -> Most {
        // A step that was active and is given stays so, and is not entered.
        let before = |place: usize| match set.contains(&place) {
            true => self.void(place, part) + self.stay(place, part),
            false => self.void(place, part) + self.leave(place, part),
        };
        let instead = |place: usize| match set.contains(&place) {
            true => self.enter(place, part).tenths(cpu),
            false => 0,
        };
        let weights = self
            .places()
            .map(|place| before(place).tenths(cpu).saturating_sub(instead(place)));
        let weights: Vec<u64> = weights.collect();
        let steps = self.activity.steps.heaviest(&weights, self.activity.most);
        let entered = set.iter().filter(|place| !steps.contains(place));
        let words = Work::of(Kind::Given, usize::from(self.graph.words().len));
        let work = words
            + steps.iter().map(|place| before(*place)).sum()
            + entered.map(|place| self.enter(*place, part)).sum();
        Most { work, steps }
    }

    /// Whether it can be kept in its situation.
    fn is_held(&self) -> bool {
        self.rows.program.layout.standings > 0
    }

    fn heaviest(&self, cpu: Cpu, work: impl Fn(usize) -> Work) -> Most {
        let works: Vec<Work> = self.places().map(work).collect();
        let weights: Vec<u64> = works.iter().map(|work| work.tenths(cpu)).collect();
        let steps = self.activity.steps.heaviest(&weights, self.activity.most);
        let work = steps.iter().filter_map(|it| works.get(*it)).cloned().sum();
        Most { work, steps }
    }

    /// Its steps, counted from the first one.
    fn places(&self) -> std::ops::Range<usize> {
        0..self.activity.steps.size()
    }

    /// A step that was active: it stays so, or is left by what it arms.
    fn own(&self, place: usize, part: Part, cpu: Cpu) -> Work {
        if part == Part::Quiet {
            return self.look(place, part) + self.stay(place, part) + self.turns(place);
        }
        let left = self.leave(place, part) + self.firings(place, part, cpu);
        let stays = match part != Part::End && self.is_left_at_once(place) {
            true => Work::NONE,
            false => self.stay(place, part),
        };
        self.look(place, part) + stays.or(left, cpu)
    }

    /// Whether a transition whose trigger is `True` leaves a step, and it alone.
    fn is_left_at_once(&self, place: usize) -> bool {
        let mut firings = self.activity.firings.iter();
        firings.any(|it| it.leaves == [place] && it.trigger.is_certain())
    }

    /// What is looked at for a step that was active in a graph whose own evolution is void.
    fn void(&self, place: usize, part: Part) -> Work {
        let fired = match part {
            Part::End => 0,
            _ => self.step(place).map_or(0, |step| step.arms().len),
        };
        self.look(place, part) + Work::of(self.rows.fire(), usize::from(fired))
    }

    fn step(&self, place: usize) -> Option<&Step> {
        let steps = self.rows.program.steps.get(self.graph.steps.indices())?;
        steps.get(place)
    }

    /// Its transitions and events.
    fn look(&self, place: usize, part: Part) -> Work {
        let Some(step) = self.step(place).filter(|_| part != Part::End) else {
            return Work::NONE;
        };
        let rows = self.rows;
        let duties = rows.duties(step);
        let arms = match self.is_followed() {
            true => rows.followed(step.arms()),
            false => rows.visit(rows.arms(step.arms(), true)),
        };
        arms + rows.visit(duties.map_or(Work::NONE, |duties| rows.events(duties)))
    }

    /// What it does while it is active.
    fn stay(&self, place: usize, part: Part) -> Work {
        let Some(step) = self.step(place) else {
            return Work::NONE;
        };
        let rows = self.rows;
        let duties = rows.duties(step);
        let orders = duties.map_or(Work::NONE, |it| rows.visit(rows.orders(it.orders)));
        let momentary = || rows.visit(rows.momentary(step.momentary()));
        let shown = match (self.is_followed(), self.only_arm(place)) {
            (true, Some(arm)) => match arm.shows {
                Arm::SHOWS_NOTHING => Work::one(Kind::FollowedPassed),
                Arm::SHOWS_MORE => Work::one(Kind::WordLooped) + momentary(),
                _ => Work::one(Kind::FollowedShown),
            },
            _ => momentary(),
        };
        let lasting = duties.map_or(Work::NONE, |it| rows.visit(rows.lasting(it.stored))) + shown;
        match part {
            Part::Scan => orders + lasting,
            Part::Round | Part::Quiet => orders,
            Part::End => lasting,
        }
    }

    fn enter(&self, place: usize, part: Part) -> Work {
        let entered = self
            .step(place)
            .and_then(|step| self.rows.duties(step))
            .filter(|_| part != Part::End)
            .map_or(Work::NONE, |duties| {
                let stamps =
                    usize::from(duties.activated.is_some()) + usize::from(duties.since.is_some());
                let stamp = Work::of(Kind::Stamp, stamps);
                self.rows.visit(stamp) + self.rows.visit(self.rows.stored(duties.on_activation))
            });
        entered + self.stay(place, part)
    }

    fn leave(&self, place: usize, part: Part) -> Work {
        self.step(place)
            .and_then(|step| self.rows.duties(step))
            .filter(|_| part != Part::End)
            .map_or(Work::NONE, |duties| {
                self.rows.visit(self.rows.stored(duties.on_deactivation))
            })
    }

    /// The transitions that lead from a step to itself fire and change nothing.
    fn turns(&self, place: usize) -> Work {
        let firings = self.activity.firings.iter();
        let turns = firings.filter(|it| it.leaves == [place] && it.leaves == it.enters);
        turns.map(|firing| self.crossed(firing)).sum()
    }

    /// The most that one firing behind the first round does beside what is done in a quiet one.
    pub fn later(&self, cpu: Cpu) -> Work {
        let firings = self.activity.firings.iter().enumerate();
        let works = firings.map(|(at, firing)| {
            let left = firing.leaves.iter();
            let left: Work = left.map(|step| self.leave(*step, Part::Round)).sum();
            left + self.fire(at, Part::Round)
        });
        works.fold(Work::NONE, |most, work| most.or(work, cpu))
    }

    /// The transitions of which a step is the first entrance: those of them that can fire together.
    fn firings(&self, place: usize, part: Part, cpu: Cpu) -> Work {
        if part == Part::End {
            return Work::NONE;
        }
        let firings = self.activity.firings.iter().enumerate();
        let own = firings.filter(|(_, firing)| firing.leaves.first() == Some(&place));
        let own: Vec<usize> = own.map(|(at, _)| at).collect();
        self.together(&own, part, cpu)
    }

    /// The transitions without entrance steps.
    pub fn sources(&self, part: Part, cpu: Cpu) -> Work {
        let role = self.rows.program.role(self.graph);
        let looked_at = self.rows.arms(role.sources, false);
        if part == Part::Quiet {
            return looked_at;
        }
        let firings = self.activity.firings.iter().enumerate();
        let own = firings.filter(|(_, firing)| firing.leaves.is_empty());
        let own: Vec<usize> = own.map(|(at, _)| at).collect();
        looked_at + self.together(&own, part, cpu)
    }

    fn together(&self, firings: &[usize], part: Part, cpu: Cpu) -> Work {
        let works: Vec<Work> = firings.iter().map(|at| self.fire(*at, part)).collect();
        let weights: Vec<u64> = works.iter().map(|work| work.tenths(cpu)).collect();
        let together = self.activity.simultaneous(firings);
        let most = together.heaviest(&weights, usize::MAX);
        most.iter().filter_map(|at| works.get(*at)).cloned().sum()
    }

    fn fire(&self, firing: usize, part: Part) -> Work {
        let Some(firing) = self.activity.firings.get(firing) else {
            return Work::NONE;
        };
        let entered = firing.enters.iter().map(|step| self.enter(*step, part));
        self.crossed(firing) + entered.sum()
    }

    /// A transition fires, whatever that leaves and enters.
    fn crossed(&self, firing: &Firing) -> Work {
        let transition = self.rows.program.transitions.get(firing.row);
        transition.map_or(Work::NONE, |it| match self.is_followed() {
            true => self.rows.followed_firing(it),
            false => self.rows.firing(it),
        })
    }
}
