//! Pictures of what users see: every file in `wrong/` with its diagnostics in `snapshots/`.

use grafcet_compiler::parser::parse;
use grafcet_compiler::render::{Style, render};
use grafcet_compiler::source::Sources;

#[test]
fn what_users_see_of_wrong_programs() {
    insta::glob!("wrong/*.grafcet", |path| {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap();
        let text = std::fs::read_to_string(path).unwrap();
        let mut sources = Sources::default();
        let file = sources.add(name, text.as_str());
        let mut diagnostics = Vec::new();
        parse(file, &text, &mut diagnostics);
        insta::with_settings!({ prepend_module_to_snapshot => false, omit_expression => true }, {
            insta::assert_snapshot!(render(&diagnostics, &sources, Style::default()));
        });
    });
}
