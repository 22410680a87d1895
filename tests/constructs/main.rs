//! The programs that the tests of the emulated image run use every construct of the language, in every spelling, and
//! every operation of the tables. A construct that is added to the language has no name here and does not compile.

#![allow(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

mod kinds;
mod spelling;
mod syntax;
mod tables;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::{fs, io};

use wiring::Loaded;

/// Where the programs are, each with its `plc.toml`.
const APPLICATIONS: &str = "tests/emulated/applications";

/// What has been come upon, by the names in [`kinds`].
type Seen = BTreeSet<&'static str>;

fn applications() -> Vec<Loaded> {
    let directories: io::Result<Vec<PathBuf>> = fs::read_dir(APPLICATIONS)
        .unwrap()
        .map(|entry| entry.map(|entry| entry.path()))
        .collect();
    let mut directories = directories.unwrap();
    directories.sort();
    let load = |directory: &PathBuf| {
        let path = directory.join("plc.toml");
        wiring::load(path.to_str().unwrap()).unwrap()
    };
    directories.iter().map(load).collect()
}

/// The texts of all programs and libraries.
fn texts() -> Vec<String> {
    let files = applications().into_iter().flat_map(|it| it.files);
    let programs = files.filter(|file| {
        Path::new(file)
            .extension()
            .is_some_and(|it| it == "grafcet")
    });
    programs
        .map(|file| fs::read_to_string(file).unwrap())
        .collect()
}

fn assert_none(missing: Vec<&str>, what: &str) {
    assert!(
        missing.is_empty(),
        "no program for the image has {what}: {missing:?}"
    );
}

#[test]
fn every_construct_of_the_syntax_occurs_in_a_program_for_the_image() {
    let mut seen = Seen::new();
    for text in texts() {
        syntax::look(&text, &mut seen);
    }
    let demanded = kinds::syntax()
        .into_iter()
        .chain(syntax::FEATURES.iter().copied());
    let runs = demanded.filter(|name| !syntax::NOT_IN_AN_IMAGE.contains(name));
    assert_none(
        runs.filter(|name| !seen.contains(name)).collect(),
        "these constructs",
    );
    let strange = syntax::NOT_IN_AN_IMAGE
        .iter()
        .filter(|name| seen.contains(*name));
    assert_eq!(
        strange.count(),
        0,
        "what is no part of an image is not in its programs"
    );
}

#[test]
fn every_operation_of_the_tables_occurs_in_a_program_for_the_image() {
    let mut seen = Seen::new();
    for loaded in applications() {
        let (application, _) = loaded
            .image
            .as_ref()
            .unwrap_or_else(|| panic!("{}", loaded.errors()));
        tables::look(&application.controller.tables.program(), &mut seen);
    }
    let demanded = kinds::tables()
        .into_iter()
        .chain(tables::FEATURES.iter().copied());
    assert_none(
        demanded.filter(|name| !seen.contains(name)).collect(),
        "these operations",
    );
}

#[test]
fn every_spelling_occurs_in_a_program_for_the_image() {
    let texts: Vec<String> = texts()
        .iter()
        .map(|text| spelling::without_comments(text))
        .collect();
    let unwritten = |spelling: &&&str| !texts.iter().any(|text| text.contains(**spelling));
    assert_none(
        spelling::ALL.iter().filter(unwritten).copied().collect(),
        "these spellings",
    );
}
