//! Where statements begin and end, and how the parser finds back after an error.

use crate::lexer::token::{Keyword, TokenKind};

use super::cursor::{Context, Parser};

impl Parser<'_> {
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

    /// Takes the `}` that closes a block.
    pub(super) fn close_block(&mut self) {
        self.block_end = Some(self.index);
        self.bump();
    }

    /// Makes sure that a statement ends here, and goes to its end if it does not. Behind a block nothing need stand.
    pub(super) fn end_statement(&mut self, advice: &str) {
        let behind_block = self.block_end.is_some_and(|end| end + 1 == self.index);
        if self.at_end() || behind_block {
            return;
        }
        let help = self.help_for_rest(advice);
        self.expected_help("the end of the line or `;`", help);
        self.recover();
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
            _ if self.at_operand() => "an operator such as `AND` is missing, or a `;` or new line",
            _ => advice,
        }
    }

    /// Goes to the end of the statement in which something failed: to its `;`, its line end or the `}` around it.
    /// Braces and parentheses that are open are skipped as a whole, but never past the start of a graph or a test.
    pub(super) fn recover(&mut self) {
        let first = self.index;
        let mut brackets = if self.next_token().newline {
            0
        } else {
            self.context.brackets
        };
        self.context = Context::default();
        let mut braces = 0_usize;
        loop {
            let token = self.next_token();
            let begins_line = token.newline && self.index != self.statement;
            match token.kind {
                TokenKind::EndOfFile => return,
                TokenKind::Keyword(word)
                    if begins_line
                        && self.begins_element(word)
                        && (braces == 0 || word.begins_item_only()) =>
                {
                    return;
                }
                TokenKind::Semicolon | TokenKind::RightBrace if braces == 0 => return,
                TokenKind::LeftParenthesis if braces == 0 => brackets += 1,
                TokenKind::RightParenthesis if braces == 0 => brackets = brackets.saturating_sub(1),
                _ if braces == 0 && brackets == 0 && self.peek() == TokenKind::LineEnd => return,
                _ => {}
            }
            match token.kind {
                TokenKind::LeftBrace => braces += 1,
                TokenKind::RightBrace => braces -= 1,
                _ => {}
            }
            self.bump();
            if braces == 0 && token.kind == TokenKind::RightBrace && self.index > first {
                self.block_end = Some(self.index - 1);
            }
        }
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
