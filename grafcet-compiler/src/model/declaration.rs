//! Declarations: names with types, ranges, addresses and initial values.

use super::address::{Address, Area, Size};
use super::resolver::Resolver;
use super::{Binding, DeclarationKind, GraphId, Type, Variable, VariableId};
use crate::ast;
use crate::diagnostic::{Diagnostic, Rule};
use crate::source::Span;

impl<'a> Resolver<'a> {
    /// Makes the names of a declaration known; what stands behind them is looked at when all names are known.
    pub(super) fn declare(&mut self, declaration: &'a ast::Declaration, owner: Option<GraphId>) {
        if declaration.names.is_empty() {
            match owner {
                Some(graph) => self.names.scopes[graph.0].nameless = true,
                None => self.names.nameless = true,
            }
        }
        for name in &declaration.names {
            let first = self.scope_mut(owner).get(&name.text).copied();
            if let Some(first) = first {
                self.names.disputed.insert(first);
                let first = self.model[first].span;
                self.report_duplicate("name", name, first);
                continue;
            }
            let id = VariableId(self.model.variables.len());
            self.scope_mut(owner).insert(name.text.clone(), id);
            self.model.variables.push(Variable {
                name: name.text.clone(),
                owner,
                kind: declaration.kind,
                ty: declaration.ty.map_or(Type::Bool, |(ty, _)| ty),
                address: None,
                at: declaration.address.as_ref().map(|address| address.span),
                range: None,
                initial: None,
                initial_span: None,
                text: declaration.text.as_ref().map(|text| text.text.clone()),
                binding: Binding::None,
                span: name.span,
            });
            if declaration.doubtful {
                self.names.disputed.insert(id);
            }
            self.declarations.push((id, declaration));
            if declaration.kind == DeclarationKind::Constant
                && let Some(value) = &declaration.initial
            {
                self.constants.add(id, value);
            }
        }
    }

    fn scope_mut(
        &mut self,
        owner: Option<GraphId>,
    ) -> &mut std::collections::BTreeMap<String, VariableId> {
        match owner {
            Some(graph) => &mut self.names.scopes[graph.0].names,
            None => &mut self.names.application,
        }
    }

    /// Takes ranges, initial values and addresses of everything declared since the last call.
    pub(super) fn settle_declarations(&mut self) {
        for (id, declaration) in std::mem::take(&mut self.declarations) {
            self.settle_address(id, declaration);
            self.settle_range(id, declaration);
            self.settle_initial(id, declaration);
        }
    }

    fn settle_address(&mut self, id: VariableId, declaration: &ast::Declaration) {
        let Some(text) = &declaration.address else {
            return;
        };
        self.model[id].address = self.address(text, id);
    }

    /// An address for a variable, checked for form, direction and width.
    pub(super) fn address(&mut self, text: &ast::Name, id: VariableId) -> Option<Address> {
        let variable = &self.model[id];
        let (kind, ty, name) = (variable.kind, variable.ty, variable.name.clone());
        let in_plant = variable.owner.is_some_and(|owner| self.model[owner].plant);
        let address = match Address::parse(&text.text) {
            Ok(address) => address,
            Err(message) => {
                self.report(Diagnostic::new(Rule::BadAddress, text.span, message));
                return None;
            }
        };
        if in_plant || kind == DeclarationKind::Constant {
            let what = if in_plant {
                "what a plant declares"
            } else {
                "a constant"
            };
            let message = format!("{what} has no address");
            self.report(Diagnostic::new(Rule::BadAddress, text.span, message));
            return None;
        }
        let (right, what) = match kind {
            DeclarationKind::Input => (Area::Input, "an input"),
            DeclarationKind::Output => (Area::Output, "an output"),
            DeclarationKind::Variable { .. } => (Area::Memory, "a variable"),
            DeclarationKind::Parameter | DeclarationKind::Constant => (Area::Memory, "a parameter"),
        };
        if address.area != right {
            let mended = Address {
                area: right,
                ..address
            };
            let diagnostic = Diagnostic::new(
                Rule::AddressDirection,
                text.span,
                format!("`{name}` is {what}, and `{address}` is not an address for one"),
            )
            .help(format!("write `{mended}`"));
            self.report(diagnostic);
            return None;
        }
        let needed = match (ty, address.size) {
            (Type::Bool, Size::Bit(_))
            | (Type::Int, Size::Word | Size::Double)
            | (Type::Time, Size::Double) => return Some(address),
            (Type::Bool, _) => "a Boolean lies at a bit, as `%IX0.0`, `%QX0.0` or `%MX0.0`",
            (Type::Int, _) => "an int lies at a word, as `%IW0`, `%QW0`, `%MW0` or `%MD0`",
            (Type::Time, _) => "a time needs 32 bits, as `%MD0`",
        };
        let diagnostic = Diagnostic::new(
            Rule::BadAddress,
            text.span,
            format!("`{address}` has the wrong width for `{name}`"),
        )
        .help(needed);
        self.report(diagnostic);
        None
    }

    /// The range: as declared, within what a word at an address can hold.
    fn settle_range(&mut self, id: VariableId, declaration: &ast::Declaration) {
        let ty = self.model[id].ty;
        let mut declared = None;
        if let Some((low, high)) = &declaration.range {
            let span = low.span.to(high.span);
            if ty == Type::Bool {
                let diagnostic =
                    Diagnostic::new(Rule::TypeMismatch, span, "a Boolean has no range")
                        .help("declare a number: `: int` or `: time`");
                self.report(diagnostic);
                return;
            }
            let view = self.view_of(self.model[id].owner);
            let (low, high) = (self.constant(low, ty, view), self.constant(high, ty, view));
            if let (Some(low), Some(high)) = (low, high) {
                if low > high {
                    let diagnostic = Diagnostic::new(
                        Rule::OutOfRange,
                        span,
                        "the ends of the range are reversed",
                    )
                    .help("write the lower end first");
                    self.report(diagnostic);
                    return;
                }
                declared = Some((low, high, span));
            }
            self.refuse_range_of_input(id, span);
        }
        let word = match self.model[id].address {
            Some(address) if address.size == Size::Word => {
                let unsigned = declared.is_some_and(|(_, high, _)| high > i32::from(i16::MAX));
                Some(if unsigned {
                    (0, 65_535)
                } else {
                    (-32_768, 32_767)
                })
            }
            _ => None,
        };
        if let (Some((low, high, span)), Some((lowest, highest))) = (declared, word)
            && (low < lowest || highest < high)
        {
            let message =
                format!("a word holds -32768 to 32767 or 0 to 65535, not {low} to {high}");
            self.report(Diagnostic::new(Rule::OutOfRange, span, message));
        }
        self.model[id].range = declared.map(|(low, high, _)| (low, high)).or(word);
    }

    /// An input has a range only at a word: at the terminals of a template the binding decides.
    fn refuse_range_of_input(&mut self, id: VariableId, span: Span) {
        let variable = &self.model[id];
        let in_template = variable
            .owner
            .is_some_and(|owner| self.model[owner].template.is_some());
        if variable.kind == DeclarationKind::Input && variable.address.is_none() && !in_template {
            let diagnostic = Diagnostic::new(
                Rule::Syntax,
                span,
                "an input has a range only at the address of a word",
            )
            .help("write `at %IW0` before `in`");
            self.report(diagnostic);
        }
    }

    fn settle_initial(&mut self, id: VariableId, declaration: &ast::Declaration) {
        let variable = &self.model[id];
        let (kind, ty) = (variable.kind, variable.ty);
        if let Some(initial) = &declaration.initial {
            let value = if kind == DeclarationKind::Constant {
                self.value_of(id, initial.span)
            } else {
                let view = self.view_of(self.model[id].owner);
                self.constant(initial, ty, view)
            };
            if let Some(value) = value {
                self.check_limits(value, id, initial.span);
            }
            if self.model[id].initial_span.is_none() {
                self.model[id].initial = value;
                self.model[id].initial_span = Some(initial.span);
                return;
            }
        }
        // What an instance has given to its parameter.
        if let (Some(value), Some(span)) = (self.model[id].initial, self.model[id].initial_span) {
            self.check_limits(value, id, span);
        }
    }

    /// A declared name must not look like the step bit of a step that there is.
    pub(super) fn refuse_names_of_step_bits(&mut self, graph: GraphId) {
        let scope = &self.names.scopes[graph.0];
        let mut clashes = Vec::new();
        for (id, step) in &scope.steps {
            if id.starts_with(|c: char| c.is_ascii_digit()) {
                continue;
            }
            let bit = format!("X{id}");
            let declared = scope
                .names
                .get(&bit)
                .or_else(|| self.names.application.get(&bit));
            clashes.extend(declared.map(|variable| (bit, *variable, *step)));
        }
        for (bit, variable, step) in clashes {
            self.names.scopes[graph.0].clashing.insert(bit.clone());
            let place = self.place_of(step);
            let message = format!(
                "`{bit}` is the step bit of a step of the graph `{}`",
                self.model[graph].name
            );
            let diagnostic =
                Diagnostic::new(Rule::DuplicateName, self.model[variable].span, message)
                    .label(place, "the step is here")
                    .help("rename one of them");
            self.report(diagnostic);
        }
    }
}
