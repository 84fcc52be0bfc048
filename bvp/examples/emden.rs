//! A singular coefficient at an end: the temperature of a star after Lane and Emden, with exponent 5,
//!
//! ```text
//! y″ + (2/x) y′ + y⁵ = 0,   y′(0) = 0,   y(1) = √3/2
//! ```
//!
//! whose solution is y = 1/√(1 + x²/3). The term (2/x) y′ is written as it stands: the points of
//! Gauss lie inside the intervals, so the right-hand side is never evaluated at x = 0. What keeps the
//! solution finite there, y′(0) = 0, is one of the conditions. In general the singular term S y/x is
//! harmless together with the condition S y(0) = 0, and y′(0) = (I − S)⁻¹ g with the rest g of the
//! right-hand side; here y″(0) = −1/3, which the continuous solution gives too.
//!
//! A scheme with points at the ends of the intervals needs that limit: write it where s is zero.
//!
//! Run with `cargo run -p bvp --example emden`.

use bvp::{Constant, Ends, Error, LeftOf, Options, Problem, Real, Segment, solve};

/// States y and y′.
struct Emden;

impl Problem for Emden {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2)]
    }

    fn rhs<T: Real>(&self, _segment: usize, x: T, y: &[T], _p: &[T], dy: &mut [T])
    where
        f64: LeftOf<T>,
    {
        dy[0] = y[1];
        dy[1] = -2.0 / x * y[1] - y[0].powi(5);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[1];
        r[1] = at.end(0)[0] - 0.75f64.sqrt();
    }
}

fn main() -> Result<(), Error> {
    let guess = Constant {
        states: vec![vec![0.75f64.sqrt(), 0.0]],
        parameters: vec![],
    };
    println!("tolerance   intervals   estimated error   true error      y″(0)");
    for tolerance in [1e-3, 1e-6, 1e-9, 1e-12] {
        let solution = solve(&Emden, &guess, &Options::to(tolerance))?;
        let (mut y, mut slope) = ([0.0; 2], [0.0; 2]);
        let mut error = 0.0f64;
        for i in 0..=1000 {
            let x = 0.001 * f64::from(i);
            solution.state(0, x, &mut y);
            error = error.max((y[0] - 1.0 / (1.0 + x * x / 3.0).sqrt()).abs());
        }
        solution.derivative(0, 0.0, &mut slope);
        println!(
            "{tolerance:9.0e} {:11} {:17.1e} {error:12.1e} {:14.10}",
            solution.mesh(0).len() - 1,
            solution.error_estimate().unwrap_or(f64::NAN),
            slope[1]
        );
        assert!(error < tolerance);
        // The derivative of the polynomials is less accurate than they are, and no tolerance bounds it.
        assert!((slope[1] + 1.0 / 3.0).abs() < 10.0 * tolerance.max(1e-10));
    }
    Ok(())
}
