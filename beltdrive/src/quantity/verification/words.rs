//! What a verification comes to, in words.

use crate::verify::{Comparison, Criterion, Verdict, Verification};

/// The program that computed the numbers.
pub(crate) const PROGRAM: &str = concat!("beltdrive ", env!("CARGO_PKG_VERSION"));

/// How many numbers have which verdict.
pub(crate) fn summary(verification: &Verification) -> String {
    let counts =
        Verdict::ALL.map(|verdict| format!("{} {}", verification.count(verdict), of(verdict)));
    counts.join(", ")
}

/// A verdict in a count.
fn of(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Agrees => "agree to the printed digits",
        Verdict::Within => "within a stated band",
        Verdict::Known => "known why",
        Verdict::Differs => "unexplained",
    }
}

/// A verdict in one word of JSON and CSV.
pub(crate) fn verdict(comparison: &Comparison) -> &'static str {
    match comparison.verdict() {
        Verdict::Agrees => "agrees",
        Verdict::Within => "within band",
        Verdict::Known => "known",
        Verdict::Differs => "differs",
    }
}

/// What a difference is measured by, in one word of JSON and CSV.
pub(crate) fn criterion(comparison: &Comparison) -> &'static str {
    match comparison.criterion {
        Criterion::Digits => "digits",
        Criterion::Band { .. } => "band",
        Criterion::Known { .. } => "known difference",
    }
}
