//! What the search for a state has found, as an answer.

use super::guess::tractive_on_pitch_line;
use super::limit::Found;
use super::numbers::Numbers;
use super::path::{Effort, ForError, Path, Solved, Stuck};
use super::state::{describe, steady_state};
use super::{DRIVEN, DRIVER, INCLINATION};
use crate::results::possible;
use crate::{
    Drive, Duty, FrictionLaw, LimitReason, Load, Pulley, SolveError, SpanTension, SteadyState,
};
use std::mem::discriminant;
use std::sync::Arc;
use web_time::Instant;

/// Searches a state of a drive at its load from which a branch can be followed.
pub(super) fn find(drive: &Drive, tolerance: f64) -> (Path<'_>, Result<Found, Stuck>) {
    let mut path = Path::of_branch(drive, tolerance);
    let found = path.find(path.target());
    (path, found)
}

/// The state found, or the reason why the load is not carried or not reached.
pub(super) fn carried(path: &Path<'_>, found: Result<Found, Stuck>) -> Result<Solved, SolveError> {
    let scales = path.scales();
    let found = found.map_err(|Stuck { last, cause, .. }| {
        let reason = lifts_off(path.drive).or_else(|| pressed_through(path));
        reason.unwrap_or_else(|| SolveError::NotConverged {
            tight: last.map(|last| last.tight_tension() * scales.units.force),
            cause: Arc::new(cause),
        })
    })?;
    match found {
        Found::State(solved) => Ok(*solved),
        Found::Beyond(limit) => {
            let state = &limit.state;
            if let Some(fault) = possible::fault(&describe(path, state)) {
                return Err(SolveError::Impossible(fault));
            }
            let value = state.tight_tension() * scales.units.force;
            let unit = scales.units.angular_speed(scales.radius[DRIVEN]);
            let speed = state.driven_speed() * unit;
            let exit = state.exit(DRIVER)[INCLINATION];
            Err(not_carried(path.drive, value, limit.reason, [speed, exit]))
        }
    }
}

/// The refusal of a drive whose belt lifts off: the tension of a span is less than centrifugal force asks for. A belt that sinks
/// is slower and may have a state, so that it is refused only where none is found.
fn lifts_off(drive: &Drive) -> Option<SolveError> {
    let Load { slack, tight } = drive.pair().load;
    let tractive = [slack, tight].map(|span| match span {
        SpanTension::Belt(tension) => tractive_on_pitch_line(drive, tension),
        SpanTension::Tractive(tension) | SpanTension::DrivenTorque(tension) => tension,
    });
    let tractive_tension = tractive[0].min(tractive[1]);
    (tractive_tension <= 0.0).then(|| SolveError::LiftsOff {
        tractive_tension,
        speed: drive.rim_speed(),
        is_loaded: true,
    })
}

/// The refusal of a drive whose belt is pressed through a groove at rest: its tension there is near to the mean of those of the
/// spans, and no less than that of the slack span. Friction may carry the belt as it runs, so that it is refused only where no
/// state is found.
fn pressed_through(path: &Path<'_>) -> Option<SolveError> {
    let (numbers, units) = (Numbers::new(&path.drive.pair()), path.scales().units);
    let carried = |pulley| numbers.groove(pulley, &units, 0.0).largest_tension();
    let least = if carried(DRIVEN) < carried(DRIVER) {
        DRIVEN
    } else {
        DRIVER
    };
    let is_least = |pulley: &&Pulley| (pulley.duty == Duty::Driven) == (least == DRIVEN);
    let pulley = path.drive.pulleys.iter().find(is_least)?;
    (path.slack() > carried(least)).then(|| SolveError::PressedThrough {
        pulley: pulley.name.clone(),
        largest: carried(least) * units.force,
    })
}

/// The same with scalar elastic friction, which holds a belt less than other laws do, where it has not even a state with bristles
/// under no or a small load. Else states are sought along branches: of 40 random drives that are pressed through at rest 25 are
/// refused for it in 0.2 to 0.9 s, and took 3 to 22 s.
pub(super) fn pressed_through_without_states(path: &mut Path<'_>) -> Option<SolveError> {
    let FrictionLaw::Epp { .. } = path.drive.law else {
        return None;
    };
    let refused = pressed_through(path)?;
    (!path.has_bristles()).then_some(refused)
}

/// The refusal of the load of a drive beyond a limit of the tight tension in N, at which the driven pulley has this
/// speed in rad/s and the belt leaves the driver with this inclination in rad.
pub(super) fn not_carried(
    drive: &Drive,
    limit: f64,
    reason: LimitReason,
    [driven_speed, exit_inclination]: [f64; 2],
) -> SolveError {
    let tight = drive.pair().load.tight;
    SolveError::NoSteadyState {
        quantity: match tight {
            SpanTension::Tractive(_) => "tight tractive tension",
            _ => "tight tension",
        },
        unit: "N",
        asked: tight.value(),
        limit,
        reason,
        driven_speed: Some(match reason {
            // It stands but for rounding, which would print as −0.
            LimitReason::DrivenSlips => 0.0,
            _ => driven_speed,
        }),
        exit_inclination: Some(exit_inclination),
    }
}

/// A state of a branch that passes its checks, on meshes for the defect if it does not on those for the error: beside the ends of
/// contacts the pressure may be negative there by more than is allowed.
pub(super) fn verified(path: &mut Path<'_>, solved: Solved) -> Result<Solved, SolveError> {
    let Err(fault) = describe(path, &solved).verified() else {
        return Ok(solved);
    };
    path.for_error = ForError::Never;
    let precise = path.again(solved, Effort::Final).map_err(|_| fault)?;
    describe(path, &precise).verified()?;
    Ok(precise)
}

/// A solution as a state that has passed its checks, after a search that began at `start`.
pub(super) fn checked(
    path: &Path<'_>,
    solved: Solved,
    start: Instant,
) -> Result<SteadyState, SolveError> {
    let state = steady_state(path, solved, start);
    state.verified()?;
    forwards(path.drive, &state).map(|()| state)
}

/// Refuses a state in which the tight span is the slacker one. Where one tension is stated as tractive and
/// the other as belt tension this is seen only once the belt speed is known.
pub(super) fn forwards(drive: &Drive, state: &SteadyState) -> Result<(), SolveError> {
    match is_crossed(drive) && state.tight_tension < state.slack_tension {
        true => Err(SolveError::Backwards {
            slack: state.slack_tension,
            tight: state.tight_tension,
        }),
        false => Ok(()),
    }
}

/// Whether the tension of one span is stated as tractive and that of the other as belt tension.
pub(super) fn is_crossed(drive: &Drive) -> bool {
    let Load { slack, tight } = drive.pair().load;
    discriminant(&slack) != discriminant(&tight)
}
