//! The clock of the soft PLC: real time, or simulated time that jumps from alarm to alarm.
//!
//! Time is simulated on a thread for as long as [`simulate`] runs there; every other thread has real time. So tests
//! that run side by side have a clock each.

use std::cell::RefCell;
use std::future::Future;
use std::pin::pin;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, LazyLock, Mutex, MutexGuard, PoisonError};
use std::task::{Context, Poll, Wake, Waker};
use std::thread;
use std::time::{Duration as StdDuration, Instant as StdInstant};

use embassy_time::Duration;
use embassy_time_driver::Driver;
use embassy_time_queue_utils::Queue;

/// An alarm that never comes.
const NEVER: u64 = u64::MAX;

thread_local! {
    static SIMULATION: RefCell<Option<Simulation>> = const { RefCell::new(None) };
}

static REAL: LazyLock<RealTime> = LazyLock::new(RealTime::start);

struct Clock;

embassy_time_driver::time_driver_impl!(static CLOCK: Clock = Clock);

impl Driver for Clock {
    fn now(&self) -> u64 {
        let simulated = SIMULATION.with_borrow(|simulation| simulation.as_ref().map(|it| it.now));
        simulated.unwrap_or_else(|| REAL.now())
    }

    fn schedule_wake(&self, at: u64, waker: &Waker) {
        let simulated = SIMULATION.with_borrow_mut(|simulation| {
            let simulation = simulation.as_mut()?;
            simulation.queue.schedule_wake(at, waker);
            Some(())
        });
        if simulated.is_none() {
            REAL.schedule_wake(at, waker);
        }
    }
}

/// Runs a future in simulated time, which starts at 0: whenever everything waits, the clock jumps to the next alarm.
///
/// The answer is none when everything waits and no alarm is set, so that nothing could ever happen again.
pub fn simulate<F: Future>(future: F) -> Option<F::Output> {
    let simulation = Simulation {
        now: 0,
        queue: Queue::new(),
    };
    let previous = SIMULATION.replace(Some(simulation));
    let output = run(future);
    SIMULATION.set(previous);
    output
}

/// Lets simulated time pass as if the caller were at work for so long. Real time is not touched.
pub fn work(duration: Duration) {
    SIMULATION.with_borrow_mut(|simulation| {
        if let Some(simulation) = simulation {
            simulation.now = simulation.now.saturating_add(duration.as_ticks());
        }
    });
}

fn run<F: Future>(future: F) -> Option<F::Output> {
    let mut future = pin!(future);
    let flag = Arc::new(Flag::default());
    let waker = Waker::from(flag.clone());
    let mut context = Context::from_waker(&waker);
    loop {
        if let Poll::Ready(output) = future.as_mut().poll(&mut context) {
            return Some(output);
        }
        // First the alarms that work has outrun, then the next one.
        while !flag.take() {
            let next = ring();
            if flag.take() {
                break;
            }
            if next == NEVER {
                return None;
            }
            SIMULATION.with_borrow_mut(|simulation| {
                if let Some(simulation) = simulation {
                    simulation.now = next;
                }
            });
        }
    }
}

/// Wakes what is due. The answer is when the next alarm is.
fn ring() -> u64 {
    SIMULATION.with_borrow_mut(|simulation| match simulation {
        Some(simulation) => simulation.queue.next_expiration(simulation.now),
        None => NEVER,
    })
}

struct Simulation {
    now: u64,
    queue: Queue,
}

/// Whether something has woken the future.
#[derive(Default)]
struct Flag(AtomicBool);

impl Flag {
    fn take(&self) -> bool {
        self.0.swap(false, Ordering::Relaxed)
    }
}

impl Wake for Flag {
    fn wake(self: Arc<Self>) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Real time since the first look at the clock, with a thread that rings the alarms.
struct RealTime {
    start: StdInstant,
    queue: Mutex<Queue>,
    changed: Condvar,
}

impl RealTime {
    fn start() -> Self {
        thread::spawn(|| REAL.ring_alarms());
        RealTime {
            start: StdInstant::now(),
            queue: Mutex::new(Queue::new()),
            changed: Condvar::new(),
        }
    }

    fn now(&self) -> u64 {
        // Microseconds in 64 bits last for half a million years.
        self.start.elapsed().as_micros() as u64
    }

    fn schedule_wake(&self, at: u64, waker: &Waker) {
        if self.queue().schedule_wake(at, waker) {
            self.changed.notify_one();
        }
    }

    fn ring_alarms(&self) {
        let mut queue = self.queue();
        loop {
            let now = self.now();
            let wait = StdDuration::from_micros(queue.next_expiration(now).saturating_sub(now));
            queue = match self.changed.wait_timeout(queue, wait) {
                Ok((queue, _)) => queue,
                Err(poisoned) => poisoned.into_inner().0,
            };
        }
    }

    /// Nothing that holds the lock leaves a queue half changed, so a panic elsewhere does no harm.
    fn queue(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
