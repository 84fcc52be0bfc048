//! A V-belt drive in, a steady state or the reason why there is none out.

use super::BeltProblem;
use super::by_branch::by_branch;
use super::found::{carried, checked};
use super::limit::{Found, may_be_another};
use super::path::{Path, Stuck};
use crate::{Drive, FrictionLaw, SolveError, SolveOptions, SteadyState};
use std::mem::discriminant;
use web_time::Instant;

/// The steady state of a V-belt drive, from nothing but the drive: at its own load if it is found there, else along the
/// branch that leads there or to the limit of the load. Where there is no such branch, from states near the load.
///
/// Scalar elastic friction may have several states under one load. Where the one at its own load is found only with a normalised
/// direction, that to which the branch of the load leads takes its place, if it leads there.
pub(crate) fn solve(drive: &Drive, options: &SolveOptions) -> Result<SteadyState, SolveError> {
    let start = Instant::now();
    let tolerance = options.tolerance;
    let mut path = Path::new(drive, tolerance).for_error();
    let is_elastic = matches!(drive.law, FrictionLaw::Epp { .. });
    // Whether a state that is known stays the answer where no branch leads to the load.
    let mut stays = false;
    let direct = match path.at_load(path.target()) {
        Ok(solved) if solved.driven_speed() > 0.0 && path.is_before_limit(&solved) => {
            let is_sure = !may_be_another(&solved) || path.is_reached(&solved);
            let may_be_one_of_two = is_elastic && !solved.problem.has_direction();
            match checked(&path, solved, start) {
                fault @ Err(SolveError::Violated(_) | SolveError::Impossible(_)) => Some(fault),
                Ok(state) if is_sure && may_be_one_of_two => {
                    stays = true;
                    Some(Ok(state))
                }
                answer if is_sure => return answer,
                answer => Some(answer),
            }
        }
        _ => None,
    };
    // Beside the ends of contacts the pressure, which may not be negative, may need a small defect.
    path.for_error = false;
    let led = by_branch(&mut path, start, stays).filter(|answer| answer.is_ok() || !stays);
    if let Some(answer) = led.or(direct) {
        return answer;
    }
    let found = path.find(path.target());
    conclude(&path, found, start)
}

/// The steady state of a V-belt drive that differs little from one that is solved.
pub(crate) fn solve_from(
    neighbour: &SteadyState,
    drive: &Drive,
    options: &SolveOptions,
) -> Result<SteadyState, SolveError> {
    let start = Instant::now();
    let tolerance = options.tolerance;
    let law = |drive: &Drive| discriminant(&drive.law);
    let Some(solved) = neighbour.restart.as_deref() else {
        return solve(drive, options);
    };
    if law(drive) != law(&neighbour.drive) || tolerance < neighbour.convergence.tolerance {
        return solve(drive, options);
    }
    let mut path = Path::new(drive, tolerance).for_error();
    path.smoothing_effect = neighbour.convergence.slip_normalisation_effect;
    match path.neighbour(solved) {
        Ok(solved) => {
            let found = path.classify(solved);
            match conclude(&path, found, start) {
                Err(SolveError::Violated(_) | SolveError::Impossible(_)) => solve(drive, options),
                answer => answer,
            }
        }
        Err(_) => solve(drive, options),
    }
}

/// The answer: a state that has passed its checks, or the reason why there is none.
fn conclude(
    path: &Path<'_>,
    found: Result<Found, Stuck>,
    start: Instant,
) -> Result<SteadyState, SolveError> {
    checked(path, carried(path, found)?, start)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TwoPulleys;
    use crate::vbelt::scaling::tests::{kim, tractive, v_belt};

    #[test]
    fn of_two_states_that_of_the_branch_is_told() {
        // The other one, whose direction is normalised, is 0.4 % faster and has an efficiency of 0.910.
        let law = FrictionLaw::Epp {
            stiffness: 1.438_469e8,
        };
        let drive = Drive::from(TwoPulleys {
            belt: v_belt([0.062_115_38, 46_517.37, 4_957_713.0, 0.205_842_2]),
            friction_coefficient: 0.677_472_3,
            driver_radius: 0.208_645_5,
            driver_speed: 35.497_14,
            driven_radius: 0.159_542_6,
            centre_distance: 0.851_132_5,
            load: tractive(274.847_1, 320.719_7),
            ..kim(law, 0.25)
        });
        let state = solve(&drive, &SolveOptions::default()).unwrap();
        let speed = state.driven.angular_speed;
        assert!((speed - 46.568_37).abs() < 1e-4, "{speed}");
        let restart = state.restart.unwrap();
        assert!(restart.problem.sticks(), "{:?}", restart.problem.regimes());
    }
}
