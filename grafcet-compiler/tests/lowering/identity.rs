//! Fingerprints and the keys of what is retained.

use crate::tables;

const TEXT: &str = "input a\nretain var n : int in 0..9\nparameter p : time = 2s\noutput M\n\
                    graph G { initial step 1 { n = n + 1; M IF T/X1/p AND n > 3 }; transition 1: 1 -> 1 when a }";

#[test]
fn the_same_program_has_the_same_fingerprint_however_it_is_written() {
    let rewritten = TEXT
        .replace("graph G {", "// a comment\ngraph G \"saw\" {\n")
        .replace("AND", "&");
    assert_eq!(tables(TEXT).fingerprint, tables(&rewritten).fingerprint);
}

#[test]
fn another_condition_initial_value_or_period_is_another_program() {
    let fingerprint = tables(TEXT).fingerprint;
    for (from, to) in [
        ("when a", "when NOT a"),
        ("= 2s", "= 3s"),
        ("input a", "scan 20ms\ninput a"),
        ("in 0..9", "in 0..8"),
    ] {
        let other = TEXT.replace(from, to);
        assert_ne!(other, TEXT);
        assert_ne!(tables(&other).fingerprint, fingerprint, "{to}");
    }
}

fn keys(text: &str) -> Vec<u32> {
    tables(text).retained.iter().map(|row| row.key).collect()
}

#[test]
fn what_is_retained_is_known_again_by_its_name_type_and_range() {
    let before = keys(TEXT);
    assert_eq!(before.len(), 2);
    let unrelated = TEXT
        .replace("input a", "input b, a\nvar more")
        .replace("n > 3", "n > 3 AND b AND NOT more");
    assert_eq!(keys(&unrelated), before);
    assert_eq!(keys(&TEXT.replace("= 2s", "= 3s")), before);
    assert_ne!(keys(&TEXT.replace("in 0..9", "in 0..8"))[0], before[0]);
    assert_ne!(
        keys(
            &TEXT
                .replace("parameter p", "parameter q")
                .replace("/p", "/q")
        )[1],
        before[1]
    );
}

#[test]
fn variables_of_two_graphs_have_keys_of_their_own() {
    let text = "graph A { retain var n : int; initial step 1 { n = n + 1 } }\n\
                graph B { retain var n : int; initial step 1 { n = n + 1 } }\nvar v : int\ngraph C { initial step 1 { v = v + 1 } }";
    let keys = keys(text);
    assert_eq!(keys.len(), 2);
    assert_ne!(keys[0], keys[1]);
}
