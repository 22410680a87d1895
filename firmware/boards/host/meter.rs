//! What people are shown of a numeric input: not every reading, but where it goes.

use crate::wiring::{AnalogueWire, Label};

/// So many lines at most from one end of a scale to the other.
const DIVISIONS: u32 = 8;

/// A meter at a numeric input.
#[derive(Debug)]
pub struct Meter {
    wire: &'static AnalogueWire,
    label: &'static Label,
    shown: i32,
}

impl Meter {
    /// A meter at each of these, with nothing there.
    #[must_use]
    pub fn each(wires: &'static [AnalogueWire], labels: &'static [Label]) -> Vec<Meter> {
        let meter = |(wire, label): (&'static AnalogueWire, _)| Meter {
            wire,
            label,
            shown: wire.scale.value(wire.scale.reading(0).into(), 1),
        };
        wires.iter().zip(labels).map(meter).collect()
    }

    /// What a converter reads when this value is there.
    #[must_use]
    pub fn reading(&self, value: i32) -> u16 {
        self.wire.scale.reading(value)
    }

    /// The value as the controller reads it, if it has come an eighth of the scale from what was shown last, or to an
    /// end of the scale.
    pub fn show(&mut self, value: i32) -> Option<String> {
        let scale = &self.wire.scale;
        let value = scale.value(self.reading(value).into(), 1);
        let way = value.abs_diff(self.shown);
        let far = way.saturating_mul(DIVISIONS) >= scale.low.abs_diff(scale.high);
        let at_end = value == scale.low || value == scale.high;
        (way > 0 && (far || at_end)).then(|| {
            self.shown = value;
            format!("{} = {value}", self.label.name)
        })
    }
}
