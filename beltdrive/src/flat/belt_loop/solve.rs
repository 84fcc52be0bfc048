//! From a loop to its steady state: rest, unloaded loop, load factor limit, loaded loop.

use super::checks::checked;
use super::closing::Target;
use super::limit::{judged, largest, load_limit, slips};
use super::numbers::{Numbers, constant};
use super::problem::{Loaded, Problem};
use super::rest::{Rest, rest_of_closure};
use super::results::{Found, state};
use super::running::RunningBelt;
use crate::mechanics::tensioner::{Towards, within_travel};
use crate::results::loop_state::LoopState;
use crate::{Closure, Drive, Duty, FrictionLaw, Pulley, SolveError};

/// Largest strain of the belt: at twice its length no belt is linear elastic, and far beyond it the length
/// of the unstretched belt is lost in rounding.
const LARGEST_STRAIN: f64 = 1.0;

/// A given power is met to this, relative: rounding errors of the torques.
const POWER: f64 = 1e-14;

/// Most iterations for the torques of given powers. Each divides the error by about EA over the change of
/// tension, at least 10 for any belt, or by the belt speed over the creep; 30 leave room for one about to
/// stall.
const POWERS: usize = 30;

/// The slope of the torque asked for with the torque is taken from changes above this, relative, far above
/// rounding errors; it is no more than the second number, which limits a step to ten times the change.
const SLOPE: (f64, f64) = (1e-10, 0.9);

/// The steady state of a belt loop.
///
/// Coulomb friction is judged first: a loop slips grossly if it does with Coulomb friction at the same
/// closure, whatever its friction law.
///
/// # Errors
/// Those of [`SolveError`], in the order given there.
pub(crate) fn solve(drive: &Drive) -> Result<LoopState, SolveError> {
    let rim = drive.rim_speed();
    let torque = |pulley: &Pulley| match pulley.duty {
        Duty::Driver(_) | Duty::Driven => 0.0,
        Duty::Torque(torque) => torque,
        Duty::Power(power) => power * pulley.radius / rim,
    };
    let mut torques: Vec<_> = drive.pulleys.iter().map(torque).collect();
    // The last torque of each pulley, what its power asked for there, and the slope of that.
    let mut last = vec![[f64::NAN, f64::NAN, 0.0]; torques.len()];
    let has_powers = drive.pulleys.iter();
    let has_powers = { has_powers }.any(|pulley| matches!(pulley.duty, Duty::Power(_)));
    if !has_powers {
        return with_torques(drive, &torques, true);
    }
    for _ in 0..POWERS {
        let state = with_torques(drive, &torques, false)?;
        let mut change = 0.0;
        for (index, pulley) in drive.pulleys.iter().enumerate() {
            if let Duty::Power(power) = pulley.duty {
                let (torque, [before, asked_before, slope]) = (torques[index], last[index]);
                let asked = power / state.pulleys[index].angular_speed;
                change = f64::max(change, ((asked - torque) / asked).abs());
                let moved = torque - before;
                let slope = match moved.abs() > SLOPE.0 * torque.abs() {
                    true => ((asked - asked_before) / moved).clamp(-SLOPE.1, SLOPE.1),
                    false => slope,
                };
                last[index] = [torque, asked, slope];
                torques[index] = torque + (asked - torque) / (1.0 - slope);
            }
        }
        if change.is_nan() || change < POWER {
            return with_torques(drive, &torques, true);
        }
    }
    Err(SolveError::NotFound {
        what: "torque of a given power",
    })
}

/// Tractive tension of a loop without torques, N; not positive where the belt lifts off.
///
/// # Errors
/// As [`solve`], but for lift-off.
pub(crate) fn unloaded_tension(drive: &Drive) -> Result<f64, SolveError> {
    let (_, problem) = stated(drive, &vec![0.0; drive.pulleys.len()])?;
    match problem.unloaded() {
        Ok((coordinate, layout)) => {
            within_travel(drive, coordinate)?;
            Ok(problem.unloaded_tension(&layout))
        }
        Err(SolveError::LiftsOff {
            tractive_tension, ..
        }) => Ok(tractive_tension),
        Err(error) => Err(error),
    }
}

/// A loop with given torques, and its state at rest where that closes it.
fn stated<'d>(
    drive: &'d Drive,
    torques: &[f64],
) -> Result<(Option<Rest>, Problem<'d>), SolveError> {
    let start = drive.start_coordinate();
    let layout = drive.layout(start)?;
    let (rest, target) = match drive.closure {
        Closure::SpanTension { span, tension } => (None, Target::Tension { span, tension }),
        Closure::SpanTractiveTension { span, tension } => {
            (None, Target::TractiveTension { span, tension })
        }
        _ => {
            let rest = rest_of_closure(drive, (start, layout.clone()))?;
            let axial = drive.belt.axial_stiffness;
            let target = Target::as_at_rest(rest.layout.length(), rest.tension, axial);
            (Some(rest), target)
        }
    };
    let problem = Problem {
        drive,
        numbers: Numbers::new(drive, torques, constant(drive)),
        target,
        start: rest.as_ref().map_or((start, layout), |rest| {
            (rest.coordinate, rest.layout.clone())
        }),
        towards: match rest {
            Some(_) => Towards::Force,
            None => Towards::Newton,
        },
    };
    Ok((rest, problem))
}

/// The steady state of a belt loop with given torques; the final one has its load factor limit and its
/// checks.
fn with_torques(drive: &Drive, torques: &[f64], is_final: bool) -> Result<LoopState, SolveError> {
    let (rest, mut problem) = stated(drive, torques)?;
    problem.start = problem.unloaded()?;
    let rigid = problem.loaded(1.0, FrictionLaw::Coulomb, None)?;
    let rest = match rest {
        Some(rest) => Some(rest),
        None => problem.rest_of(&rigid)?,
    };
    let at_rest = rest.as_ref().map(|rest| rest.coordinate);
    let running = rigid.belt.as_ref().map(|_| rigid.coordinate);
    for coordinate in at_rest.into_iter().chain(running) {
        within_travel(drive, coordinate)?;
    }
    let judged = judged(&problem, &rigid);
    let limit = match is_final || slips(judged.as_ref()) {
        true => load_limit(&problem, &rigid, judged.as_ref())?,
        false => None,
    };
    let loaded = match drive.law {
        FrictionLaw::Coulomb => rigid,
        _ => problem.loaded(1.0, drive.law, Some(&rigid))?,
    };
    let rest = match drive.closure {
        Closure::SpanTension { .. } | Closure::SpanTractiveTension { .. } => {
            problem.rest_of(&loaded)?
        }
        _ => rest,
    };
    let stalls = |pulley: usize| SolveError::Stalls {
        pulley: drive.pulleys[pulley].name.clone(),
    };
    let Loaded {
        coordinate,
        layout,
        belt: Some(belt),
    } = loaded
    else {
        return Err(stalls(judged.map_or(0, |judged| largest(&judged).0)));
    };
    let rest = rest.ok_or(SolveError::NotFound {
        what: "state at rest",
    })?;
    within_travel(drive, coordinate)?;
    within_travel(drive, rest.coordinate)?;
    let axial = drive.belt.axial_stiffness;
    presses(&belt)?;
    let tractions = belt.tractions.iter();
    let strains = tractions.map(|&traction| belt.belt.strain(traction));
    let strain = strains.fold(rest.tension / axial, f64::max);
    if strain > LARGEST_STRAIN {
        return Err(SolveError::Overstretched { strain });
    }
    let stalled = |pulley: &usize| belt.belt.offset() + belt.contacts[*pulley].reference() <= 0.0;
    if let Some(pulley) = (0..belt.contacts.len()).find(stalled) {
        return Err(stalls(pulley));
    }
    let found = Found {
        drive,
        numbers: &problem.numbers,
        rest,
        coordinate,
        layout,
        belt,
        limit,
    };
    found.stable()?;
    match is_final {
        true => checked(drive, state(found)),
        false => Ok(state(found)),
    }
}

/// Whether a running belt presses on all pulleys: with the convention `thesis` friction does not ask for it.
fn presses(belt: &RunningBelt) -> Result<(), SolveError> {
    let spans = belt.tractive.iter().zip(&belt.tractions);
    match spans.min_by(|(one, _), (other, _)| one.total_cmp(other)) {
        Some((&tractive_tension, &traction)) if tractive_tension <= 0.0 => {
            Err(SolveError::LiftsOff {
                tractive_tension,
                speed: belt.speed * (1.0 + belt.belt.strain(traction)),
                is_loaded: true,
            })
        }
        _ => Ok(()),
    }
}
