//! `grafcet check`.

use crate::desk::desk;

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
