//! What was meant by a misspelt word.

/// The candidate that is nearest to the word, if one is near enough to be what was meant.
pub(crate) fn nearest<'c>(
    word: &str,
    candidates: impl Iterator<Item = &'c str>,
) -> Option<&'c str> {
    let word = word.to_lowercase();
    let distance = |candidate: &str| strsim::osa_distance(&word, &candidate.to_lowercase());
    let furthest = (word.chars().count() / 3).max(1);
    candidates
        .map(|candidate| (distance(candidate), candidate))
        .filter(|(distance, _)| *distance <= furthest)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn a_slip_of_the_finger_is_recognised() {
        let words = || ["pin", "pull", "active", "filter"].into_iter();
        assert_eq!(nearest("pul", words()), Some("pull"));
        assert_eq!(nearest("acitve", words()), Some("active"));
        assert_eq!(nearest("Filter", words()), Some("filter"));
    }

    #[test]
    fn another_word_is_not() {
        assert_eq!(nearest("debounce", ["pin", "filter"].into_iter()), None);
    }
}
