//! Problems with exact solutions, for the measurement of orders.
//!
//! `w` stretches a problem: high orders are visible above rounding only where the solution changes
//! much over an interval.

use bvp::{Ends, Equations, Guess, Problem, Real, Segment};
use std::f64::consts::PI;

/// A problem with its exact solution, which is also the guess.
pub(crate) struct Exact {
    pub(crate) name: &'static str,
    pub(crate) equations: Box<dyn Equations>,
    pub(crate) states: fn(f64, f64, &mut [f64]),
    pub(crate) w: f64,
    pub(crate) parameters: Vec<f64>,
}

impl Guess for Exact {
    fn state(&self, _segment: usize, s: f64, y: &mut [f64]) {
        (self.states)(self.w, s, y);
    }

    fn parameters(&self, p: &mut [f64]) {
        p.copy_from_slice(&self.parameters);
    }
}

/// y'' = w² y with y = exp(−w s).
struct Exponential {
    w: f64,
}

impl Problem for Exponential {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2)]
    }

    fn rhs<T: Real>(&self, _: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = y[0] * (self.w * self.w);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] - 1.0;
        r[1] = at.end(0)[0] - (-self.w).exp();
    }
}

pub(crate) fn exponential(w: f64) -> Exact {
    Exact {
        name: "y'' = w² y",
        equations: Box::new(Exponential { w }),
        states: |w, s, y| {
            y[0] = (-w * s).exp();
            y[1] = -w * y[0];
        },
        w,
        parameters: vec![],
    }
}

/// Bratu: y'' + exp(y) = 0, y(0) = y(1) = 0, on either branch.
struct Bratu;

impl Problem for Bratu {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2)]
    }

    fn rhs<T: Real>(&self, _: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -y[0].exp();
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0];
    }
}

/// The branch nearest to θ = `guess` of y = −2 ln( cosh((s − ½) θ/2) / cosh(θ/4) ), where
/// θ = √2 cosh(θ/4).
pub(crate) fn bratu(guess: f64) -> Exact {
    let mut theta = guess;
    for _ in 0..50 {
        let f = theta - 2f64.sqrt() * (theta / 4.0).cosh();
        theta -= f / (1.0 - 2f64.sqrt() / 4.0 * (theta / 4.0).sinh());
    }
    Exact {
        name: "Bratu",
        equations: Box::new(Bratu),
        states: |theta, s, y| {
            let x = (s - 0.5) * theta / 2.0;
            y[0] = -2.0 * (x.cosh() / (theta / 4.0).cosh()).ln();
            y[1] = -theta * x.tanh();
        },
        w: theta,
        parameters: vec![],
    }
}

/// A wave of growing frequency with variable coefficients, and its square beside it:
/// y = (sin φ, cos φ, exp(−s) + sin² φ) with φ = 2w (exp(s/2) − 1).
struct Chirp {
    w: f64,
}

fn chirp_states<T: Real>(w: f64, s: T) -> [T; 3] {
    let (sin, cos) = (((s * 0.5).exp() - 1.0) * (2.0 * w)).sin_cos();
    [sin, cos, (-s).exp() + sin * sin]
}

impl Problem for Chirp {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(3)]
    }

    fn rhs<T: Real>(&self, _: usize, s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        let frequency = (s * 0.5).exp() * self.w;
        dy[0] = frequency * y[1];
        dy[1] = -frequency * y[0];
        dy[2] = -y[2] + y[0] * y[0] + frequency * y[0] * y[1] * 2.0;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        let [sin, cos, other] = chirp_states(self.w, 1.0);
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[1] * cos + at.end(0)[0] * sin - 1.0;
        r[2] = at.start(0)[2] + at.end(0)[2] - 1.0 - other;
    }
}

pub(crate) fn chirp(w: f64) -> Exact {
    Exact {
        name: "chirp",
        equations: Box::new(Chirp { w }),
        states: |w, s, y| y.copy_from_slice(&chirp_states(w, s)),
        w,
        parameters: vec![],
    }
}

/// y'' = −p² y, y(0) = y(1) = 0, y'(0) = p: the wavenumber p is a multiple of π.
struct Wavenumber;

impl Problem for Wavenumber {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -p[0] * p[0] * y[0];
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0];
        r[2] = at.start(0)[1] - p[0];
    }
}

pub(crate) fn wavenumber(half_waves: f64) -> Exact {
    Exact {
        name: "wavenumber",
        equations: Box::new(Wavenumber),
        states: |w, s, y| {
            y[0] = (w * s).sin();
            y[1] = w * (w * s).cos();
        },
        w: half_waves * PI,
        parameters: vec![half_waves * PI],
    }
}

/// Turns of the limit cycle dy/ds = T ( −y₂ + 0.1 (1 − r²) y₁, y₁ + 0.1 (1 − r²) y₂ ), r = |y|, with the
/// phase y₂(0) = 0: conditions that couple both ends, unknown duration T = 2π · turns.
struct LimitCycle;

impl Problem for LimitCycle {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        let pull = (-(y[0] * y[0] + y[1] * y[1]) + 1.0) * 0.1;
        dy[0] = p[0] * (pull * y[0] - y[1]);
        dy[1] = p[0] * (pull * y[1] + y[0]);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] - at.end(0)[0];
        r[1] = at.start(0)[1] - at.end(0)[1];
        r[2] = at.start(0)[1];
    }
}

pub(crate) fn limit_cycle(turns: f64) -> Exact {
    Exact {
        name: "limit cycle",
        equations: Box::new(LimitCycle),
        states: |w, s, y| {
            y[0] = (w * s).cos();
            y[1] = (w * s).sin();
        },
        w: 2.0 * PI * turns,
        parameters: vec![2.0 * PI * turns],
    }
}

/// y'' = p − w² y with y given at 0, ½ and 1: two segments, one unknown load p = w²/2.
struct ThreePoint {
    w: f64,
}

impl Problem for ThreePoint {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, 0.0, 0.5), Segment::on(2, 0.5, 1.0)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = p[0] - y[0] * (self.w * self.w);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] - 0.5;
        r[1] = at.end(0)[0] - (0.5 + (0.5 * self.w).sin());
        r[2] = at.end(1)[0] - (0.5 + self.w.sin());
        r[3] = at.end(0)[0] - at.start(1)[0];
        r[4] = at.end(0)[1] - at.start(1)[1];
    }
}

pub(crate) fn three_point(w: f64) -> Exact {
    Exact {
        name: "three points",
        equations: Box::new(ThreePoint { w }),
        states: |w, s, y| {
            y[0] = 0.5 + (w * s).sin();
            y[1] = w * (w * s).cos();
        },
        w,
        parameters: vec![0.5 * w * w],
    }
}

/// The pendulum of small swings from rest position to its turning point: dy/ds = T (y₂, −y₁),
/// y(0) = (0, 1), y₂(1) = 0, unknown duration T = (2j + ½) π.
struct Swing;

impl Problem for Swing {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = p[0] * y[1];
        dy[1] = -p[0] * y[0];
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.start(0)[1] - 1.0;
        r[2] = at.end(0)[1];
    }
}

pub(crate) fn swing(periods: f64) -> Exact {
    let duration = (2.0 * periods + 0.5) * PI;
    Exact {
        name: "free length",
        equations: Box::new(Swing),
        states: |w, s, y| {
            y[0] = (w * s).sin();
            y[1] = (w * s).cos();
        },
        w: duration,
        parameters: vec![duration],
    }
}
