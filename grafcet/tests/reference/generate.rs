//! Random programs and stimuli, and how they shrink.
//!
//! Indices are drawn without a look at what there is; [`fit`] then wraps them round and takes out what the compiler
//! would refuse, so that every draw is a program and a shrunken draw is one too.

use std::collections::BTreeSet;

use proptest::collection::{btree_set, vec};
use proptest::option;
use proptest::prelude::*;
use proptest::sample::select;

use crate::fit::fit;
use crate::program::{
    Boolean, Graph, Number, Preset, Program, Situation, Statement, Step, Store, Stored, Time,
    Transition,
};

/// What one scan is given.
#[derive(Clone, Debug)]
pub struct Given {
    pub a: bool,
    pub b: bool,
    pub c: bool,
    pub n: i32,
    pub p: Option<i32>,
    pub d: Option<i32>,
}

pub fn stimulus() -> impl Strategy<Value = Vec<Given>> {
    let given = (
        any::<bool>(),
        any::<bool>(),
        any::<bool>(),
        -4..5i32,
        option::weighted(0.2, -1..5i32),
        option::weighted(0.2, select(vec![0, 500, 1000, 2000, 2500, 4000, -1])),
    );
    let given = given.prop_map(|(a, b, c, n, p, d)| Given { a, b, c, n, p, d });
    vec(given, 8..40)
}

pub fn program() -> impl Strategy<Value = Program> {
    let graphs = vec(graph(), 1..4);
    (any::<bool>(), graphs).prop_map(|(stable, graphs)| fit(Program { stable, graphs }))
}

fn graph() -> impl Strategy<Value = Graph> {
    (
        vec(statement(), 0..3),
        vec(step(), 2..6),
        prop_oneof![3 => Just(0usize), 1 => 2..4usize],
        vec(transition(), 1..10),
        vec(statement(), 0..2),
        prop::bool::weighted(0.9),
    )
        .prop_map(|(first, mut steps, expansion, transitions, last, begins)| {
            steps[0].initial |= begins;
            Graph {
                first,
                steps,
                expansion,
                transitions,
                last,
            }
        })
}

fn step() -> impl Strategy<Value = Step> {
    (
        prop::bool::weighted(0.5),
        option::weighted(0.1, (0..3usize, set())),
        vec(statement(), 0..3),
    )
        .prop_map(|(initial, encloses, statements)| Step {
            initial,
            encloses,
            statements,
        })
}

fn set() -> impl Strategy<Value = BTreeSet<usize>> {
    btree_set(0..6usize, 0..3)
}

fn transition() -> impl Strategy<Value = Transition> {
    let of = |count: usize| btree_set(0..6usize, count);
    let steps = || prop_oneof![1 => of(0), 8 => of(1), 1 => of(2)];
    (steps(), steps(), trigger(), vec(store(), 0..2)).prop_map(|(from, to, trigger, action)| {
        Transition {
            from,
            to,
            trigger,
            action,
        }
    })
}

/// Most of these become True sooner or later, so that most transitions fire.
fn trigger() -> impl Strategy<Value = Boolean> {
    let input = || (0..3usize).prop_map(Boolean::Input);
    let boxed = || input().prop_map(Box::new);
    let step = (0..3usize, 0..6usize).prop_map(|(graph, step)| Boolean::Step(graph, step));
    prop_oneof![
        2 => Just(Boolean::Constant(true)),
        4 => input(),
        2 => boxed().prop_map(Boolean::Not),
        2 => boxed().prop_map(Boolean::Rising),
        1 => boxed().prop_map(Boolean::Falling),
        2 => (step, time()).prop_map(|(step, preset)| Boolean::Timer(Box::new(step), Preset::Time(preset))),
        3 => boolean(),
        3 => (boxed(), boolean()).prop_map(|(input, e)| Boolean::Or(input, Box::new(e))),
    ]
}

fn statement() -> impl Strategy<Value = Statement> {
    let momentary = (btree_set(0..3usize, 1..3), option::of(boolean()));
    let situation = prop_oneof![
        4 => set().prop_map(Situation::Set),
        1 => Just(Situation::Initial),
        2 => Just(Situation::Current),
    ];
    let condition = option::weighted(0.9, boolean());
    prop_oneof![
        4 => momentary.prop_map(|(targets, condition)| Statement::Momentary(targets, condition)),
        4 => store().prop_map(Statement::Stored),
        1 => store().prop_map(Statement::OnActivation),
        1 => store().prop_map(Statement::OnDeactivation),
        1 => (boolean(), store()).prop_map(|(event, store)| Statement::OnEvent(event, store)),
        1 => (0..3usize, situation, condition)
            .prop_map(|(graph, situation, condition)| Statement::Force(graph, situation, condition)),
    ]
}

fn store() -> impl Strategy<Value = Store> {
    let what = prop_oneof![
        3 => (0..3usize, boolean()).prop_map(|(index, value)| Stored::Boolean(index, value)),
        3 => (0..2usize, number()).prop_map(|(index, value)| Stored::Number(index, value)),
        1 => time().prop_map(Stored::Time),
    ];
    (what, option::of(boolean())).prop_map(|(what, condition)| Store { what, condition })
}

fn time() -> impl Strategy<Value = Time> {
    prop_oneof![
        select(vec![0, 500, 1000, 2000, 2500]).prop_map(Time::Milliseconds),
        Just(Time::Variable),
        Just(Time::Parameter),
    ]
}

fn number() -> impl Strategy<Value = Number> {
    let leaf = prop_oneof![
        select(vec![0, 1, 2, 3, i32::MAX]).prop_map(Number::Constant),
        Just(Number::Input),
        (0..2usize).prop_map(Number::Variable),
        Just(Number::Parameter),
    ];
    leaf.prop_recursive(2, 6, 2, |inner| {
        let operator = select(vec!["+", "-", "*", "/", "MOD"]);
        prop_oneof![
            1 => inner.clone().prop_map(|value| Number::Negate(Box::new(value))),
            4 => (operator, inner.clone(), inner).prop_map(|(operator, left, right)| {
                Number::Arithmetic(operator, Box::new(left), Box::new(right))
            }),
        ]
    })
}

fn boolean() -> impl Strategy<Value = Boolean> {
    let comparison = select(vec!["=", "<>", "<", "<=", ">", ">="]);
    let leaf = prop_oneof![
        2 => any::<bool>().prop_map(Boolean::Constant),
        6 => (0..3usize).prop_map(Boolean::Input),
        2 => (0..3usize).prop_map(Boolean::Stored),
        2 => (0..3usize).prop_map(Boolean::Momentary),
        4 => (0..3usize, 0..6usize).prop_map(|(graph, step)| Boolean::Step(graph, step)),
        1 => (0..3usize).prop_map(Boolean::Macro),
        1 => prop_oneof![Just(Boolean::FirstScan), Just(Boolean::Unstable)],
        1 => (0..3usize, set(), any::<bool>())
            .prop_map(|(graph, set, equal)| Boolean::InSituation(graph, set, equal)),
        2 => (comparison, number(), number())
            .prop_map(|(operator, left, right)| Boolean::Compare(operator, left, right)),
    ];
    leaf.prop_recursive(3, 10, 2, |inner| {
        let one = inner.clone().prop_map(Box::new);
        let two = (inner.clone().prop_map(Box::new), inner.prop_map(Box::new));
        let preset = prop_oneof![
            3 => time().prop_map(Preset::Time),
            1 => number().prop_map(Preset::Number),
        ];
        prop_oneof![
            2 => one.clone().prop_map(Boolean::Not),
            2 => two.clone().prop_map(|(left, right)| Boolean::And(left, right)),
            2 => two.clone().prop_map(|(left, right)| Boolean::Or(left, right)),
            1 => two.prop_map(|(left, right)| Boolean::Xor(left, right)),
            3 => one.clone().prop_map(Boolean::Rising),
            2 => one.clone().prop_map(Boolean::Falling),
            3 => (one.clone(), preset).prop_map(|(e, preset)| Boolean::Timer(e, preset)),
            1 => (time(), one.clone()).prop_map(|(on, e)| Boolean::OnDelay(on, e)),
            1 => (time(), one, time()).prop_map(|(on, e, off)| Boolean::OnOffDelay(on, e, off)),
        ]
    })
}
