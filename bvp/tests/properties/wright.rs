//! S. J. Wright's unstable example from its statement to its solution.
//!
//! "A collection of problems for which Gaussian elimination with partial pivoting is unstable",
//! SIAM J. Sci. Comput. 14 (1993) 231-238.

use bvp::{Constant, Ends, Options, Problem, Real, Segment, solve};

/// y' = M y with eigenvalues 5/6 and −7/6 on 0 ≤ s ≤ 60, and y(0) + y(60) = (1, 0).
struct Wright;

impl Problem for Wright {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, 0.0, 60.0)]
    }

    fn rhs<T: Real>(&self, _: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1] - y[0] / 6.0;
        dy[1] = y[0] - y[1] / 6.0;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] + at.end(0)[0] - 1.0;
        r[1] = at.start(0)[1] + at.end(0)[1];
    }
}

#[test]
fn growing_and_decaying_modes_with_coupled_ends_keep_all_digits() {
    let guess = Constant {
        states: vec![vec![0.0; 2]],
        parameters: vec![],
    };
    let options = Options {
        tolerance: 1e-11,
        ..Options::default()
    };
    let solution = solve(&Wright, &guess, &options).unwrap();
    let mut y = [0.0; 2];
    for i in 0..=600 {
        let s = 0.1 * f64::from(i);
        let growing = 0.5 * (5.0 / 6.0 * (s - 60.0)).exp() / (1.0 + (-50f64).exp());
        let decaying = 0.5 * (-7.0 / 6.0 * s).exp() / (1.0 + (-70f64).exp());
        solution.state(0, s, &mut y);
        assert!((y[0] - growing - decaying).abs() < 1e-11, "s = {s}");
        assert!((y[1] - growing + decaying).abs() < 1e-11, "s = {s}");
    }
}
