//! What each token is in its statement: which braces enclose a block, which colons join two names, what begins a
//! column.

use super::mark::{Class, Column, Mark, Marked, Role, Statement};
use crate::lexer::token::{Keyword, Token, TokenKind};

/// Marks the tokens of a text without syntax errors.
pub(super) fn mark(text: &str, tokens: &[Token]) -> Marked {
    let mut marker = Marker {
        text,
        tokens,
        marked: Marked::default(),
        blocks: vec![Block::new(Body::File, 0)],
    };
    for (at, token) in tokens.iter().enumerate() {
        marker.take(at, *token);
    }
    marker.marked
}

/// What stands in a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Body {
    File,
    /// Of a graph, a template, a plant or a macro step.
    Elements,
    Action,
    Bindings,
    Test,
}

/// A block that is open.
struct Block {
    body: Body,
    /// The token that opened it.
    open: usize,
    /// A line ends in it.
    long: bool,
    /// The next token begins a statement.
    fresh: bool,
    statement: Current,
}

impl Block {
    fn new(body: Body, open: usize) -> Self {
        Block {
            body,
            open,
            long: false,
            fresh: true,
            statement: Current::new(open),
        }
    }
}

/// The statement of a block that is being read.
struct Current {
    /// Its first token.
    first: usize,
    /// The colon of a transition, a property or an `on`.
    label: Option<usize>,
    /// It has an `IF`.
    conditional: bool,
    /// Whether the enable of a timer is open: in the statement itself, and in each bracket that is open in it.
    enables: Vec<bool>,
}

impl Current {
    fn new(first: usize) -> Self {
        Current {
            first,
            label: None,
            conditional: false,
            enables: vec![false],
        }
    }

    fn in_brackets(&self) -> bool {
        self.enables.len() > 1
    }
}

struct Marker<'t> {
    text: &'t str,
    tokens: &'t [Token],
    marked: Marked,
    /// The innermost last; never empty.
    blocks: Vec<Block>,
}

impl Marker<'_> {
    fn kind(&self, at: usize) -> TokenKind {
        self.tokens
            .get(at)
            .map_or(TokenKind::EndOfFile, |token| token.kind)
    }

    /// The kind of the token so many places before another.
    fn before(&self, at: usize, places: usize) -> TokenKind {
        at.checked_sub(places)
            .map_or(TokenKind::EndOfFile, |at| self.kind(at))
    }

    fn text_of(&self, at: usize) -> &str {
        self.tokens
            .get(at)
            .and_then(|token| self.text.get(token.start as usize..token.end as usize))
            .unwrap_or("")
    }

    /// The innermost block.
    fn block(&mut self) -> &mut Block {
        if self.blocks.is_empty() {
            self.blocks.push(Block::new(Body::File, 0));
        }
        let last = self.blocks.len() - 1;
        &mut self.blocks[last]
    }

    /// The statement that is being read.
    fn current(&mut self) -> &mut Current {
        &mut self.block().statement
    }

    fn class(&self) -> Class {
        self.marked
            .statements
            .last()
            .map_or(Class::Other, |statement| statement.class)
    }

    fn take(&mut self, at: usize, token: Token) {
        let depth = self.blocks.len();
        let block = self.block();
        block.long |= token.newline;
        let begins = !matches!(
            token.kind,
            TokenKind::RightBrace | TokenKind::Semicolon | TokenKind::EndOfFile
        ) && !block.statement.in_brackets()
            && (block.fresh || token.breaks);
        if begins {
            block.fresh = false;
            block.statement = Current::new(at);
            let class = self.class_of(at);
            self.marked.statements.push(Statement { class, depth });
        }
        let statement = self.marked.statements.len().saturating_sub(1);
        let column = self.column(at, token.kind);
        self.marked.marks.push(Mark {
            role: Role::Plain,
            begins,
            statement,
            column,
        });
        let role = self.role(at, token);
        if let Some(mark) = self.marked.marks.last_mut() {
            mark.role = role;
        }
    }

    /// The class of the statement that begins with a token.
    fn class_of(&mut self, at: usize) -> Class {
        let body = self.block().body;
        match self.kind(at) {
            TokenKind::Keyword(Keyword::Input | Keyword::Output) => Class::Terminal,
            TokenKind::Keyword(
                Keyword::Retain | Keyword::Var | Keyword::Parameter | Keyword::Const,
            ) => Class::Variable,
            TokenKind::Keyword(
                Keyword::Initial | Keyword::Step | Keyword::Entry | Keyword::Exit,
            ) => Class::Step,
            TokenKind::Keyword(Keyword::Transition) => Class::Transition,
            TokenKind::Name if body == Body::Bindings => Class::Binding,
            TokenKind::Name if body == Body::Action => {
                if self.text_of(at) == "F" && self.kind(at + 1) == TokenKind::Slash {
                    Class::Order
                } else {
                    Class::Momentary
                }
            }
            _ => Class::Other,
        }
    }

    /// The column that begins with a token.
    fn column(&mut self, at: usize, kind: TokenKind) -> Option<Column> {
        let current = self.current();
        if current.in_brackets() {
            return None;
        }
        let (first, label) = (current.first, current.label);
        match (self.class(), kind) {
            (Class::Terminal, TokenKind::Name)
                if matches!(self.before(at, 1), TokenKind::Keyword(_)) =>
            {
                Some(Column::Name)
            }
            (Class::Terminal | Class::Variable, TokenKind::Colon)
                if matches!(self.before(at, 2), TokenKind::Keyword(_)) =>
            {
                Some(Column::Type)
            }
            (Class::Terminal | Class::Variable, TokenKind::Keyword(Keyword::At)) => {
                Some(Column::At)
            }
            (Class::Terminal | Class::Variable, TokenKind::Text) => Some(Column::Last),
            (Class::Step, TokenKind::Text) => Some(Column::StepText {
                lead: match self.kind(first) {
                    TokenKind::Keyword(Keyword::Initial) => 1,
                    TokenKind::Keyword(Keyword::Entry) => 2,
                    TokenKind::Keyword(Keyword::Exit) => 3,
                    _ => 0,
                },
            }),
            (Class::Step, TokenKind::LeftBrace) if !self.opens_set(at) => Some(Column::Last),
            (Class::Transition, _)
                if label.is_some_and(|label| label + 1 == at && label == first + 2) =>
            {
                Some(Column::Entrance)
            }
            (Class::Momentary | Class::Order, TokenKind::If) => Some(Column::Condition),
            (Class::Binding, _) if at == first + 1 => Some(Column::BoundTo),
            _ => None,
        }
    }

    fn role(&mut self, at: usize, token: Token) -> Role {
        match token.kind {
            TokenKind::LeftBrace if self.opens_set(at) => self.open_bracket(),
            TokenKind::LeftBrace => self.open_block(at),
            TokenKind::RightBrace if !self.current().in_brackets() => self.close_block(at),
            TokenKind::LeftParenthesis => self.open_bracket(),
            TokenKind::RightParenthesis | TokenKind::RightBrace => {
                self.current().enables.pop();
                Role::Suffix
            }
            TokenKind::Semicolon => {
                self.block().fresh = true;
                Role::Semicolon
            }
            TokenKind::Comma => Role::Suffix,
            TokenKind::Colon => self.colon(at),
            TokenKind::Slash => self.slash(at, token),
            TokenKind::If => {
                self.current().conditional = true;
                Role::Plain
            }
            TokenKind::Not | TokenKind::Rising | TokenKind::Falling => {
                let is_word = self.text_of(at).starts_with(char::is_alphabetic);
                if is_word { Role::Plain } else { Role::Prefix }
            }
            TokenKind::Minus if !self.ends_operand(at) => Role::Prefix,
            // `when =1`.
            TokenKind::Equal if self.before(at, 1) == TokenKind::Keyword(Keyword::When) => {
                Role::Prefix
            }
            TokenKind::Assign => {
                self.store();
                Role::Plain
            }
            TokenKind::Mod => Role::Plain,
            kind if kind.is_comparison() || kind.is_arithmetic() => {
                if kind == TokenKind::Equal {
                    self.store();
                }
                // `T/level>300/2s`: what stands between the slashes holds together.
                match self.current().enables.last() {
                    Some(true) => Role::Joint,
                    _ => Role::Plain,
                }
            }
            TokenKind::Name
                if self.text_of(at) == "S" && self.kind(at + 1) == TokenKind::LeftParenthesis =>
            {
                Role::Prefix
            }
            _ => Role::Plain,
        }
    }

    /// A `=` or `:=` outside a condition: the statement is a stored one.
    fn store(&mut self) {
        let current = self.current();
        if !current.in_brackets()
            && !current.conditional
            && let Some(statement) = self.marked.statements.last_mut()
            && statement.class == Class::Momentary
        {
            statement.class = Class::Other;
        }
    }

    /// Whether a `{` opens a set: behind `S(G) =`, `F/G:` and the names behind `encloses`.
    fn opens_set(&self, at: usize) -> bool {
        match self.before(at, 1) {
            TokenKind::Equal | TokenKind::NotEqual | TokenKind::Colon => true,
            TokenKind::Name => {
                self.class() == Class::Step
                    && matches!(
                        self.before(at, 2),
                        TokenKind::Keyword(Keyword::Encloses) | TokenKind::Comma
                    )
            }
            _ => false,
        }
    }

    fn open_bracket(&mut self) -> Role {
        self.current().enables.push(false);
        Role::Prefix
    }

    fn open_block(&mut self, at: usize) -> Role {
        let first = self.current().first;
        let body = match self.kind(first) {
            TokenKind::Keyword(Keyword::Graph) if self.kind(first + 2) == TokenKind::Equal => {
                Body::Bindings
            }
            TokenKind::Keyword(
                Keyword::Graph | Keyword::Template | Keyword::Plant | Keyword::Macro,
            ) => Body::Elements,
            TokenKind::Keyword(Keyword::Test) => Body::Test,
            _ => Body::Action,
        };
        self.blocks.push(Block::new(body, at));
        // Until its end has been seen.
        Role::OpenBlock { long: false }
    }

    fn close_block(&mut self, at: usize) -> Role {
        let block = self.blocks.pop().unwrap_or(Block::new(Body::File, 0));
        let end = |at: usize| self.tokens.get(at).map_or(0, |token| token.end as usize);
        let content = self.text.get(end(block.open)..end(at)).unwrap_or("");
        let long = block.long && content.trim() != "}";
        if let Some(open) = self.marked.marks.get_mut(block.open) {
            open.role = Role::OpenBlock { long };
        }
        let outer = self.block();
        outer.long |= long;
        outer.fresh = true;
        Role::CloseBlock { long }
    }

    fn colon(&mut self, at: usize) -> Role {
        if matches!(self.class(), Class::Terminal | Class::Variable) {
            return Role::Plain;
        }
        let first = self.current().first;
        let labelled = matches!(
            self.kind(first),
            TokenKind::Keyword(Keyword::Transition | Keyword::Property | Keyword::On)
        );
        let current = self.current();
        if labelled && current.label.is_none() && !current.in_brackets() {
            current.label = Some(at);
            Role::Suffix
        } else {
            Role::Joint
        }
    }

    /// The slashes of timers and orders join. Of the others only types could tell whether they divide or delay: they
    /// stand as the author wrote them.
    fn slash(&mut self, at: usize, token: Token) -> Role {
        let of_order = self.class() == Class::Order && at == self.current().first + 1;
        let behind_t =
            at > 0 && self.text_of(at - 1) == "T" && self.before(at, 2) != TokenKind::Colon;
        let Some(enable) = self.current().enables.last_mut() else {
            return Role::Plain;
        };
        if std::mem::take(enable) || of_order {
            return Role::Joint;
        }
        if behind_t {
            *enable = true;
            return Role::Joint;
        }
        let neighbours = (
            at.checked_sub(1).and_then(|at| self.tokens.get(at)),
            self.tokens.get(at + 1),
        );
        match neighbours {
            (Some(left), Some(right)) if left.end == token.start && token.end == right.start => {
                Role::Joint
            }
            _ => Role::Plain,
        }
    }

    /// Whether an operand may end before a token, so that a minus there subtracts.
    fn ends_operand(&mut self, at: usize) -> bool {
        const WORDS: [&str; 7] = [
            "after",
            "event",
            "expect",
            "never",
            "reachable",
            "recoverable",
            "until",
        ];
        match self.before(at, 1) {
            TokenKind::Name => {
                let first = self.current().first;
                let in_place = self.block().body == Body::Test
                    || matches!(
                        self.kind(first),
                        TokenKind::Keyword(Keyword::Property | Keyword::On)
                    );
                !(in_place && at > 0 && WORDS.contains(&self.text_of(at - 1)))
            }
            TokenKind::Number
            | TokenKind::Duration
            | TokenKind::True
            | TokenKind::False
            | TokenKind::RightParenthesis
            | TokenKind::RightBrace => true,
            _ => false,
        }
    }
}
