//! What a scan does, counted by kind, and what each kind costs on a processor.

use std::ops::{Add, AddAssign, Mul};

/// A processor that images are built for, and how.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cpu {
    /// Cortex-M0+, compiled as for the image of the Pico.
    M0plusFlashed,
    /// Cortex-M0+, optimised for speed.
    M0plus,
    /// Cortex-M4, optimised for speed.
    M4,
}

impl Cpu {
    /// All of them.
    pub const ALL: [Cpu; 3] = [Cpu::M0plusFlashed, Cpu::M0plus, Cpu::M4];

    /// What it is called.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Cpu::M0plusFlashed => "Cortex-M0+ flashed",
            Cpu::M0plus => "Cortex-M0+",
            Cpu::M4 => "Cortex-M4",
        }
    }

    /// What it is called where file names end.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Cpu::M0plusFlashed => "m0plus_flashed",
            Cpu::M0plus => "m0plus",
            Cpu::M4 => "m4",
        }
    }
}

/// The kinds, each with tenths of an instruction that one takes at most, in the order of [`Cpu::ALL`].
/// `docs/src/speed.md` says how they were found.
macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident $small:literal $m0plus:literal $m4:literal)*) => {
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
                let (small, m0plus, m4) = match self { $(Kind::$kind => ($small, $m0plus, $m4)),* };
                match cpu {
                    Cpu::M0plusFlashed => small,
                    Cpu::M0plus => m0plus,
                    Cpu::M4 => m4,
                }
            }
        }
    };
}

kinds! {
    /// The scan itself.
    Scan 282 388 302
    /// Outputs that are neighbours are collected.
    Lane 36 36 88
    /// A round of a program that evolves `stable`.
    Round 46 171 210
    /// A word of situations is looked at on one of the walks over steps.
    Word 16 11 22
    /// Steps that sleep are passed over, four at a time.
    Sleepers 88 39 48
    /// A step that is active, or was, is visited on one of the walks.
    Visit 18 3 2
    /// The same in a program that evolves `stable`.
    VisitInRounds 73 114 106
    /// A transition is looked at.
    Arm 14 33 12
    ArmLooped 1206 853 639
    /// A masked word is compared.
    Term 8 26 3
    TermLooped 27 17 18
    /// A timer on a step is looked at, one that is asked for only while the step is active.
    OwnTimer 62 171 194
    OwnTimerLooped 226 342 356
    /// Any other.
    Timer 60 139 150
    TimerLooped 134 134 100
    /// An operation on Booleans.
    Logic 29 5 2
    LogicLooped 340 292 188
    /// One behind the fourth of a condition of which the others are known.
    LogicBehind 61 80 36
    /// A piece of code on numbers.
    Code 61 245 147
    /// An operation of it.
    Operation 13 8 4
    OperationLooped 919 867 622
    /// A multiplication or division, beside that.
    Product 41 41 34
    /// A transition fires.
    Fire 17 19 3
    FireLooped 700 81 526
    /// A step of a large graph is left or entered.
    Link 1714 1261 1034
    /// A word of transitions is cleared, where there are several.
    Marks 140 140 113
    /// A word of transitions is searched for those that have fired.
    Search 204 75 44
    /// A momentary statement.
    Momentary 123 61 15
    MomentaryLooped 318 150 120
    /// A word of its variables.
    Target 14 27 78
    TargetLooped 250 120 45
    /// A statement that depends on momentary variables.
    Dependent 331 635 108
    /// A word of momentary variables is cleared and compared, where there are several.
    Shown 200 200 150
    /// A stored statement.
    Stored 10 10 8
    StoredLooped 30 30 24
    /// It stores a Boolean.
    Bit 14 14 12
    BitLooped 551 705 540
    /// It stores a number.
    Number 23 23 18
    NumberLooped 35 38 30
    /// An event is looked at.
    Event 150 150 120
    /// The time of an activation is noted.
    Stamp 15 15 9
    /// A word of inputs is searched for edges.
    Edges 194 145 49
    /// An edge with a memory of its own.
    Edge 245 140 191
    EdgeLooped 75 75 60
    /// A timer with a memory of its own.
    Delay 1330 839 1502
    DelayLooped 512 1124 432
    /// A Boolean that is worked out in every scan.
    Value 200 200 150
    ValueLooped 300 300 250
    /// A macro step.
    Macro 84 110 90
    /// A step of its expansion.
    Inner 26 26 15
    /// A graph takes its place in the hierarchy.
    Graph 123 106 131
    GraphLooped 2658 2179 1681
    /// A word of its situation is ordered through.
    Ordered 75 157 36
    /// An order.
    Order 84 84 141
    OrderLooped 13 38 108
    /// A step that encloses a graph.
    Enclosing 300 300 250
    /// A word of a situation is given.
    Given 12 38 62
    /// A word of situations is passed on the walks of a large program.
    WordLooped 89 83 168
    /// A word of the sets of words of a large program.
    Sets 200 200 160
    /// A step is visited in a large program.
    VisitLooped 812 1111 662
    /// In a word of a large program it is known what is armed, and one Boolean says whether it fires.
    Followed 200 130 100
    /// There it takes more than a Boolean.
    FollowedCloser 959 818 484
    /// A transition fires there.
    FollowedFire 874 230 205
    /// It is known of a word that nothing is to be shown.
    FollowedPassed 200 180 201
    /// It is noted that it does.
    FollowedMark 450 450 400
    /// There is something to be shown.
    FollowedShown 452 398 221
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
