//! Who is alive, and who hung.
//!
//! Only the scan feeds the watchdog, and only while every other task shows that it lives: each has a [`Pulse`], which
//! the scan counts. So whatever hangs, the scan notices, or does not come itself. In both cases the image is started
//! anew, and the next boot line names the task.
//!
//! Silence is counted in scans rather than looked up on a clock: while the flash is erased nothing runs, neither the
//! task nor the scan, and nobody is to blame.

use core::sync::atomic::{AtomicU32, Ordering};

/// What can hang.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    /// All that comes before scan 0.
    Start,
    /// The scan, with the filters of its inputs; and whatever keeps it from coming.
    Scan,
    /// The task that stores retained values.
    Store,
}

impl Task {
    /// Every task.
    pub const ALL: [Task; 3] = [Task::Start, Task::Scan, Task::Store];

    /// The task as a word that is left for the next start.
    #[must_use]
    pub const fn word(self) -> u32 {
        match self {
            Task::Start => 1,
            Task::Scan => 2,
            Task::Store => 3,
        }
    }

    /// The task in a word that was left. Without a name it is the scan, which did not come.
    #[must_use]
    pub fn read(word: u32) -> Task {
        let found = Task::ALL.into_iter().find(|task| task.word() == word);
        found.unwrap_or(Task::Scan)
    }

    /// What it is called in the log.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Task::Start => "start",
            Task::Scan => "scan",
            Task::Store => "retain store",
        }
    }
}

/// The sign of life of a task below the scan.
#[derive(Debug)]
pub struct Pulse {
    task: Task,
    /// How long it may be silent, in ms.
    limit_ms: u32,
    /// How long it has been silent, in ms of scans that have run.
    silent_ms: AtomicU32,
}

impl Pulse {
    /// A task that shows every `limit_ms` at least that it lives; it has two scans more.
    #[must_use]
    pub const fn new(task: Task, limit_ms: u32) -> Self {
        Pulse {
            task,
            limit_ms,
            silent_ms: AtomicU32::new(0),
        }
    }

    /// The task lives.
    pub fn beat(&self) {
        self.silent_ms.store(0, Ordering::Relaxed);
    }

    /// Another scan has run. The answer is the task, when it has been silent for too long.
    pub fn count(&self, period_ms: u32) -> Option<Task> {
        // The task does not run while the scan does, so that its beat cannot come in between.
        let silent_ms = self
            .silent_ms
            .load(Ordering::Relaxed)
            .saturating_add(period_ms);
        self.silent_ms.store(silent_ms, Ordering::Relaxed);
        let limit_ms = self.limit_ms.saturating_add(period_ms.saturating_mul(2));
        (silent_ms > limit_ms).then_some(self.task)
    }
}
