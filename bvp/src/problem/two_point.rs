//! A problem stated by closures.

use crate::problem::automatic::{differentiate_by, value_by};
use crate::problem::dual::Dual;
use crate::problem::equations::{Equations, Shape};
use crate::problem::problem::{Ends, Segment};

/// The scalar of the closures. Eight directions serve problems with up to four states and their
/// conditions in one pass.
type Scalar = Dual<WIDTH>;
const WIDTH: usize = 8;

/// A problem on one segment, given by two closures; its Jacobians are exact.
///
/// ```text
/// dy/ds = f(s, y, p),   from ≤ s ≤ to        rhs(s, y, p, dy) writes dy
/// g(y(from), y(to), p) = 0                   conditions(start, end, p, r) writes r
/// ```
///
/// The closures work with [`Dual`] numbers, which have the functions of [`Real`](crate::Real) and take
/// plain numbers on both sides; a constant alone is `Dual::constant(1.0)`. A [`Problem`](crate::Problem) is the general form, and faster: it is
/// evaluated without derivatives where none are needed.
///
/// ```
/// use bvp::{Constant, Options, Real, TwoPoint, solve};
///
/// // Bratu's problem y'' + eʸ = 0, y(0) = y(1) = 0.
/// let bratu = TwoPoint::new(
///     [2, 0],
///     [0.0, 1.0],
///     |_s, y, _p, dy| dy.copy_from_slice(&[y[1], -y[0].exp()]),
///     |start, end, _p, r| r.copy_from_slice(&[start[0], end[0]]),
/// );
/// let solution = solve(&bratu, &Constant::new([0.0, 0.0]), &Options::default())?;
/// assert!((solution.start(0)[1] - 0.549_353).abs() < 1e-6);
/// # Ok::<(), bvp::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct TwoPoint<F, G> {
    segment: Segment,
    parameters: usize,
    condition_count: usize,
    rhs: F,
    conditions: G,
}

impl<F, G> TwoPoint<F, G>
where
    F: Fn(Scalar, &[Scalar], &[Scalar], &mut [Scalar]) + Sync,
    G: Fn(&[Scalar], &[Scalar], &[Scalar], &mut [Scalar]) + Sync,
{
    /// A problem with n states and k parameters, `[n, k]`, for s in `[from, to]`, with n + k
    /// conditions.
    pub const fn new(
        [states, parameters]: [usize; 2],
        [from, to]: [f64; 2],
        rhs: F,
        conditions: G,
    ) -> Self {
        Self {
            segment: Segment::on(states, from, to),
            parameters,
            condition_count: states + parameters,
            rhs,
            conditions,
        }
    }

    /// The same problem with another number of conditions: fewer than n + k for a
    /// [`Family`](crate::Family) or [`solve_embedded`](crate::solve_embedded).
    #[must_use]
    pub fn with_condition_count(mut self, count: usize) -> Self {
        self.condition_count = count;
        self
    }

    /// The conditions at the start and the end, which lie one after the other in `ends`.
    fn conditions_at(&self, ends: &[Scalar], p: &[Scalar], r: &mut [Scalar]) {
        let (start, end) = ends.split_at(self.segment.states);
        (self.conditions)(start, end, p, r);
    }
}

impl<F, G> Equations for TwoPoint<F, G>
where
    F: Fn(Scalar, &[Scalar], &[Scalar], &mut [Scalar]) + Sync,
    G: Fn(&[Scalar], &[Scalar], &[Scalar], &mut [Scalar]) + Sync,
{
    fn shape(&self) -> Shape {
        Shape {
            segments: vec![self.segment.clone()],
            parameters: self.parameters,
            conditions: self.condition_count,
        }
    }

    fn evaluate_rhs(&self, _segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]) {
        let s = Scalar::constant(s);
        value_by(|y, p, dy| (self.rhs)(s, y, p, dy), y, p, dy);
    }

    fn rhs_jacobian(
        &self,
        _segment: usize,
        s: f64,
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobian: &mut [f64],
    ) {
        let s = Scalar::constant(s);
        differentiate_by(|y, p, dy| (self.rhs)(s, y, p, dy), y, p, dy, jacobian);
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]) {
        value_by(
            |ends, p, r| self.conditions_at(ends, p, r),
            at.values(),
            p,
            r,
        );
    }

    fn conditions_jacobian(
        &self,
        at: Ends<'_, f64>,
        p: &[f64],
        r: &mut [f64],
        jacobian: &mut [f64],
    ) {
        differentiate_by(
            |ends, p, r| self.conditions_at(ends, p, r),
            at.values(),
            p,
            r,
            jacobian,
        );
    }
}
