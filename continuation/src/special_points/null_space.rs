//! The null space of a Jacobian with one more column.
//!
//! ```text
//! ┌ J  b ┐ T = 0,     T = ┌ t   v  ┐ / norms,     J t = 0,   J v = b,   v ⟂ t
//!                         └ 0  −1  ┘
//! ```
//!
//! Near a branch point J has a second near-null vector, v grows along it without bound, and T
//! remains well-conditioned: its span is the null space of a matrix within rounding of \[J b\].

use crate::curve::corrector::Corrector;
use crate::curve::metric::Metric;
use crate::difficulty::Difficulty;
use crate::system::system::System;

/// An orthonormal basis of the null space of \[J b\]: each vector has the n + 1 unknowns and then the
/// component η that multiplies b.
#[derive(Clone, Debug)]
pub(crate) struct NullSpace(pub(crate) [Vec<f64>; 2]);

impl NullSpace {
    /// Linearises at `z` and finds the basis for the column `b`. The first vector has η = 0.
    pub(crate) fn at<S: System>(
        system: &mut S,
        corrector: &mut Corrector,
        metric: &Metric,
        z: &[f64],
        b: &[f64],
    ) -> Result<Self, Difficulty> {
        let mut t = corrector.tangent(system, metric, z)?;
        let v = Self::second(system, metric, &t, b).ok_or(Difficulty::Singular)?;
        t.push(0.0);
        Ok(Self([t, v]))
    }

    /// The second vector of the basis, where the system was linearised last, with unit tangent `t`.
    pub(crate) fn second<S: System>(
        system: &mut S,
        metric: &Metric,
        t: &[f64],
        b: &[f64],
    ) -> Option<Vec<f64>> {
        let mut v = vec![0.0; t.len()];
        system.particular(b, &mut v);
        for _ in 0..2 {
            let along = metric.dot(&v, t);
            v.iter_mut().zip(t).for_each(|(v, t)| *v -= along * t);
        }
        let norm = metric.norm(&v).hypot(1.0);
        v.iter_mut().for_each(|v| *v /= norm);
        v.push(-1.0 / norm);
        norm.is_finite().then_some(v)
    }

    /// The η components φ of the basis of the same space that is dual to `reference`: a smooth
    /// function of the place, zero where J has two null vectors.
    pub(crate) fn eta(&self, metric: &Metric, reference: &Self) -> Option<[f64; 2]> {
        let [[a, b], [c, d]] = self.alignment(metric, reference);
        // φ M = (η₁, η₂), transposed.
        solve([[a, c], [b, d]], [self.last(0), self.last(1)])
    }

    /// The determinant of the components (λ, η) of the basis dual to `reference`: a smooth function
    /// of the place, zero where a null vector has neither.
    pub(crate) fn determinant(&self, metric: &Metric, reference: &Self) -> f64 {
        let [[a, b], [c, d]] = self.alignment(metric, reference);
        let lambda = |j: usize| self.0[j][self.0[j].len() - 2];
        (lambda(0) * self.last(1) - lambda(1) * self.last(0)) / (a * d - b * c)
    }

    /// Turns the second vector so that the basis is oriented as `reference`.
    pub(crate) fn orient(&mut self, metric: &Metric, reference: &Self) {
        let [[a, b], [c, d]] = self.alignment(metric, reference);
        if a * d - b * c < 0.0 {
            self.0[1].iter_mut().for_each(|x| *x = -*x);
        }
    }

    /// Turns the basis within its space to where it is closest to `reference`.
    pub(crate) fn align(&mut self, metric: &Metric, reference: &Self) {
        self.orient(metric, reference);
        let [[a, b], [c, d]] = self.alignment(metric, reference);
        let (sine, cosine) = (c - b).atan2(a + d).sin_cos();
        self.0 = [self.combine([cosine, -sine]), self.combine([sine, cosine])];
    }

    /// The products ⟨reference, basis⟩.
    fn alignment(&self, metric: &Metric, reference: &Self) -> [[f64; 2]; 2] {
        let product = |i: usize, j: usize| dot(metric, &reference.0[i], &self.0[j]);
        [
            [product(0, 0), product(0, 1)],
            [product(1, 0), product(1, 1)],
        ]
    }

    /// The η component of a basis vector.
    pub(crate) fn last(&self, j: usize) -> f64 {
        self.0[j][self.0[j].len() - 1]
    }

    /// The part of `vector` (n + 2 numbers) that is orthogonal to the space.
    fn project_out(&self, metric: &Metric, vector: &mut [f64]) {
        for _ in 0..2 {
            for basis in &self.0 {
                let along = dot(metric, basis, vector);
                vector
                    .iter_mut()
                    .zip(basis)
                    .for_each(|(x, b)| *x -= along * b);
            }
        }
    }

    /// The vector w = (v, η) orthogonal to the space with \[J b\] w = r, J where the system was
    /// linearised last.
    ///
    /// Near a branch point a solution of J v = r is huge and its part orthogonal to the space lost in
    /// rounding; but η is not, and J v = r − η b has a solution of the size of w.
    pub(crate) fn shortest<S: System>(
        &self,
        system: &mut S,
        metric: &Metric,
        b: &[f64],
        r: &[f64],
    ) -> Vec<f64> {
        let (n, mut eta) = (r.len(), 0.0);
        let mut w = vec![0.0; n + 2];
        for _ in 0..2 {
            let right: Vec<f64> = r.iter().zip(b).map(|(r, b)| r - eta * b).collect();
            system.particular(&right, &mut w[..=n]);
            w[n + 1] = eta;
            self.project_out(metric, &mut w);
            eta = w[n + 1];
        }
        w
    }

    /// The derivative of [`eta`](Self::eta) where both basis vectors change at these `rates`.
    pub(crate) fn eta_rate(
        &self,
        metric: &Metric,
        reference: &Self,
        rates: &[Vec<f64>; 2],
    ) -> Option<[f64; 2]> {
        let [[a, b], [c, d]] = self.alignment(metric, reference);
        let [p, q] = self.eta(metric, reference)?;
        // φ′ M = η′ − φ M′, transposed.
        let right = [0, 1].map(|j| {
            let turn = |i: usize| dot(metric, &reference.0[i], &rates[j]);
            rates[j][rates[j].len() - 1] - p * turn(0) - q * turn(1)
        });
        solve([[a, c], [b, d]], right)
    }

    /// The derivative of [`determinant`](Self::determinant) where both basis vectors change at these
    /// `rates`.
    pub(crate) fn determinant_rate(
        &self,
        metric: &Metric,
        reference: &Self,
        rates: &[Vec<f64>; 2],
    ) -> f64 {
        let [[a, b], [c, d]] = self.alignment(metric, reference);
        let turn = |i: usize, j: usize| dot(metric, &reference.0[i], &rates[j]);
        let scale = a * d - b * c;
        let scale_rate = turn(0, 0) * d + a * turn(1, 1) - turn(0, 1) * c - b * turn(1, 0);
        let ends = |v: &[f64]| [v[v.len() - 2], v[v.len() - 1]];
        let cross = |[p, q]: [f64; 2], [r, s]: [f64; 2]| p * s - r * q;
        let [first, second] = [0, 1].map(|j| ends(&self.0[j]));
        let rate = cross(ends(&rates[0]), second) + cross(first, ends(&rates[1]));
        (rate - self.determinant(metric, reference) * scale_rate) / scale
    }

    /// Σ aᵢ Tᵢ.
    pub(crate) fn combine(&self, a: [f64; 2]) -> Vec<f64> {
        let [first, second] = &self.0;
        first
            .iter()
            .zip(second)
            .map(|(x, y)| a[0] * x + a[1] * y)
            .collect()
    }
}

/// The inner product with a last component η of weight one.
pub(crate) fn dot(metric: &Metric, a: &[f64], b: &[f64]) -> f64 {
    let n = a.len() - 1;
    metric.dot(&a[..n], &b[..n]) + a[n] * b[n]
}

/// The solution of a 2 × 2 system, unless it is singular.
pub(crate) fn solve(m: [[f64; 2]; 2], r: [f64; 2]) -> Option<[f64; 2]> {
    let determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    let x = [
        (r[0] * m[1][1] - m[0][1] * r[1]) / determinant,
        (m[0][0] * r[1] - r[0] * m[1][0]) / determinant,
    ];
    x.iter().all(|x| x.is_finite()).then_some(x)
}
