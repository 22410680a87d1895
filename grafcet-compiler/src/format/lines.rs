//! Where lines begin and how far they are indented: the tokens and comments of a text, set into lines.

use super::mark::{Class, Column, Mark, Marked, Role};
use crate::lexer::Lexed;
use crate::source::Span;

/// So many spaces for each block around a line, and for a statement that goes on.
const INDENT: usize = 4;

/// The least space before what ends a line: the text of a declaration, the block of a step, a comment.
pub(super) const LAST_GAP: usize = 2;

/// A line to be.
#[derive(Clone, Debug, Default)]
pub(super) struct Line<'t> {
    /// How many spaces stand before it.
    pub(super) indent: usize,
    /// An empty line stands before it.
    pub(super) blank: bool,
    /// How it lines up with others.
    pub(super) kind: Kind,
    /// What stands in it; nothing in a line that is only a comment.
    pub(super) segments: Vec<Segment>,
    /// The comments that end it.
    pub(super) comments: Vec<Comment<'t>>,
    /// The space before them.
    pub(super) comment_gap: usize,
    /// It ends with the `{` of a block over several lines.
    pub(super) opens: bool,
    /// Index of the statement that it begins with.
    statement: Option<usize>,
    /// Its latest token.
    end: Option<Role>,
}

/// How a line lines up with those above and below.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Kind {
    /// A comment only, or what goes on from the line above: no one minds it.
    #[default]
    Rest,
    /// A statement of some class alone.
    Statement(Class),
}

/// A part of a line from one column to the next.
#[derive(Clone, Debug, Default)]
pub(super) struct Segment {
    /// The column that it begins.
    pub(super) column: Option<Column>,
    /// The space before it.
    pub(super) gap: usize,
    /// The tokens in it.
    pub(super) text: String,
    /// How many characters they have.
    pub(super) width: usize,
}

impl Segment {
    fn push(&mut self, gap: usize, text: &str) {
        self.text.extend(std::iter::repeat_n(' ', gap));
        self.text.push_str(text);
        self.width += gap + text.chars().count();
    }
}

impl Line<'_> {
    /// How far its tokens reach, the indentation not counted.
    pub(super) fn width(&self) -> usize {
        self.segments.iter().map(|it| it.gap + it.width).sum()
    }
}

/// A comment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Comment<'t> {
    /// As it is written.
    pub(super) text: &'t str,
    /// How many characters stand before it in its line of the source, if it goes over several lines.
    pub(super) column: usize,
}

/// The line breaks in front of a token or comment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Before {
    None,
    Break,
    Blank,
}

/// A token or a comment.
#[derive(Clone, Copy, Debug)]
struct Piece<'t> {
    text: &'t str,
    before: Before,
    what: What<'t>,
}

#[derive(Clone, Copy, Debug)]
enum What<'t> {
    /// The token of an index.
    Token(usize),
    Comment(Comment<'t>),
}

/// A line must end here, wherever the author ended it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Due {
    No,
    /// Behind the `{` of a block over several lines.
    AfterOpen,
    /// Behind its `}`.
    AfterClose,
}

/// Sets a text into lines.
pub(super) fn lines<'t>(text: &'t str, lexed: &Lexed, marked: &'t Marked) -> Vec<Line<'t>> {
    let pieces = pieces(text, lexed);
    let leading = leading(&pieces);
    let mut setter = Setter {
        marked,
        lines: Vec::new(),
        blocks: vec![Indents::default()],
        due: Due::No,
    };
    let mut next_token = 0;
    let mut behind_comment = false;
    for (piece, leads) in pieces.iter().zip(leading) {
        match piece.what {
            What::Token(index) => {
                setter.token(index, piece, behind_comment);
                next_token = index + 1;
                behind_comment = false;
            }
            What::Comment(comment) => {
                setter.comment(comment, piece.before, next_token, leads);
                behind_comment = true;
            }
        }
    }
    setter.lines
}

/// The tokens and comments of a text in source order, without its end.
fn pieces<'t>(text: &'t str, lexed: &Lexed) -> Vec<Piece<'t>> {
    let content = lexed.tokens.split_last().map_or(&[][..], |(_, rest)| rest);
    let mut pieces = Vec::with_capacity(content.len() + lexed.comments.len());
    let mut comments = lexed.comments.iter().peekable();
    let mut end = 0;
    let mut push = |what: Option<usize>, span: Span| {
        let slice = |start, end| text.get(start..end).unwrap_or("");
        let (start, stop) = (span.start as usize, span.end as usize);
        let mut breaks = slice(end, start).matches('\n').count();
        // A comment over several lines ends a line.
        if let Some(Piece {
            text,
            what: What::Comment(_),
            ..
        }) = pieces.last()
            && text.contains('\n')
        {
            breaks = breaks.max(1);
        }
        end = stop;
        let text = slice(start, stop).trim_end();
        pieces.push(Piece {
            text,
            before: match breaks {
                0 => Before::None,
                1 => Before::Break,
                _ => Before::Blank,
            },
            what: what.map_or_else(
                || {
                    What::Comment(Comment {
                        text,
                        column: column(slice(0, start), text),
                    })
                },
                What::Token,
            ),
        });
    };
    for (index, token) in content.iter().enumerate() {
        while let Some(comment) = comments.next_if(|comment| comment.start < token.start) {
            push(None, *comment);
        }
        push(Some(index), token.span(Default::default()));
    }
    for comment in comments {
        push(None, *comment);
    }
    pieces
}

/// How many characters stand before a comment in its line. Only of one that goes over several lines: no line has two
/// of these, so that the time for all is linear.
fn column(before: &str, comment: &str) -> usize {
    if !comment.contains('\n') {
        return 0;
    }
    let line = before.rfind('\n').map_or(before, |end| &before[end + 1..]);
    line.trim_start_matches('\u{feff}').chars().count()
}

/// For each piece whether it is a comment with a token behind it on its line.
fn leading(pieces: &[Piece]) -> Vec<bool> {
    let mut leading = vec![false; pieces.len()];
    for at in (1..pieces.len()).rev() {
        let is_token = matches!(pieces[at].what, What::Token(_));
        leading[at - 1] = pieces[at].before == Before::None
            && matches!(pieces[at - 1].what, What::Comment(_))
            && (is_token || leading[at]);
    }
    leading
}

/// The indentation of a block.
#[derive(Clone, Copy, Debug, Default)]
struct Indents {
    /// Of the line with its braces.
    outer: usize,
    /// Of what stands in it.
    inner: usize,
}

struct Setter<'t> {
    marked: &'t Marked,
    lines: Vec<Line<'t>>,
    /// The blocks that are open, the innermost last.
    blocks: Vec<Indents>,
    due: Due,
}

impl<'t> Setter<'t> {
    fn mark(&self, token: usize) -> Option<&'t Mark> {
        self.marked.marks.get(token)
    }

    fn token(&mut self, index: usize, piece: &Piece<'t>, behind_comment: bool) {
        let Some(mark) = self.mark(index) else {
            return;
        };
        let breaks = match mark.role {
            Role::CloseBlock { long } => long,
            // They stand on the line that they end, unless a comment has ended it.
            Role::OpenBlock { .. } | Role::Semicolon => {
                behind_comment && piece.before > Before::None || self.lines.is_empty()
            }
            _ => piece.before > Before::None || self.due != Due::No || self.lines.is_empty(),
        };
        if let Role::CloseBlock { .. } = mark.role {
            let block = self.blocks.pop().unwrap_or_default();
            if breaks {
                self.begin_line(block.outer, false);
            }
        } else if breaks {
            let blank = piece.before == Before::Blank && mark.begins;
            self.begin_line(self.indent_of(Some(mark)), blank);
        }
        self.push(mark, piece.text);
        match mark.role {
            Role::OpenBlock { long } => {
                let outer = self.lines.last().map_or(0, |line| line.indent);
                self.blocks.push(Indents {
                    outer,
                    inner: outer + INDENT,
                });
                if long {
                    self.due = Due::AfterOpen;
                }
            }
            Role::CloseBlock { long: true } => self.due = Due::AfterClose,
            _ => {}
        }
    }

    fn comment(&mut self, comment: Comment<'t>, before: Before, next: usize, leads: bool) {
        let next = self
            .mark(next)
            .filter(|_| next + 1 < self.marked.marks.len());
        let breaks =
            before > Before::None || self.due == Due::AfterOpen && leads || self.lines.is_empty();
        if breaks {
            let between_statements = next
                .is_none_or(|it| it.begins || matches!(it.role, Role::CloseBlock { long: true }));
            let blank = before == Before::Blank && between_statements;
            self.begin_line(self.indent_of(next), blank);
        }
        if let Some(line) = self.lines.last_mut() {
            line.comments.push(comment);
        }
    }

    /// The indentation of a line that begins with such a token, or with a comment before it.
    fn indent_of(&self, mark: Option<&Mark>) -> usize {
        let inner = self.blocks.last().map_or(0, |block| block.inner);
        let goes_on = mark.is_some_and(|mark| {
            !mark.begins
                && !matches!(
                    mark.role,
                    Role::Semicolon | Role::OpenBlock { .. } | Role::CloseBlock { .. }
                )
        });
        if goes_on { inner + INDENT } else { inner }
    }

    fn begin_line(&mut self, indent: usize, blank: bool) {
        self.lines.push(Line {
            indent,
            blank: blank && self.due != Due::AfterOpen && !self.lines.is_empty(),
            ..Line::default()
        });
        self.due = Due::No;
    }

    /// Adds a token to the line.
    fn push(&mut self, mark: &Mark, text: &str) {
        let Some(line) = self.lines.last_mut() else {
            return;
        };
        let statements = &self.marked.statements;
        if line.segments.is_empty() && line.comments.is_empty() {
            if mark.begins {
                line.statement = Some(mark.statement);
                let class = statements.get(mark.statement).map(|it| it.class);
                line.kind = Kind::Statement(class.unwrap_or(Class::Other));
            } else if matches!(mark.role, Role::CloseBlock { .. } | Role::OpenBlock { .. }) {
                line.kind = Kind::Statement(Class::Other);
            }
            line.segments.push(Segment::default());
        } else if mark.begins && line.has_neighbour(mark.statement, statements) {
            line.stand_alone();
        }
        line.take_comments();
        let long_block = mark.role == Role::OpenBlock { long: true };
        let gap = match line.end {
            None => usize::from(line.width() > 0),
            Some(role) => gap(role, mark.role),
        };
        let column = mark
            .column
            .filter(|_| line.statement == Some(mark.statement) && !long_block);
        let gap = match column {
            Some(Column::Last) => LAST_GAP,
            _ => gap,
        };
        if column.is_some() {
            line.segments.push(Segment {
                column,
                gap,
                ..Segment::default()
            });
        }
        if let Some(segment) = line.segments.last_mut() {
            segment.push(if column.is_some() { 0 } else { gap }, &squeezed(text));
        }
        line.end = Some(mark.role);
        line.opens = long_block;
    }
}

impl Line<'_> {
    /// Whether another statement of the same block stands in it already.
    fn has_neighbour(&self, statement: usize, statements: &[super::mark::Statement]) -> bool {
        let depth = |index: usize| statements.get(index).map(|it| it.depth);
        self.statement
            .is_some_and(|own| own != statement && depth(own) == depth(statement))
    }

    /// Lines up with no other.
    fn stand_alone(&mut self) {
        self.kind = Kind::Statement(Class::Other);
        self.statement = None;
        for segment in &mut self.segments {
            if segment.column.take() == Some(Column::Last) {
                segment.gap = 1;
            }
        }
    }

    /// Takes the comments at its end among its tokens: it goes on behind them.
    fn take_comments(&mut self) {
        if self.comments.is_empty() {
            return;
        }
        self.stand_alone();
        if self.segments.is_empty() {
            self.segments.push(Segment::default());
        }
        for comment in std::mem::take(&mut self.comments) {
            let gap = usize::from(self.width() > 0);
            if let Some(segment) = self.segments.last_mut() {
                segment.push(gap, comment.text);
            }
        }
        // Behind a comment stands what stands behind a word.
        self.end = Some(Role::Plain);
    }
}

/// The space between two tokens of a line.
fn gap(left: Role, right: Role) -> usize {
    match (left, right) {
        (Role::OpenBlock { .. }, Role::CloseBlock { .. }) => 0,
        (Role::OpenBlock { .. }, _) => 1,
        (Role::Prefix | Role::Joint, _) | (_, Role::Suffix | Role::Joint | Role::Semicolon) => 0,
        _ => 1,
    }
}

/// A token with single spaces in it: `2  s` is `2 s`. A text stays as it is.
fn squeezed(token: &str) -> std::borrow::Cow<'_, str> {
    if token.starts_with('"') || !token.contains(char::is_whitespace) {
        return token.into();
    }
    let parts: Vec<&str> = token.split_whitespace().collect();
    parts.join(" ").into()
}
