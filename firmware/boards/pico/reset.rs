//! Resets: why the last one came, and how the image asks for one when it cannot go on.
//!
//! Three things outlive resets, each of them another kind: the watchdog's scratch registers live until power fails or
//! the RUN pin is pulled, `CHIP_RESET` tells these two apart, and the SRAM outlives a sag of the supply too short to
//! empty it. That last one is all that an RP2040 has to tell a brown-out from power-on, which its brown-out detector
//! reports as the same: an interruption of some milliseconds counts as a brown-out.

use core::mem::MaybeUninit;
use core::panic::PanicInfo;
use core::ptr::{addr_of, addr_of_mut};

use cortex_m_rt::{ExceptionFrame, exception};
use embassy_rp::pac;
use embassy_rp::pac::watchdog::regs::Load;
use embassy_rp::watchdog::Watchdog;

use super::BOOT_WATCHDOG;
use crate::boot::{Cause, Evidence, Mark};
use crate::scan::Stop;
use crate::vitals::Task;

/// What lies in SRAM while the image has run: noise would have to guess 128 bits.
const REMEMBERED: [u32; 4] = [0x6772_6166, 0x6365_7420, 0x9e37_79b9, 0x7f4a_7c15];

/// Not initialised at start, so that it shows whether memory was lost.
#[unsafe(link_section = ".uninit.REMEMBERED")]
static mut MEMORY: MaybeUninit<[u32; 4]> = MaybeUninit::uninit();

/// Why the board starts. From now on the marks say that the image runs.
pub fn cause(watchdog: &mut Watchdog) -> Cause {
    let chip = pac::VREG_AND_CHIP_RESET.chip_reset().read();
    let evidence = Evidence {
        by_watchdog: watchdog.reset_reason().is_some(),
        mark: Mark::read(watchdog.get_scratch(0)),
        suspect: Task::read(watchdog.get_scratch(1)),
        by_debug_port: chip.had_psm_restart(),
        by_run_pin: chip.had_run(),
        memory_kept: memory_kept(),
    };
    mark(Mark::Running);
    suspect(Task::Start);
    evidence.cause()
}

fn mark(mark: Mark) {
    pac::WATCHDOG.scratch0().write_value(mark.word());
}

/// Should nothing run any more from now on, that is because of this task. The answer is which one it was before.
pub fn suspect(task: Task) -> Task {
    let register = pac::WATCHDOG.scratch1();
    let before = Task::read(register.read());
    register.write_value(task.word());
    before
}

/// Gives what comes before scan 0 its whole time again.
pub fn feed_start() {
    // The counter goes down by two in a microsecond: erratum RP2040-E1.
    let load = BOOT_WATCHDOG.as_micros() as u32 * 2;
    pac::WATCHDOG.load().write_value(Load(load));
}

/// The program is stopped; from now on the watchdog waits as long as at the start, and the next start knows why.
pub fn stop(watchdog: &mut Watchdog, stop: Stop) {
    watchdog.feed(BOOT_WATCHDOG);
    match stop {
        Stop::Overload => mark(Mark::Overloaded),
        Stop::Hung(task) => {
            suspect(task);
        }
    }
}

/// Resets the chip, with the log gone out as far as somebody reads it.
pub fn restart() -> ! {
    defmt::flush();
    reset()
}

/// Whether SRAM still holds what the image left there. It does from now on.
fn memory_kept() -> bool {
    // SAFETY: nothing else names MEMORY, and any 128 bits are a value of its type. Volatile, because what the reads
    // find was written by the image that ran before the reset.
    unsafe {
        let kept = addr_of!(MEMORY).cast::<[u32; 4]>().read_volatile() == REMEMBERED;
        addr_of_mut!(MEMORY)
            .cast::<[u32; 4]>()
            .write_volatile(REMEMBERED);
        kept
    }
}

/// Ends the image: lets go of the pins, as a reset does, says why, and resets the chip.
fn give_up(log: impl FnOnce()) -> ! {
    cortex_m::interrupt::disable();
    pac::SIO.gpio_oe(0).value_clr().write_value(u32::MAX);
    let first = Mark::read(pac::WATCHDOG.scratch0().read()) != Mark::Panicked;
    mark(Mark::Panicked);
    // A fault within the log would come here again. With a probe attached, flushing waits for it; should it have gone
    // away, the watchdog ends the wait.
    if first {
        log();
        defmt::flush();
    }
    reset()
}

fn reset() -> ! {
    cortex_m::interrupt::disable();
    pac::PSM.wdsel().write(|w| {
        // Everything but the oscillators.
        w.0 = 0x1_fffc;
    });
    pac::WATCHDOG.ctrl().write(|w| w.set_trigger(true));
    loop {
        cortex_m::asm::nop();
    }
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    give_up(|| match info.location() {
        Some(place) => defmt::error!("panic at {=str}:{=u32}", place.file(), place.line()),
        None => defmt::error!("panic"),
    })
}

/// A fault of the processor.
// SAFETY: the handler only reads the frame it is given and does not return.
#[exception]
unsafe fn HardFault(frame: &ExceptionFrame) -> ! {
    give_up(|| defmt::error!("hard fault at {=u32:08x}", frame.pc()))
}

/// An interrupt that nobody handles.
// SAFETY: the handler touches nothing that the interrupted code holds, and does not return.
#[exception]
unsafe fn DefaultHandler(interrupt: i16) {
    give_up(|| defmt::error!("unexpected interrupt {=i16}", interrupt))
}
