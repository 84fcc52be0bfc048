//! Lagrange polynomials.

use crate::discretisation::quadrature::{Quadrature, gauss};
use crate::discretisation::scheme::MAX_STAGES;
use crate::kernels::dense::add_scaled;

/// Lagrange polynomials ℓₗ on the collocation points and their integrals βₗ(θ) = ∫₀^θ ℓₗ.
#[derive(Clone, Debug)]
pub(super) struct Basis {
    points: Vec<f64>,
    /// 1 / Πⱼ (cₗ − cⱼ), j ≠ l.
    scale: Vec<f64>,
    /// The smallest Gauss rule that integrates ℓₗ exactly.
    rule: Quadrature,
}

impl Basis {
    pub(super) fn new(points: Vec<f64>) -> Self {
        let scale = (0..points.len())
            .map(|l| {
                let others = (0..points.len()).filter(|&j| j != l);
                1.0 / others.map(|j| points[l] - points[j]).product::<f64>()
            })
            .collect();
        let rule = gauss(points.len().div_ceil(2));
        Self {
            points,
            scale,
            rule,
        }
    }

    /// ℓₗ(x) for all l.
    #[inline(always)]
    pub(super) fn slopes(&self, x: f64, out: &mut [f64]) {
        // Products of the factors to the left of l, then times those to its right.
        let mut product = 1.0;
        for (out, (c, scale)) in out.iter_mut().zip(self.points.iter().zip(&self.scale)) {
            *out = scale * product;
            product *= x - c;
        }
        product = 1.0;
        for (out, c) in out.iter_mut().zip(&self.points).rev() {
            *out *= product;
            product *= x - c;
        }
    }

    /// ∫₀^x ℓₗ for all l.
    #[inline(always)]
    pub(super) fn values(&self, x: f64, out: &mut [f64]) {
        let mut at_point = [0.0; MAX_STAGES + 1];
        let at_point = &mut at_point[..out.len()];
        out.fill(0.0);
        for (t, weight) in self.rule.points.iter().zip(&self.rule.weights) {
            self.slopes(t * x, at_point);
            add_scaled(out, weight * x, at_point);
        }
    }

    /// The coefficients of uᵏ, u = 2x − 1, in all ℓₗ, a row per power.
    pub(super) fn powers(&self) -> Vec<f64> {
        let m = self.points.len();
        let mut powers = vec![0.0; m * m];
        for l in 0..m {
            // Factors x − cⱼ = u/2 + ½ − cⱼ, one after the other.
            let mut product = vec![self.scale[l]];
            for c in (0..m).filter(|&j| j != l).map(|j| self.points[j]) {
                let shifted = [&[0.0], &product[..]].concat();
                product.push(0.0);
                for (coefficient, before) in product.iter_mut().zip(shifted) {
                    *coefficient = (0.5 - c) * *coefficient + 0.5 * before;
                }
            }
            for (row, coefficient) in powers.chunks_exact_mut(m).zip(product) {
                row[l] = coefficient;
            }
        }
        powers
    }

    /// One row of `function` per point, row-major.
    pub(super) fn table(&self, points: &[f64], function: fn(&Self, f64, &mut [f64])) -> Vec<f64> {
        let m = self.points.len();
        let mut table = vec![0.0; points.len() * m];
        for (row, &x) in table.chunks_exact_mut(m).zip(points) {
            function(self, x, row);
        }
        table
    }
}

/// ℓ'(x) of all Lagrange polynomials on `points`.
pub(super) fn lagrange_slopes(points: &[f64], x: f64) -> Vec<f64> {
    let slope = |index: usize| -> f64 {
        let without = |skip: usize| -> f64 {
            (0..points.len())
                .filter(|&j| j != index && j != skip)
                .map(|j| (x - points[j]) / (points[index] - points[j]))
                .product()
        };
        (0..points.len())
            .filter(|&k| k != index)
            .map(|k| without(k) / (points[index] - points[k]))
            .sum()
    };
    (0..points.len()).map(slope).collect()
}
