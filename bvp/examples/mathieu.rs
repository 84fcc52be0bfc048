//! Eigenvalues followed from a known case: Mathieu's equation of a parametrically driven swing,
//!
//! ```text
//! y'' + (a − 2q cos 2s) y = 0,   y'(0) = y'(π) = 0,   y(0) = 1
//! ```
//!
//! For q = 0 the solutions are cos js with a = j². Each solution is the guess of the next q, and
//! brings its mesh with it. The values for q = 5 are those of Abramowitz & Stegun, *Handbook of
//! Mathematical Functions* (1964), table 20.1.
//!
//! Run with `cargo run -p bvp --example mathieu`.

use bvp::{Ends, Error, Function, LeftOf, Options, Problem, Real, Segment, Solution, solve};
use std::f64::consts::PI;

/// States y and y'; the characteristic value a is an unknown parameter, so there are three
/// conditions.
struct Mathieu {
    q: f64,
}

impl Problem for Mathieu {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, 0.0, PI)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _segment: usize, s: T, y: &[T], p: &[T], dy: &mut [T])
    where
        f64: LeftOf<T>,
    {
        dy[0] = y[1];
        dy[1] = -(p[0] - 2.0 * self.q * (2.0 * s).cos()) * y[0];
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[1];
        r[1] = at.end(0)[1];
        r[2] = at.start(0)[0] - 1.0;
    }
}

/// The even solution with j half waves, at q = 5 in steps of ½.
fn follow(j: f64) -> Result<Solution, Error> {
    let options = Options {
        tolerance: 1e-9,
        ..Options::default()
    };
    let cosine = Function {
        state: |_segment: usize, s: f64| [(j * s).cos(), -j * (j * s).sin()],
        parameters: vec![j * j],
    };
    let mut solution = solve(&Mathieu { q: 0.0 }, &cosine, &options)?;
    for step in 1..=10 {
        let q = 0.5 * f64::from(step);
        solution = solve(&Mathieu { q }, &solution, &options)?;
    }
    Ok(solution)
}

fn main() -> Result<(), Error> {
    println!(" j      a(q = 5)       tabulated   estimated error   intervals");
    let tabulated = [
        (0, -5.800_046_02),
        (1, 1.858_187_54),
        (2, 7.449_109_74),
        (5, 25.549_971_75),
    ];
    for (j, exact) in tabulated {
        let solution = follow(f64::from(j))?;
        let a = solution.parameters()[0];
        let error = solution.error_estimate().unwrap_or(f64::NAN);
        let intervals = solution.mesh(0).len() - 1;
        println!("{j:2} {a:14.8} {exact:15.8} {error:17.1e} {intervals:11}");
        assert!((a - exact).abs() < 6e-9);
    }
    Ok(())
}
