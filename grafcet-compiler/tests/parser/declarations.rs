//! Declarations.

use super::{right, show, wrong};
use grafcet_compiler::ast::{Declaration, DeclarationKind, Item, Type};

#[track_caller]
fn declaration(text: &str) -> Declaration {
    match right(text).items.into_iter().next() {
        Some(Item::Declaration(declaration)) => declaration,
        other => panic!("{other:?}"),
    }
}

#[test]
fn every_kind_is_declared() {
    for (text, kind) in [
        ("input a", DeclarationKind::Input),
        ("output a", DeclarationKind::Output),
        ("var a", DeclarationKind::Variable { retain: false }),
        ("retain var a", DeclarationKind::Variable { retain: true }),
        ("parameter a", DeclarationKind::Parameter),
        ("const a = 1", DeclarationKind::Constant),
    ] {
        assert_eq!(declaration(text).kind, kind);
    }
}

#[test]
fn a_declaration_with_everything() {
    let declared = declaration("var level : int at %MW3 = -5 in -10..16#FF \"the tank\"");
    assert_eq!(declared.ty.unwrap().0, Type::Int);
    assert_eq!(declared.address.unwrap().text, "%MW3");
    assert_eq!(show::constant(&declared.initial.unwrap()), "-5");
    let (low, high) = declared.range.unwrap();
    assert_eq!(
        (show::constant(&low), show::constant(&high)),
        ("-10".to_owned(), "255".to_owned())
    );
    assert_eq!(declared.text.unwrap().text, "the tank");
}

#[test]
fn types_are_known_by_their_place() {
    assert_eq!(declaration("var int : int").ty.unwrap().0, Type::Int);
    assert_eq!(declaration("var a : bool").ty.unwrap().0, Type::Bool);
    assert_eq!(declaration("var a : time").ty.unwrap().0, Type::Time);
}

#[test]
fn constants_are_numbers_durations_truth_values_and_names() {
    for (text, constant) in [
        ("5", "5"),
        ("- 5", "-5"),
        ("2s", "2000ms"),
        ("-2 s", "-2000ms"),
        ("True", "true"),
        ("Limit", "Limit"),
    ] {
        assert_eq!(
            show::constant(&declaration(&format!("var a = {text}")).initial.unwrap()),
            constant
        );
    }
}

#[test]
fn several_names_share_a_type_and_a_text() {
    let declared = declaration("input a, b, c : int \"levels\"");
    assert_eq!(show::names(&declared.names), "a b c");
}

#[test]
fn several_names_share_no_address_and_no_value() {
    assert_eq!(
        wrong("input a, b at %IX0.0"),
        ["syntax 1: several names share one address"]
    );
    assert_eq!(
        wrong("var a, b = 1"),
        ["syntax 1: several names share one value"]
    );
}

#[test]
fn an_input_takes_no_value() {
    assert_eq!(
        wrong("input a = 1"),
        ["syntax 1: an input has no value of its own"]
    );
}

#[test]
fn the_parts_stand_in_one_order() {
    assert_eq!(
        wrong("var a = 1 : int"),
        ["syntax 1: `:` stands in the wrong place"]
    );
    assert_eq!(
        wrong("input a \"text\" at %IX0.0"),
        ["syntax 1: `at` stands in the wrong place"]
    );
}

#[test]
fn an_initial_value_is_given_by_an_equals_sign() {
    assert_eq!(
        wrong("var a := 1"),
        ["syntax 1: `:=` stands only in a stored statement"]
    );
}

#[test]
fn only_variables_are_declared_retained() {
    assert_eq!(
        wrong("retain output a"),
        ["syntax 1: expected `var` behind `retain`, found `output`"]
    );
}

#[test]
fn a_name_is_known_though_its_declaration_is_wrong() {
    let (file, diagnostics) = super::read("output a, b : real at %QX0.0");
    assert_eq!(diagnostics.len(), 1);
    assert!(matches!(&file.items[..], [Item::Declaration(declared)] if declared.names.len() == 2));
}

#[test]
fn a_constant_needs_a_value() {
    assert_eq!(wrong("const a"), ["syntax 1: a constant has no value"]);
}
