//! The stimulus CSV: read or refused in one line, and played when it was read.

use std::sync::LazyLock;

use grafcet::machine::Bench;
use grafcet::player::Player;
use grafcet::simulation::Simulation;
use grafcet::stimulus::Stimulus;
use grafcet_compiler::application::Application;
use grafcet_compiler::{Target, compile};

/// Words and signs of the file.
pub(crate) const WORDS: &str =
    "time_ms start level delay Saw:up , ,, \n \r\n \" \"\" ; \t -1 +1 1.5 \0 \u{feff} é";

/// The program that every stimulus is for.
const PROGRAM: &str = "\
input start
input level : int at %IW0
parameter delay : time = 1s in 0s .. 10s
graph Saw {
    input up at %IX0.0
    output MOTOR
    initial step 1
    step 2 { MOTOR IF level > 3 }
    transition 1: 1 -> 2 when \u{2191}start OR up
    transition 2: 2 -> 1 when T/X2/delay
}
";

static APPLICATION: LazyLock<Option<Application>> = LazyLock::new(|| {
    let none = |_: &str| Err(std::io::ErrorKind::NotFound.into());
    compile("fuzz.grafcet", PROGRAM, &none, Target::Host).application
});

/// So many scans are played.
const SCANS: usize = 20;

pub(crate) fn run(input: &[u8]) {
    let Some(application) = &*APPLICATION else {
        panic!("the program does not compile");
    };
    let unit = &application.controller;
    let stimulus = match Stimulus::read(input, &unit.symbols) {
        Ok(stimulus) => stimulus,
        Err(error) => {
            let said = error.to_string();
            assert!(!said.is_empty() && error.line > 0, "{error:?}");
            return;
        }
    };
    let times = stimulus.rows().iter().map(|row| row.time_ms);
    assert!(times.is_sorted());
    assert_eq!(
        stimulus.end_ms(),
        stimulus.rows().last().map_or(0, |row| row.time_ms)
    );
    let bench = Bench::new();
    let mut simulation = Simulation::new(&bench, application, &[]);
    let mut player = Player::new(unit, &stimulus);
    for scan in 0..SCANS {
        player.give(scan as u64 * simulation.period_ms(), &mut simulation);
        simulation.scan();
    }
}

pub(crate) fn seeds() -> Vec<Vec<u8>> {
    const SEEDS: [&str; 6] = [
        "time_ms,start,level,delay,Saw:up\n0,0,0,1000,0\n50,1,,,\n100,0,12,20,1\n",
        "time_ms\n0\n4294967295\n18446744073709551615\n",
        "time_ms , start\r\n 0 , 1\r\n10,\r\n",
        "time_ms,\"start\",level\n5,\"1\",-2147483648\n5,0,2147483647\n",
        "time_ms,MOTOR\n0,1\n",
        "\u{feff}time_ms,strat\n10,1\n0,0\n",
    ];
    SEEDS.iter().map(|seed| seed.as_bytes().to_vec()).collect()
}
