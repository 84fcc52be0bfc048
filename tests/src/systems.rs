//! Systems of several coupled equations.

use crate::Case;
use bvp::{Ends, Problem, Real, Segment};
use std::f64::consts::PI;

/// Reaction and diffusion on a square, discretised by lines in one direction: 15 lines uᵢ between
/// two sides where u = 0, states u₁, u₁′, u₂, u₂′, …
///
/// ```text
/// uᵢ″ = 16 (2 uᵢ − uᵢ₋₁ − uᵢ₊₁) + uᵢ³,   uᵢ(0) = sin(π i/16),   uᵢ(1) = 0
/// ```
struct Lines;

impl Lines {
    /// Number of lines.
    const COUNT: usize = 15;
}

impl Problem for Lines {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2 * Self::COUNT)]
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], _: &[T], dy: &mut [T]) {
        let side = T::from_f64(0.0);
        for i in 0..Self::COUNT {
            let u = y[2 * i];
            let below = if i == 0 { side } else { y[2 * i - 2] };
            let above = if i + 1 == Self::COUNT {
                side
            } else {
                y[2 * i + 2]
            };
            dy[2 * i] = y[2 * i + 1];
            dy[2 * i + 1] = (u * 2.0 - below - above) * 16.0 + u.powi(3);
        }
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        let (left, right) = r.split_at_mut(Self::COUNT);
        for (i, (left, right)) in left.iter_mut().zip(right).enumerate() {
            let angle = PI * (i + 1) as f64 / 16.0;
            *left = at.start(0)[2 * i] - angle.sin();
            *right = at.end(0)[2 * i];
        }
    }
}

/// Three linear equations with growing and decaying modes that rotate, after Mattheij, on
/// 0 ≤ x ≤ π:
///
/// ```text
///      ⎡ 1 − m cos 2x   0   1 + m sin 2x ⎤
/// y′ = ⎢      0         m        0       ⎥ y + f(x),    y(0) + y(π) = g(0) + g(π)
///      ⎣ −1 + m sin 2x  0   1 + m cos 2x ⎦
/// ```
///
/// with m = 3; f is chosen such that y = g = (sin 4x, exp(cos 3x), 1/(1 + 4 (x − 1)²)).
pub(crate) struct RotatingModes;

impl RotatingModes {
    /// m.
    const GROWTH: f64 = 3.0;

    /// g.
    pub(crate) fn states<T: Real>(x: T) -> [T; 3] {
        let z = (x - 1.0) * 2.0;
        [
            (x * 4.0).sin(),
            (x * 3.0).cos().exp(),
            T::from_f64(1.0) / (z * z + 1.0),
        ]
    }

    /// g′.
    fn slopes<T: Real>(x: T) -> [T; 3] {
        let [_, bump, peak] = Self::states(x);
        [
            (x * 4.0).cos() * 4.0,
            (x * 3.0).sin() * bump * -3.0,
            (x - 1.0) * peak * peak * -8.0,
        ]
    }
}

impl Problem for RotatingModes {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(3, 0.0, PI)]
    }

    fn rhs<T: Real>(&self, _: usize, x: T, y: &[T], _: &[T], dy: &mut [T]) {
        let (sin, cos) = (x * 2.0).sin_cos();
        let (sin, cos) = (sin * Self::GROWTH, cos * Self::GROWTH);
        let (g, slopes) = (Self::states(x), Self::slopes(x));
        let z = [y[0] - g[0], y[1] - g[1], y[2] - g[2]];
        dy[0] = slopes[0] + (-cos + 1.0) * z[0] + (sin + 1.0) * z[2];
        dy[1] = slopes[1] + z[1] * Self::GROWTH;
        dy[2] = slopes[2] + (sin - 1.0) * z[0] + (cos + 1.0) * z[2];
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        let (left, right) = (Self::states(0.0), Self::states(PI));
        for i in 0..3 {
            r[i] = at.start(0)[i] + at.end(0)[i] - (left[i] + right[i]);
        }
    }
}

pub(crate) fn cases() -> Vec<Case> {
    let name = "thirty coupled equations, reaction and diffusion by lines";
    let source = "this project, in the spirit of the test of SciPy solve_bvp (big)";
    vec![Case::new("E25", name, source, Lines)]
}
