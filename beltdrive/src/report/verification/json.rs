//! A verification as JSON: complete, at full precision.

use super::words;
use crate::report::json::pretty;
use crate::verify::{Comparison, Criterion, Section, Source, Verdict, Verification};
use serde::Serialize;

/// The whole verification as pretty-printed JSON. What there is not is `null`.
pub fn json(verification: &Verification) -> String {
    pretty(&Report {
        program: words::PROGRAM,
        agree: verification.count(Verdict::Agrees),
        within_band: verification.count(Verdict::Within),
        known: verification.count(Verdict::Known),
        unexplained: verification.count(Verdict::Differs),
        sources: verification
            .sources
            .iter()
            .map(SourceReport::from)
            .collect(),
    })
}

#[derive(Serialize)]
struct Report {
    program: &'static str,
    agree: usize,
    within_band: usize,
    known: usize,
    unexplained: usize,
    sources: Vec<SourceReport>,
}

#[derive(Serialize)]
struct SourceReport {
    title: &'static str,
    citation: &'static str,
    method: &'static str,
    sections: Vec<SectionReport>,
}

impl From<&Source> for SourceReport {
    fn from(source: &Source) -> Self {
        Self {
            title: source.title,
            citation: source.citation,
            method: source.method,
            sections: source.sections.iter().map(SectionReport::from).collect(),
        }
    }
}

#[derive(Serialize)]
struct SectionReport {
    title: &'static str,
    comparisons: Vec<ComparisonReport>,
}

impl From<&Section> for SectionReport {
    fn from(section: &Section) -> Self {
        let comparisons = section.comparisons.iter();
        Self {
            title: section.title,
            comparisons: comparisons.map(ComparisonReport::from).collect(),
        }
    }
}

#[derive(Serialize)]
struct ComparisonReport {
    quantity: &'static str,
    unit: &'static str,
    /// The published text, which says how many digits are known.
    published: &'static str,
    published_value: f64,
    half_unit: f64,
    computed: Option<f64>,
    deviation: Option<f64>,
    relative_deviation: Option<f64>,
    verdict: &'static str,
    criterion: &'static str,
    band: Option<f64>,
    expected: Option<f64>,
    expected_tolerance: Option<f64>,
    note: Option<String>,
}

impl From<&Comparison> for ComparisonReport {
    fn from(comparison: &Comparison) -> Self {
        let [band, expected, expected_tolerance] = match comparison.criterion {
            Criterion::Digits => [None; 3],
            Criterion::Band { width } => [Some(width), None, None],
            Criterion::Known {
                expected,
                tolerance,
                ..
            } => [None, Some(expected), Some(tolerance)],
        };
        let published = comparison.published;
        Self {
            quantity: comparison.quantity,
            unit: comparison.unit,
            published: published.text(),
            published_value: published.value(),
            half_unit: published.half_unit(),
            computed: comparison.computed.as_ref().ok().copied(),
            deviation: comparison.deviation(),
            relative_deviation: comparison.relative_deviation(),
            verdict: words::verdict(comparison),
            criterion: words::criterion(comparison),
            band,
            expected,
            expected_tolerance,
            note: comparison.note(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::verification::sample;
    use serde_json::Value;

    #[test]
    fn is_complete() {
        let text = json(&sample::mixed());
        let report: Value = serde_json::from_str(&text).unwrap();
        let counts = ["agree", "within_band", "known", "unexplained"];
        assert_eq!(
            counts.map(|count| report[count].as_u64().unwrap()),
            [2, 1, 1, 2]
        );
        let rows = &report["sources"][0]["sections"][0]["comparisons"];
        assert_eq!(
            (&rows[0]["published"], &rows[0]["half_unit"]),
            (&"2.34".into(), &0.005.into())
        );
        assert_eq!(
            [&rows[2]["verdict"], &rows[2]["note"]],
            ["known", "read off a plot"]
        );
        assert_eq!(
            [&rows[2]["expected"], &rows[2]["expected_tolerance"]],
            [373.205, 0.001]
        );
        let missing = &report["sources"][1]["sections"][0]["comparisons"][1];
        assert!(missing["computed"].is_null() && missing["deviation"].is_null());
    }
}
