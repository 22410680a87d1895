//! Where statements begin and end, and how the parser finds back after an error.

use crate::diagnostic::{Diagnostic, Rule};
use crate::lexer::token::{Keyword, Token, TokenKind};

use super::cursor::{Context, Parsed, Parser};

/// What stands in braces: an action, a graph, a test, the bindings of an instance.
pub(super) struct Room<'a> {
    /// As messages name it.
    pub(super) name: &'a str,
    /// How its parts are kept apart.
    pub(super) advice: &'a str,
    /// Words that begin what cannot stand in it.
    pub(super) is_foreign: fn(Keyword) -> bool,
    /// A part behind which something stands that cannot be read is taken all the same: it gives names. What else it
    /// means is as good as unknown.
    pub(super) keeps_unfinished: bool,
}

/// So many tokens are looked at to guess what was meant, so that a long line takes no long time.
pub(super) const LOOKAHEAD: usize = 1000;

impl Parser<'_> {
    /// `{ .. }` with parts that `read` reads. Errors in it are dealt with inside: only a missing `{` fails.
    pub(super) fn room<T>(
        &mut self,
        room: &Room,
        mut read: impl FnMut(&mut Self) -> Parsed<T>,
    ) -> Parsed<Vec<T>> {
        let open = match self.expect(TokenKind::LeftBrace, "`{`") {
            Ok(open) => Some(open),
            Err(failed) => {
                // Nothing is said of the end of what has no beginning.
                self.find_inside().ok_or(failed)?;
                None
            }
        };
        Ok(self.parts(room, open, &mut read))
    }

    /// The parts behind a `{` up to its `}`. When nothing opened them, they end wherever something else begins.
    pub(super) fn parts<T>(
        &mut self,
        room: &Room,
        open: Option<Token>,
        read: &mut impl FnMut(&mut Self) -> Parsed<T>,
    ) -> Vec<T> {
        let mut parts = Vec::new();
        loop {
            self.next_statement();
            match self.peek() {
                TokenKind::RightBrace if self.goes_on_behind_brace() => {
                    let message = format!("this `}}` closes {} amid a statement", room.name);
                    let span = self.span_here();
                    self.error(span, message, "remove it, or begin a new line behind it");
                    self.recover_behind_brace();
                }
                TokenKind::RightBrace => {
                    self.block_end = Some(self.index);
                    self.bump();
                    break;
                }
                TokenKind::LeftBrace if self.is_behind_left_brace() => {
                    let span = self.span_here();
                    self.error(span, "a second `{`", "remove it");
                    self.bump();
                }
                TokenKind::EndOfFile => {
                    self.unclosed(open, room);
                    break;
                }
                TokenKind::Keyword(word)
                    if (room.is_foreign)(word)
                        && self.next_token().newline
                        && self.begins_element(word) =>
                {
                    let deeper = |open| self.indent(self.next_token()) > self.indent(open);
                    if !open.is_some_and(deeper) {
                        self.unclosed(open, room);
                        break;
                    }
                    self.expected(&format!("what belongs to {}", room.name));
                    self.recover();
                }
                _ => match read(self) {
                    Ok(part) => {
                        if self.end_statement(room.advice) || room.keeps_unfinished {
                            parts.push(part);
                        }
                    }
                    Err(_) => self.recover(),
                },
            }
        }
        parts
    }

    /// The latest token is a `{`.
    pub(super) fn is_behind_left_brace(&self) -> bool {
        let latest = self.index.checked_sub(1).map(|index| self.token(index));
        latest.is_some_and(|token| token.kind == TokenKind::LeftBrace)
    }

    /// Whether what follows the `}` that comes next can only go on with the statement before it.
    fn goes_on_behind_brace(&self) -> bool {
        let behind = self.peek_second();
        let joins = matches!(
            behind,
            TokenKind::If | TokenKind::And | TokenKind::Or | TokenKind::Xor | TokenKind::Equal
        );
        (joins || behind.is_comparison() || behind.is_arithmetic())
            && !self.token(self.index + 1).newline
    }

    /// Leaves out a `}` and the rest of its statement.
    fn recover_behind_brace(&mut self) {
        self.bump();
        self.recover();
    }

    /// Where a `{` is missing, goes to what it would have opened: behind a `{` further on in the line, before what a
    /// `}` in the line closes, or to the next line when that stands deeper. Nothing when none of these is there.
    fn find_inside(&mut self) -> Option<()> {
        for index in self.index..self.index + LOOKAHEAD {
            let token = self.token(index);
            match token.kind {
                TokenKind::LeftBrace if !token.newline => {
                    self.index = index + 1;
                    return Some(());
                }
                TokenKind::RightBrace if !token.newline => return Some(()),
                TokenKind::EndOfFile => return None,
                _ if token.newline => {
                    let header = self.indent(self.token(self.statement));
                    let deeper = self.indent(token) > header;
                    self.index = if deeper { index } else { self.index };
                    return deeper.then_some(());
                }
                _ => {}
            }
        }
        None
    }

    /// Says that a brace is open where the file ends or something else begins, and takes it as closed.
    fn unclosed(&mut self, open: Option<Token>, room: &Room) {
        self.block_end = self.index.checked_sub(1);
        let Some(open) = open else {
            return;
        };
        let found = match self.peek() {
            TokenKind::EndOfFile => "the file ends here".to_owned(),
            _ => format!("{} begins something else", self.found()),
        };
        let message = format!("{} is not closed", room.name);
        let diagnostic = Diagnostic::new(Rule::Syntax, self.span_of(open), message)
            .label(self.span_of(self.next_token()), found)
            .help("close it with `}`");
        self.push(diagnostic);
    }

    /// How many blanks begin the line of a token: what stands deeper than the line that opened a brace is more likely
    /// in the wrong place than behind a brace that was forgotten.
    fn indent(&self, token: Token) -> usize {
        let line = self.line_of(token);
        line.len() - line.trim_start().len()
    }

    /// Goes to the start of the next statement.
    pub(super) fn next_statement(&mut self) {
        self.context = Context::default();
        loop {
            self.statement = self.index;
            if !self.at(TokenKind::Semicolon) {
                break;
            }
            self.bump();
        }
    }

    /// Makes sure that a statement ends here, and goes to its end if it does not. Behind a block nothing need stand.
    pub(super) fn end_statement(&mut self, advice: &str) -> bool {
        let behind_block = self.block_end.is_some_and(|end| end + 1 == self.index);
        if self.at_end() || behind_block {
            return true;
        }
        let help = self.help_for_rest(advice);
        self.expected_help("the end of the line or `;`", help);
        self.recover();
        false
    }

    /// What a user may have meant by what goes on where a statement could end.
    fn help_for_rest<'h>(&self, advice: &'h str) -> &'h str {
        let word = self.text_of(self.next_token());
        match self.peek() {
            TokenKind::Keyword(Keyword::When) => {
                "`when` begins the trigger of a transition; a condition begins with `IF`"
            }
            TokenKind::If => {
                "`IF` begins a condition; the trigger of a transition begins with `when`"
            }
            TokenKind::Keyword(Keyword::Do) => {
                "`do` begins what a transition stores; it stands behind the trigger"
            }
            TokenKind::RightParenthesis => "no parenthesis is open here",
            TokenKind::Assign => "`:=` stores a value; a comparison is written `=`",
            TokenKind::Name if word.eq_ignore_ascii_case("else") => {
                "there is no `ELSE`: write a second statement under the contrary condition"
            }
            TokenKind::Name if word.eq_ignore_ascii_case("then") => {
                "the action stands in front of its condition: `A IF c`, `a = 1 IF c`"
            }
            TokenKind::Name
                if word.eq_ignore_ascii_case("when") || word.eq_ignore_ascii_case("do") =>
            {
                "`when` and `do` are written in lower case; a condition begins with `IF`"
            }
            _ if self.at_operand() => "an operator such as `AND` is missing, or a `;` or new line",
            _ => advice,
        }
    }

    /// Goes to the end of the statement in which something failed: to its `;`, its line end or the `}` around it.
    /// Braces and parentheses that are open are skipped as a whole, but never past the start of a graph or a test.
    pub(super) fn recover(&mut self) {
        let same_line = !self.next_token().newline;
        let mut brackets = if same_line { self.context.brackets } else { 0 };
        let mut in_set = same_line && self.context.in_set;
        let mut braces = 0_usize;
        self.context = Context::default();
        loop {
            let token = self.next_token();
            let line_ends = self.peek() == TokenKind::LineEnd;
            if line_ends && in_set {
                // A set seldom goes over a line end: its brace is missing.
                in_set = false;
                brackets = 0;
            }
            match token.kind {
                TokenKind::EndOfFile => return,
                TokenKind::Keyword(word)
                    if line_ends
                        && self.begins_element(word)
                        && (braces == 0 || word.begins_item_only()) =>
                {
                    return;
                }
                TokenKind::RightBrace if in_set => {
                    in_set = false;
                    brackets = brackets.saturating_sub(1);
                }
                TokenKind::LeftBrace => braces += 1,
                TokenKind::RightBrace | TokenKind::Semicolon if braces == 0 => return,
                TokenKind::RightBrace => {
                    braces -= 1;
                    if braces == 0 {
                        self.block_end = Some(self.index);
                    }
                }
                _ if braces > 0 => {}
                TokenKind::LeftParenthesis => brackets += 1,
                TokenKind::RightParenthesis => brackets = brackets.saturating_sub(1),
                _ if brackets == 0 && line_ends => return,
                _ => {}
            }
            self.bump();
        }
    }

    /// The word that begins the next element. One that is nearly so written is reported and read as it was meant, so
    /// that what it declares is known.
    pub(super) fn element_word(&mut self, what: &str) -> Option<Keyword> {
        if let TokenKind::Keyword(word) = self.peek() {
            return Some(word);
        }
        let word = self
            .nearest_keyword()
            .filter(|&word| self.begins_element(word))?;
        self.expected_help(what, format!("did you mean `{}`?", word.word()));
        self.read_as(word);
        Some(word)
    }

    /// The word that the next token may have been meant to be: in another case, or nearly so written.
    fn nearest_keyword(&self) -> Option<Keyword> {
        const LONGEST: usize = 20;
        let word = self.text_of(self.next_token());
        if !self.at(TokenKind::Name) || word.len() > LONGEST {
            return None;
        }
        let lower = word.to_lowercase();
        Keyword::ALL
            .iter()
            .filter(|keyword| keyword.begins_element())
            .map(|&keyword| (strsim::osa_distance(&lower, keyword.word()), keyword))
            .filter(|(distance, keyword)| *distance <= keyword.word().len() / 4)
            .min_by_key(|(distance, _)| *distance)
            .map(|(_, keyword)| keyword)
    }

    /// Whether the keyword that comes next begins an element rather than being used as a name.
    pub(super) fn begins_element(&self, word: Keyword) -> bool {
        word.begins_element()
            && !matches!(
                self.token(self.index + 1).kind,
                TokenKind::Equal
                    | TokenKind::Assign
                    | TokenKind::If
                    | TokenKind::Comma
                    | TokenKind::Semicolon
            )
            && !(self.token(self.index + 1).newline && self.token(self.index + 1).breaks)
    }
}
