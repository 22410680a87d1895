//! What is kept for the next scan.

use super::*;
use crate::program::{Actors, Arm, Armed, Course, Duties, Masks, Program, Term};

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
        crossings: &GOOD.crossings[..1],
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
        crossings: &GOOD.crossings[1..2],
        ..free(1, 0, &[])
    };
    assert!(refused(fires));
}

#[test]
fn arms_say_how_it_goes_on_behind_their_steps() {
    refused! {
        arms[0] = Arm::alone(0) => Sequences;
        arms[0].next = Armed::by(1, &ALWAYS, false) => Sequences;
        arms[0].shows = Arm::SHOWS_NOTHING => Sequences;
        arms[0].course = Course::to(2, true) => Sequences;
        arms[0].course = Course::to(1, false) => Sequences;
        arms[1].course = Course::to(2, false) => Sequences;
        arms[2].course = Course::to(0, false) => Sequences;
        arms[3].shows = 1 => Sequences;
    }
}

#[test]
fn groups_of_words_do_what_their_steps_do() {
    let with = |actors: &[Actors]| {
        let program = Program { actors, ..GOOD };
        program.unsoundness()
    };
    let actors = GOOD.actors_of(0);
    assert_eq!(with(&[actors]), None);
    assert_eq!(with(&[actors, actors]), Some(Unsound::Actors));
    let more = |masks| Actors { masks, ..actors };
    for other in [
        Actors {
            momentary: 0,
            ..actors
        },
        more(Masks::NONE),
        more(Masks {
            on_event: !actors.masks.on_event,
            ..actors.masks
        }),
    ] {
        assert_eq!(with(&[other]), Some(Unsound::Actors));
    }
}

const ALWAYS: Term = Term {
    word: 0,
    mask: 0,
    state: 0,
};
