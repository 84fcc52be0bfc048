//! Growth and decay: errors that grow along the interval, conditions at the wrong end, stiffness.

use crate::draw::Draw;
use crate::trial::{Formula, Known, OnSegment, Trial, Truth, known, some_guess};
use bvp::Real;

#[derive(Clone, Copy, Debug)]
enum Kind {
    /// y′ = λ (y − cos ωx) − ω sin ωx, y(0) given: cos ωx + c e^(λx).
    Forced { rate: f64, wave: f64, offset: f64 },
    /// Two such equations of opposite rates ±λ, turned by an angle; each with its condition at the wrong
    /// end, or at the right one.
    Saddle { rate: f64, angle: f64, wrong: bool },
    /// y₁′ = −(λ + 2) y₁ + λ y₂², y₂′ = y₁ − y₂ − y₂²: e^(−2x), e^(−x) (Kaps).
    Kaps { rate: f64 },
    /// y′ = −λ y³ + …: the exact solution is sin ωx + 2, y(0) given.
    Cubic { rate: f64, wave: f64 },
}

struct Growth {
    kind: Kind,
    to: f64,
}

fn turn<T: Real>(angle: f64, [x, y]: [T; 2]) -> [T; 2] {
    let (sin, cos) = angle.sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}

impl Kind {
    fn exact(self, x: f64) -> [f64; 2] {
        match self {
            Self::Forced { rate, wave, offset } => {
                [(wave * x).cos() + offset * (rate * x).exp(), 0.0]
            }
            Self::Saddle { angle, .. } => turn(angle, [x.cos(), x.sin()]),
            Self::Kaps { .. } => [(-2.0 * x).exp(), (-x).exp()],
            Self::Cubic { wave, .. } => [(wave * x).sin() + 2.0, 0.0],
        }
    }
}

impl Formula for Growth {
    fn slope<T: Real>(&self, x: f64, y: &[T], _p: &[T], dy: &mut [T]) {
        match self.kind {
            Kind::Forced { rate, wave, .. } => {
                let (sin, cos) = (wave * x).sin_cos();
                dy[0] = (y[0] - cos) * rate - wave * sin;
            }
            Kind::Saddle { rate, angle, .. } => {
                let [u, v] = turn(-angle, [y[0], y[1]]);
                let (sin, cos) = x.sin_cos();
                dy.copy_from_slice(&turn(
                    angle,
                    [(u - cos) * rate - sin, (v - sin) * -rate + cos],
                ));
            }
            Kind::Kaps { rate } => {
                dy[0] = y[0] * -(rate + 2.0) + y[1] * y[1] * rate;
                dy[1] = y[0] - y[1] - y[1] * y[1];
            }
            Kind::Cubic { rate, wave } => {
                let (sin, cos) = (wave * x).sin_cos();
                dy[0] = -(y[0].powi(3) - (sin + 2.0).powi(3)) * rate + wave * cos;
            }
        }
    }

    fn residual<T: Real>(&self, a: &[T], b: &[T], _p: &[T], r: &mut [T]) {
        let (start, end) = (self.kind.exact(0.0), self.kind.exact(self.to));
        match self.kind {
            Kind::Saddle { angle, wrong, .. } => {
                let (a, b) = (turn(-angle, [a[0], a[1]]), turn(-angle, [b[0], b[1]]));
                let (start, end) = (turn(-angle, start), turn(-angle, end));
                r[0] = if wrong {
                    a[0] - start[0]
                } else {
                    b[0] - end[0]
                };
                r[1] = if wrong {
                    b[1] - end[1]
                } else {
                    a[1] - start[1]
                };
            }
            _ => {
                for (r, (a, start)) in r.iter_mut().zip(a.iter().zip(start)) {
                    *r = *a - start;
                }
            }
        }
    }
}

pub(crate) fn draw(draw: &mut Draw) -> Trial {
    match draw.below(5) {
        0 => {
            let (rate, exponent) = (draw.log_between(0.5, 50.0), draw.log_between(1.0, 45.0));
            let (wave, to) = (draw.log_between(0.5, 3.0), exponent / rate);
            trial(
                "growth from the start",
                draw,
                Kind::Forced {
                    rate,
                    wave,
                    offset: 0.0,
                },
                to,
            )
        }
        1 => {
            let (rate, wave) = (-draw.log_between(10.0, 1e6), draw.log_between(0.5, 3.0));
            let (offset, to) = (draw.between(-2.0, 2.0), draw.log_between(0.3, 10.0));
            trial("stiff decay", draw, Kind::Forced { rate, wave, offset }, to)
        }
        2 => {
            let (rate, angle) = (draw.log_between(0.5, 50.0), draw.between(0.0, 3.0));
            let wrong = draw.chance(0.6);
            let exponent = draw.log_between(1.0, if wrong { 45.0 } else { 500.0 });
            trial(
                "saddle",
                draw,
                Kind::Saddle { rate, angle, wrong },
                exponent / rate,
            )
        }
        3 => {
            let (rate, to) = (draw.log_between(1.0, 1e6), draw.log_between(0.3, 10.0));
            trial("Kaps", draw, Kind::Kaps { rate }, to)
        }
        _ => {
            let (rate, wave) = (draw.log_between(0.1, 1e4), draw.between(0.5, 5.0));
            let to = draw.log_between(0.3, 10.0);
            trial("cubic decay", draw, Kind::Cubic { rate, wave }, to)
        }
    }
}

fn trial(name: &'static str, draw: &mut Draw, kind: Kind, to: f64) -> Trial {
    let states = match kind {
        Kind::Forced { .. } | Kind::Cubic { .. } => 1,
        Kind::Saddle { .. } | Kind::Kaps { .. } => 2,
    };
    let (guess, exact): (Known, Known) = if states == 1 {
        let exact = move |x: f64| [kind.exact(x)[0]];
        (some_guess(draw, 1.0, exact), known(exact))
    } else {
        let exact = move |x: f64| kind.exact(x);
        (some_guess(draw, 1.0, exact), known(exact))
    };
    let places = match kind {
        Kind::Forced { rate, .. } => (1..20).map(|i| 0.5 * f64::from(i) / rate.abs()).collect(),
        _ => vec![],
    };
    Trial {
        kind: name,
        numbers: format!("{kind:?} on [0, {to}]"),
        equations: OnSegment::new(Growth { kind, to }, states, 0.0, to, 0),
        guess,
        truth: Truth::Only(vec![exact]),
        places,
    }
}
