//! Layers at ends, corners and in the interior, of widths down to 1e-4.

use crate::draw::Draw;
use crate::trial::{Formula, Known, OnSegment, Trial, Truth, known, some_guess};
use bvp::Real;

pub(crate) fn draw(draw: &mut Draw) -> Trial {
    match draw.below(6) {
        0 => convection(draw),
        1 => reaction(draw),
        2 => turning_point(draw),
        3 => corner(draw),
        4 => burgers(draw),
        _ => boundary_of_burgers(draw),
    }
}

/// y″ = a(x) y′ + b(x) y + c(x) with given ends, a linear problem of a small width.
struct Linear {
    kind: Kind,
    width: f64,
    numbers: [f64; 2],
    ends: [f64; 2],
}

#[derive(Clone, Copy)]
enum Kind {
    /// ε y″ = −b y′.
    Convection,
    /// ε² y″ = y − (1 + ε² k²) a cos kx.
    Reaction,
    /// ε y″ = −2 (x − c) y′.
    TurningPoint,
    /// ε y″ = −(x − c) y′ + y.
    Corner,
}

impl Formula for Linear {
    fn slope<T: Real>(&self, x: f64, y: &[T], _p: &[T], dy: &mut [T]) {
        let (width, [a, b]) = (self.width, self.numbers);
        dy[0] = y[1];
        dy[1] = match self.kind {
            Kind::Convection => y[1] * (-b / width),
            Kind::Reaction => {
                (y[0] - a * (1.0 + (width * b).powi(2)) * (b * x).cos()) / (width * width)
            }
            Kind::TurningPoint => y[1] * (-2.0 * (x - a) / width),
            Kind::Corner => (y[0] - y[1] * (x - a)) / width,
        };
    }

    fn residual<T: Real>(&self, a: &[T], b: &[T], _p: &[T], r: &mut [T]) {
        r[0] = a[0] - self.ends[0];
        r[1] = b[0] - self.ends[1];
    }
}

/// A linear problem on \[`from`, 1\] with its exact solution.
fn linear(
    name: &'static str,
    draw: &mut Draw,
    from: f64,
    problem: Linear,
    places: Vec<f64>,
    exact: impl Fn(f64) -> [f64; 2] + Clone + Send + Sync + 'static,
) -> Trial {
    let Linear {
        width,
        numbers,
        ends,
        ..
    } = &problem;
    Trial {
        kind: name,
        numbers: format!("width {width}, numbers {numbers:?}, ends {ends:?}"),
        equations: OnSegment::new(problem, 2, from, 1.0, 0),
        guess: some_guess(draw, 1.0, exact.clone()),
        truth: Truth::Only(vec![known(exact)]),
        places,
    }
}

fn two(draw: &mut Draw) -> [f64; 2] {
    [draw.between(-2.0, 2.0), draw.between(-2.0, 2.0)]
}

fn convection(draw: &mut Draw) -> Trial {
    let (width, ends) = (draw.log_between(1e-4, 0.5), two(draw));
    let speed = draw.sign() * draw.log_between(0.3, 3.0);
    // e^(−b x/ε), its largest value 1.
    let rate = -speed / width;
    let mode = move |x: f64| (rate * if rate > 0.0 { x - 1.0 } else { x }).exp();
    let (at_0, at_1) = (mode(0.0), mode(1.0));
    let factor = (ends[1] - ends[0]) / (at_1 - at_0);
    let exact = move |x: f64| [ends[0] + factor * (mode(x) - at_0), factor * rate * mode(x)];
    let layer = if rate > 0.0 { 1.0 } else { 0.0 };
    let places = (1..20)
        .map(|i| (layer - f64::from(i) * 0.5 / rate).clamp(0.0, 1.0))
        .collect();
    let problem = Linear {
        kind: Kind::Convection,
        width,
        numbers: [0.0, speed],
        ends,
    };
    linear("convection layer", draw, 0.0, problem, places, exact)
}

fn reaction(draw: &mut Draw) -> Trial {
    let (width, ends) = (draw.log_between(1e-4, 0.5), two(draw));
    let (load, wave) = (draw.between(-1.0, 1.0), draw.between(0.0, 8.0));
    // y = a cos kx + A e^(−x/ε) + B e^((x − 1)/ε).
    let tail = (-1.0 / width).exp();
    let (left, right) = (ends[0] - load, ends[1] - load * wave.cos());
    let determinant = 1.0 - tail * tail;
    let (a, b) = (
        (left - tail * right) / determinant,
        (right - tail * left) / determinant,
    );
    let exact = move |x: f64| {
        let (down, up) = (a * (-x / width).exp(), b * ((x - 1.0) / width).exp());
        let (sin, cos) = (wave * x).sin_cos();
        [
            load * cos + down + up,
            (up - down) / width - load * wave * sin,
        ]
    };
    let near = |i: i32| [0.5 * width * f64::from(i), 1.0 - 0.5 * width * f64::from(i)];
    let places = (1..20).flat_map(near).collect();
    let problem = Linear {
        kind: Kind::Reaction,
        width,
        numbers: [load, wave],
        ends,
    };
    linear("reaction layers", draw, 0.0, problem, places, exact)
}

fn turning_point(draw: &mut Draw) -> Trial {
    let (width, ends) = (draw.log_between(1e-6, 0.5), two(draw));
    let place = draw.between(-0.8, 0.8);
    // y = A + B erf((x − c)/√ε).
    let root = width.sqrt();
    let shape = move |x: f64| Real::erf((x - place) / root);
    let (low, high) = (shape(-1.0), shape(1.0));
    let factor = (ends[1] - ends[0]) / (high - low);
    let exact = move |x: f64| {
        let bell = (-((x - place) / root).powi(2)).exp() * std::f64::consts::FRAC_2_SQRT_PI / root;
        [ends[0] + factor * (shape(x) - low), factor * bell]
    };
    let places = (-10..=10)
        .map(|i| place + 0.3 * root * f64::from(i))
        .collect();
    let problem = Linear {
        kind: Kind::TurningPoint,
        width,
        numbers: [place, 0.0],
        ends,
    };
    linear("interior layer", draw, -1.0, problem, places, exact)
}

fn corner(draw: &mut Draw) -> Trial {
    let (width, ends) = (draw.log_between(1e-6, 0.5), two(draw));
    let place = draw.between(-0.8, 0.8);
    // z = x − c and z erf(z/√(2ε)) + √(2ε/π) e^(−z²/(2ε)) span the solutions.
    let root = (2.0 * width).sqrt();
    let bend = move |z: f64| {
        let bell = (-(z / root).powi(2)).exp() * root / std::f64::consts::PI.sqrt();
        z * Real::erf(z / root) + bell
    };
    let (a, b) = (-1.0 - place, 1.0 - place);
    let determinant = a * bend(b) - b * bend(a);
    let straight = (ends[0] * bend(b) - ends[1] * bend(a)) / determinant;
    let bent = (a * ends[1] - b * ends[0]) / determinant;
    let exact = move |x: f64| {
        let z = x - place;
        [
            straight * z + bent * bend(z),
            straight + bent * Real::erf(z / root),
        ]
    };
    let places = (-10..=10)
        .map(|i| place + 0.3 * root * f64::from(i))
        .collect();
    let problem = Linear {
        kind: Kind::Corner,
        width,
        numbers: [place, 0.0],
        ends,
    };
    linear("corner layer", draw, -1.0, problem, places, exact)
}

/// ε y″ = y y′ with given ends.
pub(crate) struct Burgers {
    pub(crate) width: f64,
    pub(crate) ends: [f64; 2],
}

impl Formula for Burgers {
    fn slope<T: Real>(&self, _x: f64, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = y[0] * y[1] / self.width;
    }

    fn residual<T: Real>(&self, a: &[T], b: &[T], _p: &[T], r: &mut [T]) {
        r[0] = a[0] - self.ends[0];
        r[1] = b[0] - self.ends[1];
    }
}

/// y = −a tanh(a (x − c)/(2ε)) and its slope.
pub(crate) fn shock(height: f64, place: f64, width: f64) -> impl Fn(f64) -> [f64; 2] + Clone {
    let rate = 0.5 * height / width;
    move |x| {
        let (tanh, sech) = (
            (rate * (x - place)).tanh(),
            1.0 / (rate * (x - place)).cosh(),
        );
        [-height * tanh, -height * rate * sech * sech]
    }
}

/// A guess for a shock between given ends: straight, constant, or near the exact solution.
pub(crate) fn shock_guess(
    draw: &mut Draw,
    [left, right]: [f64; 2],
    exact: impl Fn(f64) -> [f64; 2] + Send + Sync + 'static,
) -> Known {
    if draw.chance(0.4) {
        let factor = if draw.chance(0.7) {
            1.0
        } else {
            draw.between(-2.0, 2.0)
        };
        return known(move |x| {
            [
                factor * (left + (right - left) * x),
                factor * (right - left),
            ]
        });
    }
    some_guess(draw, 1.0, exact)
}

/// A shock whose place the ends determine: the exponent of the smallness at the nearer end is at
/// most eight.
fn burgers(draw: &mut Draw) -> Trial {
    let (width, height) = (draw.log_between(1e-3, 0.2), draw.between(0.5, 2.0));
    let exponent = draw.between(0.5, 8.0);
    let distance = (exponent * width / height).min(0.5);
    let place = if draw.chance(0.5) {
        distance
    } else {
        1.0 - distance
    };
    let exact = shock(height, place, width);
    let ends = [exact(0.0)[0], exact(1.0)[0]];
    let places = (-10..=10)
        .map(|i| place + 0.5 * width / height * f64::from(i))
        .collect();
    Trial {
        kind: "Burgers, shock",
        numbers: format!("e y'' = y y', e = {width}, ends {ends:?}, shock of {height} at {place}"),
        equations: OnSegment::new(Burgers { width, ends }, 2, 0.0, 1.0, 0),
        guess: shock_guess(draw, ends, exact.clone()),
        truth: Truth::Only(vec![known(exact)]),
        places,
    }
}

/// A layer at an end of ε y″ = y y′: the tanh is centred at or beyond an end.
fn boundary_of_burgers(draw: &mut Draw) -> Trial {
    let (width, height) = (draw.log_between(1e-3, 0.2), draw.between(0.5, 2.0));
    let beyond = draw.between(0.0, 2.0) * width / height;
    let place = if draw.chance(0.5) {
        -beyond
    } else {
        1.0 + beyond
    };
    let exact = shock(height, place, width);
    let ends = [exact(0.0)[0], exact(1.0)[0]];
    let layer = place.clamp(0.0, 1.0);
    let places = (-10..=10)
        .map(|i| layer + 0.5 * width / height * f64::from(i))
        .collect();
    Trial {
        kind: "Burgers, end layer",
        numbers: format!("e y'' = y y', e = {width}, ends {ends:?}, tanh of {height} at {place}"),
        equations: OnSegment::new(Burgers { width, ends }, 2, 0.0, 1.0, 0),
        guess: shock_guess(draw, ends, exact.clone()),
        truth: Truth::Only(vec![known(exact)]),
        places,
    }
}
