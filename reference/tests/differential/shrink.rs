//! Making a failing case small: whatever can be left out without the failure going away is left out.

use crate::program::{
    Binding, Declaration, Element, Event, Expression, Graph, Program, Role, Situation, Statement,
    Step, Transition,
};
use crate::stimulus::Scan;

/// A program and what happens to it.
#[derive(Clone, Debug)]
pub struct Case {
    pub program: Program,
    pub stimulus: Vec<Scan>,
}

/// The smallest case that can be had from this one by leaving out one thing after the other, as long as `fails`.
pub fn shrunk(mut case: Case, fails: impl Fn(&Case) -> bool) -> Case {
    loop {
        let mut smaller = false;
        let mut place = 0;
        while let Some(candidate) = without(&case, place) {
            if fails(&candidate) {
                case = candidate;
                smaller = true;
            } else {
                place += 1;
            }
        }
        if !smaller {
            return case;
        }
    }
}

/// The case without the thing at a place; none behind the last place.
fn without(case: &Case, place: usize) -> Option<Case> {
    let mut case = case.clone();
    let mut cut = Cut { left: Some(place) };
    cut.case(&mut case);
    cut.left.is_none().then_some(case)
}

/// Walks a case up to the place where something is cut out.
struct Cut {
    /// Places still to go; none when it has been done.
    left: Option<usize>,
}

impl Cut {
    /// Whether this is the place.
    fn here(&mut self) -> bool {
        match self.left {
            Some(0) => {
                self.left = None;
                true
            }
            Some(places) => {
                self.left = Some(places - 1);
                false
            }
            None => false,
        }
    }

    fn list<T>(&mut self, list: &mut Vec<T>, inside: impl Fn(&mut Self, &mut T)) {
        for index in 0..list.len() {
            if self.left.is_none() {
                return;
            }
            if self.here() {
                list.remove(index);
                return;
            }
            inside(self, &mut list[index]);
        }
    }

    fn option<T>(&mut self, option: &mut Option<T>, inside: impl Fn(&mut Self, &mut T)) {
        if let Some(value) = option {
            if self.here() {
                *option = None;
            } else {
                inside(self, value);
            }
        }
    }

    fn case(&mut self, case: &mut Case) {
        // The last scan shows the failure.
        let last = case.stimulus.pop();
        self.list(&mut case.stimulus, Self::scan);
        case.stimulus.extend(last);
        if let Some(last) = case.stimulus.last_mut() {
            self.scan(last);
        }
        self.list(&mut case.program.graphs, Self::graph);
        self.list(&mut case.program.declarations, Self::declaration);
        for option in [&mut case.program.stable, &mut case.program.library] {
            if *option && self.here() {
                *option = false;
            }
        }
    }

    fn scan(&mut self, scan: &mut Scan) {
        self.list(&mut scan.given, |_, _| {});
        self.option(&mut scan.power_cycle, |cut, cycle| {
            cut.list(&mut cycle.strange, |_, _| {});
        });
        self.option(&mut scan.overruns, |_, _| {});
        if scan.periods > 1 && self.here() {
            scan.periods = 1;
        }
    }

    fn declaration(&mut self, declaration: &mut Declaration) {
        self.option(&mut declaration.address, |_, _| {});
        self.option(&mut declaration.initial, |_, _| {});
        self.option(&mut declaration.range, |_, _| {});
    }

    fn graph(&mut self, graph: &mut Graph) {
        if let Role::Instance { bindings, .. } = &mut graph.role {
            self.list(bindings, |cut, binding| {
                if let Binding::Expression(_, expression) = binding {
                    cut.expression(expression);
                }
            });
        }
        self.list(&mut graph.elements, Self::element);
        self.list(&mut graph.declarations, Self::declaration);
    }

    fn element(&mut self, element: &mut Element) {
        match element {
            Element::Always(statements) => self.list(statements, Self::statement),
            Element::Step(step) => self.step(step),
            Element::Macro(_, elements) => self.list(elements, Self::element),
            Element::Transition(transition) => self.transition(transition),
        }
    }

    fn step(&mut self, step: &mut Step) {
        if step.initial && self.here() {
            step.initial = false;
        }
        self.list(&mut step.encloses, |cut, (_, set)| cut.list(set, |_, _| {}));
        self.list(&mut step.statements, Self::statement);
    }

    fn transition(&mut self, transition: &mut Transition) {
        self.list(&mut transition.entrance, |_, _| {});
        self.list(&mut transition.exit, |_, _| {});
        self.option(&mut transition.trigger, Self::expression);
        self.list(&mut transition.action, Self::statement);
    }

    fn statement(&mut self, statement: &mut Statement) {
        match statement {
            Statement::Momentary { targets, condition } => {
                self.list(targets, |_, _| {});
                self.option(condition, Self::expression);
            }
            Statement::Stored {
                value, condition, ..
            } => {
                self.expression(value);
                self.option(condition, Self::expression);
            }
            Statement::On { event, statements } => {
                if let Event::Expression(event) = event {
                    self.expression(event);
                }
                self.list(statements, Self::statement);
            }
            Statement::Text(_) => {}
            Statement::Force {
                situation,
                condition,
                ..
            } => {
                self.situation(situation);
                self.option(condition, Self::expression);
            }
        }
    }

    fn situation(&mut self, situation: &mut Situation) {
        if let Situation::Steps(steps) = situation {
            self.list(steps, |_, _| {});
        }
    }

    /// Puts a part of an expression, or a constant, in its place.
    fn expression(&mut self, expression: &mut Expression) {
        if self.left.is_none() {
            return;
        }
        let parts: Vec<Expression> = match &*expression {
            Expression::Leaf(_) | Expression::Situation(..) => Vec::new(),
            Expression::Unary(_, operand) => vec![(**operand).clone()],
            Expression::Binary(_, left, right) => vec![(**left).clone(), (**right).clone()],
            Expression::Timer(enable, _) => vec![(**enable).clone()],
            Expression::Delay(_, enable, off) => {
                let without_off =
                    Expression::Delay(Box::new(Expression::leaf("10ms")), enable.clone(), None);
                let mut parts = vec![(**enable).clone()];
                parts.extend(off.is_some().then_some(without_off));
                parts
            }
        };
        for part in parts {
            if self.here() {
                *expression = part;
                return;
            }
        }
        for simple in ["TRUE", "1"] {
            let already =
                matches!(expression, Expression::Leaf(text) if text == "TRUE" || text == "1");
            if !already && self.here() {
                *expression = Expression::leaf(simple);
                return;
            }
        }
        match expression {
            Expression::Leaf(_) => {}
            Expression::Unary(_, operand) => self.expression(operand),
            Expression::Binary(_, left, right) => {
                self.expression(left);
                self.expression(right);
            }
            Expression::Timer(enable, preset) => {
                self.expression(enable);
                self.expression(preset);
            }
            Expression::Delay(on, enable, off) => {
                self.expression(on);
                self.expression(enable);
                if let Some(off) = off {
                    self.expression(off);
                }
            }
            Expression::Situation(_, _, situation) => self.situation(situation),
        }
    }
}
