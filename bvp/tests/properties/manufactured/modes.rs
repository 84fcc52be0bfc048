//! Equations near an exact solution: modes that grow, decay, rotate and are integrated.
//!
//! With the distance u of the states from the exact ones, in units of their sizes, and q that of the
//! parameters,
//!
//! ```text
//! u = Q R(s) z,    z′ = D z + B q + N(s, z, q)
//! ```
//!
//! where Q is a reflection, R turns pairs of modes by αs, D holds the rates, and N is quadratic: the
//! linear part has the fundamental solution Q R exp(D (s − a)), which is known, and every mode is
//! bounded by its value at one end.

use super::Draw;
use bvp::Real;

/// One term ν cos(s) φ(zᵢ, zⱼ or q) of N, quadratic at zero.
#[derive(Clone, Copy, Debug)]
struct Term {
    kind: usize,
    factor: f64,
    modes: [usize; 3],
    parameter: usize,
}

/// The modes of one segment.
#[derive(Clone, Debug)]
pub(super) struct Modes {
    ends: [f64; 2],
    /// Rates d; the last is zero and drives nothing if there is an integral.
    rates: Vec<f64>,
    /// z′ of the last mode is this times the first one; zero if there is no integral.
    integral: f64,
    /// Row-major, a row of parameters for every mode.
    b: Vec<f64>,
    /// Unit normal of the reflection Q = I − 2 h hᵀ.
    normal: Vec<f64>,
    /// α of every pair of modes.
    turns: Vec<f64>,
    terms: Vec<Term>,
}

impl Modes {
    pub(super) fn draw(draw: &mut Draw, ends: [f64; 2], n: usize, k: usize) -> Self {
        let integral = if n > 1 && draw.chance(0.3) {
            draw.between(0.5, 2.0)
        } else {
            0.0
        };
        let own = if integral > 0.0 { n - 1 } else { n };
        let mut rates: Vec<f64> = (0..own)
            .map(|_| draw.sign() * draw.log_between(0.3, 50.0))
            .collect();
        rates.resize(n, 0.0);
        let mut b: Vec<f64> = vec![0.0; n * k];
        for (i, b) in b[..own * k].iter_mut().enumerate() {
            *b = draw.between(-1.0, 1.0) * (1.0 + rates[i / k].abs());
        }
        let mut normal: Vec<f64> = (0..own).map(|_| draw.between(-1.0, 1.0)).collect();
        let length = normal.iter().map(|h| h * h).sum::<f64>().sqrt();
        normal.iter_mut().for_each(|h| *h /= length);
        normal.resize(n, 0.0);
        let strength = draw.between(0.0, 1.0);
        let mut terms = vec![];
        for (i, rate) in rates[..own].iter().enumerate() {
            for _ in 0..draw.below(3) {
                terms.push(Term {
                    kind: draw.below(if k > 0 { 5 } else { 4 }),
                    factor: strength * draw.between(-1.0, 1.0) * (1.0 + rate.abs()),
                    modes: [i, draw.below(n), draw.below(n)],
                    parameter: draw.below(k.max(1)),
                });
            }
        }
        Self {
            ends,
            rates,
            integral,
            b,
            normal,
            turns: (0..own / 2).map(|_| draw.between(-15.0, 15.0)).collect(),
            terms,
        }
    }

    /// Whether the last mode is the integral of the first.
    pub(super) fn has_integral(&self) -> bool {
        self.integral > 0.0
    }

    /// The end, 0 or 1, where a mode is largest.
    pub(super) fn large_end(&self, mode: usize) -> usize {
        usize::from(self.rates[mode] > 0.0)
    }

    /// Replaces z by u at s.
    pub(super) fn mix<T: Real>(&self, s: f64, z: &mut [T]) {
        self.turn(s, 1.0, z);
        self.reflect(z);
    }

    /// Replaces u by z at s.
    fn unmix<T: Real>(&self, s: f64, u: &mut [T]) {
        self.reflect(u);
        self.turn(s, -1.0, u);
    }

    fn turn<T: Real>(&self, s: f64, sense: f64, z: &mut [T]) {
        for (pair, turn) in z.chunks_exact_mut(2).zip(&self.turns) {
            let (sin, cos) = (sense * turn * s).sin_cos();
            let [x, y] = [pair[0], pair[1]];
            pair[0] = x * cos - y * sin;
            pair[1] = x * sin + y * cos;
        }
    }

    fn reflect<T: Real>(&self, z: &mut [T]) {
        let product = dot(&self.normal, z);
        for (z, h) in z.iter_mut().zip(&self.normal) {
            *z -= product * (2.0 * h);
        }
    }

    /// Replaces u by its derivative at s.
    pub(super) fn slope<T: Real>(&self, s: f64, u: &mut [T], q: &[T]) {
        self.unmix(s, u);
        let (z, n) = (u.to_vec(), u.len());
        for (i, (slope, rate)) in u.iter_mut().zip(&self.rates).enumerate() {
            *slope = z[i] * *rate + dot(&self.b[i * q.len()..][..q.len()], q);
        }
        u[n - 1] += z[0] * self.integral;
        for term in &self.terms {
            let [row, x, y] = term.modes;
            let (x, y) = (z[x], z[y]);
            let value = match term.kind {
                0 => x * y,
                1 => T::from_f64(1.0) - x.cos(),
                2 => x - x.sin(),
                3 => x * x / (y * y + 1.0),
                _ => x * q[term.parameter],
            };
            u[row] += value * (term.factor * s.cos());
        }
        for ((slope, z), turn) in u
            .chunks_exact_mut(2)
            .zip(z.chunks_exact(2))
            .zip(&self.turns)
        {
            slope[0] -= z[1] * *turn;
            slope[1] += z[0] * *turn;
        }
        self.mix(s, u);
    }

    /// The linear response u at one end, 0 or 1: of one mode, one at its large end; or, from the
    /// number of modes on, of a parameter alone.
    pub(super) fn response(&self, end: usize, column: usize) -> Vec<f64> {
        let (n, [a, _]) = (self.rates.len(), self.ends);
        let k = self.b.len() / n;
        let s = self.ends[end];
        let decayed = |i: usize, s: f64| (self.rates[i] * (s - self.ends[self.large_end(i)])).exp();
        let mut z = vec![0.0; n];
        // The integral of the first mode from a to s.
        let first = (decayed(0, s) - decayed(0, a)) / self.rates[0];
        if column < n {
            z[column] = decayed(column, s);
            if column == 0 {
                z[n - 1] += self.integral * first;
            }
        } else {
            for (i, z) in z
                .iter_mut()
                .enumerate()
                .filter(|(i, _)| self.rates[*i] != 0.0)
            {
                *z = self.b[i * k + column - n] * (decayed(i, s) - 1.0) / self.rates[i];
            }
            let forced = self.b[column - n] / self.rates[0];
            z[n - 1] += self.integral * forced * (first - (s - a));
        }
        self.mix(s, &mut z);
        z
    }
}

/// Σ aᵢ xᵢ.
pub(super) fn dot<T: Real>(a: &[f64], x: &[T]) -> T {
    let zero = T::from_f64(0.0);
    a.iter().zip(x).fold(zero, |sum, (a, x)| sum + *x * *a)
}
