//! What stands in a file: imports, the application, options, instances and everything else by name.

use crate::ast::{Binding, BindingTarget, File, Instance, Item, Name, ScanOption};
use crate::diagnostic::{Diagnostic, Rule};
use crate::lexer::token::{Keyword, Token, TokenKind};
use crate::source::Span;

use super::cursor::{Failed, Parsed, Parser};
use super::graphs::ADVICE;
use super::recovery::Room;

/// What may stand in a file.
const WHAT: &str = "a declaration, a graph, a plant, a property or a test";

/// Where the parts of a graph stand.
const INSIDE: &str =
    "steps, transitions and stand-alone actions stand inside a graph: `graph G { .. }`";

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
            if self.goes_on(&mut file) {
                continue;
            }
            match self.file_part(&mut file) {
                Ok(()) => {
                    self.end_statement(ADVICE);
                }
                Err(_) => self.recover(),
            }
            // Whatever happened, something is taken: the file comes to its end.
            if self.next_token().start == token.start && !self.at(TokenKind::EndOfFile) {
                self.bump();
            }
        }
    }

    /// What belongs to a graph or a test, right behind one: a `}` closed it too early. It is taken as part of it, so
    /// that nothing else is said of it.
    fn goes_on(&mut self, file: &mut File) -> bool {
        let message = format!("expected {WHAT}, found {}", self.found());
        let here = self.span_here();
        let closed = |span: Span| Span {
            start: span.end.saturating_sub(1),
            ..span
        };
        let diagnostic = Diagnostic::new(Rule::Syntax, here, message);
        match (self.peek(), file.items.last_mut()) {
            (
                TokenKind::Keyword(word),
                Some(Item::Graph(graph) | Item::Template(graph) | Item::Plant(graph)),
            ) if word.begins_graph_part_only() => {
                let what = format!("`{}` is closed here", graph.name.text);
                self.push(diagnostic.label(closed(graph.span), what).help(INSIDE));
                self.graph_goes_on(graph);
                true
            }
            (TokenKind::Name, Some(Item::Test(test))) if self.at_test_step() => {
                let what = "the test is closed here";
                self.push(diagnostic.label(closed(test.span), what));
                self.test_goes_on(test);
                true
            }
            _ => false,
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
                let name = self.graph_name("the name of the graph")?;
                if matches!(self.peek(), TokenKind::Equal | TokenKind::Assign) {
                    return self.instance(name, start).map(Item::Instance);
                }
                self.graph_body(name, start).map(Item::Graph)
            }
            Keyword::Template => {
                self.bump();
                let name = self.graph_name("the name of the template")?;
                self.graph_body(name, start).map(Item::Template)
            }
            Keyword::Plant => {
                self.bump();
                let name = self.graph_name("the name of the plant")?;
                self.graph_body(name, start).map(Item::Plant)
            }
            Keyword::Property => self.property().map(Item::Property),
            Keyword::Test => self.test().map(Item::Test),
            _ => Err(self.item_missing()),
        }
    }

    /// The name of a graph. Where there is none the rest is read all the same; the name is empty then.
    fn graph_name(&mut self, what: &str) -> Parsed<Name> {
        if matches!(self.peek(), TokenKind::Text | TokenKind::LeftBrace) {
            self.expected(what);
            return Ok(Name {
                text: String::new(),
                span: self.span_here(),
            });
        }
        self.declared_name(what)
    }

    fn item_missing(&mut self) -> Failed {
        match self.peek() {
            TokenKind::Keyword(word) if word.begins_graph_part_only() => {
                self.expected_help(WHAT, INSIDE)
            }
            _ => self.expected(WHAT),
        }
    }

    /// `= T { a at %IX0.0; b = c }` behind `graph G`.
    fn instance(&mut self, name: Name, start: Token) -> Parsed<Instance> {
        self.equals();
        let template = self.name("the name of a template")?;
        let room = Room {
            name: "this instance",
            advice: "separate bindings by `;` or a new line",
            is_foreign: |word| word.begins_element(),
            keeps_unfinished: true,
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
