//! What a scan does, counted by kind, and what each kind costs on a processor.

use std::ops::{Add, AddAssign, Mul};

/// A processor that images are built for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cpu {
    /// Cortex-M0+, as in the Pico.
    M0plus,
    /// Cortex-M4.
    M4,
}

impl Cpu {
    /// All of them.
    pub const ALL: [Cpu; 2] = [Cpu::M0plus, Cpu::M4];

    /// What it is called.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Cpu::M0plus => "Cortex-M0+",
            Cpu::M4 => "Cortex-M4",
        }
    }

    /// What it is called where file names end.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Cpu::M0plus => "m0plus",
            Cpu::M4 => "m4",
        }
    }
}

/// The kinds, each with tenths of an instruction on the Cortex-M0+ and on the Cortex-M4 that one takes at most.
/// `docs/src/speed.md` says how they were found.
macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident $m0plus:literal $m4:literal)*) => {
        /// What a scan does. The kinds whose names end in `Looped` are for rows that the compiler does not know one by
        /// one: behind the fourth of a run, of a large program, or of what there is more of than one.
        #[allow(missing_docs, reason = "those that end in `Looped` are documented here")]
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Kind { $($(#[$doc])* $kind),* }

        impl Kind {
            /// All of them.
            pub const ALL: &'static [Kind] = &[$(Kind::$kind),*];

            /// Tenths of an instruction.
            const fn cost(self, cpu: Cpu) -> u64 {
                let (m0plus, m4) = match self { $(Kind::$kind => ($m0plus, $m4)),* };
                match cpu {
                    Cpu::M0plus => m0plus,
                    Cpu::M4 => m4,
                }
            }
        }
    };
}

kinds! {
    /// The scan itself.
    Scan 900 700
    /// Outputs that are neighbours are collected.
    Lane 60 50
    /// A round of a program that evolves `stable`.
    Round 400 300
    /// A word of situations is looked at on one of the walks over steps.
    Word 80 60
    /// Steps that sleep are passed over, four at a time.
    Sleepers 25 20
    /// A step that is active, or was, is visited on one of the walks.
    Visit 80 60
    /// A transition is looked at.
    Arm 90 70
    ArmLooped 300 250
    /// A masked word is compared.
    Term 90 70
    TermLooped 150 120
    /// A timer on a step is looked at.
    Timer 300 250
    TimerLooped 400 350
    /// An operation on Booleans.
    Logic 60 50
    LogicLooped 200 150
    /// A piece of code on numbers.
    Code 150 100
    /// An operation of it.
    Operation 150 120
    OperationLooped 550 440
    /// A multiplication or division, beside that.
    Product 2500 100
    /// A transition fires.
    Fire 250 200
    FireLooped 600 480
    /// A step of a large graph is left or entered.
    Link 250 200
    /// A word of transitions is cleared, where there are several.
    Marks 40 30
    /// A word of transitions is searched for those that have fired.
    Search 120 90
    /// A momentary statement.
    Momentary 60 50
    MomentaryLooped 150 120
    /// A word of its variables.
    Target 60 50
    TargetLooped 120 100
    /// A statement that depends on momentary variables.
    Dependent 200 160
    /// A word of momentary variables is cleared and compared, where there are several.
    Shown 200 150
    /// A stored statement.
    Stored 200 160
    /// It stores a Boolean.
    Bit 200 160
    /// It stores a number.
    Number 300 250
    /// An event is looked at.
    Event 150 120
    /// The time of an activation is noted.
    Stamp 100 80
    /// A word of inputs is searched for edges.
    Edges 200 150
    /// An edge with a memory of its own.
    Edge 250 200
    EdgeLooped 350 300
    /// A timer with a memory of its own.
    Delay 500 400
    DelayLooped 700 600
    /// A Boolean that is worked out in every scan.
    Value 200 150
    ValueLooped 300 250
    /// A macro step.
    Macro 250 200
    /// A step of its expansion.
    Inner 120 100
    /// A graph takes its place in the hierarchy.
    Graph 600 480
    GraphLooped 900 720
    /// A word of its situation is ordered through.
    Ordered 200 150
    /// An order.
    Order 300 240
    OrderLooped 900 720
    /// A step that encloses a graph.
    Enclosing 300 250
    /// A word of a situation is given.
    Given 150 120
    /// A word of situations is passed on the walks of a large program.
    WordLooped 200 150
    /// A word of the sets of words of a large program.
    Sets 200 150
    /// A step is visited in a large program.
    VisitLooped 250 200
}

/// How often what is done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Work([u64; Kind::ALL.len()]);

impl Work {
    /// Nothing.
    pub const NONE: Work = Work([0; Kind::ALL.len()]);

    /// So many of a kind.
    #[must_use]
    pub fn of(kind: Kind, count: usize) -> Self {
        let mut work = Work::NONE;
        if let Some(place) = work.0.get_mut(kind as usize) {
            *place = count as u64;
        }
        work
    }

    /// One of a kind.
    #[must_use]
    pub fn one(kind: Kind) -> Self {
        Work::of(kind, 1)
    }

    /// The kinds that occur, with how often.
    pub fn counts(&self) -> impl Iterator<Item = (Kind, u64)> + '_ {
        let counts = Kind::ALL.iter().copied().zip(self.0);
        counts.filter(|(_, count)| *count > 0)
    }

    /// Tenths of an instruction that it takes at most.
    #[must_use]
    pub fn tenths(&self, cpu: Cpu) -> u64 {
        self.counts()
            .map(|(kind, count)| count * kind.cost(cpu))
            .sum()
    }

    /// Instructions that it takes at most.
    #[must_use]
    pub fn instructions(&self, cpu: Cpu) -> u64 {
        self.tenths(cpu).div_ceil(10)
    }

    /// The one that takes more.
    #[must_use]
    pub fn or(self, other: Work, cpu: Cpu) -> Work {
        match other.tenths(cpu) > self.tenths(cpu) {
            true => other,
            false => self,
        }
    }
}

impl AddAssign for Work {
    fn add_assign(&mut self, other: Work) {
        for (count, more) in self.0.iter_mut().zip(other.0) {
            *count += more;
        }
    }
}

impl Add for Work {
    type Output = Work;

    fn add(mut self, other: Work) -> Work {
        self += other;
        self
    }
}

impl Mul<u64> for Work {
    type Output = Work;

    fn mul(mut self, times: u64) -> Work {
        for count in &mut self.0 {
            *count *= times;
        }
        self
    }
}

impl std::iter::Sum for Work {
    fn sum<I: Iterator<Item = Work>>(works: I) -> Work {
        works.fold(Work::NONE, Add::add)
    }
}
