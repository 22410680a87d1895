//! Comments stay where they are.

use super::{action, body, formatted};

#[test]
fn comments_at_the_ends_of_lines_line_up() {
    assert_eq!(
        action("A // first\nLONG IF a // second\n\nB // third\nC\nD // fourth"),
        "A          // first\nLONG IF a  // second\n\nB  // third\nC\nD  // fourth\n"
    );
}

#[test]
fn a_comment_on_its_own_is_indented_as_what_follows() {
    assert_eq!(
        formatted(
            "  // head\n\n\n// more\ngraph G { // here\n\n// step\nstep 1\n// end\n\n}\n  // tail"
        ),
        "// head\n\n// more\ngraph G {  // here\n    // step\n    step 1\n    // end\n}\n// tail\n"
    );
}

#[test]
fn a_comment_within_a_statement_is_indented_as_its_lines() {
    assert_eq!(
        body("transition 1: 1 -> 2 when a AND // why\nb\n\n// or\nOR c"),
        "transition 1: 1 -> 2 when a AND  // why\n    b\n    // or\n    OR c\n"
    );
}

#[test]
fn a_comment_within_a_line_stays_between_its_words() {
    assert_eq!(
        action("A(* x *)IF(* y *)a\n(* z *)B\n(* of (* two *) *) C; D"),
        "A (* x *) IF (* y *) a\n(* z *) B\n(* of (* two *) *) C; D\n"
    );
}

#[test]
fn a_comment_keeps_its_line_when_the_braces_move() {
    assert_eq!(
        body("step 1 // why\n{ A (* a *) } // b\nstep 2 { (* c *) B\nC (* d *) }"),
        "step 1         // why\n{ A (* a *) }  // b\nstep 2 {\n    (* c *) B\n    C  (* d *)\n}\n"
    );
    assert_eq!(body("step 1 { // a\n}"), "step 1 {  // a\n}\n");
}

#[test]
fn a_comment_over_several_lines_moves_as_a_whole() {
    assert_eq!(
        body("  (* one\n       two\n\n   three   \nfour *)\nstep 1"),
        "(* one\n     two\n\n three\n  four *)\nstep 1\n"
    );
    assert_eq!(action("A (* x\n y *) B"), "A  (* x\n  y *)\nB\n");
}

#[test]
fn what_looks_like_a_comment_in_a_text_is_none() {
    let text = "step 1 \"// no (* comment\"  { \"*)\" }\n";
    assert_eq!(body(text), text);
}

#[test]
fn trailing_blanks_of_a_comment_go() {
    assert_eq!(formatted("var a//b  \t \r\n"), "var a  //b\r\n");
}
