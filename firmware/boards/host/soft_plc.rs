//! The controller on a host: powered, run against its machine, and powered again.

use std::cell::RefCell;
use std::future::poll_fn;
use std::io;
use std::path::Path;
use std::task::Poll;

use embassy_futures::select::{Either3, select3};
use embassy_sync::blocking_mutex::raw::NoopRawMutex;
use embassy_sync::signal::Signal;
use embassy_time::{Duration, Timer};
use grafcet_core::engine::Engine;
use grafcet_core::images::Images;
use grafcet_core::memory::Memory;
use grafcet_core::program::Compiled;

use super::flash::FlashFile;
use super::lines;
use super::machine::Machine;
use super::panel::Panel;
use super::pins::{Input, Output, Readings};
use super::script::{Next, Outcome};
use crate::analogue::Analogue;
use crate::application::{
    ANALOGUE_INPUTS, INPUTS, NAMES, OUTPUTS, OVERLOAD, PROGRAM, RETAIN, STORE_WIRES, Storage,
    ThisProgram,
};
use crate::boot::{Cause, boot};
use crate::input::Inputs;
use crate::link::Link;
use crate::log::Observer;
use crate::output::Outputs;
use crate::retain::Store;
use crate::scan::{Board, Controller, Stop, snapshot};
use crate::store::{SILENCE_MS, keep, prepare};
use crate::vitals::{Pulse, Task};
use crate::wiring::{Overload, Policy};

/// How long power stays away in a power cycle.
const POWER_OFF: Duration = Duration::from_secs(1);

const RETAINED: usize = PROGRAM.retained.len();

/// Runs the controller against its machine until the script ends, and keeps what it retains in that file.
///
/// # Errors
/// When the file can neither be read nor made.
pub async fn run(machine: Machine, retain: &Path) -> io::Result<Outcome> {
    let machine = RefCell::new(machine);
    let panel = Panel::default();
    let moved = Signal::new();
    let mut cause = Cause::PowerOn;
    loop {
        panel.make_safe();
        let board = SoftPlc {
            machine: &machine,
            panel: &panel,
            moved: &moved,
        };
        board.step(None);
        if !moved.signaled()
            && let Some(stop) = start(board, retain, cause).await?
        {
            cause = stop.cause();
            continue;
        }
        cause = Cause::PowerOn;
        if let Next::End(outcome) = moved.wait().await {
            return Ok(outcome);
        }
        Timer::after(POWER_OFF).await;
    }
}

/// Runs the controller from its start until it has to start again, or the machine asks for something else than a scan.
async fn start(board: SoftPlc<'_>, retain: &Path, cause: Cause) -> io::Result<Option<Stop>> {
    let (panel, moved) = (board.panel, board.moved);
    let mut engine = Engine::new(ThisProgram, Storage::new());
    let mut store = Store::new(FlashFile::open(retain, RETAIN)?, RETAIN);
    boot(&mut engine, &NAMES, &mut store, cause).await;
    prepare(&mut store).await;
    let stored: [i32; RETAINED] = snapshot(&engine);
    let link = Link::new(STORE_WIRES);
    let watched = [Pulse::new(Task::Store, SILENCE_MS)];
    let mut controller = Controller {
        engine,
        inputs: Inputs::new(
            panel.inputs.each_ref().map(Input),
            &INPUTS,
            Analogue::new(Readings(&panel.readings), &ANALOGUE_INPUTS),
        ),
        outputs: Outputs::new(panel.outputs.each_ref().map(Output), &OUTPUTS),
        board,
        link: &link,
        watched: &watched,
        // What a desktop does besides is no fault of the program.
        overload: Overload {
            policy: Policy::KeepRunning,
            ..OVERLOAD
        },
        observer: Observer::new(&NAMES),
    };
    let [pulse] = &watched;
    let keep = keep(&mut store, &PROGRAM, &link, stored, pulse);
    let asked = poll_fn(|_| {
        if moved.signaled() {
            Poll::Ready(())
        } else {
            Poll::Pending
        }
    });
    // Nothing is cut short when the tasks are dropped: a write to the file happens within one poll.
    match select3(controller.run(), keep, asked).await {
        Either3::First(stop) => Ok(Some(stop)),
        _ => Ok(None),
    }
}

/// What the host does around a scan.
struct SoftPlc<'a> {
    machine: &'a RefCell<Machine>,
    panel: &'a Panel,
    /// What the machine asks for, when it is not another scan.
    moved: &'a Signal<NoopRawMutex, Next>,
}

impl SoftPlc<'_> {
    /// Moves the machine before scan 0 or after a scan.
    fn step(&self, view: Option<&Images<'_>>) {
        let mut machine = self.machine.borrow_mut();
        self.panel.show_outputs();
        let next = machine.step(&self.panel.outputs(), view);
        for text in machine.take_said() {
            lines::print(format_args!("-- {text}"));
        }
        self.panel.connect(&mut machine);
        if next != Next::Scan {
            self.moved.signal(next);
        }
    }
}

impl Board for SoftPlc<'_> {
    /// A desktop is no real-time system: what costs no release is no news.
    const LATE_AFTER: Duration = Duration::from_millis(PROGRAM.period_ms as u64);

    fn complete(&mut self, engine: &Engine<impl Compiled, impl Memory>) {
        self.step(Some(&engine.images()));
    }
}
