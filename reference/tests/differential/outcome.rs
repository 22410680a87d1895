//! What comes out of a comparison.

use std::fmt;

/// What a comparison has come upon.
#[derive(Debug)]
pub enum Failure {
    /// The compiler refuses the program.
    Refused(String),
    /// The headers differ.
    Header {
        engine: Vec<String>,
        reference: Vec<String>,
    },
    /// The rows differ, for the first time in this scan.
    Row {
        scan: usize,
        differences: Vec<String>,
    },
    /// The engine leaves something else when it keeps sets of words, for the first time in this scan.
    Walks { scan: usize },
    /// A scan has taken more rounds than the program is said to take at most.
    Rounds { scan: usize, took: u32, bound: u32 },
    /// One of both takes a stored value that the other refuses.
    Restored(String),
    /// The tool's trace differs.
    Tool(String),
    /// One of both has panicked.
    Panic(String),
}

impl Failure {
    /// Whether another failure is of the same kind, so that shrinking stays with one fault.
    pub fn is_like(&self, other: &Failure) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Refused(diagnostics) => write!(f, "the compiler refuses it:\n{diagnostics}"),
            Failure::Header { engine, reference } => {
                write!(f, "the headers differ:\n{engine:?}\n{reference:?}")
            }
            Failure::Row { scan, differences } => {
                write!(
                    f,
                    "scan {scan} differs (engine, reference): {}",
                    differences.join("; ")
                )
            }
            Failure::Walks { scan } => {
                write!(f, "scan {scan} differs with and without sets of words")
            }
            Failure::Rounds { scan, took, bound } => {
                write!(
                    f,
                    "scan {scan} takes {took} rounds, {bound} are stated as the most"
                )
            }
            Failure::Restored(name) => {
                write!(f, "the stored value of `{name}` is taken by one only")
            }
            Failure::Tool(what) => write!(f, "through the tool, in CSV: {what}"),
            Failure::Panic(message) => write!(f, "a panic: {message}"),
        }
    }
}

/// What was seen of the engine at work.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    pub programs: usize,
    pub scans: usize,
    pub transitions: usize,
    /// Transitions that fired at least once.
    pub fired: usize,
    pub steps: usize,
    /// Steps that were active after a scan at least once.
    pub active: usize,
    /// Scans times graphs under a forcing order.
    pub forced: usize,
    /// Scans that did not settle.
    pub unstable: usize,
    /// Scans in which the engine knew that nothing was new.
    pub idle: usize,
    /// Programs of which it is known how soon their rounds end.
    pub settles: usize,
    /// Those of them in which a scan took as many rounds as are stated as the most.
    pub longest: usize,
    /// Programs in which a calculation went wrong.
    pub with_faults: usize,
}

impl Tally {
    pub fn add(&mut self, other: Tally) {
        self.programs += other.programs;
        self.scans += other.scans;
        self.transitions += other.transitions;
        self.fired += other.fired;
        self.steps += other.steps;
        self.active += other.active;
        self.forced += other.forced;
        self.unstable += other.unstable;
        self.idle += other.idle;
        self.settles += other.settles;
        self.longest += other.longest;
        self.with_faults += other.with_faults;
    }
}
