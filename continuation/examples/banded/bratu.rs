//! Bratu's problem by second-order differences: a tridiagonal system.

use continuation::SparseSystem;

/// u'' + λ eᵘ = 0, u(0) = u(1) = 0 at this many interior points:
///
/// ```text
/// uᵢ₋₁ − 2 uᵢ + uᵢ₊₁ + h² λ exp uᵢ = 0        z = (u₁ … uₙ, λ)
/// ```
///
/// All uᵢ are samples of one function.
pub(crate) fn bratu(points: usize) -> SparseSystem {
    let square = ((points + 1) as f64).powi(-2);
    let residual = move |u: &[f64], p: &[f64], g: &mut [f64]| {
        let at = |i: usize| {
            if i == 0 || i == points + 1 {
                0.0
            } else {
                u[i - 1]
            }
        };
        for (i, g) in g.iter_mut().enumerate() {
            *g = at(i) - 2.0 * at(i + 1) + at(i + 2) + square * p[0] * u[i].exp();
        }
    };
    SparseSystem::new(points, &[0.0], 0, residual, move |u, p, put| {
        for (i, u) in u.iter().enumerate() {
            let slope = square * u.exp();
            if i > 0 {
                put(i, i - 1, 1.0);
                put(i - 1, i, 1.0);
            }
            put(i, i, slope * p[0] - 2.0);
            put(i, points, slope);
        }
    })
    .with_groups(&vec![0; points])
}
