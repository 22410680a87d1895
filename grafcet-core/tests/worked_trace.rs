//! The worked trace of `semantics.md`, on tables written by hand: 1 (initial) -> 2 {M} when ↑a; 2 -> 1 when T/X2/20ms.

use grafcet_core::Engine;
use grafcet_core::memory::Storage;
use grafcet_core::program::{
    Bit, Code, Condition, Edge, Evolution, Graph, Layout, Momentary, NumberRow, Op, Program, Run,
    Stamp, Step, Term, Transition, Unit, Watch,
};

const A: Bit = Bit(32);
const X1: Bit = Bit(64);
const X2: Bit = Bit(65);
const M: Bit = Bit(96);
const LAST: Bit = Bit(128);
const RISE: Bit = Bit(129);

const fn run(start: u16, len: u16) -> Run {
    Run { start, len }
}

const NOTHING: Step = Step {
    transitions: Run::EMPTY,
    momentary: Run::EMPTY,
    stored: Run::EMPTY,
    on_activation: Run::EMPTY,
    on_deactivation: Run::EMPTY,
    on_event: Run::EMPTY,
    orders: Run::EMPTY,
    activated: None,
};

const COUNTER: NumberRow = NumberRow {
    initial: 0,
    min: 0,
    max: i32::MAX,
};

static PROGRAM: Program<'static> = Program {
    period_ms: 10,
    evolution: Evolution::Scan,
    fingerprint: 0,
    layout: Layout {
        words: 5,
        inputs: run(1, 1),
        situations: run(2, 1),
        macros: Run::EMPTY,
        momentary: run(3, 1),
        number_inputs: Run::EMPTY,
        outside: Run::EMPTY,
        numbers: 2,
        stamps: 1,
        stack: 1,
        fired: 1,
    },
    graphs: &[Graph {
        steps: run(0, 2),
        words: run(2, 1),
        transitions: run(0, 2),
        sources: Run::EMPTY,
        initial: 0,
        enclosings: Run::EMPTY,
        orders: Run::EMPTY,
        self_orders: Run::EMPTY,
        watches: Run::EMPTY,
        self_watches: Run::EMPTY,
    }],
    hierarchy: &[0],
    steps: &[
        Step {
            transitions: run(0, 1),
            ..NOTHING
        },
        Step {
            transitions: run(1, 1),
            momentary: run(0, 1),
            activated: Some(Stamp(0)),
            ..NOTHING
        },
    ],
    macros: &[],
    transitions: &[
        Transition {
            entrance: run(0, 1),
            exit: run(1, 1),
            trigger: Condition::All(run(0, 1)),
            actions: Run::EMPTY,
        },
        Transition {
            entrance: run(1, 1),
            exit: run(0, 1),
            trigger: Condition::Code(Code { start: 0, len: 2 }),
            actions: Run::EMPTY,
        },
    ],
    links: &[X1, X2, M],
    armed_by: &[0, 1],
    situations: &[0b01],
    enclosings: &[],
    orders: &[],
    stored: &[],
    events: &[],
    always_stored: Run::EMPTY,
    momentary: &[Momentary {
        targets: run(2, 1),
        condition: Condition::Always,
    }],
    always_momentary: Run::EMPTY,
    dependent: &[],
    watches: &[Watch::Edge {
        operand: Condition::All(run(1, 1)),
        edge: Edge::Rising,
        last: LAST,
        result: RISE,
        from_false: false,
    }],
    trigger_watches: run(0, 1),
    round_watches: Run::EMPTY,
    action_watches: Run::EMPTY,
    terms: &[
        Term {
            word: 4,
            mask: 0b10,
            state: 0b10,
        },
        Term {
            word: 1,
            mask: 1,
            state: 1,
        },
    ],
    ops: &[
        Op::Constant(20),
        Op::StepTimer {
            step: X2,
            activated: Stamp(0),
            unit: Unit::Milliseconds,
        },
    ],
    numbers: &[COUNTER, COUNTER],
    initially_true: &[],
    retained: &[],
};

/// Runs the program over samples of `a`, one a scan, from a time base on; gives (active step, M) for each scan.
fn trace(samples: &[bool], idle_ms: u64) -> Vec<(usize, bool)> {
    let mut storage = Storage::<5, 2, 1, 1, 1, 1, 1>::new();
    let mut engine = Engine::new(&PROGRAM, storage.memory());
    samples
        .iter()
        .enumerate()
        .map(|(scan, a)| {
            engine.set_input(A, *a);
            match scan {
                0 => engine.start(),
                _ => engine.scan(idle_ms + scan as u64 * 10),
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
    for idle_ms in [0, (1 << 32) - 20, 1 << 40, u64::MAX / 2] {
        assert_eq!(trace(&samples, idle_ms), expected, "after {idle_ms} ms");
    }
}

#[test]
fn memory_that_is_too_small_reads_as_false_and_never_panics() {
    let mut storage = Storage::<1, 0, 0, 0, 0, 0, 0>::new();
    let mut engine = Engine::new(&PROGRAM, storage.memory());
    engine.set_input(A, true);
    engine.start();
    engine.scan(10);
    assert_eq!(engine.active_steps(0).count(), 0);
    assert!(!engine.bit(M));
}
