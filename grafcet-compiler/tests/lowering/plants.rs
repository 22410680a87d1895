//! Plants, the wires between them and the controller, and what observes both in a test.

use grafcet_compiler::application::{Place, TestStepKind};
use grafcet_core::program::{Slot, Watch};

use crate::application;

const TEXT: &str = "input up, down, go\ninput level : int\noutput RAISE\nparameter speed : int = 2\nconst TOP : int = 100\n\
    graph G { initial step 1 { RAISE IF go AND NOT up AND NOT down AND level < 3 + speed } }\n\
    plant Press { var height : int = 50 in 0..100; var jammed\n\
      always { height = height + speed IF RAISE AND height < TOP AND NOT jammed AND NOT down; up IF height >= TOP; down IF up; level = height } }\n\
    test \"t\" with Press { set jammed, go; set speed = 3, level = 7; release go; clear jammed\n expect height > 3 AND RAISE AND T/X1/2s AND ↑X1; power cycle }";

#[test]
fn a_plant_reads_outputs_parameters_and_others_inputs_and_writes_inputs() {
    let application = application(TEXT);
    let plant = &application.plants[0];
    let controller = &application.controller.symbols;
    let slot = |name: &str| {
        controller
            .variables
            .iter()
            .find(|it| it.name == name)
            .unwrap()
            .slot
    };
    let read: Vec<Slot> = plant.reads.iter().map(|wire| wire.from).collect();
    assert_eq!(read.len(), 2);
    assert!(read.contains(&slot("RAISE")) && read.contains(&slot("speed")));
    let written: Vec<Slot> = plant.writes.iter().map(|wire| wire.to).collect();
    assert_eq!(written, [slot("up"), slot("down"), slot("level")]);
    let names: Vec<&str> = plant
        .unit
        .symbols
        .variables
        .iter()
        .map(|it| it.name.as_str())
        .collect();
    assert_eq!(names, ["Press:height", "Press:jammed"]);
    assert!(plant.unit.tables.retained.is_empty());
    assert_eq!(plant.unit.tables.program().unsoundness(), None);
}

#[test]
fn a_test_names_places_of_both_sides() {
    let application = application(TEXT);
    let test = &application.tests[0];
    let in_plant = |place: &Place| matches!(place, Place::Plant(0, _));
    let TestStepKind::Set(first) = &test.steps[0].kind else {
        panic!("{:?}", test.steps[0])
    };
    assert!(in_plant(&first[0].0) && !in_plant(&first[1].0));
    assert_eq!((first[0].1, first[1].1), (1, 1));
    let TestStepKind::Set(numbers) = &test.steps[1].kind else {
        panic!("{:?}", test.steps[1])
    };
    assert_eq!((numbers[0].1, numbers[1].1), (3, 7));
    let TestStepKind::Set(cleared) = &test.steps[3].kind else {
        panic!("{:?}", test.steps[3])
    };
    assert_eq!(cleared[0].1, 0);
    let TestStepKind::Expect(claim) = &test.steps[4].kind else {
        panic!("{:?}", test.steps[4])
    };
    let mentions: Vec<&str> = claim
        .mentions
        .iter()
        .map(|(name, _)| name.as_str())
        .collect();
    assert_eq!(mentions, ["RAISE", "Press:height", "G:X1"]);
}

#[test]
fn an_observer_watches_steps_like_any_other_bit() {
    let application = application(TEXT);
    let tables = &application.tests[0].observer.tables;
    assert!(tables.graphs.is_empty());
    assert!(matches!(
        tables.watches[..],
        [
            Watch::Timer { .. },
            Watch::Edge {
                from_false: false,
                ..
            },
            Watch::Value { gate: None, .. }
        ]
    ));
    assert_eq!(tables.program().unsoundness(), None);
}
