//! The files that come with the repository.

#![allow(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use std::fs;

use wiring::load;

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
            // Pins carry no numbers yet.
            Err(_) if reads_numbers(&directory, &example) => {}
            Err(error) => faults += &format!("{example}: plc.toml: {error}\n"),
        }
    }
    assert!(faults.is_empty(), "\n{faults}");
}

fn reads_numbers(directory: &str, example: &str) -> bool {
    let program = fs::read_to_string(format!("{directory}/{example}.grafcet"));
    program.is_ok_and(|text| text.contains(" at %IW"))
}

#[test]
fn the_radial_saw_has_two_inputs_and_an_output() {
    let loaded = load(&from_top("graphs/examples/radial_saw/plc.toml")).unwrap();
    let (application, wiring) = loaded.image.unwrap();
    assert_eq!(application.name, "radial_saw");
    assert_eq!((wiring.inputs.len(), wiring.outputs.len()), (2, 1));
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
