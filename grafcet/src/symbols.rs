//! Where everything lies in a program's images, as JSON: for tools that look into the memory of a running image.
//!
//! `image` bits and `numbers` are indices into the two arrays with which the engine's memory begins. The situation
//! of a graph is the active ones of its steps, in the order in which they stand here; `columns` is the header of a
//! trace.

use grafcet_compiler::application::{Application, GraphSymbol, VariableSymbol};
use grafcet_compiler::ast::{DeclarationKind, Type};
use grafcet_core::program::{Evolution, Layout, Run, Slot};
use serde::ser::{Serialize, SerializeMap, Serializer};

use crate::trace::Columns;

/// The names of an application's controller with their places, in JSON.
#[must_use]
pub fn json(application: &Application) -> String {
    let controller = &application.controller;
    let document = Document {
        application: &application.name,
        fingerprint: controller.tables.fingerprint,
        period_ms: controller.tables.period_ms,
        evolution: match controller.tables.evolution {
            Evolution::Scan => "scan",
            Evolution::Stable => "stable",
        },
        layout: controller.tables.layout.into(),
        columns: Columns::of(controller).header().collect(),
        graphs: controller.symbols.graphs.iter().map(Into::into).collect(),
        variables: Variables(&controller.symbols.variables),
    };
    // Nothing in it can fail to be written: every key is a string.
    serde_json::to_string_pretty(&document).unwrap_or_default()
}

#[derive(serde::Serialize)]
struct Document<'a> {
    application: &'a str,
    fingerprint: u32,
    period_ms: u32,
    evolution: &'static str,
    layout: LayoutRow,
    columns: Vec<&'a str>,
    graphs: Vec<GraphRow<'a>>,
    variables: Variables<'a>,
}

/// The parts of a [`Layout`], in words of the image and in numbers.
#[derive(serde::Serialize)]
struct LayoutRow {
    words: u16,
    numbers: u16,
    inputs: RunRow,
    situations: RunRow,
    macros: RunRow,
    momentary: RunRow,
    number_inputs: RunRow,
}

#[derive(serde::Serialize)]
struct RunRow {
    start: u16,
    len: u16,
}

#[derive(serde::Serialize)]
struct GraphRow<'a> {
    name: &'a str,
    steps: Vec<StepRow<'a>>,
    transitions: Vec<u32>,
}

#[derive(serde::Serialize)]
struct StepRow<'a> {
    id: &'a str,
    bit: u16,
}

/// A variable: one of `bit` and `number` says where it lies.
#[derive(serde::Serialize)]
struct VariableRow<'a> {
    kind: &'static str,
    #[serde(rename = "type")]
    ty: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    bit: Option<u16>,
    #[serde(skip_serializing_if = "Option::is_none")]
    number: Option<u16>,
    #[serde(skip_serializing_if = "Option::is_none")]
    address: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    range: Option<(i32, i32)>,
    initial: i32,
}

/// The variables by name, in source order.
struct Variables<'a>(&'a [VariableSymbol]);

impl Serialize for Variables<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for variable in self.0 {
            map.serialize_entry(&variable.name, &VariableRow::from(variable))?;
        }
        map.end()
    }
}

impl From<Layout> for LayoutRow {
    fn from(layout: Layout) -> Self {
        LayoutRow {
            words: layout.words,
            numbers: layout.numbers,
            inputs: layout.inputs.into(),
            situations: layout.situations.into(),
            macros: layout.macros.into(),
            momentary: layout.momentary.into(),
            number_inputs: layout.number_inputs.into(),
        }
    }
}

impl From<Run> for RunRow {
    fn from(run: Run) -> Self {
        RunRow {
            start: run.start,
            len: run.len,
        }
    }
}

impl<'a> From<&'a GraphSymbol> for GraphRow<'a> {
    fn from(graph: &'a GraphSymbol) -> Self {
        let steps = graph.steps.iter();
        GraphRow {
            name: &graph.name,
            steps: steps
                .map(|step| StepRow {
                    id: &step.id,
                    bit: step.bit.0,
                })
                .collect(),
            transitions: graph.transitions.iter().map(|t| t.number).collect(),
        }
    }
}

impl<'a> From<&'a VariableSymbol> for VariableRow<'a> {
    fn from(variable: &'a VariableSymbol) -> Self {
        let (bit, number) = match variable.slot {
            Slot::Bit(bit) => (Some(bit.0), None),
            Slot::Number(number) => (None, Some(number.0)),
        };
        VariableRow {
            kind: match variable.kind {
                DeclarationKind::Input => "input",
                DeclarationKind::Output => "output",
                DeclarationKind::Variable { retain: false } => "variable",
                DeclarationKind::Variable { retain: true } => "retained variable",
                DeclarationKind::Parameter => "parameter",
                DeclarationKind::Constant => "constant",
            },
            ty: match variable.ty {
                Type::Bool => "bool",
                Type::Int => "int",
                Type::Time => "time",
            },
            bit,
            number,
            address: variable.address.as_deref(),
            range: variable.range,
            initial: variable.initial,
        }
    }
}
