//! Where retained values are kept: the size of the store, its quiet moment and its alarm.

use wiring::rule::Rule;

use crate::{GOOD, PROGRAM, changed, loaded_with, shown};

#[test]
fn the_retain_area_has_four_sectors_at_least() {
    assert_shown!(changed("sectors = 4", "sectors = 3"), OutOfRange);
    let (rules, _) = changed("sectors = 4", "sectors = 66");
    assert_eq!(rules, [Rule::OutOfRange]);
    assert_eq!(changed("sectors = 4", "sectors = 5").0, []);
}

#[test]
fn a_quiet_moment_is_an_output_or_in_memory() {
    assert_shown!(
        changed("sectors = 4", "quiet = \"%IX0.0\""),
        AddressDirection
    );
    let (rules, _) = changed("sectors = 4", "quiet = \"%QW0\"");
    assert_eq!(rules, [Rule::AddressDirection]);
    assert_eq!(changed("sectors = 4", "quiet = \"%QX0.0\"").0, []);
}

#[test]
fn the_ends_of_the_store_have_addresses_of_the_program() {
    assert_shown!(changed("sectors = 4", "quiet = \"%QX1.0\""), UnknownAddress);
    assert_shown!(changed("sectors = 4", "alarm = \"%IX1.0\""), UnknownAddress);
    let (rules, _) = changed("sectors = 4", "quiet = \"quiet\"");
    assert_eq!(rules, [Rule::BadAddress]);
}

#[test]
fn the_alarm_of_the_store_has_no_pin() {
    assert_shown!(
        changed("sectors = 4", "alarm = \"%IX0.1\""),
        DuplicateAddress
    );
    let (rules, _) = changed("sectors = 4", "alarm = \"%QX0.0\"");
    assert_eq!(rules, [Rule::AddressDirection]);
}

#[test]
fn what_is_wired_to_the_store_needs_no_pin() {
    let program = PROGRAM.replace(
        "graph Saw",
        "input low at %IX1.0\noutput CALM at %QX1.0\n\ngraph Saw",
    );
    let program = program.replace("initial step 1", "initial step 1 { CALM IF NOT low }");
    let plc = GOOD.replace("sectors = 4", "quiet = \"%QX1.0\"\nalarm = \"%IX1.0\"");
    let loaded = loaded_with(&program, &plc);
    let errors = loaded.errors();
    let (_, wiring) = loaded.image.expect(&errors);
    assert!(wiring.store.quiet.is_some() && wiring.store.alarm.is_some());
    assert_eq!((wiring.inputs.len(), wiring.outputs.len()), (2, 1));
    let unwired = loaded_with(&program, GOOD).errors();
    assert!(unwired.contains("has no pin"), "{unwired}");
}

#[test]
fn more_retained_values_than_a_record_takes_are_refused() {
    let names = (0..450).map(|index| format!("parameter P{index} : int = 1\n"));
    let reads = (0..450)
        .map(|index| format!("P{index} > 5"))
        .collect::<Vec<_>>();
    let program = PROGRAM.replace("\ngraph", &format!("{}\ngraph", names.collect::<String>()));
    let program = program.replace("when stop", &format!("when stop OR {}", reads.join(" OR ")));
    assert_shown!(shown(&loaded_with(&program, GOOD)), RetainTooBig);
}
