//! Growth from seeds far below the tolerance: where a state is that small its defect shows nothing, and what it
//! grows to depends on all of it.

use crate::draw::Draw;
use crate::integrate::{Orbit, step};
use crate::trial::{Formula, OnSegment, Trial, Truth, known, some_guess};
use bvp::Real;

/// Equal steps in which the epidemic is integrated.
const STEPS: usize = 200;

#[derive(Clone, Copy, Debug)]
enum Kind {
    /// y′ = y (1 − y), y(0) given.
    Logistic,
    /// y′ = y, y(0) given.
    Exponential,
    /// y″ = y, y(0) = y′(0) given.
    Second,
    /// y₁′ = −r y₁ y₂, y₂′ = r y₁ y₂ − y₂ from y₁ = 1, an epidemic.
    Epidemic { ratio: f64 },
}

struct Seeded {
    kind: Kind,
    seed: f64,
}

impl Kind {
    fn slope<T: Real>(self, y: &[T], dy: &mut [T]) {
        match self {
            Self::Logistic => dy[0] = -y[0] * (y[0] - 1.0),
            Self::Exponential => dy[0] = y[0],
            Self::Second => {
                dy[0] = y[1];
                dy[1] = y[0];
            }
            Self::Epidemic { ratio } => {
                let infections = y[0] * y[1] * ratio;
                dy[0] = -infections;
                dy[1] = infections - y[1];
            }
        }
    }

    fn start(self, seed: f64) -> [f64; 2] {
        match self {
            Self::Epidemic { .. } => [1.0, seed],
            _ => [seed; 2],
        }
    }
}

impl Formula for Seeded {
    fn slope<T: Real>(&self, _x: f64, y: &[T], _p: &[T], dy: &mut [T]) {
        self.kind.slope(y, dy);
    }

    fn residual<T: Real>(&self, a: &[T], _b: &[T], _p: &[T], r: &mut [T]) {
        for ((r, a), start) in r.iter_mut().zip(a).zip(self.kind.start(self.seed)) {
            *r = *a - start;
        }
    }
}

pub(crate) fn draw(draw: &mut Draw) -> Trial {
    let seed = draw.log_between(1e-12, 1e-1);
    // From where the seed has hardly grown to far beyond one.
    let exponent = draw.between(0.3, 1.7) * -seed.ln();
    match draw.below(4) {
        0 => one("logistic", draw, Kind::Logistic, seed, exponent, |y0, x| {
            let odds = y0 / (1.0 - y0) * x.exp();
            odds / (1.0 + odds)
        }),
        1 => one(
            "exponential",
            draw,
            Kind::Exponential,
            seed,
            exponent,
            |y0, x| y0 * x.exp(),
        ),
        2 => {
            let exact = move |x: f64| [seed * x.exp(); 2];
            two("second order", draw, Kind::Second, seed, exponent, exact)
        }
        _ => {
            let kind = Kind::Epidemic {
                ratio: draw.between(1.5, 4.0),
            };
            let field = move |y: [f64; 2]| {
                let mut dy = [0.0; 2];
                kind.slope(&y, &mut dy);
                dy
            };
            let orbit = Orbit::new(&field, kind.start(seed), exponent, STEPS);
            let exact = move |x: f64| {
                let before = |&i: &usize| i as f64 * orbit.step <= x;
                let i = (0..orbit.states.len()).rfind(before).unwrap_or(0);
                step(&field, orbit.states[i], x - i as f64 * orbit.step)
            };
            two("epidemic", draw, kind, seed, exponent, exact)
        }
    }
}

fn one(
    name: &'static str,
    draw: &mut Draw,
    kind: Kind,
    seed: f64,
    to: f64,
    exact: impl Fn(f64, f64) -> f64 + Copy + Send + Sync + 'static,
) -> Trial {
    let exact = move |x: f64| [exact(seed, x)];
    Trial {
        kind: name,
        numbers: format!("{kind:?} from {seed} on [0, {to}]"),
        equations: OnSegment::new(Seeded { kind, seed }, 1, 0.0, to, 0),
        guess: some_guess(draw, 1.0, exact),
        truth: Truth::Only(vec![known(exact)]),
        places: vec![],
    }
}

fn two(
    name: &'static str,
    draw: &mut Draw,
    kind: Kind,
    seed: f64,
    to: f64,
    exact: impl Fn(f64) -> [f64; 2] + Clone + Send + Sync + 'static,
) -> Trial {
    Trial {
        kind: name,
        numbers: format!("{kind:?} from {seed} on [0, {to}]"),
        equations: OnSegment::new(Seeded { kind, seed }, 2, 0.0, to, 0),
        guess: some_guess(draw, 1.0, exact.clone()),
        truth: Truth::Only(vec![known(exact)]),
        places: vec![],
    }
}
