//! Smooth functions with known derivatives.

use super::Draw;

/// One function of s, of size one.
#[derive(Clone, Copy, Debug)]
pub(super) enum Shape {
    /// sin(ω s + φ).
    Sine { frequency: f64, phase: f64 },
    /// exp(r (s − c)), a layer if r is large; c is the end where it is 1 and not less.
    Exponential { rate: f64, centre: f64 },
    /// exp(−((s − c) / w)²).
    Bump { centre: f64, width: f64 },
    /// 1 / (1 + ((s − c) / w)²).
    Rational { centre: f64, width: f64 },
}

impl Shape {
    /// Any shape on \[a, b\].
    pub(super) fn draw(draw: &mut Draw, [a, b]: [f64; 2]) -> Self {
        let centre = draw.between(a, b);
        match draw.below(4) {
            0 => Self::Sine {
                frequency: draw.between(-20.0, 20.0),
                phase: draw.between(0.0, 6.0),
            },
            1 => {
                let rate = draw.between(-50.0, 50.0);
                let centre = if rate < 0.0 { a } else { b };
                Self::Exponential { rate, centre }
            }
            2 => Self::Bump {
                centre,
                width: draw.log_between(0.03, 0.5) * (b - a),
            },
            _ => Self::Rational {
                centre,
                width: draw.log_between(0.03, 1.0) * (b - a),
            },
        }
    }

    /// Value and derivative at s.
    pub(super) fn at(self, s: f64) -> [f64; 2] {
        match self {
            Self::Sine { frequency, phase } => {
                let (sin, cos) = (frequency * s + phase).sin_cos();
                [sin, frequency * cos]
            }
            Self::Exponential { rate, centre } => {
                let value = (rate * (s - centre)).exp();
                [value, rate * value]
            }
            Self::Bump { centre, width } => {
                let x = (s - centre) / width;
                let value = (-x * x).exp();
                [value, -2.0 * x / width * value]
            }
            Self::Rational { centre, width } => {
                let x = (s - centre) / width;
                let value = 1.0 / (1.0 + x * x);
                [value, -2.0 * x / width * value * value]
            }
        }
    }
}
