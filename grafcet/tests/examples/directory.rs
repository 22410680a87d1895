//! What stands in the directory of an example.

use std::fs;
use std::path::{Path, PathBuf};

use grafcet_compiler::application::Application;
use grafcet_compiler::render::{Style, render};
use grafcet_compiler::{Compilation, Target};

/// A line of a header comment that begins so says why there is no plant.
const NO_PLANT: &str = "// No plant: ";

/// Examples of the course that the course does not draw, with where their level-1 text stands.
const WITHOUT_LEVEL_1: [(&str, &str); 1] = [(
    "course_flip_flops",
    "a circuit for the graph of course_punching_machine",
)];

/// The directory of the programs.
pub fn graphs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../graphs")
}

/// The names of all examples, in a fixed order.
pub fn names() -> Vec<String> {
    let entries = fs::read_dir(graphs().join("examples")).expect("the examples can be read");
    let mut names: Vec<String> = entries
        .map(|entry| entry.expect("an entry can be read").file_name())
        .map(|name| name.into_string().expect("a name is text"))
        .collect();
    names.sort();
    names
}

/// A file of an example.
pub fn file(example: &str, name: &str) -> PathBuf {
    graphs().join("examples").join(example).join(name)
}

/// The compiled program of an example.
pub fn application(example: &str) -> Application {
    let path = file(example, &format!("{example}.grafcet"));
    let compiled = compile(&path, Target::Host);
    let said = said(&compiled);
    compiled
        .application
        .unwrap_or_else(|| panic!("{example} is refused:\n{said}"))
}

fn compile(path: &Path, target: Target) -> Compilation {
    grafcet::source::compile(path, target)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn said(compiled: &Compilation) -> String {
    render(&compiled.diagnostics, &compiled.sources, Style::default())
}

#[test]
fn every_example_has_a_program_with_its_plant_and_tests() {
    let mut missing = Vec::new();
    for example in names() {
        let mut want = |there: bool, what: &str| {
            if !there {
                missing.push(format!("{example}: {what}"));
            }
        };
        let path = file(&example, &format!("{example}.grafcet"));
        let Ok(text) = fs::read_to_string(path) else {
            want(false, "a program of its name");
            continue;
        };
        let application = application(&example);
        want(!application.tests.is_empty(), "a test");
        want(text.starts_with("// "), "a header comment");
        let demonstrated = application
            .tests
            .iter()
            .any(|it| it.name == "demonstration");
        match application.plants.is_empty() {
            true => want(
                text.lines().any(|line| line.starts_with(NO_PLANT)),
                "a plant, or why there is none",
            ),
            false => {
                want(demonstrated, "a demonstration");
                let used = application.tests.iter().any(|it| !it.plants.is_empty());
                want(used, "a test with its plant");
            }
        }
    }
    assert_eq!(missing, Vec::<String>::new());
}

#[test]
fn level_1_texts_are_drawn_and_not_built() {
    let mut found = 0;
    for example in names() {
        let path = file(&example, &format!("{example}.level1.grafcet"));
        if !path.is_file() {
            let excused = WITHOUT_LEVEL_1.iter().any(|(name, _)| *name == example);
            assert!(
                excused || !example.starts_with("course_"),
                "{example} has no level-1 text"
            );
            continue;
        }
        found += 1;
        let drawn = compile(&path, Target::Drawing);
        assert_eq!(said(&drawn), "", "{example}");
        let built = compile(&path, Target::Firmware);
        assert!(built.application.is_none(), "{example} is built");
        assert!(said(&built).contains("error[level-1-only]"), "{example}");
    }
    assert!(found > 0);
}
