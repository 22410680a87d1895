//! Programs, and a directory to run `grafcet` in.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

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
    input heat
    always { high = level; TALL IF heat; TALL IF high > 99 }
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
pub struct Desk(TempDir);

impl Desk {
    pub fn with(files: &[(&str, &str)]) -> Self {
        let desk = Desk(tempfile::tempdir().unwrap());
        for (name, text) in files {
            fs::write(desk.path(name), text).unwrap();
        }
        desk
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_grafcet"));
        command.args(arguments).current_dir(self.0.path());
        command
    }

    pub fn grafcet(&self, arguments: &[&str]) -> Said {
        let output = self.command(arguments).output().unwrap();
        Said::from(output)
    }
}

/// What a run said.
#[derive(Debug)]
pub struct Said {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
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
pub fn one_line(said: &Said) -> &str {
    assert_eq!(said.code, Some(2), "{said:?}");
    assert_eq!(said.err.lines().count(), 1, "{said:?}");
    said.err.trim_end()
}

/// A desk with one program of each kind: good, refused, warned of.
pub fn desk() -> Desk {
    Desk::with(&[
        ("drill.grafcet", DRILL),
        ("refused.grafcet", REFUSED),
        ("warned.grafcet", WARNED),
    ])
}
