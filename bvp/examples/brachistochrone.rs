//! A free end: the slide on which a bead falls from rest to a given point in the shortest time.
//!
//! With the speed v and the slope angle θ below the horizontal, the time is shortest when cos θ / v
//! stays the same all along (Johann Bernoulli's analogy with Snell's law). Differentiating
//! cos θ = κ v gives
//!
//! ```text
//! dx/dt = v cos θ,   dy/dt = v sin θ,   dv/dt = g sin θ,   dθ/dt = −κ g
//! ```
//!
//! The fall takes an unknown time T, so t = T s with s in [0, 1] and every right-hand side is
//! multiplied by T. Unknown constants: four states and the parameters T and κ. Six conditions: start
//! at the origin, at rest, vertically; end at (a, b).
//!
//! The answer is a cycloid; to its lowest point, b = 2a/π, the fall takes T = π √(b/(2g)).
//!
//! Run with `cargo run -p bvp --example brachistochrone`.

use bvp::{Ends, Error, Function, Options, Problem, Real, Segment, Solution, solve};
use std::f64::consts::{FRAC_PI_2, PI};

/// Acceleration of gravity in m/s².
const GRAVITY: f64 = 9.81;

/// The slide to the point `a` to the right and `b` below the start, in m.
struct Slide {
    a: f64,
    b: f64,
}

impl Problem for Slide {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(4)]
    }

    fn parameters(&self) -> usize {
        2
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        let (time, kappa) = (p[0], p[1]);
        let (speed, (sin, cos)) = (y[2], y[3].sin_cos());
        dy[0] = time * speed * cos;
        dy[1] = time * speed * sin;
        dy[2] = time * sin * GRAVITY;
        dy[3] = -time * kappa * GRAVITY;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        let (start, end) = (at.start(0), at.end(0));
        r[0] = start[0];
        r[1] = start[1];
        r[2] = start[2];
        r[3] = start[3] - FRAC_PI_2;
        r[4] = end[0] - self.a;
        r[5] = end[1] - self.b;
    }
}

/// Solves from the straight line, with the speed of free fall at its end.
fn fastest(a: f64, b: f64) -> Result<Solution, Error> {
    let speed = (2.0 * GRAVITY * b).sqrt();
    let guess = Function {
        state: |_segment: usize, s: f64| [a * s, b * s, speed * s, FRAC_PI_2 * (1.0 - s)],
        parameters: vec![2.0 * a.hypot(b) / speed, 1.0 / speed],
    };
    let options = Options {
        tolerance: 1e-9,
        ..Options::default()
    };
    solve(&Slide { a, b }, &guess, &options)
}

fn main() -> Result<(), Error> {
    let b = 1.0;
    println!("   a      b   time on the slide   on a straight ramp");
    for a in [0.5, 1.0, FRAC_PI_2, 2.5] {
        let solution = fastest(a, b)?;
        let time = solution.parameters()[0];
        let ramp = (2.0 * (a * a + b * b) / (GRAVITY * b)).sqrt();
        println!("{a:4.2} m {b:4.2} m {time:15.9} s {ramp:18.9} s");
        assert!(time < ramp);
    }
    let time = fastest(FRAC_PI_2, b)?.parameters()[0];
    assert!((time - PI * (0.5 * b / GRAVITY).sqrt()).abs() < 1e-9);

    println!("\nThe slide to its lowest point:");
    println!("    x         y        speed");
    let solution = fastest(FRAC_PI_2, b)?;
    let mut y = [0.0; 4];
    for i in 0..=5 {
        solution.state(0, 0.2 * f64::from(i), &mut y);
        println!("{:6.4} m  {:6.4} m  {:6.4} m/s", y[0], y[1], y[2]);
    }
    Ok(())
}
