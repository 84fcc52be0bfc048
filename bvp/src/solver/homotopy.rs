//! The last resort against a guess that is too poor: a homotopy from a better one.
//!
//! For any guess G of the states and p₀ of the parameters the problems
//!
//! ```text
//! y' = f(s, y, p) − (1 − λ) ( f(s, G, p₀) − G' ),     g(ends, p) = (1 − λ) g(ends of G, p₀)
//! ```
//!
//! lead from one that G solves, at λ = 0, to the one stated, at λ = 1: the Newton homotopy, E. L.
//! Allgower & K. Georg, *Introduction to Numerical Continuation Methods* (SIAM 2003), equation
//! (1.3). Damped Newton iteration follows the same path on one mesh; here the mesh follows the solution
//! along it. G is not the guess that failed but [`Straight`], which has no wrong detail.

use crate::problem::equations::{Equations, Shape};
use crate::problem::guess::Guess;
use crate::problem::held::Held;
use crate::problem::problem::Ends;
use crate::result::error::Error;
use crate::result::solution::Solution;
use crate::result::stats::Stats;
use crate::shares::TWO_DIGITS;
use crate::solver::options::Options;
use crate::solver::stepping::{follow, on_the_way};
use crate::solver::straight::Straight;

/// A solver of boundary value problems.
type Solve = fn(&dyn Equations, &dyn Guess, &Options) -> Result<Solution, Error>;

/// A rough solution of the problem by this solver, of which only the parameters and the mesh of the guess are
/// used; `None` if the path ends before it. All cost is added to `stats`.
pub(crate) fn rough_solution(
    equations: &Held<'_>,
    guess: &dyn Guess,
    options: &Options,
    stats: &mut Stats,
    solve: Solve,
) -> Option<Solution> {
    let line = Straight::new(equations, guess)?;
    let options = Options {
        // The equations are in units already.
        absolute: vec![],
        ..on_the_way(options, TWO_DIGITS)
    };
    let solve_at = |lambda: f64, guess: &dyn Guess| {
        solve(&Homotopy::new(equations, &line, lambda), guess, &options)
    };
    let first = solve_at(0.0, &line).ok()?;
    let mut cost = first.stats;
    let rough = follow(first, &mut cost, solve_at);
    // Every evaluation is one at y and one at G.
    cost.rhs_evaluations *= 2;
    *stats += cost;
    rough.ok()
}

/// The problem of one λ.
struct Homotopy<'a> {
    equations: &'a Held<'a>,
    line: &'a Straight<'a>,
    /// 1 − λ.
    rest: f64,
    /// (1 − λ) g(ends of G, p₀).
    conditions: Vec<f64>,
}

impl<'a> Homotopy<'a> {
    fn new(equations: &'a Held<'a>, line: &'a Straight<'a>, lambda: f64) -> Self {
        let rest = 1.0 - lambda;
        let at = Ends::new(equations.segments(), &line.ends);
        let mut conditions = vec![0.0; equations.condition_count()];
        equations.evaluate_conditions(at, &line.parameters, &mut conditions);
        conditions.iter_mut().for_each(|g| *g *= rest);
        Self {
            equations,
            line,
            rest,
            conditions,
        }
    }

    /// Subtracts (1 − λ)(f(s, G, p₀) − G') from `dy`.
    fn deform_rhs(&self, segment: usize, s: f64, dy: &mut [f64]) {
        let (mut y, mut f) = (vec![0.0; dy.len()], vec![0.0; dy.len()]);
        self.line.state(segment, s, &mut y);
        self.equations
            .evaluate_rhs(segment, s, &y, &self.line.parameters, &mut f);
        self.line.slope(segment, &mut y);
        for (dy, (f, slope)) in dy.iter_mut().zip(f.iter().zip(&y)) {
            *dy -= self.rest * (f - slope);
        }
    }

    fn deform_conditions(&self, r: &mut [f64]) {
        r.iter_mut()
            .zip(&self.conditions)
            .for_each(|(r, g)| *r -= g);
    }
}

impl Equations for Homotopy<'_> {
    fn shape(&self) -> Shape {
        self.equations.shape()
    }

    fn evaluate_rhs(&self, segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]) {
        self.equations.evaluate_rhs(segment, s, y, p, dy);
        self.deform_rhs(segment, s, dy);
    }

    fn rhs_jacobian(
        &self,
        segment: usize,
        s: f64,
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobian: &mut [f64],
    ) {
        self.equations.rhs_jacobian(segment, s, y, p, dy, jacobian);
        self.deform_rhs(segment, s, dy);
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]) {
        self.equations.evaluate_conditions(at, p, r);
        self.deform_conditions(r);
    }

    fn conditions_jacobian(
        &self,
        at: Ends<'_, f64>,
        p: &[f64],
        r: &mut [f64],
        jacobian: &mut [f64],
    ) {
        self.equations.conditions_jacobian(at, p, r, jacobian);
        self.deform_conditions(r);
    }
}
