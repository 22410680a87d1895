//! Where things lie in the image and among the numbers.

use grafcet_compiler::application::{Symbols, VariableSymbol};
use grafcet_core::program::{Bit, Number, NumberRow, Run, Slot};

use crate::{application, tables};

fn variable<'s>(symbols: &'s Symbols, name: &str) -> &'s VariableSymbol {
    let found = symbols
        .variables
        .iter()
        .find(|variable| variable.name == name);
    found.unwrap_or_else(|| panic!("no {name}"))
}

fn word(slot: Slot) -> u16 {
    match slot {
        Slot::Bit(bit) => bit.0 / 32,
        Slot::Number(number) => panic!("{number:?}"),
    }
}

#[test]
fn every_kind_of_boolean_has_words_of_its_own() {
    let application = application(
        "input a, b\noutput M, S\nvar v\nparameter p : bool = TRUE\ninput level : int\n\
         graph G { initial step 1 { M IF a; S = b; v = p }; step 2; transition 1: 1 -> 2 when v\n\
         macro step M5 { entry step 3; exit step 4; transition 2: 3 -> 4 when level > 3 }; transition 3: 2 -> M5; transition 4: M5 -> 1 }\n\
         graph H { initial step 1 }",
    );
    let (symbols, tables) = (
        &application.controller.symbols,
        &application.controller.tables,
    );
    let layout = tables.layout;
    assert_eq!(layout.inputs, Run { start: 1, len: 1 });
    assert_eq!(layout.situations, Run { start: 2, len: 2 });
    assert_eq!(layout.macros, Run { start: 4, len: 1 });
    assert_eq!(word(variable(symbols, "S").slot), 5);
    assert_eq!(word(variable(symbols, "v").slot), 5);
    assert_eq!(layout.momentary, Run { start: 6, len: 1 });
    assert_eq!(word(variable(symbols, "M").slot), 6);
    assert_eq!(layout.outside, Run { start: 7, len: 1 });
    assert_eq!(
        tables.initially_true,
        [match variable(symbols, "p").slot {
            Slot::Bit(bit) => bit,
            Slot::Number(_) => Bit(0),
        }]
    );
}

#[test]
fn steps_lie_in_source_order_with_expansions_in_their_place() {
    let application = application(
        "graph G { initial step 1; macro step M5 { entry step 3; macro step M6 { entry step 7; exit step 8; transition 1: 7 -> 8 }\n\
         exit step 4; transition 2: 3 -> M6; transition 3: M6 -> 4 }; step 2\n\
         transition 4: 1 -> M5; transition 5: M5 -> 2; transition 6: 2 -> 1 }",
    );
    let graph = &application.controller.symbols.graphs[0];
    let ids: Vec<&str> = graph.steps.iter().map(|step| step.id.as_str()).collect();
    assert_eq!(ids, ["1", "3", "7", "8", "4", "2"]);
    // Inner ones first.
    let macros = &application.controller.tables.macros;
    let runs: Vec<Run> = macros.iter().map(|row| row.steps).collect();
    assert_eq!(runs, [Run { start: 2, len: 2 }, Run { start: 1, len: 4 }]);
}

#[test]
fn number_inputs_come_first_behind_the_systems() {
    let application = application(
        "var n : int = 7 in 3..9\ninput level : int at %IW0 in 10..20\ninput raw : int at %IW1\nvar late : time in 2s..3s\n\
         graph G { initial step 1 { n = level + raw; late = late + 1s IF n > 3 } }",
    );
    let (symbols, tables) = (
        &application.controller.symbols,
        &application.controller.tables,
    );
    assert_eq!(tables.layout.number_inputs, Run { start: 2, len: 2 });
    assert_eq!(variable(symbols, "level").slot, Slot::Number(Number(2)));
    let row = |initial, min, max| NumberRow { initial, min, max };
    assert_eq!(
        tables.numbers[2..],
        [
            row(10, 10, 20),
            row(0, -32_768, 32_767),
            row(7, 3, 9),
            row(2000, 2000, 3000),
        ]
    );
    assert_eq!(variable(symbols, "late").initial, 2000);
}

#[test]
fn a_word_is_unsigned_when_its_range_says_so() {
    let tables = tables(
        "input level : int at %IW0 in 0..40000\noutput N : int at %QW0 in 5..65535\n\
         graph G { initial step 1 { N = level } }",
    );
    let limits: Vec<(i32, i32)> = tables.numbers[2..]
        .iter()
        .map(|row| (row.min, row.max))
        .collect();
    assert_eq!(limits, [(0, 40_000), (5, 65_535)]);
}

#[test]
fn symbols_are_globals_first_then_graph_by_graph() {
    let application = application(
        "graph G { input x at %IX0.1; initial step 1 { M IF x AND go }; output M at %QX0.1 }\n\
         output N at %Q0.0 \"lamp\"\nconst C : int = 3\ninput go\ngraph H { initial step 1 { N IF go }; var n : int = C; always { n = n + 1 } }",
    );
    let symbols = &application.controller.symbols;
    let names: Vec<&str> = symbols
        .variables
        .iter()
        .map(|it| it.name.as_str())
        .collect();
    assert_eq!(names, ["N", "go", "G:x", "G:M", "H:n"]);
    let lamp = variable(symbols, "N");
    assert_eq!(
        (lamp.address.as_deref(), lamp.text.as_deref()),
        (Some("%QX0.0"), Some("lamp"))
    );
    assert_eq!(variable(symbols, "H:n").graph, Some(1));
}

#[test]
fn names_of_an_instance_stand_for_what_they_are_bound_to() {
    let application = application(
        "template Saw { input go, stop; output MOTOR, LAMP; parameter d : time = 2s; var n : int\n\
           initial step 1 { MOTOR IF T/X1/d; LAMP = TRUE; n = n + 1; on activation: n = 0 }\n\
           transition 1: 1 -> 1 when go AND NOT stop AND n > 3 AND S(Saw) = {1} }\n\
         input a, b\noutput M\n\
         graph Left = Saw { go = a OR b; stop at %IX0.3; MOTOR = M; LAMP at %QX0.4; d = 3s }\n\
         graph Right { initial step 1; transition 1: 1 -> 1 when Left:go AND Left:MOTOR }",
    );
    let symbols = &application.controller.symbols;
    let names: Vec<(&str, bool)> = symbols
        .variables
        .iter()
        .map(|it| (it.name.as_str(), it.bound))
        .collect();
    assert_eq!(
        names,
        [
            ("a", false),
            ("b", false),
            ("M", false),
            ("Left:stop", true),
            ("Left:LAMP", true),
            ("Left:d", false),
            ("Left:n", false),
        ]
    );
    assert_eq!(variable(symbols, "Left:d").initial, 3000);
    assert_eq!(
        variable(symbols, "Left:stop").address.as_deref(),
        Some("%IX0.3")
    );
}

#[test]
fn inputs_count_as_read_by_conditions_values_and_edges_and_no_others() {
    let tables = tables(
        "input a, b, c, d, e, f, g\ninput n : int\nvar m\n\
         graph G { initial step 1 { m = a OR NOT b }; transition 1: 1 -> 1 when c AND ↑d\n\
         always { M IF ↓e AND n > 1 AND (f XOR NOT X1) } }\noutput M",
    );
    assert_eq!(tables.read_inputs, [0b011_1111]);
}

#[test]
fn first_scan_counts_as_read_by_conditions_and_values_only_where_one_reads_it() {
    let reads = |condition: &str| {
        tables(&format!(
            "input a\nvar m\ngraph G {{ initial step 1; transition 1: 1 -> 1 when {condition} }}"
        ))
        .reads_first_scan
    };
    assert!(!reads("a"));
    assert!(!reads("System:recovered"));
    assert!(reads("a AND NOT System:first_scan"));
    assert!(reads("a XOR System:first_scan"));
    assert!(reads("↑System:first_scan"));
}
