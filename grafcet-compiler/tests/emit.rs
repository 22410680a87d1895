//! Tables as Rust source: what is written is what stands in the image.

use grafcet_compiler::emit;
use grafcet_core::program::{Compiled, Names};

#[path = "emit/every_row.rs"]
mod every_row;

/// The source that is compared with what `emit` writes, compiled.
mod written {
    use grafcet_core::program::Slot;

    pub struct PlantTables {
        pub name: &'static str,
        pub program: Program<'static>,
        pub reads: &'static [(Slot, Slot)],
        pub writes: &'static [(Slot, Slot)],
    }

    include!("snapshots/emit__every_row.snap.rs");
}

#[test]
fn the_source_is_the_same_on_every_machine() {
    let application = every_row::application();
    let mut items = emit::program(&application);
    items.extend(emit::plants(&application));
    let source = emit::source(items).unwrap();
    insta::assert_binary_snapshot!("every_row.rs", source.into_bytes());
}

#[test]
fn the_source_has_the_value_of_the_tables() {
    let application = every_row::application();
    assert_eq!(written::PROGRAM, application.controller.tables.program());
}

#[test]
fn the_type_for_an_engine_of_its_own_knows_the_program() {
    assert!(std::ptr::eq(
        written::ThisProgram.program(),
        &raw const written::PROGRAM
    ));
}

#[test]
fn the_source_names_everything() {
    assert_eq!(
        written::NAMES,
        Names {
            application: "every_row",
            graphs: &["G", "H", "I"],
            steps: &["1", "E2", "S3", "1", "1"],
            transitions: &[1, 2, 7, 8, 9],
            retained: &["Locked", "G:température"],
        }
    );
}

#[test]
fn a_plant_brings_its_program_and_its_wires() {
    let application = every_row::application();
    let [plant] = &written::PLANTS;
    assert_eq!(plant.name, "Mirror");
    assert_eq!(plant.program, application.plants[0].unit.tables.program());
    let pairs = |wires: &[grafcet_compiler::application::Wire]| -> Vec<_> {
        wires.iter().map(|wire| (wire.from, wire.to)).collect()
    };
    assert_eq!(plant.reads, pairs(&application.plants[0].reads));
    assert_eq!(plant.writes, pairs(&application.plants[0].writes));
}

#[test]
fn the_storage_is_sized_for_the_program() {
    assert!(written::Storage::is_sized_for(&written::PROGRAM));
}
