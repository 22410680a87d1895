//! The tokens of the language.

use crate::source::{FileId, Span};

/// A token: its kind and place, and whether a line begins with it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Token {
    /// What it is.
    pub(crate) kind: TokenKind,
    /// Byte offset of its first character.
    pub(crate) start: u32,
    /// Byte offset just behind its last character.
    pub(crate) end: u32,
    /// A line break stands before it.
    pub(crate) newline: bool,
    /// The line break before it ends a statement, unless parentheses or a set are open.
    /// Before a word that begins an element it always does: no statement goes on with one.
    pub(crate) breaks: bool,
}

impl Token {
    /// Its place in a file.
    pub(crate) fn span(self, file: FileId) -> Span {
        Span {
            file,
            start: self.start,
            end: self.end,
        }
    }
}

/// The kinds of token.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TokenKind {
    /// A name, or a word that means something only in its place.
    Name,
    /// A reserved word of the structure.
    Keyword(Keyword),
    /// Begins with a digit and has no unit: an integer or a step identifier, perhaps badly written.
    Number,
    /// A number with a unit, or `T#..`, perhaps badly written.
    Duration,
    /// `"..."`.
    Text,
    /// `%...`.
    Address,
    /// `AND`, `&`, `·`.
    And,
    /// `OR`, `|`.
    Or,
    /// `XOR`.
    Xor,
    /// `NOT`, `!`, `¬`.
    Not,
    /// `MOD`.
    Mod,
    /// `IF`.
    If,
    /// `TRUE`.
    True,
    /// `FALSE`.
    False,
    /// `↑`, `RE`.
    Rising,
    /// `↓`, `FE`.
    Falling,
    /// `:=`.
    Assign,
    /// `=`.
    Equal,
    /// `<>`, `≠`.
    NotEqual,
    /// `<`.
    Less,
    /// `<=`, `≤`.
    LessOrEqual,
    /// `>`.
    Greater,
    /// `>=`, `≥`.
    GreaterOrEqual,
    /// `+`.
    Plus,
    /// `-`.
    Minus,
    /// `*`.
    Star,
    /// `/`.
    Slash,
    /// `->`.
    Arrow,
    /// `=>`, which is not of the language: an arrow or `>=`, by its place.
    FatArrow,
    /// `(`.
    LeftParenthesis,
    /// `)`.
    RightParenthesis,
    /// `{`.
    LeftBrace,
    /// `}`.
    RightBrace,
    /// `,`.
    Comma,
    /// `;`.
    Semicolon,
    /// `:`.
    Colon,
    /// `..`.
    Range,
    /// Characters of no token; already reported.
    Unknown,
    /// The end of a statement by a line break; only the parser's cursor makes it.
    LineEnd,
    /// The end of the file.
    EndOfFile,
}

impl TokenKind {
    /// A binary operator, `:=` among them.
    pub(crate) fn is_binary(self) -> bool {
        self.is_arithmetic()
            || self.is_comparison()
            || matches!(
                self,
                TokenKind::And | TokenKind::Or | TokenKind::Xor | TokenKind::Assign
            )
    }

    /// `+ - * / MOD`.
    pub(crate) fn is_arithmetic(self) -> bool {
        matches!(
            self,
            TokenKind::Plus
                | TokenKind::Minus
                | TokenKind::Star
                | TokenKind::Slash
                | TokenKind::Mod
        )
    }

    /// `= <> < <= > >=`.
    pub(crate) fn is_comparison(self) -> bool {
        matches!(
            self,
            TokenKind::Equal
                | TokenKind::NotEqual
                | TokenKind::Less
                | TokenKind::LessOrEqual
                | TokenKind::Greater
                | TokenKind::GreaterOrEqual
                | TokenKind::FatArrow
        )
    }

    /// A statement goes on over the line break behind this token.
    pub(crate) fn continues_behind(self) -> bool {
        self.is_binary() || matches!(self, TokenKind::Comma | TokenKind::Arrow)
    }

    /// A statement goes on over the line break before this token.
    pub(crate) fn continues_before(self) -> bool {
        self.is_binary()
            || matches!(
                self,
                TokenKind::Arrow
                    | TokenKind::If
                    | TokenKind::LeftBrace
                    | TokenKind::Keyword(Keyword::When | Keyword::Do)
            )
    }
}

macro_rules! keywords {
    ($($variant:ident $word:literal)*) => {
        /// The words that are reserved in lower case.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Keyword { $(#[doc = $word] $variant,)* }

        impl Keyword {
            /// Every keyword.
            pub(crate) const ALL: &[Keyword] = &[$(Keyword::$variant,)*];

            /// As it is written.
            pub(crate) fn word(self) -> &'static str {
                match self { $(Keyword::$variant => $word,)* }
            }

            /// The keyword that is written so.
            pub(crate) fn of(word: &str) -> Option<Keyword> {
                match word { $($word => Some(Keyword::$variant),)* _ => None }
            }
        }
    };
}

keywords! {
    Application "application"
    Import "import"
    Scan "scan"
    Evolution "evolution"
    Input "input"
    Output "output"
    Retain "retain"
    Var "var"
    Parameter "parameter"
    Const "const"
    Graph "graph"
    Always "always"
    Initial "initial"
    Step "step"
    Macro "macro"
    Entry "entry"
    Exit "exit"
    Transition "transition"
    Template "template"
    Plant "plant"
    Property "property"
    Test "test"
    At "at"
    In "in"
    Encloses "encloses"
    When "when"
    Do "do"
    On "on"
}

impl Keyword {
    /// Begins an element of a file or a graph.
    pub(crate) fn begins_element(self) -> bool {
        !matches!(
            self,
            Keyword::At
                | Keyword::In
                | Keyword::Encloses
                | Keyword::When
                | Keyword::Do
                | Keyword::On
        )
    }

    /// Begins an element that stands in a file, never in a graph.
    pub(crate) fn begins_item_only(self) -> bool {
        matches!(
            self,
            Keyword::Application
                | Keyword::Import
                | Keyword::Scan
                | Keyword::Evolution
                | Keyword::Graph
                | Keyword::Template
                | Keyword::Plant
                | Keyword::Property
                | Keyword::Test
        )
    }

    /// Begins an element that stands in a graph, never in a file.
    pub(crate) fn begins_graph_part_only(self) -> bool {
        matches!(
            self,
            Keyword::Always
                | Keyword::Initial
                | Keyword::Step
                | Keyword::Macro
                | Keyword::Entry
                | Keyword::Exit
                | Keyword::Transition
        )
    }
}

/// The word operators, which are reserved in any case, and `TRUE` and `FALSE`.
pub(crate) fn operator_word(word: &str) -> Option<TokenKind> {
    const WORDS: [(&str, TokenKind); 10] = [
        ("AND", TokenKind::And),
        ("OR", TokenKind::Or),
        ("XOR", TokenKind::Xor),
        ("NOT", TokenKind::Not),
        ("MOD", TokenKind::Mod),
        ("IF", TokenKind::If),
        ("TRUE", TokenKind::True),
        ("FALSE", TokenKind::False),
        ("RE", TokenKind::Rising),
        ("FE", TokenKind::Falling),
    ];
    WORDS
        .iter()
        .find(|(text, _)| text.eq_ignore_ascii_case(word))
        .map(|&(_, kind)| kind)
}
