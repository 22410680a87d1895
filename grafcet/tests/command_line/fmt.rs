//! `grafcet fmt`.

use std::fs;
use std::io::Write;
use std::process::{Output, Stdio};

use crate::desk::{Desk, Said, desk, one_line};

const SKEWED: &str = "input a   at %IX0.0\n\n\n\noutput LAMP at %QX0.0 // lamp\ngraph G{\ninitial step 1{LAMP IF a}}\n";

const STRAIGHT: &str = "\
input  a at %IX0.0

output LAMP at %QX0.0  // lamp
graph G {
    initial step 1  { LAMP IF a }
}
";

const BROKEN: &str = "graph G {\n  initial step 1 { LAMP LAMP }\n}\nvar 1\n";

fn skewed() -> Desk {
    Desk::with(&[
        ("skewed.grafcet", SKEWED),
        ("straight.grafcet", STRAIGHT),
        ("broken.grafcet", BROKEN),
    ])
}

fn text(desk: &Desk, name: &str) -> String {
    fs::read_to_string(desk.path(name)).unwrap()
}

/// What `fmt` makes of standard input.
fn piped(arguments: &[&str], text: &str) -> Said {
    let desk = desk();
    let mut child = desk
        .command(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child
        .stdin
        .take()
        .unwrap()
        .write_all(text.as_bytes())
        .unwrap();
    let output: Output = child.wait_with_output().unwrap();
    Said::from(output)
}

#[test]
fn a_file_is_laid_out_in_place_without_a_word() {
    let desk = skewed();
    let said = desk.grafcet(&["fmt", "skewed.grafcet", "straight.grafcet"]);
    assert_eq!(
        (said.code, said.out.as_str(), said.err.as_str()),
        (Some(0), "", "")
    );
    assert_eq!(text(&desk, "skewed.grafcet"), STRAIGHT);
    assert_eq!(text(&desk, "straight.grafcet"), STRAIGHT);
    let left = fs::read_dir(desk.path("")).unwrap().count();
    assert_eq!(left, 3, "nothing else is left in the directory");
}

#[test]
fn a_file_that_is_right_is_not_written() {
    let desk = skewed();
    let written = || {
        fs::metadata(desk.path("straight.grafcet"))
            .unwrap()
            .modified()
            .unwrap()
    };
    let before = written();
    desk.grafcet(&["fmt", "straight.grafcet"]);
    assert_eq!(written(), before);
}

#[test]
fn check_writes_nothing_and_shows_what_would_change() {
    let desk = skewed();
    let said = desk.grafcet(&["fmt", "--check", "skewed.grafcet", "straight.grafcet"]);
    assert_eq!(said.code, Some(1), "{said:?}");
    assert!(
        said.out
            .starts_with("skewed.grafcet would change:\n@@ -1,7 +1,6 @@\n"),
        "{said:?}"
    );
    assert!(said.out.contains("\n-input a   at %IX0.0\n"), "{said:?}");
    assert!(said.out.contains("\n+input  a at %IX0.0\n"), "{said:?}");
    assert!(!said.out.contains("straight"), "{said:?}");
    assert_eq!(text(&desk, "skewed.grafcet"), SKEWED);
    let said = desk.grafcet(&["fmt", "--check", "straight.grafcet"]);
    assert_eq!((said.code, said.out.as_str()), (Some(0), ""));
}

#[test]
fn a_file_with_errors_of_syntax_is_left_as_it_is_and_the_others_are_laid_out() {
    let desk = skewed();
    for check in [&["fmt", "--check"][..], &["fmt"]] {
        let said = desk.grafcet(&[check, &["broken.grafcet", "skewed.grafcet"]].concat());
        assert_eq!(said.code, Some(1), "{said:?}");
        assert_eq!(said.err.matches("error[syntax]: ").count(), 2, "{said:?}");
        assert!(said.err.contains("broken.grafcet:2:25"), "{said:?}");
        assert_eq!(text(&desk, "broken.grafcet"), BROKEN);
    }
    assert_eq!(text(&desk, "skewed.grafcet"), STRAIGHT);
}

#[test]
fn what_is_wrong_beside_the_syntax_does_not_matter() {
    let desk = Desk::with(&[("unknown.grafcet", "graph G { step 1{M} }\n")]);
    let said = desk.grafcet(&["fmt", "unknown.grafcet"]);
    assert_eq!(said.code, Some(0), "{said:?}");
    assert_eq!(text(&desk, "unknown.grafcet"), "graph G { step 1 { M } }\n");
}

#[test]
fn standard_input_goes_to_standard_output() {
    let said = piped(&["fmt", "-"], SKEWED);
    assert_eq!(
        (said.code, said.out.as_str()),
        (Some(0), STRAIGHT),
        "{said:?}"
    );
    let said = piped(&["fmt", "-"], STRAIGHT);
    assert_eq!(
        (said.code, said.out.as_str()),
        (Some(0), STRAIGHT),
        "{said:?}"
    );
    let said = piped(&["fmt", "-", "--check"], SKEWED);
    assert_eq!(said.code, Some(1), "{said:?}");
    assert!(
        said.out.starts_with("<standard input> would change:\n"),
        "{said:?}"
    );
    let said = piped(&["fmt", "-"], BROKEN);
    assert_eq!((said.code, said.out.as_str()), (Some(1), ""), "{said:?}");
    assert!(said.err.contains("--> <standard input>:2:25"), "{said:?}");
}

#[test]
fn a_file_that_cannot_be_used_gets_one_line_and_the_others_are_laid_out() {
    let desk = skewed();
    let said = desk.grafcet(&["fmt", "nowhere.grafcet", "skewed.grafcet"]);
    assert_eq!(one_line(&said), "error: nowhere.grafcet: no such file");
    assert_eq!(text(&desk, "skewed.grafcet"), STRAIGHT);
}

#[cfg(unix)]
#[test]
fn permissions_and_links_stay() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let desk = skewed();
    let (file, link) = (desk.path("skewed.grafcet"), desk.path("link.grafcet"));
    fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
    symlink("skewed.grafcet", &link).unwrap();
    desk.grafcet(&["fmt", "link.grafcet"]);
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(text(&desk, "skewed.grafcet"), STRAIGHT);
    let mode = fs::metadata(&file).unwrap().permissions().mode();
    assert_eq!(mode & 0o777, 0o640);
}

#[test]
fn a_file_that_may_not_be_written_stays() {
    let desk = skewed();
    let path = desk.path("skewed.grafcet");
    let mut permissions = fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).unwrap();
    let said = desk.grafcet(&["fmt", "skewed.grafcet"]);
    assert_eq!(one_line(&said), "error: skewed.grafcet: permission denied");
    assert_eq!(text(&desk, "skewed.grafcet"), SKEWED);
}
