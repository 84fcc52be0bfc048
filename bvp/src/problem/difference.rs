//! Jacobians by central differences.

use crate::problem::equations::{Equations, Shape};
use crate::problem::problem::{Ends, Segment};

/// Step of a central difference relative to 1 + |z|: the cube root of the rounding unit balances
/// rounding against truncation, for about ten correct digits.
const STEP: f64 = 6e-6;

/// A problem given by two plain closures; its Jacobians are central differences.
///
/// Exact derivatives are faster and more accurate: prefer a [`Problem`](crate::Problem) where the
/// right-hand side can be written generically. Steps are 6e-6 (1 + |z|) for a state or parameter z, whatever
/// [`Options::absolute`](crate::Options::absolute) says: state unknowns far below one in other units.
///
/// ```
/// use bvp::{Constant, Ends, FiniteDifferences, Options, Segment, solve};
///
/// // y'' = y, y(0) = 1, y(1) = 0
/// let problem = FiniteDifferences {
///     segments: vec![Segment::new(2)],
///     parameters: 0,
///     condition_count: 2,
///     rhs: |_: usize, _s: f64, y: &[f64], _p: &[f64], dy: &mut [f64]| {
///         dy[0] = y[1];
///         dy[1] = y[0];
///     },
///     conditions: |at: Ends<'_, f64>, _p: &[f64], r: &mut [f64]| {
///         r[0] = at.start(0)[0] - 1.0;
///         r[1] = at.end(0)[0];
///     },
/// };
/// let guess = Constant { states: vec![vec![0.0; 2]], parameters: vec![] };
/// let solution = solve(&problem, &guess, &Options::default())?;
/// assert!((solution.start(0)[1] + 1.0 / 1f64.tanh()).abs() < 1e-8);
/// # Ok::<(), bvp::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct FiniteDifferences<F, G> {
    /// The smooth segments.
    pub segments: Vec<Segment>,
    /// Number k of unknown parameters.
    pub parameters: usize,
    /// Number of conditions; must be Σ nᵢ + k, or less for a [`Family`](crate::Family).
    pub condition_count: usize,
    /// Right-hand side: (segment, s, y, p, dy) writes dy.
    pub rhs: F,
    /// Conditions: (ends, p, r) writes r.
    pub conditions: G,
}

impl FiniteDifferences<(), ()> {
    /// The values of other equations with their Jacobians replaced by central differences, to
    /// [compare](crate::check_jacobians) the originals with.
    pub fn of(equations: &dyn Equations) -> impl Equations {
        let shape = equations.shape();
        FiniteDifferences {
            segments: shape.segments,
            parameters: shape.parameters,
            condition_count: shape.conditions,
            rhs: |segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]| {
                equations.evaluate_rhs(segment, s, y, p, dy);
            },
            conditions: |at: Ends<'_, f64>, p: &[f64], r: &mut [f64]| {
                equations.evaluate_conditions(at, p, r);
            },
        }
    }
}

impl<F, G> Equations for FiniteDifferences<F, G>
where
    F: Fn(usize, f64, &[f64], &[f64], &mut [f64]) + Sync,
    G: Fn(Ends<'_, f64>, &[f64], &mut [f64]) + Sync,
{
    fn shape(&self) -> Shape {
        Shape {
            segments: self.segments.clone(),
            parameters: self.parameters,
            conditions: self.condition_count,
        }
    }

    fn evaluate_rhs(&self, segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]) {
        (self.rhs)(segment, s, y, p, dy);
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
        (self.rhs)(segment, s, y, p, dy);
        difference(
            |y, p, dy| (self.rhs)(segment, s, y, p, dy),
            y,
            p,
            dy.len(),
            jacobian,
        );
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]) {
        (self.conditions)(at, p, r);
    }

    fn conditions_jacobian(
        &self,
        at: Ends<'_, f64>,
        p: &[f64],
        r: &mut [f64],
        jacobian: &mut [f64],
    ) {
        (self.conditions)(at, p, r);
        difference(
            |ends, p, r| (self.conditions)(at.with(ends), p, r),
            at.values(),
            p,
            r.len(),
            jacobian,
        );
    }
}

/// Central differences of `function(y, p)`, which writes `rows` values: `jacobian` is row-major
/// with `y.len() + p.len()` columns.
pub(crate) fn difference(
    function: impl Fn(&[f64], &[f64], &mut [f64]),
    y: &[f64],
    p: &[f64],
    rows: usize,
    jacobian: &mut [f64],
) {
    let columns = y.len() + p.len();
    let mut z: Vec<f64> = y.iter().chain(p).copied().collect();
    let (mut above, mut below) = (vec![f64::NAN; rows], vec![f64::NAN; rows]);
    for column in 0..columns {
        let value = z[column];
        let step = STEP * (1.0 + value.abs());
        let mut at = |value: f64, result: &mut [f64]| {
            z[column] = value;
            function(&z[..y.len()], &z[y.len()..], result);
        };
        at(value + step, &mut above);
        at(value - step, &mut below);
        z[column] = value;
        // The step as it was really taken, after rounding.
        let width = (value + step) - (value - step);
        for (row, (above, below)) in above.iter().zip(&below).enumerate() {
            jacobian[row * columns + column] = (above - below) / width;
        }
    }
}
