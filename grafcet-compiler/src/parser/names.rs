//! Names, step identifiers, sets, texts and literals.

use crate::ast::{Constant, ConstantKind, Name, Ref, Set, Situation, Text};
use crate::diagnostic::{Diagnostic, Rule};
use crate::lexer;
use crate::lexer::token::{Keyword, Token, TokenKind};
use crate::literals::{self, BadLiteral};
use crate::source::Span;

use super::cursor::{Parsed, Parser};
use super::recovery::LOOKAHEAD;

/// `X` and digits: the bit of a numbered step, never a name of one's own.
pub(super) fn is_step_bit(name: &str) -> bool {
    name.strip_prefix('X').is_some_and(|digits| {
        !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_digit())
    })
}

impl Parser<'_> {
    /// A token as a name in NFC.
    pub(super) fn name_of(&self, token: Token) -> Name {
        Name {
            text: lexer::normalized(self.text_of(token)).into_owned(),
            span: self.span_of(token),
        }
    }

    /// A name that is used: of a graph, a variable, a step bit. A reserved word in its place is reported as such.
    pub(super) fn name(&mut self, what: &str) -> Parsed<Name> {
        match self.peek() {
            TokenKind::Name => {
                let token = self.bump();
                Ok(self.name_of(token))
            }
            TokenKind::Keyword(_)
            | TokenKind::And
            | TokenKind::Or
            | TokenKind::Xor
            | TokenKind::Not
            | TokenKind::Mod
            | TokenKind::If
            | TokenKind::True
            | TokenKind::False
            | TokenKind::Rising
            | TokenKind::Falling
                if self.is_word(self.next_token()) =>
            {
                let name = self.name_of(self.next_token());
                self.reserved(&name);
                self.bump();
                Ok(name)
            }
            _ => Err(self.expected(what)),
        }
    }

    /// A name that is declared here. `System` and the step bits of numbered steps are refused.
    pub(super) fn declared_name(&mut self, what: &str) -> Parsed<Name> {
        if matches!(self.peek(), TokenKind::Keyword(_)) && self.peek_second() == TokenKind::Name {
            // One word too many, not a reserved word as a name.
            self.expected(what);
            self.bump();
        }
        let is_name = self.at(TokenKind::Name);
        let name = self.name(what)?;
        if is_name && name.text == "System" {
            self.push(
                Diagnostic::new(Rule::ReservedWord, name.span, "`System` is reserved")
                    .help("its names are the system's own: `System:first_scan`"),
            );
        } else if is_name && is_step_bit(&name.text) {
            self.push(
                Diagnostic::new(
                    Rule::ReservedWord,
                    name.span,
                    format!("`{}` is reserved", name.text),
                )
                .help("`X` with digits is the step bit of the step with that number"),
            );
        }
        Ok(name)
    }

    /// The token is spelled with letters (`AND`, not `&`).
    fn is_word(&self, token: Token) -> bool {
        self.text_of(token).starts_with(lexer::begins_name)
    }

    /// Reports a reserved word that is used as a name.
    fn reserved(&mut self, name: &Name) {
        let diagnostic = Diagnostic::new(
            Rule::ReservedWord,
            name.span,
            format!("`{}` is a reserved word and cannot be a name", name.text),
        )
        .help(format!("choose another name, such as `{}_1`", name.text));
        self.fail(diagnostic);
    }

    /// `name` or `Graph:name`.
    pub(super) fn reference(&mut self, what: &str) -> Parsed<Ref> {
        let first = self.name(what)?;
        let qualified = self.at(TokenKind::Colon) && !self.context.colon_ends;
        if !qualified {
            if first.text == "System" {
                self.bare_system(first.span);
            }
            return Ok(Ref {
                graph: None,
                span: first.span,
                name: first,
            });
        }
        self.bump();
        let name = self.name("a name behind `:`")?;
        Ok(Ref {
            span: first.span.to(name.span),
            graph: Some(first),
            name,
        })
    }

    /// `System` without a name behind it.
    fn bare_system(&mut self, span: Span) {
        let help = if self.context.colon_ends {
            "in an event a name of the system stands in parentheses: `on event ↑(System:unstable): ..`"
        } else {
            "its names are written `System:first_scan`, `System:unstable`"
        };
        self.push(Diagnostic::new(Rule::ReservedWord, span, "`System` is reserved").help(help));
    }

    /// Names or references with commas between them.
    pub(super) fn list<T>(
        &mut self,
        mut read: impl FnMut(&mut Self) -> Parsed<T>,
    ) -> Parsed<Vec<T>> {
        let mut all = vec![read(self)?];
        while self.eat(TokenKind::Comma) {
            all.push(read(self)?);
        }
        Ok(all)
    }

    /// A step identifier. One that cannot be read but is evident is reported and taken as it was meant.
    pub(super) fn step_identifier(&mut self, what: &str) -> Parsed<Name> {
        const HELP: &str =
            "steps are named by digits, or by one capital letter and digits: `5`, `E5`";
        if !matches!(
            self.peek(),
            TokenKind::Name | TokenKind::Number | TokenKind::Duration
        ) {
            return Err(self.expected_help(what, HELP));
        }
        let mut name = self.name_of(self.next_token());
        if let Err((bad, meant)) = literals::step_identifier(&name.text) {
            self.bad_literal(name.span, bad);
            name.text = meant.unwrap_or(name.text);
        }
        self.bump();
        Ok(name)
    }

    /// The identifier of a step that is declared here. Where there is none the rest of the step is read all the same;
    /// the identifier is empty then.
    pub(super) fn declared_step(&mut self, what: &str) -> Parsed<Name> {
        let missing = self.at_end()
            || matches!(
                self.peek(),
                TokenKind::Text | TokenKind::LeftBrace | TokenKind::Keyword(Keyword::Encloses)
            );
        let name = self.step_identifier(what);
        if missing {
            return Ok(Name {
                text: String::new(),
                span: self.span_here(),
            });
        }
        name
    }

    /// Reports a literal that cannot be read, which is the next token.
    fn bad_literal(&mut self, span: Span, bad: BadLiteral) {
        let diagnostic = Diagnostic::new(Rule::BadLiteral, span, bad.message).help(bad.help);
        self.fail(diagnostic);
    }

    /// `{1, 3}`.
    pub(super) fn set(&mut self) -> Parsed<Set> {
        match self.situation()? {
            Situation::Steps(set) => Ok(set),
            Situation::Initial(span) | Situation::Current(span) => {
                self.error(
                    span,
                    "a set of steps is expected here",
                    "name the steps: `{1, 3}`",
                );
                Ok(Set {
                    steps: Vec::new(),
                    span,
                })
            }
        }
    }

    /// `{1, 3}`, `{I}` or `{*}`.
    pub(super) fn situation(&mut self) -> Parsed<Situation> {
        /// What stands between the braces.
        enum Inside {
            Steps(Vec<Name>),
            Initial,
            Current,
        }
        let open = self.next_token();
        if let Err(failed) = self.expect(TokenKind::LeftBrace, "a set of steps such as `{1, 3}`")
            && !self.before_rest_of_set()
        {
            return Err(failed);
        }
        let inside = self.in_set(|parser| {
            if parser.at(TokenKind::LeftBrace) && parser.is_behind_left_brace() {
                let span = parser.span_here();
                parser.error(span, "a second `{`", "remove it");
                parser.bump();
            }
            let inside = if parser.eat(TokenKind::Star) {
                Inside::Current
            } else if parser.eat_word("I") {
                Inside::Initial
            } else if parser.at_word("INIT") {
                return Err(parser.expected_help("steps", "the initial situation is written `{I}`"));
            } else if parser.at(TokenKind::RightBrace) {
                Inside::Steps(Vec::new())
            } else {
                Inside::Steps(
                    parser.list(|parser| parser.step_identifier("a step identifier in the set"))?,
                )
            };
            parser.expect(TokenKind::RightBrace, "`,` or `}` in the set")?;
            Ok(inside)
        })?;
        let span = self.span_since(open);
        Ok(match inside {
            Inside::Steps(steps) => Situation::Steps(Set { steps, span }),
            Inside::Initial => Situation::Initial(span),
            Inside::Current => Situation::Current(span),
        })
    }

    /// Steps and a `}` follow, so that only the `{` of a set is missing.
    fn before_rest_of_set(&self) -> bool {
        let rest = (self.index..self.index + LOOKAHEAD).map(|index| self.token(index));
        let mut behind = rest.skip_while(|token| {
            let of_a_set = matches!(
                token.kind,
                TokenKind::Name | TokenKind::Number | TokenKind::Star | TokenKind::Comma
            );
            of_a_set && !token.newline
        });
        behind
            .next()
            .is_some_and(|token| token.kind == TokenKind::RightBrace && !token.newline)
    }

    /// `"text"`.
    pub(super) fn quoted(&mut self, what: &str) -> Parsed<Text> {
        let token = self.expect(TokenKind::Text, what)?;
        let text = self.text_of(token);
        let inside = text.strip_prefix('"').unwrap_or(text);
        Ok(Text {
            text: inside.strip_suffix('"').unwrap_or(inside).to_owned(),
            span: self.span_of(token),
        })
    }

    /// A level-1 text, if one stands here.
    pub(super) fn text_if_any(&mut self) -> Option<Text> {
        if self.at(TokenKind::Text) {
            self.quoted("a text").ok()
        } else {
            None
        }
    }

    /// The value of the number that comes next; nothing when it cannot be read, which is reported.
    pub(super) fn integer(&mut self) -> Option<i64> {
        self.literal(literals::integer)
    }

    /// The length of the duration that comes next, in ms; nothing when it cannot be read, which is reported.
    pub(super) fn milliseconds(&mut self) -> Option<i64> {
        self.literal(literals::duration)
    }

    fn literal(&mut self, read: fn(&str) -> Result<i64, BadLiteral>) -> Option<i64> {
        let token = self.next_token();
        let value = read(self.text_of(token))
            .map_err(|bad| self.bad_literal(self.span_of(token), bad))
            .ok();
        self.bump();
        value
    }

    /// A duration as written.
    pub(super) fn duration(&mut self, what: &str) -> Parsed<Constant> {
        const HELP: &str = "durations are written `30ms`, `2s`, `0.5 s`, `1min30s` or `T#1m30s`";
        if !self.at(TokenKind::Duration) {
            return Err(self.expected_help(what, HELP));
        }
        let span = self.span_of(self.next_token());
        let kind = self
            .milliseconds()
            .map_or(ConstantKind::Unreadable, ConstantKind::Duration);
        Ok(Constant { kind, span })
    }

    /// A constant: a number, a duration, `TRUE`, `FALSE` or the name of a `const`.
    pub(super) fn constant(&mut self, what: &str) -> Parsed<Constant> {
        let start = self.next_token();
        let negative = self.eat(TokenKind::Minus);
        let signed = |value: i64| {
            if negative {
                value.saturating_neg()
            } else {
                value
            }
        };
        let kind = match self.peek() {
            TokenKind::Number => self
                .integer()
                .map(signed)
                .map_or(ConstantKind::Unreadable, ConstantKind::Integer),
            TokenKind::Duration => self
                .milliseconds()
                .map(signed)
                .map_or(ConstantKind::Unreadable, ConstantKind::Duration),
            TokenKind::Name => ConstantKind::Name(self.name(what)?, negative),
            TokenKind::True | TokenKind::False if !negative => {
                ConstantKind::Bool(self.bump().kind == TokenKind::True)
            }
            _ => return Err(self.expected(what)),
        };
        Ok(Constant {
            kind,
            span: self.span_since(start),
        })
    }
}
