//! Advice for a name that is not known: the nearest of those that are.

use super::resolver::Resolver;

/// So many names are listed when none is near.
const MOST_LISTED: usize = 12;

/// What comparing names may cost in one compilation, counted in pairs of characters. When it is used up, no more
/// names are suggested: a file of nothing but unknown names must not take long.
const BUDGET: usize = 60_000_000;

/// What each name costs beside its characters.
const EACH: usize = 64;

/// What is left of it.
pub(super) struct Suggestions {
    left: usize,
}

impl Default for Suggestions {
    fn default() -> Self {
        Suggestions { left: BUDGET }
    }
}

impl Resolver<'_> {
    /// Advice to take the nearest of the known names, written with a prefix.
    pub(super) fn suggest(
        &mut self,
        name: &str,
        prefix: &str,
        known: impl for<'s> FnOnce(&'s Self) -> Vec<&'s str>,
    ) -> Option<String> {
        let near = |known: &[&str], suggestions: &mut Suggestions| {
            let near = suggestions.nearest(name, known)?;
            Some(format!("did you mean `{prefix}{near}`?"))
        };
        self.look(known, near)
    }

    /// The same, or all that is known when none is near and there are few.
    pub(super) fn suggest_or_list(
        &mut self,
        name: &str,
        prefix: &str,
        known: impl for<'s> FnOnce(&'s Self) -> Vec<&'s str>,
    ) -> Option<String> {
        self.look(known, |known, suggestions| {
            if let Some(near) = suggestions.nearest(name, known) {
                return Some(format!("did you mean `{prefix}{near}`?"));
            }
            if known.len() > MOST_LISTED {
                return None;
            }
            let mut known = known.to_vec();
            known.sort_by_key(|it| (it.len(), *it));
            match known.as_slice() {
                [only] => Some(format!("there is only `{prefix}{only}`")),
                [first @ .., last] => {
                    let first = first.join(&format!("`, `{prefix}"));
                    Some(format!("there are `{prefix}{first}` and `{prefix}{last}`"))
                }
                [] => None,
            }
        })
    }

    /// Looks for advice among the known names, as long as that does not take too long.
    fn look(
        &mut self,
        known: impl for<'s> FnOnce(&'s Self) -> Vec<&'s str>,
        advice: impl FnOnce(&[&str], &mut Suggestions) -> Option<String>,
    ) -> Option<String> {
        if self.suggestions.left == 0 {
            return None;
        }
        let mut suggestions = std::mem::take(&mut self.suggestions);
        let advice = advice(&known(self), &mut suggestions);
        self.suggestions = suggestions;
        advice
    }
}

impl Suggestions {
    /// The known name nearest to one that is not known, if one is near at all.
    fn nearest<'n>(&mut self, name: &str, known: &[&'n str]) -> Option<&'n str> {
        let length = name.chars().count();
        let far = length.div_ceil(3).min(length.saturating_sub(1));
        let lower = name.to_lowercase();
        let mut found: Option<(usize, &str)> = None;
        for candidate in known {
            let other = candidate.chars().count();
            // Every character more or less is one step away.
            let comparable = length.abs_diff(other) <= far;
            let cost = if comparable { length * other } else { 0 };
            self.left = self.left.saturating_sub(cost + other + EACH);
            if self.left == 0 {
                return None;
            }
            let distance = if candidate.to_lowercase() == lower {
                0
            } else if comparable {
                strsim::osa_distance(name, candidate)
            } else {
                continue;
            };
            if distance <= far {
                let near = (distance, *candidate);
                found = Some(found.map_or(near, |nearest| nearest.min(near)));
            }
        }
        found.map(|(_, name)| name)
    }
}

/// The nearest of a few names.
pub(super) fn nearest<'n>(name: &str, known: &[&'n str]) -> Option<&'n str> {
    Suggestions::default().nearest(name, known)
}
