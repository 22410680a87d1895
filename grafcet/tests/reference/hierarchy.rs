//! Phase 4: enclosing and forcing.

use std::collections::{BTreeMap, BTreeSet};

use crate::expression::{Pass, Place};
use crate::machine::{Fired, Machine, Order, Situations};
use crate::program::{Graph, Situation, Statement};

impl<'p> Machine<'p> {
    /// What every graph takes before scan 0.
    pub fn initial_situations(&self) -> Situations {
        let mut situations: Situations = vec![BTreeSet::new(); self.program.graphs.len()];
        for index in self.order() {
            let own = initial(&self.program.graphs[index]);
            if !self.is_enclosed(index) {
                situations[index] = own;
            } else if let Some(set) = self.at_start(index, &situations) {
                situations[index] = if own.is_empty() { set } else { own };
            }
        }
        situations
    }

    /// The set of the last initial step that is active and encloses a graph.
    fn at_start(&self, index: usize, situations: &Situations) -> Option<BTreeSet<usize>> {
        self.enclosings(index)
            .into_iter()
            .filter(|(graph, step, _)| {
                self.program.graphs[*graph].steps[*step].initial
                    && situations[*graph].contains(step)
            })
            .map(|(_, _, set)| set.clone())
            .next_back()
    }

    /// The steps that enclose a graph, with their sets, in source order.
    fn enclosings(&self, index: usize) -> Vec<(usize, usize, &'p BTreeSet<usize>)> {
        let mut enclosings = Vec::new();
        for (graph, row) in self.program.graphs.iter().enumerate() {
            for (step, row) in row.steps.iter().enumerate() {
                if let Some((enclosed, set)) = &row.encloses
                    && *enclosed == index
                {
                    enclosings.push((graph, step, set));
                }
            }
        }
        enclosings
    }

    pub fn is_enclosed(&self, index: usize) -> bool {
        !self.enclosings(index).is_empty()
    }

    /// Whether a step that encloses the graph is active.
    pub fn is_enclosed_actively(&self, index: usize) -> bool {
        let mut enclosings = self.enclosings(index).into_iter();
        enclosings.any(|(graph, step, _)| self.x[graph].contains(&step))
    }

    /// Again and again the first graph in the source all of whose superiors have been taken.
    fn order(&self) -> Vec<usize> {
        let graphs = self.program.graphs.len();
        let mut order: Vec<usize> = Vec::new();
        while order.len() < graphs {
            let next = (0..graphs).find(|graph| {
                !order.contains(graph)
                    && (0..graphs)
                        .all(|other| order.contains(&other) || !self.is_superior(other, *graph))
            });
            order.push(next.expect("forcing and enclosing make no ring"));
        }
        order
    }

    fn is_superior(&self, superior: usize, graph: usize) -> bool {
        let encloses = self
            .enclosings(graph)
            .iter()
            .any(|(by, _, _)| *by == superior);
        let forces =
            all_orders(&self.program.graphs[superior]).any(|(forced, _, _)| forced == graph);
        superior != graph && (encloses || forces)
    }

    /// Gives every graph its situation; the transitions of those whose own evolution is void have not fired.
    pub fn settle_hierarchy(&mut self, pass: Pass, fired: &mut Fired) {
        self.in_hierarchy = true;
        let program = self.program;
        // `{*}` is the initial situation in scan 0.
        let current: Situations = match pass {
            Pass::Scan0 => program.graphs.iter().map(initial).collect(),
            Pass::First | Pass::LaterRound => self.before.clone(),
        };
        let mut orders: BTreeMap<usize, &'p Situation> = BTreeMap::new();
        let mut held = BTreeSet::new();
        for index in self.order() {
            let graph = &program.graphs[index];
            self.watch_orders(self_orders(graph, index), pass);
            let mut self_order = None;
            for (_, situation, condition) in self_orders(graph, index) {
                if self.condition(condition) {
                    self_order = Some(situation);
                }
            }
            // A stand-alone action that forces its own graph ranks last.
            if let Some(situation) = self_order {
                orders.entry(index).or_insert(situation);
            }
            let situation = self.decide(index, pass, orders.get(&index).copied(), &current[index]);
            if orders.contains_key(&index)
                && (!self.is_enclosed(index) || self.is_enclosed_actively(index))
            {
                held.insert(index);
            }
            if let Some(situation) = situation {
                self.x[index] = situation;
                fired.retain(|(graph, _)| *graph != index);
            }
            self.watch_orders(other_orders(graph, index), pass);
            let mut given: BTreeMap<usize, &'p Situation> = BTreeMap::new();
            for (forced, situation, condition) in self.executed_orders(index) {
                if self.condition(condition) {
                    given.insert(forced, situation);
                }
            }
            for (forced, situation) in given {
                orders.entry(forced).or_insert(situation);
            }
        }
        self.held = held;
        self.in_hierarchy = false;
    }

    /// The situation that phase 4 gives a graph; none when its own evolution stands.
    fn decide(
        &self,
        index: usize,
        pass: Pass,
        order: Option<&Situation>,
        current: &BTreeSet<usize>,
    ) -> Option<BTreeSet<usize>> {
        if self.is_enclosed(index) && !self.is_enclosed_actively(index) {
            return Some(BTreeSet::new());
        }
        match order {
            Some(Situation::Set(set)) => return Some(set.clone()),
            Some(Situation::Initial) => return Some(initial(&self.program.graphs[index])),
            Some(Situation::Current) => return Some(current.clone()),
            None => {}
        }
        if pass == Pass::Scan0 && self.at_start(index, &self.x).is_some() {
            return None;
        }
        let mut activated = self
            .enclosings(index)
            .into_iter()
            .filter(|(graph, step, _)| {
                self.x[*graph].contains(step) && !self.before[*graph].contains(step)
            });
        if let Some((_, _, set)) = activated.next_back() {
            return Some(set.clone());
        }
        self.held.contains(&index).then(|| current.clone())
    }

    /// The orders to other graphs that a graph's stand-alone actions and active steps give, in source order.
    fn executed_orders(&self, index: usize) -> Vec<Order<'p>> {
        let graph = &self.program.graphs[index];
        let steps = self.x[index]
            .iter()
            .flat_map(|step| &graph.steps[*step].statements);
        let statements = graph.first.iter().chain(steps).chain(&graph.last);
        orders_in(statements)
            .filter(|(forced, _, _)| *forced != index)
            .collect()
    }

    fn watch_orders(&mut self, orders: Vec<Order<'p>>, pass: Pass) {
        for (_, _, condition) in orders {
            if let Some(condition) = condition {
                self.watch(condition, Place::Action, pass);
            }
        }
    }
}

fn initial(graph: &Graph) -> BTreeSet<usize> {
    let steps = graph.steps.iter().enumerate();
    steps
        .filter(|(_, step)| step.initial)
        .map(|(index, _)| index)
        .collect()
}

fn orders_in<'p>(
    statements: impl Iterator<Item = &'p Statement>,
) -> impl Iterator<Item = Order<'p>> {
    statements.filter_map(|statement| match statement {
        Statement::Force(forced, situation, condition) => Some((*forced, situation, condition)),
        _ => None,
    })
}

fn all_orders(graph: &Graph) -> impl Iterator<Item = Order<'_>> {
    let steps = graph.steps.iter().flat_map(|step| &step.statements);
    orders_in(graph.first.iter().chain(steps).chain(&graph.last))
}

fn self_orders(graph: &Graph, index: usize) -> Vec<Order<'_>> {
    all_orders(graph)
        .filter(|(forced, _, _)| *forced == index)
        .collect()
}

fn other_orders(graph: &Graph, index: usize) -> Vec<Order<'_>> {
    all_orders(graph)
        .filter(|(forced, _, _)| *forced != index)
        .collect()
}
