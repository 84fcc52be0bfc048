//! Problems without a solution: every success is false.

use crate::draw::Draw;
use crate::trial::{Formula, Known, OnSegment, Trial, Truth, known};
use bvp::Real;
use std::f64::consts::PI;

/// The largest λ with a solution of y″ = −λ eʸ, zero ends (Bratu).
const BRATU_LIMIT: f64 = 3.513_830_719_125_16;

#[derive(Clone, Copy, Debug)]
enum Insoluble {
    /// y″ = −(kπ)² y + c sin kπx, zero ends.
    Resonant { k: f64, load: f64 },
    /// y″ = −λ eʸ, zero ends, λ beyond the fold.
    Bratu(f64),
    /// y′ = 1 + y², y(0) = tan φ, over more than π/2 − φ: it has a pole.
    Tangent(f64),
    /// y′ = y², y(0) = c > 1 on \[0, 1\]: a pole at 1/c.
    Pole(f64),
    /// y″ = 6 y² with the first state and slope of 1/(c − x)², c < 1.
    DoublePole(f64),
    /// y₁′ = y₂, y₂′ = −y₁, y₁(0) = 1 and y₁(0) = 1 + c.
    Conflict(f64),
    /// y″ = c, y′ = 0 at both ends.
    Neumann(f64),
    /// y′ = c + cos 2πx, y(0) = y(1).
    Drift(f64),
    /// An arc of curvature κ > 2 over a chord of length one.
    Arc(f64),
    /// y y′ = −x, y(0) = r < 1: ends at x = r.
    Circle(f64),
    /// y″ = c + y², y′ = 0 at both ends, c > 0: the mean of the right-hand side is positive.
    Quadratic(f64),
}

impl Formula for Insoluble {
    fn slope<T: Real>(&self, x: f64, y: &[T], _p: &[T], dy: &mut [T]) {
        if dy.len() == 2 {
            dy[0] = y[1];
        }
        match *self {
            Self::Resonant { k, load } => {
                dy[1] = y[0] * -(k * PI).powi(2) + load * (k * PI * x).sin();
            }
            Self::Bratu(lambda) => dy[1] = y[0].exp() * -lambda,
            Self::Tangent(_) => dy[0] = y[0] * y[0] + 1.0,
            Self::Pole(_) => dy[0] = y[0] * y[0],
            Self::DoublePole(_) => dy[1] = y[0] * y[0] * 6.0,
            Self::Conflict(_) => dy[1] = -y[0],
            Self::Neumann(c) => dy[1] = T::from_f64(c),
            Self::Drift(c) => dy[0] = T::from_f64(c + (2.0 * PI * x).cos()),
            Self::Arc(curvature) => dy[1] = (y[1] * y[1] + 1.0).powf(1.5) * -curvature,
            Self::Circle(_) => dy[0] = T::from_f64(-x) / y[0],
            Self::Quadratic(c) => dy[1] = y[0] * y[0] + c,
        }
    }

    fn residual<T: Real>(&self, a: &[T], b: &[T], _p: &[T], r: &mut [T]) {
        match *self {
            Self::Resonant { .. } | Self::Bratu(_) | Self::Arc(_) => {
                r[0] = a[0];
                r[1] = b[0];
            }
            Self::Tangent(phase) => r[0] = a[0] - phase.tan(),
            Self::Pole(c) | Self::Circle(c) => r[0] = a[0] - c,
            Self::DoublePole(c) => {
                r[0] = a[0] - c.powi(-2);
                r[1] = a[1] - 2.0 * c.powi(-3);
            }
            Self::Conflict(c) => {
                r[0] = a[0] - 1.0;
                r[1] = a[0] - 1.0 - c;
            }
            Self::Neumann(_) | Self::Quadratic(_) => {
                r[0] = a[1];
                r[1] = b[1];
            }
            Self::Drift(_) => r[0] = b[0] - a[0],
        }
    }
}

pub(crate) fn draw(draw: &mut Draw) -> Trial {
    let size = draw.log_between(1e-3, 10.0);
    let signed = draw.sign() * size;
    let (kind, problem, states, to) = match draw.below(11) {
        0 => {
            let k = (1 + draw.below(5)) as f64;
            (
                "incompatible load",
                Insoluble::Resonant { k, load: signed },
                2,
                1.0,
            )
        }
        1 => {
            let lambda = BRATU_LIMIT * (1.0 + draw.log_between(1e-3, 10.0));
            ("Bratu beyond the fold", Insoluble::Bratu(lambda), 2, 1.0)
        }
        2 => {
            let phase = draw.between(-1.4, 1.4);
            let beyond = draw.log_between(0.01, 4.0);
            (
                "tangent over a pole",
                Insoluble::Tangent(phase),
                1,
                PI / 2.0 - phase + beyond,
            )
        }
        3 => ("pole", Insoluble::Pole(draw.between(1.02, 5.0)), 1, 1.0),
        4 => (
            "double pole",
            Insoluble::DoublePole(draw.between(0.2, 0.98)),
            2,
            1.0,
        ),
        5 => (
            "conflicting conditions",
            Insoluble::Conflict(signed),
            2,
            1.0,
        ),
        6 => ("Neumann", Insoluble::Neumann(signed), 2, 1.0),
        7 => ("drift", Insoluble::Drift(signed), 1, 1.0),
        8 => (
            "arc too curved",
            Insoluble::Arc(draw.between(2.02, 6.0)),
            2,
            1.0,
        ),
        9 => (
            "circle left",
            Insoluble::Circle(draw.between(0.1, 0.98)),
            1,
            1.0,
        ),
        _ => ("positive mean", Insoluble::Quadratic(size), 2, 1.0),
    };
    let constants = [draw.between(-2.0, 2.0), draw.between(-2.0, 2.0)];
    // Zero is outside the domain of the circle.
    let constants = match problem {
        Insoluble::Circle(_) => [constants[0].abs() + 0.1, 0.0],
        _ if draw.chance(0.3) => [0.0; 2],
        _ => constants,
    };
    let guess: Known = if states == 1 {
        known(move |_| [constants[0]])
    } else {
        known(move |_| constants)
    };
    Trial {
        kind,
        numbers: format!("{problem:?} on [0, {to}], guess {constants:?}"),
        equations: OnSegment::new(problem, states, 0.0, to, 0),
        guess,
        truth: Truth::Only(vec![]),
        places: vec![],
    }
}
