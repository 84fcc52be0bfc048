//! How much of its load a loop carries: the load factor limit, and gross slip.

use super::super::root::bracketed;
use super::error::{LoadedState, LoopError};
use super::running::Running;
use super::solve::{Loaded, Problem};
use super::state::LoadLimit;
use crate::FrictionLaw;

/// Largest load factor that is tried: beyond it the torques are but rounding errors of the driver's.
const LARGEST: f64 = 1e12;

/// Smallest relative step of the search where a larger one leaves the range of the tensioner.
const SMALLEST_STEP: f64 = 1e-3;

/// A limit is slip if the utilisation there is 1 to this; else the tensioner jumps there.
const AT_SLIP: f64 = 1e-6;

/// The load factor limit, above 1; `None` without torques, or if the tensioner has no equilibrium up to
/// it. `whole` is the loop under its whole load.
pub(super) fn load_limit(
    problem: &Problem<'_>,
    whole: &Loaded,
) -> Result<Option<LoadLimit>, LoopError> {
    let state_at = |factor: f64| {
        let loaded = problem.loaded(factor, FrictionLaw::Coulomb)?;
        Ok::<_, LoopError>(judged(problem, &loaded, factor))
    };
    let at = |factor: f64| state_at(factor).map(|state| excess(state.as_ref()));
    let formal = judged(problem, whole, 1.0);
    let at_whole = excess(formal.as_ref());
    if at_whole == -1.0 {
        return Ok(None);
    }
    let mut low = (0.0, -1.0);
    let mut high = (1.0, at_whole);
    let mut step = 1.0;
    while high.1 < 0.0 {
        low = high;
        let next = low.0 * (1.0 + step);
        match at(next) {
            Ok(found) => high = (next, found),
            Err(_) => step *= 0.5,
        }
        if step < SMALLEST_STEP || next > LARGEST {
            return Ok(None);
        }
    }
    // A load without an equilibrium of the tensioner is not carried.
    let residual = |factor: f64| at(factor).unwrap_or(1.0);
    let lost = LoopError::NotFound {
        what: "load factor limit",
    };
    let factor = bracketed(residual, [low.0, high.0], [low.1, high.1]).ok_or(lost)?;
    let at_limit = state_at(factor).ok().flatten();
    let is_slip = |state: &LoadedState| excess(Some(state)).abs() < AT_SLIP;
    let at_limit = match (at_limit, factor > 1.0) {
        (Some(state), _) if is_slip(&state) => state,
        (_, true) => return Ok(None),
        (Some(state), false) => state,
        // The tensioner loses its equilibrium before a pulley slips.
        (None, false) => state_at(factor * (1.0 - AT_SLIP))?.ok_or(LoopError::NotFound {
            what: "load factor limit",
        })?,
    };
    let (pulley, _) = largest(&at_limit);
    if factor > 1.0 {
        return Ok(Some(LoadLimit { factor, pulley }));
    }
    Err(LoopError::GrossSlip {
        pulley: problem.belt_loop.pulleys[pulley].name.clone(),
        load_factor: factor,
        margin: formal
            .as_ref()
            .and_then(|formal| formal.torque_margins[pulley]),
        at_limit: Box::new(at_limit),
        formal: formal.map(Box::new),
    })
}

/// The pulley of a loaded loop that is closest to gross slip with Coulomb friction.
pub(super) fn most_used(problem: &Problem<'_>, loaded: &Loaded) -> usize {
    judged(problem, loaded, 1.0).map_or(0, |state| largest(&state).0)
}

/// A loaded loop against the friction of its pulleys, if it presses on all of them.
fn judged(problem: &Problem<'_>, loaded: &Loaded, factor: f64) -> Option<LoadedState> {
    let Loaded {
        layout,
        coordinate,
        belt,
    } = loaded;
    let running = Running::new(problem, layout, FrictionLaw::Coulomb, factor);
    let coordinate = problem.belt_loop.tensioner().map(|_| *coordinate);
    belt.as_ref().map(|belt| running.loaded(belt, coordinate))
}

/// The pulley with the largest friction utilisation U, and that.
fn largest(state: &LoadedState) -> (usize, f64) {
    let used = state.friction_utilisations.iter().copied().enumerate();
    used.fold(
        (0, 0.0),
        |most, used| if used.1 > most.1 { used } else { most },
    )
}

/// (U − 1)/(U + 1): −1 without load, 0 at gross slip, 1 where the belt does not press.
fn excess(state: Option<&LoadedState>) -> f64 {
    state.map_or(1.0, |state| match largest(state) {
        (_, used) if used.is_infinite() => 1.0,
        (_, used) => (used - 1.0) / (used + 1.0),
    })
}
