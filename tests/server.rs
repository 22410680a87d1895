//! The plants answer a controller that runs elsewhere, scan for scan as they move the soft PLC.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

use std::io::{BufRead, BufReader, PipeReader, PipeWriter, Write, pipe};
use std::thread;

use grafcet_core::engine::Engine;
use grafcet_core::memory::Memory;
use grafcet_core::program::Compiled;
use plc::application::{
    ANALOGUE_INPUTS, ANALOGUE_LABELS, DEMONSTRATION, INPUT_LABELS, INPUTS, OUTPUT_LABELS, OUTPUTS,
    PLANTS, PROGRAM, Storage, ThisProgram,
};
use plc::boards::host::machine::{Machine, Parts};
use plc::boards::host::server::{Error, Terminals, serve};

const TERMINALS: Terminals = Terminals {
    period_ms: 10,
    layout: &PROGRAM.layout,
    inputs: &INPUTS,
    input_labels: &INPUT_LABELS,
    analogue_labels: &ANALOGUE_LABELS,
    outputs: &OUTPUTS,
    output_labels: &OUTPUT_LABELS,
};

fn machine() -> Machine {
    Machine::new(Parts {
        period_ms: PROGRAM.period_ms,
        inputs: &INPUTS,
        analogue: &ANALOGUE_INPUTS,
        analogue_labels: &ANALOGUE_LABELS,
        outputs: &OUTPUTS,
        plants: &PLANTS,
        script: DEMONSTRATION.as_ref(),
    })
}

/// A controller behind the line: its pins are in the lines, and its inputs have no filters.
struct Elsewhere {
    requests: PipeWriter,
    answers: BufReader<PipeReader>,
    said: Vec<String>,
}

impl Elsewhere {
    fn read(&mut self) -> String {
        let mut line = String::new();
        self.answers
            .read_line(&mut line)
            .expect("the server is there");
        line.trim_end().to_owned()
    }

    /// Sends a request, keeps what is said, and gives the rest of the answer.
    fn ask(&mut self, request: &str) -> String {
        writeln!(self.requests, "{request}").expect("the server is there");
        loop {
            let answer = self.read();
            match answer.strip_prefix("say ") {
                Some(text) => self.said.push(text.to_owned()),
                None => return answer,
            }
        }
    }

    /// Runs from power-on until something else than a scan is asked for.
    fn run(&mut self, retained: &mut Vec<i32>) -> String {
        let mut engine = Engine::new(ThisProgram, Storage::new());
        for (row, value) in PROGRAM.retained.iter().zip(retained.iter()) {
            engine.restore(row.slot, *value);
        }
        let mut answer = self.ask(&format!("power {}", "0".repeat(OUTPUTS.len())));
        for scan in 0.. {
            let Some(levels) = answer.strip_prefix("inputs ") else {
                break;
            };
            let levels = levels.strip_suffix(" -").expect("there are no numbers");
            for (wire, level) in INPUTS.iter().zip(levels.chars()) {
                engine.set_input(wire.bit, (level == '1') != wire.active_low);
            }
            match scan {
                0 => engine.start(),
                _ => {
                    engine.scan(scan * u64::from(PROGRAM.period_ms));
                }
            }
            answer = self.ask(&request(&engine));
        }
        *retained = PROGRAM
            .retained
            .iter()
            .map(|row| engine.value(row.slot))
            .collect();
        answer
    }
}

fn request(engine: &Engine<impl Compiled, impl Memory>) -> String {
    let level = |wire: &plc::wiring::OutputWire| engine.bit(wire.bit) != wire.active_low;
    let levels: String = OUTPUTS
        .iter()
        .map(|wire| if level(wire) { '1' } else { '0' })
        .collect();
    let image: Vec<String> = engine
        .image()
        .iter()
        .map(|word| format!("{word:x}"))
        .collect();
    let numbers: Vec<String> = engine.numbers().iter().map(i32::to_string).collect();
    format!("scan {levels} {} {}", image.join(","), numbers.join(","))
}

#[test]
fn the_demonstration_holds_for_a_controller_elsewhere() {
    let (server_requests, requests) = pipe().expect("a pipe");
    let (answers, server_answers) = pipe().expect("a pipe");
    let server = thread::spawn(move || {
        let requests = BufReader::new(server_requests);
        serve(&mut machine(), &TERMINALS, requests, server_answers)
    });
    let mut elsewhere = Elsewhere {
        requests,
        answers: BufReader::new(answers),
        said: Vec::new(),
    };
    while elsewhere.read() != "ready" {}
    let mut retained = Vec::new();
    assert_eq!(elsewhere.run(&mut retained), "power-cycle");
    assert_eq!(elsewhere.run(&mut retained), "end held");
    assert!(elsewhere.said.iter().any(|text| text == "Power fails."));
    drop(elsewhere);
    server
        .join()
        .expect("the server does not panic")
        .expect("the line is in order");
}

#[test]
fn it_begins_by_saying_what_hangs_where() {
    let mut answers = Vec::new();
    serve(&mut machine(), &TERMINALS, &b""[..], &mut answers).expect("nothing is asked");
    let text = String::from_utf8(answers).expect("text");
    let lines: Vec<&str> = text.lines().collect();
    let memory = format!("memory {} {}", PROGRAM.layout.words, PROGRAM.layout.numbers);
    assert_eq!(lines[..3], ["period 10", &memory, "input GP2 high Onduty"]);
    assert_eq!(lines[lines.len() - 2..], ["output GP19 high BL2C", "ready"]);
}

#[test]
fn a_line_that_is_no_request_ends_it_with_the_line_named() {
    for line in [
        "",
        "scan",
        "power 0012",
        "scan 0000 xyz 0",
        "scan 0000 0 0 more",
        "stop 0000",
    ] {
        let ended = serve(
            &mut machine(),
            &TERMINALS,
            format!("{line}\n").as_bytes(),
            Vec::new(),
        );
        assert!(
            matches!(&ended, Err(Error::Request(named)) if named == line),
            "{line}: {ended:?}"
        );
    }
}
