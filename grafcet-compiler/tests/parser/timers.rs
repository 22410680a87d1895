//! `T/enable/preset`, delays, and what looks like them.

use super::{show, statements, tree, wrong_trigger};

#[test]
fn the_timers_of_the_book() {
    assert_eq!(tree("T/X3/2s"), "(T X3 2000ms)");
    assert_eq!(tree("T/X1/delay"), "(T X1 delay)");
    assert_eq!(
        tree("T/switch1 OR switch2/14s"),
        "(T (OR switch1 switch2) 14000ms)"
    );
    assert_eq!(tree("T/temperature>300/t1"), "(T (> temperature 300) t1)");
    assert_eq!(tree("T/ X23 / 14 s"), "(T X23 14000ms)");
}

#[test]
fn the_enable_is_a_whole_expression() {
    assert_eq!(tree("T/NOT a AND ↑b/2s"), "(T (AND (NOT a) (↑ b)) 2000ms)");
    assert_eq!(tree("T/S(G) = {1}/2s"), "(T (S G = {1}) 2000ms)");
}

#[test]
fn a_division_inside_an_enable_stands_in_parentheses() {
    assert_eq!(tree("T/(a / 2) > 3/4s"), "(T (> (/ a 2) 3) 4000ms)");
    assert_eq!(
        wrong_trigger("T/a / 2 > 3/4s"),
        "syntax 1: expected the end of the timer, found `>`"
    );
}

#[test]
fn a_timer_inside_an_enable_stands_in_parentheses() {
    assert_eq!(tree("T/(T/a/2s)/3s"), "(T (T a 2000ms) 3000ms)");
    assert_eq!(tree("T/(3s/X5)/2s"), "(T (delay 3000ms X5) 2000ms)");
    assert_eq!(
        wrong_trigger("T/T/a/2s/3s"),
        "syntax 1: expected the end of the timer, found `/`"
    );
    assert_eq!(
        wrong_trigger("T/3s/X5/2s"),
        "syntax 1: expected the end of the timer, found `/`"
    );
}

#[test]
fn a_preset_is_a_duration_an_integer_a_name_or_in_parentheses() {
    assert_eq!(tree("T/a/5"), "(T a 5)");
    assert_eq!(tree("T/a/Saw1:delay"), "(T a Saw1:delay)");
    assert_eq!(tree("T/a/(b + 1s)"), "(T a (+ b 1000ms))");
    assert_eq!(
        wrong_trigger("T/a/b + 1s"),
        "syntax 1: expected the end of the timer, found `+`"
    );
    assert_eq!(
        wrong_trigger("T/a/-2s"),
        "syntax 1: expected the preset of the timer, found `-`"
    );
    assert_eq!(
        wrong_trigger("T/a"),
        "syntax 1: expected `/` and the preset of the timer, found the end of the line"
    );
}

#[test]
fn a_timer_binds_tighter_than_not_and_looser_than_comparisons() {
    assert_eq!(tree("NOT T/X6/2s AND a"), "(AND (NOT (T X6 2000ms)) a)");
    assert_eq!(tree("T/X2/15s AND NOT up"), "(AND (T X2 15000ms) (NOT up))");
    assert_eq!(tree("↑T/X3/2s"), "(↑ (T X3 2000ms))");
    assert_eq!(
        wrong_trigger("T/X3/2s = TRUE"),
        "syntax 1: expected the end of the timer, found `=`"
    );
}

#[test]
fn without_a_slash_t_is_a_variable() {
    assert_eq!(show::statement(&statements("T = T + 1")[0]), "T = (+ T 1)");
    assert_eq!(tree("(T)/2 > 1"), "(> (/ T 2) 1)");
    assert_eq!(tree("T AND t/2 > T"), "(AND T (> (/ t 2) T))");
}

#[test]
fn delays_of_step_bits_and_of_conditions_in_parentheses_are_known_by_their_form() {
    assert_eq!(tree("3s/X5"), "(delay 3000ms X5)");
    assert_eq!(tree("3s/X5/1s"), "(delay 3000ms X5 1000ms)");
    assert_eq!(tree("t1/(a AND b)/t2"), "(delay t1 (AND a b) t2)");
    assert_eq!(tree("t1/(NOT a)"), "(delay t1 (NOT a))");
    assert_eq!(tree("3s/G:X5 AND a"), "(AND (delay 3000ms G:X5) a)");
}

#[test]
fn where_only_types_can_tell_a_division_is_left() {
    assert_eq!(tree("3s/a"), "(/ 3000ms a)");
    assert_eq!(tree("1s/a/2s"), "(/ (/ 1000ms a) 2000ms)");
    assert_eq!(tree("t1/(a)/t2"), "(/ (/ t1 a) t2)");
    assert_eq!(tree("3s/XM5"), "(/ 3000ms XM5)");
}

#[test]
fn a_prefix_before_a_delay_takes_it_whole() {
    assert_eq!(tree("NOT 3s/X5"), "(NOT (delay 3000ms X5))");
    assert_eq!(
        tree("↑3s/X5/2s AND a"),
        "(AND (↑ (delay 3000ms X5 2000ms)) a)"
    );
}

#[test]
fn what_is_delayed_stands_in_parentheses_unless_it_is_a_name() {
    for (enable, found) in [
        ("NOT a", "NOT"),
        ("↑a", "↑"),
        ("TRUE", "TRUE"),
        ("S(G) = {1}", "S"),
        ("T/a/2s", "T"),
    ] {
        assert_eq!(
            wrong_trigger(&format!("3s/{enable}")),
            format!("syntax 1: `{found}` behind `/` stands in parentheses")
        );
    }
}
