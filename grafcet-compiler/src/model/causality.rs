//! Which momentary statements read momentary variables of the same scan, and the order in which they are evaluated
//! (`semantics.md`, phase 7).

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

use super::{ExpressionKind, GraphId, Inside, Model, Momentary, StepId, VariableId};

/// A momentary statement with what it depends on.
pub(crate) struct Statement<'m> {
    /// The step; none for a stand-alone action.
    pub owner: Option<StepId>,
    /// The statement.
    pub statement: &'m Momentary,
    /// The momentary variables that its condition reads, edges and timers left out.
    pub reads: BTreeSet<VariableId>,
}

/// The momentary statements of some graphs.
pub(crate) struct Causality<'m> {
    /// All of them in source order: of each graph the stand-alone actions, then the steps.
    pub statements: Vec<Statement<'m>>,
    /// Indices of those that read momentary variables, each behind those it depends on. Statements in or behind a
    /// ring are missing.
    pub dependent: Vec<usize>,
}

impl<'m> Causality<'m> {
    /// The momentary statements of some graphs, in the order of their dependencies.
    pub fn of(model: &'m Model, graphs: &[GraphId]) -> Causality<'m> {
        let mut statements = Vec::new();
        for &graph in graphs {
            let graph = &model[graph];
            let always = graph.always.iter().map(|action| (None, action));
            let steps = graph
                .step_ids()
                .map(|step| (Some(step), &model[step].action));
            for (owner, action) in always.chain(steps) {
                statements.extend(action.momentary.iter().map(|statement| Statement {
                    owner,
                    statement,
                    reads: BTreeSet::new(),
                }));
            }
        }
        let momentary = targets(&statements);
        for statement in &mut statements {
            statement.reads = reads(statement.statement, &momentary);
        }
        let dependent = sorted(&statements);
        Causality {
            statements,
            dependent,
        }
    }

    /// The variables that are the object of momentary actions.
    pub fn momentary(&self) -> BTreeSet<VariableId> {
        targets(&self.statements)
    }
}

fn targets(statements: &[Statement]) -> BTreeSet<VariableId> {
    let targets = statements.iter().flat_map(|it| &it.statement.targets);
    targets.map(|target| target.variable).collect()
}

fn reads(statement: &Momentary, momentary: &BTreeSet<VariableId>) -> BTreeSet<VariableId> {
    let mut found = BTreeSet::new();
    if let Some(condition) = &statement.condition {
        condition.visit(|expression| {
            if expression.is_watch() {
                return Inside::Skip;
            }
            if let ExpressionKind::Variable(id) = expression.kind
                && momentary.contains(&id)
            {
                found.insert(id);
            }
            Inside::Visit
        });
    }
    found
}

/// A statement may be evaluated when all statements of the variables that it reads have been.
fn sorted(statements: &[Statement]) -> Vec<usize> {
    let mut readers: BTreeMap<VariableId, Vec<usize>> = BTreeMap::new();
    let mut open_writers: BTreeMap<VariableId, usize> = BTreeMap::new();
    let mut open_reads: Vec<usize> = statements.iter().map(|it| it.reads.len()).collect();
    for (index, statement) in statements.iter().enumerate() {
        for variable in &statement.reads {
            readers.entry(*variable).or_default().push(index);
        }
        for target in &statement.statement.targets {
            *open_writers.entry(target.variable).or_default() += 1;
        }
    }
    let ready = |(_, open): &(usize, &usize)| **open == 0;
    let independent: Vec<usize> = open_reads
        .iter()
        .enumerate()
        .filter(ready)
        .map(|(index, _)| index)
        .collect();
    let mut next: BinaryHeap<Reverse<usize>> = independent.into_iter().map(Reverse).collect();
    let mut dependent = Vec::new();
    while let Some(Reverse(index)) = next.pop() {
        if !statements[index].reads.is_empty() {
            dependent.push(index);
        }
        for target in &statements[index].statement.targets {
            let Some(open) = open_writers.get_mut(&target.variable) else {
                continue;
            };
            *open -= 1;
            if *open > 0 {
                continue;
            }
            for reader in readers.get(&target.variable).into_iter().flatten() {
                open_reads[*reader] -= 1;
                if open_reads[*reader] == 0 {
                    next.push(Reverse(*reader));
                }
            }
        }
    }
    dependent
}
