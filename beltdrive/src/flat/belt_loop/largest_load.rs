//! The largest load of a loop with a flat belt.

use super::solve::solve;
use crate::results::largest_load::{LargestLoad, LoadEnd};
use crate::results::loop_state::LoopState;
use crate::{Drive, SolveError};

/// Divisions of the load, until one shows where a pulley slips.
const DIVISIONS: i32 = 60;

/// Distances from the limit of slip at which a state is looked for, relative, the nearest first. With a state at one of
/// the first two the limit is that of slip, which is known to about 1e-12: where two pulleys are about to slip at once
/// a law that creeps has none nearer.
const BELOW_SLIP: [f64; 6] = [1e-11, 1e-9, 1e-6, 1e-3, 0.03, 0.3];

const AT_SLIP: usize = 2;

/// Bisections that locate another end to rounding from half of it.
const BISECTIONS: usize = 52;

/// Estimated relative error: cases that were solved with 40 digits agree to 1.6e-13.
const ERROR: f64 = 1e-12;

/// The factor on all torques up to which a loop has a steady state.
///
/// # Errors
/// There is none without torques; no end was found.
pub(crate) fn largest_load(drive: &Drive) -> Result<LargestLoad, SolveError> {
    let at = |factor: f64| {
        let mut loaded = drive.clone();
        loaded.multiply_load(factor);
        solve(&loaded)
    };
    at(0.0)?;
    let slip = first_slip(drive, &at)?;
    let mut outside = None;
    let mut inside = None;
    match slip {
        Some((factor, pulley)) => {
            for (index, distance) in BELOW_SLIP.into_iter().enumerate() {
                let below = factor * (1.0 - distance);
                match at(below) {
                    Ok(state) if index < AT_SLIP => {
                        let end = LoadEnd::Slips(pulley);
                        return Ok(found(drive, (below, &state), factor, end));
                    }
                    Ok(state) => {
                        inside = Some((below, state));
                        break;
                    }
                    Err(error) => outside = Some((below, error)),
                }
            }
        }
        None => {
            let powers = (0..DIVISIONS).map(|power| 4_f64.powi(power));
            for factor in powers {
                match at(factor) {
                    Ok(state) => inside = Some((factor, state)),
                    Err(error) => {
                        outside = Some((factor, error));
                        break;
                    }
                }
            }
        }
    }
    let lost = || SolveError::NotFound {
        what: "largest load",
    };
    let (mut beyond, mut error) = outside.ok_or_else(lost)?;
    let (mut below, mut state) = match inside {
        Some(inside) => inside,
        None => {
            let shares = (1..=DIVISIONS).map(|power| beyond * 4_f64.powi(-power));
            let mut states = shares.filter_map(|factor| Some((factor, at(factor).ok()?)));
            states.next().ok_or_else(|| error.clone())?
        }
    };
    for _ in 0..BISECTIONS {
        let middle = f64::midpoint(below, beyond);
        if middle <= below || middle >= beyond {
            break;
        }
        match at(middle) {
            Ok(found) => (below, state) = (middle, found),
            Err(cause) => (beyond, error) = (middle, cause),
        }
    }
    let index = |name: &str| drive.pulleys.iter().position(|pulley| pulley.name == name);
    let end = match &error {
        SolveError::GrossSlip { pulley, .. } => index(pulley).map(LoadEnd::Slips),
        SolveError::Stalls { pulley } => index(pulley).map(LoadEnd::Stalls),
        _ => None,
    };
    let end = end.unwrap_or_else(|| LoadEnd::NoState(Box::new(error)));
    Ok(found(drive, (below, &state), below, end))
}

/// The factor at which the first pulley slips grossly with Coulomb friction, and that pulley; none if the tensioner
/// has no equilibrium up to there.
fn first_slip(
    drive: &Drive,
    at: &impl Fn(f64) -> Result<LoopState, SolveError>,
) -> Result<Option<(f64, usize)>, SolveError> {
    let mut last = None;
    for power in 0..DIVISIONS {
        let share = 4_f64.powi(-power);
        match at(share) {
            Ok(state) => {
                let limit = state.load_limit;
                return Ok(limit.map(|limit| (share * limit.factor, limit.pulley)));
            }
            Err(SolveError::GrossSlip {
                pulley,
                load_factor,
                ..
            }) => {
                let mut pulleys = drive.pulleys.iter();
                let index = pulleys.position(|other| other.name == pulley);
                return Ok(index.map(|index| (share * load_factor, index)));
            }
            Err(error) => last = Some(error),
        }
    }
    Err(last.unwrap_or(SolveError::NotFound {
        what: "largest load",
    }))
}

/// The load of a state just below the limit, raised to the limit.
fn found(
    drive: &Drive,
    (below, state): (f64, &LoopState),
    factor: f64,
    end: LoadEnd,
) -> LargestLoad {
    let rise = factor / below;
    let stalls = matches!(end, LoadEnd::Stalls(_));
    LargestLoad {
        factor,
        end,
        driver_torque: -state.pulleys[drive.driver()].torque * rise,
        power_out: (!stalls).then_some(state.power_out * rise),
        error: ERROR,
    }
}
