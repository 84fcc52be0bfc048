//! Similarity solutions and thin films of fluid flow.

use crate::{Case, TEST_SET};
use bvp::{Ends, Problem, Real, Segment};
use std::f64::consts::FRAC_PI_2;

/// Injection into a channel: ε y⁗ = y′ y″ − y y‴, y(0) = y′(0) = y′(1) = 0, y(1) = 1.
struct Channel {
    eps: f64,
}

impl Problem for Channel {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(4)]
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = y[2];
        dy[2] = y[3];
        dy[3] = (y[1] * y[2] - y[0] * y[3]) / self.eps;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.start(0)[1];
        r[2] = at.end(0)[0] - 1.0;
        r[3] = at.end(0)[1];
    }
}

/// Falkner and Skan: y‴ + y y″ + β (1 − y′²) = 0 with β = 1/2, y(0) = y′(0) = 0, y′(6) = 1.
struct FalknerSkan;

impl Problem for FalknerSkan {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(3, 0.0, 6.0)]
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = y[2];
        dy[2] = -(y[0] * y[2]) - (-y[1] * y[1] + 1.0) * 0.5;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.start(0)[1];
        r[2] = at.end(0)[1] - 1.0;
    }
}

/// Swirling flow over an infinite disk, n = −0.1, s = 0.2, on 0 ≤ x ≤ 11.3:
///
/// ```text
/// f‴ + (3 − n)/2 f f″ + n f′² + g² − s f′ = 1
/// g″ + (3 − n)/2 f g′ + (n − 1) g f′ − s (g − 1) = 0
/// f = f′ = g = 0 at the disk, f′ = 0 and g = 1 far from it
/// ```
struct SwirlingFlow;

impl SwirlingFlow {
    /// Exponent n of the flow far from the disk.
    const N: f64 = -0.1;
    /// Magnetic parameter s.
    const S: f64 = 0.2;
}

impl Problem for SwirlingFlow {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(5, 0.0, 11.3)]
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], _: &[T], dy: &mut [T]) {
        let (f, f1, f2, g, g1) = (y[0], y[1], y[2], y[3], y[4]);
        let stretch = f * ((3.0 - Self::N) / 2.0);
        dy[0] = f1;
        dy[1] = f2;
        dy[2] = -(stretch * f2) - f1 * f1 * Self::N + 1.0 - g * g + f1 * Self::S;
        dy[3] = g1;
        dy[4] = -(stretch * g1) + f1 * g * (1.0 - Self::N) + (g - 1.0) * Self::S;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        let (disk, far) = (at.start(0), at.end(0));
        r[0] = disk[0];
        r[1] = disk[1];
        r[2] = disk[3];
        r[3] = far[1];
        r[4] = far[3] - 1.0;
    }
}

/// Pressure under a lubricated slider with unknown λ:
/// ε y′ = sin²x − λ sin⁴x / y with ε = 0.1, y(±π/2) = 1.
struct Slider;

impl Problem for Slider {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(1, -FRAC_PI_2, FRAC_PI_2)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, x: T, y: &[T], p: &[T], dy: &mut [T]) {
        let square = x.sin().powi(2);
        dy[0] = (square - p[0] * square * square / y[0]) / 0.1;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] - 1.0;
        r[1] = at.end(0)[0] - 1.0;
    }
}

/// Fluid injection through one side of a long channel, Reynolds number R = 100, Péclet number
/// P = 0.7 R, with an unknown pressure parameter A:
///
/// ```text
/// f‴ = R (f′² − f f″ − A),   h″ = −R f h′ − 1,   θ″ = −P f θ′
/// f(0) = f′(0) = f′(1) = 0, f(1) = 1,   h(0) = h(1) = 0,   θ(0) = 0, θ(1) = 1
/// ```
struct Injection;

impl Injection {
    /// Reynolds number R.
    const REYNOLDS: f64 = 100.0;
    /// Péclet number P.
    const PECLET: f64 = 70.0;
}

impl Problem for Injection {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(7)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) {
        let (f, f1, f2, h1, theta1) = (y[0], y[1], y[2], y[4], y[6]);
        dy[0] = f1;
        dy[1] = f2;
        dy[2] = (f1 * f1 - f * f2 - p[0]) * Self::REYNOLDS;
        dy[3] = h1;
        dy[4] = f * h1 * -Self::REYNOLDS - 1.0;
        dy[5] = theta1;
        dy[6] = f * theta1 * -Self::PECLET;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        let (left, right) = (at.start(0), at.end(0));
        r[0] = left[0];
        r[1] = left[1];
        r[2] = left[3];
        r[3] = left[5];
        r[4] = right[0] - 1.0;
        r[5] = right[1];
        r[6] = right[3];
        r[7] = right[5] - 1.0;
    }
}

/// The cubic f = 3x² − 2x³ with its first two derivatives, which meets the conditions of a channel.
fn channel_cubic(x: f64) -> [f64; 3] {
    [
        3.0 * x.powi(2) - 2.0 * x.powi(3),
        6.0 * x - 6.0 * x.powi(2),
        6.0 - 12.0 * x,
    ]
}

pub(crate) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (id, eps) in [("T32a", 1e-2), ("T32b", 1e-3), ("T32c", 1e-4)] {
        let name = "injection into a channel, Reynolds number 1/ε";
        let case = Case::new(id, name, TEST_SET, Channel { eps });
        cases.push(case.with_guess(|x| {
            let [f, f1, f2] = channel_cubic(x);
            [f, f1, f2, -12.0]
        }));
    }
    let name = "Falkner and Skan's boundary layer, β = 1/2, on 0 ≤ x ≤ 6";
    let case = Case::new("E04a", name, "MATLAB fsbvp", FalknerSkan);
    cases.push(case.with_guess(|_| [0.0, 0.0, 1.0]));

    let name = "swirling flow over an infinite disk";
    let source = "Ascher, Mattheij and Russell, example 1.20";
    let case = Case::new("E10", name, source, SwirlingFlow).with_intervals(20);
    cases.push(case.with_guess(|x| {
        let e = (-x).exp();
        [
            -x * x * e,
            (x * x - 2.0 * x) * e,
            (-x * x + 4.0 * x - 2.0) * e,
            1.0 - e,
            e,
        ]
    }));

    let name = "lubricated slider with an unknown parameter";
    let case = Case::new("E14", name, "examples of MATLAB bvp4c", Slider);
    let case = case.with_guess(|_| [0.5]).with_parameter_guess(&[1.0]);
    cases.push(case.with_intervals(20));

    let name = "fluid injection through one side of a channel, R = 100";
    let source = "Ascher, Mattheij and Russell, example 1.4; examples of BVP_SOLVER";
    let case = Case::new("E16a", name, source, Injection).with_parameter_guess(&[3.0]);
    cases.push(case.with_guess(|x| {
        let [f, f1, f2] = channel_cubic(x);
        [f, f1, f2, x * (1.0 - x) / 2.0, 0.5 - x, x, 1.0]
    }));
    cases
}
