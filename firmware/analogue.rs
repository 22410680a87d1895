//! Analogue inputs: voltages, averaged and scaled.

use grafcet_core::program::Number;
use heapless::Vec;

use crate::wiring::AnalogueWire;

/// Measures voltages.
pub trait Converter {
    /// One conversion at the terminal with this index, in the order of the wires: 0 at ground,
    /// [`FULL_SCALE`](crate::scale::FULL_SCALE) at the supply; none when it failed. It takes a few microseconds at most.
    fn convert(&mut self, terminal: usize) -> Option<u16>;
}

/// The analogue inputs of the program on their terminals.
///
/// One with a filter is the mean of the samples of the latest whole filter time: over 20 ms that takes out the hum of
/// 50 Hz mains. One without is converted when the scan asks. A conversion that fails is left out.
pub struct Analogue<C, const N: usize> {
    converter: C,
    terminals: Vec<Terminal, N>,
}

struct Terminal {
    wire: &'static AnalogueWire,
    /// Of the filter time that is under way.
    sum: u32,
    samples: u16,
    /// What the scan reads.
    value: i32,
}

impl<C: Converter, const N: usize> Analogue<C, N> {
    /// The terminals of the wires, in their order. Until its filter time is over, what a terminal shows now counts.
    pub fn new(mut converter: C, wires: &'static [AnalogueWire; N]) -> Self {
        let mut terminals = Vec::new();
        for (index, wire) in wires.iter().enumerate() {
            let reading = converter.convert(index).unwrap_or(0);
            // There is room for each of the N terminals.
            let _ = terminals.push(Terminal {
                wire,
                sum: 0,
                samples: 0,
                value: wire.scale.value(reading.into(), 1),
            });
        }
        Analogue {
            converter,
            terminals,
        }
    }

    /// Whether a terminal has a filter.
    #[must_use]
    pub fn is_filtered(&self) -> bool {
        self.terminals.iter().any(|it| it.wire.filter_ms > 0)
    }

    /// Samples the filtered terminals; to be called every millisecond if there are any.
    pub fn sample(&mut self) {
        for (index, terminal) in self.terminals.iter_mut().enumerate() {
            let filter_ms = terminal.wire.filter_ms;
            if filter_ms > 0
                && let Some(reading) = self.converter.convert(index)
            {
                terminal.sum = terminal.sum.saturating_add(reading.into());
                terminal.samples = terminal.samples.saturating_add(1);
                if terminal.samples >= filter_ms {
                    terminal.take(terminal.sum, terminal.samples);
                }
            }
        }
    }

    /// The values for a scan, each with its place.
    pub fn values(&mut self) -> impl Iterator<Item = (Number, i32)> {
        let converter = &mut self.converter;
        let terminals = self.terminals.iter_mut().enumerate();
        terminals.map(|(index, terminal)| {
            if terminal.wire.filter_ms == 0
                && let Some(reading) = converter.convert(index)
            {
                terminal.take(reading.into(), 1);
            }
            (terminal.wire.number, terminal.value)
        })
    }
}

impl Terminal {
    /// Takes the mean of these readings for the value, and begins anew.
    fn take(&mut self, sum: u32, readings: u16) {
        self.value = self.wire.scale.value(sum, readings);
        (self.sum, self.samples) = (0, 0);
    }
}
