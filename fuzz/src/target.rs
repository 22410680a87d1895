//! What is fuzzed.

use crate::mutation;
use crate::targets::{flash, graph, stimulus, wiring};

/// A parser of bytes from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// Graph text, through the compiler to the engine.
    Graph,
    /// `plc.toml`.
    Wiring,
    /// The stimulus CSV of `grafcet trace`.
    Stimulus,
    /// The pages of the retain store.
    Flash,
}

impl Target {
    /// All of them.
    pub const ALL: [Target; 4] = [
        Target::Graph,
        Target::Wiring,
        Target::Stimulus,
        Target::Flash,
    ];

    /// Its name on the command line and in the corpus.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Target::Graph => "graph",
            Target::Wiring => "wiring",
            Target::Stimulus => "stimulus",
            Target::Flash => "flash",
        }
    }

    /// The target by its name.
    #[must_use]
    pub fn named(name: &str) -> Option<Target> {
        Target::ALL.into_iter().find(|target| target.name() == name)
    }

    /// Gives the parser an input.
    ///
    /// # Panics
    /// When what must hold does not.
    pub fn run(self, input: &[u8]) {
        match self {
            Target::Graph => graph::run(input),
            Target::Wiring => wiring::run(input),
            Target::Stimulus => stimulus::run(input),
            Target::Flash => flash::run(input),
        }
    }

    /// Inputs that are as they should be, or nearly: what the repository itself contains.
    #[must_use]
    pub fn seeds(self) -> Vec<Vec<u8>> {
        match self {
            Target::Graph => graph::seeds(),
            Target::Wiring => wiring::seeds(),
            Target::Stimulus => stimulus::seeds(),
            Target::Flash => flash::seeds(),
        }
    }

    /// An input made of another one, with something of a third in it perhaps.
    #[must_use]
    pub fn mutated(self, input: &[u8], other: &[u8], random: &mut fastrand::Rng) -> Vec<u8> {
        match self {
            Target::Graph => mutation::of_text(input, other, graph::WORDS, random),
            Target::Wiring => mutation::of_text(input, other, wiring::WORDS, random),
            Target::Stimulus => mutation::of_text(input, other, stimulus::WORDS, random),
            Target::Flash => mutation::of_bytes(input, other, random),
        }
    }
}
