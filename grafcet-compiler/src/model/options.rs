//! The scan period and the evolution.

use super::Type;
use super::names::View;
use super::resolver::Resolver;
use crate::ast;
use crate::diagnostic::{Diagnostic, Rule};
use crate::source::Span;

impl Resolver<'_> {
    /// Takes the options: the scan period and the evolution.
    pub(super) fn take_options(&mut self, options: &[ast::ScanOption]) {
        let (mut period, mut evolution) = (None, None);
        for option in options {
            match option {
                ast::ScanOption::Period(constant) => {
                    if let Some(ms) = self.constant(constant, Type::Time, View::Application) {
                        self.take_period(ms, constant.span);
                    }
                    self.refuse_second("scan", constant.span, &mut period);
                }
                ast::ScanOption::Evolution { stable, span } => {
                    self.model.stable = *stable;
                    self.refuse_second("evolution", *span, &mut evolution);
                }
            }
        }
    }

    fn refuse_second(&mut self, word: &str, span: Span, first: &mut Option<Span>) {
        let first = *first.get_or_insert(span);
        if first != span {
            let diagnostic =
                Diagnostic::new(Rule::Syntax, span, format!("`{word}` is given twice"))
                    .label(first, "given here first")
                    .help("remove one of the two");
            self.report(diagnostic);
        }
    }

    fn take_period(&mut self, ms: i32, span: Span) {
        match u32::try_from(ms) {
            Ok(ms) if ms > 0 => self.model.period_ms = ms,
            _ => self.report(Diagnostic::new(
                Rule::OutOfRange,
                span,
                "a scan period is at least 1 ms",
            )),
        }
    }
}
