//! Periodic solutions: conditions that are not separated.

use crate::{Case, UNIT};
use bvp::{Ends, Problem, Real, Segment};
use std::f64::consts::TAU;

/// Limit cycle of the nerve model of `FitzHugh` and Nagumo over its period T, which is unknown:
///
/// ```text
/// u′ = 3 T (u + v − u³/3 − 1.3),   v′ = −T (u − 0.7 + 0.8 v)/3
/// u and v periodic,   phase fixed by v′(0) = 1
/// ```
struct FitzHughNagumo;

impl FitzHughNagumo {
    /// v′ for the states y and the period.
    fn recovery<T: Real>(y: &[T], period: T) -> T {
        -(period * (y[0] - 0.7 + y[1] * 0.8)) / 3.0
    }
}

impl Problem for FitzHughNagumo {
    fn segments(&self) -> Vec<Segment> {
        UNIT.to_vec()
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = p[0] * (y[0] + y[1] - y[0].powi(3) / 3.0 - 1.3) * 3.0;
        dy[1] = Self::recovery(y, p[0]);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let (left, right) = (at.start(0), at.end(0));
        r[0] = left[0] - right[0];
        r[1] = left[1] - right[1];
        r[2] = Self::recovery(left, p[0]) - 1.0;
    }
}

/// Forced oscillator of Duffing's kind, y″ + y′ + 4 y + y³ = F(x) with period 1, where F is chosen
/// such that y = g(x) = 1/(2 + cos 2πx).
pub(crate) struct Duffing;

impl Duffing {
    /// g, g′ and g″.
    pub(crate) fn orbit<T: Real>(x: T) -> [T; 3] {
        let (sin, cos) = (x * TAU).sin_cos();
        let g = T::from_f64(1.0) / (cos + 2.0);
        let first = sin * g * g * TAU;
        let second = (cos + sin * sin * g * 2.0) * g * g * (TAU * TAU);
        [g, first, second]
    }
}

impl Problem for Duffing {
    fn segments(&self) -> Vec<Segment> {
        UNIT.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, x: T, y: &[T], _: &[T], dy: &mut [T]) {
        let [g, g1, g2] = Self::orbit(x);
        let force = g2 + g1 + g * 4.0 + g.powi(3);
        dy[0] = y[1];
        dy[1] = force - y[1] - y[0] * 4.0 - y[0].powi(3);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] - at.end(0)[0];
        r[1] = at.start(0)[1] - at.end(0)[1];
    }
}

pub(crate) fn cases() -> Vec<Case> {
    let name = "limit cycle of FitzHugh and Nagumo's model, unknown period";
    let source = "Seydel; examples of MATLAB bvp4c";
    let cycle = Case::new("E15", name, source, FitzHughNagumo)
        .with_guess(|x| [2.0 * (TAU * x).sin(), (TAU * x).cos()])
        .with_parameter_guess(&[TAU])
        .with_intervals(20);
    vec![cycle]
}
