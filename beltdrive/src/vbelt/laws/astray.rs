//! A way that leads to no state, and the pulley on which it went astray.

use crate::vbelt::BeltProblem;
use bvp::{Error, Unknown};

/// A way that leads to no state. If it can be told, it went astray on one pulley: there Newton's method failed, or
/// friction does not obey its law.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::vbelt) struct Astray {
    pub(super) pulley: Option<usize>,
}

impl Astray {
    /// Where a problem was not solved for this reason.
    pub(in crate::vbelt) fn of<P: BeltProblem>(problem: &P, cause: &Error) -> Self {
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

#[cfg(test)]
mod tests {
    use crate::vbelt::laws::{Asked, AtLoad};
    use crate::vbelt::path::{Effort, Path, Stuck};
    use crate::vbelt::scaling::tests::kim;
    use crate::vbelt::{BeltProblem, DRIVEN, DRIVER, Regime};
    use crate::{Drive, FrictionLaw};
    use bvp::Error;

    #[test]
    fn the_pulley_is_that_of_the_problem_that_failed() {
        let drive = Drive::from(kim(FrictionLaw::Coulomb, 0.25));
        let mut path = Path::new(&drive, 1e-6);
        let asked = AtLoad {
            drive: &drive,
            tight: path.target(),
        };
        let solved = path.cold(&asked, asked.softest(), Effort::Start).unwrap();
        assert_eq!(solved.problem.zoning().count(), 2);
        let zones = [vec![Regime::Slip; 3], vec![Regime::Slip]];
        let other = solved.problem.clone().with_zones(&zones);
        for (segment, pulley) in [(1, DRIVEN), (2, DRIVEN), (3, DRIVER)] {
            let best = Box::new(solved.solution.clone());
            let cause = Error::SingularNode {
                segment,
                node: 1,
                s: 0.5,
                best,
            };
            let stuck = Stuck::before(&other, solved.clone(), cause);
            assert_eq!(stuck.astray.pulley, Some(pulley));
        }
    }
}
