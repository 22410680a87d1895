//! Programs with something wrong somewhere: always an answer, never a panic, and tables that are sound if there are
//! any.

#![allow(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use std::fs;
use std::path::{Path, PathBuf};
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

fn files(directory: &Path, extension: &str, into: &mut Vec<PathBuf>) {
    let mut paths: Vec<PathBuf> = fs::read_dir(directory)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            files(&path, extension, into);
        } else if path.extension().is_some_and(|it| it == extension) {
            into.push(path);
        }
    }
}

/// The programs of the repository, right and wrong ones.
static PROGRAMS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut paths = Vec::new();
    files(&here.join("../graphs"), "grafcet", &mut paths);
    files(&here.join("tests/rules"), "txt", &mut paths);
    let mut programs = Vec::new();
    for path in paths {
        let text = fs::read_to_string(path).unwrap();
        programs.extend(text.split("== ").map(str::to_owned));
    }
    programs.retain(|program| program.len() > 20);
    programs
});

/// Words, signs and the white space between them.
fn pieces(text: &str) -> Vec<&str> {
    let mut pieces = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word = |c: char| c.is_alphanumeric() || c == '_';
        let end = if word(first) {
            rest.find(|c| !word(c)).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let (piece, behind) = rest.split_at(end);
        pieces.push(piece);
        rest = behind;
    }
    pieces
}

fn mutated(program: &str, mutations: &[Mutation]) -> String {
    let mut pieces = pieces(program);
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
