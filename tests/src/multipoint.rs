//! Problems with several segments: interior conditions, jumps and unequal numbers of states.

use crate::Case;
use bvp::{Ends, Problem, Real, Segment};

/// Shear of a three-layer sandwich beam: y‴ = k² y′ − q, y′(0) = y′(1) = 0, y(1/2) = 0, in two
/// segments that join smoothly at 1/2.
///
/// ```text
/// y = (q/k²) (x − 1/2 − sinh(k (x − 1/2)) / (k cosh(k/2)))
/// ```
pub(crate) struct SandwichBeam {
    /// k.
    pub(crate) stiffness: f64,
    /// q.
    pub(crate) load: f64,
}

impl Problem for SandwichBeam {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(3, 0.0, 0.5), Segment::on(3, 0.5, 1.0)]
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = y[2];
        dy[2] = y[1] * self.stiffness.powi(2) - self.load;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[1];
        r[1] = at.end(0)[0];
        r[2] = at.end(1)[1];
        for i in 0..3 {
            r[3 + i] = at.start(1)[i] - at.end(0)[i];
        }
    }
}

/// y″ = 0 up to x = 1/3 and y″ = −1 beyond, y(0) = y(1) = 0, y and y′ continuous: a straight line
/// of slope 2/9, then a parabola.
struct StepSource;

impl Problem for StepSource {
    fn segments(&self) -> Vec<Segment> {
        vec![
            Segment::on(2, 0.0, 1.0 / 3.0),
            Segment::on(2, 1.0 / 3.0, 1.0),
        ]
    }

    fn rhs<T: Real>(&self, segment: usize, _: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = T::from_f64(if segment == 0 { 0.0 } else { -1.0 });
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.start(1)[0] - at.end(0)[0];
        r[2] = at.start(1)[1] - at.end(0)[1];
        r[3] = at.end(1)[0];
    }
}

/// An oscillation u on 0 ≤ x ≤ 1 that passes its value to a transported quantity v on 1 ≤ x ≤ 9/5:
/// two states, then one.
///
/// ```text
/// u″ = −81 u,   v′ = −6 sin(12 x) v
/// u′(0) = 0,   v(1) = u(1),   v(9/5) = exp(cos(21.6)/2)
/// ```
///
/// The solution is v = exp(cos(12 x)/2), u = v(1) cos(9 x)/cos 9.
pub(crate) struct OscillationToTransport;

impl OscillationToTransport {
    /// Right end of the second segment.
    const END: f64 = 1.8;

    /// v.
    pub(crate) fn transported(x: f64) -> f64 {
        ((12.0 * x).cos() / 2.0).exp()
    }
}

impl Problem for OscillationToTransport {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, 0.0, 1.0), Segment::on(1, 1.0, Self::END)]
    }

    fn rhs<T: Real>(&self, segment: usize, x: T, y: &[T], _: &[T], dy: &mut [T]) {
        if segment == 0 {
            dy[0] = y[1];
            dy[1] = y[0] * -81.0;
        } else {
            dy[0] = (x * 12.0).sin() * y[0] * -6.0;
        }
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[1];
        r[1] = at.start(1)[0] - at.end(0)[0];
        r[2] = at.end(1)[0] - Self::transported(Self::END);
    }
}

pub(crate) fn cases() -> Vec<Case> {
    let name = "three-layer sandwich beam, condition at three points";
    let source = "Cash, sandwich beam example of multipoint problems, with k = 10";
    let beam = SandwichBeam {
        stiffness: 10.0,
        load: 1.0,
    };
    vec![
        Case::new("E21", name, source, beam),
        Case::new("E28", "source with a jump", "this project", StepSource),
    ]
}
