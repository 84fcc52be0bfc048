//! Whether a drive holds: its state in each load case against what is required of it.

use super::belt_loop::{closed_once, solve_with_margins};
use super::losses::{Losses, losses};
use crate::belt_loop::LoopState;
use crate::model::{Neighbour, model};
use crate::{Drive, GivenLosses, LoadCase, Requirements, Service, SolveError, SolveOptions};

/// The load cases of a drive with their verdicts.
#[derive(Clone, Debug)]
pub struct CheckedService {
    /// What was asked.
    pub service: Service,
    /// What was found in each case, in its order.
    pub cases: Vec<CheckedCase>,
}

/// What was found in a load case.
#[derive(Clone, Debug)]
pub struct CheckedCase {
    /// The steady state, or why there is none.
    pub outcome: Result<Box<CaseState>, SolveError>,
    /// The requirements that fail; none also where there is no state.
    pub failures: Vec<Failing>,
}

/// The steady state of a load case against what may be required of it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct CaseState {
    /// The state, with its margins.
    pub state: LoopState,
    /// How far the drive is from gross slip.
    pub slip_margin: SlipMargin,
    /// The largest speed loss.
    pub speed_loss: OnPulley,
    /// The largest hub load of the running drive, N.
    pub hub_load: OnPulley,
    /// The largest hub load at rest, N.
    pub rest_hub_load: OnPulley,
    /// Where the power goes.
    pub losses: Losses,
}

/// How far a drive is from gross slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SlipMargin {
    /// No pulley has a torque.
    NoLoad,
    /// The factor on all torques at which the first pulley slips grossly, and that pulley.
    Factor(OnPulley),
    /// There is a load, but its limit was not found.
    NotFound,
}

/// The largest value of all pulleys, and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnPulley {
    /// The value, SI.
    pub value: f64,
    /// The index of the pulley in belt order.
    pub pulley: usize,
}

/// A requirement that is not met.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Failing {
    /// The slip margin is smaller than required, or it was not found.
    SlipMargin {
        /// What was found.
        found: SlipMargin,
        /// What is required.
        required: f64,
    },
    /// The speed loss of a pulley is larger than required.
    SpeedLoss {
        /// What was found.
        found: OnPulley,
        /// What is required.
        required: f64,
    },
    /// The force of the belt on a hub is larger than required.
    HubLoad {
        /// What was found, N.
        found: OnPulley,
        /// What is required, N.
        required: f64,
        /// Whether it is larger at rest than in motion.
        at_rest: bool,
    },
    /// The belt tension is larger than required.
    Tension {
        /// What was found, N.
        found: f64,
        /// What is required, N.
        required: f64,
        /// The span by its index, if it is larger there in motion than at rest.
        span: Option<usize>,
    },
}

impl CheckedCase {
    /// Whether there is a state and it meets all requirements.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.outcome.is_ok() && self.failures.is_empty()
    }
}

impl CheckedService {
    /// How many load cases do not hold.
    #[must_use]
    pub fn failing(&self) -> usize {
        self.cases.iter().filter(|case| !case.holds()).count()
    }

    /// Shares of the time and states of all cases, where every case has both.
    #[must_use]
    pub fn over_time(&self) -> Option<Vec<(f64, &CaseState)>> {
        let cases = self.service.cases.iter().zip(&self.cases);
        let cases = cases.map(|(stated, found)| {
            let state = found.outcome.as_ref().ok()?;
            Some((stated.share?, &**state))
        });
        cases.collect()
    }
}

/// Finds the steady state of a drive in each of its load cases and judges it by what is required. A case that no
/// steady state carries fails; the others are judged all the same. `progress` is called with the share of the cases
/// that are done and the name of the next.
///
/// ```
/// use beltdrive::input::DriveFile;
/// use beltdrive::{SolveOptions, check, examples};
///
/// let example = examples::find("serpentine-cases").expect("a shipped example");
/// let file = DriveFile::read(example.name, example.text, &[])?;
/// let checked = check(&file.service()?, &SolveOptions::default(), &mut |_, _| {})?;
/// assert_eq!((checked.cases.len(), checked.failing()), (3, 1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// What is asked makes no sense, whatever the drive carries ([`SolveError::is_of_statement`]).
pub fn check(
    service: &Service,
    options: &SolveOptions,
    progress: &mut dyn FnMut(f64, &str),
) -> Result<CheckedService, SolveError> {
    let count = service.cases.len() as f64;
    let mut cases = Vec::new();
    for case in &service.cases {
        progress(cases.len() as f64 / count, &case.name);
        let outcome = match judged(case, &service.given_losses, options) {
            Err(error) if error.is_of_statement() => return Err(error),
            outcome => outcome.map(Box::new),
        };
        let failures = outcome.as_ref().map_or_else(
            |_| Vec::new(),
            |found| failures(found, &service.requirements),
        );
        cases.push(CheckedCase { outcome, failures });
    }
    Ok(CheckedService {
        service: service.clone(),
        cases,
    })
}

/// The state of a load case.
pub(super) fn judged(
    case: &LoadCase,
    given: &GivenLosses,
    options: &SolveOptions,
) -> Result<CaseState, SolveError> {
    let state = solve_with_margins(&case.drive, options)?;
    Ok(case_state(&case.drive, state, given))
}

/// The slip margin of a drive alone.
pub(super) fn slip_margin(drive: &Drive, options: &SolveOptions) -> Result<SlipMargin, SolveError> {
    let drive = closed_once(drive, options)?;
    let model = model(drive.belt.kind);
    let (state, neighbour) = model.solve_loop_from(&drive, None, options)?;
    Ok(match (margin_of(&state), neighbour) {
        (SlipMargin::NotFound, Neighbour::V(neighbour)) => {
            let limit = neighbour.load_limit(options.tolerance);
            limit.map_or(SlipMargin::NotFound, |limit| {
                SlipMargin::Factor(OnPulley {
                    value: limit.factor,
                    pulley: limit.pulley,
                })
            })
        }
        (margin, _) => margin,
    })
}

/// The slip margin that a state has.
fn margin_of(state: &LoopState) -> SlipMargin {
    match &state.load_limit {
        Some(limit) => SlipMargin::Factor(OnPulley {
            value: limit.factor,
            pulley: limit.pulley,
        }),
        None if state.pulleys.iter().all(|pulley| pulley.torque == 0.0) => SlipMargin::NoLoad,
        None => SlipMargin::NotFound,
    }
}

/// What may be required of a state of a drive.
pub(super) fn case_state(drive: &Drive, state: LoopState, given: &GivenLosses) -> CaseState {
    let hub = |[x, y]: [f64; 2]| x.hypot(y);
    let all = |_: usize| true;
    let has_torque = |pulley: usize| state.pulleys[pulley].torque != 0.0;
    let is_driven = |pulley: usize| pulley != drive.driver() && has_torque(pulley);
    let no_load = !(0..state.pulleys.len()).any(has_torque);
    CaseState {
        slip_margin: margin_of(&state),
        speed_loss: match no_load {
            true => largest(&state, |pulley| pulley.speed_loss, all),
            false => largest(&state, |pulley| pulley.speed_loss, is_driven),
        },
        hub_load: largest(&state, |pulley| hub(pulley.hub_load), all),
        rest_hub_load: largest(&state, |pulley| hub(pulley.rest_hub_load), all),
        losses: losses(drive, &state, given),
        state,
    }
}

/// The largest value of the pulleys that count.
fn largest(
    state: &LoopState,
    value: impl Fn(&crate::belt_loop::PulleyState) -> f64,
    counts: impl Fn(usize) -> bool,
) -> OnPulley {
    let values = state.pulleys.iter().map(value).enumerate();
    let values = values.filter(|(pulley, _)| counts(*pulley));
    let largest = values.max_by(|(_, one), (_, other)| one.total_cmp(other));
    let (pulley, value) = largest.unwrap_or_default();
    OnPulley { value, pulley }
}

/// The requirements that a state does not meet.
fn failures(found: &CaseState, required: &Requirements) -> Vec<Failing> {
    let slip = required.smallest_slip_margin.and_then(|required| {
        let is_met = match found.slip_margin {
            SlipMargin::NoLoad => true,
            SlipMargin::Factor(margin) => margin.value >= required,
            SlipMargin::NotFound => false,
        };
        let found = found.slip_margin;
        (!is_met).then_some(Failing::SlipMargin { found, required })
    });
    let speed = required.largest_speed_loss.and_then(|required| {
        let found = found.speed_loss;
        (found.value > required).then_some(Failing::SpeedLoss { found, required })
    });
    let hub = required.largest_hub_load.and_then(|required| {
        let at_rest = found.rest_hub_load.value > found.hub_load.value;
        let found = match at_rest {
            true => found.rest_hub_load,
            false => found.hub_load,
        };
        (found.value > required).then_some(Failing::HubLoad {
            found,
            required,
            at_rest,
        })
    });
    let tension = required.largest_tension.and_then(|required| {
        let state = &found.state;
        let spans = state.spans.iter().map(|span| span.tension).enumerate();
        let rest = (None, state.rest_tension);
        let all = spans.map(|(span, tension)| (Some(span), tension));
        let largest = { all.chain([rest]) }.max_by(|(_, one), (_, other)| one.total_cmp(other));
        let (span, found) = largest.unwrap_or(rest);
        (found > required).then_some(Failing::Tension {
            found,
            required,
            span,
        })
    });
    [slip, speed, hub, tension].into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::examples;
    use crate::input::DriveFile;

    #[test]
    fn answers_go_between_threads() {
        fn is_shared<T: Send + Sync>() {}
        is_shared::<CheckedService>();
    }

    #[test]
    fn a_margin_that_was_not_found_meets_no_requirement() {
        let example = examples::find("poly-v").unwrap();
        let file = DriveFile::read(example.name, example.text, &[]).unwrap();
        let service = file.service().unwrap();
        let options = SolveOptions::default();
        let mut found = judged(&service.cases[0], &service.given_losses, &options).unwrap();
        let required = Requirements {
            smallest_slip_margin: Some(1.0),
            ..Requirements::default()
        };
        assert_eq!(failures(&found, &required), []);
        found.slip_margin = SlipMargin::NotFound;
        assert_eq!(failures(&found, &required).len(), 1);
        found.slip_margin = SlipMargin::NoLoad;
        assert_eq!(failures(&found, &required), []);
    }
}
