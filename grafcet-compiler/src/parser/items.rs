//! What stands in a file: imports, the application, options, instances and everything else by name.

use crate::ast::{Binding, BindingTarget, File, Instance, Item, ScanOption};
use crate::diagnostic::{Diagnostic, Rule};
use crate::lexer::token::{Keyword, Token, TokenKind};

use super::cursor::{Failed, Parsed, Parser};
use super::graphs::ADVICE;
use super::recovery::Room;

/// What may stand in a file.
const WHAT: &str = "a declaration, a graph, a plant, a property or a test";

impl Parser<'_> {
    /// The whole file.
    pub(super) fn file(mut self) -> File {
        let mut file = File::default();
        loop {
            self.next_statement();
            let token = self.next_token();
            match self.peek() {
                TokenKind::EndOfFile => return file,
                TokenKind::RightBrace => {
                    self.error(
                        self.span_of(token),
                        "this `}` closes nothing",
                        "remove it, or open a `{` before it",
                    );
                    self.bump();
                    continue;
                }
                _ => {}
            }
            match self.file_part(&mut file) {
                Ok(()) => self.end_statement(ADVICE),
                Err(_) => self.recover(),
            }
            // Whatever happened, something is taken: the file comes to its end.
            if self.next_token().start == token.start && !self.at(TokenKind::EndOfFile) {
                self.bump();
            }
        }
    }

    /// One import, option or item.
    fn file_part(&mut self, file: &mut File) -> Parsed<()> {
        let start = self.next_token();
        let Some(word) = self.element_word(WHAT) else {
            return Err(self.item_missing());
        };
        match word {
            Keyword::Import => {
                self.bump();
                let path = self.quoted("the path of a file in quotation marks")?;
                if file.application.is_some() || !file.options.is_empty() || !file.items.is_empty()
                {
                    let span = self.span_since(start);
                    self.error(
                        span,
                        "an import stands behind other elements",
                        "imports stand first in a file",
                    );
                }
                file.imports.push(path);
            }
            Keyword::Application => self.application(file, start)?,
            Keyword::Scan | Keyword::Evolution => {
                let option = self.option(word, start)?;
                file.options.push(option);
            }
            _ => {
                let item = self.item(word, start)?;
                file.items.push(item);
            }
        }
        Ok(())
    }

    fn application(&mut self, file: &mut File, start: Token) -> Parsed<()> {
        self.bump();
        let name = self.declared_name("the name of the application")?;
        let text = self.text_if_any();
        let span = self.span_since(start);
        if let Some((first, _)) = &file.application {
            self.push(
                Diagnostic::new(Rule::Syntax, span, "the application is named twice")
                    .label(first.span, "named here first")
                    .help("remove one of the two"),
            );
            return Ok(());
        }
        if !file.options.is_empty() || !file.items.is_empty() {
            self.error(
                span,
                "`application` stands behind other elements",
                "the application is named in front of everything but imports",
            );
        }
        file.application = Some((name, text));
        Ok(())
    }

    fn option(&mut self, word: Keyword, start: Token) -> Parsed<ScanOption> {
        self.bump();
        if word == Keyword::Scan {
            return Ok(ScanOption::Period(self.duration("the scan period")?));
        }
        let stable = self.eat_word("stable");
        if !stable && !self.eat(TokenKind::Keyword(Keyword::Scan)) {
            return Err(self.expected("`scan` or `stable` behind `evolution`"));
        }
        let span = self.span_since(start);
        Ok(ScanOption::Evolution { stable, span })
    }

    fn item(&mut self, word: Keyword, start: Token) -> Parsed<Item> {
        match word {
            Keyword::Input
            | Keyword::Output
            | Keyword::Retain
            | Keyword::Var
            | Keyword::Parameter
            | Keyword::Const => self.declaration().map(Item::Declaration),
            Keyword::Graph => {
                self.bump();
                let name = self.declared_name("the name of the graph")?;
                if matches!(self.peek(), TokenKind::Equal | TokenKind::Assign) {
                    return self.instance(name, start).map(Item::Instance);
                }
                self.graph_body(name, start).map(Item::Graph)
            }
            Keyword::Template => {
                self.bump();
                let name = self.declared_name("the name of the template")?;
                self.graph_body(name, start).map(Item::Template)
            }
            Keyword::Plant => {
                self.bump();
                let name = self.declared_name("the name of the plant")?;
                self.graph_body(name, start).map(Item::Plant)
            }
            Keyword::Property => self.property().map(Item::Property),
            Keyword::Test => self.test().map(Item::Test),
            _ => Err(self.item_missing()),
        }
    }

    fn item_missing(&mut self) -> Failed {
        match self.peek() {
            TokenKind::Keyword(
                Keyword::Initial
                | Keyword::Step
                | Keyword::Macro
                | Keyword::Entry
                | Keyword::Exit
                | Keyword::Transition
                | Keyword::Always,
            ) => self.expected_help(
                WHAT,
                "steps, transitions and stand-alone actions stand inside a graph: `graph G { .. }`",
            ),
            _ => self.expected(WHAT),
        }
    }

    /// `= T { a at %IX0.0; b = c }` behind `graph G`.
    fn instance(&mut self, name: crate::ast::Name, start: Token) -> Parsed<Instance> {
        self.equals();
        let template = self.name("the name of a template")?;
        let room = Room {
            name: "this instance",
            advice: "separate bindings by `;` or a new line",
            is_foreign: |word| word.begins_element(),
        };
        let bindings = if self.at(TokenKind::LeftBrace) {
            self.room(&room, Self::binding)?
        } else {
            Vec::new()
        };
        Ok(Instance {
            name,
            template,
            bindings,
            span: self.span_since(start),
        })
    }

    fn binding(&mut self) -> Parsed<Binding> {
        let start = self.next_token();
        let name = self.name("a name of the template's interface")?;
        let to = match self.peek() {
            TokenKind::Keyword(Keyword::At) => {
                self.bump();
                BindingTarget::Address(self.address()?)
            }
            TokenKind::Equal | TokenKind::Assign => {
                self.equals();
                BindingTarget::Expression(self.expression()?)
            }
            _ => {
                return Err(self.expected_help(
                    "`at` or `=` behind the interface name",
                    "bind it to an address, `a at %IX0.0`, or to an expression, `a = b`",
                ));
            }
        };
        Ok(Binding {
            name,
            to,
            span: self.span_since(start),
        })
    }
}
