//! Tests and properties.

use std::collections::BTreeSet;

use super::names::{Found, View};
use super::resolver::Resolver;
use super::{DeclarationKind, Expression, GraphId, Type, VariableId};
use crate::ast::{self, ConstantKind, Item};
use crate::diagnostic::{Diagnostic, Rule};
use crate::source::Span;

/// A test.
#[derive(Clone, Debug)]
pub struct Test {
    /// What it claims.
    pub name: String,
    /// The plants it runs with.
    pub plants: Vec<GraphId>,
    /// Its steps.
    pub steps: Vec<TestStep>,
    /// The test.
    pub span: Span,
}

/// A step of a test with its place.
#[derive(Clone, Debug)]
pub struct TestStep {
    /// What it does.
    pub kind: TestStepKind,
    /// Where it is written.
    pub span: Span,
}

/// What a step of a test does.
#[derive(Clone, Debug)]
pub enum TestStepKind {
    /// `set` and `clear`.
    Set(Vec<(VariableId, i32)>),
    /// `release`.
    Release(Vec<VariableId>),
    /// `pulse`, in ms.
    Pulse(VariableId, u32),
    /// `wait`, in ms.
    Wait(u32),
    /// `wait n scans`.
    WaitScans(u32),
    /// `wait until`, at most so many ms.
    WaitUntil(Expression, u32),
    /// `expect`.
    Expect(Expression),
    /// `never`.
    Never(Expression),
    /// `always`.
    Always(Expression),
    /// `power cycle`.
    PowerCycle,
}

/// A property, for a verifier.
#[derive(Clone, Debug)]
pub struct Property {
    /// What it says.
    pub name: String,
    /// What must hold.
    pub claimed: Claimed,
    /// Its text.
    pub span: Span,
}

/// What a property asks for.
#[derive(Clone, Debug)]
pub enum Claimed {
    /// It is never True.
    Never(Expression),
    /// It is always True.
    Always(Expression),
    /// It can become True.
    Reachable(Expression),
    /// It can become True from everywhere.
    Recoverable(Expression),
    /// After the trigger the expected comes in time.
    After {
        /// What starts the time.
        trigger: Expression,
        /// The time allowed, in ms.
        within_ms: u32,
        /// What must come.
        expect: Expression,
    },
}

impl Resolver<'_> {
    /// Takes the tests and properties of the main file.
    pub(super) fn take_claims(&mut self, main: &ast::File) {
        for item in &main.items {
            match item {
                Item::Test(test) => self.take_test(test),
                Item::Property(property) => self.take_property(property),
                _ => {}
            }
        }
    }

    fn take_property(&mut self, property: &ast::Property) {
        let view = View::Claim {
            plants: &[],
            whole: true,
        };
        let claimed = match &property.kind {
            ast::PropertyKind::Never(it) => Claimed::Never(self.claim(it, view)),
            ast::PropertyKind::Always(it) => Claimed::Always(self.claim(it, view)),
            ast::PropertyKind::Reachable(it) => Claimed::Reachable(self.claim(it, view)),
            ast::PropertyKind::Recoverable(it) => Claimed::Recoverable(self.claim(it, view)),
            ast::PropertyKind::After {
                trigger,
                within,
                expect,
            } => Claimed::After {
                trigger: self.claim(trigger, view),
                within_ms: self.duration(within, view),
                expect: self.claim(expect, view),
            },
        };
        self.model.properties.push(Property {
            name: property.text.text.clone(),
            claimed,
            span: property.text.span,
        });
    }

    fn claim(&mut self, text: &ast::Expression, view: View) -> Expression {
        self.condition(text, "a claim", view)
    }

    fn take_test(&mut self, test: &ast::Test) {
        let (mut plants, mut whole) = (Vec::new(), true);
        let mut seen = BTreeSet::new();
        for name in &test.plants {
            match self.plant(name) {
                Some(plant) => plants.extend(seen.insert(plant).then_some(plant)),
                None => whole = false,
            }
        }
        let view = View::Claim {
            plants: &plants,
            whole,
        };
        let mut steps = Vec::with_capacity(test.steps.len());
        for step in &test.steps {
            let kind = self.test_step(step, view);
            steps.extend(kind.map(|kind| TestStep {
                kind,
                span: step.span,
            }));
        }
        self.model.tests.push(Test {
            name: test.text.text.clone(),
            plants,
            steps,
            span: test.span,
        });
    }

    fn plant(&mut self, name: &ast::Name) -> Option<GraphId> {
        let found = self.names.graphs.get(&name.text).copied();
        if let Some(id) = found.filter(|id| self.model[*id].plant) {
            return Some(id);
        }
        let message = match found {
            Some(_) => format!("`{}` is a graph of the application, not a plant", name.text),
            None if self.names.nameless_graph => return None,
            None => format!("there is no plant `{}`", name.text),
        };
        let help = self.suggest_or_list(&name.text, "", |resolver| {
            let plants = resolver.model.plants();
            plants.map(|id| resolver.model[id].name.as_str()).collect()
        });
        self.report_with_help(
            Diagnostic::new(Rule::UnknownGraph, name.span, message),
            help,
        );
        None
    }

    fn test_step(&mut self, step: &ast::TestStep, view: View) -> Option<TestStepKind> {
        let span = step.span;
        Some(match &step.kind {
            ast::TestStepKind::Set(pairs) => TestStepKind::Set(self.set_pairs(pairs, view)),
            ast::TestStepKind::Clear(names) => {
                let mut cleared = Vec::new();
                for name in names {
                    cleared.extend(self.settable(name, view).map(|id| (id, 0)));
                }
                TestStepKind::Set(cleared)
            }
            ast::TestStepKind::Release(names) => {
                let mut released = Vec::new();
                for name in names {
                    released.extend(self.releasable(name, view));
                }
                TestStepKind::Release(released)
            }
            ast::TestStepKind::Pulse(name, duration) => {
                let ms = self.duration(duration, view);
                let id = self.settable(name, view)?;
                if self.model[id].ty != Type::Bool {
                    let message = format!(
                        "`{}` is a number, and a pulse is of a Boolean",
                        self.model[id].name
                    );
                    self.report(Diagnostic::new(Rule::TypeMismatch, name.span, message));
                    return None;
                }
                TestStepKind::Pulse(id, ms)
            }
            ast::TestStepKind::Wait(duration) => TestStepKind::Wait(self.duration(duration, view)),
            ast::TestStepKind::WaitScans(scans) => {
                let scans = u32::try_from(*scans);
                if scans.is_err() {
                    let message = format!("a test waits for at most {} scans", u32::MAX);
                    self.report(Diagnostic::new(Rule::OutOfRange, span, message));
                }
                TestStepKind::WaitScans(scans.unwrap_or_default())
            }
            ast::TestStepKind::WaitUntil(text, within) => {
                TestStepKind::WaitUntil(self.claim(text, view), self.duration(within, view))
            }
            ast::TestStepKind::Expect(text) => TestStepKind::Expect(self.claim(text, view)),
            ast::TestStepKind::Never(text) => TestStepKind::Never(self.claim(text, view)),
            ast::TestStepKind::Always(text) => TestStepKind::Always(self.claim(text, view)),
            ast::TestStepKind::PowerCycle => TestStepKind::PowerCycle,
        })
    }

    /// A stretch of time, in ms; not a `time`, so up to 49 days.
    fn duration(&mut self, constant: &ast::Constant, view: View) -> u32 {
        if let ConstantKind::Duration(ms) = constant.kind {
            if let Ok(ms) = u32::try_from(ms) {
                return ms;
            }
            let message = "a stretch of time is 0 to 49 days";
            self.report(Diagnostic::new(Rule::OutOfRange, constant.span, message));
            return 0;
        }
        let Some(ms) = self.constant(constant, Type::Time, view) else {
            return 0;
        };
        u32::try_from(ms).unwrap_or_else(|_| {
            self.report(Diagnostic::new(
                Rule::OutOfRange,
                constant.span,
                "a stretch of time is not negative",
            ));
            0
        })
    }

    fn set_pairs(
        &mut self,
        pairs: &[(ast::Ref, Option<ast::Constant>)],
        view: View,
    ) -> Vec<(VariableId, i32)> {
        let mut set = Vec::with_capacity(pairs.len());
        for (name, value) in pairs {
            let Some(id) = self.settable(name, view) else {
                continue;
            };
            let ty = self.model[id].ty;
            let value = match value {
                None if ty == Type::Bool => Some(1),
                None => {
                    let message = format!("`{}` is a number: say which value", name.name.text);
                    let diagnostic = Diagnostic::new(Rule::TypeMismatch, name.span, message)
                        .help(format!("write `set {} = ..`", name.name.text));
                    self.report(diagnostic);
                    None
                }
                // `TRUE` and 1 are the same here.
                Some(constant) => match constant.kind {
                    ConstantKind::Integer(value @ (0 | 1)) if ty == Type::Bool => {
                        Some(i32::from(value == 1))
                    }
                    _ => self.constant(constant, ty, view).inspect(|value| {
                        self.check_set(*value, id, constant.span);
                    }),
                },
            };
            set.extend(value.map(|value| (id, value)));
        }
        set
    }

    /// An input may be set outside its range, which it is then clamped to; nothing else may.
    fn check_set(&mut self, value: i32, id: VariableId, span: Span) {
        if self.model[id].kind != DeclarationKind::Input {
            self.check_limits(value, id, span);
        }
    }

    /// What a test may set: inputs, parameters, and what its plants declare.
    fn settable(&mut self, name: &ast::Ref, view: View) -> Option<VariableId> {
        let span = name.span;
        let (rule, what) = match self.find_read(name, view)? {
            Found::Variable(id) => {
                let variable = &self.model[id];
                let of_plant = variable.owner.is_some_and(|owner| self.model[owner].plant);
                match variable.kind {
                    DeclarationKind::Input if variable.binding.is_alias() => {
                        (Rule::WriteToInput, "bound to an expression")
                    }
                    DeclarationKind::Input | DeclarationKind::Parameter => return Some(id),
                    DeclarationKind::Variable { .. } if of_plant => return Some(id),
                    DeclarationKind::Variable { .. } => {
                        (Rule::WriteToConstant, "a variable of the application")
                    }
                    DeclarationKind::Output => (Rule::WriteToConstant, "an output"),
                    DeclarationKind::Constant => (Rule::WriteToConstant, "a constant"),
                }
            }
            Found::Step(_) | Found::Macro(_) => (Rule::WriteToStepBit, "a step bit"),
            Found::System(_) => (Rule::WriteToConstant, "read-only"),
        };
        let message = format!("a test cannot set `{}`: it is {what}", written(name));
        let diagnostic = Diagnostic::new(rule, span, message)
            .help("a test sets inputs, parameters and the variables of its plants");
        self.report(diagnostic);
        None
    }

    fn releasable(&mut self, name: &ast::Ref, view: View) -> Option<VariableId> {
        let id = self.settable(name, view)?;
        if self.model[id].kind == DeclarationKind::Input {
            return Some(id);
        }
        let message = format!(
            "`{}` is no input: only an input is given back to a plant",
            name.name.text
        );
        self.report(Diagnostic::new(Rule::TypeMismatch, name.span, message));
        None
    }
}

/// A name as it stands in the text.
fn written(name: &ast::Ref) -> String {
    match &name.graph {
        Some(graph) => format!("{}:{}", graph.text, name.name.text),
        None => name.name.text.clone(),
    }
}

impl Test {
    /// The expressions of a test, in source order.
    pub fn expressions(&self) -> impl Iterator<Item = &Expression> {
        self.steps.iter().filter_map(|step| match &step.kind {
            TestStepKind::WaitUntil(it, _)
            | TestStepKind::Expect(it)
            | TestStepKind::Never(it)
            | TestStepKind::Always(it) => Some(it),
            _ => None,
        })
    }
}
