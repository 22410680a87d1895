//! Properties and tests.

use crate::ast::{Property, PropertyKind, Test, TestStep, TestStepKind};
use crate::lexer::token::{Keyword, TokenKind};

use super::cursor::{Failed, Parsed, Parser};
use super::recovery::Room;

/// The braces of a test.
const STEPS: Room = Room {
    name: "this test",
    advice: "separate the steps of a test by `;` or a new line",
    is_foreign: |word| word.begins_element() && word != Keyword::Always,
    keeps_unfinished: false,
};

impl Parser<'_> {
    /// `property "text": never e`.
    pub(super) fn property(&mut self) -> Parsed<Property> {
        let start = self.bump();
        let text = self.quoted("what the property says, in quotation marks")?;
        self.expect(TokenKind::Colon, "`:` behind the text of the property")?;
        let kind = if self.eat(TokenKind::Keyword(Keyword::Always)) {
            PropertyKind::Always(self.expression()?)
        } else if self.eat_word("never") {
            PropertyKind::Never(self.expression()?)
        } else if self.eat_word("reachable") {
            PropertyKind::Reachable(self.expression()?)
        } else if self.eat_word("recoverable") {
            PropertyKind::Recoverable(self.expression()?)
        } else if self.eat_word("after") {
            let trigger = self.expression()?;
            self.expect_word("within")?;
            let within = self.duration("a duration behind `within`")?;
            self.expect_word("expect")?;
            PropertyKind::After {
                trigger,
                within,
                expect: self.expression()?,
            }
        } else {
            return Err(self.expected("`never`, `always`, `reachable`, `recoverable` or `after`"));
        };
        Ok(Property {
            text,
            kind,
            span: self.span_since(start),
        })
    }

    /// `test "text" with A, B { .. }`.
    pub(super) fn test(&mut self) -> Parsed<Test> {
        let start = self.bump();
        let text = self.quoted("what the test claims, in quotation marks")?;
        let mut test = Test {
            text,
            plants: Vec::new(),
            steps: Vec::new(),
            span: self.span_since(start),
        };
        let with = self.eat_word("with");
        if !with && self.at(TokenKind::Name) {
            self.expected("`with` or `{`");
        }
        if with || self.at(TokenKind::Name) {
            test.plants = self.list(|parser| parser.name("the name of a plant"))?;
        }
        test.steps = self.room(&STEPS, Self::test_step)?;
        test.span = self.span_since(start);
        Ok(test)
    }

    /// Takes what stands behind a test as part of it, up to the next `}` or to something else.
    pub(super) fn test_goes_on(&mut self, test: &mut Test) {
        let more = self.parts(&STEPS, None, &mut Self::test_step);
        test.steps.extend(more);
    }

    /// A word that begins a step of a test comes next.
    pub(super) fn at_test_step(&self) -> bool {
        const WORDS: [&str; 8] = [
            "set", "clear", "release", "pulse", "wait", "expect", "never", "power",
        ];
        WORDS.into_iter().any(|word| self.at_word(word))
    }

    fn test_step(&mut self) -> Parsed<TestStep> {
        let start = self.next_token();
        let kind = self.test_step_kind()?;
        Ok(TestStep {
            kind,
            span: self.span_since(start),
        })
    }

    fn test_step_kind(&mut self) -> Parsed<TestStepKind> {
        if self.eat(TokenKind::Keyword(Keyword::Always)) {
            return self.expression().map(TestStepKind::Always);
        }
        if !self.at(TokenKind::Name) {
            return Err(self.test_step_missing());
        }
        match self.text_of(self.next_token()) {
            "set" => {
                self.bump();
                let all = self.list(|parser| {
                    let input = parser.reference("the name of an input")?;
                    let value = match parser.peek() {
                        TokenKind::Equal | TokenKind::Assign => {
                            parser.equals();
                            Some(parser.constant("a constant behind `=`")?)
                        }
                        _ => None,
                    };
                    Ok((input, value))
                })?;
                Ok(TestStepKind::Set(all))
            }
            "clear" => {
                self.bump();
                self.list(|parser| parser.reference("the name of an input"))
                    .map(TestStepKind::Clear)
            }
            "release" => {
                self.bump();
                self.list(|parser| parser.reference("the name of an input"))
                    .map(TestStepKind::Release)
            }
            "pulse" => {
                self.bump();
                let input = self.reference("the name of an input")?;
                self.expect_word("for")?;
                let duration = self.duration("a duration behind `for`")?;
                Ok(TestStepKind::Pulse(input, duration))
            }
            "wait" => {
                self.bump();
                self.wait()
            }
            "expect" => {
                self.bump();
                self.expression().map(TestStepKind::Expect)
            }
            "never" => {
                self.bump();
                self.expression().map(TestStepKind::Never)
            }
            "power" => {
                self.bump();
                self.expect_word("cycle")?;
                Ok(TestStepKind::PowerCycle)
            }
            _ => Err(self.test_step_missing()),
        }
    }

    fn wait(&mut self) -> Parsed<TestStepKind> {
        if self.eat_word("until") {
            let condition = self.expression()?;
            self.expect_word("within")?;
            let within = self.duration("a duration behind `within`")?;
            return Ok(TestStepKind::WaitUntil(condition, within));
        }
        if self.at(TokenKind::Number) {
            let count = self.integer();
            if !self.eat_word("scans") {
                return Err(self.expected_help(
                    "`scans` or a unit of time",
                    "write `wait 3 scans` or `wait 30 ms`",
                ));
            }
            return Ok(TestStepKind::WaitScans(count.unwrap_or_default()));
        }
        self.duration("a duration, a number of scans or `until`")
            .map(TestStepKind::Wait)
    }

    fn test_step_missing(&mut self) -> Failed {
        self.expected_help(
            "a step of the test",
            "tests `set`, `clear`, `release`, `pulse`, `wait`, `expect`, `never`, `always` and `power cycle`",
        )
    }
}
