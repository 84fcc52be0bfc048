//! Conditions on integrals.

use bvp::{Ends, Function, Options, Problem, Real, Segment, solve};
use proptest::prelude::*;

/// A chain of length ℓ over a span of 1: y″ = μ √(1 + y′²) with unknown μ, y(0) = y(1) = 0, and the
/// running length as the third state. ℓ = sinh(μ/2)/(μ/2).
struct Chain {
    length: f64,
}

impl Problem for Chain {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(3)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        let stretch = (y[1] * y[1] + 1.0).sqrt();
        dy[0] = y[1];
        dy[1] = p[0] * stretch;
        dy[2] = stretch;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.start(0)[2];
        r[2] = at.end(0)[0];
        r[3] = at.end(0)[2] - self.length;
    }
}

proptest! {
    #[test]
    fn a_chain_of_given_length_hangs_as_a_catenary(mu in 0.5..6.0f64) {
        let length = (0.5 * mu).sinh() / (0.5 * mu);
        let guess = Function {
            state: |_: usize, s: f64| [2.0 * s * (s - 1.0), 4.0 * s - 2.0, length * s],
            parameters: vec![2.0],
        };
        let solution = solve(&Chain { length }, &guess, &Options::to(1e-10)).unwrap();
        prop_assert!((solution.parameters()[0] - mu).abs() < 2e-10 * (1.0 + mu));
        let mut y = [0.0; 3];
        solution.state(0, 0.5, &mut y);
        let sag = (1.0 - (0.5 * mu).cosh()) / mu;
        prop_assert!((y[0] - sag).abs() < 2e-10 * (1.0 - sag));
    }
}
