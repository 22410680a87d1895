//! Whether two texts say the same in different layouts.

use std::hash::{Hash, Hasher};

use crate::ast::File;
use crate::lexer::Lexed;

/// Everything that a tree says, places apart: they do not count in a hash.
pub(super) fn said(tree: &File) -> Vec<u8> {
    let mut said = Said(Vec::new());
    tree.hash(&mut said);
    said.0
}

/// The comments of a text without their white space.
pub(super) fn comments<'t>(text: &'t str, lexed: &'t Lexed) -> impl Iterator<Item = String> + 't {
    lexed.comments.iter().map(|comment| {
        let text = text.get(comment.start as usize..comment.end as usize);
        text.unwrap_or("").split_whitespace().collect()
    })
}

/// Keeps what is hashed instead of its hash.
struct Said(Vec<u8>);

impl Hasher for Said {
    fn write(&mut self, bytes: &[u8]) {
        self.0.extend_from_slice(bytes);
    }

    fn finish(&self) -> u64 {
        self.0.len() as u64
    }
}

#[cfg(test)]
mod tests {
    use super::said;
    use crate::parser::parse;
    use crate::source::FileId;

    fn tree(text: &str) -> Vec<u8> {
        said(&parse(FileId(0), text, &mut Vec::new()))
    }

    #[test]
    fn another_layout_says_the_same() {
        assert_eq!(
            tree("var a; graph G { step 1 { A; B } }"),
            tree("var  a\n\ngraph G {\n  step 1 {\n A\nB }\n}\n"),
        );
    }

    #[test]
    fn other_words_in_another_order_or_number_say_something_else() {
        let trees = [
            "graph G { step 1 { A; B } }",
            "graph G { step 1 { B; A } }",
            "graph G { step 1 { A, B } }",
            "graph G { step 1 { A } }",
            "graph G { step 2 { A; B } }",
            "graph G { step 1 { A = B } }",
            "graph G { step 1 { A = 1 } }",
            "graph G { step 1 { A = 2 } }",
            "graph G { step 1 { A = 2s } }",
            "graph G \"\" { step 1 { A; B } }",
        ]
        .map(tree);
        for (index, one) in trees.iter().enumerate() {
            for other in &trees[..index] {
                assert_ne!(one, other, "{index}");
            }
        }
    }
}
