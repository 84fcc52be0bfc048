//! Problems in other units: x by 1e-12 to 1e12, states by 1e-10 to 1e10, conditions by any factor.

use crate::draw::Draw;
use crate::trial::{Formula, Known, OnSegment, Trial, Truth, known};
use bvp::Real;

/// One formula in the variable t of \[0, 1\] and states u of size one.
#[derive(Clone, Copy)]
enum Kind {
    /// u″ = u / d², u(0) = 1, u(1) = 0.
    Layer { width: f64 },
    /// u″ = −u³ + sin³ ωt − ω² sin ωt with the ends of sin ωt.
    Wave { frequency: f64 },
    /// u₁′ = ω u₂, u₂′ = −ω u₁ with u₁(0) and u₂(1) given: a pair of states with units of their own.
    Pair { frequency: f64 },
    /// u′ = −r u (1 − u), u(0) given; u₂′ = u.
    Logistic { rate: f64, first: f64 },
}

/// A formula in other units: x = x₀ + X t and yᵢ = Yᵢ uᵢ.
struct Scaled {
    kind: Kind,
    start: f64,
    length: f64,
    sizes: [f64; 2],
    factors: [f64; 2],
}

impl Kind {
    /// The solution at t = 1 − `rest`, both without cancellation: where u is 1e8 in its unit and vanishes at the
    /// end, the rounding of t would show.
    fn exact(self, t: f64, rest: f64) -> [f64; 2] {
        match self {
            Self::Layer { width } => {
                let (down, up) = ((-t / width).exp(), (-rest / width).exp());
                let both = -(-2.0 / width).exp_m1();
                let slope = -(down + up * (-1.0 / width).exp()) / (both * width);
                [-(-2.0 * rest / width).exp_m1() * down / both, slope]
            }
            Self::Wave { frequency } => {
                let (sin, cos) = (frequency * t).sin_cos();
                [sin, frequency * cos]
            }
            Self::Pair { frequency } => {
                let (sin, cos) = (frequency * t).sin_cos();
                [sin, cos]
            }
            Self::Logistic { rate, first } => {
                let odds = first / (1.0 - first) * (-rate * t).exp();
                let start = first / (1.0 - first);
                let u = odds / (1.0 + odds);
                [u, (start.ln_1p() - odds.ln_1p()) / rate]
            }
        }
    }
}

impl Formula for Scaled {
    fn slope<T: Real>(&self, x: f64, y: &[T], _p: &[T], dy: &mut [T]) {
        let t = (x - self.start) / self.length;
        let u = [y[0] / self.sizes[0], y[1] / self.sizes[1]];
        let du = match self.kind {
            Kind::Layer { width } => [u[1], u[0] / (width * width)],
            Kind::Wave { frequency } => {
                let sin = (frequency * t).sin();
                [
                    u[1],
                    -u[0].powi(3) + (sin.powi(3) - frequency * frequency * sin),
                ]
            }
            Kind::Pair { frequency } => [u[1] * frequency, u[0] * -frequency],
            Kind::Logistic { rate, .. } => [u[0] * (u[0] - 1.0) * rate, u[0]],
        };
        for (dy, (du, size)) in dy.iter_mut().zip(du.iter().zip(&self.sizes)) {
            *dy = *du * (size / self.length);
        }
    }

    fn residual<T: Real>(&self, a: &[T], b: &[T], _p: &[T], r: &mut [T]) {
        let (start, end) = (self.kind.exact(0.0, 1.0), self.kind.exact(1.0, 0.0));
        let of = |y: &[T], i: usize, u: f64| y[i] - u * self.sizes[i];
        let residuals = match self.kind {
            Kind::Layer { .. } | Kind::Wave { .. } => [of(a, 0, start[0]), of(b, 0, end[0])],
            Kind::Pair { .. } => [of(a, 0, start[0]), of(b, 1, end[1])],
            Kind::Logistic { .. } => [of(a, 0, start[0]), of(a, 1, start[1])],
        };
        for (r, (residual, factor)) in r.iter_mut().zip(residuals.iter().zip(&self.factors)) {
            *r = *residual * *factor;
        }
    }
}

pub(crate) fn draw(draw: &mut Draw) -> Trial {
    let (name, kind) = match draw.below(4) {
        0 => (
            "layer",
            Kind::Layer {
                width: draw.log_between(1e-3, 1.0),
            },
        ),
        1 => (
            "wave",
            Kind::Wave {
                frequency: draw.between(0.5, 10.0),
            },
        ),
        // Well away from the singular frequencies, where cos ω = 0.
        2 => (
            "pair",
            Kind::Pair {
                frequency: std::f64::consts::PI * (draw.below(5) as f64 + draw.between(-0.3, 0.3)),
            },
        ),
        _ => (
            "logistic",
            Kind::Logistic {
                rate: draw.log_between(0.1, 50.0),
                first: draw.between(0.05, 0.95),
            },
        ),
    };
    let length = draw.log_between(1e-12, 1e12);
    let start = if draw.chance(0.5) {
        0.0
    } else {
        draw.between(-10.0, 10.0) * length
    };
    let mut sizes: [f64; 2] = std::array::from_fn(|_| {
        if draw.chance(0.4) {
            1.0
        } else {
            draw.log_between(1e-10, 1e10)
        }
    });
    if matches!(kind, Kind::Layer { .. } | Kind::Wave { .. }) && draw.chance(0.7) {
        // As an equation of second order has it: the second state is the slope of the first.
        sizes[1] = sizes[0] / length;
    }
    let factors = std::array::from_fn(|_| {
        if draw.chance(0.5) {
            1.0
        } else {
            draw.log_between(1e-8, 1e8)
        }
    });
    let exact = move |x: f64| {
        let (t, rest) = ((x - start) / length, (start + length - x) / length);
        let u = kind.exact(t, rest);
        [sizes[0] * u[0], sizes[1] * u[1]]
    };
    let guess: Known = match draw.below(3) {
        0 => known(|_| [0.0; 2]),
        1 => {
            let factors = [draw.between(-1.0, 1.0), draw.between(-1.0, 1.0)];
            known(move |_| [sizes[0] * factors[0], sizes[1] * factors[1]])
        }
        _ => known(move |x| {
            let [y, z] = exact(x);
            [1.1 * y + 0.05 * sizes[0], 0.9 * z - 0.05 * sizes[1]]
        }),
    };
    let problem = Scaled {
        kind,
        start,
        length,
        sizes,
        factors,
    };
    let width = if let Kind::Layer { width } = kind {
        width
    } else {
        0.1
    };
    let places = (1..20)
        .map(|i| start + length * (0.5 * width * f64::from(i)).min(1.0))
        .collect();
    let numbers = match kind {
        Kind::Layer { width } => format!("d = {width}"),
        Kind::Wave { frequency } | Kind::Pair { frequency } => format!("frequency {frequency}"),
        Kind::Logistic { rate, first } => format!("rate {rate}, first {first}"),
    };
    Trial {
        kind: name,
        numbers: format!(
            "{numbers}, x from {start} by {length}, states by {sizes:?}, conditions by {factors:?}"
        ),
        equations: OnSegment::new(problem, 2, start, start + length, 0),
        guess,
        truth: match kind {
            // y″ = −y³ + … has other solutions.
            Kind::Wave { .. } => Truth::OneOf(known(exact)),
            _ => Truth::Only(vec![known(exact)]),
        },
        places,
    }
}
