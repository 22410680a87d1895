//! What a person at a terminal gets from `grafcet`: output, errors and exit codes.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

const DRILL: &str = "\
application drill
input  start, up, down
output SPIN, RAISE
parameter delay : time = 20 ms in 10 ms .. 1 s
input level : int at %IW0 in 0 .. 100
var high : int = 0
output TALL
graph Drill {
    always { high = level; TALL IF high > 99 }
    initial step 1 { RAISE IF NOT up }
    step 2 { SPIN }
    transition 1: 1 -> 2 when ↑start
    transition 2: 2 -> 1 when T/X2/delay OR down
}
plant Mast { always { up IF RAISE } }
test \"it spins and stops\" {
    pulse start for 10 ms
    expect SPIN
    wait 20 ms
    expect NOT SPIN
}
test \"it never spins\" {
    never SPIN
    pulse start for 10 ms
}
";

const REFUSED: &str = "graph G {\n    initial step 1 { M }\n}\n";

const WARNED: &str = "input a\ngraph G { initial step 1 }\n";

/// A directory with files in it, where `grafcet` runs.
struct Desk(TempDir);

impl Desk {
    fn with(files: &[(&str, &str)]) -> Self {
        let desk = Desk(tempfile::tempdir().unwrap());
        for (name, text) in files {
            fs::write(desk.path(name), text).unwrap();
        }
        desk
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_grafcet"));
        command.args(arguments).current_dir(self.0.path());
        command
    }

    fn grafcet(&self, arguments: &[&str]) -> Said {
        let output = self.command(arguments).output().unwrap();
        Said::from(output)
    }
}

/// What a run said.
#[derive(Debug)]
struct Said {
    code: Option<i32>,
    out: String,
    err: String,
}

impl From<Output> for Said {
    fn from(output: Output) -> Self {
        Said {
            code: output.status.code(),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        }
    }
}

/// The one line on standard error of a run that could not do its work.
#[track_caller]
fn one_line(said: &Said) -> &str {
    assert_eq!(said.code, Some(2), "{said:?}");
    assert_eq!(said.err.lines().count(), 1, "{said:?}");
    said.err.trim_end()
}

fn desk() -> Desk {
    Desk::with(&[
        ("drill.grafcet", DRILL),
        ("refused.grafcet", REFUSED),
        ("warned.grafcet", WARNED),
    ])
}

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

#[test]
fn a_missing_file_gets_one_line_and_the_others_are_checked() {
    let desk = desk();
    let said = desk.grafcet(&["check", "nowhere.grafcet"]);
    assert_eq!(said.code, Some(2));
    assert!(
        said.err.contains("error: nowhere.grafcet: no such file\n"),
        "{said:?}"
    );
    let said = desk.grafcet(&["check", "nowhere.grafcet", "refused.grafcet"]);
    assert_eq!(said.code, Some(2));
    assert!(said.out.contains("error[unknown-name]"), "{said:?}");
    for arguments in [
        &["trace", "nowhere.grafcet", "--until", "0"][..],
        &["test", "nowhere.grafcet"],
        &["symbols", "nowhere.grafcet"],
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
fn a_trace_is_csv_of_every_scan() {
    let desk = desk();
    fs::write(
        desk.path("s.csv"),
        "time_ms,start,level\n0,0,7\n10,1,\n40,,150\n",
    )
    .unwrap();
    let said = desk.grafcet(&["trace", "drill.grafcet", "--stimulus", "s.csv"]);
    assert_eq!(said.code, Some(0), "{said:?}");
    let expected = "\
time_ms,Drill,SPIN,RAISE,TALL,delay,high
0,1,0,1,0,20,7
10,2,1,0,0,20,7
20,2,1,0,0,20,7
30,1,0,1,0,20,7
40,1,0,1,1,20,100
";
    let said_again = desk.grafcet(&[
        "trace",
        "drill.grafcet",
        "--stimulus",
        "s.csv",
        "-o",
        "t.csv",
    ]);
    assert_eq!(said.out, expected);
    assert_eq!(said_again.out, "");
    assert_eq!(fs::read_to_string(desk.path("t.csv")).unwrap(), expected);
}

#[test]
fn a_trace_ends_at_until_and_runs_the_plants_it_is_told_to() {
    let desk = desk();
    let said = desk.grafcet(&["trace", "drill.grafcet", "--until", "25", "--with", "Mast"]);
    let expected = "\
time_ms,Drill,SPIN,RAISE,TALL,delay,high
0,1,0,1,0,20,0
10,1,0,0,0,20,0
20,1,0,1,0,20,0
";
    assert_eq!(said.out, expected, "{said:?}");
    let said = desk.grafcet(&["trace", "drill.grafcet", "--until", "0", "--with", "Nobody"]);
    assert_eq!(
        one_line(&said),
        "error: no plant is called `Nobody`; there is Mast"
    );
}

#[test]
fn a_bad_stimulus_gets_one_line_with_its_place() {
    let desk = desk();
    for (stimulus, line) in [
        ("", "s.csv:1: the first column has to be `time_ms`"),
        (
            "time,start\n",
            "s.csv:1: the first column has to be `time_ms`",
        ),
        (
            "time_ms,strat\n",
            "s.csv:1: no input or parameter is called `strat`; is `start` meant?",
        ),
        (
            "time_ms,SPIN\n",
            "s.csv:1: `SPIN` is an output; a stimulus gives inputs and parameters",
        ),
        (
            "time_ms,up,up\n",
            "s.csv:1: the column `up` stands twice in the header",
        ),
        (
            "time_ms,up\n0,1\n5,2\n",
            "s.csv:3: `2` is no value for the Boolean `up`: 0 or 1",
        ),
        (
            "time_ms,level\n0,high\n",
            "s.csv:2: `high` is no value for the number `level`: a whole number of 32 bits",
        ),
        (
            "time_ms,level\n0,99999999999\n",
            "s.csv:2: `99999999999` is no value for the number `level`: a whole number of 32 bits",
        ),
        (
            "time_ms,up\n10,1\n5,0\n",
            "s.csv:3: times have to ascend: 5 ms stands below 10 ms",
        ),
        (
            "time_ms,up\n,1\n",
            "s.csv:2: `` is no time: whole milliseconds from 0 on",
        ),
        (
            "time_ms,up\n-1,1\n",
            "s.csv:2: `-1` is no time: whole milliseconds from 0 on",
        ),
        (
            "time_ms,up\n0,1,1\n",
            "s.csv:2: a row of 3 cells under a header of 2",
        ),
    ] {
        fs::write(desk.path("s.csv"), stimulus).unwrap();
        let said = desk.grafcet(&["trace", "drill.grafcet", "--stimulus", "s.csv"]);
        assert_eq!(one_line(&said), format!("error: {line}"), "{stimulus:?}");
        assert_eq!(said.out, "");
    }
    fs::write(desk.path("s.csv"), b"time_ms,up\n0,\xff\n").unwrap();
    let said = desk.grafcet(&["trace", "drill.grafcet", "--stimulus", "s.csv"]);
    assert_eq!(one_line(&said), "error: s.csv:2: the text is not UTF-8");
    let said = desk.grafcet(&["trace", "drill.grafcet", "--stimulus", "none.csv"]);
    assert_eq!(one_line(&said), "error: none.csv: no such file");
}

#[test]
fn a_refused_program_gives_no_output() {
    let desk = desk();
    for arguments in [
        &["trace", "refused.grafcet", "--until", "0", "-o", "out.csv"][..],
        &["test", "refused.grafcet"],
        &["symbols", "refused.grafcet"],
    ] {
        let said = desk.grafcet(arguments);
        assert_eq!(said.code, Some(1), "{said:?}");
        assert_eq!(said.out, "");
        assert!(said.err.starts_with("error[unknown-name]: "), "{said:?}");
    }
    assert!(!desk.path("out.csv").exists());
}

#[test]
fn tests_are_reported_like_cargos() {
    let desk = desk();
    let said = desk.grafcet(&["test", "drill.grafcet"]);
    assert_eq!(said.code, Some(1), "{said:?}");
    assert!(said.out.starts_with("running 2 tests\n"), "{said:?}");
    assert!(
        said.out
            .contains("test drill.grafcet: it spins and stops ... ok\n"),
        "{said:?}"
    );
    assert!(
        said.out
            .contains("test drill.grafcet: it never spins ... FAILED\n"),
        "{said:?}"
    );
    assert!(
        said.out.contains("error[never]: this holds at 10 ms"),
        "{said:?}"
    );
    assert!(said.out.contains("drill.grafcet:23:"), "the line: {said:?}");
    assert!(
        said.out.contains("at 10 ms: SPIN = 1\n"),
        "the values: {said:?}"
    );
    assert!(
        said.out
            .contains("time_ms  Drill  SPIN\n0        1      0\n10       2      1\n"),
        "{said:?}"
    );
    assert!(said.out.ends_with("\n1 passed, 1 failed\n"), "{said:?}");
}

#[test]
fn a_filter_chooses_tests_by_their_names() {
    let desk = desk();
    let said = desk.grafcet(&["test", "drill.grafcet", "spins and"]);
    assert_eq!(said.code, Some(0), "{said:?}");
    assert!(
        said.out.ends_with("\n1 passed, 0 failed, 1 filtered out\n"),
        "{said:?}"
    );
}

#[test]
fn a_test_leaves_its_trace_where_it_is_told_to() {
    let desk = desk();
    let said = desk.grafcet(&["test", "drill.grafcet", "stops", "--trace", "traces"]);
    assert_eq!(said.code, Some(0), "{said:?}");
    let trace = fs::read_to_string(desk.path("traces/drill.01.it_spins_and_stops.csv")).unwrap();
    let expected = "\
time_ms,Drill,SPIN,RAISE,TALL,delay,high
0,1,0,1,0,20,0
10,2,1,0,0,20,0
20,2,1,0,0,20,0
30,1,0,1,0,20,0
";
    assert_eq!(trace, expected);
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
    for command in ["check", "trace", "test", "symbols"] {
        let said = desk.grafcet(&[command, "--help"]);
        assert_eq!(said.code, Some(0));
        assert!(said.out.contains("Example"), "{said:?}");
    }
}

#[test]
fn a_reader_that_leaves_early_is_no_failure() {
    let desk = desk();
    let mut child = desk
        .command(&["trace", "drill.grafcet", "--until", "1000000"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let said = Said::from(child.wait_with_output().unwrap());
    assert_eq!(said.code, Some(0), "{said:?}");
    assert_eq!(said.err, "");
}
