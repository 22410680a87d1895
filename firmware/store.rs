//! The store task: writes what the scan hands over, below the scan.

use embassy_time::{Duration, Instant, with_deadline};
use embedded_storage_async::nor_flash::NorFlash;
use grafcet_core::program::Program;

use crate::boot::log_error;
use crate::record::Values;
use crate::retain::Store;
use crate::scan::Changes;

/// How long to wait before a failed write is tried again.
const RETRY_AFTER: Duration = Duration::from_secs(1);

/// Stores retained values whenever they differ from those stored last, which are `stored` at first.
pub async fn keep<F: NorFlash, const R: usize>(
    store: &mut Store<F>,
    program: &Program<'_>,
    changes: &Changes<R>,
    mut stored: [i32; R],
) -> ! {
    let mut failed = None;
    loop {
        let values = match failed {
            None => changes.wait().await,
            // Only the wait may be cut short, never a write.
            Some(values) => {
                let deadline = Instant::now().saturating_add(RETRY_AFTER);
                with_deadline(deadline, changes.wait())
                    .await
                    .unwrap_or(values)
            }
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
