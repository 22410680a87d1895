//! The page "What is promised" against the sources: its list of unsafe code is whole, and the tests it names exist.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use cargo_metadata::{MetadataCommand, TargetKind};

/// The word, which this file must not contain as code.
const WORD: &str = concat!("un", "safe");

fn top() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn page() -> String {
    fs::read_to_string(top().join("docs/src/safety.md")).expect("the page can be read")
}

/// All files with this extension below a directory, but what was built and what was installed.
fn files(directory: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(directory).expect("the directory can be read") {
        let path = entry.expect("its entry can be read").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() && !name.starts_with('.') && name != "target" && name != "node_modules" {
            found.extend(files(&path, extension));
        } else if path.extension().is_some_and(|it| it == extension) {
            found.push(path);
        }
    }
    found
}

fn without_comment(line: &str) -> &str {
    line.split_once("//").map_or(line, |(code, _)| code).trim()
}

/// Every use of the word in a text, with what it is about: an attribute and the opening of a block bring the next line.
fn uses(text: &str) -> Vec<String> {
    let lines: Vec<&str> = text.lines().map(without_comment).collect();
    let is_use = |line: &str| {
        let mut words = line.split(|c: char| !c.is_alphanumeric() && c != '_');
        words.any(|word| word == WORD)
    };
    let places = lines.iter().enumerate().filter(|(_, line)| is_use(line));
    let with_next = places.map(|(at, line)| {
        let opens = line.starts_with("#[") || *line == format!("{WORD} {{");
        match lines.iter().skip(at + 1).find(|next| !next.is_empty()) {
            Some(next) if opens => format!("{line} {next}"),
            _ => (*line).to_owned(),
        }
    });
    with_next.collect()
}

#[test]
fn every_unsafe_is_listed_with_its_reason() {
    let mut used = Vec::new();
    for path in files(top(), "rs") {
        let text = fs::read_to_string(&path).expect("the source can be read");
        let name = path.strip_prefix(top()).unwrap_or(&path).display();
        used.extend(uses(&text).into_iter().map(|it| format!("{name}: {it}")));
    }
    let page = page();
    let (_, section) = page
        .split_once("\n## Unsafe code\n")
        .expect("there is such a section");
    let mut listed = Vec::new();
    let mut file = "";
    for line in section.lines().take_while(|line| !line.starts_with("## ")) {
        if let Some(name) = line.strip_prefix("### `") {
            file = name.trim_end_matches('`');
        } else if let Some((code, reason)) =
            line.strip_prefix("| `").and_then(|it| it.split_once("` |"))
        {
            let words = reason.trim_matches([' ', '|']).split(' ').count();
            assert!(words >= 4, "a reason: {line}");
            listed.push(format!("{file}: {code}"));
        }
    }
    used.sort();
    listed.sort();
    assert_eq!(used, listed);
}

#[test]
fn an_unsafe_is_found_wherever_it_stands() {
    let text = "fn a() { x@y }\n    @ {\n        // why\n        b()\n    }\n#[@(no_mangle)]\nstatic C: u8;\n// @\n#![forbid(@_code)]\n@ fn d();\n";
    let found = uses(&text.replace('@', WORD));
    let marked = ["@ { b()", "#[@(no_mangle)] static C: u8;", "@ fn d();"];
    assert_eq!(found, marked.map(|it| it.replace('@', WORD)));
}

#[test]
fn what_is_not_on_the_list_forbids_unsafe_code() {
    let metadata = MetadataCommand::new()
        .cargo_path(env!("CARGO"))
        .manifest_path(top().join("Cargo.toml"))
        .no_deps()
        .other_options(["--locked".to_owned()])
        .exec()
        .expect("cargo knows its packages");
    let (mut forbids, mut does_not) = (BTreeSet::new(), BTreeSet::new());
    for package in metadata.packages {
        for target in package.targets {
            if target.kind.contains(&TargetKind::Lib) {
                let text = fs::read_to_string(&target.src_path).expect("the source can be read");
                let said = text.contains(&format!("#![forbid({WORD}_code)]"));
                let of = if said { &mut forbids } else { &mut does_not };
                of.insert(package.name.to_string());
            }
        }
    }
    // The library of the image denies it, and lets the board alone do it.
    assert_eq!(does_not, BTreeSet::from(["plc".to_owned()]));
    assert!(forbids.len() >= 6, "{forbids:?}");
    let library = fs::read_to_string(top().join("firmware/lib.rs")).expect("it can be read");
    assert!(library.contains(&format!("#![deny({WORD}_code)]")));
}

/// What stands between two marks.
fn between(text: &str, mark: char) -> impl Iterator<Item = &str> {
    text.split(mark).skip(1).step_by(2)
}

#[test]
fn every_test_that_the_page_names_exists() {
    let page = page();
    let (promises, _) = page
        .split_once("\n## Unsafe code\n")
        .expect("there is such a section");
    let promises: Vec<&str> = promises.split_whitespace().collect();
    let promises = promises.join(" ");
    let contents = |extension| {
        files(top(), extension)
            .into_iter()
            .map(|path| fs::read_to_string(path).expect("a test can be read"))
            .collect::<String>()
    };
    let (rust, script) = (contents("rs"), contents("js"));
    let is_name = |name: &&str| {
        let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        name.chars().all(plain) && name.matches('_').count() >= 2
    };
    let functions: Vec<&str> = between(&promises, '`').filter(is_name).collect();
    let sentences: Vec<&str> = between(&promises, '*').collect();
    assert!(functions.len() >= 15, "{functions:?}");
    assert!(sentences.len() >= 10, "{sentences:?}");
    let no_function = functions
        .into_iter()
        .filter(|it| !rust.contains(&format!("fn {it}(")));
    let no_sentence = sentences.into_iter().filter(|it| !script.contains(*it));
    let missing: Vec<&str> = no_function.chain(no_sentence).collect();
    assert_eq!(missing, Vec::<&str>::new());
}
