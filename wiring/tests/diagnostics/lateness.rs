//! What becomes of late scans: the watchdog, and the policy for overload.

use wiring::file::{Overload, Policy};
use wiring::rule::Rule;

use crate::{GOOD, PROGRAM, changed, loaded_with, shown};

#[test]
fn the_watchdog_bears_a_scan_and_an_erase() {
    assert_shown!(changed("1 s", "400 ms"), OutOfRange);
}

#[test]
fn the_watchdog_waits_no_longer_than_it_can() {
    assert_shown!(changed("1 s", "9 s"), OutOfRange);
}

#[test]
fn a_scan_is_shorter_than_the_watchdog_can_wait() {
    let slow = PROGRAM.replace("application saw", "application saw\nscan 9 s");
    let unset = GOOD.replace("[watchdog]\ntimeout = \"1 s\"\n", "");
    assert_shown!(shown(&loaded_with(&slow, &unset)), OutOfRange);
}

#[test]
fn the_watchdog_follows_a_slow_scan_by_itself() {
    let slow = PROGRAM.replace("application saw", "application saw\nscan 2 s");
    let unset = GOOD.replace("[watchdog]\ntimeout = \"1 s\"\n", "");
    let (_, wiring) = loaded_with(&slow, &unset).image.unwrap();
    assert_eq!(wiring.watchdog_ms, 2400);
}

#[test]
fn an_overload_is_an_overrun_in_ten_scans_and_stops_unless_the_file_says_otherwise() {
    let overload = |table: &str| {
        let loaded = loaded_with(PROGRAM, &format!("{GOOD}{table}"));
        let (_, wiring) = loaded.image.expect("the file is good");
        wiring.overload
    };
    let (stop, go_on) = (Policy::SafeStop, Policy::KeepRunning);
    let cases = [
        ("", stop, 10),
        ("[overload]\n", stop, 10),
        ("[overload]\noverruns = 1\n", stop, 1),
        ("[overload]\npolicy = \"keep-running\"\n", go_on, 10),
        (
            "[overload]\npolicy = \"safe-stop\"\noverruns = 100\n",
            stop,
            100,
        ),
    ];
    for (table, policy, overruns) in cases {
        assert_eq!(overload(table), Overload { policy, overruns }, "{table}");
    }
}

#[test]
fn a_policy_for_overload_is_one_of_two_words() {
    assert_shown!(
        changed(
            "[watchdog]",
            "[overload]\npolicy = \"keep-runing\"\n\n[watchdog]"
        ),
        BadValue
    );
    assert_shown!(
        changed("[watchdog]", "[overload]\npolicy = true\n\n[watchdog]"),
        BadValue
    );
}

#[test]
fn an_overload_is_counted_among_a_hundred_scans() {
    for wrong in ["0", "101", "-1"] {
        let table = format!("[overload]\noverruns = {wrong}\n\n[watchdog]");
        let (rules, text) = changed("[watchdog]", &table);
        assert_eq!(rules, [Rule::OutOfRange], "{text}");
    }
    assert_shown!(
        changed("[watchdog]", "[overload]\noverruns = 101\n\n[watchdog]"),
        OutOfRange
    );
    assert_shown!(
        changed("[watchdog]", "[overload]\noverruns = \"10\"\n\n[watchdog]"),
        BadValue
    );
}

#[test]
fn an_overload_is_spelled_as_it_is() {
    assert_shown!(
        changed(
            "[watchdog]",
            "[overlaod]\npolicy = \"safe-stop\"\n\n[watchdog]"
        ),
        UnknownKey
    );
    assert_shown!(
        changed("[watchdog]", "[overload]\noverrun = 3\n\n[watchdog]"),
        UnknownKey
    );
    assert_shown!(
        changed("board =", "overload = \"safe-stop\"\nboard ="),
        BadValue
    );
}
