//! The belt at rest.

use crate::drive::layout::Layout;
use crate::mechanics::tensioner::{Held, Towards, equilibrium, length_derivatives, within_travel};
use crate::results::loop_state::RestState;
use crate::{Closure, Drive, SolveError};
use bvp::Real;

/// The belt at rest: uniform tension, no friction.
#[derive(Clone, Debug)]
pub(super) struct Rest {
    /// Coordinate of the tensioner, rad or m; without one it means nothing.
    pub(super) coordinate: f64,
    pub(super) layout: Layout,
    /// Belt tension, N.
    pub(super) tension: f64,
    /// Length `L_0` of the unstretched belt, m.
    pub(super) unstretched: f64,
}

/// Length in m of the unstretched belt that has a tension in N in a loop of a length.
pub(super) fn unstretched<S: Real>(length: S, tension: S, axial_stiffness: S) -> S {
    length / (tension / axial_stiffness + 1.0)
}

/// Tension in N of a belt of an unstretched length in m in a loop of a length.
pub(super) fn tension<S: Real>(length: S, unstretched: S, axial_stiffness: S) -> S {
    axial_stiffness * ((length - unstretched) / unstretched)
}

/// The loop at rest, where the closure is one of it.
pub(crate) fn at_rest(drive: &Drive) -> Result<RestState, SolveError> {
    let start = drive.start_coordinate();
    let rest = rest_of_closure(drive, (start, drive.layout(start)?))?;
    within_travel(drive, rest.coordinate)?;
    Ok(RestState {
        tension: rest.tension,
        unstretched_length: rest.unstretched,
        coordinate: rest.coordinate,
    })
}

/// The belt at rest where its length or its tension at rest is given.
/// The search for it begins with the belt round a tensioner at a coordinate.
pub(super) fn rest_of_closure(
    drive: &Drive,
    (start, layout): (f64, Layout),
) -> Result<Rest, SolveError> {
    let axial = drive.belt.axial_stiffness;
    let (coordinate, layout) = match drive.closure {
        Closure::UnstretchedLength(length) => {
            return rest_of_length(drive, (start, layout), length);
        }
        Closure::SetupTension(tension) => {
            equilibrium(drive, (start, layout), Towards::Newton, "at rest", |_| {
                Ok([tension, 0.0])
            })?
        }
        Closure::RestCoordinate(_)
        | Closure::SpanTension { .. }
        | Closure::SpanTractiveTension { .. }
        | Closure::BothSpans(_) => (start, layout),
    };
    let tension = match (drive.closure, drive.tensioner()) {
        (Closure::RestCoordinate(_), Some((pulley, tensioner))) => {
            let [slope, _] = length_derivatives(&layout, pulley, &tensioner.guide, coordinate);
            tensioner.load_at(coordinate)[0] / slope
        }
        (Closure::SetupTension(tension), _) => tension,
        _ => f64::NAN,
    };
    let unstretched = unstretched(layout.length(), tension, axial);
    stable_rest(
        drive,
        Rest {
            coordinate,
            layout,
            tension,
            unstretched,
        },
    )
}

/// The belt of a given unstretched length at rest.
pub(super) fn rest_of_length(
    drive: &Drive,
    (start, layout): (f64, Layout),
    length: f64,
) -> Result<Rest, SolveError> {
    let axial = drive.belt.axial_stiffness;
    let tension = |layout: &Layout| tension(layout.length(), length, axial);
    let at_start = tension(&layout);
    let found = equilibrium(
        drive,
        (start, layout),
        Towards::Force,
        "at rest",
        |layout| Ok([tension(layout), axial / length]),
    );
    let (coordinate, layout) = match found {
        Ok(found) => found,
        Err(error) => {
            return Err(match at_start <= 0.0 {
                true => SolveError::Slack { tension: at_start },
                false => error,
            });
        }
    };
    stable_rest(
        drive,
        Rest {
            coordinate,
            tension: tension(&layout),
            layout,
            unstretched: length,
        },
    )
}

/// A belt at rest that is in tension, with its tensioner in a stable equilibrium.
fn stable_rest(drive: &Drive, rest: Rest) -> Result<Rest, SolveError> {
    let tension = rest.tension;
    if tension <= 0.0 {
        return Err(SolveError::Slack { tension });
    }
    let Some((pulley, tensioner)) = drive.tensioner() else {
        return Ok(rest);
    };
    let Rest {
        coordinate,
        unstretched,
        ..
    } = rest;
    let carried = (pulley, tensioner);
    let held = Held::new(
        drive,
        carried,
        &rest.layout,
        coordinate,
        tension,
        unstretched,
    );
    match tension.is_finite() && held.stiffness > 0.0 {
        true => Ok(rest),
        false => Err(SolveError::NoEquilibrium {
            pulley: drive.pulleys[pulley].name.clone(),
            which: "at rest",
        }),
    }
}
