//! Exact derivatives by dual numbers: the feature `bvp`.

use bvp::{Dual, LeftOf, Real};

/// Number of derivatives that one evaluation carries.
const WIDTH: usize = 4;

/// Equations G(x, p) = 0 written once over any scalar, for values and for exact derivatives.
pub trait Differentiable {
    /// `g` = G(x, p), as many numbers as states x; every one must be written. The bound lets numbers stand on
    /// the left, `2.0 * x[0]`; equations without them may leave it out.
    fn residual<T: Real>(&self, x: &[T], p: &[T], g: &mut [T])
    where
        f64: LeftOf<T>;
}

/// Writes the derivative of G along a direction: x and p, then the rates of both.
pub(crate) fn derivative_along(
    equations: &impl Differentiable,
    [x, p]: [&[f64]; 2],
    [dx, dp]: [&[f64]; 2],
    g: &mut [f64],
) {
    let along = |values: &[f64], rates: &[f64]| -> Vec<Dual<1>> {
        let pairs = values.iter().zip(rates);
        let dual = |(&value, &rate)| Dual {
            value,
            gradient: [rate],
        };
        pairs.map(dual).collect()
    };
    let mut dual = vec![Dual::constant(f64::NAN); g.len()];
    equations.residual(&along(x, dx), &along(p, dp), &mut dual);
    for (g, dual) in g.iter_mut().zip(dual) {
        *g = if dual.value.is_nan() {
            f64::NAN
        } else {
            dual.gradient[0]
        };
    }
}

/// Writes the derivatives of G with respect to x and p, n × (n + parameters), row-major.
pub(crate) fn derivatives(equations: &impl Differentiable, x: &[f64], p: &[f64], j: &mut [f64]) {
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
