//! Long runs: past 2^32 µs (71.6 min), past 2^32 ms (49.7 days) and for half a century. A timer that fired stays True,
//! none fires twice, and no scan is lost.

#![allow(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use grafcet::machine::{Bench, Machine};
use grafcet_compiler::application::Application;
use grafcet_compiler::{Target, compile};
use grafcet_core::program::Slot;

const HOUR_MS: u64 = 3_600_000;
const DAY_MS: u64 = 24 * HOUR_MS;
const YEAR_MS: u64 = 365 * DAY_MS + 6 * HOUR_MS;
/// 2^32 µs, in ms.
const MICROSECONDS_WRAP: u64 = (1 << 32) / 1000;
/// 2^32 ms.
const MILLISECONDS_WRAP: u64 = 1 << 32;

/// Every kind of timer, started at once and never again; each counts how often it becomes True.
const ALL_TIMERS: &str = "\
input go
parameter long : time = 20d
var by_step, by_enable, by_delay, by_seconds, by_parameter, by_hold, falls, scans : int
output STEP, ENABLE, DELAY, SECONDS, PARAMETER, HOLD
graph G {
    initial step 1
    step 2
    transition 1: 1 -> 2 when \u{2191}go
    always {
        scans = scans + 1
        STEP      IF T/X2/24d
        ENABLE    IF T/go/23d
        DELAY     IF 22d/go
        SECONDS   IF T/(go AND X2)/2000000
        PARAMETER IF T/X2/long
        HOLD      IF 1s/go/5s
        by_step      = by_step + 1      IF \u{2191}(T/X2/24d)
        by_enable    = by_enable + 1    IF \u{2191}(T/go/23d)
        by_delay     = by_delay + 1     IF \u{2191}(22d/go)
        by_seconds   = by_seconds + 1   IF \u{2191}(T/(go AND X2)/2000000)
        by_parameter = by_parameter + 1 IF \u{2191}(T/X2/long)
        by_hold      = by_hold + 1      IF \u{2191}(1s/go/5s)
        falls        = falls + 1        IF \u{2193}(1s/go/5s)
    }
}
";

struct Run<'b, 't> {
    application: &'t Application,
    machine: Machine<'b>,
    scans: i32,
}

impl<'b, 't> Run<'b, 't> {
    fn new(bench: &'b Bench<'t>, application: &'t Application) -> Self {
        Run {
            application,
            machine: bench.machine(&application.controller.tables),
            scans: 0,
        }
    }

    fn slot(&self, name: &str) -> Slot {
        let variables = &self.application.controller.symbols.variables;
        variables.iter().find(|it| it.name == name).unwrap().slot
    }

    fn set(&mut self, name: &str, value: i32) {
        self.machine.sample(self.slot(name), value);
    }

    fn scan(&mut self, time_ms: u64) {
        self.machine.scan(time_ms);
        self.scans += 1;
    }

    fn values<const N: usize>(&self, names: [&str; N]) -> [i32; N] {
        names.map(|name| self.machine.images().value(self.slot(name)))
    }
}

fn application(text: &str) -> Application {
    let none = |_: &str| Err(std::io::ErrorKind::NotFound.into());
    let compilation = compile("long.grafcet", text, &none, Target::Host);
    compilation.application.unwrap()
}

const OUTPUTS: [&str; 6] = ["STEP", "ENABLE", "DELAY", "SECONDS", "PARAMETER", "HOLD"];
const COUNTS: [&str; 6] = [
    "by_step",
    "by_enable",
    "by_delay",
    "by_seconds",
    "by_parameter",
    "by_hold",
];

/// The places where 32 bits of µs or ms end, and around them: a scan on each side, and on it.
fn brinks(until_ms: u64) -> Vec<u64> {
    let wraps = (1..40).map(|n| n * MICROSECONDS_WRAP);
    let wraps = wraps.chain((1..=until_ms / MILLISECONDS_WRAP).map(|n| n * MILLISECONDS_WRAP));
    let signs = (1..=until_ms / MILLISECONDS_WRAP).map(|n| n * MILLISECONDS_WRAP - (1 << 31));
    let mut times: Vec<u64> = wraps
        .chain(signs)
        .flat_map(|at| [at - 10, at - 1, at, at + 1, at + 10])
        .filter(|at| *at < until_ms)
        .collect();
    times.sort_unstable();
    times.dedup();
    times
}

#[test]
fn timers_fire_once_and_stay_true_for_half_a_century() {
    let application = application(ALL_TIMERS);
    // Started at once, just before 32 bits of time end, and years after power came.
    for start in [
        0,
        MICROSECONDS_WRAP - 5,
        (1 << 31) - 5,
        MILLISECONDS_WRAP - 5,
        3 * MILLISECONDS_WRAP - 5,
        10 * YEAR_MS,
    ] {
        let bench = Bench::new();
        let mut run = Run::new(&bench, &application);
        run.scan(0);
        if start > 0 {
            run.scan(start);
        }
        run.set("go", 1);
        let begin = start + 10;
        run.scan(begin);
        let due = [
            24 * DAY_MS,
            23 * DAY_MS,
            22 * DAY_MS,
            2_000_000_000,
            20 * DAY_MS,
            1000,
        ];
        let mut times = brinks(50 * YEAR_MS);
        times.extend(due.iter().flat_map(|due| [begin + due - 1, begin + due]));
        times.retain(|time| *time > begin);
        times.sort_unstable();
        times.dedup();
        for time in times {
            run.scan(time);
            let fired = due.map(|due| i32::from(time - begin >= due));
            assert_eq!(
                run.values(OUTPUTS),
                fired,
                "at {time} ms, started at {begin} ms"
            );
            assert_eq!(
                run.values(COUNTS),
                fired,
                "at {time} ms, started at {begin} ms"
            );
        }
        assert_eq!(run.values(["scans", "falls"]), [run.scans, 0]);
    }
}

#[test]
fn an_off_delay_that_begins_years_later_ends_in_time() {
    let application = application(ALL_TIMERS);
    for begin in [
        MICROSECONDS_WRAP,
        MILLISECONDS_WRAP,
        7 * MILLISECONDS_WRAP,
        40 * YEAR_MS,
    ] {
        let bench = Bench::new();
        let mut run = Run::new(&bench, &application);
        run.set("go", 1);
        run.scan(0);
        run.scan(1000);
        // It falls a moment before the wrap, and the hold ends a moment behind it.
        let fall = begin - 10;
        run.scan(fall - 10);
        run.set("go", 0);
        run.scan(fall);
        assert_eq!(run.values(["HOLD", "falls"]), [1, 0]);
        run.scan(fall + 4_999);
        assert_eq!(run.values(["HOLD", "falls"]), [1, 0]);
        run.scan(fall + 5_000);
        assert_eq!(run.values(["HOLD", "falls"]), [0, 1]);
        for later in brinks(begin + 2 * MILLISECONDS_WRAP) {
            if later > fall + 5_000 {
                run.scan(later);
                assert_eq!(run.values(["HOLD", "falls"]), [0, 1], "at {later} ms");
            }
        }
    }
}

#[test]
fn a_cycle_of_steps_is_timed_alike_before_and_behind_every_end_of_32_bits() {
    let application = application(
        "var n : int\n\
         graph G { initial step 1; step 2 { on activation: n = n + 1 }\n\
         transition 1: 1 -> 2 when T/X1/30ms\n\
         transition 2: 2 -> 1 when T/X2/20ms }",
    );
    for end in [
        MICROSECONDS_WRAP,
        1 << 31,
        MILLISECONDS_WRAP,
        5 * MILLISECONDS_WRAP,
        1 << 53,
    ] {
        let bench = Bench::new();
        let mut run = Run::new(&bench, &application);
        run.scan(0);
        // Step 2 is entered at the first scan, long due.
        let first = end - 1000;
        for scan in 0..200 {
            run.scan(first + scan * 10);
            // It is left two scans later, and entered three behind that: once in five.
            let entered = 1 + scan / 5;
            assert_eq!(
                run.values(["n"]),
                [i32::try_from(entered).unwrap()],
                "scan {scan}"
            );
        }
    }
}
