//! The contract: `bench_init` and `scan_once`, `bench_in`, `bench_out` and `bench_now_ms`.

use core::mem::MaybeUninit;
use core::ptr::{addr_of, addr_of_mut};

use grafcet_core::engine::Engine;

mod program {
    #![allow(unused)]
    include!(concat!(env!("OUT_DIR"), "/program.rs"));
}
use program::{INPUTS, OUTPUTS, Storage, ThisProgram};

/// The first 32 Boolean inputs, in declaration order from bit 0.
#[unsafe(no_mangle)]
pub static mut bench_in: u32 = 0;
/// The first 32 Boolean outputs.
#[unsafe(no_mangle)]
pub static mut bench_out: u32 = 0;
/// The time of the scan in ms.
#[unsafe(no_mangle)]
pub static mut bench_now_ms: u32 = 0;

type Controller = Engine<ThisProgram, Storage>;
static mut ENGINE: MaybeUninit<Controller> = MaybeUninit::uninit();

/// Scan 0.
#[unsafe(no_mangle)]
pub extern "C" fn bench_init() {
    unsafe {
        let engine = (*addr_of_mut!(ENGINE)).write(Engine::new(ThisProgram, Storage::new()));
        sample(engine);
        engine.start();
        write(engine);
    }
}

/// One later scan.
#[unsafe(no_mangle)]
pub extern "C" fn scan_once() {
    unsafe {
        let engine = (*addr_of_mut!(ENGINE)).assume_init_mut();
        #[cfg(feature = "panicking")]
        addr_of_mut!(bench_out).write_volatile(OUTPUTS[bench_in as usize].0.into());
        engine.set_inputs(0, addr_of!(bench_in).read_volatile());
        if engine.scan(u64::from(addr_of!(bench_now_ms).read_volatile())) {
            write(engine);
        }
    }
}

unsafe fn sample(engine: &mut Controller) {
    let word = unsafe { addr_of!(bench_in).read_volatile() };
    for (place, bit) in INPUTS.iter().enumerate() {
        engine.set_input(*bit, word & (1 << place) != 0);
    }
}

#[inline(never)]
unsafe fn write(engine: &Controller) {
    let mut word = 0;
    for (place, bit) in OUTPUTS.iter().enumerate() {
        word |= u32::from(engine.bit(*bit)) << place;
    }
    unsafe { addr_of_mut!(bench_out).write_volatile(word) };
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
