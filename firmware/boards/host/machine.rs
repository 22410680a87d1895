//! The machine in front of a controller: the site with its plants, and the script that is played on it.
//!
//! It moves once for each scan of the controller, in the soft PLC or on a board: just after it, so that the next scan
//! finds everything as the plants left it, and input filters have had the period to see it.

use grafcet_core::images::Images;

use super::meter::Meter;
use super::script::{Next, Outcome, Player, Script};
use super::site::{PlantTables, Site};
use crate::wiring::{AnalogueWire, InputWire, Label, OutputWire};

/// Plants and script.
pub struct Machine {
    site: Site,
    player: Option<Player>,
    meters: Vec<Meter>,
    period_ms: u32,
}

/// What a machine is made of.
#[derive(Clone, Copy, Debug)]
pub struct Parts {
    /// Scan period of the controller, in ms.
    pub period_ms: u32,
    /// Its Boolean inputs.
    pub inputs: &'static [InputWire],
    /// Its numeric inputs.
    pub analogue: &'static [AnalogueWire],
    /// What these are called.
    pub analogue_labels: &'static [Label],
    /// Its outputs.
    pub outputs: &'static [OutputWire],
    /// All plants of the application.
    pub plants: &'static [PlantTables],
    /// What is played; without it all plants run, and nothing else happens.
    pub script: Option<&'static Script>,
}

impl Machine {
    /// A machine at rest.
    #[must_use]
    pub fn new(parts: Parts) -> Self {
        let chosen = |(index, _): &(usize, &PlantTables)| {
            parts
                .script
                .is_none_or(|script| script.plants.contains(index))
        };
        let plants = parts.plants.iter().enumerate().filter(chosen);
        let period_ms = parts.period_ms.max(1);
        Machine {
            site: Site::new(plants, parts.inputs, parts.analogue, parts.outputs),
            meters: Meter::each(parts.analogue, parts.analogue_labels),
            player: parts.script.map(|script| Player::new(script, period_ms)),
            period_ms,
        }
    }

    /// Moves the machine before the controller's scan 0, when `view` is none, or after a scan of it. `outputs` is what
    /// stands at the controller's output terminals, in the order of its wires.
    pub fn step(&mut self, outputs: &[bool], view: Option<&Images<'_>>) -> Next {
        let next = match &mut self.player {
            Some(player) => player.advance(&mut self.site, view),
            None => Next::Scan,
        };
        if next == Next::Scan {
            self.site.scan(self.period_ms, outputs, view);
        }
        next
    }

    /// What stands at the controller's Boolean inputs, in the order of its wires.
    pub fn inputs(&self) -> impl Iterator<Item = bool> {
        self.site.inputs()
    }

    /// What a converter reads at the controller's numeric inputs, in the order of its wires.
    pub fn readings(&self) -> impl Iterator<Item = u16> {
        let meters = self.meters.iter().zip(self.site.numbers());
        meters.map(|(meter, value)| meter.reading(value))
    }

    /// The numeric inputs that have moved far enough to be shown, as a line for people; none when there are none.
    pub fn take_moved(&mut self) -> Option<String> {
        let meters = self.meters.iter_mut().zip(self.site.numbers());
        let moved: Vec<String> = meters
            .filter_map(|(meter, value)| meter.show(value))
            .collect();
        (!moved.is_empty()).then(|| moved.join(", "))
    }

    /// What the script has said since it was last asked.
    pub fn take_said(&mut self) -> Vec<&'static str> {
        self.player
            .as_mut()
            .map(Player::take_said)
            .unwrap_or_default()
    }
}

impl Outcome {
    /// Whether everything was as claimed.
    #[must_use]
    pub const fn held(self) -> bool {
        matches!(self, Outcome::Held)
    }
}
