//! From tokens to the tree: `language.md`, structure and expressions.
//!
//! Recursive descent. What is wrong is reported where it stands, then the parser goes on at the next statement,
//! element or brace, so that the next error is a real one.

mod cursor;
mod declarations;
mod expressions;
mod graphs;
mod items;
mod names;
mod properties;
mod recovery;
mod statements;
mod timers;

use crate::ast::File;
use crate::diagnostic::Diagnostic;
use crate::lexer;
pub use crate::lexer::MAX_WORD;
pub use crate::report::MAX_SYNTAX_ERRORS;
use crate::report::Report;
use crate::source::FileId;
use cursor::Parser;

/// How deep parentheses, edges, `NOT`, macro steps and `on` blocks may be nested in each other.
pub const MAX_NESTING: u32 = 200;

/// How many levels the tree of an expression may have. A chain of `AND`, `OR` or `XOR` of any length is balanced and
/// takes few; every operand of a chain of `+ - * / MOD` or of comparisons takes one.
pub const MAX_EXPRESSION_DEPTH: u32 = 256;

/// Reads one file. Never fails: what is wrong goes into `diagnostics`, what is right into the tree.
///
/// Time and memory are linear in the size of the text, the stack is bounded by [`MAX_NESTING`].
pub fn parse(file: FileId, text: &str, diagnostics: &mut Vec<Diagnostic>) -> File {
    let mut report = Report::new(diagnostics);
    let tokens = lexer::lex(file, text, &mut report).tokens;
    Parser::new(file, text, tokens, report).file()
}
