//! How much of its load a loop carries: the load factor limit, and gross slip.

use super::equations::Equations;
use super::problem::{Loaded, Problem};
use crate::mechanics::root::bracketed;
use crate::results::loop_state::LoadLimit;
use crate::{FrictionLaw, LoadedState, SolveError};

/// Largest load factor that is tried: beyond it the torques are but rounding errors of the driver's.
const LARGEST: f64 = 1e12;

/// Smallest relative step of the search where a larger one leaves the range of the tensioner.
const SMALLEST_STEP: f64 = 1e-3;

/// A limit is slip if the utilisation there is 1 to this; else the tensioner jumps there.
const AT_SLIP: f64 = 1e-6;

/// The load factor limit, above 1; `None` without torques, or if the tensioner has no equilibrium up to
/// it. `whole` is the loop under its whole load, `formal` that state if it presses on all pulleys.
pub(super) fn load_limit(
    problem: &Problem<'_>,
    whole: &Loaded,
    formal: Option<&LoadedState>,
) -> Result<Option<LoadLimit>, SolveError> {
    let state_at = |factor: f64| {
        let loaded = problem.loaded(factor, FrictionLaw::Coulomb, None)?;
        Ok::<_, SolveError>(judged(problem, &loaded))
    };
    let at = |factor: f64| state_at(factor).map(|state| excess(state.as_ref()));
    let at_whole = excess(formal);
    if at_whole == -1.0 {
        return Ok(None);
    }
    if at_whole < 0.0
        && let Some((factor, loaded)) = first_slip(problem, whole)
        && let Some(state) = judged(problem, &loaded)
        && excess(Some(&state)).abs() < AT_SLIP
    {
        let (pulley, _) = largest(&state);
        return Ok(Some(LoadLimit {
            factor,
            pulley,
            error: 0.0,
        }));
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
    let lost = SolveError::NotFound {
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
        (None, false) => state_at(factor * (1.0 - AT_SLIP))?.ok_or(SolveError::NotFound {
            what: "load factor limit",
        })?,
    };
    if factor <= 1.0
        && !is_slip(&at_limit)
        && let Some((idler, _)) = problem.drive.tensioner()
    {
        return Err(SolveError::NoEquilibrium {
            pulley: problem.drive.pulleys[idler].name.clone(),
            which: "under load",
        });
    }
    let (pulley, _) = largest(&at_limit);
    if factor > 1.0 {
        return Ok(Some(LoadLimit {
            factor,
            pulley,
            error: 0.0,
        }));
    }
    Err(SolveError::GrossSlip {
        pulley: problem.drive.pulleys[pulley].name.clone(),
        load_factor: factor,
        margin: formal.and_then(|formal| formal.torque_margins[pulley]),
        at_limit: Box::new(at_limit),
        formal: formal.cloned().map(Box::new),
    })
}

/// The load factor limit, above 1, and the loop there, if it is found at once from the loop under its whole load.
fn first_slip(problem: &Problem<'_>, whole: &Loaded) -> Option<(f64, Loaded)> {
    let equations = Equations::new(problem, FrictionLaw::Coulomb, &whole.layout);
    let start = equations.guess_of_slip(whole.state()?);
    let (loaded, factor) = equations.loaded::<4>(start)?;
    (1.0 < factor && factor < LARGEST).then_some((factor, loaded))
}

/// Whether a pulley slips grossly.
pub(super) fn slips(state: Option<&LoadedState>) -> bool {
    excess(state) >= 0.0
}

/// A loaded loop against the friction of its pulleys, if it presses on all of them.
pub(super) fn judged(problem: &Problem<'_>, loaded: &Loaded) -> Option<LoadedState> {
    let Problem { drive, .. } = problem;
    let found = loaded.belt.as_ref()?;
    let pulleys = drive.pulleys.iter().enumerate();
    let used = pulleys.map(|(index, pulley)| {
        let load = found.largest_load(pulley, loaded.layout.wraps()[index]);
        let arc = found.contacts[index].arc;
        let torque = found.changes[index] * pulley.radius;
        let capacity = pulley.radius * arc.low * load.exp_m1();
        let utilisation = if arc.change == 0.0 {
            0.0
        } else {
            arc.load() / load
        };
        let margin = (torque != 0.0).then(|| capacity / torque.abs());
        (torque, capacity, utilisation, margin)
    });
    let used: Vec<_> = used.collect();
    let tractions = found.tractions.iter();
    Some(LoadedState {
        torques: used.iter().map(|used| used.0).collect(),
        tensions: tractions
            .map(|&traction| found.belt.tension(traction))
            .collect(),
        tractive_tensions: found.tractive.clone(),
        mass_flow: drive.belt.mass_per_length * found.speed,
        tensioner_coordinate: drive.tensioner().map(|_| loaded.coordinate),
        friction_utilisations: used.iter().map(|used| used.2).collect(),
        torque_capacities: used.iter().map(|used| used.1).collect(),
        torque_margins: used.iter().map(|used| used.3).collect(),
    })
}

/// The pulley with the largest friction utilisation U, and that.
pub(super) fn largest(state: &LoadedState) -> (usize, f64) {
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
