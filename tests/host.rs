//! The parts of the soft PLC: its clock, its flash in a file, its command line.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

use std::fs;
use std::future::pending;
use std::process::{Command, Output, Stdio};

use embassy_futures::block_on;
use embassy_futures::join::join;
use embassy_time::{Duration, Instant, Timer};
use embedded_storage_async::nor_flash::{NorFlash, ReadNorFlash};
use plc::boards::host::clock::{simulate, work};
use plc::boards::host::flash::{Error, FlashFile};

#[test]
fn simulated_time_jumps_from_alarm_to_alarm() {
    let years = Duration::from_secs(50 * 365 * 24 * 3600);
    let (ended, between) = simulate(async {
        let mut between = Vec::new();
        join(Timer::after(years), async {
            for ms in [1, 10, 100] {
                Timer::after_millis(ms).await;
                between.push(Instant::now().as_millis());
            }
        })
        .await;
        (Instant::now(), between)
    })
    .expect("alarms are set");
    assert_eq!(ended, Instant::from_ticks(0) + years);
    assert_eq!(between, [1, 11, 111]);
}

#[test]
fn work_lets_simulated_time_pass_and_alarms_ring_late() {
    let late = simulate(async {
        work(Duration::from_millis(30));
        Timer::at(Instant::from_millis(10)).await;
        Instant::now().as_millis()
    });
    assert_eq!(late, Some(30));
}

#[test]
fn what_can_never_go_on_ends_the_simulation() {
    assert_eq!(simulate(pending::<()>()), None);
}

#[test]
fn a_flash_in_a_file_clears_bits_erases_sectors_and_is_there_the_next_time() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("area");
    let area = 0x1_0000..0x1_4000;
    let read = |flash: &mut FlashFile, offset| {
        let mut byte = [0; 2];
        block_on(flash.read(offset, &mut byte)).map(|()| byte)
    };
    let mut flash = FlashFile::open(&path, area.clone()).expect("the file can be made");
    assert_eq!(
        read(&mut flash, 0x1_3ffe).expect("it is in the area"),
        [0xff; 2]
    );
    block_on(flash.write(0x1_1000, &[0x0f, 0xf0])).expect("it is in the area");
    block_on(flash.write(0x1_1000, &[0xfc, 0xff])).expect("it is in the area");
    drop(flash);
    let mut flash = FlashFile::open(&path, area.clone()).expect("the file is there");
    assert_eq!(
        read(&mut flash, 0x1_1000).expect("it is in the area"),
        [0x0c, 0xf0]
    );
    block_on(flash.erase(0x1_1000, 0x1_2000)).expect("it is a sector");
    assert_eq!(
        read(&mut flash, 0x1_1000).expect("it is in the area"),
        [0xff; 2]
    );
    assert!(matches!(read(&mut flash, 0xfffe), Err(Error::OutOfBounds)));
    assert!(matches!(
        read(&mut flash, 0x1_3fff),
        Err(Error::OutOfBounds)
    ));
    assert!(matches!(
        block_on(flash.erase(0x1_0000, 0x1_0800)),
        Err(Error::NotAligned)
    ));
}

#[test]
fn a_file_of_another_length_is_made_to_fit_and_keeps_its_beginning() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("area");
    for length in [0, 100, 4096, 100_000] {
        fs::write(&path, vec![0x5a; length]).expect("the folder is ours");
        FlashFile::open(&path, 0..16_384).expect("the file is there");
        let bytes = fs::read(&path).expect("the file is there");
        assert_eq!(bytes.len(), 16_384);
        let kept = length.min(16_384);
        assert!(bytes[..kept].iter().all(|byte| *byte == 0x5a));
        assert!(bytes[kept..].iter().all(|byte| *byte == 0xff));
    }
}

fn plc(arguments: &[&str]) -> Output {
    let output = Command::new(env!("CARGO_BIN_EXE_plc"))
        .args(arguments)
        .output();
    output.expect("the soft PLC can be run")
}

#[test]
fn in_simulated_time_the_command_prints_the_same_every_time() {
    let (first, second) = (plc(&["--fast"]), plc(&["--fast"]));
    assert!(first.status.success());
    assert!(String::from_utf8_lossy(&first.stdout).contains("LineSwitcher T7: {3} -> {5}"));
    assert_eq!(first.stdout, second.stdout);
}

#[test]
fn the_command_stops_when_its_time_is_over() {
    let output = plc(&["--fast", "--for", "2"]);
    assert!(output.status.success());
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(
        text.contains("T3: {2} -> {3}") && !text.contains("T7: {3} -> {5}"),
        "{text}"
    );
}

#[test]
fn in_real_time_the_same_lines_begin() {
    let output = plc(&["--for", "0"]);
    assert!(output.status.success());
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(
        text.contains("real time") && text.contains("LineSwitcher starts in {1}"),
        "{text}"
    );
}

#[test]
fn what_cannot_be_done_is_said_and_ends_with_2() {
    let wrong = plc(&["--faster"]);
    assert_eq!(wrong.status.code(), Some(2));
    let folder = tempfile::tempdir().expect("a temporary folder");
    let missing = folder.path().join("missing/file");
    let output = plc(&["--fast", "--retain", &missing.to_string_lossy()]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).starts_with("error: cannot use "));
}

#[test]
fn the_soft_plc_ends_quietly_when_nobody_reads_its_lines() {
    let mut plc = Command::new(env!("CARGO_BIN_EXE_plc"))
        .arg("--fast")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the soft PLC starts");
    drop(plc.stdout.take());
    let Output { status, stderr, .. } = plc.wait_with_output().expect("it ends");
    assert_eq!(String::from_utf8_lossy(&stderr), "");
    assert!(status.success());
}
