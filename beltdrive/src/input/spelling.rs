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

/// The dotted path nearest to `path`: of as many names, each of which is near enough to its counterpart to be
/// what was meant.
pub(crate) fn nearest_path<'c>(
    path: &str,
    candidates: impl IntoIterator<Item = &'c str>,
) -> Option<&'c str> {
    let names: Vec<_> = path.split('.').collect();
    let is_near = |candidate: &&str| {
        let others: Vec<_> = candidate.split('.').collect();
        let mut pairs = names.iter().zip(&others);
        others.len() == names.len() && pairs.all(|(a, b)| nearest(a, [(b, ())]).is_some())
    };
    let near = candidates.into_iter().filter(is_near);
    nearest(path, near.map(|candidate| (candidate, candidate)))
}

/// The key of a drive file nearest to `path`: by all of its names, by its letters alone, or else by the last name.
pub(crate) fn nearest_key<'c, C>(path: &str, candidates: impl Fn() -> C) -> Option<&'c str>
where
    C: Iterator<Item = &'c str>,
{
    let by_name = || {
        let names = candidates().map(|path| (path.rsplit('.').next().unwrap_or(path), path));
        nearest(path, names)
    };
    let letters = |path: &str| path.replace(['.', '_', '-', ' '], "").to_lowercase();
    let by_letters = || candidates().find(|candidate| letters(candidate) == letters(path));
    nearest_path(path, candidates())
        .or_else(by_letters)
        .or_else(by_name)
}

/// The line of a message that proposes a spelling, after those before it; empty without one.
pub(crate) fn hint(nearest: Option<&str>) -> String {
    nearest.map_or_else(String::new, |name| {
        format!("\nhelp: did you mean `{name}`?")
    })
}

#[cfg(test)]
mod tests {
    use super::{nearest, nearest_key, nearest_path};

    #[test]
    fn points_and_underscores_may_be_mixed_up() {
        let keys = || ["friction.stiffness", "friction.bristle_stiffness"].into_iter();
        let meant = Some("friction.bristle_stiffness");
        for written in ["friction.bristle.stiffness", "friction_bristle-stiffness"] {
            assert_eq!(nearest_key(written, keys), meant, "{written}");
        }
    }

    #[test]
    fn every_name_of_a_path_is_near() {
        let paths = [
            "friction.law",
            "pulleys.driver.speed",
            "pulleys.driven.radius",
        ];
        assert_eq!(nearest_path("frction.lwa", paths), Some("friction.law"));
        assert_eq!(
            nearest_path("pulley.driven.radius", paths),
            Some("pulleys.driven.radius")
        );
        assert_eq!(nearest_path("friction.mu", paths), None);
        assert_eq!(nearest_path("pulleys.driver.diameter", paths), None);
    }

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
