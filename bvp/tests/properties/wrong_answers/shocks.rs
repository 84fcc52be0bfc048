//! Shocks whose place is exponentially ill determined.

use super::Score;
use bvp::{Ends, Function, Options, Problem, Real, Segment, solve};

/// ε y'' = y y', y(0) = 1, y(1) = −1.
struct Shock {
    epsilon: f64,
}

impl Problem for Shock {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2)]
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = y[0] * y[1] / self.epsilon;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] - 1.0;
        r[1] = at.end(0)[0] + 1.0;
    }
}

/// −a tanh(a (s − ½) / 2ε) with a tanh(a / 4ε) = 1.
fn exact(epsilon: f64) -> impl Fn(f64) -> f64 {
    let a = (0..200).fold(1.0f64, |a, _| 1.0 / (a / (4.0 * epsilon)).tanh());
    move |s: f64| -a * (a * (s - 0.5) / (2.0 * epsilon)).tanh()
}

#[test]
fn a_shock_is_where_it_belongs_or_refused() {
    let mut score = Score::default();
    let guesses = [[1.0, -2.0], [0.3, 0.0], [-0.5, 0.0], [0.0, 0.0]];
    for i in 0..23 {
        let epsilon = 0.2 * 0.005_f64.powf(f64::from(i) / 22.0);
        for tolerance in [1e-2, 1e-3, 1e-5, 1e-6, 1e-9] {
            for [value, slope] in guesses {
                let guess = Function {
                    state: |_: usize, s: f64| [value + slope * s, slope],
                    parameters: vec![],
                };
                let outcome = solve(&Shock { epsilon }, &guess, &Options::to(tolerance));
                score.count(&format!("{epsilon}"), tolerance, outcome, exact(epsilon));
            }
        }
    }
    // Where the slopes at the ends, e^(−1/2ε), are not lost in rounding, all are solved.
    assert!(score.solved > 180, "{score:?}");
}
