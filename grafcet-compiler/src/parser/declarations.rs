//! Declarations of inputs, outputs, variables, parameters and constants.

use crate::ast::{Declaration, DeclarationKind, Type};
use crate::lexer::token::{Keyword, TokenKind};
use crate::source::Span;

use super::cursor::{Parsed, Parser};

impl Parser<'_> {
    /// A declaration. What is right in front of an error is kept, so that its names are known.
    pub(super) fn declaration(&mut self) -> Parsed<Declaration> {
        let start = self.next_token();
        let kind = self.declaration_kind()?;
        let names = match self.peek() {
            // The rest is read all the same.
            TokenKind::Colon | TokenKind::Equal | TokenKind::Text => {
                self.expected("a name");
                Vec::new()
            }
            TokenKind::Keyword(Keyword::At) if self.peek_second() == TokenKind::Address => {
                self.expected("a name");
                Vec::new()
            }
            _ => self.list(|parser| parser.declared_name("a name"))?,
        };
        let mut declaration = Declaration {
            kind,
            names,
            ty: None,
            address: None,
            initial: None,
            range: None,
            text: None,
            doubtful: false,
            span: self.span_since(start),
        };
        let read = self.clauses(&mut declaration);
        declaration.span = self.span_since(start);
        if read.is_ok() {
            self.check_shape(&declaration);
        }
        // What a declaration says where it cannot be read may be its type.
        declaration.doubtful = declaration.ty.is_none() && !self.at_end();
        if read.is_err() {
            self.recover();
        }
        Ok(declaration)
    }

    fn declaration_kind(&mut self) -> Parsed<DeclarationKind> {
        let kind = match self.bump().kind {
            TokenKind::Keyword(Keyword::Input) => DeclarationKind::Input,
            TokenKind::Keyword(Keyword::Output) => DeclarationKind::Output,
            TokenKind::Keyword(Keyword::Parameter) => DeclarationKind::Parameter,
            TokenKind::Keyword(Keyword::Const) => DeclarationKind::Constant,
            TokenKind::Keyword(Keyword::Retain) => {
                if !self.eat(TokenKind::Keyword(Keyword::Var)) {
                    return Err(self.expected_help(
                        "`var` behind `retain`",
                        "only variables are declared `retain`; parameters are retained anyway",
                    ));
                }
                DeclarationKind::Variable { retain: true }
            }
            _ => DeclarationKind::Variable { retain: false },
        };
        Ok(kind)
    }

    /// What follows the names. Parts in the wrong order are reported and taken.
    fn clauses(&mut self, declaration: &mut Declaration) -> Parsed<()> {
        let mut latest = 0;
        loop {
            let start = self.next_token();
            let place = match self.peek() {
                TokenKind::Colon => 1,
                TokenKind::Keyword(Keyword::At) => 2,
                TokenKind::Equal | TokenKind::Assign => 3,
                TokenKind::Keyword(Keyword::In) => 4,
                TokenKind::Text => 5,
                _ => return Ok(()),
            };
            if place <= latest {
                self.error(
                    self.span_of(start),
                    format!("{} stands in the wrong place", self.found()),
                    "the order is `: type at %ADDRESS = value in low..high \"text\"`, each once",
                );
            }
            latest = latest.max(place);
            self.clause(declaration)?;
        }
    }

    fn clause(&mut self, declaration: &mut Declaration) -> Parsed<()> {
        match self.peek() {
            TokenKind::Colon => {
                self.bump();
                declaration.ty = Some(self.type_name()?);
            }
            TokenKind::Keyword(Keyword::At) => {
                self.bump();
                declaration.address = Some(self.address()?);
            }
            TokenKind::Equal | TokenKind::Assign => {
                self.equals();
                declaration.initial = Some(self.constant("a constant behind `=`")?);
            }
            TokenKind::Keyword(Keyword::In) => {
                self.bump();
                let low = self.constant("the low end of the range")?;
                if !self.eat(TokenKind::Range) {
                    return Err(self.expected_help("`..`", "a range is written `in 0..100`"));
                }
                let high = self.constant("the high end of the range")?;
                declaration.range = Some((low, high));
            }
            _ => declaration.text = Some(self.quoted("a text")?),
        }
        Ok(())
    }

    /// Takes `=`; a `:=` in its place is refused.
    pub(super) fn equals(&mut self) {
        if self.at(TokenKind::Assign) {
            let span = self.span_here();
            self.error(span, "`:=` stands only in a stored statement", "write `=`");
        }
        self.bump();
    }

    /// An address as written.
    pub(super) fn address(&mut self) -> Parsed<crate::ast::Name> {
        if !self.at(TokenKind::Address) {
            return Err(self.expected_help(
                "an address behind `at`",
                "addresses are written `%IX0.0`, `%QX0.0`, `%MW0`",
            ));
        }
        let token = self.bump();
        Ok(self.name_of(token))
    }

    fn type_name(&mut self) -> Parsed<(Type, Span)> {
        let token = self.next_token();
        let word = self.text_of(token);
        let ty = match word {
            "bool" => Type::Bool,
            "int" => Type::Int,
            "time" => Type::Time,
            _ => {
                let lower = word.to_lowercase();
                let help = match lower.as_str() {
                    "bool" | "int" | "time" => format!("write `{lower}`"),
                    "boolean" | "bit" => "write `bool`".to_owned(),
                    "real" | "float" | "lreal" | "double" => {
                        "numbers are whole: scale to an `int`, such as tenths of a degree"
                            .to_owned()
                    }
                    "integer" | "dint" | "uint" | "sint" | "word" | "dword" | "i32" => {
                        "write `int`".to_owned()
                    }
                    _ => "the types are `bool`, `int` and `time`".to_owned(),
                };
                return Err(self.expected_help("a type", help));
            }
        };
        self.bump();
        Ok((ty, self.span_of(token)))
    }

    /// What the grammar says beside its productions: `at` and `=` only with a single name, inputs take no `=`.
    fn check_shape(&mut self, declaration: &Declaration) {
        let several = declaration.names.len() > 1;
        if declaration.kind == DeclarationKind::Constant && declaration.initial.is_none() {
            self.error(
                declaration.span,
                "a constant has no value",
                "write `const name = value`",
            );
        }
        if let Some(address) = declaration.address.as_ref().filter(|_| several) {
            self.error(
                address.span,
                "several names share one address",
                "declare each name with its own address",
            );
        }
        if let Some(initial) = &declaration.initial {
            if declaration.kind == DeclarationKind::Input {
                self.error(
                    initial.span,
                    "an input has no value of its own",
                    "the machine or a test gives an input its value; for a fixed value declare a `const`",
                );
            } else if several {
                self.error(
                    initial.span,
                    "several names share one value",
                    "declare each name with its own value",
                );
            }
        }
    }
}
