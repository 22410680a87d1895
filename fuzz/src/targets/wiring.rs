//! `plc.toml`: an answer, and an image or errors, never both.

use wiring::load_from;

use crate::corpus;

/// Words and signs of the file.
pub(crate) const WORDS: &str = "application board inputs outputs retain watchdog scan sectors timeout pin pull active \
    filter safe range \"pico\" \"GP2\" \"GP25\" \"GP26\" \"%IX0.0\" \"%QX0.0\" \"%IW0\" \"%QW0\" \"%MX0.0\" \"up\" \"down\" \
    \"none\" \"low\" \"high\" \"on\" \"off\" \"5ms\" \"1s\" \"2min\" true false [ ] [[ ]] { } = , . # \" ' \"\"\" ''' \\u0041 \
    nan inf 1979-05-27 0xff \0 \r\n \u{feff} é";

/// The program that every file wires.
const PROGRAM: &str = "\
input  start at %IX0.0
input  stop  at %IX0.1
input  level : int at %IW0
output MOTOR at %QX0.0
output LAMP  at %QX0.1
retain var count : int
graph Saw {
    initial step 1
    step 2 { MOTOR; LAMP IF level > 10; count = count + 1 IF \u{2191}stop }
    transition 1: 1 -> 2 when start
    transition 2: 2 -> 1 when NOT start OR stop
}
";

pub(crate) fn run(input: &[u8]) {
    // The file is read as text.
    let Ok(text) = str::from_utf8(input) else {
        return;
    };
    let read = |path: &str| Ok(if path == "plc.toml" { text } else { PROGRAM }.to_owned());
    match load_from("plc.toml", &read) {
        Ok(loaded) => assert_eq!(loaded.image.is_some(), loaded.errors().is_empty()),
        Err(error) => panic!("the file was there: {error}"),
    }
}

pub(crate) fn seeds() -> Vec<Vec<u8>> {
    let shipped = corpus::repository("graphs", "plc.toml");
    let own = corpus::repository("", "/plc.toml").into_iter().take(1);
    shipped
        .into_iter()
        .chain(own)
        .map(String::into_bytes)
        .collect()
}
