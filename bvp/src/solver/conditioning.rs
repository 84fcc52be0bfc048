//! The conditioning constants of a problem at a solution.
//!
//! The linearised problem at the solution, y' = J y + q with conditions C y = β and the parameters as
//! states of derivative zero, has the solution
//!
//! ```text
//! y(s) = Y(s) Q⁻¹ β + ∫ G(s, t) q(t) dt
//! ```
//!
//! with fundamental solutions Y, Q = C Y and Green's function G: U. M. Ascher, R. M. M. Mattheij &
//! R. D. Russell, *Numerical Solution of Boundary Value Problems for Ordinary Differential Equations*
//! (SIAM 1995), section 3.2. How much of changes of the conditions and of the equations arrives in
//! the solution is measured by the constants of J. R. Cash & F. Mazzia, "A new mesh selection
//! algorithm, based on conditioning, for two-point boundary value codes", J. Comput. Appl. Math. 184
//! (2005) 362-381.

use crate::discretisation::iterate::{Iterate, Residual, SegmentIterate};
use crate::kernels::dense::max_or_nan;
use crate::newton::collocation::Collocation;
use crate::problem::equations::Equations;
use crate::problem::problem::Segment;
use crate::result::error::Error;
use crate::result::solution::Solution;
use crate::shares::PLACES;
use crate::solver::at_solution::{AtSolution, at_solution};

/// How sensitive a problem is at a solution. All norms are maximum norms over states and parameters,
/// absolute and in the units of the problem or, if the solution was found with
/// [`Options::absolute`](crate::Options::absolute), in multiples of these numbers, rounded down to powers
/// of two; a right-hand side is then in multiples of that of its state per unit of s, and a condition in
/// multiples of the most that a change of one state or parameter by its number makes of it.
///
/// ```text
/// κ₁, κ₂ moderate, σ moderate    well conditioned
/// κ₁, κ₂ moderate, σ ≫ 1         well conditioned and stiff: conditions are felt in layers only
/// κ₁ or κ₂ large                 ill-conditioned
/// ```
///
/// Moderate is what a layer of width w makes of slopes, 1/w. The constants are those of the
/// discretised problem: what layers the mesh of the solution does not resolve are as wide as its intervals.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Conditioning {
    /// κ = max ( ‖Y(s) Q⁻¹‖ + ∫ ‖G(s, t)‖ dt ) over s, with the integral as in κ₂.
    pub kappa: f64,
    /// κ₁ = max ‖Y(s) Q⁻¹‖ over s: the largest change of the solution when every condition changes by
    /// at most 1.
    pub kappa1: f64,
    /// κ₂ = max ∫ ‖G(s, t)‖ dt over s: the largest change of the solution when every right-hand side
    /// changes by at most 1. A lower bound: the changes are constant over groups of neighbouring
    /// intervals, at most 64 groups a segment, so that it is exact if no entry of G changes its sign as
    /// a function of t inside a group.
    pub kappa2: f64,
    /// γ₁ = ∫ ‖Y(s) Q⁻¹‖ ds / Σ (b − a), the mean where κ₁ is the maximum; by the trapezoidal rule on the
    /// mesh.
    pub gamma1: f64,
    /// The stiffness ratio σ = κ₁ / γ₁, at least 1 but for rounding.
    pub sigma: f64,
    /// The estimated rounding error of the solution relative to 1 + |y|: the error with which a linear
    /// system with the Newton matrix and a known solution of the size of this one is solved in double
    /// precision, with one step of iterative refinement. [`solve`](crate::solve) refuses a solution
    /// where it exceeds ten tolerances or 0.01.
    pub rounding: f64,
}

impl Solution {
    /// The [`Conditioning`] of the problem with these equations at this solution: one linearisation on the mesh of the solution,
    /// and a solve for each condition and, for κ₂, up to 64 for each state. Maxima are over the nodes.
    ///
    /// # Errors
    /// Statement errors as of [`solve`](crate::solve) if the equations are not those of the solution;
    /// [`Error::NonFiniteRhs`], [`Error::NonFiniteCondition`], [`Error::SingularNode`] or
    /// [`Error::SingularConditions`], with the solution, if they cannot be linearised there.
    pub fn conditioning(&self, equations: &dyn Equations) -> Result<Conditioning, Error> {
        conditioning(equations, self)
    }
}

/// See [`Solution::conditioning`].
pub(crate) fn conditioning(
    equations: &dyn Equations,
    solution: &Solution,
) -> Result<Conditioning, Error> {
    let AtSolution {
        mut collocation, x, ..
    } = at_solution(equations, solution)?;
    let responses = condition_responses(&mut collocation);
    let by_conditions = norms(&collocation, &responses);
    let responses = forcing_responses(&mut collocation);
    let by_forcing = norms(&collocation, &responses);
    let (mut kappa, mut integral, mut length) = (0.0, 0.0, 0.0);
    let segments = by_conditions.iter().zip(&by_forcing);
    for ((first, second), nodes) in segments.zip(&collocation.mesh) {
        let sums = first.iter().zip(second).map(|(a, b)| a + b);
        kappa = sums.fold(kappa, max_or_nan);
        for (pair, s) in first.windows(2).zip(nodes.windows(2)) {
            integral += 0.5 * (pair[0] + pair[1]) * (s[1] - s[0]);
        }
        length += nodes[nodes.len() - 1] - nodes[0];
    }
    let largest = |norms: &[Vec<f64>]| norms.iter().flatten().copied().fold(0.0, max_or_nan);
    let (kappa1, gamma1) = (largest(&by_conditions), integral / length);
    Ok(Conditioning {
        kappa,
        kappa1,
        kappa2: largest(&by_forcing),
        gamma1,
        sigma: kappa1 / gamma1,
        rounding: collocation.rounding(&x),
    })
}

/// Σ |columns| of Y Q⁻¹ at all nodes, a sum for every state and parameter.
fn condition_responses(collocation: &mut Collocation<'_>) -> Iterate {
    let mut residual = collocation.residual_buffer();
    let (mut sums, mut response) = (collocation.zeros(), collocation.zeros());
    for (condition, unit) in collocation.condition_units().into_iter().enumerate() {
        residual.conditions[condition] = unit;
        collocation.node_correction(&residual, &mut response);
        residual.conditions[condition] = 0.0;
        add_sizes(&mut sums, &response);
    }
    sums
}

/// Σ |∫ columns of G over a group of intervals| at all nodes, a sum for every state and parameter.
fn forcing_responses(collocation: &mut Collocation<'_>) -> Iterate {
    let mut residual = collocation.residual_buffer();
    let (mut sums, mut response) = (collocation.zeros(), collocation.zeros());
    for segment in 0..residual.equations.len() {
        let n = collocation.equations.segments()[segment].states;
        let size = collocation.tableau.stages * n;
        let intervals = residual.equations[segment].stages.len() / size;
        let group = intervals.div_ceil(PLACES);
        for first in (0..intervals).step_by(group) {
            let last = (first + group).min(intervals);
            for state in 0..n {
                let force = |residual: &mut Residual, value: f64| {
                    let stages = &mut residual.equations[segment].stages[first * size..last * size];
                    stages
                        .iter_mut()
                        .skip(state)
                        .step_by(n)
                        .for_each(|r| *r = value);
                };
                force(&mut residual, 1.0);
                collocation.node_correction(&residual, &mut response);
                force(&mut residual, 0.0);
                add_sizes(&mut sums, &response);
            }
        }
    }
    sums
}

/// sums += |response|, at nodes and of parameters.
fn add_sizes(sums: &mut Iterate, response: &Iterate) {
    let add = |sums: &mut [f64], x: &[f64]| {
        sums.iter_mut().zip(x).for_each(|(sum, x)| *sum += x.abs());
    };
    for (sums, response) in sums.segments.iter_mut().zip(&response.segments) {
        add(&mut sums.nodes, &response.nodes);
    }
    add(&mut sums.p, &response.p);
}

/// The norms of rows that [`add_sizes`] summed, at every node of every segment: the largest over the
/// states there and the parameters.
fn norms(collocation: &Collocation<'_>, sums: &Iterate) -> Vec<Vec<f64>> {
    let parameters = sums.p.iter().copied().fold(0.0, max_or_nan);
    let at_nodes = |(sums, segment): (&SegmentIterate, &Segment)| -> Vec<f64> {
        let rows = sums.nodes.chunks_exact(segment.states);
        rows.map(|row| row.iter().copied().fold(parameters, max_or_nan))
            .collect()
    };
    let segments = collocation.equations.segments();
    sums.segments.iter().zip(segments).map(at_nodes).collect()
}
