//! Tasks that hang when they are told to, for the tests of what becomes of it: the feature `hang`.

use core::future::{Future, poll_fn};
use core::pin::pin;
use core::sync::atomic::{AtomicU32, Ordering};
use core::task::Poll;

use crate::vitals::Task;

/// Who hangs, and how: the word of a [`Task`] and one of the manners below. It is 0 after every start.
#[unsafe(export_name = "PLC_HANG")]
static HANG: AtomicU32 = AtomicU32::new(0);

/// It does not end, and leaves the processor to those above it.
const SPINS: u32 = 0x100;
/// It waits for what never comes.
const WAITS: u32 = 0x200;
/// It does not end, with all interrupts off, as the flash would be that does not come back.
const HOLDS: u32 = 0x300;

/// A task that hangs when it is to, from when it is next polled.
pub async fn hangable<F: Future>(task: Task, future: F) -> F::Output {
    let mut future = pin!(future);
    poll_fn(|context| match told(task) {
        SPINS => spin(),
        WAITS => Poll::Pending,
        _ => future.as_mut().poll(context),
    })
    .await
}

/// Where a task has the processor for itself.
pub fn hold(task: Task) {
    if told(task) == HOLDS {
        cortex_m::interrupt::disable();
        spin();
    }
}

fn told(task: Task) -> u32 {
    HANG.load(Ordering::Relaxed).wrapping_sub(task.word())
}

/// Never ends; asleep, which leaves an emulator less to do.
fn spin() -> ! {
    loop {
        cortex_m::asm::wfe();
    }
}
