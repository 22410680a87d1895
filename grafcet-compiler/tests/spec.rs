//! `language.md` sentence by sentence: what is accepted, what is refused, by which rule and at which characters.
//!
//! A file `spec/CHAPTER.txt` holds programs, each behind a line `== what it shows`. A line `=== title` begins a frame:
//! the programs behind it stand where the frame says `<...>`. In a program `⟦rule: text⟧` marks text that the rule must
//! underline, `⟦rule«mend»: text⟧` also what its help must say. All errors must be marked; all warnings too where the
//! title begins with `warnings:`. A line `-- path` begins a library.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use grafcet_compiler::diagnostic::{Diagnostic, Level};
use grafcet_compiler::render::{Style, render};
use grafcet_compiler::{Compilation, Target, compile};

/// One program: files by path, and what is to be said of them.
struct Case {
    title: String,
    files: BTreeMap<String, String>,
    marks: Vec<Mark>,
}

/// A rule, the characters it underlines and a part of its help.
#[derive(Clone, Debug)]
struct Mark {
    file: String,
    start: usize,
    end: usize,
    rule: String,
    help: Option<String>,
}

const MAIN: &str = "main.grafcet";

/// The programs of a file, each in its frame.
fn cases(text: &str) -> Vec<Case> {
    let mut frame = String::new();
    let mut cases = Vec::new();
    for part in format!("\n{text}").split("\n==").skip(1) {
        let (title, body) = part.split_once('\n').unwrap_or((part, ""));
        if title.starts_with('=') {
            frame = body.to_owned();
            continue;
        }
        let program = match frame.split_once("<...>") {
            Some((before, behind)) => format!("{before}{}{behind}", body.trim_end_matches('\n')),
            None => body.to_owned(),
        };
        cases.push(case(title.trim(), &program));
    }
    cases
}

fn case(title: &str, program: &str) -> Case {
    let mut case = Case {
        title: title.to_owned(),
        files: BTreeMap::new(),
        marks: Vec::new(),
    };
    for (index, part) in format!("{MAIN}\n{program}").split("\n-- ").enumerate() {
        let (path, marked) = part.split_once('\n').unwrap_or((part, ""));
        assert!(index == 0 || path != MAIN, "{title}: {path}");
        let text = unmarked(title, path, marked, &mut case.marks);
        case.files.insert(path.to_owned(), text);
    }
    case
}

/// A program without its marks; `␍` stands for a carriage return, `␂` for a byte order mark.
fn unmarked(title: &str, path: &str, marked: &str, marks: &mut Vec<Mark>) -> String {
    let mut text = String::new();
    let mut open: Vec<Mark> = Vec::new();
    let mut rest = marked;
    while let Some((at, sign)) = rest.char_indices().find(|(_, c)| "⟦⟧␍␂".contains(*c)) {
        text.push_str(&rest[..at]);
        rest = &rest[at + sign.len_utf8()..];
        match sign {
            '␍' => text.push('\r'),
            '␂' => text.push('\u{feff}'),
            '⟦' => {
                let Some((rule, behind)) = rest.split_once(": ") else {
                    panic!("{title}: a mark without a rule");
                };
                rest = behind;
                let (rule, help) = match rule.split_once('«') {
                    Some((rule, help)) => (rule, Some(help.trim_end_matches('»').to_owned())),
                    None => (rule, None),
                };
                open.push(Mark {
                    file: path.to_owned(),
                    start: text.len(),
                    end: 0,
                    rule: rule.to_owned(),
                    help,
                });
            }
            _ => {
                assert!(!open.is_empty(), "{title}: a mark ends that did not begin");
                marks.extend(open.pop().map(|mark| Mark {
                    end: text.len(),
                    ..mark
                }));
            }
        }
    }
    assert!(open.is_empty(), "{title}");
    text.push_str(rest);
    text
}

/// What is wrong with what the compiler says of a program.
fn faults(case: &Case) -> Vec<String> {
    let load = |path: &str| match case.files.get(path) {
        Some(text) => Ok(text.clone()),
        None => Err(io::Error::from(io::ErrorKind::NotFound)),
    };
    let compilation = compile(MAIN, &case.files[MAIN], &load, Target::Host);
    let every = case.title.starts_with("warnings:");
    let mut marks = case.marks.clone();
    let mut faults = Vec::new();
    for diagnostic in &compilation.diagnostics {
        let place = place(&compilation, diagnostic);
        let help = diagnostic.help.as_deref().unwrap_or("");
        let there =
            |mark: &Mark| (mark.file.as_str(), mark.start, mark.end, mark.rule.as_str()) == place;
        let says = |mark: &Mark| {
            mark.help
                .as_deref()
                .is_none_or(|wanted| help.contains(wanted))
        };
        let exact = marks.iter().position(|mark| there(mark) && says(mark));
        match exact.or_else(|| marks.iter().position(there)) {
            Some(marked) => {
                let mark = marks.swap_remove(marked);
                if let Some(wanted) = mark.help.as_ref().filter(|_| !says(&mark)) {
                    faults.push(format!("help `{help}` does not say `{wanted}`"));
                }
            }
            None if every || diagnostic.level() == Level::Error => {
                faults.push(format!("not expected: {}", place.3));
            }
            None => {}
        }
    }
    faults.extend(marks.iter().map(|mark| {
        let text = &case.files[&mark.file][mark.start..mark.end];
        format!("expected: {} at `{text}`", mark.rule)
    }));
    if !faults.is_empty() {
        faults.push(render(
            &compilation.diagnostics,
            &compilation.sources,
            Style::default(),
        ));
    }
    faults
}

fn place<'a>(
    compilation: &'a Compilation,
    diagnostic: &Diagnostic,
) -> (&'a str, usize, usize, &'static str) {
    let span = diagnostic.span;
    let path = compilation.sources.get(span.file);
    (
        path.map_or("", |source| &source.path),
        span.start as usize,
        span.end as usize,
        diagnostic.rule.name(),
    )
}

fn directory() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/spec")
}

fn check(chapter: &str) {
    let path = directory().join(format!("{chapter}.txt"));
    let text =
        fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let cases = cases(&text);
    assert!(cases.len() >= 2, "{chapter} holds programs");
    let faults: Vec<String> = cases
        .iter()
        .map(|case| (case, faults(case)))
        .filter(|(_, faults)| !faults.is_empty())
        .map(|(case, faults)| format!("== {}\n{}", case.title, faults.join("\n")))
        .collect();
    assert!(
        faults.is_empty(),
        "{} of {}:\n{}",
        faults.len(),
        cases.len(),
        faults.join("\n")
    );
}

macro_rules! chapters {
    ($($chapter:ident)*) => {
        $(#[test]
        fn $chapter() {
            check(stringify!($chapter));
        })*

        #[test]
        fn every_chapter_is_checked() {
            let held: BTreeSet<String> = [$(concat!(stringify!($chapter), ".txt").to_owned(),)*].into();
            let files = fs::read_dir(directory()).unwrap();
            let all = files.map(|file| file.unwrap().file_name().into_string().unwrap());
            assert_eq!(held, all.collect());
        }
    };
}

chapters! {
    lexical
    names
    literals
    declarations
    graphs
    expressions
    templates
    macros
    claims
    warnings
    recovery
    wide
}
