//! The board and its pins.

use wiring::rule::Rule;

use crate::changed;

#[test]
fn an_unknown_board_is_told_its_nearest() {
    assert_shown!(changed("\"pico\"", "\"picoo\""), UnknownBoard);
}

#[test]
fn a_board_of_another_kind_is_told_what_there_is() {
    assert_shown!(changed("\"pico\"", "\"esp32\""), UnknownBoard);
}

#[test]
fn a_pin_is_called_as_on_the_board() {
    assert_shown!(changed("\"GP2\"", "\"PIN_2\""), UnknownPin);
}

#[test]
fn a_pin_that_the_board_needs_is_refused_with_the_reason() {
    assert_shown!(changed("GP2", "GP23"), ReservedPin);
}

#[test]
fn the_led_is_no_input() {
    assert_shown!(changed("GP2", "GP25"), ReservedPin);
    let (rules, text) = changed("GP16", "GP25");
    assert_eq!(rules, [], "{text}");
}

#[test]
fn a_pin_serves_one_address() {
    assert_shown!(changed("GP16", "GP3"), PinUsedTwice);
}
