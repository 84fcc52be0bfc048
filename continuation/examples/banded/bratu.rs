//! Bratu's problem by second-order differences: a tridiagonal system that solves its own equations.

use continuation::{Cause, System};

/// u'' + λ eᵘ = 0, u(0) = u(1) = 0 at so many interior points:
///
/// ```text
/// uᵢ₋₁ − 2 uᵢ + uᵢ₊₁ + h² λ exp uᵢ = 0        z = (u₁ … uₙ, λ)
/// ```
///
/// The Jacobian \[A g\], A tridiagonal and g = h² eᵘ, is factored by elimination with row exchanges.
/// Row and column of the last pivot are left over: there either uₙ or λ is free, whichever has the
/// smaller pivot, so that a singular A needs no care.
pub(crate) struct Bratu {
    /// The rows of U: pivot, two superdiagonals, column of λ.
    upper: Vec<[f64; 4]>,
    /// The multiplier of every elimination, and whether the rows were exchanged before it.
    lower: Vec<(f64, bool)>,
    /// Sign of det A without its last pivot.
    sign: f64,
    right: Vec<f64>,
}

impl Bratu {
    /// The system with so many interior points.
    pub(crate) fn new(points: usize) -> Self {
        Self {
            upper: vec![[0.0; 4]; points],
            lower: vec![(0.0, false); points - 1],
            sign: 1.0,
            right: vec![0.0; points],
        }
    }

    fn spacing(&self) -> f64 {
        1.0 / (self.right.len() + 1) as f64
    }

    /// Solves U x + g λ = `right` with the last pivot of uₙ or of λ; the other one has the value
    /// `free`.
    fn back_substitute(&self, free: f64, v: &mut [f64]) {
        let n = self.right.len();
        let [pivot, _, _, column] = self.upper[n - 1];
        (v[n - 1], v[n]) = if pivot.abs() > column.abs() {
            ((self.right[n - 1] - column * free) / pivot, free)
        } else {
            (free, (self.right[n - 1] - pivot * free) / column)
        };
        for i in (0..n - 1).rev() {
            let [pivot, next, second, column] = self.upper[i];
            let beyond = if i + 2 < n { second * v[i + 2] } else { 0.0 };
            v[i] = (self.right[i] - next * v[i + 1] - beyond - column * v[n]) / pivot;
        }
    }
}

impl System for Bratu {
    fn unknowns(&self) -> usize {
        self.right.len() + 1
    }

    fn residual(&mut self, z: &[f64], g: &mut [f64]) {
        let (n, square) = (g.len(), self.spacing().powi(2));
        let at = |i: usize| if i == 0 || i == n + 1 { 0.0 } else { z[i - 1] };
        for (i, g) in g.iter_mut().enumerate() {
            *g = at(i) - 2.0 * at(i + 1) + at(i + 2) + square * z[n] * z[i].exp();
        }
    }

    fn linearise(&mut self, z: &[f64]) -> Result<(), Cause> {
        let (n, square) = (self.right.len(), self.spacing().powi(2));
        let row = |i: usize, below: f64| {
            let slope = square * z[i].exp();
            let above = if i + 1 < n { 1.0 } else { 0.0 };
            [below, slope.mul_add(z[n], -2.0), above, slope]
        };
        if !z.iter().all(|z| z.is_finite()) {
            return Err("a value is not finite".into());
        }
        self.sign = 1.0;
        let [_, diagonal, above, slope] = row(0, 0.0);
        let mut last = [diagonal, above, 0.0, slope];
        for i in 0..n - 1 {
            let [below, diagonal, above, slope] = row(i + 1, 1.0);
            let mut next = [below, diagonal, above, slope];
            let exchange = next[0].abs() > last[0].abs();
            if exchange {
                (last, next) = (next, last);
                self.sign = -self.sign;
            }
            let factor = next[0] / last[0];
            self.sign *= last[0].signum();
            self.upper[i] = last;
            self.lower[i] = (factor, exchange);
            last = [
                next[1] - factor * last[1],
                next[2] - factor * last[2],
                0.0,
                next[3] - factor * last[3],
            ];
        }
        self.upper[n - 1] = last;
        Ok(())
    }

    fn particular(&mut self, r: &[f64], v: &mut [f64]) {
        self.right.copy_from_slice(r);
        for (i, &(factor, exchange)) in self.lower.iter().enumerate() {
            if exchange {
                self.right.swap(i, i + 1);
            }
            self.right[i + 1] -= factor * self.right[i];
        }
        self.back_substitute(0.0, v);
    }

    fn null_vector(&mut self, t: &mut [f64]) {
        self.right.fill(0.0);
        let [pivot, _, _, column] = self.upper[self.right.len() - 1];
        // det [J; tᵀ] has the sign of det [J; eᵀ] times that of the free component, with e the unit
        // vector of the free unknown: λ, or uₙ with its column moved past that of λ.
        let orientation = if pivot.abs() > column.abs() {
            pivot
        } else {
            -column
        };
        self.back_substitute(self.sign * orientation.signum(), t);
    }

    fn groups(&self, group: &mut [usize], share: &mut [f64]) {
        group.fill(0);
        share.fill(1.0 / share.len() as f64);
    }
}
