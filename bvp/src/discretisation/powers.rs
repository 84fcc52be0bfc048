//! The solution on one interval in powers, by which it is evaluated at many places at the least cost.

use crate::discretisation::iterate::Interval;
use crate::discretisation::tableau::Tableau;

/// The collocation polynomials of the n states of an interval of length h, in powers of u, which runs from −1
/// at its left end to 1 at its right end:
///
/// ```text
/// y' = Σ cₖ uᵏ,      y = d₀ + Σ dₖ₊₁ uᵏ⁺¹,      dₖ₊₁ = h cₖ / (2 (k + 1))
/// ```
#[derive(Clone, Debug, Default)]
pub(crate) struct Powers {
    /// cₖ, m × n, and then dₖ, (m + 1) × n.
    coefficients: Vec<f64>,
}

impl Powers {
    /// Makes room for m stages and n states.
    pub(crate) fn resize(&mut self, [m, n]: [usize; 2]) {
        self.coefficients.resize((2 * m + 1) * n, 0.0);
    }

    /// Finds the coefficients on an interval with m stages and n states.
    #[inline(always)]
    pub(crate) fn expand(&mut self, [m, n]: [usize; 2], t: &Tableau, interval: &Interval<'_>) {
        let (slopes, states) = self.coefficients[..(2 * m + 1) * n].split_at_mut(m * n);
        let slopes = slopes.chunks_exact_mut(n);
        let (start, states) = states.split_at_mut(n);
        start.copy_from_slice(interval.y);
        let (mut at_start, mut twice) = (-1.0, 2.0);
        let rows = t.powers_of_slope[..m * m].chunks_exact(m);
        for ((slope, state), row) in slopes.zip(states.chunks_exact_mut(n)).zip(rows) {
            interval.slope(row, slope);
            for ((start, state), slope) in start.iter_mut().zip(state).zip(&*slope) {
                *state = interval.h / twice * slope;
                *start -= at_start * *state;
            }
            (at_start, twice) = (-at_start, twice + 2.0);
        }
    }

    /// The states at u.
    #[inline(always)]
    pub(crate) fn state(&self, [m, n]: [usize; 2], u: f64, y: &mut [f64]) {
        horner(&self.coefficients[m * n..(2 * m + 1) * n], n, u, y);
    }

    /// Their slopes at u.
    #[inline(always)]
    pub(crate) fn slope(&self, [m, n]: [usize; 2], u: f64, slope: &mut [f64]) {
        horner(&self.coefficients[..m * n], n, u, slope);
    }
}

/// n polynomials at u from their coefficients, n per power, by Horner's rule. Two at a time fill the vector
/// registers of every machine and stay in them.
#[inline(always)]
fn horner(coefficients: &[f64], n: usize, u: f64, values: &mut [f64]) {
    let powers = || coefficients.chunks_exact(n).rev();
    let mut first = 0;
    let mut pairs = values.chunks_exact_mut(2);
    for pair in &mut pairs {
        let sums = powers().fold([0.0; 2], |[a, b], power| {
            [a * u + power[first], b * u + power[first + 1]]
        });
        pair.copy_from_slice(&sums);
        first += 2;
    }
    for value in pairs.into_remainder() {
        *value = powers().fold(0.0, |sum, power| sum * u + power[first]);
    }
}
