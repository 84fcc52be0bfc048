//! Infinite slopes and other singularities at an end, which no singular term covers.

use crate::draw::Draw;
use crate::trial::{Formula, Known, OnSegment, Trial, Truth, known, some_guess};
use bvp::Real;

/// With z the distance from the singular end.
#[derive(Clone, Copy, Debug)]
enum Kind {
    /// dy/dz = c z^(−α), y given at an end: c z^(1 − α)/(1 − α).
    Power { factor: f64, alpha: f64 },
    /// dy/dz = c ln z: c (z ln z − z).
    Logarithm { factor: f64 },
    /// d²y/dz² = c z^(−α): zero at both ends.
    Bending { factor: f64, alpha: f64 },
    /// dy/dz = β y / z, y = 1 at the other end: z^β.
    Euler { beta: f64 },
    /// dy/dz = c / (2 y), y = 0 at the singular end: √(c z).
    Root { factor: f64 },
    /// dy/dz = −k y + c z^(−α) + …, the exact solution z^(1 − α).
    Decay { rate: f64, alpha: f64 },
}

struct SingularEnd {
    kind: Kind,
    /// Whether the singular end is the right one.
    reversed: bool,
}

impl SingularEnd {
    fn distance(&self, x: f64) -> f64 {
        if self.reversed { 1.0 - x } else { x }
    }
}

impl Kind {
    /// The states at a distance; the second is dy/dz.
    fn exact(self, z: f64) -> [f64; 2] {
        let power = |alpha: f64| z.powf(1.0 - alpha) / (1.0 - alpha);
        match self {
            Self::Power { factor, alpha } => [factor * power(alpha), 0.0],
            Self::Logarithm { factor } if z == 0.0 => [0.0 * factor, 0.0],
            Self::Logarithm { factor } => [factor * (z * z.ln() - z), 0.0],
            Self::Bending { factor, alpha } => {
                let whole = 1.0 / ((1.0 - alpha) * (2.0 - alpha));
                [
                    factor * whole * (z.powf(2.0 - alpha) - z),
                    factor * (power(alpha) - whole),
                ]
            }
            Self::Euler { beta } => [z.powf(beta), 0.0],
            Self::Root { factor } => [(factor * z).sqrt(), 0.0],
            Self::Decay { alpha, .. } => [z.powf(1.0 - alpha), 0.0],
        }
    }

    fn states(self) -> usize {
        if matches!(self, Self::Bending { .. }) {
            2
        } else {
            1
        }
    }
}

impl Formula for SingularEnd {
    fn slope<T: Real>(&self, x: f64, y: &[T], _p: &[T], dy: &mut [T]) {
        let z = self.distance(x);
        match self.kind {
            Kind::Power { factor, alpha } => dy[0] = T::from_f64(factor * z.powf(-alpha)),
            Kind::Logarithm { factor } => dy[0] = T::from_f64(factor * z.ln()),
            Kind::Bending { factor, alpha } => {
                dy[0] = y[1];
                dy[1] = T::from_f64(factor * z.powf(-alpha));
            }
            Kind::Euler { beta } => dy[0] = y[0] * (beta / z),
            Kind::Root { factor } => dy[0] = T::from_f64(0.5 * factor) / y[0],
            Kind::Decay { rate, alpha } => {
                let [exact, _] = self.kind.exact(z);
                dy[0] = -(y[0] - exact) * rate + (1.0 - alpha) * z.powf(-alpha);
            }
        }
        if self.reversed {
            dy.iter_mut().for_each(|dy| *dy = -*dy);
        }
    }

    fn residual<T: Real>(&self, a: &[T], b: &[T], _p: &[T], r: &mut [T]) {
        let (near, far) = if self.reversed { (b, a) } else { (a, b) };
        match self.kind {
            Kind::Bending { .. } => {
                r[0] = near[0];
                r[1] = far[0];
            }
            Kind::Euler { .. } => r[0] = far[0] - 1.0,
            _ => r[0] = near[0],
        }
    }
}

pub(crate) fn draw(draw: &mut Draw) -> Trial {
    let factor = draw.sign() * draw.log_between(0.01, 10.0);
    let alpha = draw.between(0.05, 0.95);
    let (name, kind) = match draw.below(6) {
        0 => ("power", Kind::Power { factor, alpha }),
        1 => ("logarithm", Kind::Logarithm { factor }),
        2 => ("bending", Kind::Bending { factor, alpha }),
        3 => (
            "Euler",
            Kind::Euler {
                beta: draw.between(0.1, 3.0),
            },
        ),
        4 => (
            "root",
            Kind::Root {
                factor: factor.abs(),
            },
        ),
        _ => (
            "decay to a power",
            Kind::Decay {
                rate: draw.log_between(0.1, 30.0),
                alpha,
            },
        ),
    };
    let reversed = draw.chance(0.5);
    let distance = move |x: f64| if reversed { 1.0 - x } else { x };
    let (guess, exact): (Known, Known) = if kind.states() == 1 {
        let exact = move |x: f64| [kind.exact(distance(x))[0]];
        let guess: Known = if matches!(kind, Kind::Root { .. }) {
            // Inside the domain.
            let constant = draw.between(0.1, 2.0);
            known(move |_| [constant])
        } else {
            some_guess(draw, 1.0, exact)
        };
        (guess, known(exact))
    } else {
        let exact = move |x: f64| kind.exact(distance(x));
        (some_guess(draw, 1.0, exact), known(exact))
    };
    // Close to the end as far as 1e-4 of the interval.
    let places = (1..12).map(|i| distance(0.5f64.powi(i + 2))).collect();
    Trial {
        kind: name,
        numbers: format!("{kind:?}, reversed: {reversed}"),
        equations: OnSegment::new(SingularEnd { kind, reversed }, kind.states(), 0.0, 1.0, 0),
        guess,
        truth: match kind {
            // The root of either sign.
            Kind::Root { .. } => Truth::OneOf(exact),
            _ => Truth::Only(vec![exact]),
        },
        places,
    }
}
