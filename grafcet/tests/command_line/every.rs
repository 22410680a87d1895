//! What all commands have in common, and `grafcet symbols`.

use std::fs;

use crate::desk::{desk, one_line};

#[test]
fn a_missing_file_gets_one_line_and_the_others_are_checked() {
    let desk = desk();
    let said = desk.grafcet(&["check", "nowhere.grafcet", "refused.grafcet"]);
    assert_eq!(said.code, Some(2));
    assert!(said.out.contains("error[unknown-name]"), "{said:?}");
    assert_eq!(
        said.err,
        "1 error, 0 warnings\nerror: nowhere.grafcet: no such file\n"
    );
    for arguments in [
        &["check", "nowhere.grafcet"][..],
        &["trace", "nowhere.grafcet", "--until", "0"],
        &["test", "nowhere.grafcet"],
        &["symbols", "nowhere.grafcet"],
        &["bound", "nowhere.grafcet"],
        &["fmt", "nowhere.grafcet"],
    ] {
        let said = desk.grafcet(arguments);
        assert_eq!(one_line(&said), "error: nowhere.grafcet: no such file");
    }
}

#[test]
fn a_file_that_is_no_text_gets_one_line() {
    let desk = desk();
    fs::write(desk.path("image.grafcet"), [0xff, 0xfe, 0x00]).unwrap();
    let said = desk.grafcet(&["test", "image.grafcet"]);
    assert_eq!(one_line(&said), "error: image.grafcet: is not UTF-8 text");
}

#[test]
fn a_refused_program_gives_no_output() {
    let desk = desk();
    for arguments in [
        &["trace", "refused.grafcet", "--until", "0", "-o", "out.csv"][..],
        &["test", "refused.grafcet"],
        &["symbols", "refused.grafcet"],
        &["bound", "refused.grafcet"],
    ] {
        let said = desk.grafcet(arguments);
        assert_eq!(said.code, Some(1), "{said:?}");
        assert_eq!(said.out, "");
        assert!(said.err.starts_with("error[unknown-name]: "), "{said:?}");
    }
    assert!(!desk.path("out.csv").exists());
}

#[test]
fn symbols_tell_where_everything_lies() {
    let said = desk().grafcet(&["symbols", "drill.grafcet"]);
    assert_eq!(said.code, Some(0), "{said:?}");
    let symbols: serde_json::Value = serde_json::from_str(&said.out).unwrap();
    assert_eq!(symbols["application"], "drill");
    assert_eq!(symbols["period_ms"], 10);
    assert_eq!(symbols["graphs"][0]["name"], "Drill");
    assert_eq!(symbols["graphs"][0]["steps"][1]["id"], "2");
    assert!(symbols["graphs"][0]["steps"][1]["bit"].is_u64());
    assert_eq!(symbols["variables"]["start"]["kind"], "input");
    assert!(symbols["variables"]["start"]["bit"].is_u64());
    assert!(symbols["variables"]["delay"]["number"].is_u64());
    assert_eq!(symbols["variables"]["level"]["address"], "%IW0");
    assert_eq!(symbols["columns"][1], "Drill");
    assert!(symbols["layout"]["words"].is_u64());
}

#[test]
fn a_wrong_command_line_gives_2_and_help_gives_examples() {
    let desk = desk();
    for arguments in [
        &[][..],
        &["polish", "drill.grafcet"],
        &["check"],
        &["trace", "drill.grafcet"],
        &["check", "drill.grafcet", "--format", "xml"],
    ] {
        let said = desk.grafcet(arguments);
        assert_eq!(said.code, Some(2), "{arguments:?}: {said:?}");
    }
    for command in ["check", "fmt", "trace", "test", "symbols"] {
        let said = desk.grafcet(&[command, "--help"]);
        assert_eq!(said.code, Some(0));
        assert!(said.out.contains("Example"), "{said:?}");
    }
}
