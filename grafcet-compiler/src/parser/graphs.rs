//! Graphs, templates and plants: steps, macro steps, transitions, stand-alone actions.

use crate::ast::{Always, Element, Graph, Macro, Name, Step, StepRole, Transition, Trigger};
use crate::diagnostic::{Diagnostic, Rule};
use crate::lexer::token::{Keyword, TokenKind};
use crate::literals;

use super::cursor::{Failed, Parsed, Parser};
use super::recovery::{LOOKAHEAD, Room};
use super::statements::Place;

/// How elements are kept apart.
pub(super) const ADVICE: &str = "every element begins on a new line or behind `;`";

const SHAPE: &str = "a transition is written `transition 7: 3, 4 -> 5 when a`";

/// What a body belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Body {
    Graph,
    Macro,
}

impl Body {
    /// What may stand in it.
    fn parts(self) -> &'static str {
        match self {
            Body::Graph => "a declaration, a step, a transition or `always`",
            Body::Macro => "a step or a transition",
        }
    }
}

/// The braces of a graph or of an expansion.
fn body_of(owner: &str) -> Room<'_> {
    Room {
        name: owner,
        advice: ADVICE,
        is_foreign: Keyword::begins_item_only,
        keeps_unfinished: true,
    }
}

impl Parser<'_> {
    /// `"text" { .. }` behind the name of a graph, a template or a plant.
    pub(super) fn graph_body(
        &mut self,
        name: Name,
        start: crate::lexer::token::Token,
    ) -> Parsed<Graph> {
        let text = self.text_if_any();
        let elements = self.body(Body::Graph, &format!("`{}`", name.text))?;
        Ok(Graph {
            name,
            text,
            elements,
            span: self.span_since(start),
        })
    }

    /// Takes what stands behind a graph as part of it, up to the next `}` or to something else.
    pub(super) fn graph_goes_on(&mut self, graph: &mut Graph) {
        let mut read = |parser: &mut Self| parser.element(Body::Graph);
        let more = self.parts(&body_of(&graph.name.text), None, &mut read);
        graph.elements.extend(more);
    }

    /// `{ .. }` with elements. Errors in it are dealt with inside.
    fn body(&mut self, body: Body, owner: &str) -> Parsed<Vec<Element>> {
        self.room(&body_of(owner), |parser| parser.element(body))
    }

    fn element(&mut self, body: Body) -> Parsed<Element> {
        let start = self.next_token();
        let Some(word) = self.element_word(body.parts()) else {
            return Err(self.element_missing(body));
        };
        match word {
            Keyword::Input
            | Keyword::Output
            | Keyword::Retain
            | Keyword::Var
            | Keyword::Parameter
            | Keyword::Const
            | Keyword::Always
                if body == Body::Macro =>
            {
                Err(self.expected_help(
                    "a step or a transition",
                    "declarations and stand-alone actions stand in the graph, in front of its steps",
                ))
            }
            Keyword::Input
            | Keyword::Output
            | Keyword::Retain
            | Keyword::Var
            | Keyword::Parameter
            | Keyword::Const => self.declaration().map(Element::Declaration),
            Keyword::Always => {
                self.bump();
                let text = self.text_if_any();
                let block = self.block(Place::Always)?;
                let span = self.span_since(start);
                Ok(Element::Always(Always { text, block, span }))
            }
            Keyword::Initial | Keyword::Step => self.step(StepRole::Plain).map(Element::Step),
            Keyword::Entry => self.step(StepRole::Entry).map(Element::Step),
            Keyword::Exit => self.step(StepRole::Exit).map(Element::Step),
            Keyword::Macro => self.nested(Self::macro_step).map(Element::Macro),
            Keyword::Transition => self.transition().map(Element::Transition),
            _ => Err(self.element_missing(body)),
        }
        .inspect(|element| {
            if let (Body::Graph, Element::Step(step)) = (body, element)
                && step.role != StepRole::Plain
            {
                let message = format!("`{}` stands outside a macro step", self.text_of(start));
                self.error(self.span_of(start), message, "entry and exit steps belong to the expansion of a macro step");
            }
        })
    }

    fn element_missing(&mut self, body: Body) -> Failed {
        match self.peek() {
            TokenKind::Name | TokenKind::Text => self.expected_help(
                body.parts(),
                "what is done stands in the braces of a step or of `always`",
            ),
            _ => self.expected(body.parts()),
        }
    }

    /// `initial step 3 "text" encloses G{1} { .. }`, with `entry` or `exit` in front in an expansion.
    fn step(&mut self, role: StepRole) -> Parsed<Step> {
        let start = self.next_token();
        if role != StepRole::Plain {
            self.bump();
        }
        let initial = self.eat(TokenKind::Keyword(Keyword::Initial));
        self.expect(TokenKind::Keyword(Keyword::Step), "`step`")?;
        let mut step = Step {
            initial,
            role,
            id: self.declared_step("a step identifier")?,
            text: None,
            encloses: Vec::new(),
            block: None,
            span: self.span_since(start),
        };
        if self.step_rest(&mut step).is_err() {
            self.recover();
        }
        step.span = self.span_since(start);
        Ok(step)
    }

    fn step_rest(&mut self, step: &mut Step) -> Parsed<()> {
        const BRACES: &str = "the action of a step stands in braces: `step 3 { A }`";
        step.text = self.text_if_any();
        if self.eat(TokenKind::Keyword(Keyword::Encloses)) {
            step.encloses = self.list(|parser| {
                let graph = parser.name("the name of a graph")?;
                let set = parser.set()?;
                Ok((graph, set))
            })?;
        }
        if self.at(TokenKind::Colon) {
            let span = self.span_here();
            self.error(span, "`:` stands behind a step", BRACES);
            self.bump();
            if !self.at(TokenKind::LeftBrace) {
                return Err(Failed);
            }
        }
        if self.at(TokenKind::LeftBrace) {
            step.block = Some(self.block(Place::Step)?);
        } else if self.at(TokenKind::Name) {
            self.expected_help("`{` and the action of the step", BRACES);
            step.block = Some(self.block(Place::Step)?);
        }
        Ok(())
    }

    /// `macro step M5 "text" { .. }`.
    fn macro_step(&mut self) -> Parsed<Macro> {
        let start = self.bump();
        const STEP: TokenKind = TokenKind::Keyword(Keyword::Step);
        if self.expect(STEP, "`step` behind `macro`").is_err() && self.peek_second() == STEP {
            self.bump();
            self.bump();
        }
        let id = self.declared_step("the identifier of the macro step")?;
        let text = self.text_if_any();
        let elements = self.body(Body::Macro, &format!("macro step `{}`", id.text))?;
        Ok(Macro {
            id,
            text,
            elements,
            span: self.span_since(start),
        })
    }

    /// `transition 7 "text": 3, 4 -> 5 when .. do { .. }`.
    fn transition(&mut self) -> Parsed<Transition> {
        let start = self.bump();
        if !matches!(self.peek(), TokenKind::Number | TokenKind::Duration) {
            return Err(self.expected_help("the number of the transition", SHAPE));
        }
        let number = self.transition_number();
        let text = self.text_if_any();
        if !self.eat(TokenKind::Colon) {
            return Err(self.expected_help("`:` behind the transition's number", SHAPE));
        }
        let entrance = self.steps("a step identifier in front of the arrow")?;
        self.arrow()?;
        let exit = self.steps("a step identifier behind the arrow")?;
        let mut transition = Transition {
            number,
            text,
            entrance,
            exit,
            trigger: Trigger::AlwaysTrue,
            action: None,
            span: self.span_since(start),
        };
        if self.transition_rest(&mut transition).is_err() {
            self.recover();
        }
        transition.span = self.span_since(start);
        Ok(transition)
    }

    /// Digits without leading zeros; anything else is reported and taken as it was meant.
    fn transition_number(&mut self) -> Name {
        let token = self.next_token();
        let mut number = self.name_of(token);
        let checked = literals::step_identifier(&number.text);
        if let Err((_, meant)) = checked {
            let message = format!(
                "`{}` is not the number of a transition",
                literals::shortened(&number.text)
            );
            let diagnostic = Diagnostic::new(Rule::BadLiteral, number.span, message).help(
                "transitions are numbered by digits without leading zeros: `transition 7: ..`",
            );
            self.fail(diagnostic);
            number.text = meant.unwrap_or(number.text);
        }
        self.bump();
        number
    }

    /// Step identifiers with commas between them, or none.
    fn steps(&mut self, what: &str) -> Parsed<Vec<Name>> {
        let none = self.at_end()
            || matches!(
                self.peek(),
                TokenKind::Arrow
                    | TokenKind::FatArrow
                    | TokenKind::If
                    | TokenKind::Keyword(Keyword::When | Keyword::Do)
            );
        if none {
            Ok(Vec::new())
        } else {
            self.list(|parser| parser.step_identifier(what))
        }
    }

    fn arrow(&mut self) -> Parsed<()> {
        if self.at(TokenKind::FatArrow) {
            let span = self.span_here();
            self.error(span, "`=>` is not the arrow of a transition", "write `->`");
            self.bump();
            return Ok(());
        }
        if self.eat(TokenKind::Arrow) {
            return Ok(());
        }
        Err(self.expected_help("`->` between the steps of the transition", SHAPE))
    }

    fn transition_rest(&mut self, transition: &mut Transition) -> Parsed<()> {
        let trigger_follows = !self.at_end() && !self.at(TokenKind::Keyword(Keyword::Do));
        if trigger_follows {
            if self.at(TokenKind::If) {
                let span = self.span_here();
                self.error(span, "a trigger does not begin with `IF`", "write `when`");
                self.bump();
            } else if !self.eat(TokenKind::Keyword(Keyword::When)) {
                let in_line = (self.index..self.index + LOOKAHEAD).map(|index| self.token(index));
                let mut in_line = in_line
                    .take_while(|token| !token.newline && token.kind != TokenKind::EndOfFile);
                let when =
                    in_line.position(|token| token.kind == TokenKind::Keyword(Keyword::When));
                if self.at(TokenKind::LeftBrace) {
                    return Err(self.expected_help(
                        "`when` or `do`",
                        "what a transition stores stands behind `do`",
                    ));
                }
                let help = "the trigger of a transition begins with `when`";
                self.expected_help("`when`", help);
                self.index += when.map_or(0, |ahead| ahead + 1);
            }
            transition.trigger = self.trigger()?;
            if !self.at_end() && !self.at(TokenKind::Keyword(Keyword::Do)) {
                // What it would have been is not known.
                transition.trigger = Trigger::AlwaysTrue;
            }
        }
        if self.eat(TokenKind::Keyword(Keyword::Do)) {
            transition.action = Some(self.block(Place::Do)?);
        }
        Ok(())
    }

    /// What stands behind `when`.
    fn trigger(&mut self) -> Parsed<Trigger> {
        if self.at(TokenKind::Keyword(Keyword::When)) {
            self.expected("a trigger");
            self.bump();
        }
        if self.at(TokenKind::Text) {
            return Ok(Trigger::Text(self.quoted("a text")?));
        }
        if self.at(TokenKind::Equal)
            && self.peek_second() == TokenKind::Number
            && self.text_of_second() == "1"
        {
            self.bump();
            self.bump();
            return Ok(Trigger::AlwaysTrue);
        }
        if self.at_end() || self.at(TokenKind::Keyword(Keyword::Do)) {
            return Err(self.expected_help(
                "a trigger behind `when`",
                "a line may break before `when`, not behind it; without `when` the trigger is always True",
            ));
        }
        self.expression().map(Trigger::Expression)
    }
}
