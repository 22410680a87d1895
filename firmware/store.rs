//! The store task: writes what the scan hands over, below the scan, and erases when it is the time for it.
//!
//! - A change is written at once, as long as the [budget](crate::budget) allows; when it does not, the newest values are
//!   written as soon as it does.
//! - A sector is erased at start, before scan 0, or after a scan in which the program declares a quiet moment: one after
//!   each such scan, so that every erase has been asked for.
//! - When nothing is left in stock, a program that declares quiet moments has said what the others are not: the newest
//!   values wait in RAM for the next. A program that declares none would never store anything again; then the
//!   store erases while it runs, and says so. The alarm comes before either, with a quarter of the area left.

use core::future::pending;

use embassy_futures::select::{Either3, select3};
use embassy_time::{Duration, Instant, TimeoutError, Timer, with_timeout};
use embedded_storage_async::nor_flash::NorFlash;
use grafcet_core::program::Program;

use crate::boot::log_error;
use crate::budget::Budget;
use crate::link::Link;
use crate::log::{fault, note};
use crate::record::Values;
use crate::retain::{Error, Store};
use crate::vitals::Pulse;

/// How long to wait before what failed is tried again.
const RETRY_AFTER: Duration = Duration::from_secs(1);

/// How often the task shows at least that it lives, when it has nothing to do.
const BEAT: Duration = Duration::from_millis(250);

/// The task is hung when scans have run for so many ms without a sign of life of it. In a write it shows itself at each
/// operation of the flash. Under a program that leaves a hundredth of the processor these are 20 ms of its own time.
pub const SILENCE_MS: u32 = 2_000;

/// Erases all that is spent, before a program is started.
pub async fn prepare<F: NorFlash>(store: &mut Store<F>) {
    loop {
        match store.erase_spent().await {
            Ok(true) => {}
            Ok(false) => return,
            Err(error) => return log_error(&error),
        }
    }
}

/// Stores retained values whenever they differ from those stored last, which are `stored` at first.
pub async fn keep<F: NorFlash, const R: usize>(
    store: &mut Store<F>,
    program: &Program<'_>,
    link: &Link<R>,
    stored: [i32; R],
    pulse: &Pulse,
) -> ! {
    let now = Instant::now();
    let mut keeper = Keeper {
        budget: Budget::new(store.area(), store.credit(), now),
        store,
        program,
        link,
        pulse,
        stored,
        waiting: None,
        not_before: now,
        failed: false,
        held: false,
        slowed: false,
        low: false,
    };
    loop {
        keeper.step().await;
    }
}

struct Keeper<'a, F, const R: usize> {
    store: &'a mut Store<F>,
    program: &'a Program<'a>,
    link: &'a Link<R>,
    pulse: &'a Pulse,
    budget: Budget,
    /// The values in flash.
    stored: [i32; R],
    /// Newer ones.
    waiting: Option<[i32; R]>,
    /// When something has failed: not to be tried again before.
    not_before: Instant,
    /// What was tried last has failed.
    failed: bool,
    /// Nothing can be written before a sector is erased.
    held: bool,
    /// Writing has been slowed down, and it was said.
    slowed: bool,
    /// The stock is low, and it was said.
    low: bool,
}

impl<F: NorFlash, const R: usize> Keeper<'_, F, R> {
    /// Waits for something to do, and does it. Only the waiting may be cut short, never what is done with the flash.
    async fn step(&mut self) {
        self.raise_alarm();
        let (link, now) = (self.link, Instant::now());
        let write_at = match self.waiting {
            Some(_) if !self.held => Some(self.budget.ready(now).max(self.not_before)),
            _ => None,
        };
        let erasable = self.store.spent() > 0 && now >= self.not_before;
        let write = async {
            match write_at {
                Some(time) => Timer::at(time).await,
                None => pending().await,
            }
        };
        let quiet = async {
            match erasable {
                true => link.quiet().await,
                false => pending().await,
            }
        };
        self.pulse.beat();
        match with_timeout(BEAT, select3(link.changed(), write, quiet)).await {
            Ok(Either3::First(values)) => self.change(values),
            Ok(Either3::Second(())) => self.write().await,
            Ok(Either3::Third(())) => self.erase().await,
            Err(TimeoutError) => {}
        }
    }

    fn change(&mut self, values: [i32; R]) {
        self.waiting = (values != self.stored).then_some(values);
        let now = Instant::now();
        let ready = self.budget.ready(now);
        if self.waiting.is_some() && ready > now && !self.slowed {
            self.slowed = true;
            fault!(
                "retain store: changes come faster than the flash bears, the next is written in {} ms",
                ready.saturating_duration_since(now).as_millis()
            );
        } else if self.budget.is_comfortable() {
            self.slowed = false;
        }
    }

    async fn write(&mut self) {
        let Some(values) = self.waiting else {
            return;
        };
        let used = self.store.used();
        let record = Values::Running(self.program.retained, &values);
        let saved = self
            .store
            .save(self.program.fingerprint, record, self.budget.credit())
            .await;
        self.budget.pay(self.store.used().wrapping_sub(used));
        match saved {
            Ok(()) => {
                self.stored = values;
                self.waiting = None;
                self.failed = false;
            }
            Err(Error::NoStock) if self.link.declares_quiet() => {
                self.held = true;
                fault!("retain store: no erased sector is left, changes wait for a quiet moment");
            }
            Err(Error::NoStock) => {
                fault!(
                    "retain store: no erased sector is left, one is erased while the program runs"
                );
                self.erase().await;
            }
            Err(error) => self.fail(&error),
        }
    }

    async fn erase(&mut self) {
        match self.store.erase_spent().await {
            Ok(_) => {
                self.held = false;
                self.failed = false;
                note!(
                    "retain store: {} erased sectors in stock",
                    self.store.stock()
                );
            }
            Err(error) => self.fail(&error),
        }
    }

    fn fail(&mut self, error: &Error<F::Error>) {
        log_error(error);
        self.failed = true;
        self.not_before = Instant::now().saturating_add(RETRY_AFTER);
    }

    fn raise_alarm(&mut self) {
        let stock = self.store.stock();
        let low = stock <= self.store.most_stock().div_ceil(4);
        if low && !self.low {
            fault!(
                "retain store: {} erased sectors are left, more come with a quiet moment or a start",
                stock
            );
        }
        self.low = low;
        self.link.set_alarm(low || self.failed);
    }
}
