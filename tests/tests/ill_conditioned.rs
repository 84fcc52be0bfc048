//! A problem whose solution rounding errors hide: what the solver claims of it must still be right.

use bvp::{Constant, Ends, Error, Options, Problem, Real, Segment, Solution, solve};
use reference_problems::{FALSE_FROM, TOLERANCES};

/// ε y″ = x y′ − y, y(−1) = 1, y(1) = 2: number 35 of the test set of Cash, Wright and Mazzia.
///
/// The solution is x/2 but for layers of width ε at both ends; y′(0) = 1/2 for every ε. A multiple of
/// x is a solution that the conditions fix only through the layers: it changes by exp(1/(2 ε)) times as
/// much as they do, 1e22 for ε = 0.01.
struct TwoLayers {
    eps: f64,
}

impl Problem for TwoLayers {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, -1.0, 1.0)]
    }

    fn rhs<T: Real>(&self, _: usize, x: T, y: &[T], _: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = (x * y[1] - y[0]) / self.eps;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] - 1.0;
        r[1] = at.end(0)[0] - 2.0;
    }
}

/// Solves it from zero.
fn attempt(eps: f64, tolerance: f64) -> Result<Solution, Error> {
    let guess = Constant {
        states: vec![vec![0.0; 2]],
        parameters: vec![],
    };
    let options = Options {
        tolerance,
        ..Options::default()
    };
    solve(&TwoLayers { eps }, &guess, &options)
}

/// The error of the slope in the middle relative to 1 + 1/2.
fn slope_error(solution: &Solution) -> f64 {
    let mut y = [f64::NAN; 2];
    solution.state(0, 0.0, &mut y);
    (y[1] - 0.5).abs() / 1.5
}

#[test]
fn thick_layers_are_solved() {
    for tolerance in TOLERANCES {
        let solution = attempt(0.1, tolerance).expect("a well-conditioned problem");
        assert!(slope_error(&solution) <= tolerance, "at {tolerance:e}");
    }
}

#[test]
fn thin_layers_are_solved_or_refused_as_ill_conditioned() {
    let mut complaints = Vec::new();
    for eps in [2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 1e-4, 1e-6] {
        for tolerance in TOLERANCES {
            let text = match attempt(eps, tolerance) {
                Ok(solution) => {
                    let (error, estimate) = (slope_error(&solution), solution.error_estimate());
                    let text = format!("true error {error:.1e}, estimate {estimate:.1?}");
                    if error > FALSE_FROM * tolerance {
                        complaints.push(format!("{eps:e} at {tolerance:e}: {text}"));
                    }
                    text
                }
                Err(error) => {
                    let text = error.to_string();
                    if !matches!(error, Error::IllConditioned { .. }) {
                        complaints.push(format!("{eps:e} at {tolerance:e}: {text}"));
                    }
                    text
                }
            };
            println!("{eps:e} at {tolerance:e}: {text}");
        }
    }
    assert!(complaints.is_empty(), "{complaints:#?}");
}
