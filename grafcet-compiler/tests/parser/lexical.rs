//! Comments, names, reserved words and the spellings of operators.

use super::{graph, right, tree, wrong, wrong_trigger};
use grafcet_compiler::ast::{File, Item};

/// The names that the declarations of a file declare.
fn declared(file: &File) -> Vec<String> {
    let mut names = Vec::new();
    for item in &file.items {
        if let Item::Declaration(declaration) = item {
            names.extend(declaration.names.iter().map(|name| name.text.clone()));
        }
    }
    names
}

#[test]
fn a_line_comment_ends_with_its_line() {
    assert_eq!(declared(&right("input a // input b\ninput c")), ["a", "c"]);
}

#[test]
fn comments_nest() {
    assert_eq!(
        declared(&right("input a (* one (* two *) (* three *) *), b")),
        ["a", "b"]
    );
}

#[test]
fn a_comment_over_a_line_end_ends_the_line() {
    assert_eq!(declared(&right("input a (* one\n*) input b")), ["a", "b"]);
}

#[test]
fn a_comment_that_is_not_closed_is_reported_where_it_begins() {
    assert_eq!(
        wrong("input a\n(* one (* two *)\ninput b"),
        ["syntax 2: this comment is not closed"]
    );
}

#[test]
fn a_comment_may_be_the_whole_file() {
    assert_eq!(declared(&right("// nothing")), [""; 0]);
    assert_eq!(declared(&right("(* nothing *)")), [""; 0]);
    assert_eq!(declared(&right("")), [""; 0]);
}

#[test]
fn a_comment_of_c_is_refused_with_ours_as_the_mend() {
    assert_eq!(
        wrong("/* old */ input a"),
        ["syntax 1: `/*` does not begin a comment"]
    );
}

#[test]
fn a_byte_order_mark_and_windows_line_ends_are_nothing() {
    assert_eq!(
        declared(&right("\u{feff}input a\r\ninput b\r\n")),
        ["a", "b"]
    );
}

#[test]
fn letters_are_those_of_every_language() {
    assert_eq!(
        declared(&right("input température, Größe, 温度, ключ_1")),
        ["température", "Größe", "温度", "ключ_1"]
    );
}

#[test]
fn names_are_kept_in_nfc() {
    let decomposed = "input tempe\u{301}rature";
    assert_eq!(declared(&right(decomposed)), ["temp\u{e9}rature"]);
}

#[test]
fn single_points_stand_inside_names() {
    assert_eq!(
        declared(&right("input Line1.breaker.open, a.1")),
        ["Line1.breaker.open", "a.1"]
    );
    assert!(!super::read("input a..b").1.is_empty());
    assert!(!super::read("input a.").1.is_empty());
}

#[test]
fn names_differ_by_case() {
    assert_eq!(
        declared(&right("input spin, Spin, SPIN")),
        ["spin", "Spin", "SPIN"]
    );
}

#[test]
fn a_name_begins_with_a_letter() {
    assert_eq!(wrong("input _a"), ["syntax 1: `_` means nothing here"]);
}

#[test]
fn every_reserved_word_is_refused_as_a_name() {
    let lower = "application import scan evolution input output retain var parameter const graph always initial step \
                 macro entry exit transition template plant property test at in encloses when do on";
    let any_case = "AND and Or XOR not Mod IF if TRUE True false RE re FE";
    for word in lower.split_whitespace().chain(any_case.split_whitespace()) {
        let text = format!("var {word}");
        assert_eq!(
            wrong(&text),
            [format!(
                "reserved-word 1: `{word}` is a reserved word and cannot be a name"
            )]
        );
    }
}

#[test]
fn reserved_words_in_another_case_are_names() {
    assert_eq!(
        declared(&right("var Step, GRAPH, When, ON")),
        ["Step", "GRAPH", "When", "ON"]
    );
}

#[test]
fn step_bits_of_numbered_steps_and_system_are_reserved() {
    assert_eq!(wrong("var X25"), ["reserved-word 1: `X25` is reserved"]);
    assert_eq!(
        wrong("graph System { }"),
        ["reserved-word 1: `System` is reserved"]
    );
    assert_eq!(
        declared(&right("var X, XV101, XM5, x25, X2a, system")),
        ["X", "XV101", "XM5", "x25", "X2a", "system"]
    );
}

#[test]
fn a_system_without_its_name_is_reserved() {
    assert_eq!(
        wrong_trigger("System"),
        "reserved-word 1: `System` is reserved"
    );
    assert_eq!(tree("System:first_scan"), "System:first_scan");
}

#[test]
fn a_reserved_word_in_an_expression_is_reported_as_one() {
    assert_eq!(
        wrong_trigger("a AND step"),
        "reserved-word 1: `step` is a reserved word and cannot be a name"
    );
}

#[test]
fn words_of_the_grammar_are_free_as_names() {
    let words = "set clear release pulse wait until within expect never reachable recoverable after power cycle \
                 scans with for bool int time stable activation deactivation event min ms s h d T F S I";
    let names: Vec<_> = words.split_whitespace().collect();
    assert_eq!(
        declared(&right(&format!("var {}", names.join(", ")))),
        names
    );
    for word in names {
        assert_eq!(tree(&format!("a AND {word}")), format!("(AND a {word})"));
        graph(&format!("graph G {{ step 1 {{ {word}; {word} = 1 }} }}"));
    }
}

#[test]
fn every_spelling_of_an_operator_means_the_same() {
    for (spellings, meaning) in [
        (
            &["a AND b", "a and b", "a & b", "a&b", "a·b", "a · b"][..],
            "(AND a b)",
        ),
        (&["a OR b", "a Or b", "a | b"], "(OR a b)"),
        (&["a XOR b", "a xor b"], "(XOR a b)"),
        (&["NOT a", "not a", "!a", "¬a", "¬ a"], "(NOT a)"),
        (&["↑a", "RE a", "re a", "↑ a"], "(↑ a)"),
        (&["↓a", "FE a", "Fe a"], "(↓ a)"),
        (&["a = b", "a=b"], "(= a b)"),
        (&["a <> b", "a≠b"], "(<> a b)"),
        (&["a <= b", "a≤b"], "(<= a b)"),
        (&["a >= b", "a≥b"], "(>= a b)"),
        (&["TRUE", "True", "true"], "true"),
        (&["FALSE", "False"], "false"),
        (&["a MOD b = 0", "a mod b = 0"], "(= (MOD a b) 0)"),
    ] {
        for spelling in spellings {
            assert_eq!(tree(spelling), meaning, "{spelling}");
        }
    }
}

#[test]
fn operators_of_other_languages_are_refused_and_read_as_meant() {
    for (spelling, mend) in [
        ("a == b", "write `=`"),
        ("a != b", "write `<>`"),
        ("a && b", "write `AND`"),
        ("a || b", "write `OR`"),
        ("a => b", "write `>=`"),
        ("a =< b", "write `<=`"),
        ("~a", "write `NOT`"),
        ("a ∧ b", "write `AND`"),
    ] {
        let text = format!("graph G {{ transition 1: 1 -> 2 when {spelling}\n}}");
        let (_, diagnostics) = super::read(&text);
        assert_eq!(diagnostics.len(), 1, "{spelling}");
        assert_eq!(diagnostics[0].help.as_deref(), Some(mend), "{spelling}");
    }
}

#[test]
fn characters_of_no_token_are_reported_once_for_a_run() {
    assert_eq!(
        wrong("input a @@@@ b\ninput c"),
        ["syntax 1: `@` means nothing here"]
    );
}

#[test]
fn a_text_stands_on_one_line() {
    assert_eq!(
        wrong("input a \"one\ninput b"),
        ["syntax 1: this text is not closed"]
    );
}

#[test]
fn a_text_has_no_escapes() {
    let file = right(r#"application a "C:\new // (* not a comment""#);
    let (_, text) = file.application.unwrap();
    assert_eq!(text.unwrap().text, r"C:\new // (* not a comment");
}
