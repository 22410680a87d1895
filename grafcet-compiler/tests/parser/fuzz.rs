//! Whatever stands in a file, the parser answers, and its places lie in the text.

use grafcet_compiler::render::{Style, render, render_json};
use grafcet_compiler::source::Sources;
use proptest::prelude::*;

/// Reads a text and draws what is wrong with it.
fn survives(text: &str) {
    let mut sources = Sources::default();
    sources.add("fuzz.grafcet", text);
    let (_, diagnostics) = super::read(text);
    for diagnostic in &diagnostics {
        let (start, end) = (diagnostic.span.start as usize, diagnostic.span.end as usize);
        assert!(
            text.get(start..end).is_some(),
            "{diagnostic:?} lies outside {text:?}"
        );
    }
    let drawn = render(&diagnostics, &sources, Style::default());
    assert_eq!(drawn.is_empty(), diagnostics.is_empty());
    assert_eq!(
        render_json(&diagnostics, &sources).lines().count(),
        diagnostics.len()
    );
}

/// Words, signs and literals of the language and of its neighbours.
const TOKENS: &str = "application import scan evolution input output retain var parameter const graph always initial \
    step macro entry exit transition template plant property test at in encloses when do on AND OR XOR NOT MOD IF TRUE \
    FALSE RE FE System X25 XM5 T F S I stable bool int time activation deactivation event never reachable recoverable \
    after within expect set clear release pulse for wait until scans power cycle with a b Drill 0 1 07 42 16#FF 2#12 \
    1_000 30ms 2s 0.5s 1min30s T#1m30s 2 s \"text\" \" %IX0.0 %QW3 E5 ( ) { } , ; : := = <> ≠ < <= ≤ > >= ≥ + - * / & · \
    | ! ¬ ↑ ↓ -> => == && || .. . // (* *) /* # @ _ é e\u{301} → {I} {*} {1,3} S(G) F/G: T/X3/ \u{1F600}";

fn soup() -> impl Strategy<Value = String> {
    let tokens: Vec<&'static str> = TOKENS
        .split(' ')
        .filter(|token| !token.is_empty())
        .collect();
    let separators = prop::sample::select(vec![" ", " ", " ", "\n", "", "\t", "\r\n"]);
    prop::collection::vec((prop::sample::select(tokens), separators), 0..60).prop_map(|parts| {
        parts
            .into_iter()
            .flat_map(|(token, separator)| [token, separator])
            .collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn arbitrary_text_is_answered(text in any::<String>()) {
        survives(&text);
    }

    #[test]
    fn arbitrary_tokens_are_answered(text in soup()) {
        survives(&text);
    }

    #[test]
    fn arbitrary_tokens_in_an_action_a_trigger_and_a_test_are_answered(text in soup()) {
        survives(&format!("graph G {{ step 1 {{ {text} }} }}"));
        survives(&format!("graph G {{ transition 1: 1 -> 2 when {text} }}"));
        survives(&format!("test \"t\" {{ {text} }}"));
    }

    #[test]
    fn a_program_with_a_piece_cut_out_is_answered(from in 0_usize..1500, length in 0_usize..200) {
        let text = include_str!("drill_press.grafcet");
        let from = text.floor_char_boundary(from);
        let to = text.ceil_char_boundary((from + length).min(text.len()));
        survives(&format!("{}{}", &text[..from], &text[to..]));
    }
}
