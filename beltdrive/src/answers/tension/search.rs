//! The search for the smallest tension that has a margin.

use super::setting::Setting;
use crate::answers::check::{SlipMargin, slip_margin};
use crate::{Drive, SolveError, SolveOptions};

/// Most states of one search: a bracket of any width that is halved ends below rounding within these.
const STATES: usize = 100;

/// Largest step of the search as a factor on what is varied: it only bounds an extrapolation.
const LARGEST_STEP: f64 = 8.0;

/// Step where nothing is known but its direction, as a factor.
const STEP: f64 = 2.0;

/// What a search for a margin is made of.
#[derive(Clone, Copy)]
pub(super) struct Search<'o> {
    pub(super) setting: Setting,
    /// The asked margin.
    pub(super) margin: f64,
    /// By how much the margin found may be larger, relative.
    pub(super) accuracy: f64,
    pub(super) options: &'o SolveOptions,
}

/// A drive at some tension.
pub(super) enum Judged {
    /// A pulley slips grossly at this factor on all torques.
    Slips(f64),
    /// No pulley has a torque.
    Idle,
    /// There is no steady state, since the belt is too slack.
    Loose(SolveError),
}

/// The smallest value of what is varied.
pub(super) struct Found {
    pub(super) value: f64,
    /// The load case that decides.
    pub(super) case: usize,
    /// The smallest margin of all cases where the search began, if there is a state with a load.
    pub(super) margin_at_start: Option<f64>,
    /// Why there is no state below it, if it is this that decides.
    pub(super) ends_below: Option<SolveError>,
}

/// How far a drive is from slip.
pub(super) fn judge(drive: &Drive, options: &SolveOptions) -> Result<Judged, SolveError> {
    match slip_margin(drive, options) {
        Ok(SlipMargin::Factor(margin)) => Ok(Judged::Slips(margin.value)),
        Ok(SlipMargin::NoLoad) => Ok(Judged::Idle),
        Ok(SlipMargin::NotFound) => Err(SolveError::NotFound {
            what: "load at which a pulley slips",
        }),
        Err(
            SolveError::GrossSlip { load_factor, .. } | SolveError::Overloaded { load_factor, .. },
        ) => Ok(Judged::Slips(load_factor)),
        Err(
            error @ (SolveError::Slack { .. }
            | SolveError::LiftsOff { .. }
            | SolveError::NoEquilibrium { .. }
            | SolveError::TensionerBeyondTravel { .. }
            | SolveError::Stalls { .. }),
        ) => Ok(Judged::Loose(error)),
        Err(error) => Err(error),
    }
}

/// An end of a bracket: the logarithm of what is varied, and that of the margin over the asked one.
type End = (f64, f64);

impl Search<'_> {
    /// The smallest value with which all drives have the margin, sought from a value. The drives are the same one
    /// in its load cases.
    pub(super) fn of_all(&self, drives: &[Drive], start: f64) -> Result<Found, SolveError> {
        let mut found: Option<Found> = None;
        let mut value = start;
        let mut margin_at_start = None;
        loop {
            let mut worst = (f64::INFINITY, 0);
            for (case, drive) in drives.iter().enumerate() {
                let is_done = found.as_ref().is_some_and(|found| found.case == case);
                if !is_done {
                    let (excess, _) = self.excess(drive, value)?;
                    worst = if excess < worst.0 {
                        (excess, case)
                    } else {
                        worst
                    };
                }
            }
            let (excess, case) = worst;
            match found {
                Some(found) if excess >= 0.0 => {
                    return Ok(Found {
                        margin_at_start,
                        ..found
                    });
                }
                Some(_) => {}
                None => margin_at_start = excess.is_finite().then(|| self.margin * excess.exp()),
            }
            let next = self.of_one(&drives[case], case, (value, excess))?;
            value = next.value;
            found = Some(next);
        }
    }

    /// The logarithm of the margin over the asked one, and why there is no state if the belt is too slack.
    fn excess(&self, drive: &Drive, value: f64) -> Result<(f64, Option<SolveError>), SolveError> {
        let judged = judge(&self.setting.applied(drive, value), self.options)?;
        Ok(match judged {
            Judged::Slips(factor) => ((factor / self.margin).ln(), None),
            Judged::Idle => (f64::INFINITY, None),
            Judged::Loose(error) => (f64::NEG_INFINITY, Some(error)),
        })
    }

    /// The tension that centrifugal force takes up; what is varied counts from there.
    fn taken_up(&self, drive: &Drive) -> f64 {
        match self.setting {
            Setting::SetupTension => drive.belt.mass_per_length * drive.rim_speed().powi(2),
            Setting::Preload { .. } => 0.0,
        }
    }

    /// The smallest value with which one drive has the margin, from a value and the excess there.
    fn of_one(
        &self,
        drive: &Drive,
        case: usize,
        (start, at_start): (f64, f64),
    ) -> Result<Found, SolveError> {
        let taken_up = self.taken_up(drive);
        let value_of = |place: f64| taken_up + place.exp();
        let aim = 0.5 * self.accuracy;
        let mut here: End = ((start - taken_up).ln(), at_start);
        // A start below what centrifugal force takes up is none.
        if !here.0.is_finite() {
            here = (start.ln(), f64::NAN);
        }
        if here.1.is_nan() {
            here.1 = self.excess(drive, value_of(here.0))?.0;
        }
        let (mut low, mut high): (Option<End>, Option<End>) = (None, None);
        let (mut before, mut ends_below): (Option<End>, _) = (None, None);
        for _ in 0..STATES {
            let (place, excess) = here;
            if (0.0..=self.accuracy).contains(&excess) {
                let value = value_of(place);
                return Ok(Found {
                    value,
                    case,
                    margin_at_start: None,
                    ends_below: None,
                });
            }
            if excess < 0.0 {
                low = Some(here);
            } else {
                high = Some(here);
            }
            if let (Some(low), Some(high)) = (low, high)
                && high.0 - low.0 <= aim
            {
                return Ok(Found {
                    value: value_of(high.0),
                    case,
                    margin_at_start: None,
                    ends_below,
                });
            }
            let next = next(here, before, [low, high], aim);
            before = Some(here);
            let (excess, why) = self.excess(drive, value_of(next))?;
            ends_below = why.or(ends_below.filter(|_| excess >= 0.0));
            here = (next, excess);
        }
        Err(SolveError::NotFound {
            what: "setup tension",
        })
    }
}

/// Where to look next: where the excess would be at its aim by the secant of the last two places, or in proportion
/// from one; within the bracket, and in its middle where they do not say.
fn next(here: End, before: Option<End>, bracket: [Option<End>; 2], aim: f64) -> f64 {
    let secant = before.map(|before| (here.1 - before.1) / (here.0 - before.0));
    // The limit grows about in proportion.
    let slope = secant.filter(|slope| slope.is_finite() && *slope > 0.1 && *slope < 10.0);
    let asked = here.0 + (aim - here.1) / slope.unwrap_or(1.0);
    match bracket {
        [Some(low), Some(high)] => {
            let margin = 1e-3 * (high.0 - low.0);
            match asked > low.0 + margin && asked < high.0 - margin {
                true => asked,
                false => f64::midpoint(low.0, high.0),
            }
        }
        _ if here.1.is_finite() => {
            let most = LARGEST_STEP.ln();
            asked.clamp(here.0 - most, here.0 + most)
        }
        _ => here.0 - STEP.ln().copysign(here.1),
    }
}
