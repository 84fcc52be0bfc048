//! Problems with several solutions, told apart by the guess.

use crate::{Case, TEST_SET, UNIT, end_values};
use bvp::{Ends, Problem, Real, Segment};
use std::f64::consts::PI;

/// Bratu: y″ = −λ eʸ, y(0) = y(1) = 0; two solutions for 0 < λ < 3.513830719…, where they fold.
///
/// ```text
/// y = −2 ln(cosh((x − 1/2) θ/2) / cosh(θ/4)),   θ = √(2λ) cosh(θ/4)
/// ```
pub(crate) struct Bratu {
    pub(crate) lambda: f64,
}

impl Problem for Bratu {
    fn segments(&self) -> Vec<Segment> {
        UNIT.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -y[0].exp() * self.lambda;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        end_values(at, 0.0, 0.0, r);
    }
}

/// y″ + |y| = 0, y(0) = 0, y(4) = −2. The positive solution changes sign at x = π, where its third
/// derivative jumps.
struct AbsoluteValue;

impl Problem for AbsoluteValue {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, 0.0, 4.0)]
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -y[0].abs();
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        end_values(at, 0.0, -2.0, r);
    }
}

/// Euler's rod under end thrust, in the angle: y″ = −20 sin y, y′(0) = y′(1) = 0.
struct BuckledRod;

impl Problem for BuckledRod {
    fn segments(&self) -> Vec<Segment> {
        UNIT.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -y[0].sin() * 20.0;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[1];
        r[1] = at.end(0)[1];
    }
}

pub(crate) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (id, lambda) in [("T34a", 1.0), ("T34b", 3.0), ("T34c", 3.51)] {
        let name = "Bratu's problem, lower branch";
        cases.push(Case::new(id, name, TEST_SET, Bratu { lambda }));
    }
    let source = "SciPy, documentation of solve_bvp";
    let name = "Bratu's problem, λ = 1, lower solution";
    cases.push(Case::new("E12a", name, source, Bratu { lambda: 1.0 }).with_intervals(4));
    let name = "Bratu's problem, λ = 1, upper solution";
    let upper = Case::new("E12b", name, source, Bratu { lambda: 1.0 });
    cases.push(upper.with_guess(|_| [3.0, 0.0]).with_intervals(4));
    let source = "MATLAB twobvp";
    let name = "y″ + |y| = 0, positive solution";
    cases.push(Case::new("E07a", name, source, AbsoluteValue).with_guess(|_| [1.0, 0.0]));
    let name = "y″ + |y| = 0, negative solution";
    cases.push(Case::new("E07b", name, source, AbsoluteValue).with_guess(|_| [-1.0, 0.0]));
    let name = "buckled rod, thrust 20";
    let source = "this project, after Euler's elastica";
    let guess = |x: f64| [2.0 * (PI * x).cos(), -2.0 * PI * (PI * x).sin()];
    cases.push(Case::new("E29", name, source, BuckledRod).with_guess(guess));
    cases
}
