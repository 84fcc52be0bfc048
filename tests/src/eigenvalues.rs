//! Problems with unknown parameters: eigenvalues, forces and free lengths.

use crate::{Case, UNIT};
use bvp::{Ends, Problem, Real, Segment};
use std::f64::consts::{FRAC_PI_2, PI};

/// Mathieu: y″ = −(λ − 2 q cos 2x) y with q = 5 and unknown λ, y′(0) = y′(π) = 0, y(0) = 1.
struct Mathieu;

impl Problem for Mathieu {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, 0.0, PI)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, x: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -(p[0] - (x * 2.0).cos() * 10.0) * y[0];
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[1];
        r[1] = at.end(0)[1];
        r[2] = at.start(0)[0] - 1.0;
    }
}

/// y″ = −κ² y with unknown κ, y(0) = y(1) = 0, y′(0) = κ: sin κx with κ = π, 2π, …
pub(crate) struct Wavenumber;

impl Problem for Wavenumber {
    fn segments(&self) -> Vec<Segment> {
        UNIT.to_vec()
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -(p[0] * p[0] * y[0]);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0];
        r[2] = at.start(0)[1] - p[0];
    }
}

/// Half of an elastica with unknown force P; states are the position x, y, the angle θ and the
/// curvature κ over arc length 0 ≤ s ≤ 1/2:
///
/// ```text
/// x′ = cos θ,   y′ = sin θ,   θ′ = κ,   κ′ = P cos θ
/// x = y = κ = 0 at s = 0,   y = 0 and θ = −π/2 at s = 1/2
/// ```
struct Elastica;

impl Problem for Elastica {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(4, 0.0, 0.5)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) {
        let (sin, cos) = y[2].sin_cos();
        dy[0] = cos;
        dy[1] = sin;
        dy[2] = y[3];
        dy[3] = p[0] * cos;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        let (left, right) = (at.start(0), at.end(0));
        r[0] = left[0];
        r[1] = left[1];
        r[2] = left[3];
        r[3] = right[1];
        r[4] = right[2] + FRAC_PI_2;
    }
}

/// Double integrator brought from rest at 0 to rest at 1 with the least time plus control effort.
/// States are position x, velocity v and costate λ of the velocity, which is the negative control;
/// unknown are the costate p₁ of the position and the final time T:
///
/// ```text
/// x′ = T v,   v′ = −T λ,   λ′ = −T p₁
/// x = v = 0 at the start,   x = 1, v = 0 and 1 − λ²/2 + p₁ v = 0 at the end
/// ```
struct FreeFinalTime;

impl Problem for FreeFinalTime {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(3)]
    }

    fn parameters(&self) -> usize {
        2
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) {
        let (costate, time) = (p[0], p[1]);
        dy[0] = time * y[1];
        dy[1] = -(time * y[2]);
        dy[2] = -(time * costate);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let (left, right) = (at.start(0), at.end(0));
        r[0] = left[0];
        r[1] = left[1];
        r[2] = right[0] - 1.0;
        r[3] = right[1];
        r[4] = -(right[2] * right[2]) / 2.0 + p[0] * right[1] + 1.0;
    }
}

/// Catenary y = √(a² + σ²) between given points, its length L unknown. States are the position
/// x, y and the angle θ over s = arc length / L:
///
/// ```text
/// x′ = L cos θ,   y′ = L sin θ,   θ′ = L cos²θ / a
/// x = y = 0 at s = 0,   x and y given at s = 1
/// ```
pub(crate) struct Catenary {
    /// Parameter a: horizontal tension over weight per length.
    pub(crate) a: f64,
    /// End point x, y.
    pub(crate) to: [f64; 2],
}

impl Problem for Catenary {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(3)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) {
        let (sin, cos) = y[2].sin_cos();
        dy[0] = p[0] * cos;
        dy[1] = p[0] * sin;
        dy[2] = p[0] * cos * cos / self.a;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.start(0)[1];
        r[2] = at.end(0)[0] - self.to[0];
        r[3] = at.end(0)[1] - self.to[1];
    }
}

pub(crate) fn cases() -> Vec<Case> {
    let name = "fourth eigenvalue of Mathieu's equation, q = 5";
    let source = "MATLAB mat4bvp; examples of BVP_SOLVER";
    let mathieu = Case::new("E01", name, source, Mathieu)
        .with_guess(|x| [(4.0 * x).cos(), -4.0 * (4.0 * x).sin()])
        .with_parameter_guess(&[15.0]);

    let name = "harmonic with unknown wavenumber";
    let source = "SciPy, test of solve_bvp (sl)";
    let wavenumber = Case::new("E11b", name, source, Wavenumber)
        .with_guess(|x| [(3.0 * x).sin(), 3.0 * (3.0 * x).cos()])
        .with_parameter_guess(&[3.0]);

    let name = "elastica with unknown force";
    let elastica = Case::new("E18", name, "bvpSolve, elastica example", Elastica)
        .with_guess(|x| [x, 0.0, 0.0, 0.0])
        .with_parameter_guess(&[0.0]);

    let name = "double integrator with free final time";
    let free_time = Case::new("E31", name, "this project", FreeFinalTime)
        .with_guess(|x| [x, 1.0, 2.0 * x - 1.0])
        .with_parameter_guess(&[-1.0, 2.0]);

    vec![mathieu, wavenumber, elastica, free_time]
}
