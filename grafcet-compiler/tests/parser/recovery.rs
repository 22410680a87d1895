//! After an error the next one is real, and what is right is kept.

use super::{read, wrong};
use grafcet_compiler::ast::{Element, Item};

#[test]
fn each_wrong_line_is_reported_once() {
    assert_eq!(
        wrong(
            "graph G {\nstep 1 {\nA IF (b\nB IF c AND OR d\nC\nD E F G\n}\ntransition 1: 1 - 2\nstep 2\n}\nimput a"
        ),
        [
            "syntax 3: expected `)`, found the end of the line",
            "syntax 4: expected a name, a number or a condition, found `OR`",
            "syntax 6: expected the end of the line or `;`, found `E`",
            "syntax 8: expected `->` between the steps of the transition, found `-`",
            "syntax 11: expected a declaration, a graph, a plant, a property or a test, found `imput`",
        ]
    );
}

#[test]
fn an_unknown_element_is_skipped_with_its_braces() {
    let text = "graph G {\nunit 3 {\nA;\nB IF { C }\n}\nstep 4\n}\ninput a";
    assert_eq!(
        wrong(text),
        ["syntax 2: expected a declaration, a step, a transition or `always`, found `unit`"]
    );
    let (file, _) = read(text);
    assert_eq!(file.items.len(), 2);
    assert!(matches!(&file.items[0], Item::Graph(graph) if graph.elements.len() == 1));
}

#[test]
fn a_step_with_a_wrong_head_keeps_what_stands_behind_it() {
    let text = "graph G {\nstep 1 encloses { A\nB }\nstep 2 { C IF }\n}";
    let (file, diagnostics) = read(text);
    assert_eq!(diagnostics.len(), 2, "{diagnostics:?}");
    assert!(matches!(&file.items[0], Item::Graph(graph) if graph.elements.len() == 2));
}

#[test]
fn a_brace_that_is_not_closed_is_reported_where_it_was_opened() {
    assert_eq!(
        wrong("graph G {\nstep 1 { A\nstep 2 { B }\n}\ngraph H {\nstep 1\ngraph I { }"),
        [
            "syntax 2: this action is not closed",
            "syntax 5: `H` is not closed"
        ]
    );
    assert_eq!(
        wrong("test \"t\" {\nwait 1 s\ninput a"),
        ["syntax 1: this test is not closed"]
    );
    assert_eq!(
        wrong("graph G {\nstep 1 {\nA"),
        [
            "syntax 1: `G` is not closed",
            "syntax 2: this action is not closed"
        ]
    );
}

#[test]
fn what_stands_behind_an_open_brace_is_read() {
    let (file, _) = read("graph G {\nstep 1 { A\nstep 2 { B }\n}\ngraph H { step 1 }");
    assert_eq!(file.items.len(), 2);
    assert!(matches!(&file.items[0], Item::Graph(graph) if graph.elements.len() == 2));
}

#[test]
fn a_brace_that_closes_nothing_is_reported_once() {
    assert_eq!(
        wrong("input a\n}\ninput b"),
        ["syntax 2: this `}` closes nothing"]
    );
}

#[test]
fn a_parenthesis_over_several_lines_is_skipped_whole() {
    assert_eq!(
        wrong("graph G {\ntransition 1: 1 -> 2 when (a AND\nb c\nOR d)\nstep 3\n}"),
        ["syntax 3: expected `)`, found `c`"]
    );
}

#[test]
fn a_transition_with_a_wrong_trigger_is_kept() {
    let (file, diagnostics) = read("graph G {\ntransition 1: 1 -> 2 when AND do { a = 1 }\n}");
    assert_eq!(diagnostics.len(), 1);
    let Item::Graph(graph) = &file.items[0] else {
        panic!("a graph")
    };
    assert!(matches!(&graph.elements[..], [Element::Transition(_)]));
}

#[test]
fn elements_in_the_wrong_room_are_told_where_they_belong() {
    for (text, help) in [
        (
            "step 1 { A }",
            "steps, transitions and stand-alone actions stand inside a graph: `graph G { .. }`",
        ),
        (
            "graph G { SPIN IF a\n}",
            "what is done stands in the braces of a step or of `always`",
        ),
        ("Graph G { }", "did you mean `graph`?"),
        (
            "graph G { tranistion 1: 1 -> 2\n}",
            "did you mean `transition`?",
        ),
    ] {
        let (_, diagnostics) = read(text);
        assert_eq!(diagnostics.len(), 1, "{text}");
        assert_eq!(diagnostics[0].help.as_deref(), Some(help), "{text}");
    }
}

#[test]
fn a_word_that_is_nearly_right_is_read_as_it_was_meant() {
    let (file, diagnostics) = read("imput a\nGraph G {\nstepp 3 { A }\ninitial step 4 { A }\n}");
    assert_eq!(diagnostics.len(), 3);
    assert!(matches!(&file.items[0], Item::Declaration(_)));
    assert!(matches!(&file.items[1], Item::Graph(graph) if graph.elements.len() == 2));
}
