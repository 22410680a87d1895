//! Table 1 of *Structured PLC Programming using Grafcet*: for each of the four steps a mask word, a state word and an
//! output word. The compiler makes the same words of `structured_four_steps`.

#![allow(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use std::fs;

use grafcet_compiler::application::Application;
use grafcet_compiler::{Target, compile, emit};
use grafcet_core::program::{Bit, Crossing, Slot, Term};

/// The presets of one step, as table 1 has them.
struct Presets {
    /// Which bits of the input word are looked at.
    mask: u32,
    /// How they must stand for the step to be passed.
    state: u32,
    /// Which bits of the output word the step activates.
    output: u32,
}

/// Table 1, word 0 to word 3.
#[rustfmt::skip]
const TABLE_1: [Presets; 4] = [
    Presets { mask: 0b01, state: 0b01, output: 0b0000_0000_0000_0001 },
    Presets { mask: 0b10, state: 0b10, output: 0b0000_0000_0000_0011 },
    Presets { mask: 0b11, state: 0b11, output: 0b0000_0000_0000_0100 },
    Presets { mask: 0b11, state: 0b00, output: 0b0100_0000_0000_0000 },
];

fn four_steps() -> Application {
    let name = "graphs/examples/structured_four_steps/structured_four_steps.grafcet";
    let path = format!("{}/../{name}", env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(path).unwrap();
    let load = |path: &str| panic!("{path} is not imported");
    let compilation = compile(name, &text, &load, Target::Firmware);
    assert!(compilation.diagnostics.is_empty());
    compilation.application.unwrap()
}

/// The place in a 16-bit word of what has an address: 14 for `%QX1.6`.
fn place_in_word(address: &str) -> u32 {
    let (byte, bit) = address[3..].split_once('.').unwrap();
    byte.parse::<u32>().unwrap() * 8 + bit.parse::<u32>().unwrap()
}

/// The bit that a Boolean has in the input or output word by its address.
fn word_bit(application: &Application, bit: Bit) -> u32 {
    let mut variables = application.controller.symbols.variables.iter();
    let variable = variables.find(|it| it.slot == Slot::Bit(bit)).unwrap();
    1 << place_in_word(variable.address.as_deref().unwrap())
}

#[test]
fn the_trigger_behind_each_step_is_its_mask_and_state_word() {
    let application = four_steps();
    let tables = &application.controller.tables;
    let steps = &application.controller.symbols.graphs[0].steps;
    for (step, presets) in TABLE_1.iter().enumerate() {
        let transition = &tables.transitions[step];
        let crossing = tables.program().crossing(transition);
        let Crossing::Within { leaves, .. } = crossing else {
            panic!("step {step}: {crossing:?}");
        };
        assert_eq!(leaves, steps[step].bit.mask());
        // All of the trigger is the first term.
        assert_eq!(transition.fires, 0, "step {step}");
        let input_word = Term {
            word: tables.layout.inputs.start,
            mask: presets.mask,
            state: presets.state,
        };
        let [arm] = tables.steps[step].arms().of(&tables.arms) else {
            panic!("step {step} arms another number of transitions than one");
        };
        assert_eq!(usize::from(arm.transition), step);
        let term = tables.terms[usize::from(transition.term)];
        assert_eq!(term, input_word, "step {step}");
    }
}

#[test]
fn the_source_of_the_image_has_these_four_words_and_no_others() {
    let application = four_steps();
    let source = emit::source(emit::program(&application)).unwrap();
    let packed: String = source.split_whitespace().collect();
    let rows_of = |table: &str| {
        let (_, behind) = packed.split_once(&format!(",{table}:&[")).unwrap();
        let (rows, _) = behind.split_once(']').unwrap();
        rows.trim_end_matches(',').replace(",}", "}")
    };
    let word = application.controller.tables.layout.inputs.start;
    let row = |it: &Presets| {
        let (mask, state) = (it.mask, it.state);
        format!("Term{{word:{word},mask:{mask},state:{state}}}")
    };
    let rows: Vec<String> = TABLE_1.iter().map(row).collect();
    assert_eq!(rows_of("terms"), rows.join(","));
    for empty in ["codes", "ops", "timers"] {
        assert_eq!(rows_of(empty), "", "{empty}");
    }
}

#[test]
fn bits_of_the_input_word_lie_where_their_addresses_say() {
    let application = four_steps();
    let tables = &application.controller.tables;
    let mut seen = 0;
    for place in 0..2 {
        let bit = Bit(tables.layout.inputs.start * 32 + place);
        assert_eq!(word_bit(&application, bit), bit.mask());
        seen |= bit.mask();
    }
    assert_eq!(seen, TABLE_1.iter().fold(0, |all, it| all | it.mask));
}

#[test]
fn the_outputs_of_each_step_make_its_output_word() {
    let application = four_steps();
    let tables = &application.controller.tables;
    for (step, presets) in TABLE_1.iter().enumerate() {
        let statements = tables.steps[step].momentary().of(&tables.momentary);
        let mut output = 0;
        for statement in statements {
            // As long as the step is active, and under no other condition.
            assert_eq!(statement.condition, 0);
            for target in statement.targets.of(&tables.targets) {
                let places = (0..32).filter(|place| target.mask & 1 << place != 0);
                let bits = places.map(|place| Bit(target.word * 32 + place));
                output |= bits.fold(0, |word, bit| word | word_bit(&application, bit));
            }
        }
        assert_eq!(output, presets.output, "step {step}: {output:#018b}");
    }
    // Nothing else writes the outputs: a bit that is not set forces its output off.
    assert!(tables.dependent.is_empty() && tables.stored.is_empty());
    assert_eq!(tables.always_momentary.len, 0);
}
