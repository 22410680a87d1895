//! Inputs: filtered, and put into the input image.

use embassy_time::{Duration, Instant, Timer};
use embedded_hal::digital::InputPin;
use grafcet_core::engine::Engine;
use grafcet_core::memory::Memory;
use grafcet_core::program::Compiled;
use heapless::Vec;

use crate::analogue::{Analogue, Converter};
use crate::filter::{Filter, SAMPLE_US};
use crate::wiring::InputWire;

const SAMPLE: Duration = Duration::from_micros(SAMPLE_US as u64);

/// A pin that a filter can follow.
pub trait Latched: InputPin {
    /// Whether its level has changed since this was last asked, however short it was another one; none for a pin that
    /// cannot tell.
    fn take_changed(&mut self) -> Option<bool>;
}

/// The inputs of the program on their pins: N Booleans and A numbers.
pub struct Inputs<P, C, const N: usize, const A: usize> {
    terminals: Vec<Terminal<P>, N>,
    analogue: Analogue<C, A>,
    /// When the filtered inputs are sampled next; none when there are none.
    next_sample: Option<Instant>,
}

/// A pin with what is wired to it.
struct Terminal<P> {
    pin: P,
    wire: &'static InputWire,
    filter: Filter,
}

impl<P: Latched, C: Converter, const N: usize, const A: usize> Inputs<P, C, N, A> {
    /// The pins of the wires, in their order, and the analogue inputs.
    pub fn new(pins: [P; N], wires: &'static [InputWire; N], analogue: Analogue<C, A>) -> Self {
        let now = Instant::now();
        let mut terminals = Vec::new();
        for (mut pin, wire) in pins.into_iter().zip(wires) {
            let filter = Filter::new(wire.filter_ms, is_true(&mut pin, wire), micros(now));
            // There is room for each of the N pins.
            let _ = terminals.push(Terminal { pin, wire, filter });
        }
        let filtered = wires.iter().any(|wire| wire.filter_ms > 0) || analogue.is_filtered();
        Inputs {
            terminals,
            analogue,
            next_sample: filtered.then_some(now.saturating_add(SAMPLE)),
        }
    }

    /// Samples the filtered inputs every millisecond until `release`, and the Booleans then too.
    pub async fn watch_until(&mut self, release: Instant) {
        while let Some(next) = self.next_sample
            && next < release
        {
            Timer::at(next).await;
            self.sample_filtered();
        }
        Timer::at(release).await;
        self.sample_filtered();
    }

    /// Writes the input image of a scan: the filtered inputs as their filters see them, the others as they are.
    pub fn read(&mut self, engine: &mut Engine<impl Compiled, impl Memory>) {
        for Terminal { pin, wire, filter } in &mut self.terminals {
            let value = match wire.filter_ms {
                0 => is_true(pin, wire),
                _ => filter.read(),
            };
            engine.set_input(wire.bit, value);
        }
        for (number, value) in self.analogue.values() {
            engine.sample_number(number, value);
        }
    }

    fn sample_filtered(&mut self) {
        let Some(next) = self.next_sample else {
            return;
        };
        let now = Instant::now();
        for Terminal { pin, wire, filter } in &mut self.terminals {
            if wire.filter_ms > 0 {
                // In this order: what changes after the question is an answer to the next one.
                let changed = pin.take_changed();
                filter.sample(is_true(pin, wire), changed, micros(now));
            }
        }
        // A mean is one of evenly spaced samples.
        if now >= next {
            self.analogue.sample();
        }
        // What was missed is not made up for.
        let following = [
            next,
            next.saturating_add(SAMPLE),
            now.saturating_add(SAMPLE),
        ];
        self.next_sample = following.into_iter().find(|it| *it > now);
    }
}

/// The value at the pin. A pin that cannot be read shows False; those of a microcontroller always can.
fn is_true(pin: &mut impl InputPin, wire: &InputWire) -> bool {
    let level = if wire.active_low {
        pin.is_low()
    } else {
        pin.is_high()
    };
    level.unwrap_or(false)
}

/// The clock, wrapping around after 71 minutes.
fn micros(now: Instant) -> u32 {
    now.as_micros() as u32
}
