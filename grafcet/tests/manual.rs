//! The manual against the product: its examples compile and do what their tests say, its table of rules is whole, its
//! decisions are tested.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::{fs, io};

use grafcet::testing;
use grafcet_compiler::diagnostic::Rule;
use grafcet_compiler::format::format;
use grafcet_compiler::render::{Style, render};
use grafcet_compiler::source::FileId;
use grafcet_compiler::{Target, compile};

/// A block of the manual that is a whole program.
struct Example {
    page: String,
    line: usize,
    text: String,
}

#[test]
fn every_program_in_the_manual_compiles_without_a_word_and_passes_its_tests() {
    let examples = examples().expect("the manual can be read");
    assert!(examples.len() >= 20, "only {} found", examples.len());
    let style = Style::default();
    let mut faults = String::new();
    for example in &examples {
        let path = format!("{}:{}", example.page, example.line);
        let compiled = compile(&path, &example.text, &no_library, Target::Host);
        faults += &render(&compiled.diagnostics, &compiled.sources, style);
        if let Some(application) = &compiled.application {
            for test in &application.tests {
                if let Err(failure) = testing::run(application, test, |_| {}) {
                    faults += &render(&[failure.diagnostic()], &compiled.sources, style);
                }
            }
        }
    }
    assert!(faults.is_empty(), "\n{faults}");
}

#[test]
fn every_program_in_the_manual_is_laid_out_as_the_formatter_does_it() {
    for example in examples().expect("the manual can be read") {
        let layout = format(FileId(0), &example.text);
        let place = format!("{}:{}", example.page, example.line);
        assert_eq!(layout.ok(), Some(example.text), "{place}");
    }
}

#[test]
fn every_rule_of_the_language_is_in_its_table() {
    let page = fs::read_to_string(root().join("language.md")).expect("the page can be read");
    let row = |rule: &&Rule| {
        let name = format!("`{}`", rule.name());
        page.lines()
            .any(|line| line.starts_with("| `") && line.contains(&name))
    };
    let missing: Vec<&Rule> = Rule::ALL.iter().filter(|rule| !row(rule)).collect();
    assert_eq!(missing, Vec::<&Rule>::new());
}

#[test]
fn the_manual_says_of_every_rule_that_is_not_decided_that_it_is_not() {
    let page = fs::read_to_string(root().join("language.md")).expect("the page can be read");
    let (_, section) = page
        .split_once("### Not decided yet")
        .expect("there is such a section");
    let rows = section.lines().filter_map(|line| line.strip_prefix("| `"));
    let named: BTreeSet<&str> = rows.filter_map(|row| row.split('`').next()).collect();
    let decided: BTreeSet<&str> = Rule::DECIDED.iter().map(|rule| rule.name()).collect();
    assert_eq!(named, decided);
}

#[test]
fn every_decision_in_the_manual_names_tests_that_there_are() {
    let page = fs::read_to_string(root().join("semantics.md")).expect("the page can be read");
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut tests = BTreeSet::new();
    for directory in ["grafcet/tests", "grafcet-compiler/tests", "reference/tests"] {
        let files = files(&repository.join(directory), "rs").expect("tests can be read");
        for path in files {
            tests.extend(tests_in(
                &fs::read_to_string(path).expect("a test can be read"),
            ));
        }
    }
    let decisions = decisions(&page);
    assert!(decisions.len() >= 50, "only {} found", decisions.len());
    let mut faults = String::new();
    for decision in &decisions {
        let names: Vec<&str> = test_names(decision).collect();
        if names.is_empty() {
            faults += &format!("no test: {decision}\n");
        }
        for name in names.iter().filter(|name| !tests.contains(**name)) {
            faults += &format!("no test of that name: {name}\n");
        }
    }
    assert!(faults.is_empty(), "\n{faults}");
}

/// The items of the sections of the manual that name their tests.
fn decisions(page: &str) -> Vec<String> {
    let mut decisions: Vec<String> = Vec::new();
    let mut inside = false;
    for line in page.lines() {
        if let Some(title) = line.strip_prefix("## ") {
            inside = title.starts_with("Where this differs") || title.starts_with("Decisions");
        } else if inside && line.starts_with("- ") {
            decisions.push(line.to_owned());
        } else if inside
            && let (Some(last), Some(more)) = (decisions.last_mut(), line.strip_prefix("  "))
        {
            *last = format!("{last} {more}");
        }
    }
    decisions
}

/// What stands in backquotes and is made of several words.
fn test_names(decision: &str) -> impl Iterator<Item = &str> {
    let quoted = decision.split('`').skip(1).step_by(2);
    quoted.filter(|name| {
        let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        name.chars().all(plain) && name.matches('_').count() >= 2
    })
}

/// The names of the functions that a file of Rust marks as tests.
fn tests_in(text: &str) -> Vec<String> {
    let behind_marks = text.split("#[test]").skip(1);
    let names = behind_marks.filter_map(|behind| behind.trim_start().strip_prefix("fn "));
    let names = names.filter_map(|behind| behind.split_once('('));
    names.map(|(name, _)| name.to_owned()).collect()
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/src")
}

fn no_library(_path: &str) -> io::Result<String> {
    Err(io::ErrorKind::NotFound.into())
}

fn examples() -> io::Result<Vec<Example>> {
    let root = root();
    let mut examples = Vec::new();
    for path in files(&root, "md")? {
        let page = path.strip_prefix(&root).unwrap_or(&path).display();
        examples.extend(programs(&page.to_string(), &fs::read_to_string(&path)?));
    }
    Ok(examples)
}

/// All files below a directory whose names end so, in a fixed order.
fn files(directory: &Path, extension: &str) -> io::Result<Vec<PathBuf>> {
    let mut entries: Vec<PathBuf> = fs::read_dir(directory)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<io::Result<_>>()?;
    entries.sort();
    let mut files = Vec::new();
    for path in entries {
        if path.is_dir() {
            files.extend(self::files(&path, extension)?);
        } else if path.extension().is_some_and(|end| end == extension) {
            files.push(path);
        }
    }
    Ok(files)
}

/// The blocks marked `grafcet` that begin with `application`; the others are parts of programs.
fn programs(page: &str, text: &str) -> Vec<Example> {
    let mut programs = Vec::new();
    let mut lines = text.lines().enumerate();
    while let Some((number, line)) = lines.next() {
        if line != "```grafcet" {
            continue;
        }
        let block: Vec<&str> = lines
            .by_ref()
            .map(|(_, line)| line)
            .take_while(|line| *line != "```")
            .collect();
        if block
            .first()
            .is_some_and(|it| it.starts_with("application"))
        {
            programs.push(Example {
                page: page.to_owned(),
                line: number + 1,
                text: block.join("\n") + "\n",
            });
        }
    }
    programs
}
