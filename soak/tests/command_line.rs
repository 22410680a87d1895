//! `soak`, as scripts and the tests in the emulator call it.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

use std::process::{Command, Output};

fn soak(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_soak"));
    command.args(arguments).output().expect("it runs")
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).expect("it is text")
}

#[test]
fn a_run_says_how_long_it_was_and_that_both_agree() {
    let output = soak(&["days", "0.0002", "drilling_station", "--seed", "3"]);
    let said = text(&output.stdout);
    assert!(output.status.success(), "{said}");
    assert!(
        said.starts_with("drilling_station: 0.0002 days, 1728 scans ("),
        "{said}"
    );
    assert!(said.contains("both interpreters agree"), "{said}");
    assert!(!said.contains('\x1b'), "{said}");
    assert_eq!(text(&output.stderr), "");
}

#[test]
fn what_is_no_duration_is_wrong_usage() {
    for long in ["0", "-1", "soon", "1e9", "NaN"] {
        let output = soak(&["years", "--", long]);
        assert_eq!(output.status.code(), Some(2), "{long}");
        assert!(text(&output.stderr).contains("a number above 0"), "{long}");
    }
}

#[test]
fn a_delay_of_what_the_plant_writes_is_refused() {
    let output = soak(&["play", "line_switcher", "--scans", "5", "--delay", "VL1=2"]);
    assert_eq!(output.status.code(), Some(1));
    let said = text(&output.stderr);
    assert_eq!(said, "error: no operator gives an input called VL1\n");
}

#[test]
fn an_input_that_a_filter_delays_is_wired_before_it_is_seen() {
    let play = |delay: &str| {
        let arguments = ["play", "drilling_station", "--scans", "1500", "--delay"];
        let output = soak(&[&arguments[..], &[delay]].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stdout).to_owned()
    };
    // The first press of start, at the first of the levels, and the scan that leaves step 1 for it.
    let first = |out: &str| {
        let rows: Vec<&str> = out.lines().skip(1).collect();
        let pressed = rows.iter().position(|row| row.starts_with('1'));
        let seen = rows
            .iter()
            .position(|row| row.split(',').nth(1) == Some("2"));
        (pressed.expect("it is pressed"), seen.expect("it is seen"))
    };
    let (at_once, delayed) = (play("start=0"), play("start=2"));
    assert!(at_once.starts_with("start,stop,closed,up1,down1,up2,down2 time_ms,Graph8,"));
    assert_eq!(at_once.lines().count(), 1501);
    let (pressed, seen) = first(&at_once);
    assert_eq!(seen, pressed);
    assert_eq!(first(&delayed), (pressed, pressed + 2));
}
