//! The addresses: each one of the program, in its own table, once.

use wiring::rule::Rule;

use crate::{PROGRAM, changed, loaded_with, shown};

#[test]
fn a_key_has_to_be_an_address() {
    assert_shown!(changed("\"%IX0.0\"", "\"start\""), BadAddress, NotWired);
}

#[test]
fn two_spellings_of_an_address_are_one() {
    assert_shown!(
        changed("[outputs]", "\"%I0.1\" = \"GP4\"\n\n[outputs]"),
        DuplicateAddress
    );
}

#[test]
fn an_output_is_no_input() {
    assert_shown!(
        changed("[outputs]", "\"%QX0.1\" = \"GP4\"\n\n[outputs]"),
        AddressDirection
    );
}

#[test]
fn memory_is_on_no_pin() {
    assert_shown!(
        changed("[outputs]", "\"%MX0.1\" = \"GP4\"\n\n[outputs]"),
        AddressDirection
    );
}

#[test]
fn an_address_that_the_program_does_not_use_is_refused() {
    assert_shown!(
        changed("[outputs]", "\"%IX0.2\" = \"GP4\"\n\n[outputs]"),
        UnknownAddress
    );
}

#[test]
fn a_mistyped_address_is_told_which_was_meant() {
    assert_shown!(changed("%IX0.1", "%IX1.0"), UnknownAddress, NotWired);
}

#[test]
fn every_input_and_output_of_the_program_needs_a_pin() {
    let unwired = loaded_with(
        PROGRAM,
        "application = \"saw.grafcet\"\nboard = \"pico\"\n[inputs]\n",
    );
    assert_shown!(shown(&unwired), NotWired, NotWired, NotWired);
}
