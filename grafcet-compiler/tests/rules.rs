//! Each static rule of `language.md`, by small programs that break it and neighbours that do not.
//!
//! A file `rules/RULE.txt` holds programs, each behind a line `== what it shows`. One whose title begins with `fine:`
//! must not raise the rule, every other one must. What a user sees of each is a snapshot.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use grafcet_compiler::diagnostic::Rule;
use grafcet_compiler::render::{Style, render};
use grafcet_compiler::{Compilation, Target, compile};

fn directory() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/rules")
}

/// The programs of a file with their titles.
fn programs(text: &str) -> Vec<(&str, &str)> {
    text.split("\n== ")
        .map(|part| part.strip_prefix("== ").unwrap_or(part))
        .filter_map(|part| part.split_once('\n'))
        .collect()
}

fn compiled(rule: Rule, program: &str) -> Compilation {
    let target = if rule == Rule::NoAddress {
        Target::Firmware
    } else {
        Target::Host
    };
    let load = |path: &str| fs::read_to_string(directory().join("libraries").join(path));
    compile("program.grafcet", program, &load, target)
}

fn check(rule: Rule) {
    let path = directory().join(format!("{}.txt", rule.name()));
    let text =
        fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut seen = String::new();
    let mut breaking = 0;
    for (title, program) in programs(&text) {
        let compilation = compiled(rule, program);
        let raised = compilation.diagnostics.iter().any(|it| it.rule == rule);
        let fine = title.starts_with("fine:");
        assert_eq!(
            raised,
            !fine,
            "{}: {title}: {:#?}",
            rule.name(),
            compilation.diagnostics
        );
        assert_eq!(
            compilation.application.is_none(),
            compilation.has_errors(),
            "{title}"
        );
        breaking += usize::from(!fine);
        seen += &format!("== {title}\n");
        seen += &render(
            &compilation.diagnostics,
            &compilation.sources,
            Style::default(),
        );
    }
    assert!(breaking >= 3, "{} is broken several times", rule.name());
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(directory().join("snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(rule.name(), seen.trim_end()));
}

macro_rules! rules {
    ($($test:ident: $rule:ident,)*) => {
        $(#[test]
        fn $test() {
            check(Rule::$rule);
        })*

        #[test]
        fn every_rule_is_held_by_programs() {
            let held: BTreeSet<Rule> = [$(Rule::$rule,)*].into_iter().chain(Rule::DECIDED.iter().copied()).collect();
            let all: BTreeSet<Rule> = Rule::ALL.iter().copied().collect();
            assert_eq!(held, all);
        }
    };
}

rules! {
    syntax: Syntax,
    unknown_name: UnknownName,
    unknown_graph: UnknownGraph,
    unknown_step: UnknownStep,
    duplicate_name: DuplicateName,
    duplicate_step: DuplicateStep,
    duplicate_transition: DuplicateTransition,
    reserved_word: ReservedWord,
    type_mismatch: TypeMismatch,
    bad_literal: BadLiteral,
    write_to_input: WriteToInput,
    write_to_step_bit: WriteToStepBit,
    write_to_constant: WriteToConstant,
    momentary_and_stored: MomentaryAndStored,
    momentary_number: MomentaryNumber,
    causality_loop: CausalityLoop,
    forcing_cycle: ForcingCycle,
    self_forcing: SelfForcing,
    hierarchy_conflict: HierarchyConflict,
    bad_address: BadAddress,
    address_direction: AddressDirection,
    duplicate_address: DuplicateAddress,
    out_of_range: OutOfRange,
    macro_shape: MacroShape,
    momentary_initial: MomentaryInitial,
    no_address: NoAddress,
    template_binding: TemplateBinding,
    level_1_only: Level1Only,
    unreachable_step: UnreachableStep,
    never_fires: NeverFires,
    always_fires: AlwaysFires,
    event_without_edge: EventWithoutEdge,
    unused: Unused,
    never_written: NeverWritten,
    never_read: NeverRead,
    case_only: CaseOnly,
    never_cleared: NeverCleared,
    short_preset: ShortPreset,
}
