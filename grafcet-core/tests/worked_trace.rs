//! The worked trace of `semantics.md`, on tables written by hand: 1 (initial) -> 2 {M} when ↑a; 2 -> 1 when T/X2/20ms.

use grafcet_core::Engine;
use grafcet_core::program::{
    Arm, Armed, Bit, Block, Condition, Course, Crossing, Duties, Edges, Evolution, Graph, Layout,
    Masks, Momentary, NumberRow, Preset, Program, Rest, Role, Run, Seen, Stamp, Step, Target, Term,
    Timer, Transition,
};

const A: Bit = Bit(32);
const X2: Bit = Bit(65);
const M: Bit = Bit(96);

const fn run(start: u16, len: u16) -> Run {
    Run { start, len }
}

/// `↑a`.
const PRESSED: Term = Term {
    word: 5,
    mask: 1,
    state: 1,
};
const ALWAYS: Term = Term {
    word: 0,
    mask: 0,
    state: 0,
};

const NOTHING: Duties = Duties {
    stored: Run::EMPTY,
    on_activation: Run::EMPTY,
    on_deactivation: Run::EMPTY,
    on_event: Run::EMPTY,
    orders: Run::EMPTY,
    activated: None,
    since: None,
};

const COUNTER: NumberRow = NumberRow {
    initial: 0,
    min: 0,
    max: i32::MAX,
};

/// Word 1: inputs; 2: steps; 3: outputs; 4: the inputs in the scan before; 5: their rising edges.
static PROGRAM: Program<'static> = Program {
    period_ms: 10,
    evolution: Evolution::Scan,
    fingerprint: 0,
    layout: Layout {
        words: 32,
        inputs: run(1, 1),
        situations: run(2, 1),
        macros: Run::EMPTY,
        momentary: run(3, 1),
        number_inputs: Run::EMPTY,
        outside: Run::EMPTY,
        numbers: 2,
        stamps: 1,
        since: 0,
        stack: 0,
        fired: 1,
        passed: 0,
        remembered: 0,
        standings: 0,
        shown: 0,
        sets: 0,
        armed: 8,
        before: 1,
    },
    read_inputs: &[1],
    reads_first_scan: false,
    crosses_at_once: false,
    marks_all: true,
    graphs: &[Graph {
        steps: run(0, 2),
        first_word: 2,
        transitions: run(0, 2),
        initial: 0,
        role: 0,
    }],
    roles: &[Role::NONE],
    hierarchy: &[0],
    blocks: &[Block {
        first: 0,
        masks: 0,
        momentary: 0b10,
    }],
    masks: &[Masks {
        timed: 0b10,
        ..Masks::NONE
    }],
    actors: &[],
    steps: &[
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 0,
            arm_count: 1,
            momentary_count: 0,
        },
        Step {
            first_arm: 1,
            first_momentary: 0,
            duties: 1,
            arm_count: 1,
            momentary_count: 1,
        },
    ],
    duties: &[
        NOTHING,
        Duties {
            activated: Some(Stamp(0)),
            ..NOTHING
        },
    ],
    macros: &[],
    transitions: &[
        Transition {
            fires: 0,
            term: 0,
            crossing: 0,
        },
        Transition {
            fires: 1,
            term: 1,
            crossing: 1,
        },
    ],
    crossings: &[
        Crossing::Within {
            actions: 0,
            leaves: 0b01,
            enters: 0b10,
        },
        Crossing::Within {
            actions: 0,
            leaves: 0b10,
            enters: 0b01,
        },
    ],
    do_blocks: &[Run::EMPTY],
    links: &[],
    arms: &[
        Arm {
            transition: 0,
            course: Course::to(1, true),
            shows: 0,
            next: Armed::by(1, &ALWAYS, true),
        },
        Arm {
            transition: 1,
            course: Course::to(0, true),
            shows: 1,
            next: Armed::by(0, &PRESSED, false),
        },
    ],
    situations: &[0b01],
    enclosings: &[],
    orders: &[],
    sources: &[],
    lasting_in_steps: false,
    momentary_varies: false,
    stores_on_change: false,
    stored: &[],
    events: &[],
    always_stored: Run::EMPTY,
    targets: &[Target { word: 3, mask: 1 }],
    momentary: &[Momentary {
        targets: run(0, 1),
        condition: 0,
    }],
    always_momentary: Run::EMPTY,
    dependent: &[],
    edges: &[Edges {
        word: 1,
        last: 4,
        rises: Some(Seen { word: 5, bits: 1 }),
        falls: None,
    }],
    watches: &[],
    trigger_watches: Run::EMPTY,
    round_watches: Run::EMPTY,
    action_watches: Run::EMPTY,
    conditions: &[
        Condition::ALWAYS,
        Condition {
            terms: Run::EMPTY,
            rest: Rest::Elapsed(0),
        },
    ],
    terms: &[PRESSED, ALWAYS],
    timers: &[Timer::Any {
        step: X2,
        activated: Stamp(0),
        preset: Preset::Constant(20),
    }],
    codes: &[],
    ops: &[],
    numbers: &[COUNTER, COUNTER],
    initially_true: &[],
    retained: &[],
};

const _: () = grafcet_core::soundness::demand(&PROGRAM);

grafcet_core::storage!(Storage {
    image: 32,
    numbers: 2,
    before: 1,
    before_scan: 0,
    fired: 1,
    passed: 0,
    stack: 0,
    stamps: 1,
    since: 0,
    standings: 0,
    shown: 0,
    sets: 0,
    armed: 8
});

const _: () = assert!(Storage::is_sized_for(&PROGRAM));

grafcet_core::storage!(Small {
    image: 1,
    numbers: 0,
    before: 0,
    before_scan: 0,
    fired: 0,
    passed: 0,
    stack: 0,
    stamps: 0,
    since: 0,
    standings: 0,
    shown: 0,
    sets: 0,
    armed: 0
});

/// Runs the program over samples of `a`, one a scan, from a time base on; gives (active step, M) for each scan.
fn trace(samples: &[bool], idle_ms: u64) -> Vec<(usize, bool)> {
    let mut engine = Engine::new(&PROGRAM, Storage::new());
    samples
        .iter()
        .enumerate()
        .map(|(scan, a)| {
            engine.set_input(A, *a);
            match scan {
                0 => engine.start(),
                _ => {
                    engine.scan(idle_ms + scan as u64 * 10);
                }
            }
            let active: Vec<_> = engine.active_steps(0).map(|step| step + 1).collect();
            assert_eq!(active.len(), 1, "one token in a loop of two steps");
            (active[0], engine.bit(M))
        })
        .collect()
}

#[test]
fn a_held_button_is_no_edge_and_a_pressed_one_acts_in_the_scan_that_reads_it() {
    let samples = [true, true, false, true, true, false];
    let expected = [
        (1, false),
        (1, false),
        (1, false),
        (2, true),
        (2, true),
        (1, false),
    ];
    assert_eq!(trace(&samples, 0), expected);
}

#[test]
fn timers_are_exact_after_any_running_time() {
    let samples = [false, true, true, true];
    let expected = [(1, false), (2, true), (2, true), (1, false)];
    for idle_ms in [0, (1 << 32) - 20, 1 << 40, u64::MAX / 4] {
        assert_eq!(trace(&samples, idle_ms), expected, "after {idle_ms} ms");
    }
}

#[test]
fn memory_that_is_too_small_reads_as_false_and_never_panics() {
    let mut engine = Engine::new(&PROGRAM, Small::new());
    engine.set_input(A, true);
    engine.start();
    engine.scan(10);
    assert_eq!(engine.active_steps(0).count(), 0);
    assert!(!engine.bit(M));
}
