//! Which steps of a graph can be active together: found from its structure and from what its triggers exclude.
//!
//! Two steps are taken to be active together when any sequence of firings from any situation that the graph can begin
//! with, or be given, leads there; of triggers only that two exclude each other is looked at. That is more than what
//! happens, never less.

mod together;
mod trigger;

use std::collections::BTreeMap;

use grafcet_core::program::{Forced, Graph, Program};

pub use self::together::Together;
pub use self::trigger::{Asks, Trigger};

/// Steps of one graph beyond which all are taken to be active together: the relation has their square.
const MOST_STEPS: usize = 2048;

/// A graph as firings see it; its steps are counted from its first one.
#[derive(Debug)]
pub struct Activity {
    /// Which steps can be active together.
    pub steps: Together,
    /// How many can be active together at most.
    pub most: usize,
    /// Its transitions in source order.
    pub firings: Vec<Firing>,
    /// The sets of steps that an order or an enclosing step gives it.
    pub given: Vec<Vec<usize>>,
}

/// A transition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Firing {
    /// Row of [`Program::transitions`].
    pub row: usize,
    /// Its entrance steps. By the first it is found.
    pub leaves: Vec<usize>,
    /// Its exit steps.
    pub enters: Vec<usize>,
    /// When it fires while it is armed.
    pub trigger: Trigger,
}

impl Activity {
    /// Of the graph with that index.
    #[must_use]
    pub fn of(program: &Program<'_>, index: usize, graph: &Graph) -> Self {
        let firings = firings(program, graph);
        let given = given(program, index, graph);
        let size = usize::from(graph.steps.len);
        let mut begins = given.clone();
        if program.role(graph).enclosings.len == 0 {
            begins.push(situation(program, graph, graph.initial));
        }
        let steps = match size > MOST_STEPS && begins.iter().any(|set| !set.is_empty()) {
            true => Together::all(size),
            false => explored(size, &begins, &firings),
        };
        let most = match never_more(&firings) {
            true => begins.iter().map(Vec::len).max().unwrap_or(0),
            false => size,
        };
        Activity {
            steps,
            most,
            firings,
            given,
        }
    }

    /// Of transitions, by their places, which can fire at the same time.
    #[must_use]
    pub fn simultaneous(&self, these: &[usize]) -> Together {
        let mut together = Together::none(these.len());
        let firing = |place: &usize| self.firings.get(*place);
        for (left, one) in these.iter().enumerate() {
            for (right, other) in these.iter().enumerate().skip(left) {
                if let (Some(one), Some(other)) = (firing(one), firing(other))
                    && (left == right || !one.trigger.excludes(&other.trigger))
                {
                    together.join(left, right);
                }
            }
        }
        together
    }
}

impl Firing {
    /// Whether two leave the same step, and can do so at once.
    fn conflicts(&self, other: &Firing) -> bool {
        self.leaves.iter().any(|step| other.leaves.contains(step))
            && !self.trigger.excludes(&other.trigger)
    }
}

/// Whether no firing makes more steps active than were.
fn never_more(firings: &[Firing]) -> bool {
    firings.iter().enumerate().all(|(place, one)| {
        let mut others = firings.iter().enumerate();
        one.enters.len() <= one.leaves.len()
            && others.all(|(at, other)| at == place || !one.conflicts(other))
    })
}

/// What any sequence of firings reaches, pair by pair.
fn explored(size: usize, begins: &[Vec<usize>], firings: &[Firing]) -> Together {
    let mut together = Together::none(size);
    for set in begins {
        join_all(&mut together, set, set);
    }
    let mut conflicts: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (place, one) in firings.iter().enumerate() {
        let others = firings.iter().enumerate();
        let others = others.filter(|(at, other)| *at != place && one.conflicts(other));
        conflicts.insert(place, others.map(|(at, _)| at).collect());
    }
    loop {
        let mut grown = false;
        for (place, firing) in firings.iter().enumerate() {
            if !are_all(&together, &firing.leaves) {
                continue;
            }
            let stay: Vec<usize> = together
                .with_all(&firing.leaves)
                .filter(|step| !firing.leaves.contains(step))
                .collect();
            grown |= join_all(&mut together, &firing.enters, &firing.enters);
            grown |= join_all(&mut together, &firing.enters, &stay);
            // One that shares no entrance with it gets there by firing behind it.
            for other in conflicts.get(&place).into_iter().flatten() {
                let Some(other) = firings.get(*other) else {
                    continue;
                };
                let both: Vec<usize> = firing.leaves.iter().chain(&other.leaves).copied().collect();
                if are_all(&together, &both) {
                    grown |= join_all(&mut together, &firing.enters, &other.enters);
                }
            }
        }
        if !grown {
            return together;
        }
    }
}

fn are_all(together: &Together, steps: &[usize]) -> bool {
    let mut pairs = steps
        .iter()
        .flat_map(|one| steps.iter().map(move |other| (one, other)));
    pairs.all(|(one, other)| together.are(*one, *other))
}

fn join_all(together: &mut Together, these: &[usize], those: &[usize]) -> bool {
    let mut grown = false;
    for one in these {
        for other in those {
            grown |= together.join(*one, *other);
        }
    }
    grown
}

fn firings(program: &Program<'_>, graph: &Graph) -> Vec<Firing> {
    let firing = |row: usize| {
        let transition = program.transitions.get(row)?;
        Some(Firing {
            row,
            leaves: local(graph, program.entrance_steps(graph, transition)),
            enters: local(graph, program.exit_steps(graph, transition)),
            trigger: Trigger::of(program, transition),
        })
    };
    graph.transitions.indices().filter_map(firing).collect()
}

fn local(graph: &Graph, steps: impl Iterator<Item = usize>) -> Vec<usize> {
    let first = usize::from(graph.steps.start);
    steps.filter_map(|step| step.checked_sub(first)).collect()
}

fn given(program: &Program<'_>, index: usize, graph: &Graph) -> Vec<Vec<usize>> {
    let orders = program.orders.iter();
    let orders = orders.filter(|order| usize::from(order.graph) == index);
    let forced = orders.filter_map(|order| match order.situation {
        Forced::Set(set) => Some(set),
        Forced::Current => None,
    });
    let enclosings = program.role(graph).enclosings.of(program.enclosings).iter();
    let enclosed = enclosings.flat_map(|by| [Some(by.situation), by.at_start]);
    let sets = forced.chain(enclosed.flatten());
    sets.map(|set| situation(program, graph, set)).collect()
}

/// The steps of a row of the table of situations.
fn situation(program: &Program<'_>, graph: &Graph, first: u16) -> Vec<usize> {
    let active = |step: &usize| {
        let word = program.situations.get(usize::from(first) + step / 32);
        word.is_some_and(|word| word >> (step % 32) & 1 != 0)
    };
    (0..usize::from(graph.steps.len)).filter(active).collect()
}
