//! What to build: the values of free numbers and the choices that make a drive best within its limits.

mod least_distance;
mod local;
mod problem;
mod programme;
mod search;
mod starts;

pub use problem::{DesignLimit, LimitPlace};

use super::check::{CheckedService, check};
use super::members::Refusal;
use super::shares::each;
use crate::input::{DesignQuestion, Diagnostic, DriveFile};
use crate::{BeltKind, SolveError, SolveOptions};
use problem::Problem;
use search::Accuracy;
use starts::starts;
use std::sync::Mutex;

/// How accurately a design is found.
#[derive(Clone, Copy)]
struct Precision {
    /// As [`Problem::clearance`].
    clearance: f64,
    /// Step of differences, as a share of the smaller one of a number and of its range.
    difference: f64,
    /// Relative error of slopes by such differences.
    slopes: f64,
    search: Accuracy,
}

/// Flat belts are solved to about 1e-13: central differences then err by 1e-10 with this step, and what a limit is kept
/// clear of is far above both.
const OF_FLAT: Precision = Precision {
    clearance: 1e-8,
    difference: 1e-5,
    slopes: 1e-6,
    search: Accuracy {
        settled: 1e-9,
        noise: 1e-12,
    },
};

/// The load limits of V-belts are known to about 1e-4, but repeat to about 1e-8 from a drive to its neighbours:
/// differences over a three-thousandth err by a thousandth at most.
const OF_V: Precision = Precision {
    clearance: 1e-4,
    difference: 3e-3,
    slopes: 1e-3,
    search: Accuracy {
        settled: 1e-5,
        noise: 1e-7,
    },
};

/// The best drive within the limits of a design, or the one that misses them least.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Designed {
    /// What was asked.
    pub question: DesignQuestion,
    /// Whether all limits hold.
    pub is_feasible: bool,
    /// The free numbers, SI, in the order of the question.
    pub values: Vec<f64>,
    /// Which value of each choice was taken, by its index.
    pub chosen: Vec<usize>,
    /// What was made small, SI; `None` where not every load case has a steady state.
    pub objective: Option<f64>,
    /// The limits that decide: those that the best drive has reached, or, if it misses some, those in conflict.
    pub limits: Vec<DecidingLimit>,
    /// How well the first-order conditions of an optimum hold: the largest component of the gradient of the Lagrangian
    /// over the largest of the objective, each per range of a free number.
    pub residual: f64,
    /// Relative error of the values: by about this share of it every limit is kept clear of.
    pub accuracy: f64,
    /// Relative error of the prices, from the differences of which they are made.
    pub price_error: f64,
    /// Free numbers that change neither what is made small nor any limit, by their indices.
    pub idle: Vec<usize>,
    /// The combinations of choices that were tried, in their order.
    pub combinations: Vec<Combination>,
    /// The drive file with the values found.
    pub file: DriveFile,
    /// The drive so designed in all load cases, judged by the requirements of its file.
    pub checked: CheckedService,
    /// How many drives were judged.
    pub drives: usize,
}

/// A limit that decides a design.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct DecidingLimit {
    /// The limit.
    pub limit: DesignLimit,
    /// Where it is met.
    pub places: Vec<LimitPlace>,
    /// The value that is allowed, SI.
    pub allowed: f64,
    /// The value there, SI.
    pub found: f64,
    /// Its price: by how much what is made small grows with the allowed value, both SI. If limits are in conflict, by how
    /// much the share by which they are missed grows with the allowed value.
    pub price: f64,
}

/// What came of a combination of choices.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Combination {
    /// The value of each choice, by its index.
    pub chosen: Vec<usize>,
    /// The least that was found, SI, or why there is none.
    pub outcome: Result<f64, Unfit>,
}

/// Why a combination of choices does not do.
#[derive(Clone, Debug)]
pub enum Unfit {
    /// A limit is missed by this share of it at least.
    Misses(f64),
    /// No drive that was tried has a steady state; why the last one has none.
    NoState(Box<Refusal>),
}

/// Why there is no design.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DesignError {
    /// The drive file is at fault.
    #[error(transparent)]
    Input(#[from] Box<Diagnostic>),
    /// No drive that was tried has a steady state.
    #[error("no drive that was tried has a steady state; the last one: {0}")]
    NoState(Box<Refusal>),
}

/// Finds the values of the free numbers and the choices with which a drive is best: `question.objective` is smallest, all
/// requirements of the file hold in all load cases, every load case has a steady state, the free numbers stay within
/// their bounds, and no pulley is smaller than its belt section allows.
///
/// Every combination of choices is searched by itself, in the order of the file, the last choice changing first. Each
/// search begins at the best of a number of places spread over the ranges and goes on by sequential quadratic programming
/// with derivatives by differences; the best end counts. A limit holds with a clearance of 1e-8 of it with flat
/// belts and 1e-4 with V-belts, so that errors do not break it. If no combination meets all limits, the answer is the
/// drive that misses them least, by the largest share of a limit. `progress` is called with the share of the combinations
/// that are done.
///
/// ```
/// use beltdrive::input::DriveFile;
/// use beltdrive::{SolveOptions, design, examples};
///
/// let example = examples::find("back-side-idler").expect("a shipped example");
/// let text = example.text.to_owned()
///     + "\n[requirements]\nsmallest_slip_margin = 2\n"
///     + "[design]\nminimise = \"load.setup_tension\"\n[design.free]\nload.setup_tension = [\"100 N\", \"1 kN\"]";
/// let file = DriveFile::read(example.name, &text, &[])?;
/// let found = design(&file, &file.design()?, &SolveOptions::default(), &mut |_, _| {})?;
/// assert!((found.values[0] - 227.324).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The drive file is at fault, or no drive that was tried has a steady state.
pub fn design(
    file: &DriveFile,
    question: &DesignQuestion,
    options: &SolveOptions,
    progress: &mut (dyn FnMut(f64, &str) + Send),
) -> Result<Designed, DesignError> {
    file.drive().map_err(Box::new)?;
    let count = question.combinations();
    let done = Mutex::new((0, progress));
    let found = each(count, |index| {
        let chosen = combination(question, index);
        let found = search_in(file, question, &chosen, options);
        if let Ok(mut done) = done.lock() {
            done.0 += 1;
            let share = f64::from(done.0) / count as f64;
            (done.1)(share, "combinations");
        }
        (chosen, found)
    });
    let mut best: Option<(Found, Vec<usize>)> = None;
    let (mut combinations, mut drives, mut refusal) = (Vec::new(), 0, None);
    for (chosen, (found, tried)) in found {
        drives += tried;
        let outcome = match &found {
            Ok(found) => match found.missed {
                Some(missed) => Err(Unfit::Misses(missed)),
                None => Ok(found.objective.unwrap_or(f64::NAN)),
            },
            Err(why) => {
                refusal = Some(why.clone());
                Err(Unfit::NoState(why.clone()))
            }
        };
        combinations.push(Combination {
            chosen: chosen.clone(),
            outcome,
        });
        if let Ok(found) = found
            && best
                .as_ref()
                .is_none_or(|(best, _)| found.is_better_than(best))
        {
            best = Some((found, chosen));
        }
    }
    let Some((found, chosen)) = best else {
        let none = || unreachable!("there is at least one combination");
        return Err(DesignError::NoState(refusal.unwrap_or_else(none)));
    };
    let file = file
        .chosen(&question.choices, &chosen)
        .designed(&question.free, &found.values);
    let service = file.service().map_err(Box::new)?;
    let checked = check(&service, options, &mut |_, _| {})
        .map_err(|error| DesignError::NoState(Box::new(error.into())))?;
    Ok(Designed {
        question: question.clone(),
        is_feasible: found.missed.is_none(),
        values: found.values,
        chosen,
        objective: found.objective,
        limits: found.limits,
        residual: found.residual,
        accuracy: found.precision.clearance,
        price_error: found.precision.slopes,
        idle: found.idle,
        combinations,
        file,
        checked,
        drives,
    })
}

/// The best drive of a combination.
struct Found {
    values: Vec<f64>,
    objective: Option<f64>,
    /// By which share of it a limit is missed, if one is.
    missed: Option<f64>,
    limits: Vec<DecidingLimit>,
    residual: f64,
    idle: Vec<usize>,
    precision: Precision,
}

impl Found {
    fn is_better_than(&self, other: &Self) -> bool {
        let objective = |found: &Self| found.objective.unwrap_or(f64::INFINITY);
        match (self.missed, other.missed) {
            (None, None) => objective(self) < objective(other),
            (Some(one), Some(other)) => one < other,
            (missed, _) => missed.is_none(),
        }
    }
}

/// The values of a combination, by its index: the last choice changes first.
fn combination(question: &DesignQuestion, index: usize) -> Vec<usize> {
    let mut left = index;
    let chosen = question.choices.iter().rev().map(|choice| {
        let count = choice.values.len();
        let value = left % count;
        left /= count;
        value
    });
    let mut chosen: Vec<_> = chosen.collect();
    chosen.reverse();
    chosen
}

/// The best drive of a combination, or why none has a steady state, and how many were judged.
fn search_in(
    file: &DriveFile,
    question: &DesignQuestion,
    chosen: &[usize],
    options: &SolveOptions,
) -> (Result<Found, Box<Refusal>>, usize) {
    let file = file.chosen(&question.choices, chosen);
    let is_v = match file.drive() {
        Ok(drive) => matches!(drive.belt.kind, BeltKind::V(_)),
        Err(error) => return (Err(Box::new(Refusal::Input(Box::new(error)))), 0),
    };
    let precision = if is_v { OF_V } else { OF_FLAT };
    let mut problem = Problem {
        file: file.with_sense(),
        question,
        options,
        unit: 1.0,
        clearance: precision.clearance,
        known: Mutex::default(),
    };
    let starts = starts(&problem);
    let best = starts.first().and_then(|(_, found)| found.whole.as_ref());
    let size = best.and_then(|(pieces, _)| pieces.iter().map(|piece| piece.abs()).reduce(f64::max));
    problem.unit = size.filter(|size| *size > 0.0).unwrap_or(1.0);
    let mut best: Option<Found> = None;
    let mut refusal = None;
    for (place, found) in starts {
        match problem.local(place, &found, &precision) {
            Some(found) => {
                if best.as_ref().is_none_or(|best| found.is_better_than(best)) {
                    best = Some(found);
                }
            }
            None => refusal = found.refusal.clone().or(refusal),
        }
    }
    let drives = problem.judged();
    let why = || {
        let unknown = SolveError::NotFound {
            what: "slip margin",
        };
        Box::new(refusal.unwrap_or_else(|| unknown.into()))
    };
    (best.ok_or_else(why), drives)
}
