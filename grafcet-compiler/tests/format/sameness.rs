//! Laid out, a program says what it said: every program of the repository, with its white space changed at random.

use std::sync::LazyLock;

use grafcet_compiler::parser::parse;
use grafcet_compiler::source::FileId;
use grafcet_compiler::{Target, compile};
use proptest::prelude::*;
use proptest::sample::Index;

use super::corpus;
use super::{Unformatted, format, formatted};

/// What can be put between two words of a line without changing what it says.
const WITHIN: [&str; 6] = [" ", "   ", "\t", " (* x *) ", "(* (* y *) // *)", "\u{a0}"];

/// What ends a line.
const BREAKS: [&str; 6] = [
    "\n",
    "\n\n\n",
    " // z\n",
    "\r\n\t",
    "(* u\n  v *)",
    "\n// w\n\n",
];

/// What is done to a program.
#[derive(Clone, Debug)]
enum Change {
    /// White space or a comment is put between two words.
    Within(Index, usize),
    /// A line is ended before a word: it may or may not go on there.
    Break(Index, usize),
    /// White space is taken out.
    Close(Index),
    /// A line end is made another.
    Retouch(Index, usize),
}

static PROGRAMS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let mut programs = corpus::programs();
    programs.retain(|program| is_right(program));
    programs
});

fn is_right(text: &str) -> bool {
    let mut diagnostics = Vec::new();
    parse(FileId(0), text, &mut diagnostics);
    diagnostics.is_empty()
}

fn changed(program: &str, changes: &[Change]) -> String {
    let mut pieces = corpus::pieces(program);
    for change in changes {
        let length = pieces.len();
        match *change {
            Change::Within(at, with) => pieces.insert(at.index(length), WITHIN[with]),
            Change::Break(at, with) => pieces.insert(at.index(length), BREAKS[with]),
            Change::Close(at) => {
                let at = at.index(length);
                if pieces[at].trim().is_empty() {
                    pieces[at] = "";
                }
            }
            Change::Retouch(at, with) => {
                let start = at.index(length);
                let ends = |piece: &&str| *piece == "\n";
                if let Some(at) = pieces[start..].iter().position(ends) {
                    pieces[start + at] = BREAKS[with];
                }
            }
        }
    }
    pieces.concat()
}

fn change() -> impl Strategy<Value = Change> {
    prop_oneof![
        4 => (any::<Index>(), 0..WITHIN.len()).prop_map(|(at, with)| Change::Within(at, with)),
        1 => (any::<Index>(), 0..BREAKS.len()).prop_map(|(at, with)| Change::Break(at, with)),
        4 => any::<Index>().prop_map(Change::Close),
        4 => (any::<Index>(), 0..BREAKS.len()).prop_map(|(at, with)| Change::Retouch(at, with)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_changed_program_is_laid_out_without_loss_or_refused_for_its_errors(
        program in any::<Index>(),
        changes in prop::collection::vec(change(), 0..8),
    ) {
        let text = changed(program.get::<String>(&PROGRAMS), &changes);
        match format(FileId(0), &text) {
            Ok(first) => {
                prop_assert_eq!(format(FileId(0), &first).ok(), Some(first.clone()));
                let bare = |text: &str| text.split_whitespace().collect::<String>();
                prop_assert_eq!(bare(&first), bare(&text));
            }
            Err(Unformatted::Wrong(diagnostics)) => {
                prop_assert!(!diagnostics.is_empty());
                prop_assert!(!is_right(&text));
            }
            Err(Unformatted::Otherwise) => prop_assert!(false, "read otherwise:\n{}", text),
        }
    }
}

#[test]
fn the_tables_of_every_program_stay_what_they_are() {
    let tables = |text: &str| {
        let load = |_: &str| Err(std::io::ErrorKind::NotFound.into());
        let compiled = compile("program.grafcet", text, &load, Target::Host);
        compiled
            .application
            .map(|it| format!("{:?}", it.controller.tables))
    };
    let compared = PROGRAMS
        .iter()
        .filter(|program| {
            let before = tables(program);
            assert_eq!(tables(&formatted(program)), before, "{program}");
            before.is_some()
        })
        .count();
    assert!(compared > 50, "only {compared} programs were compared");
}

#[test]
fn a_text_with_errors_is_refused_with_all_of_them() {
    match format(FileId(0), "graph G { step 1 { A B } }\nvar 1\n") {
        Err(Unformatted::Wrong(diagnostics)) => assert_eq!(diagnostics.len(), 2),
        other => panic!("{other:?}"),
    }
}

#[test]
fn deep_nesting_and_long_texts_are_laid_out() {
    let open: String = (1..=150)
        .map(|n| {
            format!(
                "macro step M{n} {{ entry step {}; exit step {}\n",
                n * 2,
                n * 2 + 1
            )
        })
        .collect();
    formatted(&format!("graph G {{ {open} {} }}", "}".repeat(150)));
    let deep = format!(
        "graph G {{ always {{ A IF {}a{} }} }}",
        "(".repeat(190),
        ")".repeat(190)
    );
    formatted(&deep);
    formatted(&format!(
        "{}var a{}",
        "(* c *)".repeat(50_000),
        " // c\n".repeat(10_000)
    ));
    formatted(&format!(
        "{}x{}",
        "(*".repeat(100_000),
        "*)".repeat(100_000)
    ));
}
