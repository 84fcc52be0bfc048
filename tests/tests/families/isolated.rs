//! Problems whose solutions are not isolated: periodic orbits without a phase condition, resonance,
//! free constants, parameters that nothing determines. A success is right only at another solution that
//! is isolated, such as an equilibrium.

use crate::draw::Draw;
use crate::integrate::{Orbit, to_falling_zero};
use crate::trial::{Formula, Known, OnSegment, Trial, Truth, known, known_with};
use bvp::Real;
use std::f64::consts::PI;

pub(crate) fn draw(draw: &mut Draw) -> Trial {
    match draw.below(5) {
        0 | 1 => orbit(draw),
        2 => resonance(draw),
        3 => constant(draw),
        _ => parameter(draw),
    }
}

/// An autonomous system of two states with a period.
#[derive(Clone, Copy, Debug)]
enum Flow {
    /// y″ = μ (1 − y²) y′ − y.
    VanDerPol(f64),
    /// u′ = a u − u v, v′ = u v − v.
    LotkaVolterra(f64),
    /// y″ = −sin y.
    Pendulum,
    /// y″ = −y − b y³.
    Duffing(f64),
    /// The unit circle attracts at a rate; it is run through at an angular velocity.
    Circle { rate: f64, velocity: f64 },
    /// y₁′ = ω y₂, y₂′ = −ω y₁.
    Rotation(f64),
}

impl Flow {
    fn slope<T: Real>(self, y: &[T]) -> [T; 2] {
        let [u, v] = [y[0], y[1]];
        match self {
            Self::VanDerPol(mu) => [v, -(u * u - 1.0) * v * mu - u],
            Self::LotkaVolterra(a) => [u * a - u * v, u * v - v],
            Self::Pendulum => [v, -u.sin()],
            Self::Duffing(b) => [v, -u - u.powi(3) * b],
            Self::Circle { rate, velocity } => {
                let growth = -(u * u + v * v - 1.0) * rate;
                [u * growth - v * velocity, v * growth + u * velocity]
            }
            Self::Rotation(omega) => [v * omega, u * -omega],
        }
    }

    fn field(self) -> impl Fn([f64; 2]) -> [f64; 2] {
        move |y| self.slope(&y)
    }

    /// The period of the orbit and a point of it.
    fn period(self, draw: &mut Draw) -> (f64, [f64; 2]) {
        let f = self.field();
        match self {
            Self::VanDerPol(_) => {
                let mut y = [2.0, 0.0];
                let mut period = 0.0;
                for _ in 0..60 {
                    (period, y) = to_falling_zero(&f, y, 0.0, 0.05);
                    y[1] = 0.0;
                }
                (period, y)
            }
            Self::LotkaVolterra(a) => {
                let y = [1.0 + draw.between(0.3, 1.5), a];
                let (_, on) = to_falling_zero(&f, y, a, 0.02);
                (to_falling_zero(&f, on, a, 0.02).0, on)
            }
            Self::Pendulum | Self::Duffing(_) => {
                let y = [draw.between(0.3, 2.5), 0.0];
                let (_, on) = to_falling_zero(&f, y, 0.0, 0.05);
                (to_falling_zero(&f, on, 0.0, 0.05).0, on)
            }
            Self::Circle { velocity, .. } => (2.0 * PI / velocity, [1.0, 0.0]),
            Self::Rotation(omega) => (2.0 * PI / omega, [draw.between(0.2, 2.0), 0.0]),
        }
    }

    /// Its equilibria, which are isolated periodic solutions.
    fn equilibria(self) -> Vec<[f64; 2]> {
        match self {
            Self::VanDerPol(_) | Self::Duffing(_) | Self::Circle { .. } => vec![[0.0; 2]],
            Self::LotkaVolterra(a) => vec![[0.0; 2], [1.0, a]],
            Self::Pendulum => (-4..=4).map(|i| [f64::from(i) * PI, 0.0]).collect(),
            Self::Rotation(_) => vec![],
        }
    }
}

/// Periodic solutions of a flow, in time 0 … T.
struct Periodic {
    flow: Flow,
    /// What state 0 grows by in a period.
    growth: f64,
}

impl Formula for Periodic {
    fn slope<T: Real>(&self, _x: f64, y: &[T], _p: &[T], dy: &mut [T]) {
        dy.copy_from_slice(&self.flow.slope(y));
    }

    fn residual<T: Real>(&self, a: &[T], b: &[T], _p: &[T], r: &mut [T]) {
        r[0] = b[0] - a[0] - self.growth;
        r[1] = b[1] - a[1];
    }
}

fn orbit(draw: &mut Draw) -> Trial {
    if draw.chance(0.2) {
        return rotating_pendulum(draw);
    }
    let (kind, flow) = match draw.below(6) {
        0 => ("Van der Pol", Flow::VanDerPol(draw.log_between(0.1, 3.0))),
        1 => (
            "Lotka-Volterra",
            Flow::LotkaVolterra(draw.between(0.5, 2.0)),
        ),
        2 => ("pendulum", Flow::Pendulum),
        3 => ("Duffing", Flow::Duffing(draw.log_between(0.1, 3.0))),
        4 => {
            let (rate, velocity) = (draw.log_between(0.1, 10.0), draw.log_between(0.3, 5.0));
            ("attracting circle", Flow::Circle { rate, velocity })
        }
        _ => ("rotation", Flow::Rotation(draw.log_between(0.3, 5.0))),
    };
    let (period, on) = flow.period(draw);
    let orbit = Orbit::new(&flow.field(), on, period, 200);
    let (phase, bent) = (draw.between(0.0, period), draw.log_between(1e-6, 0.3));
    let guess = known(move |x| {
        let y = orbit.at((x + phase) % period);
        let wave = (2.0 * PI * x / period).sin();
        [y[0] + bent * wave, y[1] - bent * wave]
    });
    Trial {
        kind,
        numbers: format!("{flow:?}, period {period}, from {on:?}, guess off by {bent}"),
        equations: OnSegment::new(Periodic { flow, growth: 0.0 }, 2, 0.0, period, 0),
        guess,
        truth: Truth::Only(
            flow.equilibria()
                .into_iter()
                .map(|y| known(move |_| y))
                .collect(),
        ),
        places: vec![],
    }
}

/// A pendulum that turns over, y(T) = y(0) + 2π.
fn rotating_pendulum(draw: &mut Draw) -> Trial {
    let (flow, speed) = (Flow::Pendulum, draw.between(2.2, 5.0));
    let f = flow.field();
    // The time to turn once, by Newton's method.
    let mut period = 2.0 * PI / speed;
    for _ in 0..60 {
        let end = Orbit::new(&f, [0.0, speed], period, 200).last();
        period -= (end[0] - 2.0 * PI) / end[1];
    }
    let orbit = Orbit::new(&f, [0.0, speed], 2.0 * period, 400);
    let (phase, bent) = (draw.between(0.0, period), draw.log_between(1e-6, 0.3));
    let guess = known(move |x| {
        let y = orbit.at(x + phase);
        [y[0] + bent * x.sin(), y[1] + bent * x.cos()]
    });
    Trial {
        kind: "rotating pendulum",
        numbers: format!("speed {speed} below, period {period}, guess off by {bent}"),
        equations: OnSegment::new(
            Periodic {
                flow,
                growth: 2.0 * PI,
            },
            2,
            0.0,
            period,
            0,
        ),
        guess,
        truth: Truth::Only(vec![]),
        places: vec![],
    }
}

/// y″ = −(kπ)² y + c sin mπx with y(0) = y(1) = 0, m ≠ k.
struct Resonance {
    wave: f64,
    load: f64,
    load_wave: f64,
}

impl Formula for Resonance {
    fn slope<T: Real>(&self, x: f64, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = y[0] * -self.wave.powi(2) + self.load * (self.load_wave * x).sin();
    }

    fn residual<T: Real>(&self, a: &[T], b: &[T], _p: &[T], r: &mut [T]) {
        r[0] = a[0];
        r[1] = b[0];
    }
}

fn some_constants(draw: &mut Draw) -> [f64; 2] {
    let none = draw.chance(0.3);
    std::array::from_fn(|_| if none { 0.0 } else { draw.between(-2.0, 2.0) })
}

fn resonance(draw: &mut Draw) -> Trial {
    let k = 1 + draw.below(6);
    let load = if draw.chance(0.4) {
        0.0
    } else {
        draw.between(-10.0, 10.0)
    };
    let (wave, load_wave) = (PI * k as f64, PI * (k + 1 + draw.below(3)) as f64);
    let constants = some_constants(draw);
    Trial {
        kind: "resonance",
        numbers: format!(
            "y'' = -({k} pi)^2 y + {load} sin {load_wave} x, zero ends, guess {constants:?}"
        ),
        equations: OnSegment::new(
            Resonance {
                wave,
                load,
                load_wave,
            },
            2,
            0.0,
            1.0,
            0,
        ),
        guess: known(move |x| {
            [
                constants[0] * (wave * x).sin(),
                constants[1] * (3.0 * x).cos(),
            ]
        }),
        truth: Truth::Only(vec![]),
        places: vec![],
    }
}

/// Free constants.
#[derive(Clone, Copy, Debug)]
enum Free {
    /// y″ = c cos 2πx, y′ = 0 at both ends.
    Neumann(f64),
    /// y′ = c cos 2πx, y(0) = y(1).
    Periodic(f64),
    /// y″ = c, the slope given twice.
    Slopes(f64),
    /// y₁′ = y₁² + c, y₂′ = cos x, y₁(0) given twice.
    Decoupled(f64),
}

impl Formula for Free {
    fn slope<T: Real>(&self, x: f64, y: &[T], _p: &[T], dy: &mut [T]) {
        match *self {
            Self::Neumann(c) => {
                dy[0] = y[1];
                dy[1] = T::from_f64(c * (2.0 * PI * x).cos());
            }
            Self::Periodic(c) => dy[0] = T::from_f64(c * (2.0 * PI * x).cos()),
            Self::Slopes(c) => {
                dy[0] = y[1];
                dy[1] = T::from_f64(c);
            }
            Self::Decoupled(c) => {
                dy[0] = -y[0] * y[0] + c;
                dy[1] = T::from_f64(x.cos());
            }
        }
    }

    fn residual<T: Real>(&self, a: &[T], b: &[T], _p: &[T], r: &mut [T]) {
        match *self {
            Self::Neumann(_) => {
                r[0] = a[1];
                r[1] = b[1];
            }
            Self::Periodic(_) => r[0] = b[0] - a[0],
            Self::Slopes(c) => {
                r[0] = a[1] - c;
                r[1] = b[1] - 2.0 * c;
            }
            Self::Decoupled(_) => {
                r[0] = a[0] - 0.5;
                r[1] = a[0] * 2.0 - 1.0;
            }
        }
    }
}

fn constant(draw: &mut Draw) -> Trial {
    let c = draw.sign() * draw.log_between(0.01, 10.0);
    let (kind, free, states) = match draw.below(4) {
        0 => ("Neumann", Free::Neumann(c), 2),
        1 => ("periodic constant", Free::Periodic(c), 1),
        2 => ("slopes alone", Free::Slopes(c), 2),
        _ => ("condition stated twice", Free::Decoupled(c.abs()), 2),
    };
    let constants = some_constants(draw);
    let guess: Known = if states == 1 {
        known(move |_| [constants[0]])
    } else {
        known(move |_| constants)
    };
    Trial {
        kind,
        numbers: format!("{free:?}, guess {constants:?}"),
        equations: OnSegment::new(free, states, 0.0, 1.0, 0),
        guess,
        truth: Truth::Only(vec![]),
        places: vec![],
    }
}

/// Parameters that nothing determines.
#[derive(Clone, Copy, Debug)]
enum Idle {
    /// y′ = −y + cos x, y(0) = 1 stated twice; p appears nowhere.
    Absent,
    /// y′ = (p₁ + p₂) y, y(0) = 1, y(1) = 2, and that again.
    Sum,
    /// y″ = −p y, y(0) = y(1) = 0 = y(0) + y(1): zero for every p.
    Eigenvalue,
    /// y″ = −p y, y(0) = y(1) = 0, y′(0) = y′(1): any amplitude at p = (2π)².
    Amplitude,
}

impl Formula for Idle {
    fn slope<T: Real>(&self, x: f64, y: &[T], p: &[T], dy: &mut [T]) {
        match self {
            Self::Absent => dy[0] = -y[0] + x.cos(),
            Self::Sum => dy[0] = (p[0] + p[1]) * y[0],
            Self::Eigenvalue | Self::Amplitude => {
                dy[0] = y[1];
                dy[1] = -p[0] * y[0];
            }
        }
    }

    fn residual<T: Real>(&self, a: &[T], b: &[T], _p: &[T], r: &mut [T]) {
        match self {
            Self::Absent => {
                r[0] = a[0] - 1.0;
                r[1] = a[0] * 3.0 - 3.0;
            }
            Self::Sum => {
                r[0] = a[0] - 1.0;
                r[1] = b[0] - 2.0;
                r[2] = a[0] + b[0] - 3.0;
            }
            Self::Eigenvalue => {
                r[0] = a[0];
                r[1] = b[0];
                r[2] = a[0] + b[0];
            }
            Self::Amplitude => {
                r[0] = a[0];
                r[1] = b[0];
                r[2] = b[1] - a[1];
            }
        }
    }
}

fn parameter(draw: &mut Draw) -> Trial {
    let (kind, idle, states, parameters) = match draw.below(4) {
        0 => ("parameter nowhere", Idle::Absent, 1, 1),
        1 => ("sum of parameters", Idle::Sum, 1, 2),
        2 => ("eigenvalue of zero", Idle::Eigenvalue, 2, 1),
        _ => ("eigenfunction of any size", Idle::Amplitude, 2, 1),
    };
    let amplitude = draw.between(-2.0, 2.0);
    let guessed: Vec<f64> = match idle {
        Idle::Amplitude => vec![(2.0 * PI).powi(2) * (1.0 + draw.between(-0.1, 0.1))],
        _ => (0..parameters).map(|_| draw.between(-2.0, 2.0)).collect(),
    };
    let numbers = format!("{idle:?}, guess {guessed:?} and {amplitude}");
    let guess: Known = if states == 1 {
        known_with(guessed, move |_| [amplitude])
    } else {
        known_with(guessed, move |x| {
            let (sin, cos) = (2.0 * PI * x).sin_cos();
            [amplitude * sin, amplitude * 2.0 * PI * cos]
        })
    };
    Trial {
        kind,
        numbers,
        equations: OnSegment::new(idle, states, 0.0, 1.0, parameters),
        guess,
        truth: Truth::Only(vec![]),
        places: vec![],
    }
}
