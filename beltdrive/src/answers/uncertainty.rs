//! How far an answer may be from its value, because numbers of the drive file are not known exactly.
//!
//! By linearisation at the solution: with the standard deviations `σ_i` of independent inputs `x_i` and the expected
//! values `m_i` beside the stated `x_i`,
//!
//! ```text
//! mean = y + Σ y_i (m_i − x_i)      σ² = Σ (y_i σ_i)²      y_i = ∂y/∂x_i
//! ```
//!
//! (JCGM 100:2008, Evaluation of measurement data, eq. 10), and the band mean ± 1.96 σ, which holds 95 % where y is
//! normally distributed. By sampling: the same answer for a Latin hypercube of inputs (`McKay`, Beckman and Conover
//! 1979), and its 2.5 % and 97.5 % quantiles, which need no linearisation (JCGM 101:2008).

mod propagation;

use super::check::{CheckedService, SlipMargin, check};
use super::rating::{Rating, RatingEnd, RatingQuestion, rating};
use super::tension::{Setup, smallest_tension};
use crate::SolveOptions;
use crate::input::{Diagnostic, DriveFile, Uncertain};
use propagation::{Propagation, QUANTILES};
use statrs::distribution::{Continuous, ContinuousCDF, Normal};

/// How far an answer may be from its value.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Uncertainty {
    /// The numbers that are not known exactly.
    pub inputs: Vec<Uncertain>,
    /// How many samples were drawn; 0 without sampling.
    pub samples: usize,
    /// How many of them are no drive: a number is out of its range, or the file contradicts itself.
    pub no_drive: usize,
    /// What was found for each number of the answer.
    pub bands: Vec<Band>,
    /// The share of the samples that are a drive in which each load case holds; none without sampling.
    pub holds: Vec<f64>,
}

/// How far a number may be from its value.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Band {
    /// Which number.
    pub number: Number,
    /// The index of its load case; `None` for one of all of them.
    pub case: Option<usize>,
    /// Its value with the numbers of the file, SI.
    pub value: f64,
    /// By how much the number changes with one standard deviation of each input, SI; `None` where no difference was found.
    pub effects: Vec<Option<f64>>,
    /// By linearisation; `None` without one of the effects.
    pub linear: Option<Distribution>,
    /// By sampling; `None` without, and with fewer than two samples that have the number.
    pub sampled: Option<Sampled>,
}

/// Where a number lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distribution {
    /// Its expected value, SI.
    pub mean: f64,
    /// Its standard deviation, SI.
    pub standard_deviation: f64,
    /// Between these values it lies with a probability of 95 %, SI.
    pub interval: [f64; 2],
}

/// Where the samples of a number lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled {
    /// How many samples have the number; those without a steady state have none.
    pub count: usize,
    /// Where they lie.
    pub distribution: Distribution,
}

/// A number of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Number {
    /// The slip margin.
    SlipMargin,
    /// The largest speed loss.
    SpeedLoss,
    /// The efficiency.
    Efficiency,
    /// The power lost between the pulleys, W.
    PowerLoss,
    /// The largest hub load of the running drive, N.
    HubLoad,
    /// The largest hub load at rest, N.
    RestHubLoad,
    /// The smallest setup tension, N.
    SetupTension,
    /// The speed of the driver at which it has the largest power, rad/s.
    BestSpeed,
    /// The largest torque of the driver there, N·m.
    BestTorque,
    /// The largest power of the driver there, W.
    BestPower,
    /// The largest torque of the driver at the speed of the drive file, N·m.
    StatedTorque,
    /// The largest power of the driver there, W.
    StatedPower,
    /// The speed of the driver at which the belt lifts off, rad/s.
    LiftOffSpeed,
}

impl Band {
    /// Whether linearisation and sampling differ by more than the number of samples explains.
    ///
    /// The standard error of a quantile q of n samples is √(p (1 − p)/n) over the density at q, which is taken for
    /// normal; a Latin hypercube has a smaller one.
    #[must_use]
    pub fn disagrees(&self) -> bool {
        let (Some(linear), Some(sampled)) = (self.linear, self.sampled) else {
            return false;
        };
        let (normal, [p, _]) = (Normal::standard(), QUANTILES);
        let density = normal.pdf(normal.inverse_cdf(p));
        let scatter = (p * (1.0 - p) / sampled.count as f64).sqrt() / density;
        // A tenth of a standard deviation is of no use to know.
        let allowed = (3.0 * scatter).max(0.1) * linear.standard_deviation;
        let ends = linear.interval.iter().zip(sampled.distribution.interval);
        { ends }.any(|(one, other)| (one - other).abs() > allowed)
    }

    /// The share of each input in the variance by linearisation; none without an effect.
    #[must_use]
    pub fn shares(&self) -> Vec<f64> {
        let squares = || self.effects.iter().flatten().map(|effect| effect * effect);
        let variance: f64 = squares().sum();
        match self.linear {
            Some(_) if variance > 0.0 => squares().map(|square| square / variance).collect(),
            _ => Vec::new(),
        }
    }
}

/// The numbers of an answer with one choice of the inputs.
#[derive(Clone)]
struct Found {
    /// With the index of their load case, and nothing without a state.
    numbers: Vec<(Number, Option<usize>, Option<f64>)>,
    /// Whether each load case holds.
    holds: Vec<bool>,
}

/// How far the numbers of [`check`] may be from their values, by `[uncertainty]` of the file and, unless `samples` is
/// 0, by so many samples. `progress` is called with the share of the answers that are found.
///
/// ```
/// use beltdrive::input::DriveFile;
/// use beltdrive::uncertainty::{Number, of_check};
/// use beltdrive::{SolveOptions, check, examples};
///
/// let example = examples::find("serpentine-cases").expect("a shipped example");
/// let spread = ["uncertainty.friction.coefficient = 10 %".to_owned()];
/// let file = DriveFile::read(example.name, example.text, &spread)?;
/// let options = SolveOptions::default();
/// let checked = check(&file.service()?, &options, &mut |_, _| {})?;
/// let found = of_check(&file, &checked, 100, &options, &mut |_, _| {})?;
/// let margin = &found.bands[0];
/// assert_eq!((margin.number, margin.case), (Number::SlipMargin, Some(0)));
/// let [low, high] = margin.linear.expect("derivatives").interval;
/// assert!(low < margin.value && margin.value < high);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The table `[uncertainty]` is at fault.
pub fn of_check(
    file: &DriveFile,
    checked: &CheckedService,
    samples: usize,
    options: &SolveOptions,
    progress: &mut (dyn FnMut(f64, &str) + Send),
) -> Result<Uncertainty, Diagnostic> {
    let answer = |file: &DriveFile| {
        let service = file.service().ok()?;
        let checked = check(&service, options, &mut |_, _| {}).ok()?;
        Some(found_by_check(&checked))
    };
    let propagation = Propagation::new(file, &answer, samples)?;
    Ok(propagation.of(&found_by_check(checked), progress))
}

/// How far the smallest setup tension that [`tension`](crate::tension()) finds may be from its value; otherwise as
/// [`of_check`].
///
/// # Errors
/// The table `[uncertainty]` is at fault.
pub fn of_tension(
    file: &DriveFile,
    setup: &Setup,
    samples: usize,
    options: &SolveOptions,
    progress: &mut (dyn FnMut(f64, &str) + Send),
) -> Result<Uncertainty, Diagnostic> {
    let found = |tension: Option<f64>| Found {
        numbers: vec![(Number::SetupTension, None, tension)],
        holds: Vec::new(),
    };
    let answer = |file: &DriveFile| {
        let service = file.service().ok()?;
        Some(found(
            smallest_tension(&service, setup.question, options).ok(),
        ))
    };
    let propagation = Propagation::new(file, &answer, samples)?;
    Ok(propagation.of(&found(Some(setup.tension)), progress))
}

/// How far what [`rating`](crate::rating()) finds may be from its value: the largest power with its speed and torque, the
/// load at the speed of the file, and the speed of lift-off; otherwise as [`of_check`].
///
/// # Errors
/// The table `[uncertainty]` is at fault.
pub fn of_rating(
    file: &DriveFile,
    rated: &Rating,
    question: RatingQuestion,
    samples: usize,
    options: &SolveOptions,
    progress: &mut (dyn FnMut(f64, &str) + Send),
) -> Result<Uncertainty, Diagnostic> {
    let answer = |file: &DriveFile| {
        let drive = file.drive().ok()?;
        let rated = rating(&drive, question, options, &mut |_, _| {});
        Some(found_by_rating(rated.ok().as_ref()))
    };
    let propagation = Propagation::new(file, &answer, samples)?;
    Ok(propagation.of(&found_by_rating(Some(rated)), progress))
}

/// What a rating says that has a band.
fn found_by_rating(rated: Option<&Rating>) -> Found {
    let best = rated.map(|rated| &rated.optimum);
    let stated = rated.and_then(|rated| rated.stated.as_ref().ok());
    let lift_off = rated.and_then(|rated| match rated.end {
        RatingEnd::LiftsOff { speed } => Some(speed),
        _ => None,
    });
    let numbers = [
        (Number::BestSpeed, best.map(|load| load.speed)),
        (Number::BestTorque, best.map(|load| load.torque)),
        (Number::BestPower, best.map(|load| load.power)),
        (Number::StatedTorque, stated.map(|load| load.torque)),
        (Number::StatedPower, stated.map(|load| load.power)),
        (Number::LiftOffSpeed, lift_off),
    ];
    Found {
        numbers: { numbers }
            .map(|(number, value)| (number, None, value))
            .to_vec(),
        holds: Vec::new(),
    }
}

/// What a check says that has a band.
fn found_by_check(checked: &CheckedService) -> Found {
    let mut numbers = Vec::new();
    for (case, found) in checked.cases.iter().enumerate() {
        let state = found.outcome.as_deref().ok();
        let of = |value: fn(&crate::CaseState) -> f64| state.map(value);
        let margin = state.and_then(|found| match found.slip_margin {
            SlipMargin::Factor(margin) => Some(margin.value),
            SlipMargin::NoLoad | SlipMargin::NotFound => None,
        });
        let of_case = [
            (Number::SlipMargin, margin),
            (Number::SpeedLoss, of(|found| found.speed_loss.value)),
            (
                Number::Efficiency,
                state.and_then(|found| found.state.efficiency),
            ),
            (Number::PowerLoss, of(|found| found.losses.total)),
            (Number::HubLoad, of(|found| found.hub_load.value)),
            (Number::RestHubLoad, of(|found| found.rest_hub_load.value)),
        ];
        numbers.extend(of_case.map(|(number, value)| (number, Some(case), value)));
    }
    Found {
        numbers,
        holds: checked
            .cases
            .iter()
            .map(super::check::CheckedCase::holds)
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_go_between_threads() {
        fn is_shared<T: Send + Sync>() {}
        is_shared::<Uncertainty>();
    }
}
