//! A verification as comma-separated values.

use super::words;
use crate::report::rows;
use crate::verify::Verification;

const HEADER: [&str; 11] = [
    "source",
    "section",
    "quantity",
    "unit",
    "published",
    "computed",
    "deviation",
    "relative_deviation",
    "criterion",
    "verdict",
    "note",
];

/// One row per published number, at full precision; the published ones as they are printed.
pub fn csv(verification: &Verification) -> String {
    let sections = verification.sources.iter().flat_map(|source| {
        let sections = source.sections.iter();
        sections.map(move |section| (source.title, section))
    });
    let rows = sections.flat_map(|(source, section)| {
        section.comparisons.iter().map(move |comparison| {
            vec![
                source.to_owned(),
                section.title.to_owned(),
                comparison.quantity.to_owned(),
                comparison.unit.to_owned(),
                comparison.published.text().to_owned(),
                rows::optional(comparison.computed.as_ref().ok().copied()),
                rows::optional(comparison.deviation()),
                rows::optional(comparison.relative_deviation()),
                words::criterion(comparison).to_owned(),
                words::verdict(comparison).to_owned(),
                comparison.note().unwrap_or_default(),
            ]
        })
    });
    rows::csv(HEADER.map(str::to_owned).to_vec(), rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::verification::sample;

    #[test]
    fn has_a_row_for_each_number() {
        let text = csv(&sample::mixed());
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines.len(), 7);
        assert!(lines[1].starts_with("Author (2001),\"Table 1, a\",transition,rad,2.34,2.3435,"));
        assert!(
            lines[3].ends_with("known difference,known,read off a plot"),
            "{text}"
        );
        assert!(
            lines[6].ends_with(",,,,digits,differs,not computed: no steady state"),
            "{text}"
        );
    }
}
