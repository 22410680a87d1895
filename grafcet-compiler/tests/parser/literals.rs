//! Integers, durations, step identifiers, addresses.

use super::{right, show, step, transition, tree, wrong, wrong_trigger};
use grafcet_compiler::ast::{Item, ScanOption};

fn scan(duration: &str) -> String {
    match &right(&format!("scan {duration}")).options[..] {
        [ScanOption::Period(period)] => show::constant(period),
        other => panic!("{other:?}"),
    }
}

#[test]
fn integers_have_bases_and_underscores() {
    for (text, value) in [
        ("42", "42"),
        ("16#FF", "255"),
        ("16#ff", "255"),
        ("2#1010", "10"),
        ("2#1111_0000", "240"),
        ("8#17", "15"),
        ("1_000", "1000"),
        ("0", "0"),
        ("2147483648", "2147483648"),
    ] {
        assert_eq!(tree(&format!("n = {text}")), format!("(= n {value})"));
    }
}

#[test]
fn an_integer_too_long_for_any_type_saturates() {
    assert_eq!(
        tree("n = 99999999999999999999999"),
        format!("(= n {})", i64::MAX)
    );
}

#[test]
fn a_minus_directly_before_digits_is_one_literal() {
    assert_eq!(tree("n = -2147483648"), "(= n -2147483648)");
    assert_eq!(tree("t = -2s"), "(= t -2000ms)");
    assert_eq!(tree("n = a -1"), "(= n (- a 1))");
    assert_eq!(tree("n = -a"), "(= n (- a))");
}

#[test]
fn integers_that_cannot_be_read() {
    for text in ["16#G", "2#12", "7#1", "16#", "1_", "1__0", "0.5", "1.5.2"] {
        assert!(
            wrong_trigger(&format!("n = {text}")).starts_with("bad-literal 1: "),
            "{text}"
        );
    }
}

#[test]
fn durations_in_every_spelling() {
    for (text, ms) in [
        ("30ms", 30),
        ("2s", 2_000),
        ("2 s", 2_000),
        ("0.5 s", 500),
        ("0.5s", 500),
        ("1.50s", 1_500),
        ("2min", 120_000),
        ("2 min", 120_000),
        ("0.001min", 60),
        ("1h", 3_600_000),
        ("1d", 86_400_000),
        ("1min30s", 90_000),
        ("1min 30s", 90_000),
        ("1 min 30 s", 90_000),
        ("1h30min", 5_400_000),
        ("1s500ms", 1_500),
        ("1min1.5s", 61_500),
        ("1_000ms", 1_000),
        ("1.0ms", 1),
        ("T#1m30s", 90_000),
        ("t#2S", 2_000),
        ("TIME#1h_30m", 5_400_000),
        ("T#14.5s", 14_500),
        ("T#1d2h3m4s5ms", 93_784_005),
    ] {
        assert_eq!(scan(text), format!("{ms}ms"), "{text}");
    }
}

#[test]
fn a_duration_finer_than_a_millisecond_is_an_error() {
    for text in [
        "0.5ms",
        "0.0001s",
        "1.0005 s",
        "500us",
        "10 µs",
        "T#0.5ms",
        "0.00000000000000000001h",
    ] {
        assert_eq!(
            wrong(&format!("scan {text}")),
            ["bad-literal 1: a duration finer than 1 ms"],
            "{text}"
        );
    }
}

#[test]
fn durations_that_cannot_be_read() {
    for text in [
        "2x",
        "2S",
        "2m",
        "2 sec",
        "30s1min",
        "1s2s",
        "1.5min30s",
        "1min30",
        "T#",
        "T#5",
        "T#-1s",
        "1s_",
    ] {
        let said = wrong(&format!("scan {text}"));
        assert_eq!(said.len(), 1, "{text}: {said:?}");
        assert!(said[0].starts_with("bad-literal 1: "), "{text}: {said:?}");
    }
}

#[test]
fn a_unit_on_the_next_line_is_a_name() {
    let statements = super::statements("n = 2\ns = 3");
    assert_eq!(statements.len(), 2);
}

#[test]
fn an_enormous_duration_saturates() {
    assert_eq!(scan("99999999999999999h"), format!("{}ms", i64::MAX));
}

#[test]
fn steps_are_named_by_digits_or_a_capital_letter_and_digits() {
    for id in ["0", "7", "100", "E5", "S12", "M5", "Ä1", "X5"] {
        assert_eq!(step(&format!("step {id}")).id.text, id);
    }
}

#[test]
fn step_identifiers_that_cannot_be_read() {
    for id in [
        "07", "E05", "00", "e5", "EE5", "spin", "5E", "3s", "1_0", "16#1",
    ] {
        let said = wrong(&format!("graph G {{ step {id}\n}}"));
        assert_eq!(said.len(), 1, "{id}: {said:?}");
        assert!(said[0].starts_with("bad-literal 1: "), "{id}: {said:?}");
    }
}

#[test]
fn a_step_with_leading_zeros_is_taken_as_the_step_that_was_meant() {
    let (file, diagnostics) = super::read("graph G { step 07\ntransition 1: 7 -> 07 }");
    assert_eq!(diagnostics.len(), 2);
    let Item::Graph(graph) = &file.items[0] else {
        panic!("a graph")
    };
    let grafcet_compiler::ast::Element::Step(step) = &graph.elements[0] else {
        panic!("a step")
    };
    assert_eq!(step.id.text, "7");
}

#[test]
fn transitions_are_numbered_by_digits() {
    assert_eq!(transition("transition 12: 1 -> 2").number.text, "12");
    assert_eq!(
        wrong("graph G { transition 012: 1 -> 2\n}"),
        ["bad-literal 1: `012` is not the number of a transition"]
    );
}

#[test]
fn addresses_are_kept_as_written() {
    for address in ["%IX0.0", "%I0.0", "%QX1.7", "%MW0", "%MD12", "%iw3", "%foo"] {
        let file = right(&format!("var a at {address} \"text\""));
        let Item::Declaration(declaration) = &file.items[0] else {
            panic!("a declaration")
        };
        assert_eq!(declaration.address.as_ref().unwrap().text, address);
    }
}

#[test]
fn a_range_is_no_decimal_point() {
    let file = right(
        "parameter a : int = 1 in 0..5; parameter b : time = 1s in 0s..5s; var c : int in Low..High",
    );
    let ranges: Vec<_> = file
        .items
        .iter()
        .filter_map(|item| match item {
            Item::Declaration(declaration) => declaration.range.as_ref(),
            _ => None,
        })
        .map(|(low, high)| format!("{}..{}", show::constant(low), show::constant(high)))
        .collect();
    assert_eq!(ranges, ["0..5", "0ms..5000ms", "Low..High"]);
}
