//! A controller whose tables hold every kind of row and every operation.

use grafcet_compiler::application::{
    Application, GraphSymbol, Plant, StepSymbol, Symbols, Tables, TransitionSymbol, Unit,
    VariableSymbol, Wire,
};
use grafcet_compiler::ast::{DeclarationKind, Type};
use grafcet_compiler::source::Span;
use grafcet_core::program::{
    Assignment, Bit, Code, Condition, Dependent, Edge, Enclosing, Event, Evolution, Forced, Graph,
    Layout, Macro, Momentary, Number, NumberRow, Op, Order, Retained, Run, Slot, Stamp, Step,
    Stored, Term, Transition, Unit as PresetUnit, Watch,
};

const fn run(start: u16, len: u16) -> Run {
    Run { start, len }
}

const COMPARED: Condition = Condition::Code(Code { start: 0, len: 3 });
const FIVE: Code = Code { start: 1, len: 1 };

/// The application: the controller, and a plant that is the same program.
pub fn application() -> Application {
    let tables = tables();
    Application {
        name: "every_row".into(),
        text: None,
        plants: vec![Plant {
            name: "Mirror".into(),
            unit: Unit {
                tables: tables.clone(),
                symbols: Symbols::default(),
            },
            reads: vec![Wire {
                from: Slot::Bit(Bit(160)),
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
        ],
        variables: vec![
            variable("Locked", Slot::Bit(Bit(192))),
            variable("G:température", Slot::Number(Number(3))),
        ],
    }
}

fn tables() -> Tables {
    Tables {
        period_ms: 10,
        evolution: Evolution::Stable,
        fingerprint: 0xfeed_beef,
        layout: Layout {
            words: 8,
            inputs: run(1, 1),
            situations: run(2, 2),
            macros: run(4, 1),
            momentary: run(5, 1),
            number_inputs: run(2, 1),
            outside: run(7, 1),
            numbers: 4,
            stamps: 4,
            stack: 2,
            fired: 1,
        },
        graphs: vec![
            Graph {
                steps: run(0, 3),
                words: run(2, 1),
                transitions: run(0, 2),
                sources: Run::EMPTY,
                initial: 0,
                enclosings: Run::EMPTY,
                orders: Run::EMPTY,
                self_orders: run(1, 1),
                watches: Run::EMPTY,
                self_watches: Run::EMPTY,
            },
            Graph {
                steps: run(3, 1),
                words: run(3, 1),
                transitions: run(2, 1),
                sources: run(2, 1),
                initial: 1,
                enclosings: run(0, 1),
                orders: Run::EMPTY,
                self_orders: Run::EMPTY,
                watches: Run::EMPTY,
                self_watches: Run::EMPTY,
            },
        ],
        hierarchy: vec![0, 1],
        steps: (0..4).map(step).collect(),
        macros: vec![Macro {
            bit: Bit(128),
            graph: 0,
            steps: run(1, 2),
            activated: None,
        }],
        transitions: vec![
            transition(run(0, 1), run(1, 1), Condition::All(run(0, 1))),
            transition(run(1, 1), run(0, 1), COMPARED),
            transition(Run::EMPTY, run(2, 1), Condition::Always),
        ],
        links: vec![Bit(64), Bit(65), Bit(96), Bit(160)],
        armed_by: vec![0, 1, 2],
        situations: vec![0b001, 0b1, 0b101],
        enclosings: vec![Enclosing {
            step: Bit(65),
            situation: 1,
            at_start: Some(1),
        }],
        orders: vec![order(1, Forced::Current), order(0, Forced::Set(2))],
        stored: vec![
            Stored {
                assignment: Assignment::Bit(Bit(192), COMPARED),
                condition: Condition::Always,
            },
            Stored {
                assignment: Assignment::Number(Number(3), FIVE),
                condition: COMPARED,
            },
        ],
        events: vec![Event {
            event: Bit(194),
            stored: run(1, 1),
        }],
        always_stored: run(0, 1),
        momentary: vec![momentary(Condition::Always)],
        always_momentary: Run::EMPTY,
        dependent: vec![
            Dependent {
                owner: Some(Bit(64)),
                statement: momentary(COMPARED),
            },
            Dependent {
                owner: None,
                statement: momentary(Condition::Code(Code { start: 3, len: 36 })),
            },
        ],
        watches: watches(),
        trigger_watches: run(0, 2),
        round_watches: run(2, 1),
        action_watches: run(3, 3),
        terms: vec![Term {
            word: 1,
            mask: 0x8000_0001,
            state: 1,
        }],
        ops: ops(),
        numbers: [(0, i32::MIN, i32::MAX), (0, 0, 0), (-5, -7, -1), (1, 0, 9)]
            .map(|(initial, min, max)| NumberRow { initial, min, max })
            .to_vec(),
        initially_true: vec![Bit(192)],
        retained: vec![
            Retained {
                slot: Slot::Bit(Bit(192)),
                key: u32::MAX,
            },
            Retained {
                slot: Slot::Number(Number(3)),
                key: 2,
            },
        ],
    }
}

fn step(index: u16) -> Step {
    Step {
        transitions: run(index.min(2), u16::from(index < 2)),
        momentary: run(0, 1),
        stored: run(0, 1),
        on_activation: run(1, 1),
        on_deactivation: run(0, 2),
        on_event: run(0, 1),
        orders: run(0, u16::from(index == 2)),
        activated: (index == 0).then_some(Stamp(0)),
    }
}

fn transition(entrance: Run, exit: Run, trigger: Condition) -> Transition {
    Transition {
        entrance,
        exit,
        trigger,
        actions: run(1, 1),
    }
}

fn order(graph: u16, situation: Forced) -> Order {
    Order {
        graph,
        rank: 1 - graph,
        situation,
        condition: Condition::Always,
    }
}

fn momentary(condition: Condition) -> Momentary {
    Momentary {
        targets: run(3, 1),
        condition,
    }
}

fn watches() -> Vec<Watch> {
    let edge = |edge, first| Watch::Edge {
        operand: Condition::All(run(0, 1)),
        edge,
        last: Bit(first),
        result: Bit(first + 1),
        from_false: edge == Edge::Rising,
    };
    vec![
        edge(Edge::Rising, 193),
        edge(Edge::Falling, 195),
        Watch::Timer {
            enable: COMPARED,
            preset: FIVE,
            unit: PresetUnit::Seconds,
            last: Bit(197),
            risen: Stamp(1),
            result: Bit(198),
        },
        Watch::OnDelay {
            enable: Condition::Always,
            delay: FIVE,
            last: Bit(199),
            risen: Stamp(2),
            result: Bit(200),
        },
        Watch::OffDelay {
            on: Condition::Always,
            hold: FIVE,
            last: Bit(201),
            fallen: Stamp(3),
            result: Bit(202),
        },
        Watch::Value {
            condition: Condition::Always,
            gate: Some(Bit(64)),
            result: Bit(203),
        },
    ]
}

/// `x < 5` in front, then every other operation in one expression.
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
    ops.extend([Op::Bit(Bit(0)), Op::And, Op::Not]);
    ops
}
