//! How the file is written: its keys, the values they take, and what is no TOML.

use wiring::rule::Rule;

use crate::{GOOD, PROGRAM, changed, loaded_with, shown};

#[test]
fn a_key_without_meaning_is_unknown() {
    assert_shown!(changed("pull =", "pul ="), UnknownKey);
}

#[test]
fn an_unknown_table_is_told_the_known_ones() {
    assert_shown!(changed("[retain]", "[flash]"), UnknownKey);
}

#[test]
fn a_file_has_to_name_program_and_board() {
    let nothing = loaded_with(PROGRAM, "");
    assert_shown!(shown(&nothing), MissingKey, MissingKey);
}

#[test]
fn an_input_has_to_have_a_pin() {
    assert_shown!(changed("pin = \"GP3\", ", ""), MissingKey);
}

#[test]
fn a_pull_is_one_of_three_words() {
    assert_shown!(changed("\"up\"", "\"upp\""), BadValue);
}

#[test]
fn a_filter_is_a_text() {
    assert_shown!(changed("\"5 ms\"", "5"), BadValue);
}

#[test]
fn an_input_is_no_number() {
    assert_shown!(changed("\"GP2\"", "2"), BadValue);
}

#[test]
fn a_duration_has_a_unit() {
    assert_shown!(changed("5 ms", "5 msec"), BadDuration);
}

#[test]
fn a_filter_lasts_a_second_at_most() {
    assert_shown!(changed("5 ms", "1001 ms"), OutOfRange);
}

#[test]
fn a_key_twice_shows_both() {
    assert_shown!(
        changed("[outputs]", "\"%IX0.0\" = \"GP4\"\n\n[outputs]"),
        Toml
    );
}

#[test]
fn an_address_needs_its_quotes() {
    assert_shown!(changed("\"%IX0.0\"", "%IX0.0"), Toml);
}

#[test]
fn what_is_no_toml_is_told_once_a_line() {
    assert_shown!(changed("board = \"pico\"", "board = pico"), Toml);
}

#[test]
fn a_value_in_place_of_a_table_is_refused() {
    assert_shown!(
        shown(&loaded_with(
            PROGRAM,
            &format!("watchdog = 5\n{}", GOOD.split("[watchdog]").next().unwrap())
        )),
        BadValue
    );
}
