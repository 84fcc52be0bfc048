//! A singular coefficient at an end, and strongly nonlinear conditions.

use crate::{Case, UNIT};
use bvp::{Ends, Problem, Real, Segment};

/// Lane and Emden with exponent 5: y″ + (2/x) y′ = −y⁵, y′(0) = 0, y(1) = √3/2; the solution is
/// 1/√(1 + x²/3). The right-hand side is not defined at x = 0.
struct LaneEmden;

impl Problem for LaneEmden {
    fn segments(&self) -> Vec<Segment> {
        UNIT.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, x: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -y[0].powi(5) - y[1] * 2.0 / x;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[1];
        r[1] = at.end(0)[0] - 3f64.sqrt() / 2.0;
    }
}

/// Potential y between two electrodes 0.1 apart, y″ = 0, with the kinetics of Butler and Volmer at
/// both: the current through the electrolyte equals that of the reaction,
///
/// ```text
/// 2 j sinh(38.9 η) = −1.64 y′ at the left (η = −y), +1.64 y′ at the right (η = −1/2 − y)
/// ```
///
/// with j = 0.01 and 0.0001. The solution is a straight line, the conditions are stiff.
struct ButlerVolmer;

impl ButlerVolmer {
    /// Reaction current of the exchange current `j` at the overpotential `eta`.
    fn current<T: Real>(j: f64, eta: T) -> T {
        (eta * 38.9).sinh() * (2.0 * j)
    }
}

impl Problem for ButlerVolmer {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, 0.0, 0.1)]
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = T::from_f64(0.0);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        let (left, right) = (at.start(0), at.end(0));
        r[0] = Self::current(0.01, -left[0]) + left[1] * 1.64;
        r[1] = Self::current(1e-4, -right[0] - 0.5) - right[1] * 1.64;
    }
}

pub(crate) fn cases() -> Vec<Case> {
    let source = "MATLAB emdenbvp; SciPy, test of solve_bvp (emden)";
    let emden = Case::new(
        "E03",
        "Lane and Emden's equation, exponent 5",
        source,
        LaneEmden,
    );
    let name = "electrode kinetics of Butler and Volmer";
    let source = "SciPy, test of solve_bvp (nonlin_bc)";
    vec![
        emden.with_guess(|_| [3f64.sqrt() / 2.0, 1e-4]),
        Case::new("E11c", name, source, ButlerVolmer),
    ]
}
