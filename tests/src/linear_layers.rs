//! Linear problems with boundary layers, and linear problems with a smooth or oscillating solution.

use crate::{Case, SYMMETRIC, TEST_SET, UNIT, end_values};
use bvp::{Ends, Problem, Real, Segment};
use std::f64::consts::PI;

/// ε y″ = y, y(0) = 1, y(1) = 0: a layer of width √ε at x = 0.
pub(crate) struct Reaction {
    pub(crate) eps: f64,
}

impl Problem for Reaction {
    fn segments(&self) -> Vec<Segment> {
        UNIT.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = y[0] / self.eps;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        end_values(at, 1.0, 0.0, r);
    }
}

/// ε y″ = y′, y(0) = 1, y(1) = 0: a layer of width ε at x = 1.
struct Convection {
    eps: f64,
}

impl Problem for Convection {
    fn segments(&self) -> Vec<Segment> {
        UNIT.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = y[1] / self.eps;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        end_values(at, 1.0, 0.0, r);
    }
}

/// ε y″ + c y′ − y = −(1 + ε π²) cos πx − c π sin πx with c = 2 + cos πx, y(±1) = −1.
///
/// The solution cos πx is smooth, the operator is stiff.
struct StiffOperator {
    eps: f64,
}

impl Problem for StiffOperator {
    fn segments(&self) -> Vec<Segment> {
        SYMMETRIC.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, x: T, y: &[T], _: &[T], dy: &mut [T]) {
        let (sin, cos) = (x * PI).sin_cos();
        let c = cos + 2.0;
        dy[0] = y[1];
        dy[1] = (y[0] - c * y[1] - cos * (1.0 + self.eps * PI * PI) - c * sin * PI) / self.eps;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        end_values(at, -1.0, -1.0, r);
    }
}

/// ε y″ + y′ − (1 + ε) y = 0, y(−1) = 1 + e⁻², y(1) = 1 + exp(−2 (1 + ε)/ε): a layer of width ε
/// at x = −1 beside the smooth part exp(x − 1).
struct ConvectionReaction {
    eps: f64,
}

impl Problem for ConvectionReaction {
    fn segments(&self) -> Vec<Segment> {
        SYMMETRIC.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = (y[0] * (1.0 + self.eps) - y[1]) / self.eps;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        let layer = (-2.0 * (1.0 + self.eps) / self.eps).exp();
        end_values(at, 1.0 + (-2f64).exp(), 1.0 + layer, r);
    }
}

/// ε y″ − y = −(1 + ε π²) cos πx with given y(±1): cos πx, and a layer of width √ε at every end
/// whose value is not −1.
struct ReactionDiffusion {
    eps: f64,
    left: f64,
    right: f64,
}

impl Problem for ReactionDiffusion {
    fn segments(&self) -> Vec<Segment> {
        SYMMETRIC.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, x: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = (y[0] - (x * PI).cos() * (1.0 + self.eps * PI * PI)) / self.eps;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        end_values(at, self.left, self.right, r);
    }
}

/// y″ = −ω² y with ω = π/(2 ε), y(0) = 0, y(1) = sin ω.
struct Harmonic {
    eps: f64,
}

impl Harmonic {
    fn frequency(&self) -> f64 {
        PI / (2.0 * self.eps)
    }
}

impl Problem for Harmonic {
    fn segments(&self) -> Vec<Segment> {
        UNIT.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -y[0] * self.frequency().powi(2);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        end_values(at, 0.0, self.frequency().sin(), r);
    }
}

/// ε y″ = −y′, y(0) = 1, y(1) = exp(−1/ε): pure decay over a width ε.
struct Decay {
    eps: f64,
}

impl Problem for Decay {
    fn segments(&self) -> Vec<Segment> {
        UNIT.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -y[1] / self.eps;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        end_values(at, 1.0, (-1.0 / self.eps).exp(), r);
    }
}

pub(crate) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (id, eps) in [("T01a", 1e-2), ("T01b", 1e-4), ("T01c", 1e-6)] {
        let name = "linear reaction layer at left";
        cases.push(Case::new(id, name, TEST_SET, Reaction { eps }));
    }
    for (id, eps) in [("T02a", 1e-1), ("T02b", 1e-2), ("T02c", 1e-4)] {
        let name = "convection layer at right";
        cases.push(Case::new(id, name, TEST_SET, Convection { eps }));
    }
    for (id, eps) in [("T03a", 1e-1), ("T03b", 1e-2), ("T03c", 1e-4)] {
        let name = "smooth solution, stiff operator";
        cases.push(Case::new(id, name, TEST_SET, StiffOperator { eps }));
    }
    for (id, eps) in [("T04a", 1e-1), ("T04b", 1e-2), ("T04c", 1e-4)] {
        let name = "convection layer at left";
        cases.push(Case::new(id, name, TEST_SET, ConvectionReaction { eps }));
    }
    for (id, eps) in [("T11a", 1e-1), ("T11b", 1e-2), ("T11c", 1e-4)] {
        let name = "reaction-diffusion, smooth solution";
        let (left, right) = (-1.0, -1.0);
        let equations = ReactionDiffusion { eps, left, right };
        cases.push(Case::new(id, name, TEST_SET, equations));
    }
    for (id, eps) in [("T12a", 1e-2), ("T12b", 1e-4), ("T12c", 1e-6)] {
        let name = "reaction-diffusion, layer at right";
        let (left, right) = (-1.0, 0.0);
        let equations = ReactionDiffusion { eps, left, right };
        cases.push(Case::new(id, name, TEST_SET, equations));
    }
    for (id, eps) in [("T14a", 1e-2), ("T14b", 1e-4), ("T14c", 1e-6)] {
        let name = "reaction-diffusion, two layers";
        let value = (-2.0 / f64::sqrt(eps)).exp();
        let (left, right) = (value, value);
        let equations = ReactionDiffusion { eps, left, right };
        cases.push(Case::new(id, name, TEST_SET, equations));
    }
    for (id, odd) in [("T16a", 11.0), ("T16b", 51.0), ("T16c", 151.0)] {
        let name = "harmonic oscillation of high frequency";
        let eps = 1.0 / odd;
        cases.push(Case::new(id, name, TEST_SET, Harmonic { eps }));
    }
    for (id, eps) in [("T18a", 1e-1), ("T18b", 1e-2), ("T18c", 1e-4)] {
        let name = "pure decay layer";
        cases.push(Case::new(id, name, TEST_SET, Decay { eps }));
    }
    let source = "SciPy, test of solve_bvp (exp)";
    cases.push(Case::new("E11a", "y″ = y", source, Reaction { eps: 1.0 }));
    cases
}
