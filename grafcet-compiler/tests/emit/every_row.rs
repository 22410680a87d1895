//! A controller whose tables hold every kind of row and every operation.

use grafcet_compiler::application::{
    Application, GraphSymbol, Plant, StepSymbol, Symbols, Tables, TransitionSymbol, Unit,
    VariableSymbol, Wire,
};
use grafcet_compiler::ast::{DeclarationKind, Type};
use grafcet_compiler::source::Span;
use grafcet_core::program::{
    Assignment, Bit, Code, Condition, Dependent, Edge, Edges, Enclosing, Event, Evolution, Forced,
    Layout, Macro, Momentary, Number, NumberRow, Op, Order, Preset, Rest, Retained, Run, Seen,
    Since, Slot, Stamp, Stored, Target, Term, Timer, Unit as PresetUnit, Watch,
};

use self::structure::{
    BLOCKS, FIRST_TERMS, across, arm, blocks, duties, graphs, masks, roles, step, transition,
    within,
};

#[path = "structure.rs"]
mod structure;

const fn run(start: u16, len: u16) -> Run {
    Run { start, len }
}

const fn only(rest: Rest) -> Condition {
    Condition {
        terms: Run::EMPTY,
        rest,
    }
}

const COMPARED: Condition = only(Rest::Code(0));
const BOTH: Condition = Condition {
    terms: run(0, 1),
    rest: Rest::Logic(1),
};
const FIVE: Code = Code { start: 1, len: 1 };

/// The application: the controller, and a plant that is the same program but evolves `stable`.
pub fn application() -> Application {
    let tables = tables();
    Application {
        name: "every_row".into(),
        text: None,
        plants: vec![Plant {
            name: "Mirror".into(),
            unit: Unit {
                tables: stable(tables.clone()),
                symbols: Symbols::default(),
            },
            reads: vec![Wire {
                from: Slot::Bit(Bit(224)),
                to: Slot::Bit(Bit(32)),
            }],
            writes: vec![Wire {
                from: Slot::Number(Number(3)),
                to: Slot::Number(Number(2)),
            }],
        }],
        controller: Unit {
            tables,
            symbols: symbols(),
        },
        tests: Vec::new(),
    }
}

fn symbols() -> Symbols {
    let span = Span::default();
    let graph = |name: &str, ids: &[&str], numbers: &[u32]| GraphSymbol {
        name: name.into(),
        text: None,
        steps: ids
            .iter()
            .map(|id| StepSymbol {
                id: (*id).into(),
                bit: Bit(0),
                text: None,
                span,
            })
            .collect(),
        transitions: numbers
            .iter()
            .map(|&number| TransitionSymbol { number, span })
            .collect(),
        span,
    };
    let variable = |name: &str, slot| VariableSymbol {
        name: name.into(),
        graph: None,
        kind: DeclarationKind::Variable { retain: true },
        ty: Type::Bool,
        slot,
        address: None,
        range: None,
        initial: 0,
        text: None,
        bound: false,
        span,
    };
    Symbols {
        graphs: vec![
            graph("G", &["1", "E2", "S3"], &[1, 2]),
            graph("H", &["1"], &[7]),
            graph("I", &["1"], &[8, 9]),
        ],
        variables: vec![
            variable("Locked", Slot::Bit(Bit(256))),
            variable("G:température", Slot::Number(Number(3))),
        ],
    }
}

/// What `evolution stable` changes.
fn stable(tables: Tables) -> Tables {
    Tables {
        evolution: Evolution::Stable,
        layout: Layout {
            passed: 1,
            ..tables.layout
        },
        edges: Vec::new(),
        ..tables
    }
}

fn tables() -> Tables {
    let mut tables = Tables {
        period_ms: 10,
        evolution: Evolution::Scan,
        fingerprint: 0xfeed_beef,
        layout: Layout {
            words: 13,
            inputs: run(1, 1),
            situations: run(2, 4),
            macros: run(6, 1),
            momentary: run(7, 1),
            number_inputs: run(2, 1),
            outside: run(9, 1),
            numbers: 4,
            stamps: 4,
            since: 1,
            stack: 2,
            fired: 1,
            passed: 0,
            remembered: 5,
            standings: 3,
            shown: 0,
            sets: 0,
            armed: 0,
            before: 5,
        },
        read_inputs: vec![0xc000_0001],
        reads_first_scan: true,
        crosses_at_once: false,
        marks_all: true,
        graphs: graphs(),
        roles: roles(),
        hierarchy: vec![0, 1, 2],
        blocks: blocks(),
        masks: BLOCKS.map(masks).to_vec(),
        actors: vec![],
        steps: (0..37).map(step).collect(),
        duties: duties(),
        macros: vec![Macro {
            bit: Bit(192),
            graph: 0,
            steps: run(1, 2),
            activated: None,
        }],
        transitions: vec![
            transition(0, 1),
            transition(1, 2),
            transition(2, 0),
            transition(3, 3),
            transition(4, 4),
        ],
        crossings: vec![
            within(0b01, 0b10),
            within(0b10, 0b01),
            within(0, 0b1),
            across(0, 1),
            across(1, 0),
        ],
        do_blocks: vec![Run::EMPTY, run(1, 1)],
        links: vec![0, 32],
        arms: (0..5).map(arm).collect(),
        situations: vec![0b001, 0b1, 0b101, 0b1, 0b0],
        enclosings: vec![Enclosing {
            step: Bit(65),
            situation: 1,
            at_start: Some(1),
        }],
        orders: vec![order(1, Forced::Current), order(0, Forced::Set(2))],
        sources: vec![1],
        lasting_in_steps: true,
        momentary_varies: true,
        stores_on_change: true,
        stored: vec![
            Stored {
                assignment: Assignment::Bit(Bit(256), COMPARED),
                condition: Condition::ALWAYS,
            },
            Stored {
                assignment: Assignment::Number(Number(3), FIVE),
                condition: COMPARED,
            },
        ],
        events: vec![Event {
            event: Bit(258),
            stored: run(1, 1),
        }],
        always_stored: run(0, 1),
        targets: vec![Target {
            word: 7,
            mask: 0x8000_0001,
        }],
        momentary: vec![momentary(0), momentary(1)],
        always_momentary: Run::EMPTY,
        dependent: vec![
            Dependent {
                owner: Some(Bit(64)),
                statement: momentary(2),
            },
            Dependent {
                owner: None,
                statement: momentary(5),
            },
        ],
        edges: vec![Edges {
            word: 1,
            last: 10,
            rises: Some(Seen { word: 11, bits: 1 }),
            falls: Some(Seen {
                word: 12,
                bits: 0x8000_0000,
            }),
        }],
        watches: watches(),
        trigger_watches: run(0, 2),
        round_watches: run(2, 1),
        action_watches: run(3, 3),
        conditions: vec![
            Condition::ALWAYS,
            BOTH,
            COMPARED,
            only(Rest::Elapsed(0)),
            only(Rest::Running(1)),
            only(Rest::Code(2)),
        ],
        terms: vec![term(1, 0x8000_0001, 1), FIRST_TERMS[0], FIRST_TERMS[1]],
        timers: vec![
            timer(Preset::Constant(500)),
            timer(Preset::Number(Number(3), PresetUnit::Seconds)),
            Timer::Own {
                since: Since(0),
                preset: Preset::Constant(10),
            },
        ],
        codes: vec![
            Code { start: 0, len: 3 },
            Code { start: 3, len: 4 },
            Code { start: 7, len: 37 },
        ],
        ops: ops(),
        numbers: [(0, i32::MIN, i32::MAX), (0, 0, 0), (-5, -7, -1), (1, 0, 9)]
            .map(|(initial, min, max)| NumberRow { initial, min, max })
            .to_vec(),
        initially_true: vec![Bit(256)],
        retained: vec![
            Retained {
                slot: Slot::Bit(Bit(256)),
                key: u32::MAX,
            },
            Retained {
                slot: Slot::Number(Number(3)),
                key: 2,
            },
        ],
    };
    tables.actors = vec![tables.program().actors_of(0)];
    tables
}

fn term(word: u16, mask: u32, state: u32) -> Term {
    Term { word, mask, state }
}

fn timer(preset: Preset) -> Timer {
    Timer::Any {
        step: Bit(64),
        activated: Stamp(0),
        preset,
    }
}

fn order(graph: u16, situation: Forced) -> Order {
    Order {
        graph,
        by: 0,
        rank: 1 - graph,
        situation,
        condition: Condition::ALWAYS,
    }
}

fn momentary(condition: u16) -> Momentary {
    Momentary {
        targets: run(0, 1),
        condition,
    }
}

fn watches() -> Vec<Watch> {
    let edge = |edge, first| Watch::Edge {
        operand: BOTH,
        edge,
        last: Bit(first),
        result: Bit(first + 1),
        from_false: edge == Edge::Rising,
    };
    vec![
        edge(Edge::Rising, 257),
        edge(Edge::Falling, 259),
        Watch::Timer {
            enable: COMPARED,
            preset: FIVE,
            unit: PresetUnit::Seconds,
            last: Bit(261),
            risen: Stamp(1),
            result: Bit(262),
        },
        Watch::OnDelay {
            enable: Condition::ALWAYS,
            delay: FIVE,
            last: Bit(263),
            risen: Stamp(2),
            result: Bit(264),
        },
        Watch::OffDelay {
            on: Condition::ALWAYS,
            hold: FIVE,
            last: Bit(265),
            fallen: Stamp(3),
            result: Bit(266),
        },
        Watch::Value {
            condition: Condition::ALWAYS,
            gate: Some(Bit(64)),
            result: Bit(267),
        },
    ]
}

/// `x < 5` in front, then logic, then every other operation in one expression.
fn ops() -> Vec<Op> {
    let two = [
        Op::And,
        Op::Or,
        Op::Xor,
        Op::Add,
        Op::Subtract,
        Op::Multiply,
        Op::Divide,
        Op::Modulo,
        Op::Equal,
        Op::NotEqual,
        Op::Less,
        Op::LessOrEqual,
        Op::Greater,
        Op::GreaterOrEqual,
    ];
    let mut ops = vec![Op::Number(Number(3)), Op::Constant(5), Op::Less];
    ops.extend([Op::Bit(Bit(32)), Op::Not, Op::Elapsed(1), Op::Or]);
    ops.push(Op::Constant(i32::MIN));
    for op in two {
        ops.extend([Op::Constant(-1), op]);
    }
    ops.extend([Op::Not, Op::Negate]);
    for unit in [PresetUnit::Milliseconds, PresetUnit::Seconds] {
        ops.push(Op::StepTimer {
            step: Bit(64),
            activated: Stamp(0),
            unit,
        });
    }
    ops.extend([Op::Bit(Bit(0)), Op::And, Op::Not, Op::AndElapsed(2)]);
    ops
}
