//! `grafcet trace`.

use std::fs;
use std::process::Stdio;

use crate::desk::{Said, desk, one_line};

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
            "time_ms,heat\n",
            "s.csv:1: no input or parameter is called `heat`; is `Drill:heat` meant?",
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
