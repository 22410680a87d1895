//! From trees to a model: the order in which names become known.

use super::bound::Substituted;
use super::names::Names;
use super::structure::Body;
use super::suggest::Suggestions;
use super::{Binding, DeclarationKind, GraphId, Model, VariableId};
use crate::ast::{self, Item};
use crate::diagnostic::{Diagnostic, Rule};
use crate::source::Span;

/// What is known while names are looked up.
pub(super) struct Resolver<'a> {
    pub model: Model,
    pub names: Names<'a>,
    /// The texts of the graphs, in the order of [`Model::graphs`].
    pub bodies: Vec<Body<'a>>,
    /// Declarations of constants whose value is not known yet, or being found out.
    pub constants: super::constant::Pending<'a>,
    /// Bindings of instances that are not looked up yet.
    pub bindings: super::instance::Pending<'a>,
    /// Declarations whose ranges, addresses and values are not looked at yet.
    pub declarations: Vec<(VariableId, &'a ast::Declaration)>,
    pub diagnostics: Vec<Diagnostic>,
    pub suggestions: Suggestions,
    pub substituted: Substituted,
    /// Bytes of template text that instances have repeated.
    pub repeated: usize,
    /// Steps in all situations that expressions compare.
    pub compared: usize,
}

/// Looks up every name of an application. `files` are the main file and the libraries that it imports, directly or
/// not; `stem` names an application without a name of its own.
pub(crate) fn resolve(files: &[ast::File], stem: &str) -> (Model, Vec<Diagnostic>) {
    let Some((main, libraries)) = files.split_first() else {
        return (Model::default(), Vec::new());
    };
    let mut resolver = Resolver {
        model: Model {
            name: stem.to_owned(),
            period_ms: 10,
            ..Model::default()
        },
        names: Names::default(),
        bodies: Vec::new(),
        constants: Default::default(),
        bindings: Default::default(),
        declarations: Vec::new(),
        diagnostics: Vec::new(),
        suggestions: Suggestions::default(),
        substituted: Substituted::default(),
        repeated: 0,
        compared: 0,
    };
    resolver.take_application(main);
    resolver.take_templates(main, libraries);
    resolver.take_declarations(main);
    resolver.take_graphs(main);
    resolver.take_options(&main.options);
    resolver.take_bindings();
    resolver.take_actions();
    resolver.take_unused_templates();
    resolver.take_claims(main);
    (resolver.model, resolver.diagnostics)
}

impl<'a> Resolver<'a> {
    fn take_application(&mut self, main: &ast::File) {
        if let Some((name, text)) = &main.application {
            self.model.name.clone_from(&name.text);
            self.model.text = text.as_ref().map(|text| text.text.clone());
            self.model.span = name.span;
        }
    }

    fn take_templates(&mut self, main: &'a ast::File, libraries: &'a [ast::File]) {
        for library in libraries {
            self.refuse_non_templates(library);
        }
        let items = libraries.iter().chain([main]).flat_map(|file| &file.items);
        for item in items {
            if let Item::Template(template) = item {
                if template.name.text.is_empty() {
                    self.names.nameless_graph = true;
                } else if let Some(first) = self.names.templates.get(&template.name.text) {
                    let first = first.name.span;
                    self.report_duplicate("template", &template.name, first);
                } else {
                    self.names
                        .templates
                        .insert(template.name.text.clone(), template);
                }
            }
        }
    }

    /// A library holds templates and nothing else.
    fn refuse_non_templates(&mut self, library: &ast::File) {
        let application = library
            .application
            .iter()
            .map(|(name, _)| (name.span, "names an application"));
        let options = library.options.iter().map(|option| match option {
            ast::ScanOption::Period(period) => (period.span, "sets the scan period"),
            ast::ScanOption::Evolution { span, .. } => (*span, "sets the evolution"),
        });
        let items = library.items.iter().filter_map(|item| match item {
            Item::Template(_) => None,
            Item::Declaration(it) => Some((it.span, "declares a name")),
            Item::Graph(it) => Some((it.name.span, "has a graph")),
            Item::Instance(it) => Some((it.name.span, "has an instance")),
            Item::Plant(it) => Some((it.name.span, "has a plant")),
            Item::Property(it) => Some((it.text.span, "has a property")),
            Item::Test(it) => Some((it.text.span, "has a test")),
        });
        for (span, what) in application.chain(options).chain(items) {
            let diagnostic = Diagnostic::new(
                Rule::Syntax,
                span,
                format!("a library is a file of templates; this one {what}"),
            )
            .help("move it into the application that imports the library");
            self.report(diagnostic);
        }
    }

    fn take_declarations(&mut self, main: &'a ast::File) {
        for item in &main.items {
            if let Item::Declaration(declaration) = item {
                self.declare(declaration, None);
            }
        }
        self.model.globals = self.model.variables.len();
        self.settle_declarations();
    }

    /// Takes all graphs and their names, plants behind the controller's.
    fn take_graphs(&mut self, main: &'a ast::File) {
        for item in &main.items {
            match item {
                Item::Graph(graph) => {
                    self.take_graph(&graph.name, graph, None);
                }
                Item::Instance(instance) => self.take_instance(instance),
                _ => {}
            }
        }
        for item in &main.items {
            if let Item::Plant(plant) = item {
                self.take_plant(plant);
            }
        }
        self.settle_declarations();
        for index in 0..self.model.graphs.len() {
            self.refuse_names_of_step_bits(GraphId(index));
        }
        self.names.note_holders();
    }

    fn take_actions(&mut self) {
        for index in 0..self.model.graphs.len() {
            self.take_body(GraphId(index));
        }
    }

    /// Takes note of something that is wrong.
    pub fn report(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    /// The same, with advice where there is some.
    pub fn report_with_help(&mut self, diagnostic: Diagnostic, help: Option<String>) {
        self.diagnostics.push(match help {
            Some(help) => diagnostic.help(help),
            None => diagnostic,
        });
    }

    /// Two declarations of one name in one scope: the one that stands later in the source is the second, whichever
    /// has been taken first.
    pub fn report_duplicate(&mut self, what: &str, name: &ast::Name, other: Span) {
        let (first, second) = if other.file == name.span.file && name.span < other {
            (name.span, other)
        } else {
            (other, name.span)
        };
        let diagnostic = Diagnostic::new(
            Rule::DuplicateName,
            second,
            format!("a second {what} is called `{}`", name.text),
        )
        .label(first, "the first one is here");
        self.report(diagnostic);
    }

    /// Which variable a name that an action writes stands for: an interface output may stand for another one.
    pub fn written_through(&self, named: VariableId) -> VariableId {
        let variable = &self.model[named];
        if variable.kind == DeclarationKind::Output
            && let Binding::Expression(to) = &variable.binding
            && let super::ExpressionKind::Variable(target) = to.bare().kind
        {
            return self.written_through(target);
        }
        named
    }
}
