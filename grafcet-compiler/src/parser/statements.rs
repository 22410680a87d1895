//! Actions: blocks and the statements in them.

use crate::ast::{Block, Event, Expression, Statement, StatementKind};
use crate::diagnostic::{Diagnostic, Rule};
use crate::lexer::token::{Keyword, TokenKind};

use super::cursor::{Context, Failed, Parsed, Parser};
use super::recovery::Room;

/// Where a block stands; it decides which statements may stand in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// The action of a step.
    Step,
    /// A stand-alone action.
    Always,
    /// Behind the `do` of a transition.
    Do,
    /// Behind an `on`.
    On,
}

impl Parser<'_> {
    /// `{ .. }` with statements. Errors in it are dealt with inside.
    pub(super) fn block(&mut self, place: Place) -> Parsed<Block> {
        let start = self.next_token();
        let room = Room {
            name: "this action",
            advice: "separate statements by `;` or a new line",
            is_foreign: |word| word.begins_element(),
            keeps_unfinished: false,
        };
        let statements = self.room(&room, |parser| parser.statement(place))?;
        Ok(Block {
            statements,
            span: self.span_since(start),
        })
    }

    /// One statement that may stand in such a place.
    fn statement(&mut self, place: Place) -> Parsed<Statement> {
        let start = self.next_token();
        let kind = match self.peek() {
            TokenKind::Text => StatementKind::Text(self.quoted("a text")?),
            TokenKind::Keyword(Keyword::On) if !self.names_something() => self.nested(Self::on)?,
            TokenKind::Name
                if self.text_of(start) == "F" && self.peek_second() == TokenKind::Slash =>
            {
                self.force()?
            }
            TokenKind::If if !self.names_something() => {
                return Err(self.expected_help(
                    "a statement",
                    "the action stands in front of its condition: `A IF c`, `a = 1 IF c`",
                ));
            }
            TokenKind::Not => {
                return Err(self.expected_help(
                    "a statement",
                    "a momentary action makes a variable True while it lasts; to store False write `a = False`",
                ));
            }
            _ => self.assignment()?,
        };
        let statement = Statement {
            kind,
            span: self.span_since(start),
        };
        self.allowed(&statement, place)?;
        Ok(statement)
    }

    /// The reserved word that comes next is used as a name: it is reported as such where it is read.
    fn names_something(&self) -> bool {
        matches!(
            self.peek_second(),
            TokenKind::Equal
                | TokenKind::Assign
                | TokenKind::If
                | TokenKind::Comma
                | TokenKind::Semicolon
                | TokenKind::RightBrace
                | TokenKind::LineEnd
                | TokenKind::EndOfFile
        )
    }

    /// Reports a statement that may not stand where it stands.
    fn allowed(&mut self, statement: &Statement, place: Place) -> Parsed<()> {
        let (message, help) = match (&statement.kind, place) {
            (StatementKind::On { .. }, Place::Step)
            | (StatementKind::Stored { .. } | StatementKind::Text(_), _) => {
                return Ok(());
            }
            (_, Place::Step | Place::Always)
                if !matches!(statement.kind, StatementKind::On { .. }) =>
            {
                return Ok(());
            }
            (StatementKind::On { .. }, Place::Do) => (
                "a `do` block holds stored statements without `on`",
                "write the stored statement alone: it runs when the transition fires",
            ),
            (StatementKind::On { .. }, Place::On) => (
                "an `on` stands inside another `on`",
                "write the two one behind the other in the step",
            ),
            (StatementKind::On { .. }, _) => (
                "`on` stands in a stand-alone action",
                "`on` belongs to a step; here write `a = e IF ↑c`",
            ),
            (StatementKind::Force { .. }, Place::Do) => (
                "a forcing order stands in a `do` block",
                "force from a step or a stand-alone action: `F/G:{I} IF ↑X3`",
            ),
            (StatementKind::Force { .. }, _) => (
                "a forcing order stands under `on`",
                "write the order with an edge as its condition: `F/G:{I} IF ↑X3`",
            ),
            (StatementKind::Momentary { .. }, Place::Do) => (
                "a momentary statement stands in a `do` block",
                "a `do` block holds stored statements: `a = True`",
            ),
            (StatementKind::Momentary { .. }, _) => (
                "a momentary statement stands under `on`",
                "`on` holds stored statements: `a = True`",
            ),
        };
        self.error(statement.span, message, help);
        Err(Failed)
    }

    /// `IF c`, if it stands here.
    fn condition(&mut self) -> Parsed<Option<Expression>> {
        if self.eat(TokenKind::If) {
            self.expression().map(Some)
        } else {
            Ok(None)
        }
    }

    /// `A, B IF c` or `a = e IF c`.
    fn assignment(&mut self) -> Parsed<StatementKind> {
        let target = self.reference("a statement")?;
        if matches!(self.peek(), TokenKind::Equal | TokenKind::Assign) {
            self.bump();
            let value = self.expression()?;
            let condition = self.condition()?;
            return Ok(StatementKind::Stored {
                target,
                value,
                condition,
            });
        }
        let mut targets = vec![target];
        while self.eat(TokenKind::Comma) {
            targets.push(self.reference("a variable behind `,`")?);
        }
        if matches!(self.peek(), TokenKind::Equal | TokenKind::Assign) {
            let message = "a value is stored in several variables at once";
            let diagnostic = Diagnostic::new(Rule::Syntax, self.span_here(), message)
                .help("store it by one statement for each variable: `a = 1; b = 1`");
            return Err(self.fail(diagnostic));
        }
        let condition = self.condition()?;
        Ok(StatementKind::Momentary { targets, condition })
    }

    /// `F/G:{1,2} IF c`.
    fn force(&mut self) -> Parsed<StatementKind> {
        const SHAPE: &str =
            "an order is written `F/Graph:{1, 3}`, `F/Graph:{I}`, `F/Graph:{*}` or `F/Graph:{}`";
        self.bump();
        self.bump();
        let graph = self.name("the name of a graph behind `F/`")?;
        if !self.eat(TokenKind::Colon) {
            return Err(self.expected_help("`:` behind the name of the graph", SHAPE));
        }
        if !self.at(TokenKind::LeftBrace) {
            self.expected_help("a set of steps", SHAPE);
        }
        let situation = self.situation()?;
        let condition = self.condition()?;
        Ok(StatementKind::Force {
            graph,
            situation,
            condition,
        })
    }

    /// `on activation: ..`, `on event e { .. }`.
    fn on(&mut self) -> Parsed<StatementKind> {
        self.bump();
        let event = if self.eat_word("activation") {
            Event::Activation
        } else if self.eat_word("deactivation") {
            Event::Deactivation
        } else if self.eat_word("event") {
            let context = Context {
                colon_ends: true,
                ..self.context
            };
            Event::Expression(self.within(context, Self::expression)?)
        } else {
            return Err(self.expected("`activation`, `deactivation` or `event` behind `on`"));
        };
        if self.at(TokenKind::LeftBrace) {
            let statements = self.block(Place::On)?.statements;
            return Ok(StatementKind::On { event, statements });
        }
        if !self.eat(TokenKind::Colon) {
            return Err(self.expected_help(
                "`:` or `{` behind the event",
                "write `on activation: a = 1` or `on activation { .. }`; a name `G:a` in an event stands in parentheses",
            ));
        }
        let statements = vec![self.statement(Place::On)?];
        Ok(StatementKind::On { event, statements })
    }
}
