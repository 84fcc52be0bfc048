//! A second solution where some are known.
//!
//! With known solutions xⱼ at the same λ, Newton's method is applied to
//!
//! ```text
//! m(x) G(x, λ) = 0,     m(x) = Πⱼ (1 / ‖x − xⱼ‖² + 1)
//! ```
//!
//! which the known solutions do not solve. Its correction is a multiple of the one δ of G alone,
//! δ / (1 − ∇ln m · δ). P. E. Farrell, Á. Birkisson & S. W. Funke, "Deflation techniques for finding
//! distinct solutions of nonlinear partial differential equations", SIAM J. Sci. Comput. 37 (2015)
//! A2026-A2045.

use crate::curve::corrector::{Accuracy, Condition, Corrector};
use crate::curve::metric::Metric;
use crate::difficulty::Difficulty;
use crate::error::{Error, check_length};
use crate::options::Options;
use crate::special_points::branch_point::irregular;
use crate::system::system::System;

/// The most deflated Newton steps from one place.
const STEPS: usize = 60;
/// Where they start: the guess, then places around it, by these multiples of an irregular vector as
/// long as the sizes of the unknowns.
const PLACES: [f64; 9] = [0.0, 0.3, -0.3, 0.6, -0.6, 1.0, -1.0, 2.0, -2.0];
/// The longest step, in the norm of the arclength.
const LONGEST: f64 = 0.5;
/// Corrections of G alone shorter than this are left to Newton's method.
const CLOSE: f64 = 1e-4;
/// The most corrections of it.
const CORRECTIONS: usize = 30;
/// A solution must be this far from all known ones.
const DISTINCT: f64 = 1e-5;

/// Finds a solution of G(x, λ) = 0 at the λ of `guess` that is none of the `known` ones (their λ is
/// ignored): the way to branches that are connected to no known one. Where the iteration from
/// the guess fails, it is tried from places around the guess.
///
/// # Errors
/// Those of [`Branch::new`](crate::Branch::new); [`Error::Deflation`] where none is found.
pub fn deflate<S: System>(
    system: &mut S,
    known: &[Vec<f64>],
    guess: &[f64],
    options: &Options,
) -> Result<Vec<f64>, Error> {
    let unknowns = system.unknowns();
    options.validate(unknowns)?;
    known.iter().try_for_each(|z| check_length(z, unknowns))?;
    check_length(guess, unknowns)?;
    system.set_bounds(options.bounds);
    let lambda = guess[unknowns - 1];
    let mut metric = Metric::new(system, options, guess);
    known.iter().for_each(|z| metric.observe(z));
    let known: Vec<Vec<f64>> = known
        .iter()
        .map(|z| {
            let mut z = z.clone();
            z[unknowns - 1] = lambda;
            z
        })
        .collect();
    let mut failure = None;
    for multiple in PLACES {
        let moved = |(i, z): (usize, &f64)| z + multiple * irregular(i) * metric.scale(i);
        let mut place: Vec<f64> = guess.iter().enumerate().map(moved).collect();
        place[unknowns - 1] = lambda;
        match from(system, &metric, &known, place, options) {
            Ok(found) => return Ok(found),
            Err(error) => failure.get_or_insert(error),
        };
    }
    Err(failure.unwrap_or(Error::SingularStart))
}

/// Deflated Newton iteration from one place.
fn from<S: System>(
    system: &mut S,
    metric: &Metric,
    known: &[Vec<f64>],
    mut z: Vec<f64>,
    options: &Options,
) -> Result<Vec<f64>, Error> {
    let (unknowns, lambda) = (z.len(), z[z.len() - 1]);
    let condition = Condition::lambda(unknowns, lambda);
    let mut corrector = Corrector::within(options.bounds);
    let (mut before, mut length) = (z.clone(), f64::INFINITY);
    for _ in 0..STEPS {
        let outcome = corrector.newton(system, metric, &condition, &z);
        let delta = match outcome {
            Ok(delta) => delta.to_vec(),
            Err(Difficulty::NotFinite { .. }) if z != before => {
                // Half way back into the domain of G.
                for (z, before) in z.iter_mut().zip(&before) {
                    *z = 0.5 * (*z + before);
                }
                continue;
            }
            Err(difficulty) => return Err(Error::Start(difficulty)),
        };
        length = metric.norm(&delta);
        if length <= CLOSE {
            let mut found = z.clone();
            let goal = (Accuracy::Rounding, CORRECTIONS);
            let outcome = corrector.correct(system, metric, &mut found, &condition, goal, false);
            if outcome.is_ok() && known.iter().all(|x| metric.distance(&found, x) > DISTINCT) {
                return Ok(found);
            }
        }
        // ∇ln m · δ
        let slope: f64 = known
            .iter()
            .map(|x| {
                let away: Vec<f64> = z.iter().zip(x).map(|(z, x)| z - x).collect();
                let square = metric.dot(&away, &away);
                -2.0 * metric.dot(&away, &delta) / (square * (1.0 + square))
            })
            .sum();
        let factor = 1.0 / (1.0 - slope);
        let factor = factor.clamp(-LONGEST / length, LONGEST / length);
        before.clone_from(&z);
        for (z, delta) in z.iter_mut().zip(&delta) {
            *z += factor * delta;
        }
        z[unknowns - 1] = lambda;
    }
    Err(Error::Deflation {
        correction: length,
        steps: STEPS,
    })
}
