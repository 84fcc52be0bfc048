//! Problems of any number of states whose Jacobians are written by hand.

use bvp::{Ends, Equations, Segment, Shape};

/// y′ = A y with a full antisymmetric A; the first half of the states is 1 at s = 0, the others
/// are 1 at s = 1. The Jacobian costs no more than to copy A.
pub(crate) struct Rotation {
    segments: [Segment; 1],
    a: Vec<f64>,
}

impl Rotation {
    /// With so many states.
    pub(crate) fn new(states: usize) -> Self {
        let mut a = vec![0.0; states * states];
        for i in 0..states {
            for j in 0..i {
                // Spread over [−1, 1] and of bounded norm.
                let value = ((i * 7 + j * 13) as f64).sin() / states as f64;
                a[i * states + j] = value;
                a[j * states + i] = -value;
            }
        }
        Self {
            segments: [Segment::new(states)],
            a,
        }
    }

    fn states(&self) -> usize {
        self.segments[0].states
    }
}

impl Equations for Rotation {
    fn shape(&self) -> Shape {
        Shape::new(self.segments.to_vec(), 0)
    }

    fn evaluate_rhs(&self, _: usize, _: f64, y: &[f64], _: &[f64], dy: &mut [f64]) {
        for (dy, row) in dy.iter_mut().zip(self.a.chunks_exact(y.len())) {
            *dy = row.iter().zip(y).map(|(a, y)| a * y).sum();
        }
    }

    fn rhs_jacobian(
        &self,
        segment: usize,
        s: f64,
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobian: &mut [f64],
    ) {
        self.evaluate_rhs(segment, s, y, p, dy);
        jacobian.copy_from_slice(&self.a);
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, _: &[f64], r: &mut [f64]) {
        let half = self.states() / 2;
        for (i, r) in r.iter_mut().enumerate() {
            let end = if i < half { at.start(0) } else { at.end(0) };
            *r = end[i] - 1.0;
        }
    }

    fn conditions_jacobian(
        &self,
        at: Ends<'_, f64>,
        p: &[f64],
        r: &mut [f64],
        jacobian: &mut [f64],
    ) {
        self.evaluate_conditions(at, p, r);
        let n = self.states();
        jacobian.fill(0.0);
        for i in 0..n {
            let column = if i < n / 2 { i } else { n + i };
            jacobian[i * 2 * n + column] = 1.0;
        }
    }
}

/// A reaction with diffusion on a rectangle, ∂²u/∂s² + ∂²u/∂x² = u³ with u(s, 0) = u(s, 1) = 0 and
/// u(0, x) = u(1, x) = sin πx, on the equidistant lines x = j / (N + 1), j = 1 … N:
///
/// ```text
/// uⱼ″ = (2 uⱼ − uⱼ₋₁ − uⱼ₊₁) (N + 1)² + uⱼ³
/// ```
///
/// 2 N states u₁, u₁′, u₂, u₂′, …
pub(crate) struct ReactionDiffusion {
    segments: [Segment; 1],
    lines: usize,
}

impl ReactionDiffusion {
    /// With N lines.
    pub(crate) fn new(lines: usize) -> Self {
        Self {
            segments: [Segment::new(2 * lines)],
            lines,
        }
    }

    /// (N + 1)².
    fn diffusion(&self) -> f64 {
        ((self.lines + 1) as f64).powi(2)
    }
}

impl Equations for ReactionDiffusion {
    fn shape(&self) -> Shape {
        Shape::new(self.segments.to_vec(), 0)
    }

    fn evaluate_rhs(&self, _: usize, _: f64, y: &[f64], _: &[f64], dy: &mut [f64]) {
        let u = |line: Option<usize>| line.and_then(|j| y.get(2 * j)).copied().unwrap_or(0.0);
        for (j, dy) in dy.chunks_exact_mut(2).enumerate() {
            let here = u(Some(j));
            let around = u(j.checked_sub(1)) + u(Some(j + 1));
            dy[0] = y[2 * j + 1];
            dy[1] = (2.0 * here - around) * self.diffusion() + here.powi(3);
        }
    }

    fn rhs_jacobian(
        &self,
        segment: usize,
        s: f64,
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobian: &mut [f64],
    ) {
        self.evaluate_rhs(segment, s, y, p, dy);
        jacobian.fill(0.0);
        let columns = y.len();
        for (j, rows) in jacobian.chunks_exact_mut(2 * columns).enumerate() {
            let (first, second) = rows.split_at_mut(columns);
            first[2 * j + 1] = 1.0;
            second[2 * j] = 2.0 * self.diffusion() + 3.0 * y[2 * j].powi(2);
            if j > 0 {
                second[2 * j - 2] = -self.diffusion();
            }
            if j + 1 < self.lines {
                second[2 * j + 2] = -self.diffusion();
            }
        }
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, _: &[f64], r: &mut [f64]) {
        for (j, r) in r.chunks_exact_mut(2).enumerate() {
            let x = (j + 1) as f64 / (self.lines + 1) as f64;
            let edge = (std::f64::consts::PI * x).sin();
            r[0] = at.start(0)[2 * j] - edge;
            r[1] = at.end(0)[2 * j] - edge;
        }
    }

    fn conditions_jacobian(
        &self,
        at: Ends<'_, f64>,
        p: &[f64],
        r: &mut [f64],
        jacobian: &mut [f64],
    ) {
        self.evaluate_conditions(at, p, r);
        jacobian.fill(0.0);
        let n = 2 * self.lines;
        for (i, row) in jacobian.chunks_exact_mut(2 * n).enumerate() {
            // Even conditions look at the start, odd ones at the end.
            row[(i % 2) * n + 2 * (i / 2)] = 1.0;
        }
    }
}
