//! Failed tests as people read them: the place in the compiler's diagnostic style, the values, the last scans.

use grafcet_compiler::diagnostic::{Diagnostic, Level, NamedRule};

use crate::testing::{Claimed, Failure};

impl NamedRule for Claimed {
    fn name(self) -> &'static str {
        match self {
            Claimed::Expect => "expect",
            Claimed::Never => "never",
            Claimed::Always => "always",
            Claimed::WaitUntil { .. } => "wait-until",
        }
    }

    fn level(self) -> Level {
        Level::Error
    }
}

impl Failure {
    /// The failure at its place in the source.
    #[must_use]
    pub fn diagnostic(&self) -> Diagnostic<Claimed> {
        let at = format!("at {} ms", self.time_ms);
        let message = match self.claimed {
            Claimed::Expect => format!("this does not hold {at}"),
            Claimed::Never => format!("this holds {at}, and never should"),
            Claimed::Always => format!("this does not hold {at}, and always should"),
            Claimed::WaitUntil { within_ms } => {
                format!("this did not come within {within_ms} ms")
            }
        };
        let diagnostic = Diagnostic::new(self.claimed, self.span, message);
        if self.during == self.span {
            diagnostic
        } else {
            diagnostic.label(self.during, "during this step")
        }
    }

    /// What the diagnostic does not show: the values of the names in the claim, and the last scans.
    #[must_use]
    pub fn details(&self) -> String {
        let mut text = String::new();
        if !self.values.is_empty() {
            let values = self.values.iter();
            let values: Vec<String> = values
                .map(|(name, value)| format!("{name} = {value}"))
                .collect();
            text = format!("at {} ms: {}\n", self.time_ms, values.join(", "));
        }
        format!("{text}the last scans:\n{}", self.last_scans)
    }
}
