//! Programs with something wrong somewhere: always an answer, never a panic, and tables that are sound if there are
//! any.

#![allow(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

mod corpus;

use std::sync::LazyLock;

use grafcet_compiler::render::{Style, render};
use grafcet_compiler::{Target, compile};
use proptest::prelude::*;
use proptest::sample::Index;

/// What is done to a program.
#[derive(Clone, Debug)]
enum Mutation {
    Delete(Index),
    Repeat(Index),
    Swap(Index, Index),
    Replace(Index, Index),
}

static PROGRAMS: LazyLock<Vec<String>> = LazyLock::new(corpus::programs);

fn mutated(program: &str, mutations: &[Mutation]) -> String {
    let mut pieces = corpus::pieces(program);
    for mutation in mutations {
        let length = pieces.len();
        if length < 2 {
            break;
        }
        match mutation {
            Mutation::Delete(at) => {
                pieces.remove(at.index(length));
            }
            Mutation::Repeat(at) => pieces.insert(at.index(length), pieces[at.index(length)]),
            Mutation::Swap(one, other) => pieces.swap(one.index(length), other.index(length)),
            Mutation::Replace(at, by) => pieces[at.index(length)] = pieces[by.index(length)],
        }
    }
    pieces.concat()
}

fn mutation() -> impl Strategy<Value = Mutation> {
    prop_oneof![
        any::<Index>().prop_map(Mutation::Delete),
        any::<Index>().prop_map(Mutation::Repeat),
        (any::<Index>(), any::<Index>()).prop_map(|(one, other)| Mutation::Swap(one, other)),
        (any::<Index>(), any::<Index>()).prop_map(|(at, by)| Mutation::Replace(at, by)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_damaged_program_gets_an_answer(
        program in any::<Index>(),
        mutations in prop::collection::vec(mutation(), 0..6),
    ) {
        let text = mutated(program.get::<String>(&PROGRAMS), &mutations);
        let load = |_: &str| Err(std::io::ErrorKind::NotFound.into());
        let compilation = compile("damaged.grafcet", &text, &load, Target::Firmware);
        let said = render(&compilation.diagnostics, &compilation.sources, Style::default());
        prop_assert_eq!(said.is_empty(), compilation.diagnostics.is_empty());
        prop_assert_eq!(compilation.application.is_none(), compilation.has_errors());
        if let Some(application) = compilation.application {
            let plants = application.plants.iter().map(|plant| &plant.unit.tables);
            let tests = application.tests.iter().map(|test| &test.observer.tables);
            for tables in [&application.controller.tables].into_iter().chain(plants).chain(tests) {
                prop_assert_eq!(tables.program().unsoundness(), None);
            }
        }
    }
}
