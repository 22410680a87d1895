//! Forcing and enclosing (`semantics.md`, scan 0 and phase 4).

use std::collections::{BTreeMap, BTreeSet};

use grafcet_compiler::ast::{Expression, Situation as Named, Statement, StatementKind};

use crate::expression::Scope;
use crate::graph::{Graph, Owner};
use crate::machine::{Machine, Situation};
use crate::program::{Enclosing, Program};
use crate::watch::Pass;

/// A forcing statement.
struct Order<'a> {
    /// The graph whose statement it is.
    by: &'a Graph<'a>,
    owner: Owner<'a>,
    /// The graph that it forces.
    on: &'a Graph<'a>,
    situation: &'a Named,
    condition: Option<&'a Expression>,
}

impl<'a> Program<'a> {
    /// The enclosing steps of a graph with their sets, in source order; none when it is not enclosed.
    pub(crate) fn enclosings(&self, graph: &str) -> &[Enclosing<'a>] {
        self.enclosings.get(graph).map_or(&[], Vec::as_slice)
    }

    pub(crate) fn find_enclosings(&self) -> BTreeMap<&'a str, Vec<Enclosing<'a>>> {
        let mut enclosings: BTreeMap<&'a str, Vec<Enclosing<'a>>> = BTreeMap::new();
        for superior in &self.graphs {
            for step in &superior.steps {
                for (enclosed, set) in &step.encloses {
                    let enclosed = self.graph(superior.name, &enclosed.text).name;
                    let set = set.steps.iter().map(|id| id.text.as_str()).collect();
                    let step = (superior.name, step.id.text.as_str());
                    enclosings.entry(enclosed).or_default().push((step, set));
                }
            }
        }
        enclosings
    }

    /// Again and again the first graph in the source all of whose superiors have been taken.
    pub(crate) fn order_graphs(&self) -> Vec<&'a str> {
        let superiors = |graph: &Graph<'a>| -> BTreeSet<&'a str> {
            let forcing = self
                .graphs
                .iter()
                .filter(|by| by.forces(|name| self.graph(by.name, name).name == graph.name));
            let enclosing = self.enclosings(graph.name).iter().map(|((by, _), _)| *by);
            let all = forcing.map(|by| by.name).chain(enclosing);
            all.filter(|by| *by != graph.name).collect()
        };
        let mut taken: BTreeSet<&str> = BTreeSet::new();
        let mut order = Vec::new();
        while order.len() < self.graphs.len() {
            let mut rest = self
                .graphs
                .iter()
                .filter(|graph| !taken.contains(graph.name));
            let Some(next) = rest.find(|graph| superiors(graph).is_subset(&taken)) else {
                panic!("graphs force each other in a ring");
            };
            order.push(next.name);
            taken.insert(next.name);
        }
        order
    }
}

impl<'a> Machine<'a> {
    /// Scan 0, item 2.
    pub(crate) fn take_initial_situation(&mut self) {
        let program = self.program;
        for name in &program.from_the_top {
            let graph = program.graph(name, name);
            let enclosings = program.enclosings(name);
            let active_initial = enclosings.iter().filter(|((superior, step), _)| {
                let superior = program.graph(superior, superior);
                superior.initial_steps().contains(step)
                    && self.situation[superior.name].contains(step)
            });
            let active_initial: Vec<&Enclosing<'a>> = active_initial.collect();
            let own = graph.initial_steps();
            let taken = match active_initial.last() {
                None if enclosings.is_empty() => own,
                None => BTreeSet::new(),
                Some(_) if !own.is_empty() => {
                    let steps = active_initial.iter().map(|(step, _)| *step).collect();
                    self.kept.insert(graph.name, steps);
                    own
                }
                Some((_, taken)) => {
                    let givers = active_initial.iter().filter(|(_, set)| set == taken);
                    let steps = givers.map(|(step, _)| *step).collect();
                    self.kept.insert(graph.name, steps);
                    taken.clone()
                }
            };
            self.situation.insert(graph.name, taken);
        }
    }

    /// Phase 4. The answer is the graphs that go on with their own evolution.
    pub(crate) fn hierarchy(&mut self, pass: Pass) -> BTreeSet<&'a str> {
        let program = self.program;
        // In scan 0 forcing conditions compare, and `{*}` means the initial situation.
        let (edges, frozen) = match pass {
            Pass::Prime => (Pass::Compare, self.situation.clone()),
            Pass::Compare | Pass::Later => (pass, self.before.clone()),
        };
        let mut orders: Situation<'a> = BTreeMap::new();
        let mut ordered = BTreeSet::new();
        let mut own_evolution = BTreeSet::new();
        for name in &program.from_the_top {
            let graph = program.graph(name, name);
            let (own, others): (Vec<_>, Vec<_>) = forcing(program, graph)
                .into_iter()
                .partition(|order| order.on.name == graph.name);
            self.give(own, &frozen, &mut orders, edges);
            match self.governed(graph, &orders) {
                None => {
                    own_evolution.insert(graph.name);
                }
                Some((situation, by_order)) => {
                    self.situation.insert(graph.name, situation);
                    if by_order {
                        ordered.insert(graph.name);
                    }
                }
            }
            self.give(others, &frozen, &mut orders, edges);
        }
        self.ordered = ordered;
        self.kept.clear();
        own_evolution
    }

    /// The situation that a graph is given, and whether an order gives it; none when its own evolution counts.
    fn governed(
        &self,
        graph: &'a Graph<'a>,
        orders: &Situation<'a>,
    ) -> Option<(BTreeSet<&'a str>, bool)> {
        if !self.may_run(graph.name) {
            return Some((BTreeSet::new(), false));
        }
        if let Some(forced) = orders.get(graph.name) {
            return Some((forced.clone(), true));
        }
        if let Some(steps) = self.kept.get(graph.name)
            && steps.iter().any(|step| self.active(*step))
        {
            return Some((self.situation[graph.name].clone(), false));
        }
        let enclosings = self.program.enclosings(graph.name);
        let activated = enclosings
            .iter()
            .rfind(|(step, _)| self.active(*step) && !self.was_active(*step));
        if let Some((_, set)) = activated {
            return Some((set.clone(), false));
        }
        if self.ordered.contains(graph.name) {
            return Some((self.before[graph.name].clone(), false));
        }
        None
    }

    /// Evaluates the forcing statements of one graph. An order of a graph taken earlier stays; within these the later
    /// one wins.
    fn give(
        &mut self,
        statements: Vec<Order<'a>>,
        frozen: &Situation<'a>,
        orders: &mut Situation<'a>,
        edges: Pass,
    ) {
        for order in &statements {
            if let Some(condition) = order.condition {
                self.watch(condition, &Scope::of(order.by.name), edges);
            }
        }
        let mut valid: Situation<'a> = BTreeMap::new();
        for order in &statements {
            let by = order.by.name;
            let executed = order
                .owner
                .is_none_or(|step| self.situation[by].contains(step));
            let holds = |machine: &mut Self| {
                order
                    .condition
                    .is_none_or(|condition| machine.evaluate(condition, &Scope::of(by)).truth())
            };
            if executed && holds(self) {
                let situation = order.on.named_situation(order.situation);
                let situation = situation.unwrap_or_else(|| frozen[order.on.name].clone());
                valid.insert(order.on.name, situation);
            }
        }
        for (on, situation) in valid {
            orders.entry(on).or_insert(situation);
        }
    }
}

/// The forcing statements of a graph, in source order.
fn forcing<'a>(program: &'a Program<'a>, by: &'a Graph<'a>) -> Vec<Order<'a>> {
    let order = |(owner, statement): &(Owner<'a>, &'a Statement)| match &statement.kind {
        StatementKind::Force {
            graph,
            situation,
            condition,
        } => Some(Order {
            by,
            owner: *owner,
            on: program.graph(by.name, &graph.text),
            situation,
            condition: condition.as_ref(),
        }),
        _ => None,
    };
    by.statements.iter().filter_map(order).collect()
}
