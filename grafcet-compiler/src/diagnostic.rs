//! What the compiler says about a program: a rule, a place, a sentence and, where there is one, the mend.

use crate::source::Span;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// The program is refused.
    Error,
    /// The program runs, but look here.
    Warning,
}

/// A set of rules with names: those of the language, [`Rule`], and those of other files that are shown the same way.
pub trait NamedRule: Copy + Ord {
    /// The rule's name as users see it, in `error[name]`.
    fn name(self) -> &'static str;
    /// Whether breaking the rule refuses the program.
    fn level(self) -> Level;
}

macro_rules! rules {
    ($($(#[$doc:meta])* $variant:ident $name:literal $level:ident;)*) => {
        /// The static rules of `language.md`, by their names there.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Rule { $($(#[$doc])* $variant,)* }

        impl Rule {
            /// Every rule.
            pub const ALL: &[Rule] = &[$(Rule::$variant,)*];

            /// The rule's name as users see it, in `error[name]`.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self { $(Rule::$variant => $name,)* }
            }

            /// Whether breaking the rule refuses the program.
            #[must_use]
            pub fn level(self) -> Level {
                match self { $(Rule::$variant => Level::$level,)* }
            }
        }

        impl NamedRule for Rule {
            fn name(self) -> &'static str {
                self.name()
            }

            fn level(self) -> Level {
                self.level()
            }
        }
    };
}

rules! {
    /// The text does not fit the grammar.
    Syntax "syntax" Error;
    /// Nothing by that name.
    UnknownName "unknown-name" Error;
    /// No graph by that name.
    UnknownGraph "unknown-graph" Error;
    /// No step by that identifier.
    UnknownStep "unknown-step" Error;
    /// A name declared twice in one scope.
    DuplicateName "duplicate-name" Error;
    /// A step declared twice in one graph.
    DuplicateStep "duplicate-step" Error;
    /// A transition number used twice in one graph.
    DuplicateTransition "duplicate-transition" Error;
    /// A reserved word as a name.
    ReservedWord "reserved-word" Error;
    /// An operator, trigger, condition, preset, range or assignment of the wrong type.
    TypeMismatch "type-mismatch" Error;
    /// A number, duration or step identifier that cannot be read.
    BadLiteral "bad-literal" Error;
    /// An action writes an input.
    WriteToInput "write-to-input" Error;
    /// An action writes a step bit.
    WriteToStepBit "write-to-step-bit" Error;
    /// An action writes a constant, a parameter or a `System:` name.
    WriteToConstant "write-to-constant" Error;
    /// One variable is the object of both kinds of action.
    MomentaryAndStored "momentary-and-stored" Error;
    /// A momentary action on a number.
    MomentaryNumber "momentary-number" Error;
    /// Momentary actions depend on each other in a ring.
    CausalityLoop "causality-loop" Error;
    /// Graphs force or enclose each other in a ring.
    ForcingCycle "forcing-cycle" Error;
    /// A step forces its own graph.
    SelfForcing "self-forcing" Error;
    /// A graph is both enclosed and forced.
    HierarchyConflict "hierarchy-conflict" Warning;
    /// Two orders with different situations can be valid on one graph at once.
    ForcingConflict "forcing-conflict" Warning;
    /// A graph is enclosed by two steps that can be active together.
    EnclosedTwice "enclosed-twice" Warning;
    /// Not an address, or of the wrong width for the type.
    BadAddress "bad-address" Error;
    /// An output at `%I`, an input at `%Q`, a variable at either.
    AddressDirection "address-direction" Error;
    /// Two declarations at one address.
    DuplicateAddress "duplicate-address" Error;
    /// A constant that its type or declared range cannot hold.
    OutOfRange "out-of-range" Error;
    /// A macro step of the wrong shape.
    MacroShape "macro-shape" Error;
    /// An initial value on a variable that is the object of momentary actions.
    MomentaryInitial "momentary-initial" Error;
    /// An input or output without an address, in a firmware build.
    NoAddress "no-address" Error;
    /// An interface name unbound, bound twice or unknown.
    TemplateBinding "template-binding" Error;
    /// A block or trigger that consists only of text.
    Level1Only "level-1-only" Error;
    /// No evolution, forcing or enclosing can activate the step.
    UnreachableStep "unreachable-step" Warning;
    /// A trigger that is constant False.
    NeverFires "never-fires" Warning;
    /// A trigger that is constant True without being written so.
    AlwaysFires "always-fires" Warning;
    /// A ring of transitions whose triggers can all be true at once.
    UnstableLoop "unstable-loop" Warning;
    /// An OR divergence whose triggers can be true together.
    NotExclusive "not-exclusive" Warning;
    /// Statements that can run in the same scan store different values in one variable.
    WriteRace "write-race" Warning;
    /// `on event` with an expression that contains no edge.
    EventWithoutEdge "event-without-edge" Error;
    /// An input no one reads; a variable, parameter or constant no one reads or writes.
    Unused "unused" Warning;
    /// An output no one writes, or a variable that is only read and has no initial value.
    NeverWritten "never-written" Warning;
    /// A variable that is only written.
    NeverRead "never-read" Warning;
    /// Two names that differ only in case.
    CaseOnly "case-only" Warning;
    /// A stored output that is only ever set True.
    NeverCleared "never-cleared" Warning;
    /// A constant preset below the scan period.
    ShortPreset "short-preset" Warning;
    /// Entrance steps that cannot be active together.
    NeverArmed "never-armed" Warning;
    /// An active step that can be entered again from a parallel branch.
    TokenLost "token-lost" Warning;
    /// An action in a step that can only be passed through.
    TransientAction "transient-action" Warning;
}

impl Rule {
    /// The rules that only a search through all runs decides. No check raises them yet; their silence proves nothing.
    pub const DECIDED: &[Rule] = &[
        Rule::ForcingConflict,
        Rule::EnclosedTwice,
        Rule::UnstableLoop,
        Rule::NotExclusive,
        Rule::WriteRace,
        Rule::NeverArmed,
        Rule::TokenLost,
        Rule::TransientAction,
    ];
}

/// A second place that a diagnostic shows, with what is to be seen there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// What is to be seen there, a lower-case phrase.
    pub message: String,
}

/// One thing the compiler has to say.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic<R = Rule> {
    /// The rule that is broken.
    pub rule: R,
    /// What is wrong, in the words of GRAFCET: a lower-case phrase.
    pub message: String,
    /// The place, underlined.
    pub span: Span,
    /// Further places, such as the first of two declarations.
    pub labels: Vec<Label>,
    /// The mend, where there is one obvious one.
    pub help: Option<String>,
}

impl<R: NamedRule> Diagnostic<R> {
    /// A diagnostic at one place, without a mend yet.
    pub fn new(rule: R, span: Span, message: impl Into<String>) -> Self {
        Diagnostic {
            rule,
            message: message.into(),
            span,
            labels: Vec::new(),
            help: None,
        }
    }

    /// Adds a second place.
    #[must_use]
    pub fn label(mut self, span: Span, message: impl Into<String>) -> Self {
        self.labels.push(Label {
            span,
            message: message.into(),
        });
        self
    }

    /// Says how to mend it.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Error or warning.
    #[must_use]
    pub fn level(&self) -> Level {
        self.rule.level()
    }
}
