//! Samples of ranges, as the command line states them.

use crate::cli::failure::Failure;
use beltdrive::{LatinHypercube, Sobol, SweepRow};
use std::ops::Range;

/// The most rows.
const MOST: usize = 1_000_000_000_000;

/// A sample of ranges.
pub(super) enum Sample {
    LatinHypercube(LatinHypercube),
    Sobol(Sobol),
}

impl Sample {
    /// The sample of ranges that an option states.
    pub(super) fn new(text: &str, ranges: Vec<[f64; 2]>, seed: u64) -> Result<Self, Failure> {
        let fault = |problem: &str| {
            Failure::Usage(format!(
                "error: --sample {text}: {problem}; expected lhs:N or sobol:N, such as lhs:1000"
            ))
        };
        let (method, count) = text
            .split_once(':')
            .ok_or_else(|| fault("there is no `:`"))?;
        let rows = || {
            let count = count.trim().parse().ok();
            let count = count.filter(|count| (1..=MOST).contains(count));
            count.ok_or_else(|| fault(&format!("N is not a whole number from 1 to {MOST}")))
        };
        match method.trim() {
            "lhs" => Ok(Self::LatinHypercube(LatinHypercube::new(
                ranges,
                rows()?,
                seed,
            ))),
            "sobol" if ranges.len() > Sobol::MOST_NUMBERS => Err(Failure::Usage(format!(
                "error: --sample {text}: {} numbers vary, and the Sobol' sequence has direction numbers for {}\n\
                 help: lhs:N draws a Latin hypercube of any number of them",
                ranges.len(),
                Sobol::MOST_NUMBERS
            ))),
            "sobol" => Ok(Self::Sobol(Sobol::new(ranges, rows()?, seed))),
            method => Err(fault(&format!("there is no sample `{method}`"))),
        }
    }

    /// The number of rows.
    pub(super) fn count(&self) -> usize {
        match self {
            Self::LatinHypercube(sample) => sample.count(),
            Self::Sobol(sample) => sample.count(),
        }
    }

    /// The rows of a range.
    pub(super) fn take(&self, range: Range<usize>) -> Vec<SweepRow> {
        let count = range.len();
        match self {
            Self::LatinHypercube(sample) => sample.rows(range.start).take(count).collect(),
            Self::Sobol(sample) => sample.rows(range.start).take(count).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_numbers_than_the_sequence_has_are_one_error() {
        let ranges = |count| vec![[0.0, 1.0]; count];
        assert!(Sample::new("sobol:8", ranges(Sobol::MOST_NUMBERS), 1).is_ok());
        let refused = Sample::new("sobol:8", ranges(Sobol::MOST_NUMBERS + 1), 1);
        let Some(Failure::Usage(message)) = refused.err() else {
            panic!("it is refused");
        };
        assert!(message.contains("54 numbers vary"), "{message}");
        assert!(Sample::new("lhs:8", ranges(Sobol::MOST_NUMBERS + 1), 1).is_ok());
    }
}
