//! Linear problems with a turning point or a spike inside the interval.

use crate::{Case, SYMMETRIC, TEST_SET, end_values};
use bvp::{Ends, Problem, Real, Segment};
use std::f64::consts::PI;

/// ε y″ + x y′ = −ε π² cos πx − π x sin πx, y(−1) = −2, y(1) = 0: a shock of width √ε at the
/// turning point x = 0.
struct Shock {
    eps: f64,
}

impl Problem for Shock {
    fn segments(&self) -> Vec<Segment> {
        SYMMETRIC.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, x: T, y: &[T], _: &[T], dy: &mut [T]) {
        let (sin, cos) = (x * PI).sin_cos();
        dy[0] = y[1];
        dy[1] = -(x * y[1] + cos * (self.eps * PI * PI) + x * sin * PI) / self.eps;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        end_values(at, -2.0, 0.0, r);
    }
}

/// ε y″ + x y′ − y = −(1 + ε π²) cos πx − π x sin πx, y(∓1) = ∓1: a corner of width √ε at the
/// turning point x = 0.
struct Corner {
    eps: f64,
}

impl Problem for Corner {
    fn segments(&self) -> Vec<Segment> {
        SYMMETRIC.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, x: T, y: &[T], _: &[T], dy: &mut [T]) {
        let (sin, cos) = (x * PI).sin_cos();
        dy[0] = y[1];
        let forcing = cos * (1.0 + self.eps * PI * PI) + x * sin * PI;
        dy[1] = (y[0] - x * y[1] - forcing) / self.eps;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        end_values(at, -1.0, 1.0, r);
    }
}

/// (ε + x²) y″ + 4 x y′ + 2 y = 0, y(±1) = 1/(1 + ε): the spike 1/(ε + x²).
pub(crate) struct Spike {
    pub(crate) eps: f64,
}

impl Problem for Spike {
    fn segments(&self) -> Vec<Segment> {
        SYMMETRIC.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, x: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -(x * y[1] * 4.0 + y[0] * 2.0) / (x * x + self.eps);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        let value = 1.0 / (1.0 + self.eps);
        end_values(at, value, value, r);
    }
}

/// ε y″ = x y, y(±1) = 1: Airy functions of x/∛ε, oscillating at left and with a layer at right.
struct Airy {
    eps: f64,
}

impl Problem for Airy {
    fn segments(&self) -> Vec<Segment> {
        SYMMETRIC.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, x: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = x * y[0] / self.eps;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        end_values(at, 1.0, 1.0, r);
    }
}

pub(crate) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (id, eps) in [("T06a", 1e-1), ("T06b", 1e-2), ("T06c", 1e-4)] {
        let source = "Cash, Wright and Mazzia, test set for boundary value problem solvers; \
                      MATLAB shockbvp; SciPy, test of solve_bvp (shock)";
        let name = "turning point with interior shock";
        cases.push(Case::new(id, name, source, Shock { eps }));
    }
    for (id, eps) in [("T07a", 1e-2), ("T07b", 1e-4), ("T07c", 1e-5)] {
        let name = "turning point with corner layer";
        cases.push(Case::new(id, name, TEST_SET, Corner { eps }));
    }
    for (id, eps) in [("T09a", 1e-1), ("T09b", 1e-2), ("T09c", 1e-4)] {
        let name = "spike of Runge's kind";
        cases.push(Case::new(id, name, TEST_SET, Spike { eps }));
    }
    for (id, eps) in [("T15a", 1e-2), ("T15b", 1e-3), ("T15c", 1e-5)] {
        let name = "Airy turning point, oscillating at left, layer at right";
        cases.push(Case::new(id, name, TEST_SET, Airy { eps }));
    }
    cases
}
