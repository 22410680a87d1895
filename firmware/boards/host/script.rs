//! The demonstration: a test of the language whose steps are taken while a controller runs elsewhere, as the soft PLC
//! here or on a board.

use grafcet_core::images::Images;
use grafcet_core::program::{Bit, Program, Slot};

use super::site::{HostEngine, Site, new_engine, run};

/// A test, as the build lowered it.
#[derive(Debug)]
pub struct Script {
    /// Indices of the plants that stand around the controller.
    pub plants: &'static [usize],
    /// What happens.
    pub steps: &'static [Step],
    /// A program without graphs whose results are the values of the claims.
    pub observer: Program<'static>,
    /// What it sees.
    pub reads: &'static [(Place, Slot)],
}

/// A step of a test.
#[derive(Debug)]
pub struct Step {
    /// The comment above it, or nothing.
    pub comment: &'static str,
    /// How it is written.
    pub text: &'static str,
    /// What it does.
    pub kind: StepKind,
}

/// What a step does (`semantics.md`, "Tests").
#[derive(Debug)]
pub enum StepKind {
    /// Writes inputs, or a plant's own variables; an input stays overridden.
    Set(&'static [(Place, i32)]),
    /// Gives inputs back to the plants.
    Release(&'static [Place]),
    /// Sets, runs so many ms, clears.
    Pulse {
        /// What is pulsed.
        place: Place,
        /// For how long, in ms.
        ms: u32,
    },
    /// Runs as many scans as fit into so many ms, rounded up.
    Wait {
        /// For how long, in ms.
        ms: u32,
    },
    /// Runs so many scans.
    WaitScans(u32),
    /// Runs until the result is True, at most so many ms.
    WaitUntil {
        /// The observer's result.
        result: Bit,
        /// At most so long, in ms.
        within_ms: u32,
    },
    /// The result is True now.
    Expect(Bit),
    /// The result is False from now on.
    Never(Bit),
    /// The result is True from now on.
    Always(Bit),
    /// Power is lost and comes back.
    PowerCycle,
}

/// A value of the controller or of a plant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In the controller's images.
    Controller(Slot),
    /// In the images of a plant.
    Plant(usize, Slot),
}

/// What a script asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// Another scan.
    Scan,
    /// Power off and on again.
    PowerCycle,
    /// Nothing more.
    End(Outcome),
}

/// How a script ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Everything that it claims was so.
    Held,
    /// The step with this text could not be taken, or what it claims was not so.
    Failed(&'static str),
}

/// A script being played.
pub struct Player {
    script: &'static Script,
    period_ms: u32,
    observer: HostEngine,
    /// Scans since the beginning.
    scans: u64,
    /// The step that is taken next, or under way.
    index: usize,
    under_way: Option<UnderWay>,
    /// Results with the values that they must have after every scan, and the text of the step that says so.
    standing: Vec<(Bit, bool, &'static str)>,
    said: Vec<&'static str>,
}

/// A step that needs scans.
#[derive(Clone, Copy)]
struct UnderWay {
    scans_left: u64,
    until: Option<Bit>,
    clear: Option<Place>,
}

impl Player {
    /// Plays a script from its beginning, in scans of so many ms.
    #[must_use]
    pub fn new(script: &'static Script, period_ms: u32) -> Self {
        Player {
            script,
            period_ms,
            observer: new_engine(&script.observer),
            scans: 0,
            index: 0,
            under_way: None,
            standing: Vec::new(),
            said: Vec::new(),
        }
    }

    /// What was said since it was last asked.
    pub fn take_said(&mut self) -> Vec<&'static str> {
        std::mem::take(&mut self.said)
    }

    /// Takes all steps up to the next one that needs a scan. `view` is what the controller's latest scan left; none
    /// when power has come since.
    pub fn advance(&mut self, site: &mut Site, view: Option<&Images<'_>>) -> Next {
        if let Some(view) = view {
            self.observe(site, view);
            let broken = self
                .standing
                .iter()
                .find(|(bit, value, _)| self.observer.bit(*bit) != *value);
            if let Some((_, _, text)) = broken {
                return Next::End(Outcome::Failed(text));
            }
        }
        loop {
            if let Some(under_way) = self.under_way {
                match self.go_on(under_way, site) {
                    Some(next) => return next,
                    None => continue,
                }
            }
            let Some(step) = self.script.steps.get(self.index) else {
                return Next::End(Outcome::Held);
            };
            if step.kind.needs_scan() && view.is_none() {
                return Next::Scan;
            }
            self.said.extend(step.announcement());
            if let Some(next) = self.begin(step, site) {
                return next;
            }
        }
    }

    /// Goes on with a step that is under way; none when it has ended.
    fn go_on(&mut self, under_way: UnderWay, site: &mut Site) -> Option<Next> {
        let reached = under_way
            .until
            .is_some_and(|result| self.observer.bit(result));
        if !reached && under_way.scans_left > 0 {
            self.under_way = Some(UnderWay {
                scans_left: under_way.scans_left - 1,
                ..under_way
            });
            return Some(Next::Scan);
        }
        if !reached && under_way.until.is_some() {
            return Some(self.failed());
        }
        if let Some(place) = under_way.clear {
            site.set(place, 0);
        }
        self.under_way = None;
        self.index += 1;
        None
    }

    /// Begins a step, and ends it when it needs no scan. None when the next one can follow.
    fn begin(&mut self, step: &Step, site: &mut Site) -> Option<Next> {
        let text = step.text;
        match step.kind {
            StepKind::Set(values) => {
                for (place, value) in values {
                    if !site.set(*place, *value) {
                        return Some(self.failed());
                    }
                }
            }
            StepKind::Release(places) => places.iter().for_each(|place| site.release(*place)),
            StepKind::Pulse { place, ms } => {
                if !site.set(place, 1) {
                    return Some(self.failed());
                }
                return self.wait(self.scans_in(ms), None, Some(place));
            }
            StepKind::Wait { ms } => return self.wait(self.scans_in(ms), None, None),
            StepKind::WaitScans(scans) => return self.wait(u64::from(scans), None, None),
            StepKind::WaitUntil { result, within_ms } => {
                return self.wait(self.scans_in(within_ms), Some(result), None);
            }
            StepKind::Expect(result) if !self.observer.bit(result) => return Some(self.failed()),
            StepKind::Expect(_) => {}
            StepKind::Never(result) if self.observer.bit(result) => return Some(self.failed()),
            StepKind::Never(result) => self.standing.push((result, false, text)),
            StepKind::Always(result) if !self.observer.bit(result) => return Some(self.failed()),
            StepKind::Always(result) => self.standing.push((result, true, text)),
            StepKind::PowerCycle => {
                self.index += 1;
                return Some(Next::PowerCycle);
            }
        }
        self.index += 1;
        None
    }

    fn wait(&mut self, scans: u64, until: Option<Bit>, clear: Option<Place>) -> Option<Next> {
        self.under_way = Some(UnderWay {
            scans_left: scans,
            until,
            clear,
        });
        None
    }

    fn failed(&self) -> Next {
        let text = self
            .script
            .steps
            .get(self.index)
            .map_or("", |step| step.text);
        Next::End(Outcome::Failed(text))
    }

    fn scans_in(&self, ms: u32) -> u64 {
        u64::from(ms).div_ceil(u64::from(self.period_ms))
    }

    /// Shows the observer what the latest scan left.
    fn observe(&mut self, site: &Site, view: &Images<'_>) {
        for (place, slot) in self.script.reads {
            let value = match place {
                Place::Controller(from) => view.value(*from),
                Place::Plant(index, from) => site.plant_value(*index, *from),
            };
            self.observer.sample(*slot, value);
        }
        run(
            &mut self.observer,
            self.scans.saturating_mul(u64::from(self.period_ms)),
        );
        self.scans += 1;
    }
}

impl Step {
    /// What to say when the step begins: its comment; without one, what it does to the site.
    fn announcement(&self) -> Option<&'static str> {
        let acts = matches!(
            self.kind,
            StepKind::Set(_) | StepKind::Release(_) | StepKind::Pulse { .. } | StepKind::PowerCycle
        );
        match (self.comment, acts) {
            ("", false) => None,
            ("", true) => Some(self.text),
            (comment, _) => Some(comment),
        }
    }
}

impl StepKind {
    /// Whether the step needs a scan to have run since power came.
    const fn needs_scan(&self) -> bool {
        !matches!(
            self,
            StepKind::Set(_) | StepKind::Release(_) | StepKind::PowerCycle
        )
    }
}
