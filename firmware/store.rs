//! The store task: writes what the scan hands over, below the scan.

use embassy_time::{Duration, Instant, with_deadline};
use embedded_storage_async::nor_flash::NorFlash;
use grafcet_core::program::Program;

use crate::boot::log_error;
use crate::record::Values;
use crate::retain::Store;
use crate::scan::Changes;
use crate::vitals::Pulse;

/// How long to wait before a failed write is tried again.
const RETRY_AFTER: Duration = Duration::from_secs(1);

/// How often the task shows at least that it lives, when it has nothing to do.
const BEAT: Duration = Duration::from_millis(250);

/// The task is hung when scans have run for so many ms without a sign of life of it. In a write it shows itself at each
/// operation of the flash. Under a program that leaves a hundredth of the processor these are 20 ms of its own time.
pub const SILENCE_MS: u32 = 2_000;

/// Stores retained values whenever they differ from those stored last, which are `stored` at first.
pub async fn keep<F: NorFlash, const R: usize>(
    store: &mut Store<F>,
    program: &Program<'_>,
    changes: &Changes<R>,
    mut stored: [i32; R],
    pulse: &Pulse,
) -> ! {
    let mut failed = None;
    loop {
        let values = match failed {
            None => wait(changes, Instant::MAX, pulse).await,
            Some(values) => {
                let deadline = Instant::now().saturating_add(RETRY_AFTER);
                let newer = wait(changes, deadline, pulse).await;
                newer.or(Some(values))
            }
        };
        let Some(values) = values else {
            continue;
        };
        failed = None;
        if values == stored {
            continue;
        }
        match store
            .save(
                program.fingerprint,
                Values::Running(program.retained, &values),
            )
            .await
        {
            Ok(()) => stored = values,
            Err(error) => {
                log_error(&error);
                failed = Some(values);
            }
        }
    }
}

/// The next change until a deadline, and a beat all the while. Only the wait is cut short, never a write.
async fn wait<const R: usize>(
    changes: &Changes<R>,
    deadline: Instant,
    pulse: &Pulse,
) -> Option<[i32; R]> {
    loop {
        pulse.beat();
        let beat = Instant::now().saturating_add(BEAT).min(deadline);
        match with_deadline(beat, changes.wait()).await {
            Ok(values) => return Some(values),
            Err(_) if Instant::now() >= deadline => return None,
            Err(_) => {}
        }
    }
}
