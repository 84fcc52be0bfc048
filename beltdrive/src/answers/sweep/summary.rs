//! How many rows of a sweep have an answer, and why others have none.

use super::Swept;
use crate::answers::members::{Refusal, Refusals};

/// How many rows have an answer, and why others have none.
#[derive(Clone, Debug, Default)]
pub struct SweepSummary {
    /// The number of rows.
    pub rows: usize,
    /// The number of rows whose answers stood before, which are not among them.
    pub standing: usize,
    /// Why there is no answer, by reason.
    pub refusals: Refusals,
}

impl SweepSummary {
    /// Counts a row.
    pub fn add(&mut self, answer: &Result<Swept, Refusal>) {
        self.rows += 1;
        if let Err(refusal) = answer {
            self.refusals.add(refusal);
        }
    }

    /// Counts the rows of another summary behind those of this one.
    pub fn join(&mut self, other: Self) {
        self.rows += other.rows;
        self.standing += other.standing;
        self.refusals.join(other.refusals);
    }

    /// The number of rows with an answer.
    #[must_use]
    pub fn answered(&self) -> usize {
        self.rows - self.refusals.count()
    }
}
