//! The parser's place among the tokens: looking, taking and complaining.

use crate::diagnostic::{Diagnostic, Rule};
use crate::lexer::token::{Keyword, Token, TokenKind};
use crate::literals;
use crate::report::Report;
use crate::source::{FileId, Span};

use super::MAX_NESTING;

/// A construct could not be read; the reason has been reported.
#[derive(Clone, Copy, Debug)]
pub(super) struct Failed;

/// What reading a construct gives.
pub(super) type Parsed<T> = Result<T, Failed>;

/// What the surroundings of an expression say about it; parentheses begin afresh.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Context {
    /// How many parentheses and sets are open: inside them a line break means nothing.
    pub(super) brackets: u32,
    /// A set is the innermost of them.
    pub(super) in_set: bool,
    /// The next `/` ends the expression: the enable of a timer.
    pub(super) slash_ends: bool,
    /// A `:` ends the expression: an event.
    pub(super) colon_ends: bool,
}

/// Reads one file.
pub(super) struct Parser<'a> {
    file: FileId,
    text: &'a str,
    tokens: Vec<Token>,
    pub(super) index: usize,
    /// The token that begins the statement: a line break before it is past.
    pub(super) statement: usize,
    /// The `}` that closed the latest block or body; behind it no `;` is needed.
    pub(super) block_end: Option<usize>,
    /// The token at which the latest error was reported.
    failed_at: Option<usize>,
    nesting: u32,
    pub(super) context: Context,
    report: Report<'a>,
}

impl<'a> Parser<'a> {
    /// A parser at the first of the tokens, the last of which is the end of the file.
    pub(super) fn new(file: FileId, text: &'a str, tokens: Vec<Token>, report: Report<'a>) -> Self {
        Parser {
            file,
            text,
            tokens,
            index: 0,
            statement: 0,
            block_end: None,
            failed_at: None,
            nesting: 0,
            context: Context::default(),
            report,
        }
    }

    /// The token at an index; behind the last one the end of the file goes on.
    pub(super) fn token(&self, index: usize) -> Token {
        let end = Token {
            kind: TokenKind::EndOfFile,
            start: 0,
            end: 0,
            newline: true,
            breaks: true,
        };
        self.tokens
            .get(index)
            .or(self.tokens.last())
            .copied()
            .unwrap_or(end)
    }

    /// The next token, whatever stands before it.
    pub(super) fn next_token(&self) -> Token {
        self.token(self.index)
    }

    /// The kind of the next token, or the end of the line if that ends the statement.
    pub(super) fn peek(&self) -> TokenKind {
        let token = self.next_token();
        if self.statement != self.index && self.line_ends_before(token) {
            TokenKind::LineEnd
        } else {
            token.kind
        }
    }

    /// The kind of the token behind the next one.
    pub(super) fn peek_second(&self) -> TokenKind {
        let token = self.token(self.index + 1);
        if self.line_ends_before(token) {
            TokenKind::LineEnd
        } else {
            token.kind
        }
    }

    /// Whether a statement ends at the line break before a token. Inside brackets only a word that begins an element
    /// ends it: then a bracket has not been closed.
    fn line_ends_before(&self, token: Token) -> bool {
        let in_brackets = self.context.brackets > 0;
        let begins_element =
            matches!(token.kind, TokenKind::Keyword(word) if word.begins_element());
        token.breaks && (!in_brackets || begins_element) && token.kind != TokenKind::EndOfFile
    }

    /// Whether the next token is of a kind.
    pub(super) fn at(&self, kind: TokenKind) -> bool {
        self.peek() == kind
    }

    /// Whether the next token is a word that means something only in its place.
    pub(super) fn at_word(&self, word: &str) -> bool {
        self.at(TokenKind::Name) && self.text_of(self.next_token()) == word
    }

    /// No token of the statement is left.
    pub(super) fn at_end(&self) -> bool {
        matches!(
            self.peek(),
            TokenKind::LineEnd
                | TokenKind::Semicolon
                | TokenKind::RightBrace
                | TokenKind::EndOfFile
        )
    }

    /// Takes the next token.
    pub(super) fn bump(&mut self) -> Token {
        let token = self.next_token();
        if token.kind != TokenKind::EndOfFile {
            self.index += 1;
        }
        token
    }

    /// Takes the name that comes next for a reserved word, after it has been reported.
    pub(super) fn read_as(&mut self, word: Keyword) {
        let token = self.tokens.get_mut(self.index);
        if let Some(token) = token.filter(|token| token.kind == TokenKind::Name) {
            token.kind = TokenKind::Keyword(word);
        }
    }

    /// Takes the next token if it is of a kind.
    pub(super) fn eat(&mut self, kind: TokenKind) -> bool {
        let there = self.at(kind);
        if there {
            self.bump();
        }
        there
    }

    /// Takes the next token if it is a word that means something only here.
    pub(super) fn eat_word(&mut self, word: &str) -> bool {
        let there = self.at_word(word);
        if there {
            self.bump();
        }
        there
    }

    /// Takes a token of a kind, or says that it is missing.
    pub(super) fn expect(&mut self, kind: TokenKind, what: &str) -> Parsed<Token> {
        if self.at(kind) {
            Ok(self.bump())
        } else {
            Err(self.expected(what))
        }
    }

    /// Takes a word that means something only here, or says that it is missing.
    pub(super) fn expect_word(&mut self, word: &str) -> Parsed<()> {
        if self.eat_word(word) {
            Ok(())
        } else {
            Err(self.expected(&format!("`{word}`")))
        }
    }

    /// The text of a token.
    pub(super) fn text_of(&self, token: Token) -> &'a str {
        self.text
            .get(token.start as usize..token.end as usize)
            .unwrap_or("")
    }

    /// The text from the start of a token's line to the token.
    pub(super) fn line_of(&self, token: Token) -> &'a str {
        let before = self.text.get(..token.start as usize).unwrap_or("");
        before.rsplit('\n').next().unwrap_or("")
    }

    /// The text of the token behind the next one.
    pub(super) fn text_of_second(&self) -> &'a str {
        self.text_of(self.token(self.index + 1))
    }

    /// The place of a token.
    pub(super) fn span_of(&self, token: Token) -> Span {
        token.span(self.file)
    }

    /// From the token at `start` to the latest token taken.
    pub(super) fn span_since(&self, start: Token) -> Span {
        let last = self.token(self.index.saturating_sub(1));
        Span {
            file: self.file,
            start: start.start,
            end: last.end.max(start.start),
        }
    }

    /// Where the next token stands; at the end of a line or file, just behind the latest one.
    pub(super) fn span_here(&self) -> Span {
        match self.peek() {
            TokenKind::LineEnd | TokenKind::EndOfFile => {
                let end = if self.index == 0 {
                    0
                } else {
                    self.token(self.index - 1).end
                };
                Span {
                    file: self.file,
                    start: end,
                    end,
                }
            }
            _ => self.span_of(self.next_token()),
        }
    }

    /// The next token in words.
    pub(super) fn found(&self) -> String {
        match self.peek() {
            TokenKind::LineEnd => "the end of the line".to_owned(),
            TokenKind::EndOfFile => "the end of the file".to_owned(),
            TokenKind::Text => "a text".to_owned(),
            _ => format!("`{}`", literals::shortened(self.text_of(self.next_token()))),
        }
    }

    /// Takes a diagnostic as it is.
    pub(super) fn push(&mut self, diagnostic: Diagnostic) {
        self.report.push(diagnostic);
        if self.report.is_full() {
            self.index = self.tokens.len().saturating_sub(1);
        }
    }

    /// Reports a violation of the grammar at a place.
    pub(super) fn error(
        &mut self,
        span: Span,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        self.push(Diagnostic::new(Rule::Syntax, span, message).help(help));
    }

    /// Reports an error at the next token, unless one has been reported there.
    pub(super) fn fail(&mut self, diagnostic: Diagnostic) -> Failed {
        if self.next_token().kind != TokenKind::Unknown && self.failed_at != Some(self.index) {
            self.failed_at = Some(self.index);
            self.push(diagnostic);
        }
        Failed
    }

    /// Says what should stand in the place of the next token.
    pub(super) fn expected(&mut self, what: &str) -> Failed {
        let message = format!("expected {what}, found {}", self.found());
        let diagnostic = Diagnostic::new(Rule::Syntax, self.span_here(), message);
        self.fail(diagnostic)
    }

    /// Says what should stand in the place of the next token, and the mend.
    pub(super) fn expected_help(&mut self, what: &str, help: impl Into<String>) -> Failed {
        let message = format!("expected {what}, found {}", self.found());
        let diagnostic = Diagnostic::new(Rule::Syntax, self.span_here(), message).help(help);
        self.fail(diagnostic)
    }

    /// Reads something one level deeper, or refuses at [`MAX_NESTING`].
    pub(super) fn nested<T>(&mut self, read: impl FnOnce(&mut Self) -> Parsed<T>) -> Parsed<T> {
        if self.nesting >= MAX_NESTING {
            let message = format!("more than {MAX_NESTING} levels are nested in each other");
            let diagnostic = Diagnostic::new(Rule::Syntax, self.span_here(), message).help(
                "store a part in a variable, or write a chain of `AND` or `OR` without parentheses",
            );
            return Err(self.fail(diagnostic));
        }
        self.nesting += 1;
        let result = read(self);
        self.nesting -= 1;
        result
    }

    /// Reads something under a context of its own.
    pub(super) fn within<T>(
        &mut self,
        context: Context,
        read: impl FnOnce(&mut Self) -> Parsed<T>,
    ) -> Parsed<T> {
        let outer = std::mem::replace(&mut self.context, context);
        let result = read(self);
        // After an error the brackets that are open tell where the statement may end.
        if result.is_ok() {
            self.context = outer;
        }
        result
    }

    /// Reads something inside parentheses, where a line break means nothing.
    pub(super) fn in_parentheses<T>(
        &mut self,
        read: impl FnOnce(&mut Self) -> Parsed<T>,
    ) -> Parsed<T> {
        let context = Context {
            brackets: self.context.brackets + 1,
            ..Context::default()
        };
        self.within(context, read)
    }

    /// Reads something inside a set, where a line break means nothing either.
    pub(super) fn in_set<T>(&mut self, read: impl FnOnce(&mut Self) -> Parsed<T>) -> Parsed<T> {
        let context = Context {
            brackets: self.context.brackets + 1,
            in_set: true,
            ..Context::default()
        };
        self.within(context, read)
    }
}
