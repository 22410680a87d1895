//! The manual against the product: its examples compile and do what their tests say, its table of rules is whole.

use std::path::{Path, PathBuf};
use std::{fs, io};

use grafcet::testing;
use grafcet_compiler::diagnostic::Rule;
use grafcet_compiler::render::{Style, render};
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

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/src")
}

fn no_library(_path: &str) -> io::Result<String> {
    Err(io::ErrorKind::NotFound.into())
}

fn examples() -> io::Result<Vec<Example>> {
    let root = root();
    let mut examples = Vec::new();
    for path in pages(&root)? {
        let page = path.strip_prefix(&root).unwrap_or(&path).display();
        examples.extend(programs(&page.to_string(), &fs::read_to_string(&path)?));
    }
    Ok(examples)
}

/// All pages below a directory, in a fixed order.
fn pages(directory: &Path) -> io::Result<Vec<PathBuf>> {
    let mut entries: Vec<PathBuf> = fs::read_dir(directory)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<io::Result<_>>()?;
    entries.sort();
    let mut pages = Vec::new();
    for path in entries {
        if path.is_dir() {
            pages.extend(self::pages(&path)?);
        } else if path.extension().is_some_and(|end| end == "md") {
            pages.push(path);
        }
    }
    Ok(pages)
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
