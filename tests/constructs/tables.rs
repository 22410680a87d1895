//! Looks over the tables of a program.

use grafcet_core::program::{Assignment, Condition, Op, Order, Program, Slot, Stored, Watch};

use crate::Seen;
use crate::kinds::Kind;

/// What is not a variant of its own in the tables.
pub const FEATURES: &[&str] = &[
    "order of a step",
    "order of a stand-alone action",
    "order on itself",
    "watch of orders",
    "watch of orders on itself",
    "watch of triggers",
    "watch of rounds",
    "watch of actions",
    "enclosing at the start",
    "situation of several words",
    "macro timed",
    "step timed",
    "momentary of a step",
    "momentary of a stand-alone action",
    "dependent of a step",
    "dependent of a stand-alone action",
    "retained Boolean",
    "retained number",
    "True before scan 0",
    "edges of inputs",
    "source transition",
    "first term of a transition",
    "terms",
];

/// Looks over the tables of a program.
pub fn look(program: &Program<'_>, seen: &mut Seen) {
    seen.insert(program.evolution.name());
    program.ops.iter().for_each(|op| operation(op, seen));
    program.watches.iter().for_each(|it| watch(it, seen));
    program.stored.iter().for_each(|it| stored(it, seen));
    program.orders.iter().for_each(|it| order(it, seen));
    for crossing in program.crossings {
        seen.insert(crossing.name());
    }
    for timer in program.timers {
        seen.insert(timer.preset().name());
    }
    for it in program.conditions {
        condition(it, seen);
    }
    seen.extend(
        features(program)
            .into_iter()
            .filter(|(_, occurs)| *occurs)
            .map(|(name, _)| name),
    );
}

fn features(program: &Program<'_>) -> [(&'static str, bool); 23] {
    let (graphs, steps, duties) = (program.graphs, program.steps, program.duties);
    let roles = program.roles;
    let retained = |number: bool| {
        let rows = program.retained.iter();
        rows.filter(|row| matches!(row.slot, Slot::Number(_)) == number)
            .count()
            > 0
    };
    let owned = program.dependent.iter().any(|it| it.owner.is_some());
    let ownerless = program.dependent.iter().any(|it| it.owner.is_none());
    [
        ("order of a step", duties.iter().any(|it| it.orders.len > 0)),
        (
            "order of a stand-alone action",
            roles.iter().any(|it| it.orders.len > 0),
        ),
        (
            "order on itself",
            roles.iter().any(|it| it.self_orders.len > 0),
        ),
        ("watch of orders", roles.iter().any(|it| it.watches.len > 0)),
        (
            "watch of orders on itself",
            roles.iter().any(|it| it.self_watches.len > 0),
        ),
        ("watch of triggers", program.trigger_watches.len > 0),
        ("watch of rounds", program.round_watches.len > 0),
        ("watch of actions", program.action_watches.len > 0),
        (
            "enclosing at the start",
            program.enclosings.iter().any(|it| it.at_start.is_some()),
        ),
        (
            "situation of several words",
            graphs.iter().any(|it| it.words().len > 1),
        ),
        (
            "macro timed",
            program.macros.iter().any(|it| it.activated.is_some()),
        ),
        ("step timed", duties.iter().any(|it| it.activated.is_some())),
        (
            "step timed for itself",
            duties.iter().any(|it| it.since.is_some()),
        ),
        (
            "momentary of a step",
            steps.iter().any(|it| it.momentary_count > 0),
        ),
        (
            "momentary of a stand-alone action",
            program.always_momentary.len > 0,
        ),
        ("dependent of a step", owned),
        ("dependent of a stand-alone action", ownerless),
        ("retained Boolean", retained(false)),
        ("retained number", retained(true)),
        ("True before scan 0", !program.initially_true.is_empty()),
        ("edges of inputs", !program.edges.is_empty()),
        ("source transition", !program.sources.is_empty()),
        (
            "first term of a transition",
            program.transitions.iter().any(|it| {
                let term = program.terms.get(usize::from(it.term));
                term.is_some_and(|term| term.mask != 0)
            }),
        ),
    ]
}

fn condition(condition: &Condition, seen: &mut Seen) {
    seen.insert(condition.rest.name());
    if condition.terms.len > 0 {
        seen.insert("terms");
    }
}

fn operation(op: &Op, seen: &mut Seen) {
    seen.insert(op.name());
    if let Op::StepTimer { unit, .. } = op {
        seen.insert(unit.name());
    }
}

fn watch(watch: &Watch, seen: &mut Seen) {
    seen.insert(watch.name());
    let operand: Condition = match watch {
        Watch::Edge { operand, edge, .. } => {
            seen.insert(edge.name());
            *operand
        }
        Watch::Timer { enable, unit, .. } => {
            seen.insert(unit.name());
            *enable
        }
        Watch::OnDelay { enable, .. } => *enable,
        Watch::OffDelay { on, .. } => *on,
        Watch::Value { condition, .. } => *condition,
    };
    condition(&operand, seen);
}

fn stored(statement: &Stored, seen: &mut Seen) {
    condition(&statement.condition, seen);
    seen.insert(statement.assignment.name());
    let slot = match statement.assignment {
        Assignment::Bit(bit, _) => Slot::Bit(bit),
        Assignment::Number(number, _) => Slot::Number(number),
    };
    seen.insert(slot.name());
}

fn order(order: &Order, seen: &mut Seen) {
    seen.insert(order.situation.name());
    condition(&order.condition, seen);
}
