//! The search for the belt at rest.

use super::guess::groove_compliances;
use super::rest::{Known, Rest, RestProblem};
use super::rest_guess::RestGuess;
use super::solve::{Search, lost};
use crate::SolveError;
use crate::drive::layout::Layout;
use crate::mechanics::tensioner::{Towards, equilibrium, length_derivatives};

/// The belt at rest, from where its pitch line would be with grooves that yield.
pub(super) fn rest_near(
    search: &mut Search<'_>,
    known: Known,
    start: f64,
    layout: &Layout,
) -> Result<(RestProblem, Rest), SolveError> {
    let drive = search.drive;
    let axial = drive.belt.axial_stiffness;
    let (coordinate, tension) = match known {
        Known::Length(length) => {
            let grooves = groove_compliances(drive, layout);
            let compliance = length / axial + grooves.iter().sum::<f64>();
            let tension = |layout: &Layout| (layout.length() - length) / compliance;
            let found = equilibrium(
                drive,
                (start, layout.clone()),
                Towards::Force,
                "at rest",
                |layout| Ok([tension(layout), compliance.recip()]),
            );
            match found {
                Err(_) if tension(layout) <= 0.0 => (start, tension(layout)),
                found => {
                    let (coordinate, layout) = found?;
                    (coordinate, tension(&layout))
                }
            }
        }
        Known::Tension(tension) => {
            let found = equilibrium(
                drive,
                (start, layout.clone()),
                Towards::Newton,
                "at rest",
                |_| Ok([tension, 0.0]),
            );
            (found?.0, tension)
        }
        Known::Equilibrium => {
            let tension = drive.tensioner().map_or(f64::NAN, |(pulley, tensioner)| {
                let guide = &tensioner.guide;
                let [slope, _] = length_derivatives(layout, pulley, guide, start);
                tensioner.load_at(start)[0] / slope
            });
            (start, tension)
        }
    };
    if tension <= 0.0 {
        return Err(SolveError::Slack { tension });
    }
    let layout = drive.layout(coordinate)?;
    let problem = RestProblem::new(drive, &layout, tension, known);
    let problem = match known {
        Known::Equilibrium => problem.held(coordinate),
        _ => problem,
    };
    let pressed = |(pulley, largest): (usize, f64)| SolveError::PressedThrough {
        pulley: drive.pulleys[pulley].name.clone(),
        largest,
    };
    let guess = RestGuess::new(&problem, tension, coordinate).map_err(pressed)?;
    let outcome = problem.solve(&guess, search);
    let rest = outcome.map_err(|cause| lost(0.0, &cause))?;
    match rest.tension > 0.0 {
        true => Ok((problem, rest)),
        false => Err(SolveError::Slack {
            tension: rest.tension,
        }),
    }
}
