//! Numbers of a drive file found from measured rows, by weighted least squares.
//!
//! Each row of [`Measurements`] is a drive with measured numbers y of standard deviations σ. The free numbers p minimise
//!
//! ```text
//! S(p) = Σ ((y − f(p))/σ)²
//! ```
//!
//! where f is what the steady state of the drive of the row has. The derivatives of flat belts are exact but for rounding
//! where the numbers of a drive change with those of its file along straight lines, as nearly all do; the others and those
//! of V-belts are differences of states.
//!
//! Without standard deviations, which only a single measured quantity does without, σ² = S/(n − m) of n readings and m
//! numbers. The covariance is that of the problem linearised at the solution, (JᵀJ)⁻¹; with the standard error s of p
//! intervals are p exp(± t s/p) of positive numbers, p ± t s of others, with the 97.5 % quantile t of the normal
//! distribution, or of Student's distribution with n − m degrees of freedom where σ is estimated.
//!
//! ```
//! use beltdrive::calibrate::calibrate;
//! use beltdrive::input::{DriveFile, Measurements};
//! use beltdrive::{SolveOptions, examples};
//!
//! let example = examples::find("flat-bench")?;
//! let file = DriveFile::read(example.name, example.text, &[])?;
//! let data = Measurements::read("flat-bench.csv", examples::FLAT_BENCH, &file)?;
//! let keys = file.free_keys(&[])?;
//! let found = calibrate(&keys, &data, &SolveOptions::default(), &mut |_, _| {})?;
//! let stiffness = &found.parameters[0];
//! assert_eq!(stiffness.key.path(), "belt.axial_stiffness");
//! // The belt of these rows was made up with 90 kN.
//! let [low, high] = stiffness.interval.expect("the rows determine it");
//! assert!(low < 90e3 && 90e3 < high);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod identifiability;
mod least_squares;
mod model;
mod quantile;

use super::members::Varied;
use crate::SolveOptions;
use crate::input::{FileKey, Measurements};
use crate::results::measured::Measured;
pub use identifiability::Ambiguity;
use least_squares::{Fit, fit};
use model::Model;
pub use model::RowFailure;
use quantile::{normal_quantile, student_quantile};

/// What measured rows say of a belt.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Calibration {
    /// The free numbers, in the order asked for.
    pub parameters: Vec<Parameter>,
    /// Their correlations; `None` if the rows leave a combination of them open.
    pub correlation: Option<Vec<Vec<f64>>>,
    /// Singular values of the derivatives of all readings over σ with respect to relative changes of the
    /// parameters, from large to small.
    pub singular_values: Vec<f64>,
    /// What the rows cannot tell apart.
    pub ambiguities: Vec<Ambiguity>,
    /// Every reading beside the model, by rows.
    pub residuals: Vec<Residual>,
    /// Sum of squares S of all readings over σ; without standard deviations in the units of the quantity, SI.
    pub sum_of_squares: f64,
    /// Readings less parameters.
    pub degrees_of_freedom: usize,
    /// Where the standard deviations are from.
    pub scatter: Scatter,
    /// Steps of the Levenberg–Marquardt method.
    pub steps: usize,
    /// Steady states that it took; exact derivatives take none.
    pub states: usize,
}

/// A number that was found.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Parameter {
    /// Where it stands in the drive file.
    pub key: FileKey,
    /// The value from which it was sought, SI.
    pub start: f64,
    /// Its value, SI.
    pub value: f64,
    /// Its standard error, SI; `None` if the rows do not determine it.
    pub standard_error: Option<f64>,
    /// Its 95 % confidence interval, SI; `None` as the standard error.
    pub interval: Option<[f64; 2]>,
}

/// A reading beside the model.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Residual {
    /// Line of the row in its file.
    pub line: usize,
    /// What was measured.
    pub measured: Measured,
    /// The reading, SI.
    pub value: f64,
    /// What the model has, SI.
    pub model: f64,
    /// Standard deviation of the reading, SI; estimated if the rows have none, and `None` if that is not possible.
    pub deviation: Option<f64>,
}

/// Where the standard deviations of readings are from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scatter {
    /// The file states them. The reduced sum of squares S/(n − m), which is about 1 if they are right, and the range
    /// in which it then lies with a probability of 95 %; `None` without degrees of freedom.
    Stated(Option<(f64, [f64; 2])>),
    /// One for all readings, estimated from how far the model is from them, SI; `None` without degrees of
    /// freedom.
    Estimated(Option<f64>),
}

/// Why there is no calibration.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A number that is to be found is set in every row.
    #[error("`{path}` cannot be found, because a column sets it in every row")]
    Set {
        /// Where it stands in the drive file.
        path: String,
    },
    /// There are fewer readings than parameters.
    #[error("{readings} readings cannot determine {parameters} numbers")]
    TooFew {
        /// Number of readings.
        readings: usize,
        /// Number of free numbers.
        parameters: usize,
    },
    /// A row has no steady state at the values of the drive file, from which the search begins.
    #[error(
        "the row in line {} has no answer at the values of the drive file, from which the search begins: {}",
        .0.line, .0.reason
    )]
    Start(RowFailure),
    /// The search did not end.
    #[error("no least sum of squares was found in {steps} steps: {reason}")]
    NotConverged {
        /// Number of steps.
        steps: usize,
        /// Why the last one failed.
        reason: String,
    },
}

/// Finds the numbers `keys` of the drive file from measured rows. The search begins at the values of the file.
///
/// `progress` is told the share of the work that is done, as far as that is known, and what is being done.
///
/// # Errors
/// [`Error`].
pub fn calibrate(
    keys: &[FileKey],
    data: &Measurements,
    options: &SolveOptions,
    progress: &mut dyn FnMut(f64, &str),
) -> Result<Calibration, Error> {
    if let Some(key) = keys.iter().find(|key| data.set.contains(key)) {
        let path = key.path().to_owned();
        return Err(Error::Set { path });
    }
    let varied: Vec<_> = keys.iter().cloned().map(Varied::Key).collect();
    let model = Model::new(keys, &varied, data, options);
    let (readings, parameters) = (model.readings(), keys.len());
    if readings < parameters {
        return Err(Error::TooFew {
            readings,
            parameters,
        });
    }
    let fit = fit(&model, progress)?;
    Ok(calibration(&model, data, fit))
}

/// What there is to tell of a fit.
fn calibration(model: &Model<'_>, data: &Measurements, fit: Fit) -> Calibration {
    let sum_of_squares = fit.sum_of_squares();
    let degrees_of_freedom = model.readings() - model.keys().len();
    let freedom = degrees_of_freedom as f64;
    let reduced = (degrees_of_freedom > 0).then(|| sum_of_squares / freedom);
    let (scale, quantile, scatter) = match data.has_deviations {
        true => {
            let expected = reduced.map(|reduced| (reduced, quantile::reduced_range(freedom)));
            (Some(1.0), normal_quantile(), Scatter::Stated(expected))
        }
        false => {
            let estimated = reduced.map(f64::sqrt);
            let quantile = student_quantile(degrees_of_freedom);
            (estimated, quantile, Scatter::Estimated(estimated))
        }
    };
    let spectrum = identifiability::Spectrum::new(&fit, scale);
    let errors = spectrum.relative_errors();
    let values = model.values(&fit.place);
    let parameters = model.keys().iter().enumerate().map(|(index, key)| {
        let relative = errors[index];
        let standard_error = relative
            .zip(scale)
            .map(|(error, scale)| error * scale * model.scale(index, &fit.place));
        let value = values[index];
        let interval = standard_error.map(|error| {
            [-1.0, 1.0].map(|side| match key.is_positive() {
                true => value * (side * quantile * error / value).exp(),
                false => value + side * quantile * error,
            })
        });
        Parameter {
            key: key.clone(),
            start: model.start(index),
            value,
            standard_error,
            interval,
        }
    });
    let residuals = model
        .told(&fit.predictions)
        .map(|(line, index, reading, model)| Residual {
            line,
            measured: data.measured[index].clone(),
            value: reading.value,
            model,
            deviation: reading.deviation.or(scale),
        });
    Calibration {
        parameters: parameters.collect(),
        correlation: spectrum.correlation(),
        ambiguities: spectrum.ambiguities(model.keys()),
        singular_values: spectrum.singular_values(),
        residuals: residuals.collect(),
        sum_of_squares,
        degrees_of_freedom,
        scatter,
        steps: fit.steps,
        states: fit.states,
    }
}
