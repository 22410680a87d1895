//! Diagnostics as people and programs read them.

use grafcet_compiler::diagnostic::{Diagnostic, Rule};
use grafcet_compiler::position::{Position, line_column};
use grafcet_compiler::render::{Style, render, render_json};
use grafcet_compiler::source::{FileId, Sources, Span};

fn sources(text: &str) -> Sources {
    let mut sources = Sources::default();
    sources.add("drill.grafcet", text);
    sources
}

/// The place of the first occurrence of a piece of the text.
fn span(text: &str, piece: &str) -> Span {
    let Some(start) = text.find(piece) else {
        panic!("{piece:?} is not in the text")
    };
    let offset = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
    Span {
        file: FileId(0),
        start: offset(start),
        end: offset(start + piece.len()),
    }
}

fn plain(diagnostics: &[Diagnostic], text: &str) -> String {
    render(diagnostics, &sources(text), Style::default())
}

#[test]
fn a_diagnostic_has_its_rule_place_source_and_help() {
    let text = "graph G {\n    step 1 { SPINN }\n}\n";
    let diagnostic = Diagnostic::new(
        Rule::UnknownName,
        span(text, "SPINN"),
        "nothing is called `SPINN`",
    )
    .help("did you mean `SPIN`?");
    assert_eq!(
        plain(&[diagnostic], text),
        "error[unknown-name]: nothing is called `SPINN`\n \
         --> drill.grafcet:2:14\n  |\n\
         2 |     step 1 { SPINN }\n  |              ^^^^^\n  |\nhelp: did you mean `SPIN`?\n\n"
    );
}

#[test]
fn a_warning_says_so() {
    let text = "input a\n";
    let diagnostic = Diagnostic::new(Rule::Unused, span(text, "a"), "no one reads `a`");
    assert!(
        plain(&[diagnostic], text)
            .starts_with("warning[unused]: no one reads `a`\n --> drill.grafcet:1:7\n")
    );
}

#[test]
fn further_places_are_labelled() {
    let text = "input a\ninput b\ninput a\n";
    let second = Span {
        start: 22,
        end: 23,
        ..span(text, "a")
    };
    let diagnostic = Diagnostic::new(Rule::DuplicateName, second, "`a` is declared twice")
        .label(span(text, "a"), "declared here first");
    assert_eq!(
        plain(&[diagnostic], text),
        "error[duplicate-name]: `a` is declared twice\n --> drill.grafcet:3:7\n  |\n\
         1 | input a\n  |       - declared here first\n2 | input b\n3 | input a\n  |       ^\n\n"
    );
}

#[test]
fn a_label_in_another_file_shows_that_file() {
    let mut sources = sources("graph A = Saw\n");
    let library = sources.add("lib/saws.grafcet", "template Saw { }\n");
    let diagnostic = Diagnostic::new(
        Rule::TemplateBinding,
        Span {
            file: FileId(0),
            start: 10,
            end: 13,
        },
        "`up` is not bound",
    )
    .label(
        Span {
            file: library,
            start: 9,
            end: 12,
        },
        "the template",
    );
    let drawn = render(&[diagnostic], &sources, Style::default());
    assert!(drawn.contains(" --> drill.grafcet:1:11\n"), "{drawn}");
    assert!(drawn.contains(" ::: lib/saws.grafcet:1:10\n"), "{drawn}");
    assert!(drawn.contains("the template"), "{drawn}");
}

#[test]
fn a_label_far_away_costs_no_lines_between() {
    let text = format!("input a\n{}input a\n", "// nothing\n".repeat(10_000));
    let end = u32::try_from(text.len()).unwrap();
    let diagnostic = Diagnostic::new(
        Rule::DuplicateName,
        Span {
            file: FileId(0),
            start: end - 2,
            end: end - 1,
        },
        "`a` is declared twice",
    )
    .label(span(&text, "a"), "declared here first");
    let drawn = plain(&[diagnostic], &text);
    assert!(drawn.contains("--> drill.grafcet:10002:7\n"), "{drawn}");
    assert!(drawn.contains("::: drill.grafcet:1:7\n"), "{drawn}");
    assert!(drawn.lines().count() < 15, "{drawn}");
}

#[test]
fn columns_are_counted_in_characters() {
    let text = "// é\nvar température, 温度, x\n";
    let diagnostic = Diagnostic::new(Rule::Unused, span(text, "x"), "no one reads `x`");
    assert!(plain(&[diagnostic], text).contains("--> drill.grafcet:2:22\n"));
}

#[test]
fn a_place_over_several_lines_is_underlined_on_its_first() {
    let text = "graph G {\n    step 1\n}\n";
    let diagnostic = Diagnostic::new(Rule::Unused, span(text, text), "the whole graph");
    let drawn = plain(&[diagnostic], text);
    assert!(drawn.contains("1 | graph G {\n  | ^^^^^^^^^\n"), "{drawn}");
}

#[test]
fn the_end_of_a_file_is_a_place() {
    for text in ["", "input a", "input a\n", "input a\r\n"] {
        let end = u32::try_from(text.len()).unwrap();
        let place = Span {
            file: FileId(0),
            start: end,
            end,
        };
        let drawn = plain(
            &[Diagnostic::new(Rule::Syntax, place, "something is missing")],
            text,
        );
        let Position { line, column } = line_column(text, text.len());
        assert!(
            drawn.contains(&format!("--> drill.grafcet:{line}:{column}\n")),
            "{text:?}\n{drawn}"
        );
    }
}

#[test]
fn of_a_long_line_a_part_is_shown() {
    let text = format!(
        "var {}, wrong, {}",
        "a, ".repeat(100_000),
        "b, ".repeat(100_000)
    );
    let diagnostic = Diagnostic::new(Rule::Unused, span(&text, "wrong"), "no one reads `wrong`");
    let drawn = plain(&[diagnostic], &text);
    assert!(drawn.contains("--> drill.grafcet:1:300007\n"), "{drawn}");
    assert!(drawn.contains("wrong, b, b,"), "{drawn}");
    assert!(drawn.len() < 1_000, "{drawn}");
}

#[test]
fn diagnostics_stand_in_the_order_of_their_places() {
    let text = "input a\ninput b\ninput c\n";
    let all: Vec<_> = ["c", "a", "b"]
        .into_iter()
        .map(|name| Diagnostic::new(Rule::Unused, span(text, &format!(" {name}")), name))
        .collect();
    let drawn = plain(&all, text);
    let titles: Vec<_> = drawn
        .lines()
        .filter(|line| line.starts_with("warning"))
        .collect();
    assert_eq!(
        titles,
        [
            "warning[unused]: a",
            "warning[unused]: b",
            "warning[unused]: c"
        ]
    );
}

#[test]
fn colours_are_drawn_only_when_asked_for() {
    let text = "input a\n";
    let diagnostic = [Diagnostic::new(
        Rule::Unused,
        span(text, "a"),
        "no one reads `a`",
    )];
    assert!(!plain(&diagnostic, text).contains('\u{1b}'));
    assert!(render(&diagnostic, &sources(text), Style { color: true }).contains('\u{1b}'));
}

#[test]
fn a_place_outside_its_file_is_drawn_at_its_end() {
    let place = Span {
        file: FileId(0),
        start: 100,
        end: 200,
    };
    let drawn = plain(&[Diagnostic::new(Rule::Syntax, place, "lost")], "input a\n");
    assert!(drawn.starts_with("error[syntax]: lost\n"), "{drawn}");
    let nowhere = Span {
        file: FileId(7),
        start: 1,
        end: 2,
    };
    let drawn = plain(
        &[Diagnostic::new(Rule::Syntax, nowhere, "lost")],
        "input a\n",
    );
    assert!(drawn.starts_with("error[syntax]: lost\n"), "{drawn}");
}

#[test]
fn programs_read_one_object_a_line() {
    let text = "input \"é\", a\ngraph G {\n}\n";
    let all = [
        Diagnostic::new(
            Rule::Syntax,
            span(text, "graph G {\n}"),
            "a \"graph\"\nof two lines",
        ),
        Diagnostic::new(Rule::Unused, span(text, "a"), "no one reads `a`").help("remove it"),
    ];
    let drawn = render_json(&all, &sources(text));
    let objects: Vec<serde_json::Value> = drawn
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(
        objects,
        [
            serde_json::json!({
                "rule": "unused", "level": "warning", "message": "no one reads `a`", "file": "drill.grafcet",
                "line": 1, "column": 12, "end": { "line": 1, "column": 13 }, "help": "remove it",
            }),
            serde_json::json!({
                "rule": "syntax", "level": "error", "message": "a \"graph\"\nof two lines", "file": "drill.grafcet",
                "line": 2, "column": 1, "end": { "line": 3, "column": 2 }, "help": null,
            }),
        ]
    );
}
