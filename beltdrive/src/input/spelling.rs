//! The nearest right spelling of a misspelled word.

/// The item whose spelling is nearest to `word`, if any is near enough to be what was meant: at
/// most one typing slip (a letter too many, missing, wrong or swapped with its neighbour) per three
/// letters of the longer. Case counts only between spellings that are otherwise equally near.
pub(crate) fn nearest<S: AsRef<str>, T>(
    word: &str,
    candidates: impl IntoIterator<Item = (S, T)>,
) -> Option<T> {
    let lowercase = word.to_lowercase();
    let length = word.chars().count();
    candidates
        .into_iter()
        .filter_map(|(spelling, item)| {
            let spelling = spelling.as_ref();
            let distance = strsim::osa_distance(&lowercase, &spelling.to_lowercase());
            let slips = spelling.chars().count().max(length) / 3;
            let near = distance <= slips;
            near.then(|| ((distance, strsim::osa_distance(word, spelling)), item))
        })
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, item)| item)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn finds_slips_and_case_but_nothing_far() {
        let units = ["N", "kN", "MPa", "mPa", "rpm"].map(|unit| (unit, unit));
        assert_eq!(nearest("kn", units), Some("kN"));
        assert_eq!(nearest("Mpa", units), Some("MPa"));
        assert_eq!(nearest("rmp", units), Some("rpm"));
        assert_eq!(nearest("furlong", units), None);
        assert_eq!(nearest("", units), None);
    }
}
