//! A program as maps and lists of what stands in its text.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, HashMap};

use grafcet_compiler::ast::{
    BindingTarget, Constant, ConstantKind, Declaration, DeclarationKind, Expression,
    ExpressionKind, File, Graph as Tree, Item, ScanOption, Type, Unary,
};

use grafcet_compiler::source::Span;

use crate::graph::Graph;
use crate::momentary::Momentary;
use crate::name::{Named, Qualified};
use crate::value::{self, Value};

/// A program, borrowed from its text.
#[derive(Debug)]
pub struct Program<'a> {
    /// The scan period in ms.
    pub period_ms: u64,
    /// `evolution stable`.
    pub(crate) stable: bool,
    /// The graphs in source order, instances among them.
    pub(crate) graphs: Vec<Graph<'a>>,
    /// Every declaration, by its name.
    pub(crate) declared: BTreeMap<Qualified<'a>, (&'a Declaration, Option<&'a BindingTarget>)>,
    /// The names of `declared` in the order of a trace: globals, then per graph, in source order.
    pub(crate) names: Vec<Qualified<'a>>,
    /// For each enclosed graph its enclosing steps, in source order.
    pub(crate) enclosings: BTreeMap<&'a str, Vec<Enclosing<'a>>>,
    /// The graphs in the order in which phase 4 takes them.
    pub(crate) from_the_top: Vec<&'a str>,
    /// The momentary statements in source order.
    pub(crate) momentary: Vec<Momentary<'a>>,
    /// What has a column in a trace, besides the graphs.
    pub(crate) columns: Vec<Qualified<'a>>,
    /// What names have turned out to mean, by graph and place: only to save time.
    pub(crate) resolved: RefCell<HashMap<(&'a str, Span), Named<'a>>>,
}

/// A step that encloses a graph: the step and the set that its activation activates.
pub type Enclosing<'a> = (Qualified<'a>, BTreeSet<&'a str>);

impl<'a> Program<'a> {
    /// Opens up a file and the libraries it imports.
    #[must_use]
    pub fn new(file: &'a File, libraries: &'a [File]) -> Self {
        let mut program = Program {
            period_ms: 10,
            stable: false,
            graphs: Vec::new(),
            declared: BTreeMap::new(),
            names: Vec::new(),
            enclosings: BTreeMap::new(),
            from_the_top: Vec::new(),
            momentary: Vec::new(),
            columns: Vec::new(),
            resolved: RefCell::default(),
        };
        let templates: BTreeMap<&str, &Tree> = libraries
            .iter()
            .chain([file])
            .flat_map(|file| &file.items)
            .filter_map(|item| match item {
                Item::Template(template) => Some((template.name.text.as_str(), template)),
                _ => None,
            })
            .collect();
        for item in &file.items {
            match item {
                Item::Declaration(declaration) => program.declare("", declaration, None),
                Item::Graph(graph) => program.graphs.push(Graph::of(graph)),
                Item::Instance(instance) => {
                    let template = templates[instance.template.text.as_str()];
                    program.graphs.push(Graph::instance(instance, template));
                }
                _ => {}
            }
        }
        for graph in std::mem::take(&mut program.graphs) {
            for declaration in &graph.declarations {
                program.declare(graph.name, declaration, Some(&graph.bindings));
            }
            program.graphs.push(graph);
        }
        for option in &file.options {
            match option {
                ScanOption::Period(period) => {
                    let period_ms = program.constant("", period).number();
                    program.period_ms = u64::from(period_ms.unsigned_abs());
                }
                ScanOption::Evolution { stable, .. } => program.stable = *stable,
            }
        }
        program.enclosings = program.find_enclosings();
        program.from_the_top = program.order_graphs();
        program.momentary = program.find_momentary();
        program.columns = program.find_columns();
        program
    }

    fn declare(
        &mut self,
        graph: &'a str,
        declaration: &'a Declaration,
        bindings: Option<&BTreeMap<&'a str, &'a BindingTarget>>,
    ) {
        for name in &declaration.names {
            let name = name.text.as_str();
            let binding = bindings.and_then(|bindings| bindings.get(name)).copied();
            self.declared.insert((graph, name), (declaration, binding));
            self.names.push((graph, name));
        }
    }

    /// The graph that `name` means inside the graph `from`.
    pub(crate) fn graph(&self, from: &str, name: &str) -> &Graph<'a> {
        let mut graphs = self.graphs.iter();
        graphs
            .find(|graph| {
                graph.name == name || (graph.name == from && graph.template == Some(name))
            })
            .unwrap_or_else(|| panic!("no graph is called `{name}`"))
    }

    /// The value of a constant as it is written in a graph.
    pub(crate) fn constant(&self, graph: &'a str, constant: &'a Constant) -> Value {
        match &constant.kind {
            ConstantKind::Integer(value) => Value::Int(narrow(*value)),
            ConstantKind::Duration(ms) => Value::Time(narrow(*ms)),
            ConstantKind::Bool(value) => Value::Bool(*value),
            ConstantKind::Unreadable => panic!("a program with errors is not run"),
            ConstantKind::Name(name, negative) => {
                let local = self.declared.contains_key(&(graph, name.text.as_str()));
                let value = self.constant_named(if local { graph } else { "" }, &name.text);
                let number = value.number();
                Value::of(value.ty(), if *negative { -number } else { number })
            }
        }
    }

    /// The value of a declared constant.
    pub(crate) fn constant_named(&self, graph: &'a str, name: &'a str) -> Value {
        let (declaration, _) = self.declared[&(graph, name)];
        let Some(value) = &declaration.initial else {
            panic!("the constant `{name}` has no value");
        };
        self.constant(graph, value)
    }

    pub(crate) fn ty(&self, name: Qualified<'a>) -> Type {
        let (declaration, _) = self.declared[&name];
        declaration.ty.map_or(Type::Bool, |(ty, _)| ty)
    }

    pub(crate) fn kind(&self, name: Qualified<'a>) -> DeclarationKind {
        self.declared[&name].0.kind
    }

    /// Lowest and highest value of a number.
    pub(crate) fn range(&self, name: Qualified<'a>) -> (i32, i32) {
        let (declaration, binding) = self.declared[&name];
        let ends = declaration.range.as_ref().map(|(low, high)| {
            let end = |constant| self.constant(name.0, constant).number();
            (end(low), end(high))
        });
        let address = match binding {
            Some(BindingTarget::Address(address)) => Some(address),
            _ => declaration.address.as_ref(),
        };
        let word = address.is_some_and(|address| address.text.to_uppercase().contains('W'));
        let physical = if word {
            (-32_768, 32_767)
        } else {
            (i32::MIN, i32::MAX)
        };
        ends.unwrap_or(physical)
    }

    /// The value before scan 0: what is declared, or 0, or the bound nearest to it.
    pub(crate) fn initial(&self, name: Qualified<'a>) -> Value {
        let (declaration, binding) = self.declared[&name];
        let (low, high) = self.range(name);
        let own = declaration
            .initial
            .as_ref()
            .map(|c| self.constant(name.0, c));
        let number = match (binding, declaration.kind) {
            (Some(BindingTarget::Expression(setting)), DeclarationKind::Parameter) => {
                self.setting(setting).number()
            }
            _ => own.map_or(0.clamp(low, high), Value::number),
        };
        Value::of(self.ty(name), number)
    }

    /// The value to which an instance sets a parameter.
    fn setting(&self, setting: &'a Expression) -> Value {
        match &setting.kind {
            ExpressionKind::Bool(value) => Value::Bool(*value),
            ExpressionKind::Integer(value) => Value::Int(narrow(*value)),
            ExpressionKind::Duration(ms) => Value::Time(narrow(*ms)),
            ExpressionKind::Ref(reference) => match self.resolve("", reference) {
                Named::Constant(value) => value,
                other => panic!("a parameter is set to {other:?}"),
            },
            ExpressionKind::Unary {
                operator: Unary::Negate,
                operand,
            } => value::negated(self.setting(operand)).value,
            other => panic!("a parameter is set to {other:?}"),
        }
    }
}

/// The compiler has refused constants that do not fit.
fn narrow(wide: i64) -> i32 {
    i32::try_from(wide).unwrap_or_else(|_| panic!("{wide} is no constant"))
}
