//! Columns: what stands below its like lines up.

use super::lines::{Kind, LAST_GAP, Line};
use super::mark::{Class, Column};

/// In the order of a line.
const COLUMNS: [Column; 11] = [
    Column::Name,
    Column::Type,
    Column::At,
    Column::StepText { lead: 0 },
    Column::StepText { lead: 1 },
    Column::StepText { lead: 2 },
    Column::StepText { lead: 3 },
    Column::Entrance,
    Column::Condition,
    Column::BoundTo,
    Column::Last,
];

/// Where the names of inputs and outputs stand.
const NAME: usize = "output ".len();

/// Lines up the columns of statements of one class that follow each other, then the comments at the ends of lines.
/// An empty line or another statement ends a group, a line that is only a comment does not.
pub(super) fn align(lines: &mut [Line]) {
    let mut group: Vec<usize> = Vec::new();
    let mut of = (Class::Other, 0);
    for at in 0..lines.len() {
        let line = &lines[at];
        let class = match line.kind {
            Kind::Rest if line.blank => Class::Other,
            Kind::Rest => continue,
            Kind::Statement(class) => class,
        };
        if line.blank || (class, line.indent) != of {
            align_group(lines, &group);
            group.clear();
            of = (class, lines[at].indent);
        }
        if class != Class::Other {
            group.push(at);
        }
    }
    align_group(lines, &group);
    align_comments(lines);
}

fn align_group(lines: &mut [Line], group: &[usize]) {
    for column in COLUMNS {
        // The column stands behind the longest of what stands before it.
        let reach = |line: &Line| match place(line, column) {
            Some(_) if column == Column::Name => Some(NAME),
            Some(index) => Some(reach_of(line, index)),
            None if column == Column::Last && waits(line) => Some(line.width() + LAST_GAP),
            None => None,
        };
        let Some(stop) = group.iter().filter_map(|&at| reach(&lines[at])).max() else {
            continue;
        };
        for &at in group {
            let line = &mut lines[at];
            if let Some(index) = place(line, column) {
                let missing = stop - reach_of(line, index);
                line.segments[index].gap += missing;
            }
        }
    }
}

/// A step without a block, whose text the blocks of the others should not cut into. An initial step most often has
/// none, and does not count.
fn waits(line: &Line) -> bool {
    let is_initial = line
        .segments
        .first()
        .is_some_and(|it| it.text.starts_with("initial"));
    line.kind == Kind::Statement(Class::Step) && !line.opens && !is_initial
}

/// The segment that begins such a column.
fn place(line: &Line, column: Column) -> Option<usize> {
    line.segments
        .iter()
        .position(|segment| segment.column == Some(column))
}

/// Where a segment begins.
fn reach_of(line: &Line, index: usize) -> usize {
    let before = line.segments.iter().take(index);
    let width: usize = before.map(|segment| segment.gap + segment.width).sum();
    width + line.segments.get(index).map_or(0, |segment| segment.gap)
}

/// Comments that end lines which follow each other line up.
fn align_comments(lines: &mut [Line]) {
    let mut at = 0;
    while at < lines.len() {
        let indent = lines[at].indent;
        let end = lines[at..]
            .iter()
            .enumerate()
            .position(|(index, line)| {
                let ends = line.segments.is_empty() || line.comments.is_empty();
                ends || line.indent != indent || index > 0 && line.blank
            })
            .map_or(lines.len(), |length| at + length);
        let run = &mut lines[at..end];
        let widest = run.iter().map(Line::width).max().unwrap_or(0);
        for line in run {
            line.comment_gap = widest + LAST_GAP - line.width();
        }
        at = end.max(at + 1);
    }
}
