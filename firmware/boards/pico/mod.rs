//! The Raspberry Pi Pico: an RP2040 with 2 MB of flash.
//!
//! The scan runs on an executor of its own, in a software interrupt above all other tasks and below the timer. The
//! store task runs in thread mode. Unsafe code is here and in [`reset`] only; each piece says why.

mod flash;
#[cfg(feature = "hang")]
mod hang;
pub mod pin;
pub mod reset;

use core::ptr::addr_of_mut;
use core::sync::atomic::{AtomicU32, Ordering};

// The log goes to a probe, or to an emulator, through RTT.
use defmt_rtt as _;
use embassy_executor::InterruptExecutor;
use embassy_rp::adc::{self, Adc, Channel};
use embassy_rp::flash::Flash;
use embassy_rp::gpio::Output;
use embassy_rp::interrupt;
use embassy_rp::interrupt::{InterruptExt, Priority};
use embassy_rp::watchdog::Watchdog;
use embassy_time::Duration;
use grafcet_core::engine::Engine;
use grafcet_core::memory::Memory;
use grafcet_core::program::Compiled;

use crate::analogue::{Analogue, Converter};
use crate::application::{
    ANALOGUE_INPUTS, INPUTS, NAMES, OUTPUTS, OVERLOAD, PROGRAM, RETAIN, STORE_WIRES, Storage,
    ThisProgram, WATCHDOG_MS, board_pins,
};
use crate::boot::boot;
use crate::input::Inputs;
use crate::link::Link;
use crate::log::Observer;
use crate::output::Outputs;
use crate::retain::Store;
use crate::scan::{Board, Controller, STANDSTILL, Stop, snapshot};
use crate::store::{SILENCE_MS, keep, prepare};
use crate::vitals::{Pulse, Task};
use flash::StoreFlash;
use pin::DigitalInput;

/// A task as it is; in an image with the feature `hang`, one that hangs when a test tells it to.
macro_rules! hangable {
    ($task:expr, $future:expr) => {{
        #[cfg(not(feature = "hang"))]
        let future = $future;
        #[cfg(feature = "hang")]
        let future = hang::hangable($task, $future);
        future
    }};
}

/// Bytes of flash on a Pico.
const FLASH_SIZE: usize = 2 * 1024 * 1024;

/// The longest time that the RP2040's watchdog can wait: until the retain area has been read, and mended if need be.
const BOOT_WATCHDOG: Duration = Duration::from_millis(8_000);

const SCAN_WATCHDOG: Duration = Duration::from_millis(WATCHDOG_MS as u64);

const _: () = assert!(SCAN_WATCHDOG.as_millis() <= BOOT_WATCHDOG.as_millis());
const _: () = assert!(STANDSTILL.as_millis() < BOOT_WATCHDOG.as_millis());
const _: () = assert!(RETAIN.end as usize <= FLASH_SIZE);

/// How many variables and parameters are retained.
const RETAINED: usize = PROGRAM.retained.len();

/// The memory of the program. Its exported name lets tools that look into RAM find it.
#[unsafe(export_name = "PLC_STORAGE")]
static mut STORAGE: Storage = Storage::new();

/// Completed scans since reset, for the same tools. It wraps around.
#[unsafe(export_name = "PLC_SCANS")]
static SCANS: AtomicU32 = AtomicU32::new(0);

static LINK: Link<RETAINED> = Link::new(STORE_WIRES);

/// The tasks below the scan.
static WATCHED: [Pulse; 1] = [Pulse::new(Task::Store, SILENCE_MS)];

static SCAN_EXECUTOR: InterruptExecutor = InterruptExecutor::new();

type PicoController = Controller<
    'static,
    ThisProgram,
    &'static mut Storage,
    DigitalInput,
    Voltmeter,
    Output<'static>,
    Pico,
    { INPUTS.len() },
    { ANALOGUE_INPUTS.len() },
    { OUTPUTS.len() },
    RETAINED,
>;

/// Brings the program up on the board and runs it. To be called once, from the thread-mode executor's main task.
pub async fn run() -> ! {
    let p = embassy_rp::init(embassy_rp::config::Config::default());
    let (inputs, channels, outputs) = board_pins!(p);
    let outputs = Outputs::new(outputs, &OUTPUTS);
    let mut watchdog = Watchdog::new(p.WATCHDOG);
    let cause = reset::cause(&mut watchdog);
    watchdog.pause_on_debug(true);
    watchdog.start(BOOT_WATCHDOG);

    // SAFETY: this is the only place that names STORAGE, and main runs once.
    let memory = unsafe { &mut *addr_of_mut!(STORAGE) };
    let mut engine = Engine::new(ThisProgram, memory);
    let [pulse] = &WATCHED;
    let flash = StoreFlash::new(Flash::new_blocking(p.FLASH), pulse);
    let mut store = Store::new(flash, RETAIN);
    hangable!(Task::Start, boot(&mut engine, &NAMES, &mut store, cause)).await;
    prepare(&mut store).await;

    let stored = snapshot(&engine);
    let voltmeter = Voltmeter {
        // Without analogue inputs the converter stays without power.
        adc: (!ANALOGUE_INPUTS.is_empty())
            .then(|| Adc::new_blocking(p.ADC, adc::Config::default())),
        channels,
    };
    let controller = Controller {
        engine,
        inputs: Inputs::new(inputs, &INPUTS, Analogue::new(voltmeter, &ANALOGUE_INPUTS)),
        outputs,
        board: Pico {
            watchdog,
            interrupted: Task::Scan,
        },
        link: &LINK,
        watched: &WATCHED,
        overload: OVERLOAD,
        observer: Observer::new(&NAMES),
    };
    // What is not under way elsewhere is the scan that does not come.
    reset::suspect(Task::Scan);
    interrupt::SWI_IRQ_0.set_priority(Priority::P1);
    let spawner = SCAN_EXECUTOR.start(interrupt::SWI_IRQ_0);
    match scan(controller) {
        Ok(task) => spawner.spawn(task),
        // It is spawned once. Should that ever not hold, nothing feeds the watchdog.
        Err(_) => defmt::error!("the scan task is already running"),
    }
    hangable!(
        Task::Store,
        keep(&mut store, &PROGRAM, &LINK, stored, pulse)
    )
    .await
}

#[embassy_executor::task]
async fn scan(mut controller: PicoController) -> ! {
    hangable!(Task::Scan, controller.run()).await;
    reset::restart()
}

#[interrupt]
unsafe fn SWI_IRQ_0() {
    // SAFETY: this is the handler of the interrupt that the executor was started with, which enabled it.
    unsafe { SCAN_EXECUTOR.on_interrupt() }
}

/// The RP2040's converter with its channels, in the order of the wires.
struct Voltmeter {
    adc: Option<Adc<'static, adc::Blocking>>,
    channels: [Channel<'static>; ANALOGUE_INPUTS.len()],
}

impl Converter for Voltmeter {
    /// 96 cycles of 48 MHz, 2 us, after which the converter is ready in any case.
    fn convert(&mut self, terminal: usize) -> Option<u16> {
        let channel = self.channels.get_mut(terminal)?;
        self.adc.as_mut()?.blocking_read(channel).ok()
    }
}

/// What the Pico does around a scan.
struct Pico {
    watchdog: Watchdog,
    /// What had the processor when the scan began.
    interrupted: Task,
}

impl Board for Pico {
    /// The longest cause that is no fault is a page of flash being programmed, 0.4 ms at a time.
    const LATE_AFTER: Duration = Duration::from_millis(1);

    fn begin(&mut self) {
        self.interrupted = reset::suspect(Task::Scan);
    }

    fn complete(&mut self, _engine: &Engine<impl Compiled, impl Memory>) {
        self.watchdog.feed(SCAN_WATCHDOG);
        reset::suspect(self.interrupted);
        // One writer: no compare-and-swap is needed, and a Cortex-M0+ has none.
        SCANS.store(
            SCANS.load(Ordering::Relaxed).wrapping_add(1),
            Ordering::Relaxed,
        );
    }

    fn stop(&mut self, stop: Stop) {
        reset::stop(&mut self.watchdog, stop);
    }
}
