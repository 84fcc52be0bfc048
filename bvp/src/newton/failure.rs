//! Why Newton's method fails.

use crate::discretisation::iterate::NonFinite;
use crate::newton::collocation::LinearisationError;
use crate::newton_matrix::dependence::Dependence;
use crate::newton_matrix::singular::Singular;
use crate::problem::unknown::Unknown;

/// Why the iteration stopped short.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Failure {
    NonFinite(NonFinite),
    /// The states of this node are not determined by their neighbours.
    Node {
        segment: usize,
        node: usize,
    },
    /// The conditions do not determine the ends and the parameters.
    Ends(Dependence),
    /// Steps or damping exhausted; the size of the last correction and where it is largest.
    NoConvergence {
        correction: f64,
        largest: Option<Unknown>,
    },
}

impl From<LinearisationError> for Failure {
    fn from(error: LinearisationError) -> Self {
        match error {
            LinearisationError::NonFinite(what) => Self::NonFinite(what),
            LinearisationError::Singular(Singular::Node { segment, node }) => {
                Self::Node { segment, node }
            }
            LinearisationError::Singular(Singular::Ends) => Self::Ends(Dependence::default()),
        }
    }
}
