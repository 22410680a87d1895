//! Where lines break, and how far they are indented.

use super::{action, body, formatted};

#[test]
fn the_lines_of_the_author_stay() {
    assert_eq!(
        body("always{A;B}\nalways{\nA;B\nC;\n}"),
        "always { A; B }\nalways {\n    A; B\n    C;\n}\n"
    );
    let one_line = "graph G { initial step 1; step 2 { A; B IF c }; transition 1: 1 -> 2 }\n";
    assert_eq!(formatted(one_line), one_line);
}

#[test]
fn the_braces_of_a_block_over_several_lines_end_their_lines() {
    assert_eq!(
        body("step 1\n\n{ A\nB } step 2 { C\n} ; step 3"),
        "step 1 {\n    A\n    B\n}\nstep 2 {\n    C\n};\nstep 3\n"
    );
    assert_eq!(
        formatted("graph G{step 1{\nA}}"),
        "graph G {\n    step 1 {\n        A\n    }\n}\n"
    );
}

#[test]
fn an_empty_block_is_closed_where_it_opens() {
    assert_eq!(body("step 1 {\n\n}\nalways { }"), "step 1  {}\nalways {}\n");
}

#[test]
fn a_statement_that_goes_on_is_indented_once_more() {
    assert_eq!(
        body("transition 1: 1 ->\n2 when a\n\nAND (b\nOR c\n)\ndo\n{\nx = 0\n}"),
        "transition 1: 1 ->\n    2 when a\n    AND (b\n    OR c\n    )\n    do {\n        x = 0\n    }\n"
    );
    assert_eq!(
        formatted("input a,\n      b\ninput c\n"),
        "input  a,\n    b\ninput  c\n"
    );
}

#[test]
fn one_empty_line_stays_of_several_and_none_inside_the_braces() {
    assert_eq!(
        formatted("\n\nvar a\n\n\n\nvar b\ngraph G {\n\n\nstep 1\n \n\t\nstep 2\n\n}\n\n\n"),
        "var a\n\nvar b\ngraph G {\n    step 1\n\n    step 2\n}\n"
    );
}

#[test]
fn a_semicolon_at_the_start_of_a_line_goes_to_the_end_of_the_one_before() {
    assert_eq!(action("A\n; B\n;;C"), "A; B;; C\n");
}

#[test]
fn an_empty_text_stays_empty() {
    for text in ["", " \n\n\t", "\r\n"] {
        assert_eq!(formatted(text), "");
    }
}

#[test]
fn lines_end_as_the_first_one_does() {
    assert_eq!(formatted("var a\r\nvar b"), "var a\r\nvar b\r\n");
    assert_eq!(formatted("var a\nvar b\r\n"), "var a\nvar b\n");
}

#[test]
fn a_byte_order_mark_stays() {
    assert_eq!(formatted("\u{feff}  var   a"), "\u{feff}var a\n");
}
