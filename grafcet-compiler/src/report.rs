//! Where the lexer and the parser of one file put what they find wrong.

use crate::diagnostic::{Diagnostic, Rule};

/// After so many syntax errors in one file the rest of it is not looked at; a last diagnostic says so.
pub const MAX_SYNTAX_ERRORS: usize = 500;

/// Collects the diagnostics of one file up to [`MAX_SYNTAX_ERRORS`].
pub(crate) struct Report<'a> {
    diagnostics: &'a mut Vec<Diagnostic>,
    room: usize,
}

impl<'a> Report<'a> {
    /// An empty report for one file.
    pub(crate) fn new(diagnostics: &'a mut Vec<Diagnostic>) -> Self {
        Report {
            diagnostics,
            room: MAX_SYNTAX_ERRORS,
        }
    }

    /// No more diagnostics are taken.
    pub(crate) fn is_full(&self) -> bool {
        self.room == 0
    }

    /// Takes a diagnostic; the last one that fits is followed by the remark that there may be more.
    pub(crate) fn push(&mut self, diagnostic: Diagnostic) {
        if self.room == 0 {
            return;
        }
        self.room -= 1;
        let span = diagnostic.span;
        self.diagnostics.push(diagnostic);
        if self.room == 0 {
            self.diagnostics.push(Diagnostic::new(
                Rule::Syntax,
                span,
                format!("more than {MAX_SYNTAX_ERRORS} errors in one file; what follows is not looked at"),
            ));
        }
    }
}
