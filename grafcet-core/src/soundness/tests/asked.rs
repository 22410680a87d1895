//! What is kept for the next scan.

use std::vec;

use super::*;
use crate::program::{Course, Duties, Program, Sequel};

#[test]
fn what_the_program_asks_of_the_scan_before_is_kept() {
    program_refused! {
        marks_all = false => Layout;
    }
    // This one asks nothing but which transitions of its large graph have fired.
    let free = |fired, before, links: &'static [u16]| Program {
        marks_all: false,
        crosses_at_once: true,
        enclosings: &[],
        orders: &[],
        sources: &[],
        transitions: &GOOD.transitions[..1],
        duties: &[],
        layout: Layout {
            macros: Run::EMPTY,
            remembered: 0,
            standings: 0,
            fired,
            before,
            ..GOOD.layout
        },
        links,
        ..GOOD
    };
    let refused = |program: Program<'_>| program.unsoundness() == Some(Unsound::Layout);
    assert!(!refused(free(1, 4, &[0])));
    assert!(!refused(free(1, 0, &[0])));
    assert!(!refused(free(0, 0, &[])));
    assert!(refused(free(0, 0, &[0])));
    assert!(refused(free(1, 3, &[0])));
    let with_duty = |duty: &'static [Duties]| Program {
        duties: duty,
        ..free(0, 0, &[])
    };
    assert!(refused(with_duty(&GOOD.duties[1..2])));
    assert!(refused(with_duty(&GOOD.duties[2..3])));
    assert!(!refused(with_duty(&GOOD.duties[3..4])));
    let fires = Program {
        transitions: &GOOD.transitions[1..2],
        ..free(1, 0, &[])
    };
    assert!(refused(fires));
}

#[test]
fn arms_say_how_it_goes_on_behind_their_steps() {
    refused! {
        arms[0].sequel = Sequel::NONE => Sequences;
        arms[0].sequel.next = 1 => Sequences;
        arms[0].sequel.shows = Sequel::SHOWS_NOTHING => Sequences;
        arms[0].sequel.course = Course::to(2, true) => Sequences;
        arms[0].sequel.course = Course::to(1, false) => Sequences;
        arms[1].sequel.course = Course::to(2, false) => Sequences;
        arms[2].sequel.course = Course::to(0, false) => Sequences;
        arms[3].sequel.shows = 1 => Sequences;
    }
}

#[test]
fn what_is_not_known_is_no_row() {
    let terms = vec![GOOD.terms[1]; 65_536];
    let program = |rows: usize| Program {
        terms: &terms[..rows],
        ..GOOD
    };
    assert_eq!(program(65_535).unsoundness(), None);
    assert_eq!(program(65_536).unsoundness(), Some(Unsound::Sequences));
}
