//! Diagnostics as people and programs read them.
//!
//! The drawing is `annotate-snippets`, rustc's own; the excerpts it gets are kept small, so that many diagnostics in
//! a large file, or on a long line, cost time in proportion to their number.

use std::ops::Range;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{Annotation, AnnotationKind, Group, Origin, Renderer, Snippet};
use serde::Serialize;

use crate::diagnostic::{Diagnostic, Level, NamedRule};
use crate::position::{Lines, Position};
use crate::source::{FileId, Sources, Span};

/// How diagnostics are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Style {
    /// With the colours of a terminal (ANSI escapes).
    pub color: bool,
}

/// All diagnostics in the order of their places, each with its source underlined and a blank line behind it.
///
/// The first line of each is `error[rule]: sentence` or `warning[rule]: sentence`, the second ` --> file:line:column`.
#[must_use]
pub fn render<R: NamedRule>(
    diagnostics: &[Diagnostic<R>],
    sources: &Sources,
    style: Style,
) -> String {
    let renderer = if style.color {
        Renderer::styled()
    } else {
        Renderer::plain()
    };
    let renderer = renderer.decor_style(DecorStyle::Ascii).term_width(WIDTH);
    let mut pages = Pages::of(sources);
    let mut text = String::new();
    for diagnostic in sorted(diagnostics) {
        text.push_str(&renderer.render(&report(diagnostic, &mut pages)));
        text.push_str("\n\n");
    }
    text
}

/// All diagnostics in the order of their places, one JSON object a line: `rule`, `level`, `message`, `file`, `line`,
/// `column`, `end` (an object with `line` and `column`, just behind the last character) and `help` (or null).
#[must_use]
pub fn render_json<R: NamedRule>(diagnostics: &[Diagnostic<R>], sources: &Sources) -> String {
    #[derive(Serialize)]
    struct Record<'a> {
        rule: &'a str,
        level: &'a str,
        message: &'a str,
        file: &'a str,
        #[serde(flatten)]
        start: Position,
        end: Position,
        help: Option<&'a str>,
    }
    let mut pages = Pages::of(sources);
    let mut text = String::new();
    for diagnostic in sorted(diagnostics) {
        let page = pages.page(diagnostic.span.file);
        let record = Record {
            rule: diagnostic.rule.name(),
            level: match diagnostic.level() {
                Level::Error => "error",
                Level::Warning => "warning",
            },
            message: &diagnostic.message,
            file: page.path,
            start: page.lines.position(diagnostic.span.start as usize),
            end: page.lines.position(diagnostic.span.end as usize),
            help: diagnostic.help.as_deref(),
        };
        // Strings and numbers in a struct always become JSON.
        text.push_str(&serde_json::to_string(&record).unwrap_or_default());
        text.push('\n');
    }
    text
}

/// By place; those at one place in the order in which they were found.
fn sorted<R: NamedRule>(diagnostics: &[Diagnostic<R>]) -> Vec<&Diagnostic<R>> {
    let mut sorted: Vec<_> = diagnostics.iter().collect();
    sorted.sort_by_key(|diagnostic| (diagnostic.span, diagnostic.rule));
    sorted
}

/// A file, its lines found.
#[derive(Clone)]
struct Page<'a> {
    path: &'a str,
    text: &'a str,
    lines: Lines<'a>,
}

/// The files that diagnostics point into; the lines of each are found once.
struct Pages<'a> {
    sources: &'a Sources,
    pages: Vec<(FileId, Page<'a>)>,
}

impl<'a> Pages<'a> {
    fn of(sources: &'a Sources) -> Self {
        Pages {
            sources,
            pages: Vec::new(),
        }
    }

    fn page(&mut self, file: FileId) -> &Page<'a> {
        let at = match self.pages.iter().position(|(known, _)| *known == file) {
            Some(at) => at,
            None => {
                let (path, text) = match self.sources.get(file) {
                    Some(source) => (source.path.as_str(), source.text.as_str()),
                    None => ("", ""),
                };
                let lines = Lines::of(text);
                self.pages.push((file, Page { path, text, lines }));
                self.pages.len() - 1
            }
        };
        &self.pages[at].1
    }
}

/// A place that is to be underlined, cut to its first line.
struct Mark<'d> {
    span: Span,
    start: usize,
    end: usize,
    primary: bool,
    label: Option<&'d str>,
}

/// The title, the place, the excerpts and the help of one diagnostic.
fn report<'a, R: NamedRule>(
    diagnostic: &'a Diagnostic<R>,
    pages: &mut Pages<'a>,
) -> Vec<Group<'a>> {
    let level = match diagnostic.level() {
        Level::Error => annotate_snippets::Level::ERROR,
        Level::Warning => annotate_snippets::Level::WARNING,
    };
    let title = level
        .primary_title(diagnostic.message.as_str())
        .id(diagnostic.rule.name());
    let mut group = Group::with_title(title);
    for marks in clusters(diagnostic, pages) {
        if let Some(first) = marks.first() {
            let page = pages.page(first.span.file);
            group = match excerpt(page, &marks) {
                Excerpt::Lines(snippet) => group.element(snippet.path(page.path)),
                Excerpt::Part(snippet) => {
                    let position = page.lines.position(first.start);
                    let origin = Origin::path(page.path)
                        .line(position.line)
                        .char_column(position.column);
                    group.element(origin).element(snippet)
                }
            };
        }
    }
    let mut groups = vec![group];
    if let Some(help) = &diagnostic.help {
        groups.push(Group::with_title(
            annotate_snippets::Level::HELP.secondary_title(help.as_str()),
        ));
    }
    groups
}

/// An excerpt of whole lines is at most so many bytes long.
const LONGEST_EXCERPT: usize = 4096;

/// Of a line of more bytes than this a part is shown.
const LONGEST_LINE: usize = 200;

/// Columns of a drawing: room for a line and its number.
const WIDTH: usize = LONGEST_LINE + 40;

/// The places of a diagnostic, those that are near each other together, the main one first.
fn clusters<'a, R: NamedRule>(
    diagnostic: &'a Diagnostic<R>,
    pages: &mut Pages<'a>,
) -> Vec<Vec<Mark<'a>>> {
    let main = (diagnostic.span, true, None);
    let others = diagnostic
        .labels
        .iter()
        .map(|label| (label.span, false, Some(label.message.as_str())));
    let mut clusters: Vec<Vec<Mark>> = Vec::new();
    for (span, primary, label) in std::iter::once(main).chain(others) {
        let page = pages.page(span.file);
        let start = page.text.floor_char_boundary(span.start as usize);
        let (_, line_end) = page.lines.bounds(page.lines.line(start));
        let start = start.min(line_end);
        let end = page
            .text
            .ceil_char_boundary(span.end as usize)
            .clamp(start, line_end);
        let mark = Mark {
            span,
            start,
            end,
            primary,
            label,
        };
        let near = clusters.iter_mut().find(|cluster| {
            let marks = || cluster.iter().chain([&mark]);
            cluster.iter().all(|other| other.span.file == span.file) && go_together(page, marks)
        });
        match near {
            Some(cluster) => cluster.push(mark),
            None => clusters.push(vec![mark]),
        }
    }
    clusters
}

/// Whether one excerpt shows several places: whole lines that are few, or a part of one line.
fn go_together<'m, 'a: 'm, I>(page: &Page<'a>, marks: impl Fn() -> I) -> bool
where
    I: Iterator<Item = &'m Mark<'a>>,
{
    let (first, last) = ends(marks());
    let (lines, whole) = lines_about(page, first, last);
    if whole {
        lines.len() <= LONGEST_EXCERPT
    } else {
        page.lines.line(first) == page.lines.line(last) && last - first <= LONGEST_LINE / 2
    }
}

/// Where the first mark begins and the last ends.
fn ends<'m, 'a: 'm>(marks: impl Iterator<Item = &'m Mark<'a>>) -> (usize, usize) {
    let places = marks.map(|mark| (mark.start, mark.end));
    let widest = places.reduce(|(first, last), (start, end)| (first.min(start), last.max(end)));
    widest.unwrap_or_default()
}

/// The lines from one place to another, and whether neither the first nor the last of them is too long to be shown.
fn lines_about(page: &Page, first: usize, last: usize) -> (Range<usize>, bool) {
    let bounds = |offset| page.lines.bounds(page.lines.line(offset));
    let ((from, first_end), (last_start, to)) = (bounds(first), bounds(last));
    let whole = first_end - from <= LONGEST_LINE && to - last_start <= LONGEST_LINE;
    (from..to, whole)
}

/// What is shown of a file.
enum Excerpt<'a> {
    /// Whole lines.
    Lines(Snippet<'a, Annotation<'a>>),
    /// A part of one line, whose columns the drawing cannot count.
    Part(Snippet<'a, Annotation<'a>>),
}

/// The lines from the first mark to the last; of a line that is too long what is about its marks.
fn excerpt<'a>(page: &Page<'a>, marks: &[Mark<'a>]) -> Excerpt<'a> {
    const CUT: &str = "...";
    let (first, last) = ends(marks.iter());
    let (lines, whole) = lines_about(page, first, last);
    let line = page.lines.line(first);
    let shown = |range: Range<usize>| page.text.get(range).unwrap_or("");
    // Marks on what is shown from one byte of the file to another, with something in front of it.
    let annotations = |from: usize, to: usize, before: usize| {
        let place = move |at: usize| at.clamp(from, to) - from + before;
        marks.iter().map(move |mark| {
            let kind = if mark.primary {
                AnnotationKind::Primary
            } else {
                AnnotationKind::Context
            };
            let span = place(mark.start)..place(mark.end);
            kind.span(span).label(mark.label)
        })
    };
    if whole {
        let annotations = annotations(lines.start, lines.end, 0);
        let snippet = Snippet::source(shown(lines)).line_start(line);
        return Excerpt::Lines(snippet.annotations(annotations));
    }
    let (start, end) = page.lines.bounds(line);
    let from = first.saturating_sub(LONGEST_LINE / 4).max(start);
    let from = page.text.floor_char_boundary(from);
    let to = page.text.floor_char_boundary(end.min(from + LONGEST_LINE));
    let before = if from > start { CUT } else { "" };
    let behind = if to < end { CUT } else { "" };
    let text = format!("{before}{}{behind}", shown(from..to));
    let snippet = Snippet::source(text).line_start(line);
    Excerpt::Part(snippet.annotations(annotations(from, to, before.len())))
}
