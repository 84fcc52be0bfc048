//! Gauss quadrature and the shape functions of a spectral element.
//!
//! On −1 ≤ t ≤ 1, with Legendre polynomials `P_n`:
//!
//! ```text
//! φ_0 = (1 − t)/2,  φ_1 = (1 + t)/2,  φ_n = (P_n − P_{n−2})/√(4 n − 2)   (n ≥ 2)
//! φ_n' = √(n − ½) P_{n−1}
//! ```
//!
//! All but the first two vanish at both ends, and their derivatives are orthonormal.

use std::f64::consts::PI;

/// Newton's method for a node has converged where its step is below this.
const CONVERGED: f64 = 1e-15;
/// The most steps of Newton's method.
const STEPS: usize = 20;

/// Nodes and weights of the quadrature with so many points, exact to degree 2 `points` − 1.
pub(super) fn gauss(points: usize) -> Vec<(f64, f64)> {
    let n = points as f64;
    let node = |i: usize| {
        let mut t = (PI * (i as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = f64::NAN;
        for _ in 0..STEPS {
            let p = legendre(points, t);
            slope = n * (p[points - 1] - t * p[points]) / (1.0 - t * t);
            let step = p[points] / slope;
            t -= step;
            if step.abs() < CONVERGED {
                break;
            }
        }
        (t, 2.0 / ((1.0 - t * t) * slope * slope))
    };
    (0..points).map(node).collect()
}

/// `P_0` to `P_degree` at t.
fn legendre(degree: usize, t: f64) -> Vec<f64> {
    let mut p = vec![1.0, t];
    for n in 1..degree {
        let m = n as f64;
        p.push(((2.0 * m + 1.0) * t * p[n] - m * p[n - 1]) / (m + 1.0));
    }
    p
}

/// The values and derivatives of `φ_0` to `φ_degree` at t; the degree is at least one.
pub(super) fn shape_functions(degree: usize, t: f64) -> (Vec<f64>, Vec<f64>) {
    let p = legendre(degree, t);
    let (mut values, mut derivatives) = (vec![0.5 * (1.0 - t), 0.5 * (1.0 + t)], vec![-0.5, 0.5]);
    for n in 2..=degree {
        let twice = 2.0 * n as f64 - 1.0;
        values.push((p[n] - p[n - 2]) / (2.0 * twice).sqrt());
        derivatives.push(p[n - 1] * (0.5 * twice).sqrt());
    }
    (values, derivatives)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quadrature_is_exact_for_polynomials() {
        for points in [1, 2, 7, 60, 301] {
            let rule = gauss(points);
            for degree in [0, 1, points, 2 * points - 2, 2 * points - 1] {
                let power = i32::try_from(degree).expect("small");
                let sum: f64 = rule.iter().map(|(t, w)| w * t.powi(power)).sum();
                let even = degree % 2 == 0;
                let exact = if even {
                    2.0 / (degree as f64 + 1.0)
                } else {
                    0.0
                };
                assert!((sum - exact).abs() < 1e-13, "{points} {degree} {sum}");
            }
        }
    }

    #[test]
    fn the_shape_functions_have_orthonormal_derivatives() {
        let degree = 9;
        for i in 2..=degree {
            for j in 2..=degree {
                let term = |(t, w): (f64, f64)| {
                    let (_, d) = shape_functions(degree, t);
                    w * d[i] * d[j]
                };
                let product: f64 = gauss(degree + 1).into_iter().map(term).sum();
                let exact = if i == j { 1.0 } else { 0.0 };
                assert!((product - exact).abs() < 1e-13);
            }
        }
        let at = |t| shape_functions(degree, t).0;
        assert_eq!(at(-1.0)[..2], [1.0, 0.0]);
        assert!(
            at(1.0)[2..]
                .iter()
                .chain(&at(-1.0)[2..])
                .all(|v| v.abs() < 1e-15)
        );
    }
}
