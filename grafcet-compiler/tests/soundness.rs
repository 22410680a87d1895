//! What the compiler makes of the control programs of the repository is sound.

#![allow(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use std::fs;
use std::path::{Path, PathBuf};

use grafcet_compiler::{Target, compile};

/// Every program under a directory that runs, in a fixed order: what is specified by texts only does not.
fn programs(directory: &Path) -> Vec<PathBuf> {
    let mut paths: Vec<_> = fs::read_dir(directory)
        .unwrap()
        .map(|it| it.unwrap().path())
        .collect();
    paths.sort();
    let (directories, files): (Vec<_>, Vec<_>) = paths.into_iter().partition(|path| path.is_dir());
    let mut found: Vec<_> = files
        .into_iter()
        .filter(|path| {
            let name = path.to_string_lossy();
            name.ends_with(".grafcet") && !name.ends_with(".level1.grafcet")
        })
        .collect();
    found.extend(directories.iter().flat_map(|directory| programs(directory)));
    found
}

#[test]
fn controllers_plants_and_observers_of_every_program_are_sound() {
    let programs = programs(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../graphs"));
    assert!(programs.len() >= 9, "{programs:?}");
    for path in programs {
        let shown = path.display().to_string();
        let text = fs::read_to_string(&path).unwrap();
        let load = |library: &str| fs::read_to_string(path.with_file_name(library));
        let compilation = compile(&shown, &text, &load, Target::Host);
        let application = compilation
            .application
            .ok_or(compilation.diagnostics)
            .unwrap();
        let plants = application.plants.iter().map(|plant| &plant.unit.tables);
        let observers = application.tests.iter().map(|test| &test.observer.tables);
        for tables in [&application.controller.tables]
            .into_iter()
            .chain(plants)
            .chain(observers)
        {
            assert_eq!(tables.program().unsoundness(), None, "{shown}");
        }
    }
}
