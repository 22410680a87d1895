//! One canonical layout of a program's text.
//!
//! Only white space changes. What the layout is stands in the manual ("The layout").

mod columns;
mod lines;
mod mark;
mod marks;
mod sameness;

use lines::{Comment, Line};

use crate::diagnostic::Diagnostic;
use crate::lexer::{self, Lexed};
use crate::parser::parse;
use crate::report::Report;
use crate::source::FileId;

/// Why a text is left as it is.
#[derive(Clone, Debug)]
pub enum Unformatted {
    /// It has errors of syntax.
    Wrong(Vec<Diagnostic>),
    /// The new layout would have read otherwise: a defect of the formatter.
    Otherwise,
}

/// Lays a text out. A byte order mark stays, and lines end as the first one does.
///
/// Time and memory are linear in the size of the text.
///
/// # Errors
/// When the text does not fit the grammar, or its tree of syntax or its comments would be others.
pub fn format(file: FileId, text: &str) -> Result<String, Unformatted> {
    let mut diagnostics = Vec::new();
    let tree = parse(file, text, &mut diagnostics);
    if !diagnostics.is_empty() {
        return Err(Unformatted::Wrong(diagnostics));
    }
    let lexed = lexed(file, text);
    let laid_out = laid_out(text, &lexed);
    let again = parse(file, &laid_out, &mut diagnostics);
    let same = diagnostics.is_empty()
        && sameness::said(&tree) == sameness::said(&again)
        && sameness::comments(text, &lexed)
            .eq(sameness::comments(&laid_out, &self::lexed(file, &laid_out)));
    if same {
        Ok(laid_out)
    } else {
        Err(Unformatted::Otherwise)
    }
}

fn lexed(file: FileId, text: &str) -> Lexed {
    lexer::lex(file, text, &mut Report::new(&mut Vec::new()))
}

fn laid_out(text: &str, lexed: &Lexed) -> String {
    let marked = marks::mark(text, &lexed.tokens);
    let mut lines = lines::lines(text, lexed, &marked);
    columns::align(&mut lines);
    let mut out = String::with_capacity(text.len() + text.len() / 4);
    if text.starts_with('\u{feff}') {
        out.push('\u{feff}');
    }
    for line in &lines {
        write(&mut out, line);
    }
    let first_line = text.split_once('\n').map_or("", |(line, _)| line);
    if first_line.ends_with('\r') {
        return out.replace('\n', "\r\n");
    }
    out
}

fn write(out: &mut String, line: &Line) {
    let space = |out: &mut String, width| out.extend(std::iter::repeat_n(' ', width));
    if line.blank {
        out.push('\n');
    }
    space(out, line.indent);
    for segment in &line.segments {
        space(out, segment.gap);
        out.push_str(&segment.text);
    }
    let mut column = line.indent + line.width();
    for (index, comment) in line.comments.iter().enumerate() {
        let gap = match (index, line.segments.is_empty()) {
            (0, true) => 0,
            (0, false) => line.comment_gap,
            _ => 1,
        };
        space(out, gap);
        column += gap;
        write_comment(out, comment, column);
        column += comment.text.chars().count();
    }
    out.push('\n');
}

/// A comment; the further lines of one move with the first.
fn write_comment(out: &mut String, comment: &Comment, column: usize) {
    for (index, line) in comment.text.lines().enumerate() {
        let line = line.trim_end();
        if index == 0 {
            out.push_str(line);
            continue;
        }
        out.push('\n');
        let content = line.trim_start_matches(' ');
        if !content.is_empty() {
            let old = line.len() - content.len();
            let new = (old + column).saturating_sub(comment.column);
            out.extend(std::iter::repeat_n(' ', new));
            out.push_str(content);
        }
    }
}
