//! What a program's images hold after a scan, and how people read it.

use grafcet_compiler::application::Unit;
use grafcet_core::images::Images;

/// The situation of a graph: the identifiers of its active steps in source order, separated by one space; empty
/// when no step is active (`semantics.md`, "The trace").
#[must_use]
pub fn situation(unit: &Unit, graph: usize, images: Images<'_>) -> String {
    let (Some(symbol), Some(row)) = (
        unit.symbols.graphs.get(graph),
        unit.tables.graphs.get(graph),
    ) else {
        return String::new();
    };
    let mut text = String::new();
    for step in images.active(row.words()) {
        if let Some(step) = symbol.steps.get(step) {
            if !text.is_empty() {
                text.push(' ');
            }
            text.push_str(&step.id);
        }
    }
    text
}
