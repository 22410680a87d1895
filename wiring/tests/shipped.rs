//! The files that come with the repository.

#![allow(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use std::fs;

use grafcet_compiler::diagnostic::NamedRule;
use wiring::load;
use wiring::rule::Rule;

/// A path from the top of the repository.
fn from_top(path: &str) -> String {
    format!("{}/../{path}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn the_line_switcher_is_wired_without_a_warning() {
    let loaded = load(&from_top("plc.toml")).unwrap();
    assert_eq!(loaded.errors() + &loaded.warnings(), "");
    let (application, wiring) = loaded.image.unwrap();
    assert_eq!(application.name, "line_switcher");
    assert_eq!((wiring.inputs.len(), wiring.outputs.len()), (9, 4));
    // Nothing commands a breaker before the program does.
    assert!(wiring.outputs.iter().all(|output| !output.entry.safe));
}

#[test]
fn every_example_is_wired_without_a_warning() {
    let mut faults = String::new();
    for entry in fs::read_dir(from_top("graphs/examples")).unwrap() {
        let example = entry.unwrap().file_name().into_string().unwrap();
        let directory = from_top(&format!("graphs/examples/{example}"));
        match load(&format!("{directory}/plc.toml")) {
            Ok(loaded) => {
                faults += &(loaded.errors() + &loaded.warnings());
                let program = format!("{directory}/{example}.grafcet");
                assert_eq!(loaded.files.get(1), Some(&program));
            }
            Err(error) => faults += &format!("{example}: plc.toml: {error}\n"),
        }
    }
    assert!(faults.is_empty(), "\n{faults}");
}

#[test]
fn the_radial_saw_has_two_inputs_and_an_output() {
    let loaded = load(&from_top("graphs/examples/radial_saw/plc.toml")).unwrap();
    let (application, wiring) = loaded.image.unwrap();
    assert_eq!(application.name, "radial_saw");
    assert_eq!((wiring.inputs.len(), wiring.outputs.len()), (2, 1));
}

#[test]
fn the_mixing_tank_measures_its_level_in_cm() {
    let loaded = load(&from_top("graphs/examples/mixing_tank/plc.toml")).unwrap();
    let (_, wiring) = loaded.image.unwrap();
    let [level] = wiring.analogue_inputs.as_slice() else {
        panic!("there is one number");
    };
    let entry = level.entry;
    assert_eq!(
        (level.pin.name, entry.low.value, entry.high.value),
        ("GP26", 0, 250)
    );
}

#[test]
fn every_rule_is_in_the_table_of_the_manual() {
    let page = fs::read_to_string(from_top("docs/src/wiring.md")).unwrap();
    let rows = page.lines().filter_map(|line| line.strip_prefix("| `"));
    let named: Vec<&str> = rows
        .skip_while(|row| !row.starts_with("toml`"))
        .filter_map(|row| row.split_once('`'))
        .map(|(name, _)| name)
        .take(Rule::ALL.len())
        .collect();
    let rules: Vec<&str> = Rule::ALL.iter().map(|rule| rule.name()).collect();
    assert_eq!(named, rules);
}

#[test]
fn the_build_follows_every_file_that_it_read() {
    let plc = from_top("plc.toml");
    let loaded = load(&plc).unwrap();
    assert_eq!(
        loaded.files,
        [plc, from_top("graphs/line_switcher.grafcet")]
    );
}
