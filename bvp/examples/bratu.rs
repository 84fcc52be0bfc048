//! Two solutions of one problem: Bratu's equation of a reacting slab,
//!
//! ```text
//! y'' + λ exp(y) = 0,   y(0) = y(1) = 0
//! ```
//!
//! y is the dimensionless temperature and λ the strength of the reaction. Below λ = 3.5138 there
//! are two steady states, a cool and a hot one; above it the slab ignites. Which of the two is
//! found depends on the guess alone. Both are known in closed form,
//!
//! ```text
//! y = −2 ln( cosh((s − ½) θ/2) / cosh(θ/4) ),   θ = √(2λ) cosh(θ/4)
//! ```
//!
//! Run with `cargo run -p bvp --example bratu`.

use bvp::{Ends, Error, Function, Options, Problem, Real, Segment, Solution, solve};
use std::f64::consts::PI;

/// States: temperature and its slope.
struct Bratu {
    lambda: f64,
}

impl Problem for Bratu {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2)]
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -y[0].exp() * self.lambda;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0];
    }
}

/// Solves from a sine arch of the given height.
fn from_arch(lambda: f64, height: f64) -> Result<Solution, Error> {
    let guess = Function {
        state: |_segment: usize, s: f64| [height * (PI * s).sin(), height * PI * (PI * s).cos()],
        parameters: vec![],
    };
    let options = Options {
        tolerance: 1e-9,
        ..Options::default()
    };
    solve(&Bratu { lambda }, &guess, &options)
}

/// The temperature in the middle, 2 ln cosh(θ/4), with the root θ nearest to `theta`.
fn exact_middle(lambda: f64, mut theta: f64) -> f64 {
    let c = (2.0 * lambda).sqrt();
    for _ in 0..60 {
        let (cosh, sinh) = ((theta / 4.0).cosh(), (theta / 4.0).sinh());
        theta -= (theta - c * cosh) / (1.0 - 0.25 * c * sinh);
    }
    2.0 * (theta / 4.0).cosh().ln()
}

fn main() -> Result<(), Error> {
    println!("    λ   branch     y(½) computed      closed form   intervals   Newton steps");
    for lambda in [1.0, 2.0, 3.0] {
        for (branch, height, theta) in [("cool", 0.2, 1.0), ("hot", 4.0, 10.0)] {
            let solution = from_arch(lambda, height)?;
            let mut y = [0.0; 2];
            solution.state(0, 0.5, &mut y);
            let exact = exact_middle(lambda, theta);
            println!(
                "{lambda:5.1}   {branch:6} {:16.10} {exact:16.10} {:11} {:14}",
                y[0],
                solution.mesh(0).len() - 1,
                solution.stats().newton_steps
            );
            assert!((y[0] - exact).abs() < 1e-8);
        }
    }
    // Beyond the fold there is nothing to find, and the solver says so.
    let error = from_arch(4.0, 0.2).expect_err("no solution exists");
    println!("\nλ = 4: {error}");
    Ok(())
}
