//! Lengths and states in units far from one.

use super::Score;
use bvp::{Constant, Ends, Options, Problem, Real, Segment, solve};

/// y'' = y / (0.01 L)² on \[0, L\], y(0) = Y, y(L) = Y / 2.
struct Layers {
    length: f64,
    value: f64,
}

impl Problem for Layers {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, 0.0, self.length)]
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = y[0] / (0.01 * self.length).powi(2);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] - self.value;
        r[1] = at.end(0)[0] - 0.5 * self.value;
    }
}

#[test]
fn layers_are_solved_in_any_unit_of_length() {
    for exponent in [-12, -10, -6, -3, 0, 3, 6, 8] {
        for value in [1.0, 1e8] {
            let length = 10f64.powi(exponent);
            let problem = Layers { length, value };
            for tolerance in [1e-3, 1e-6, 1e-9] {
                let guess = Constant {
                    states: vec![vec![0.0; 2]],
                    parameters: vec![],
                };
                let solution = solve(&problem, &guess, &Options::to(tolerance))
                    .unwrap_or_else(|error| panic!("{length:e} {value:e} {tolerance:e}: {error}"));
                let slope = solution.start(0)[1];
                let error = (slope / (-100.0 * value / length) - 1.0).abs();
                assert!(
                    error <= 10.0 * tolerance || slope.abs() < 1e-2,
                    "{length:e}: {error:e}"
                );
                let exact = |s: f64| {
                    let x = s / length;
                    value * ((-100.0 * x).exp() + 0.5 * (100.0 * (x - 1.0)).exp())
                };
                let name = format!("{length:e} {value:e}");
                Score::default().count(&name, tolerance, Ok(solution), exact);
            }
        }
    }
}
