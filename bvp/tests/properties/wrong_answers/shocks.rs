//! Shocks whose place is exponentially ill determined.

use super::{Score, place};
use bvp::{Ends, Function, Options, Problem, Real, Segment, TwoPoint, solve};
use std::f64::consts::SQRT_2;

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

/// ε² y'' = y³ − y with y' = 0 at the ends: all solutions are symmetric or antisymmetric about the middle.
struct Interface {
    epsilon: f64,
}

impl Problem for Interface {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2)]
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = (y[0].powi(3) - y[0]) / self.epsilon.powi(2);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[1];
        r[1] = at.end(0)[1];
    }
}

/// tanh((s − a) / √2 w) and its derivative, a solution for w = ε of ε² y'' = y³ − y.
fn interface(at: f64, width: f64, s: f64) -> [f64; 2] {
    let rate = 1.0 / (SQRT_2 * width);
    let tanh = (rate * (s - at)).tanh();
    [tanh, rate * (1.0 - tanh * tanh)]
}

#[test]
fn an_interface_that_the_ends_hardly_feel_is_in_the_middle_or_refused() {
    for i in 0..160 {
        let epsilon = 0.004 * 12f64.powf(f64::from(i) / 160.0);
        let (at, wide) = (0.15 + 0.7 * place(i), 0.6 + 2.0 * place(3 * i));
        let guess = Function {
            state: |_: usize, s: f64| interface(at, wide * epsilon, s),
            parameters: vec![],
        };
        let Ok(solution) = solve(&Interface { epsilon }, &guess, &Options::to(1e-3)) else {
            continue;
        };
        let mut y = [[0.0; 2]; 2];
        let mut asymmetry = [0.0f64; 2];
        for i in 0..=200 {
            let s = f64::from(i) / 400.0;
            solution.state(0, s, &mut y[0]);
            solution.state(0, 1.0 - s, &mut y[1]);
            for (asymmetry, sign) in asymmetry.iter_mut().zip([-1.0, 1.0]) {
                *asymmetry = asymmetry.max((y[0][0] + sign * y[1][0]).abs());
            }
        }
        let [even, odd] = asymmetry;
        assert!(even.min(odd) <= 2e-2, "{epsilon} from {at}: {even} {odd}");
    }
}

/// The values at the ends, that of the interface at 0.564, differ from −1 and 1 by less than rounding. A coarse mesh
/// holds an interface at places that depend on the mesh alone.
#[test]
fn an_interface_that_only_a_mesh_holds_is_refused() {
    let (epsilon, exact) = (0.004_235_184_622, 0.564_411_648);
    let ends = [0.0, 1.0].map(|s| interface(exact, epsilon, s)[0]);
    let problem = TwoPoint::new(
        [2, 0],
        [0.0, 1.0],
        move |_, y, _, dy| {
            dy[0] = y[1];
            dy[1] = (y[0].powi(3) - y[0]) / epsilon.powi(2);
        },
        move |a, b, _, r| {
            r[0] = a[0] - ends[0];
            r[1] = b[0] - ends[1];
        },
    );
    // Without a look at a halved mesh after a long way the third of these guesses leads to an accepted solution.
    for i in 15..19 {
        let (at, wide) = (0.1 + 0.8 * place(i), 0.5 + 2.5 * place(3 * i));
        let guess = Function {
            state: |_: usize, s: f64| interface(at, wide * epsilon, s),
            parameters: vec![],
        };
        let mut score = Score::default();
        let outcome = solve(&problem, &guess, &Options::to(1e-3));
        score.count(&format!("from {at}"), 1e-3, outcome, |s| {
            interface(exact, epsilon, s)[0]
        });
    }
}
