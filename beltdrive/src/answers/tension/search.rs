//! The search for the smallest tension that has a margin.

use super::setting::Setting;
use crate::answers::check::{SlipMargin, slip_margin};
use crate::model::model;
use crate::{Closure, Drive, SolveError, SolveOptions};

/// Most states of one search: a bracket of any width that is halved ends below rounding within these.
const STATES: usize = 100;

/// Largest step of the search as a factor on what is varied: it only bounds an extrapolation.
const LARGEST_STEP: f64 = 8.0;

/// Step where nothing is known but its direction, as a factor.
const STEP: f64 = 2.0;

/// So many places at which the margin is not found are left in a row, each for the middle between it and the last one.
const MISSED: usize = 4;

/// A belt whose tension is above that at which it lifts off by no more than this share is about to lift off: nearer, by
/// 1e-5, states of two random loops were not found.
const NEAREST: f64 = 1e-4;

/// A bracket over which the margin more than doubles is a jump once it is no wider than this, relative: no margin grows as
/// its 700th power. Of the SPB belt that ships as an example, with μ = 0.6, halving the jump to 1e-6 took twice as long.
const JUMP: f64 = 1e-3;

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
    /// By how much it may be larger than the smallest one, relative.
    pub(super) accuracy: f64,
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
        let mut value = self.borne(drives, start);
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

    /// A value no higher than a first one with which the grooves bear the belt at rest, if there is one.
    fn borne(&self, drives: &[Drive], start: f64) -> f64 {
        let is_borne = |value: &f64| {
            drives.iter().all(|drive| {
                let drive = self.setting.applied(drive, *value);
                let at_rest = model(drive.belt.kind).at_rest(&drive, self.options);
                !matches!(at_rest, Err(SolveError::PressedThrough { .. }))
            })
        };
        let lower = std::iter::successors(Some(start), |value| Some(value / STEP));
        lower.take(STATES).find(is_borne).unwrap_or(start)
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

    /// The value at which a belt between fixed centres lifts off without load; what is varied counts from there. A belt
    /// that lifts off lies on its pitch line with a tractive tension of zero, at rest one of its length sinks into its
    /// grooves:
    ///
    /// ```text
    /// EA ε = m v²/(1 + ε)          L = L_pitch/(1 + ε)
    /// ```
    fn lifts_off(&self, drive: &Drive) -> f64 {
        if drive.tensioner().is_some() {
            return 0.0;
        }
        let belt = &drive.belt;
        let centrifugal = belt.mass_per_length * drive.rim_speed().powi(2);
        let strain = 0.5 * ((1.0 + 4.0 * centrifugal / belt.axial_stiffness).sqrt() - 1.0);
        let layout = drive.layout(drive.start_coordinate());
        let at_rest = layout.ok().and_then(|layout| {
            let mut drive = drive.clone();
            drive.closure = Closure::UnstretchedLength(layout.length() / (1.0 + strain));
            model(belt.kind).at_rest(&drive, self.options).ok()
        });
        at_rest.map_or(0.0, |rest| rest.tension)
    }

    /// The excess at the last of two places or, where it is not found there, at one nearer to the first, and that place.
    fn near(
        &self,
        drive: &Drive,
        [from, asked]: [f64; 2],
        value_of: impl Fn(f64) -> f64,
    ) -> Result<(f64, (f64, Option<SolveError>)), SolveError> {
        let mut place = asked;
        let mut found = self.excess(drive, value_of(place));
        for _ in 0..MISSED {
            if found.is_ok() {
                break;
            }
            place = f64::midpoint(place, from);
            found = self.excess(drive, value_of(place));
        }
        found.map(|found| (place, found))
    }

    /// The smallest value with which one drive has the margin, from a value and the excess there.
    fn of_one(
        &self,
        drive: &Drive,
        case: usize,
        (start, at_start): (f64, f64),
    ) -> Result<Found, SolveError> {
        let lifts_off = self.lifts_off(drive);
        let value_of = |place: f64| lifts_off + place.exp();
        let aim = 0.5 * self.accuracy;
        let found = |place, ends_below| Found {
            value: value_of(place),
            accuracy: self.accuracy,
            case,
            margin_at_start: None,
            ends_below,
        };
        let mut here: End = ((start - lifts_off).ln(), at_start);
        // A start below lift-off is none.
        if !here.0.is_finite() {
            here = (start.ln(), f64::NAN);
        }
        if here.1.is_nan() {
            here.1 = self.excess(drive, value_of(here.0))?.0;
        }
        let lowest = (NEAREST * lifts_off).ln();
        let (mut low, mut high): (Option<End>, Option<End>) = (None, None);
        let (mut before, mut ends_below): (Option<End>, _) = (None, None);
        for _ in 0..STATES {
            let (place, excess) = here;
            if (0.0..=self.accuracy).contains(&excess) {
                return Ok(found(place, None));
            }
            if excess > 0.0 && place <= lowest {
                let below = self.excess(drive, (1.0 - NEAREST) * lifts_off);
                return Ok(found(place, below.ok().and_then(|(_, why)| why)));
            }
            if excess < 0.0 {
                low = Some(here);
            } else {
                high = Some(here);
            }
            if let (Some(low), Some(high)) = (low, high) {
                let width = high.0 - low.0;
                if width <= aim {
                    return Ok(found(high.0, ends_below));
                }
                if width <= JUMP && low.1.is_finite() && high.1 - low.1 > 2_f64.ln() {
                    let accuracy = width.max(self.accuracy);
                    return Ok(Found {
                        accuracy,
                        ..found(high.0, ends_below)
                    });
                }
            }
            let asked = next(here, before, [low, high], aim).max(lowest);
            let (next, (excess, why)) = self.near(drive, [place, asked], value_of)?;
            before = Some(here);
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
