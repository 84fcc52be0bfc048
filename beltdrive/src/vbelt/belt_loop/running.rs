//! The search for the running loop under its whole load.

use super::climb::{Climbed, Top};
use super::guess::tractive_tensions;
use super::laws::Start;
use super::problem::Target;
use super::rest::Rest;
use super::solve::{Search, Solved};
use crate::drive::layout::Layout;
use crate::results::loop_error::LoopError;

/// Shares of the load that are tried in turn from nothing; from all but the first the load is then raised.
const SHARES: [f64; 7] = [1.0, 0.5, 0.2, 0.05, 0.01, 1e-3, 0.0];
/// Where the belt leaves a pulley more steeply than this, or a pulley loses more than this share of its
/// speed, a state may lie beyond the largest load.
const STEEP: f64 = 1.3;
const SLOW: f64 = 0.5;

/// A running loop.
pub(super) struct Running {
    /// To the tolerance.
    pub(super) solved: Solved,
    /// Roughly, to raise the load from. Coulomb friction has a large ε there, which matters little where the belt
    /// slips (margins change by 1e-6) and makes the way there easy: with a small one neither the driver of three
    /// grooves had a margin nor their loop a load limit.
    pub(super) rough: Solved,
}

/// The running loop under its whole load: at once where Newton's method finds it and it cannot lie
/// beyond the largest load, else by raising a share of the load.
pub(super) fn running(
    search: &mut Search<'_>,
    target: Target,
    rest: Option<&Rest>,
    coordinate: f64,
) -> Result<Running, LoopError> {
    let layout = search.belt_loop.layout(coordinate)?;
    presses(search, target, &layout)?;
    let start = |factor: f64| {
        let tractive = tractive_tensions(search.belt_loop, &layout, target, rest, factor);
        Start {
            layout: &layout,
            target,
            tractive,
            coordinate,
            factor,
        }
    };
    let [whole, shares @ ..] = SHARES.map(start);
    let direct = match whole.is_taut() {
        true => search
            .rough(&whole)
            .and_then(|rough| sharpened(search, rough))
            .map_err(Some),
        false => Err(None),
    };
    let is_safe = |solved: &Solved| is_drive(solved) && !may_be_beyond(solved);
    let direct = match direct {
        Ok(running) if is_safe(&running.solved) => return Ok(running),
        other => other,
    };
    for share in shares.iter().filter(|share| share.is_taut()) {
        match search.rough(share) {
            Ok(rough) if is_safe(&rough) => return raise(search, &rough),
            _ => {}
        }
    }
    match direct {
        Ok(running) if is_drive(&running.solved) => Ok(running),
        Err(Some(cause)) => Err(search.lost(0.0, &cause)),
        _ => Err(LoopError::NotConverged {
            reached: 0.0,
            cause: "the belt would have to push in a span even under hardly any load",
        }),
    }
}

/// Whether a belt between fixed centres presses on its pulleys without torques. Where it hardly presses
/// it does not sink either: the tension of its pitch line decides.
fn presses(search: &Search<'_>, target: Target, layout: &Layout) -> Result<(), LoopError> {
    let (Target::Length(length), None) = (target, search.belt_loop.tensioner()) else {
        return Ok(());
    };
    let (belt, rim) = (search.belt_loop.belt, search.belt_loop.rim_speed());
    let strain = (layout.length() - length) / length;
    let flow = belt.mass_per_length * rim / (1.0 + strain);
    let tractive_tension = belt.axial_stiffness * strain - flow * rim;
    match tractive_tension > 0.0 {
        true => Ok(()),
        false => Err(LoopError::LiftsOff {
            tractive_tension,
            speed: rim,
            is_loaded: false,
        }),
    }
}

/// Raises the load of a state to the whole.
fn raise(search: &mut Search<'_>, from: &Solved) -> Result<Running, LoopError> {
    match search.climb(from, 1.0) {
        Climbed::Reached(rough) => {
            let outcome = sharpened(search, *rough);
            outcome.map_err(|cause| search.lost(1.0, &cause))
        }
        Climbed::Limit(Top {
            factor,
            pulley,
            overhangs,
        }) => Err(LoopError::Overloaded {
            pulley: search.belt_loop.pulleys[pulley].name.clone(),
            load_factor: factor,
            overhangs,
        }),
        Climbed::Lost { reached, cause } => Err(LoopError::NotConverged { reached, cause }),
    }
}

/// The running loop to the tolerance, from a rough one with a large ε.
fn sharpened(search: &mut Search<'_>, rough: Solved) -> Result<Running, bvp::Error> {
    let solved = search.sharpen(rough.clone())?;
    Ok(Running { solved, rough })
}

/// Whether the state may lie beyond the largest load.
fn may_be_beyond(solved: &Solved) -> bool {
    let p = solved.solution.parameters();
    let ends = solved.with_ends(|at, _| solved.problem.end_angles(at));
    let mut segments = 0..solved.problem.pulley_of.len();
    ends.iter().any(|ends| ends.exit > STEEP)
        || segments.any(|segment| solved.problem.omega(segment, p) < SLOW)
}

/// Whether the belt pulls in all spans, turns every pulley forwards and touches it.
fn is_drive(solved: &Solved) -> bool {
    let p = solved.solution.parameters();
    let segments = solved.problem.pulley_of.len();
    p[0] > 0.0
        && (0..segments).all(|segment| {
            p[solved.problem.length_index(segment)] > 0.0
                && solved.problem.omega(segment, p) > 0.0
                && solved.solution.end(segment)[0] > 0.0
        })
}
