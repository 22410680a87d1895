//! The scanner: one pass over the text, no recursion, so that nested comments cost no stack.

use crate::diagnostic::{Diagnostic, Rule};
use crate::literals;
use crate::report::Report;
use crate::source::{FileId, Span};

use super::token::{Token, TokenKind};
use super::{Lexed, MAX_WORD, begins_name, continues_name, span};

/// A blank within a line.
fn is_blank(c: char) -> bool {
    c != '\n' && c.is_whitespace()
}

/// Reads a text from its start to its end.
pub(super) struct Scanner<'a, 'r, 'd> {
    file: FileId,
    text: &'a str,
    at: usize,
    tokens: Vec<Token>,
    comments: Vec<Span>,
    report: &'r mut Report<'d>,
}

impl<'a, 'r, 'd> Scanner<'a, 'r, 'd> {
    pub(super) fn new(file: FileId, text: &'a str, report: &'r mut Report<'d>) -> Self {
        Scanner {
            file,
            text,
            // Some editors write a byte order mark.
            at: if text.starts_with('\u{feff}') {
                '\u{feff}'.len_utf8()
            } else {
                0
            },
            tokens: Vec::new(),
            comments: Vec::new(),
            report,
        }
    }

    /// Reads all tokens and comments.
    pub(super) fn run(mut self) -> Lexed {
        let mut newline = true;
        while let Some(c) = self.peek() {
            let start = self.at;
            if c == '\n' {
                self.at += 1;
                newline = true;
            } else if is_blank(c) {
                self.at += c.len_utf8();
            } else if self.rest().starts_with("//") {
                self.take_while(|c| c != '\n');
                self.comments.push(self.span_from(start));
            } else if self.rest().starts_with("(*") || self.rest().starts_with("/*") {
                // A comment that goes over a line end is a line end too.
                newline |= self.block_comment();
                self.comments.push(self.span_from(start));
            } else {
                let kind = self.token(c);
                self.push(kind, start, newline);
                newline = false;
            }
        }
        let end = self.at;
        self.push(TokenKind::EndOfFile, end, true);
        Lexed {
            tokens: self.tokens,
            comments: self.comments,
        }
    }

    fn push(&mut self, kind: TokenKind, start: usize, newline: bool) {
        let place = self.limited(kind, start);
        if let Some(last) = self.tokens.last_mut()
            && (last.kind, kind) == (TokenKind::Unknown, TokenKind::Unknown)
        {
            last.end = place.end;
            return;
        }
        let begins_element = matches!(kind, TokenKind::Keyword(word) if word.begins_element());
        let goes_on = kind.continues_before()
            || !begins_element
                && self
                    .tokens
                    .last()
                    .is_some_and(|last| last.kind.continues_behind());
        self.tokens.push(Token {
            kind,
            start: place.start,
            end: place.end,
            newline,
            breaks: newline && !goes_on,
        });
    }

    /// Where a token stands. Of a word that is too long, which is reported, what is within the limit.
    fn limited(&mut self, kind: TokenKind, start: usize) -> Span {
        use TokenKind::{Address, Duration, Name, Number};
        let length = self.at - start;
        if length <= MAX_WORD || !matches!(kind, Name | Number | Duration | Address) {
            return self.span_from(start);
        }
        let end = self.text.floor_char_boundary(start + MAX_WORD);
        let place = span(self.file, start, end);
        let message =
            format!("a name or a number is at most {MAX_WORD} bytes long; this one has {length}");
        self.report
            .push(Diagnostic::new(Rule::Syntax, place, message));
        place
    }

    fn rest(&self) -> &'a str {
        self.text.get(self.at..).unwrap_or("")
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn span_from(&self, start: usize) -> Span {
        span(self.file, start, self.at)
    }

    /// Takes characters as long as they fit.
    fn take_while(&mut self, fits: impl Fn(char) -> bool) {
        let rest = self.rest();
        self.at += rest.find(|c| !fits(c)).unwrap_or(rest.len());
    }

    fn error(&mut self, start: usize, message: impl Into<String>, help: impl Into<String>) {
        let place = self.span_from(start);
        self.report
            .push(Diagnostic::new(Rule::Syntax, place, message).help(help));
    }

    /// One token that begins with `c`.
    fn token(&mut self, c: char) -> TokenKind {
        if c.is_ascii_digit() {
            self.number()
        } else if begins_name(c) {
            self.word()
        } else {
            match c {
                '"' => self.text(),
                '%' => self.address(),
                _ => self.symbol(c),
            }
        }
    }

    /// A comment that may hold others; true when it goes over a line end.
    fn block_comment(&mut self) -> bool {
        let start = self.at;
        let c_style = self.rest().starts_with("/*");
        let (open, close) = if c_style { ("/*", "*/") } else { ("(*", "*)") };
        let mut depth = 0_usize;
        let mut newline = false;
        while let Some(c) = self.peek() {
            if self.rest().starts_with(open) {
                // C's comments do not nest.
                depth = if c_style { 1 } else { depth + 1 };
                self.at += 2;
            } else if self.rest().starts_with(close) {
                depth -= 1;
                self.at += 2;
                if depth == 0 {
                    break;
                }
            } else {
                newline |= c == '\n';
                self.at += c.len_utf8();
            }
        }
        let end = std::mem::replace(&mut self.at, start + 2);
        if depth > 0 {
            self.error(
                start,
                "this comment is not closed",
                format!("close it with `{close}`"),
            );
        } else if c_style {
            self.error(
                start,
                "`/*` does not begin a comment",
                "write `(* .. *)`, or `//` to the end of the line",
            );
        }
        self.at = end;
        newline
    }

    /// Takes characters that fit, and single points with a part behind them that begins as it may.
    fn dotted(&mut self, fits: impl Fn(char) -> bool, begins_part: impl Fn(char) -> bool) {
        loop {
            self.take_while(&fits);
            let mut rest = self.rest().chars();
            if rest.next() != Some('.') || !rest.next().is_some_and(&begins_part) {
                break;
            }
            self.at += 1;
        }
    }

    fn word(&mut self) -> TokenKind {
        let start = self.at;
        self.take_while(continues_name);
        let prefix = self.text.get(start..self.at).unwrap_or("");
        if self.peek() == Some('#') && literals::is_duration_prefix(prefix) {
            self.take_while(|c| matches!(c, '#' | '-'));
            self.number_run();
            return TokenKind::Duration;
        }
        self.dotted(continues_name, continues_name);
        TokenKind::of_word(self.text.get(start..self.at).unwrap_or(""))
    }

    /// A number; units that follow it on the same line, behind blanks too, make it a duration.
    fn number(&mut self) -> TokenKind {
        let start = self.at;
        self.number_run();
        let run = self.text.get(start..self.at).unwrap_or("");
        let has_unit = !run.contains('#') && run.chars().any(char::is_alphabetic);
        if !has_unit && (run.contains('#') || !self.unit_behind_blanks()) {
            return TokenKind::Number;
        }
        while self.part_behind_blanks() {}
        TokenKind::Duration
    }

    /// A number with all that is attached to it; `..` ends it.
    fn number_run(&mut self) {
        self.dotted(|c| continues_name(c) || c == '#', |c| c.is_ascii_digit());
    }

    /// Takes ` s` behind `2`, when there is a unit.
    fn unit_behind_blanks(&mut self) -> bool {
        let start = self.at;
        self.take_while(is_blank);
        let unit = self.at;
        self.number_run();
        let word = self.text.get(unit..self.at).unwrap_or("");
        let taken = literals::begins_with_unit(word);
        if !taken {
            self.at = start;
        }
        taken
    }

    /// Takes ` 30 s` or ` 30s` behind `1 min`, when it is there.
    fn part_behind_blanks(&mut self) -> bool {
        let start = self.at;
        self.take_while(is_blank);
        let part = self.at;
        if !self.peek().is_some_and(|c| c.is_ascii_digit()) {
            self.at = start;
            return false;
        }
        self.number_run();
        let run = self.text.get(part..self.at).unwrap_or("");
        let unit = run.trim_start_matches(|c: char| c.is_ascii_digit() || matches!(c, '.' | '_'));
        let taken = if unit.is_empty() {
            self.unit_behind_blanks()
        } else {
            literals::begins_with_unit(unit)
        };
        if !taken {
            self.at = start;
        }
        taken
    }

    fn text(&mut self) -> TokenKind {
        let start = self.at;
        self.at += 1;
        self.take_while(|c| !matches!(c, '"' | '\n' | '\r'));
        if self.peek() == Some('"') {
            self.at += 1;
        } else {
            self.error(
                start,
                "this text is not closed",
                "a text stands in quotation marks on one line",
            );
        }
        TokenKind::Text
    }

    fn address(&mut self) -> TokenKind {
        let start = self.at;
        self.at += 1;
        self.dotted(continues_name, continues_name);
        if self.at > start + 1 {
            return TokenKind::Address;
        }
        self.error(
            start,
            "`%` does not begin an address here",
            "write `%IX0.0`, or `MOD` for the rest of a division",
        );
        TokenKind::Unknown
    }

    /// Operators and punctuation, and what other languages write for them.
    fn symbol(&mut self, c: char) -> TokenKind {
        use TokenKind as K;
        // The spellings of the language, the longer ones first.
        const SYMBOLS: &[(&str, TokenKind)] = &[
            (":=", K::Assign),
            ("<>", K::NotEqual),
            ("≠", K::NotEqual),
            ("<=", K::LessOrEqual),
            ("≤", K::LessOrEqual),
            (">=", K::GreaterOrEqual),
            ("≥", K::GreaterOrEqual),
            ("->", K::Arrow),
            ("=>", K::FatArrow),
            ("..", K::Range),
            ("=", K::Equal),
            ("<", K::Less),
            (">", K::Greater),
            ("&", K::And),
            ("·", K::And),
            ("\u{387}", K::And),
            ("|", K::Or),
            ("!", K::Not),
            ("¬", K::Not),
            ("↑", K::Rising),
            ("↓", K::Falling),
            ("+", K::Plus),
            ("-", K::Minus),
            ("*", K::Star),
            ("/", K::Slash),
            ("(", K::LeftParenthesis),
            (")", K::RightParenthesis),
            ("{", K::LeftBrace),
            ("}", K::RightBrace),
            (",", K::Comma),
            (";", K::Semicolon),
            (":", K::Colon),
        ];
        const FOREIGN: &[(&str, TokenKind, &str)] = &[
            ("==", K::Equal, "="),
            ("!=", K::NotEqual, "<>"),
            ("=<", K::LessOrEqual, "<="),
            ("&&", K::And, "AND"),
            ("||", K::Or, "OR"),
            ("→", K::Arrow, "->"),
            ("⇒", K::Arrow, "->"),
            ("∧", K::And, "AND"),
            ("∨", K::Or, "OR"),
            ("⊕", K::Xor, "XOR"),
            ("~", K::Not, "NOT"),
            ("−", K::Minus, "-"),
            ("×", K::Star, "*"),
            ("÷", K::Slash, "/"),
            ("…", K::Range, ".."),
        ];
        let start = self.at;
        let rest = self.rest();
        if let Some(&(spelling, kind, right)) = FOREIGN
            .iter()
            .find(|(spelling, ..)| rest.starts_with(spelling))
        {
            self.at += spelling.len();
            self.error(
                start,
                format!("`{spelling}` is not an operator"),
                format!("write `{right}`"),
            );
            return kind;
        }
        if let Some(&(spelling, kind)) = SYMBOLS
            .iter()
            .find(|(spelling, _)| rest.starts_with(spelling))
        {
            self.at += spelling.len();
            return kind;
        }
        self.at += c.len_utf8();
        if self
            .tokens
            .last()
            .is_none_or(|last| last.kind != K::Unknown || last.end as usize != start)
        {
            self.stray(start, c);
        }
        K::Unknown
    }

    fn stray(&mut self, start: usize, c: char) {
        let message = match c {
            c if c.is_control() => {
                format!("a control character (U+{:04X}) stands here", u32::from(c))
            }
            c => format!("`{c}` means nothing here"),
        };
        let help = match c {
            '_' => "a name begins with a letter",
            '“' | '”' | '„' | '«' | '»' | '\'' | '‘' | '’' | '`' => {
                "a text stands in straight quotation marks: \"..\""
            }
            '[' | ']' => "a condition stands in parentheses, a set in braces",
            '#' => "write a base as `16#FF`, a comment as `// ..`",
            '.' => "a point stands only between the parts of a name, a number or an address",
            '^' => "write `XOR`",
            _ => "remove it, or put it into a text: \"..\"",
        };
        self.error(start, message, help);
    }
}
