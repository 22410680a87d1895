//! The tables of the manual that list the examples.

use std::collections::BTreeSet;
use std::fs;

use crate::directory::{graphs, names};

/// The cells of every row that begins with a name, of all tables.
fn rows() -> Vec<Vec<String>> {
    let page = fs::read_to_string(graphs().join("../docs/src/examples.md")).expect("it is there");
    page.lines()
        .filter(|line| line.starts_with("| `"))
        .map(|line| {
            let cells = line.trim_matches('|').split('|');
            cells.map(|cell| cell.trim().to_owned()).collect()
        })
        .collect()
}

/// The examples, and the programs that stand beside them.
fn programs() -> BTreeSet<String> {
    let beside = fs::read_dir(graphs()).expect("the programs can be read");
    let beside = beside.filter_map(|entry| {
        let name = entry.expect("an entry can be read").file_name();
        Some(name.to_str()?.strip_suffix(".grafcet")?.to_owned())
    });
    beside.chain(names()).collect()
}

#[test]
fn the_tables_list_every_program_once_and_nothing_else() {
    let mut unlisted = programs();
    let mut too_many = Vec::new();
    for row in rows() {
        let name = row[0].trim_matches('`');
        if !unlisted.remove(name) {
            too_many.push(name.to_owned());
        }
    }
    assert_eq!((unlisted, too_many), (BTreeSet::new(), Vec::new()));
}

#[test]
fn every_row_says_what_it_is_and_what_it_teaches() {
    for row in rows() {
        assert_eq!(row.len(), 3, "{row:?}");
        assert!(row.iter().all(|cell| !cell.is_empty()), "{row:?}");
    }
}
