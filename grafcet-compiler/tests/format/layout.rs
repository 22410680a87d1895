//! Spaces and columns.

use super::{action, body, formatted};

#[test]
fn names_types_addresses_and_texts_of_declarations_line_up() {
    assert_eq!(
        formatted(
            "input start at %IX0.0 \"push button\"\n\
             input level:int at %IW0 in 0..250 \"cm\"\n\
             output   RAISE   at   %QX0.1\n\
             output M at %QX0.12 \"motor\"\n"
        ),
        "input  start       at %IX0.0            \"push button\"\n\
         input  level : int at %IW0 in 0 .. 250  \"cm\"\n\
         output RAISE       at %QX0.1\n\
         output M           at %QX0.12           \"motor\"\n"
    );
}

#[test]
fn variables_line_up_apart_from_inputs_and_outputs() {
    assert_eq!(
        formatted(
            "input a,b\nparameter delay:time=2  s in 1s..5s \"d\"\nretain var n:int=-1\nvar x,y:int\nconst full:int=1 \"f\"\n"
        ),
        "input  a, b\n\
         parameter delay : time = 2 s in 1s .. 5s  \"d\"\n\
         retain var n    : int = -1\n\
         var x, y : int\n\
         const full      : int = 1                 \"f\"\n"
    );
}

#[test]
fn an_empty_line_ends_a_group_and_a_comment_does_not() {
    assert_eq!(
        formatted("var a \"1\"\n// why\nvar long \"2\"\n\nvar longer_still \"3\"\n"),
        "var a     \"1\"\n// why\nvar long  \"2\"\n\nvar longer_still  \"3\"\n"
    );
}

#[test]
fn blocks_on_one_line_stand_behind_the_longest_step() {
    assert_eq!(
        body(
            "initial step 1 \"not the longest, without a block\"\nstep 2 \"go\" {A;B}\nstep 10 \"wait, and wait\"\nstep 3 { A }\nstep 4 \"many\" {\nA\n}"
        ),
        "initial step 1 \"not the longest, without a block\"\n\
         step 2  \"go\"              { A; B }\n\
         step 10 \"wait, and wait\"\n\
         step 3                    { A }\n\
         step 4  \"many\" {\n    A\n}\n"
    );
}

#[test]
fn entry_and_exit_steps_line_up_with_the_others() {
    assert_eq!(
        body("macro step M5 \"m\"\n{ entry step E5{A}\nstep 50 {B}\nexit step S5\n}"),
        "macro step M5 \"m\" {\n    entry step E5  { A }\n    step 50        { B }\n    exit step S5\n}\n"
    );
}

#[test]
fn the_entrances_of_transitions_line_up() {
    assert_eq!(
        body(
            "transition 9:1->2,3 when a\n// why\ntransition 10 :->1\ntransition 11 \"t\":4->\ntransition 12: 4 -> 5 when =1 do{x=0}"
        ),
        "transition 9:  1 -> 2, 3 when a\n\
         // why\n\
         transition 10: -> 1\n\
         transition 11 \"t\": 4 ->\n\
         transition 12: 4 -> 5 when =1 do { x = 0 }\n"
    );
}

#[test]
fn conditions_of_momentary_statements_and_of_orders_line_up() {
    assert_eq!(
        action("A IF a\nLONG IF b\nx=1 IF c\nF/G:{1,2}IF d\nF/H:{} IF e\nF/H:{*}"),
        "A    IF a\nLONG IF b\nx = 1 IF c\nF/G:{1, 2} IF d\nF/H:{}     IF e\nF/H:{*}\n"
    );
}

#[test]
fn bindings_line_up() {
    assert_eq!(
        formatted("graph A=T{\na at %IX0.0;\nlong=NOT b\n}\ngraph B = T {a at %IX0.0;b=c}\n"),
        "graph A = T {\n    a    at %IX0.0;\n    long = NOT b\n}\ngraph B = T { a at %IX0.0; b = c }\n"
    );
}

#[test]
fn statements_that_share_a_line_line_up_with_none() {
    assert_eq!(
        action("A IF a; B IF b\nLONG IF c"),
        "A IF a; B IF b\nLONG IF c\n"
    );
    assert_eq!(
        body("step 1 {A} step 2 {B}\nstep 100 {C}"),
        "step 1 { A } step 2 { B }\nstep 100  { C }\n"
    );
}

#[test]
fn operators_have_spaces_and_signs_and_edges_have_none() {
    for (text, expected) in [
        ("a=b+c*-d-1", "a = b + c * -d - 1"),
        ("a:=b MOD(c)", "a := b MOD (c)"),
        ("a=- 3", "a = -3"),
        ("A IF NOT( a&b|!c )", "A IF NOT (a & b | !c)"),
        ("A IF ↑ a AND RE a·¬( b )", "A IF ↑a AND RE a · ¬(b)"),
        ("A IF a<=b XOR c≠d", "A IF a <= b XOR c ≠ d"),
        ("A IF S (G)={ 1 ,2 }", "A IF S(G) = {1, 2}"),
        ("A IF S(G)<>{I}", "A IF S(G) <> {I}"),
        ("A IF G : a", "A IF G:a"),
        ("on  activation :x=0", "on activation: x = 0"),
        ("on event ↑(G : a):x=0", "on event ↑(G:a): x = 0"),
        ("on deactivation{x=0}", "on deactivation { x = 0 }"),
        ("F / G : { }", "F/G:{}"),
        ("\"a  text\"", "\"a  text\""),
    ] {
        assert_eq!(action(text), format!("{expected}\n"));
    }
}

#[test]
fn timers_hold_together() {
    for (text, expected) in [
        ("A IF T / X3 / 2s", "A IF T/X3/2s"),
        ("A IF T/a OR b / 14  s AND c", "A IF T/a OR b/14 s AND c"),
        ("A IF T/level > 300/t1", "A IF T/level>300/t1"),
        ("A IF T / (x / 2 > 1) / 3s", "A IF T/(x / 2 > 1)/3s"),
        ("A IF T/T / 2s", "A IF T/T/2s"),
        ("A IF T/ NOT a /( d*2 )", "A IF T/NOT a/(d * 2)"),
    ] {
        assert_eq!(action(text), format!("{expected}\n"));
    }
}

#[test]
fn about_other_slashes_the_author_decides() {
    for text in [
        "a = b/c",
        "a = b / c",
        "A IF 3s/X5",
        "A IF t1 / a / t2",
        "A IF 1s/(NOT a)",
    ] {
        assert_eq!(action(text), format!("{text}\n"));
    }
    assert_eq!(action("a = b/ c"), "a = b / c\n");
}

#[test]
fn spellings_stay() {
    let text = "A IF a & b AND c · d or ¬e | NOT f\n";
    assert_eq!(action(text), text);
}

#[test]
fn properties_and_tests_have_single_spaces() {
    assert_eq!(
        formatted(
            "property  \"p\" :never  - x>3\nproperty \"q\": after ↑a within 2  s expect(b)\ntest \"t\" with A,B{set a,b=3;wait  2 s;expect - x=3\nnever(a)\n}"
        ),
        "property \"p\": never -x > 3\n\
         property \"q\": after ↑a within 2 s expect (b)\n\
         test \"t\" with A, B {\n    set a, b = 3; wait 2 s; expect -x = 3\n    never (a)\n}\n"
    );
}

#[test]
fn enclosed_graphs_keep_their_sets_beside_them() {
    assert_eq!(
        body("step 2 \"a\" encloses A{1},B{ 2,3 }{ C }\nstep E5 { D }"),
        "step 2 \"a\" encloses A {1}, B {2, 3}  { C }\nstep E5                              { D }\n"
    );
}

#[test]
fn columns_are_counted_in_characters() {
    assert_eq!(
        formatted("input température at %IX0.0\ninput b at %IX0.1\n"),
        "input  température at %IX0.0\ninput  b           at %IX0.1\n"
    );
}
