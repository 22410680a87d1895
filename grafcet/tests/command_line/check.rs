//! `grafcet check`.

use crate::desk::{Desk, desk};

#[test]
fn an_accepted_program_checks_with_0() {
    let said = desk().grafcet(&["check", "drill.grafcet"]);
    assert_eq!(said.code, Some(0), "{said:?}");
    assert_eq!(said.out, "");
}

#[test]
fn a_refused_program_checks_with_1_and_names_rule_and_place() {
    let said = desk().grafcet(&["check", "refused.grafcet"]);
    assert_eq!(said.code, Some(1));
    assert!(said.out.starts_with("error[unknown-name]: "), "{said:?}");
    assert!(said.out.contains("refused.grafcet:2:22"), "{said:?}");
    assert!(
        !said.out.contains('\u{1b}'),
        "no colours in a file: {said:?}"
    );
}

#[test]
fn warnings_refuse_only_when_denied() {
    let desk = desk();
    let said = desk.grafcet(&["check", "warned.grafcet"]);
    assert_eq!(said.code, Some(0));
    assert!(said.out.starts_with("warning[unused]: "), "{said:?}");
    let said = desk.grafcet(&["check", "warned.grafcet", "--deny", "warnings"]);
    assert_eq!(said.code, Some(1));
}

#[test]
fn json_is_one_object_a_line() {
    let desk = desk();
    let said = desk.grafcet(&[
        "check",
        "--format",
        "json",
        "refused.grafcet",
        "warned.grafcet",
    ]);
    assert_eq!(said.code, Some(1));
    let rules: Vec<String> = said
        .out
        .lines()
        .map(|line| {
            let object: serde_json::Value = serde_json::from_str(line).unwrap();
            for key in ["level", "message", "file", "line", "column", "end", "help"] {
                assert!(object.get(key).is_some(), "{key} in {line}");
            }
            object["rule"].as_str().unwrap().to_owned()
        })
        .collect();
    assert_eq!(rules, ["unknown-name", "unused"]);
}

/// Two levels in one program: what the text of step 2 uses is known to people only.
const DRAFT: &str = "\
input start, part
output DRILL
graph Draft {
    initial step 1
    step 2 { \"drill the part\" }
    step 3 { DRILL }
    transition 1: 1 -> 2 when ↑start
    transition 2: 2 -> 3 when \"the part is there\"
    transition 3: 3 -> 1
}
";

#[test]
fn texts_alone_are_refused_where_something_runs_and_accepted_in_a_drawing() {
    let desk = Desk::with(&[("draft.grafcet", DRAFT)]);
    let said = desk.grafcet(&["check", "draft.grafcet"]);
    assert_eq!(said.code, Some(1), "{said:?}");
    assert_eq!(said.out.matches("error[level-1-only]: ").count(), 2);
    let said = desk.grafcet(&["check", "--drawing", "--deny", "warnings", "draft.grafcet"]);
    assert_eq!((said.code, said.out.as_str()), (Some(0), ""), "{said:?}");
    let said = desk.grafcet(&["test", "draft.grafcet"]);
    assert_eq!(said.code, Some(1), "{said:?}");
}

#[test]
fn what_is_wrong_beside_the_texts_is_refused_in_a_drawing_too() {
    let desk = Desk::with(&[("draft.grafcet", &DRAFT.replace("3 -> 1", "3 -> 4"))]);
    let said = desk.grafcet(&["check", "--drawing", "draft.grafcet"]);
    assert_eq!(said.code, Some(1), "{said:?}");
    assert!(said.out.starts_with("error[unknown-step]: "), "{said:?}");
    assert!(!said.out.contains("level-1-only"), "{said:?}");
}

#[test]
fn a_drawing_without_texts_is_checked_whole() {
    let said = desk().grafcet(&["check", "--drawing", "warned.grafcet"]);
    assert!(said.out.starts_with("warning[unused]: "), "{said:?}");
}
