//! The points of Gauss and of Lobatto, from Legendre polynomials.

use std::f64::consts::PI;

/// A rule on \[0, 1\]: ∫ g ≈ Σ weights g(points).
#[derive(Clone, Debug)]
pub(crate) struct Quadrature {
    pub(crate) points: Vec<f64>,
    pub(crate) weights: Vec<f64>,
}

/// Legendre polynomials Pₙ₋₁(x) and Pₙ(x), n ≥ 1, by the three-term recurrence.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut current) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        let next = ((2.0 * k - 1.0) * x * current - (k - 1.0) * previous) / k;
        (previous, current) = (current, next);
    }
    (previous, current)
}

/// The Gauss-Legendre rule with n points on \[0, 1\].
pub(super) fn gauss(n: usize) -> Quadrature {
    let order = n as f64;
    let mut rule = Quadrature {
        points: Vec::with_capacity(n),
        weights: Vec::with_capacity(n),
    };
    for i in (0..n).rev() {
        // Tricomi's estimate of the root of Pₙ, polished by Newton's method.
        let mut x = (PI * (i as f64 + 0.75) / (order + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..6 {
            let (previous, current) = legendre(n, x);
            slope = order * (previous - x * current) / (1.0 - x * x);
            x -= current / slope;
        }
        rule.points.push(0.5 * (1.0 + x));
        rule.weights.push(1.0 / ((1.0 - x * x) * slope * slope));
    }
    rule
}

/// The Lobatto points on \[0, 1\]: both ends and the roots of P'ₙ₋₁, all of them roots of
/// Pₙ − Pₙ₋₂, whose derivative is (2n − 1) Pₙ₋₁.
pub(super) fn lobatto_points(n: usize) -> Vec<f64> {
    let interior = |i: usize| {
        let mut x = -(PI * i as f64 / (n - 1) as f64).cos();
        for _ in 0..8 {
            let (p1, p) = legendre(n, x);
            let (_, p2) = legendre(n - 2, x);
            x -= (p - p2) / ((2 * n - 1) as f64 * p1);
        }
        0.5 * (1.0 + x)
    };
    let mut points = vec![0.0];
    points.extend((1..n - 1).map(interior));
    points.push(1.0);
    points
}
