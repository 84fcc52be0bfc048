//! A way that leads to no state, and the pulley on which it went astray.

use crate::vbelt::BeltProblem;
use crate::vbelt::path::Stuck;
use bvp::{Error, Unknown};

/// A way that leads to no state. If it can be told, it went astray on one pulley: there Newton's method failed, or
/// friction does not obey its law.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Astray {
    pub(super) pulley: Option<usize>,
}

impl Astray {
    /// Where a problem was not solved for this reason.
    pub(super) fn of<P: BeltProblem>(problem: &P, cause: &Error) -> Self {
        let segment = match cause {
            Error::NoConvergence {
                largest: Some(Unknown::State { segment, .. }),
                ..
            }
            | Error::SingularConditions {
                free: Some(Unknown::State { segment, .. }),
                ..
            }
            | Error::SingularNode { segment, .. }
            | Error::MeshLimit { segment, .. }
            | Error::Unresolved { segment, .. } => Some(*segment),
            Error::NoConvergence {
                largest: Some(Unknown::Parameter { index }),
                ..
            } => index
                .checked_sub(problem.first_length())
                .filter(|&segment| segment < problem.zoning().count()),
            _ => None,
        };
        Self {
            pulley: segment.map(|segment| problem.pulley(segment)),
        }
    }
}

impl<P: BeltProblem> Stuck<P> {
    /// Where the way was lost behind the last problem that was solved.
    pub(super) fn astray(&self) -> Astray {
        let last = self.last.as_ref();
        last.map_or(Astray::default(), |last| {
            Astray::of(&last.problem, &self.cause)
        })
    }
}
