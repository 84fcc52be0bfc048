//! Systems with exact derivatives: the feature `bvp`.

use crate::system::dense::DenseSystem;
use bvp::{Dual, Real};
use std::sync::Arc;

/// Number of derivatives that one evaluation carries.
const WIDTH: usize = 4;

/// Equations G(x, p) = 0 written once over any scalar, for values and for exact derivatives.
pub trait Differentiable {
    /// `g` = G(x, p), as many numbers as states x; every one must be written.
    fn residual<T: Real>(&self, x: &[T], p: &[T], g: &mut [T]);
}

impl DenseSystem {
    /// As [`new`](Self::new), with exact derivatives by dual numbers. Neither the units of the unknowns
    /// nor narrow features of G matter to these, as they do to differences.
    ///
    /// ```
    /// use bvp::Real;
    /// use continuation::{Branch, DenseSystem, Differentiable, Direction, Kind, Options};
    ///
    /// /// Steady states of a stirred tank (Uppal, Ray & Poore 1974).
    /// struct Tank;
    ///
    /// impl Differentiable for Tank {
    ///     fn residual<T: Real>(&self, x: &[T], p: &[T], g: &mut [T]) {
    ///         let rate = p[0] * (-x[0] + 1.0) * x[1].exp();
    ///         g[0] = rate - x[0];
    ///         g[1] = p[1] * rate - (p[2] + 1.0) * x[1];
    ///     }
    /// }
    ///
    /// let mut tank = DenseSystem::exact(2, &[0.0, 18.0, 3.0], 0, Tank);
    /// let options = Options::within(0.0, 0.3);
    /// let branch = Branch::new(&mut tank, &[0.0; 3], Direction::Increasing, &options)?;
    /// let limits: Vec<_> = branch.filter(|point| point.kind == Kind::LimitPoint).collect();
    /// assert!((limits[0].lambda() - 0.5 * (-1.5f64).exp()).abs() < 1e-15);
    /// # Ok::<(), continuation::Error>(())
    /// ```
    ///
    /// # Panics
    /// If there is no parameter of the number `lambda`.
    pub fn exact(
        states: usize,
        parameters: &[f64],
        lambda: usize,
        equations: impl Differentiable + Send + Sync + 'static,
    ) -> Self {
        let equations = Arc::new(equations);
        let values = Arc::clone(&equations);
        Self::new(states, parameters, lambda, move |x, p, g| {
            values.residual(x, p, g);
        })
        .with_jacobian(move |x, p, j| derivatives(&*equations, x, p, j))
    }
}

/// Writes the derivatives of G with respect to x and p, n × (n + parameters), row-major.
fn derivatives(equations: &impl Differentiable, x: &[f64], p: &[f64], j: &mut [f64]) {
    let (n, columns) = (x.len(), x.len() + p.len());
    let constant = |value: &f64| Dual::<WIDTH>::constant(*value);
    let mut unknowns: Vec<_> = x.iter().chain(p).map(constant).collect();
    let mut g = vec![constant(&f64::NAN); n];
    for first in (0..columns).step_by(WIDTH) {
        let last = (first + WIDTH).min(columns);
        for (direction, unknown) in unknowns[first..last].iter_mut().enumerate() {
            unknown.gradient[direction] = 1.0;
        }
        let (x, p) = unknowns.split_at(n);
        equations.residual(x, p, &mut g);
        for (row, g) in j.chunks_exact_mut(columns).zip(&mut g) {
            row[first..last].copy_from_slice(&g.gradient[..last - first]);
            *g = constant(&f64::NAN);
        }
        for unknown in &mut unknowns[first..last] {
            unknown.gradient = [0.0; WIDTH];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gᵢ = xᵢ² p₀ + xᵢ₊₁ p₁, cyclic.
    struct Ring;

    impl Differentiable for Ring {
        fn residual<T: Real>(&self, x: &[T], p: &[T], g: &mut [T]) {
            for (i, g) in g.iter_mut().enumerate() {
                *g = x[i] * x[i] * p[0] + x[(i + 1) % x.len()] * p[1];
            }
        }
    }

    #[test]
    fn derivatives_are_exact_for_any_number_of_unknowns() {
        for n in 2..11 {
            let x: Vec<f64> = (0..n).map(|i| 0.5 + i as f64).collect();
            let p = [3.0, -2.0];
            let mut j = vec![f64::NAN; n * (n + 2)];
            derivatives(&Ring, &x, &p, &mut j);
            for (i, row) in j.chunks_exact(n + 2).enumerate() {
                let next = (i + 1) % n;
                let mut expected = vec![0.0; n + 2];
                expected[i] = 2.0 * x[i] * p[0];
                expected[next] = p[1];
                expected[n] = x[i] * x[i];
                expected[n + 1] = x[next];
                assert_eq!(row, expected);
            }
        }
    }
}
