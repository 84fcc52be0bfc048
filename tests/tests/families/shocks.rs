//! Shocks and interfaces whose place is exponentially ill determined.

use crate::draw::Draw;
use crate::layers::{Burgers, shock, shock_guess};
use crate::trial::{Formula, Known, OnSegment, Trial, Truth, known};
use bvp::{Guess, Real};
use std::f64::consts::SQRT_2;

pub(crate) fn draw(draw: &mut Draw) -> Trial {
    match draw.below(4) {
        0 => symmetric(draw),
        1 => asymmetric(draw),
        2 => interface(draw),
        _ => free_interface(draw),
    }
}

/// ε y″ = y y′ from 1 to −1: the shock is in the middle.
fn symmetric(draw: &mut Draw) -> Trial {
    let width = draw.log_between(1e-3, 0.2);
    // The height a with a tanh(a/(4ε)) = 1, by iteration from above.
    let mut height = 1.0;
    for _ in 0..200 {
        height = 0.5 * (height + 1.0 / f64::tanh(0.25 * height / width));
    }
    let (exact, ends) = (shock(height, 0.5, width), [1.0, -1.0]);
    burgers("Burgers from 1 to -1", draw, width, ends, 0.5, exact)
}

/// ε y″ = y y′ with a shock anywhere: what determines its place is exponentially small.
fn asymmetric(draw: &mut Draw) -> Trial {
    let width = draw.log_between(1e-3, 0.2);
    let (height, place) = (draw.between(0.5, 2.0), draw.between(0.1, 0.9));
    let exact = shock(height, place, width);
    let ends = [exact(0.0)[0], exact(1.0)[0]];
    burgers("Burgers, any place", draw, width, ends, place, exact)
}

fn burgers(
    kind: &'static str,
    draw: &mut Draw,
    width: f64,
    ends: [f64; 2],
    place: f64,
    exact: impl Fn(f64) -> [f64; 2] + Clone + Send + Sync + 'static,
) -> Trial {
    Trial {
        kind,
        numbers: format!("e y'' = y y', e = {width}, ends {ends:?}, shock at {place}"),
        equations: OnSegment::new(Burgers { width, ends }, 2, 0.0, 1.0, 0),
        guess: shock_guess(draw, ends, exact.clone()),
        truth: Truth::Only(vec![known(exact)]),
        places: (-10..=10)
            .map(|i| place + 0.5 * width * f64::from(i))
            .collect(),
    }
}

/// ε² y″ = y³ − y, with given ends or with y′ = 0 there.
struct AllenCahn {
    width: f64,
    ends: Option<[f64; 2]>,
}

impl Formula for AllenCahn {
    fn slope<T: Real>(&self, _x: f64, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = (y[0].powi(3) - y[0]) / (self.width * self.width);
    }

    fn residual<T: Real>(&self, a: &[T], b: &[T], _p: &[T], r: &mut [T]) {
        r[0] = self.ends.map_or(a[1], |[left, _]| a[0] - left);
        r[1] = self.ends.map_or(b[1], |[_, right]| b[0] - right);
    }
}

/// A guessed interface at a place of its own.
fn guessed_interface(draw: &mut Draw, width: f64) -> Known {
    let (place, width) = (draw.between(0.1, 0.9), width * draw.log_between(0.5, 3.0));
    let rate = 1.0 / (SQRT_2 * width);
    known(move |x| {
        let tanh = (rate * (x - place)).tanh();
        [tanh, rate * (1.0 - tanh * tanh)]
    })
}

/// Ends of a tanh.
fn interface(draw: &mut Draw) -> Trial {
    let (width, place) = (draw.log_between(3e-3, 0.3), draw.between(0.1, 0.9));
    let rate = 1.0 / (SQRT_2 * width);
    let exact = move |x: f64| {
        let tanh = (rate * (x - place)).tanh();
        [tanh, rate * (1.0 - tanh * tanh)]
    };
    let ends = [exact(0.0)[0], exact(1.0)[0]];
    let guess = if draw.chance(0.5) {
        guessed_interface(draw, width)
    } else {
        shock_guess(draw, ends, exact)
    };
    Trial {
        kind: "interface",
        numbers: format!("e^2 y'' = y^3 - y, e = {width}, ends {ends:?}, interface at {place}"),
        equations: OnSegment::new(
            AllenCahn {
                width,
                ends: Some(ends),
            },
            2,
            0.0,
            1.0,
            0,
        ),
        guess,
        truth: Truth::OneOf(known(exact)),
        places: (-10..=10)
            .map(|i| place + 0.5 * width * f64::from(i))
            .collect(),
    }
}

/// y′ = 0 at both ends: every solution is symmetric or antisymmetric about the middle, since the points
/// where y′ vanishes are equally spaced.
fn free_interface(draw: &mut Draw) -> Trial {
    let width = draw.log_between(3e-3, 0.3);
    let guess = guessed_interface(draw, width);
    let asymmetry = move |found: &dyn Guess| {
        let (mut left, mut right) = ([0.0; 2], [0.0; 2]);
        let mut largest = [0.0f64; 2];
        for i in 0..=200 {
            let x = f64::from(i) / 400.0;
            found.state(0, x, &mut left);
            found.state(0, 1.0 - x, &mut right);
            for (largest, sign) in largest.iter_mut().zip([-1.0, 1.0]) {
                let error = (left[0] + sign * right[0]).abs() / (1.0 + left[0].abs());
                *largest = largest.max(if error.is_nan() { f64::INFINITY } else { error });
            }
        }
        largest[0].min(largest[1])
    };
    Trial {
        kind: "free interface",
        numbers: format!("e^2 y'' = y^3 - y, e = {width}, y' = 0 at the ends"),
        equations: OnSegment::new(AllenCahn { width, ends: None }, 2, 0.0, 1.0, 0),
        guess,
        truth: Truth::Measured(Box::new(asymmetry)),
        places: vec![],
    }
}
