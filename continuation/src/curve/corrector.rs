//! Newton's method back to the curve.
//!
//! From a predicted point z the corrections solve
//!
//! ```text
//! ┌ J ┐     ┌ −G(z)   ┐
//! │   │ δ = │         │        δ = v + α t,   J v = −G,   J t = 0
//! └ c ┘     └ κ − c z ┘        α = (κ − c z − c v) / (c t)
//! ```
//!
//! with one more linear condition c z = κ: a plane across the tangent (pseudo-arclength, Keller
//! 1977) or a prescribed λ. As long as the corrections contract fast, the linearisation is kept
//! (chord steps). What is left where they no longer do is rounding only if a new linearisation agrees.

use crate::curve::metric::Metric;
use crate::difficulty::Difficulty;
use crate::system::system::System;

/// Corrections that shrink at least this much per step keep the linearisation.
const KEEP_BELOW: f64 = 0.1;
/// Corrections that shrink less than this are diverging, or rounding.
const CONTRACTION: f64 = 0.7;
/// Corrections shorter than this, or than this many times the length wanted, that shrink no more
/// are rounding.
const ROUNDING: f64 = 1e-8;
const ROUNDING_FACTOR: f64 = 100.0;
/// A first correction shorter than this keeps the linearisation for the second one, and a way shorter than this leads to a place
/// nearby.
pub(crate) const SHORT: f64 = 1e-3;
/// A condition this nearly parallel to the curve determines nothing.
const PARALLEL: f64 = 1e-13;

/// A linear condition c z = κ.
#[derive(Clone, Debug)]
pub(crate) struct Condition {
    row: Vec<f64>,
    value: f64,
}

impl Condition {
    /// The plane through `z` across `normal`.
    pub(crate) fn plane(metric: &Metric, normal: &[f64], z: &[f64]) -> Self {
        let row = metric.row(normal);
        let value = dot(&row, z);
        Self { row, value }
    }

    /// A prescribed λ, for this many unknowns.
    pub(crate) fn lambda(unknowns: usize, value: f64) -> Self {
        let mut row = vec![0.0; unknowns];
        row[unknowns - 1] = 1.0;
        Self { row, value }
    }
}

/// How a correction went.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Correction {
    /// Length of the first correction: the error of the prediction.
    pub(crate) first: f64,
    /// The second over the first; zero if there was none, or the first was so short that the second may be rounding.
    pub(crate) contraction: f64,
    /// Distance from the last linearisation to the point found.
    pub(crate) drift: f64,
}

/// How accurately a point is wanted.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Accuracy {
    /// The next correction is shorter than this.
    Length(f64),
    /// Corrections no longer shrink.
    Rounding,
}

/// Newton's method between bounds of λ, with its buffers.
#[derive(Clone, Debug)]
pub(crate) struct Corrector {
    /// λ may not leave them on the way to a solution.
    bounds: [f64; 2],
    residual: Vec<f64>,
    particular: Vec<f64>,
    null: Vec<f64>,
}

impl Corrector {
    pub(crate) fn within(bounds: [f64; 2]) -> Self {
        Self {
            bounds,
            residual: Vec::new(),
            particular: Vec::new(),
            null: Vec::new(),
        }
    }

    /// Without bounds.
    pub(crate) fn anywhere() -> Self {
        Self::within([f64::NEG_INFINITY, f64::INFINITY])
    }

    fn resize(&mut self, unknowns: usize) {
        self.residual.resize(unknowns - 1, 0.0);
        self.particular.resize(unknowns, 0.0);
        self.null.resize(unknowns, 0.0);
    }

    /// Corrects `z` onto the curve and `condition` by at most so many corrections. With `keep` it begins with the last
    /// linearisation, which was made at a place nearby, and the drift is counted from there. The null vector of the last
    /// linearisation is left in [`null`](Self::null).
    pub(crate) fn correct<S: System>(
        &mut self,
        system: &mut S,
        metric: &Metric,
        z: &mut [f64],
        condition: &Condition,
        (accuracy, limit): (Accuracy, usize),
        mut keep: bool,
    ) -> Result<Correction, Difficulty> {
        self.resize(z.len());
        let n = z.len() - 1;
        let mut report = Correction {
            first: 0.0,
            contraction: 0.0,
            drift: 0.0,
        };
        z[n] = z[n].clamp(self.bounds[0], self.bounds[1]);
        let wanted = match accuracy {
            Accuracy::Length(length) => length,
            Accuracy::Rounding => 0.0,
        };
        let rounding = ROUNDING.max(ROUNDING_FACTOR * wanted);
        // The length of the correction before, unless it is no measure for the next one.
        let mut before = None;
        // A correction by an old linearisation that may be rounding.
        let mut doubted: Option<Vec<f64>> = None;
        for step in 0..limit {
            self.evaluate(system, z)?;
            if !keep {
                self.linearise(system, z)?;
                report.drift = 0.0;
            }
            let length = self.solve(system, metric, condition, z)?;
            let ratio = before.map(|before: f64| length / before);
            if step == 1 && report.first > rounding {
                report.contraction = ratio.unwrap_or(1.0);
            }
            if let Some(chord) = doubted.take() {
                let both = self.particular.iter().zip(&chord);
                let apart: Vec<f64> = both.map(|(new, old)| new - old).collect();
                // By the old linearisation, too, corrections would have shrunk: what is left is rounding.
                if metric.norm(&apart) < KEEP_BELOW * length {
                    return Ok(report);
                }
            }
            if let Some(last) = before
                && length > CONTRACTION * last
            {
                let small = last <= rounding;
                if keep {
                    // The linearisation may be too old: another one at the same point.
                    doubted = small.then(|| self.particular.clone());
                    (before, keep) = (None, false);
                    continue;
                }
                if small {
                    return Ok(report);
                }
                return Err(no_convergence(length, step + 1, wanted));
            }
            let (lambda, [low, high]) = (z[n] + self.particular[n], self.bounds);
            if lambda < low || lambda > high {
                return Err(Difficulty::OutOfBounds { lambda });
            }
            let mut turned = false;
            for (z, delta) in z.iter_mut().zip(&self.particular) {
                turned |= delta.abs() >= z.abs() && *z != 0.0;
                *z += delta;
            }
            report.drift += length;
            if step == 0 {
                report.first = length;
            }
            // With linear convergence the corrections to come add up to this.
            let ahead = length * ratio.unwrap_or(1.0);
            if ahead <= wanted || length == 0.0 {
                if turned {
                    // An unknown that has changed its sign may have left the domain of G.
                    self.evaluate(system, z)?;
                }
                return Ok(report);
            }
            keep = match ratio {
                Some(ratio) => ratio < KEEP_BELOW,
                None => step == 0 && length < SHORT,
            };
            before = Some(length);
        }
        match before {
            // No step is left for another linearisation.
            None if doubted.is_some() => Ok(report),
            Some(length) if length <= ROUNDING && matches!(accuracy, Accuracy::Rounding) => {
                Ok(report)
            }
            length => Err(no_convergence(
                length.unwrap_or(f64::INFINITY),
                limit,
                wanted,
            )),
        }
    }

    /// Evaluates G, which beyond the bounds counts as undefined.
    pub(crate) fn residual<S: System>(&self, system: &mut S, z: &[f64], g: &mut [f64]) {
        g.fill(f64::NAN);
        let [low, high] = self.bounds;
        if (low..=high).contains(&z[z.len() - 1]) {
            system.residual(z, g);
        }
    }

    /// The bounds of λ.
    pub(crate) fn bounds(&self) -> [f64; 2] {
        self.bounds
    }

    /// λ, or its mirror image at the bound that it lies beyond.
    pub(crate) fn reflected(&self, lambda: f64) -> f64 {
        let [low, high] = self.bounds;
        2.0 * lambda.clamp(low, high) - lambda
    }

    /// Evaluates the residual at `z` into the buffer.
    fn evaluate<S: System>(&mut self, system: &mut S, z: &[f64]) -> Result<(), Difficulty> {
        let mut residual = std::mem::take(&mut self.residual);
        self.residual(system, z, &mut residual);
        self.residual = residual;
        match self.residual.iter().position(|g| !g.is_finite()) {
            Some(equation) => Err(Difficulty::NotFinite {
                equation,
                lambda: z[z.len() - 1],
            }),
            None => Ok(()),
        }
    }

    fn linearise<S: System>(&mut self, system: &mut S, z: &[f64]) -> Result<(), Difficulty> {
        system.linearise(z).map_err(Difficulty::Linearisation)?;
        system.null_vector(&mut self.null);
        finite(&self.null)
    }

    /// Leaves the correction in `particular` and returns its length.
    fn solve<S: System>(
        &mut self,
        system: &mut S,
        metric: &Metric,
        condition: &Condition,
        z: &[f64],
    ) -> Result<f64, Difficulty> {
        self.residual.iter_mut().for_each(|g| *g = -*g);
        system.particular(&self.residual, &mut self.particular);
        finite(&self.particular)?;
        let c = &condition.row;
        let across = dot(c, &self.null);
        if across.abs() <= PARALLEL * metric.norm_of_row(c) * metric.norm(&self.null) {
            return Err(Difficulty::Singular);
        }
        let alpha = (condition.value - dot(c, z) - dot(c, &self.particular)) / across;
        for (v, t) in self.particular.iter_mut().zip(&self.null) {
            *v += alpha * t;
        }
        finite(&self.particular)?;
        Ok(metric.norm(&self.particular))
    }

    /// The Newton correction at `z`, freshly linearised.
    pub(crate) fn newton<S: System>(
        &mut self,
        system: &mut S,
        metric: &Metric,
        condition: &Condition,
        z: &[f64],
    ) -> Result<&[f64], Difficulty> {
        self.resize(z.len());
        self.evaluate(system, z)?;
        self.linearise(system, z)?;
        self.solve(system, metric, condition, z)?;
        Ok(&self.particular)
    }

    /// The correction at `z` by the last linearisation.
    pub(crate) fn chord<S: System>(
        &mut self,
        system: &mut S,
        metric: &Metric,
        condition: &Condition,
        z: &[f64],
    ) -> Result<&[f64], Difficulty> {
        self.evaluate(system, z)?;
        self.solve(system, metric, condition, z)?;
        Ok(&self.particular)
    }

    /// The null vector of the last linearisation, as the system orients it.
    pub(crate) fn null(&self) -> &[f64] {
        &self.null
    }

    /// Linearises at `z` and returns the oriented unit tangent.
    pub(crate) fn tangent<S: System>(
        &mut self,
        system: &mut S,
        metric: &Metric,
        z: &[f64],
    ) -> Result<Vec<f64>, Difficulty> {
        self.resize(z.len());
        self.linearise(system, z)?;
        let mut tangent = self.null.clone();
        if metric.normalise(&mut tangent) {
            Ok(tangent)
        } else {
            Err(Difficulty::Singular)
        }
    }
}

fn no_convergence(correction: f64, steps: usize, limit: f64) -> Difficulty {
    Difficulty::NoConvergence {
        correction,
        steps,
        limit,
    }
}

fn finite(values: &[f64]) -> Result<(), Difficulty> {
    if values.iter().all(|x| x.is_finite()) {
        Ok(())
    } else {
        Err(Difficulty::Singular)
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
