//! What is asked of a setup.

use crate::SolveError;
use std::borrow::Cow;

/// What is asked of a setup.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SetupQuestion {
    /// The smallest factor on all torques at which a pulley may slip grossly, in every load case; at least 1.
    pub slip_margin: f64,
    /// By which share of its unstretched length the belt grows in service; at least 0, below 1.
    pub elongation: f64,
    /// Index of the pulley whose centre is moved to tension the belt; without one, the driver where there are
    /// two pulleys.
    pub moved: Option<usize>,
}

/// Whether what is asked is in range.
pub(super) fn in_range(question: SetupQuestion) -> Result<(), SolveError> {
    let wrong = |subject: &str, problem: &'static str| {
        Err(SolveError::Statement {
            subject: subject.to_owned(),
            problem: Cow::Borrowed(problem),
        })
    };
    match question {
        SetupQuestion { slip_margin, .. } if !(slip_margin >= 1.0 && slip_margin.is_finite()) => {
            wrong("slip margin", "must be at least 1")
        }
        SetupQuestion { elongation, .. } if !(0.0..1.0).contains(&elongation) => {
            wrong("elongation", "must be at least 0 and below 1")
        }
        _ => Ok(()),
    }
}
