//! The boards that there are.

use std::collections::BTreeSet;

use wiring::board::{BOARDS, Board, Purpose};
use wiring::boards::PICO;

#[test]
fn a_board_is_found_by_its_name() {
    for board in BOARDS {
        assert_eq!(Board::by_name(board.name), Some(*board));
    }
    assert_eq!(Board::by_name("Pico"), None);
}

#[test]
fn no_two_pins_share_a_name_or_a_peripheral() {
    for board in BOARDS {
        let names: BTreeSet<_> = board.pins.iter().map(|pin| pin.name).collect();
        let peripherals: BTreeSet<_> = board.pins.iter().map(|pin| pin.peripheral).collect();
        assert_eq!(names.len(), board.pins.len());
        assert_eq!(peripherals.len(), board.pins.len());
    }
}

#[test]
fn the_pico_offers_its_26_pins_and_its_led() {
    let free = PICO.pins.iter().filter(|pin| pin.purpose == Purpose::Free);
    assert_eq!(free.count(), 26);
    assert_eq!(PICO.pins.len(), 30);
    let led = PICO.pin("GP25").unwrap();
    assert!(matches!(led.purpose, Purpose::Output(_)));
}

#[test]
fn the_pico_measures_at_four_pins_one_of_which_is_its_supply() {
    let pins = PICO.pins.iter().filter(|pin| pin.analogue);
    let names: Vec<&str> = pins.clone().map(|pin| pin.name).collect();
    assert_eq!(names, ["GP26", "GP27", "GP28", "GP29"]);
    let kept: Vec<&str> = pins
        .filter(|pin| matches!(pin.purpose, Purpose::AnalogueInput(_)))
        .map(|pin| pin.name)
        .collect();
    assert_eq!(kept, ["GP29"]);
}

#[test]
fn the_watchdog_outlasts_an_erase() {
    for board in BOARDS {
        assert!(board.watchdog_limit_ms > 2 * board.erase_ms);
    }
}
