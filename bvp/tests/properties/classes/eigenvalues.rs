//! Eigenvalues by their number.

use bvp::{Ends, Function, Options, Problem, Real, Segment, Solution, solve};
use proptest::prelude::*;
use std::f64::consts::PI;

/// −y″ + q y = λ y with q = c₁ exp(s) + c₂ cos(s), y(0) = y(π) = 0, by the angle of Prüfer,
/// tan θ = n y/y′: θ(0) = 0 and θ(π) = n π for the eigenvalue number n = 1, 2, …
struct Pruefer {
    c: [f64; 2],
    n: f64,
}

fn potential<T: Real>(c: [f64; 2], s: T) -> T {
    s.exp() * c[0] + s.cos() * c[1]
}

impl Problem for Pruefer {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(1, 0.0, PI)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, s: T, y: &[T], p: &[T], dy: &mut [T]) {
        let (sin, cos) = y[0].sin_cos();
        dy[0] = cos * cos * self.n + (p[0] - potential(self.c, s)) / self.n * sin * sin;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0] - self.n * PI;
    }
}

fn pruefer(c: [f64; 2], n: f64) -> Solution {
    let guess = Function {
        state: |_: usize, s: f64| [n * s],
        parameters: vec![n * n + c[0] * (PI.exp() - 1.0) / PI],
    };
    solve(&Pruefer { c, n }, &guess, &Options::to(1e-9)).unwrap()
}

/// The same in the states y and y′, with y′(0) = n.
struct SturmLiouville {
    c: [f64; 2],
    n: f64,
}

impl Problem for SturmLiouville {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, 0.0, PI)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = (potential(self.c, s) - p[0]) * y[0];
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.start(0)[1] - self.n;
        r[2] = at.end(0)[0];
    }
}

#[test]
fn eigenvalues_of_paine_by_their_number() {
    // J. W. Paine, F. R. de Hoog & R. S. Anderssen, Computing 26 (1981) 123-139, q = exp(s).
    let published = [4.896_669_4, 10.045_190, 16.019_267, 23.266_271, 32.263_707];
    for (n, published) in (1..).zip(published) {
        let found = pruefer([1.0, 0.0], f64::from(n)).parameters()[0];
        assert!((found - published).abs() < 6e-7, "{n}: {found}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn the_angle_counts_the_zeros(c in [0.0..0.5f64, -2.0..2.0f64], n in 1..7u32) {
        let angle = pruefer(c, f64::from(n));
        let problem = SturmLiouville { c, n: f64::from(n) };
        let guess = Function {
            state: |_: usize, s: f64| {
let mut theta = [0.0];
                angle.state(0, s, &mut theta);
                let (sin, cos) = theta[0].sin_cos();
[sin, problem.n * cos]
},
            parameters: angle.parameters().to_vec(),
        };
        let solution = solve(&problem, &guess, &Options::to(1e-9)).unwrap();
        let lambda = solution.parameters()[0];
        let difference = (lambda - angle.parameters()[0]).abs();
        prop_assert!(difference < 4e-9 * (1.0 + lambda.abs()), "{difference:e}");
        let at = |i: u32| {
            let mut y = [0.0; 2];
            solution.state(0, PI * f64::from(i) / 1000.0, &mut y);
            y[0]
        };
        let zeros = (1..999).filter(|&i| at(i) * at(i + 1) < 0.0).count();
        prop_assert_eq!(zeros, n as usize - 1);
    }
}
