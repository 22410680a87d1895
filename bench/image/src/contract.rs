//! The contract with whatever counts instructions: the functions `bench_init`, `scan_once` and `look_once`, and the
//! words `bench_in`, `bench_out` and `bench_now_ms`. Nothing is done before `bench_init` but clearing `.bss`.

use core::mem::MaybeUninit;
use core::ptr::{addr_of, addr_of_mut};

use super::program::{Storage, ThisProgram};
use super::{Controller, outputs};

/// The first 32 Boolean inputs, in declaration order from bit 0. The inputs behind them, and all numbers, stay 0.
#[unsafe(no_mangle)]
pub static mut bench_in: u32 = 0;
/// The first 32 Boolean outputs, likewise.
#[unsafe(no_mangle)]
pub static mut bench_out: u32 = 0;
/// The time of the scan in ms.
#[unsafe(no_mangle)]
pub static mut bench_now_ms: u32 = 0;

static mut ENGINE: MaybeUninit<Controller> = MaybeUninit::uninit();

/// Scan 0.
#[unsafe(no_mangle)]
pub extern "C" fn bench_init() {
    // SAFETY: one thread without interrupts calls the functions here, one after the other, so nobody else holds a
    // reference to the engine.
    let engine = unsafe { &mut *addr_of_mut!(ENGINE) };
    let engine = engine.write(Controller::new(ThisProgram, Storage::new()));
    engine.set_inputs(0, read(addr_of!(bench_in)));
    engine.start();
    write(engine);
}

/// A later scan, to be called after `bench_init` only.
#[unsafe(no_mangle)]
pub extern "C" fn scan_once() {
    let engine = sampled();
    #[cfg(feature = "panicking")]
    engine.set_inputs(0, super::OUTPUTS[read(addr_of!(bench_in)) as usize].mask);
    // An idle scan leaves the outputs as they are.
    let time_ms = u64::from(read(addr_of!(bench_now_ms)));
    if !engine.is_idle(time_ms) {
        work(engine, time_ms);
    }
}

/// The same, but the whole program is looked at even when there is nothing new.
#[unsafe(no_mangle)]
pub extern "C" fn look_once() {
    work(sampled(), u64::from(read(addr_of!(bench_now_ms))));
}

/// The engine, with the inputs of now.
#[inline(always)]
fn sampled() -> &'static mut Controller {
    // SAFETY: as in `bench_init`, which has written the engine.
    let engine = unsafe { (*addr_of_mut!(ENGINE)).assume_init_mut() };
    engine.set_inputs(0, read(addr_of!(bench_in)));
    engine
}

/// Kept apart, so that an idle scan saves no registers for it.
#[inline(never)]
fn work(engine: &mut Controller, time_ms: u64) {
    engine.full_scan(time_ms);
    write(engine);
}

#[inline(always)]
fn read(word: *const u32) -> u32 {
    // SAFETY: it is one of the words above, which the outside writes between two calls only. Volatile, since the
    // compiler does not see it written.
    unsafe { word.read_volatile() }
}

#[inline(always)]
fn write(engine: &Controller) {
    // SAFETY: as for `read`.
    unsafe { addr_of_mut!(bench_out).write_volatile(outputs(engine)) };
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
