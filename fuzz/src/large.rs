//! Texts as large as asked for, each of one shape that might cost more than its size: what stands in it again and again
//! refers to all the rest, nests, or is wrong.

mod claims;
mod expressions;
mod instances;
mod lexical;
mod names;
mod structure;

/// A shape of text.
pub struct Shape {
    /// What it is called.
    pub name: &'static str,
    make: fn(usize) -> String,
}

impl Shape {
    /// A text of that shape with about so many bytes.
    #[must_use]
    pub fn text(&self, bytes: usize) -> String {
        (self.make)(bytes)
    }
}

/// All shapes.
#[must_use]
pub fn shapes() -> Vec<&'static Shape> {
    let all = [
        lexical::SHAPES,
        names::SHAPES,
        expressions::SHAPES,
        structure::SHAPES,
        instances::SHAPES,
        claims::SHAPES,
    ];
    all.into_iter().flatten().collect()
}

/// A part again and again.
fn repeated(part: &str, bytes: usize) -> String {
    part.repeat(bytes / part.len())
}

/// A numbered part again and again.
fn each(bytes: usize, part: impl Fn(usize) -> String) -> String {
    let mut text = String::with_capacity(bytes);
    let mut number = 0;
    while text.len() < bytes {
        text += &part(number);
        number += 1;
    }
    text
}

/// As many numbered parts as the other text of that size has, and one more.
fn so_many(count: usize, part: impl Fn(usize) -> String) -> String {
    (0..count).map(part).collect()
}

/// A graph whose only action has that condition.
fn condition(condition: &str) -> String {
    format!("input a, b\noutput M\ngraph G {{ initial step 1 {{ M IF {condition} }} }}\n")
}

/// A graph with initial steps of so many bytes.
fn steps(graph: &str, bytes: usize) -> String {
    let steps = each(bytes, |number| format!("initial step {number}\n"));
    format!("graph {graph} {{ {steps} }}\n")
}
