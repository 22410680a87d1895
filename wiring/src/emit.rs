//! The wiring as Rust source: what `build.rs` puts beside the program.
//!
//! `InputWire`, `AnalogueWire`, `OutputWire`, `Overload` and `Policy` are types of the image; the generated items name them as the including
//! module knows them.

use grafcet_compiler::application::Application;
use grafcet_core::program::{Bit, Number, Slot};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use crate::board::Pin;
use crate::check::{Connection, Wiring};
use crate::file::Policy;
use crate::wire::{Active, AnalogueInput, DigitalInput, OutputEntry, Pull};

/// `INPUTS`, `ANALOGUE_INPUTS`, `OUTPUTS`, `RETAIN`, `STORE_WIRES`, `WATCHDOG_MS` and `OVERLOAD`: what the image is told on every machine.
#[must_use]
pub fn tables(wiring: &Wiring) -> TokenStream {
    let inputs = wiring.inputs.iter().map(input_wire);
    let analogue_inputs = wiring.analogue_inputs.iter().map(analogue_wire);
    let outputs = wiring.outputs.iter().map(output_wire);
    let [input_count, analogue_count, output_count] = counts(wiring);
    let (start, end) = (
        Literal::u32_unsuffixed(wiring.retain.start),
        Literal::u32_unsuffixed(wiring.retain.end),
    );
    let [quiet, alarm] = [wiring.store.quiet, wiring.store.alarm].map(|end| match end {
        Some(Bit(bit)) => {
            let bit = Literal::u16_unsuffixed(bit);
            quote!(Some(Bit(#bit)))
        }
        None => quote!(None),
    });
    let record_bytes = Literal::usize_unsuffixed(wiring.record_bytes);
    let watchdog_ms = Literal::u32_unsuffixed(wiring.watchdog_ms);
    let overruns = Literal::u32_unsuffixed(wiring.overload.overruns);
    let policy = match wiring.overload.policy {
        Policy::KeepRunning => quote!(KeepRunning),
        Policy::SafeStop => quote!(SafeStop),
    };
    quote! {
        /// The Boolean inputs, in the order of their pins.
        pub static INPUTS: [InputWire; #input_count] = [#(#inputs),*];

        /// The numeric inputs, in the order of their pins.
        pub static ANALOGUE_INPUTS: [AnalogueWire; #analogue_count] = [#(#analogue_inputs),*];

        /// The outputs, in the order of their pins.
        pub static OUTPUTS: [OutputWire; #output_count] = [#(#outputs),*];

        /// Where retained values lie: byte offsets in flash, whole sectors.
        pub const RETAIN: core::ops::Range<u32> = #start..#end;

        /// What of the program the store of retained values is wired to.
        pub const STORE_WIRES: crate::link::Wires = crate::link::Wires { quiet: #quiet, alarm: #alarm };

        const _: () = assert!(#record_bytes <= crate::record::LONGEST_RECORD);

        /// After so many ms without a completed scan the watchdog resets the board.
        pub const WATCHDOG_MS: u32 = #watchdog_ms;

        /// What is an overload, and what is done about it.
        pub const OVERLOAD: Overload = Overload { policy: Policy::#policy, overruns: #overruns };
    }
}

/// `INPUT_LABELS`, `ANALOGUE_LABELS` and `OUTPUT_LABELS`: what people call the terminals, for an image that runs on a
/// host.
#[must_use]
pub fn labels(wiring: &Wiring, application: &Application) -> TokenStream {
    let variables = &application.controller.symbols.variables;
    let label = |slot, pin: &Pin| {
        let variable = variables.iter().find(|it| it.slot == slot);
        let name = variable.map_or("", |variable| variable.name.as_str());
        let pin = pin.name;
        quote!(Label { name: #name, pin: #pin })
    };
    let bits = |bit, pin| label(Slot::Bit(bit), pin);
    let inputs = wiring.inputs.iter().map(|it| bits(it.place, it.pin));
    let analogue_inputs = wiring.analogue_inputs.iter();
    let analogue_inputs = analogue_inputs.map(|it| label(Slot::Number(it.place), it.pin));
    let outputs = wiring.outputs.iter().map(|it| bits(it.place, it.pin));
    let [input_count, analogue_count, output_count] = counts(wiring);
    quote! {
        /// What the Boolean inputs are called, in the order of their pins.
        pub static INPUT_LABELS: [Label; #input_count] = [#(#inputs),*];

        /// What the numeric inputs are called, in the order of their pins.
        pub static ANALOGUE_LABELS: [Label; #analogue_count] = [#(#analogue_inputs),*];

        /// What the outputs are called, in the order of their pins.
        pub static OUTPUT_LABELS: [Label; #output_count] = [#(#outputs),*];
    }
}

/// `board_pins!`, which makes of a board's peripherals the input pins, the channels of the converter and the output
/// pins, each in the order of its table. An output begins at its safe level.
#[must_use]
pub fn board_pins(wiring: &Wiring) -> TokenStream {
    let inputs = wiring.inputs.iter().map(|input| {
        let pin = peripheral(input);
        let pull = match input.entry.pull {
            Pull::Up => quote!(Up),
            Pull::Down => quote!(Down),
            Pull::None => quote!(None),
        };
        quote!(crate::boards::pico::pin::DigitalInput::new($p.#pin, embassy_rp::gpio::Pull::#pull))
    });
    let channels = wiring.analogue_inputs.iter().map(|input| {
        let pin = peripheral(input);
        quote!(embassy_rp::adc::Channel::new_pin($p.#pin, embassy_rp::gpio::Pull::None))
    });
    let outputs = wiring.outputs.iter().map(|output| {
        let pin = peripheral(output);
        let level = if output.entry.safe == (output.entry.active == Active::High) {
            quote!(High)
        } else {
            quote!(Low)
        };
        quote!(embassy_rp::gpio::Output::new($p.#pin, embassy_rp::gpio::Level::#level))
    });
    quote! {
        /// The pins of the program: inputs, analogue inputs and outputs, each in the order of its table.
        #[allow(unused_macros)]
        macro_rules! board_pins {
            ($p:ident) => {
                ([#(#inputs),*], [#(#channels),*], [#(#outputs),*])
            };
        }

        #[allow(unused_imports)]
        pub(crate) use board_pins;
    }
}

/// The lines of a linker script that name the length of the retain area.
#[must_use]
pub fn retain_script(wiring: &Wiring) -> String {
    format!("RETAIN_LENGTH = {};\n", wiring.retain.len())
}

fn counts(wiring: &Wiring) -> [Literal; 3] {
    [
        wiring.inputs.len(),
        wiring.analogue_inputs.len(),
        wiring.outputs.len(),
    ]
    .map(Literal::usize_unsuffixed)
}

fn peripheral<P, T>(connection: &Connection<P, T>) -> Ident {
    Ident::new(connection.pin.peripheral, Span::call_site())
}

fn input_wire(input: &Connection<Bit, DigitalInput>) -> TokenStream {
    let bit = Literal::u16_unsuffixed(input.place.0);
    let address = input.address.to_string();
    let active_low = input.entry.active == Active::Low;
    let filter_ms = Literal::u16_unsuffixed(input.entry.filter_ms);
    quote! {
        InputWire { bit: Bit(#bit), address: #address, active_low: #active_low, filter_ms: #filter_ms }
    }
}

fn analogue_wire(input: &Connection<Number, AnalogueInput>) -> TokenStream {
    let number = Literal::u16_unsuffixed(input.place.0);
    let address = input.address.to_string();
    let ends = [input.entry.low, input.entry.high];
    let [low, high] = ends.map(|end| Literal::i32_unsuffixed(end.value));
    let filter_ms = Literal::u16_unsuffixed(input.entry.filter_ms);
    quote! {
        AnalogueWire {
            number: Number(#number),
            address: #address,
            scale: crate::scale::Scale { low: #low, high: #high },
            filter_ms: #filter_ms
        }
    }
}

fn output_wire(output: &Connection<Bit, OutputEntry>) -> TokenStream {
    let bit = Literal::u16_unsuffixed(output.place.0);
    let address = output.address.to_string();
    let active_low = output.entry.active == Active::Low;
    let safe = output.entry.safe;
    quote! {
        OutputWire { bit: Bit(#bit), address: #address, active_low: #active_low, safe: #safe }
    }
}
