//! Nonlinear problems with boundary layers and shocks.

use crate::{Case, TEST_SET, UNIT, end_values, straight};
use bvp::{Ends, Problem, Real, Segment};
use std::f64::consts::PI;

/// ε y″ + eʸ y′ = (π/2) sin(πx/2) e²ʸ, y(0) = y(1) = 0: a layer of width ε at x = 0.
struct ExponentialConvection {
    eps: f64,
}

impl Problem for ExponentialConvection {
    fn segments(&self) -> Vec<Segment> {
        UNIT.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, x: T, y: &[T], _: &[T], dy: &mut [T]) {
        let exp = y[0].exp();
        dy[0] = y[1];
        dy[1] = exp * (exp * (x * (PI / 2.0)).sin() * (PI / 2.0) - y[1]) / self.eps;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        end_values(at, 0.0, 0.0, r);
    }
}

/// ε y″ = y + y² − exp(−2x/√ε), y(0) = 1, y(1) = exp(−1/√ε): the layer exp(−x/√ε).
struct QuadraticReaction {
    eps: f64,
}

impl QuadraticReaction {
    fn right_value(&self) -> f64 {
        (-1.0 / self.eps.sqrt()).exp()
    }
}

impl Problem for QuadraticReaction {
    fn segments(&self) -> Vec<Segment> {
        UNIT.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, x: T, y: &[T], _: &[T], dy: &mut [T]) {
        let forcing = (x * (-2.0 / self.eps.sqrt())).exp();
        dy[0] = y[1];
        dy[1] = (y[0] + y[0] * y[0] - forcing) / self.eps;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        end_values(at, 1.0, self.right_value(), r);
    }
}

/// Troesch: y″ = μ sinh μy with μ = 1/ε, y(0) = 0, y(1) = 1: a layer at x = 1.
struct Troesch {
    eps: f64,
}

impl Problem for Troesch {
    fn segments(&self) -> Vec<Segment> {
        UNIT.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = (y[0] / self.eps).sinh() / self.eps;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        end_values(at, 0.0, 1.0, r);
    }
}

/// Shock in a nozzle of section A = 1 + x², γ = 1.4:
///
/// ```text
/// ε A y y″ = ((1 + γ)/2 − ε A′) y y′ − y′/y − (A′/A) (1 − (γ − 1)/2 y²)
/// y(0) = 0.9129, y(1) = 0.375
/// ```
struct Nozzle {
    eps: f64,
}

impl Nozzle {
    const LEFT: f64 = 0.9129;
    const RIGHT: f64 = 0.375;
    /// Ratio of the specific heats γ.
    const GAMMA: f64 = 1.4;
}

impl Problem for Nozzle {
    fn segments(&self) -> Vec<Segment> {
        UNIT.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, x: T, y: &[T], _: &[T], dy: &mut [T]) {
        let section = x * x + 1.0;
        let widening = x * 2.0;
        let (u, slope) = (y[0], y[1]);
        let inertia = (-widening * self.eps + (1.0 + Self::GAMMA) / 2.0) * u * slope;
        let pressure = slope / u;
        let source = widening / section * (-u * u * ((Self::GAMMA - 1.0) / 2.0) + 1.0);
        dy[0] = slope;
        dy[1] = (inertia - pressure - source) / (section * u * self.eps);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        end_values(at, Self::LEFT, Self::RIGHT, r);
    }
}

/// Lagerstrom and Cole: ε y″ + y y′ − y = 0 with given y(0), y(1); boundary layers or an interior
/// shock, depending on the end values.
struct LagerstromCole {
    eps: f64,
    left: f64,
    right: f64,
}

impl Problem for LagerstromCole {
    fn segments(&self) -> Vec<Segment> {
        UNIT.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = y[0] * (-y[1] + 1.0) / self.eps;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        end_values(at, self.left, self.right, r);
    }
}

/// The three cases of one pair of end values.
fn lagerstrom_cole(
    ids: [&'static str; 3],
    name: &'static str,
    eps: [f64; 3],
    (left, right): (f64, f64),
) -> impl Iterator<Item = Case> {
    ids.into_iter().zip(eps).map(move |(id, eps)| {
        let equations = LagerstromCole { eps, left, right };
        Case::new(id, name, TEST_SET, equations).with_guess(straight(left, right))
    })
}

pub(crate) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (id, eps) in [("T19a", 1e-1), ("T19b", 1e-2), ("T19c", 1e-3)] {
        let name = "exponential nonlinearity, layer at left";
        cases.push(Case::new(id, name, TEST_SET, ExponentialConvection { eps }));
    }
    for (id, eps) in [("T21a", 1e-1), ("T21b", 1e-2), ("T21c", 1e-4)] {
        let name = "nonlinear reaction layer";
        let equations = QuadraticReaction { eps };
        let guess = straight(1.0, equations.right_value());
        cases.push(Case::new(id, name, TEST_SET, equations).with_guess(guess));
    }
    for (id, mu) in [("T23a", 5.0), ("T23b", 10.0), ("T23c", 15.0)] {
        let name = "Troesch's problem";
        let equations = Troesch { eps: 1.0 / mu };
        cases.push(Case::new(id, name, TEST_SET, equations).with_guess(straight(0.0, 1.0)));
    }
    for (id, eps) in [("T24a", 0.05), ("T24b", 0.02), ("T24c", 0.005)] {
        let name = "shock in a nozzle";
        let guess = straight(Nozzle::LEFT, Nozzle::RIGHT);
        cases.push(Case::new(id, name, TEST_SET, Nozzle { eps }).with_guess(guess));
    }
    let shock = "Lagerstrom and Cole's equation, interior shock";
    let layer = "Lagerstrom and Cole's equation, boundary layer";
    let eps = [0.1, 0.02, 0.005];
    let ids = ["T26a", "T26b", "T26c"];
    cases.extend(lagerstrom_cole(ids, shock, eps, (1.0, -1.0 / 3.0)));
    let ids = ["T27a", "T27b", "T27c"];
    cases.extend(lagerstrom_cole(ids, layer, eps, (1.0, 1.0 / 3.0)));
    let ids = ["T29a", "T29b", "T29c"];
    cases.extend(lagerstrom_cole(ids, layer, [0.1, 0.02, 0.001], (0.0, 1.5)));
    let ids = ["T30a", "T30b", "T30c"];
    cases.extend(lagerstrom_cole(ids, shock, eps, (-7.0 / 6.0, 1.5)));
    cases
}
