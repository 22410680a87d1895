//! What the layout has to know of a token.

/// How a token stands beside its neighbours on one line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// A space on both sides.
    Plain,
    /// Close to what follows: `(`, `¬`, a minus sign.
    Prefix,
    /// Close to what it follows: `)`, `,`, the colon behind a transition's number.
    Suffix,
    /// Close to both: the colon of `Graph:X3`, the slashes of a timer.
    Joint,
    /// Ends a statement.
    Semicolon,
    /// `{` of a block, which goes over several lines or stands on one.
    OpenBlock {
        /// Over several lines.
        long: bool,
    },
    /// `}` of a block.
    CloseBlock {
        /// Over several lines.
        long: bool,
    },
}

/// What kind of statement it is, as far as columns are concerned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Class {
    /// `input`, `output`.
    Terminal,
    /// `var`, `parameter`, `const`.
    Variable,
    /// A step, not a macro step.
    Step,
    /// A transition.
    Transition,
    /// A momentary statement.
    Momentary,
    /// A forcing order.
    Order,
    /// A binding of an instance.
    Binding,
    /// Anything else.
    Other,
}

/// What lines up with its like in the lines above and below. In this order on a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Column {
    /// The name that is declared: of an input below those of outputs.
    Name,
    /// The colon and type of a single name.
    Type,
    /// `at` of a declaration.
    At,
    /// The text of a step; only where the same words stand before `step`.
    StepText {
        /// The first of them.
        lead: u8,
    },
    /// The entrance steps of a transition.
    Entrance,
    /// `IF`.
    Condition,
    /// `at` or `=` of a binding.
    BoundTo,
    /// What ends the line: the text of a declaration, the block of a step.
    Last,
}

/// A token in its statement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mark {
    /// How it stands beside its neighbours.
    pub(super) role: Role,
    /// A statement begins with it.
    pub(super) begins: bool,
    /// Index of its statement in [`Marked::statements`].
    pub(super) statement: usize,
    /// It begins a column.
    pub(super) column: Option<Column>,
}

/// A statement or element.
#[derive(Clone, Copy, Debug)]
pub(super) struct Statement {
    /// Its kind.
    pub(super) class: Class,
    /// In how many blocks it stands.
    pub(super) depth: usize,
}

/// All tokens in their statements.
#[derive(Clone, Debug, Default)]
pub(super) struct Marked {
    /// One for each token.
    pub(super) marks: Vec<Mark>,
    /// In source order.
    pub(super) statements: Vec<Statement>,
}
