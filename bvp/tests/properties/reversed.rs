//! Segments along which s descends: the solution is that of the segment the other way round.

use bvp::{
    Constant, Control, Ends, FiniteDifferences, Function, LeftOf, Options, Problem, Real, Segment,
    Solution, Table, check_jacobians, solve,
};
use proptest::prelude::*;

/// y₀' = y₁, y₁' = p y₀ with y₀(0) = 0, y₁(0) = 1 and y₀(1) = sinh(2)/2: p = 4, and y₀ = sinh(2 s)/2. The
/// exact slopes at s tell a sign that is wrong.
struct Growth {
    reversed: bool,
    joined: Vec<f64>,
}

impl Problem for Growth {
    fn segments(&self) -> Vec<Segment> {
        let segment = match self.reversed {
            true => Segment::on(2, 1.0, 0.0),
            false => Segment::on(2, 0.0, 1.0),
        };
        vec![segment.joined(&self.joined)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = p[0] * y[0];
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T])
    where
        f64: LeftOf<T>,
    {
        let (zero, one) = match self.reversed {
            true => (at.end(0), at.start(0)),
            false => (at.start(0), at.end(0)),
        };
        r[0] = zero[0];
        r[1] = 1.0 - zero[1];
        r[2] = one[0] - 0.5 * 2f64.sinh();
    }
}

fn guess() -> Function<impl Fn(usize, f64) -> [f64; 2]> {
    Function {
        state: |_: usize, s: f64| [s, 1.0],
        parameters: vec![1.0],
    }
}

fn largest_error(solution: &Solution) -> f64 {
    let (mut y, mut slope) = ([0.0; 2], [0.0; 2]);
    let mut largest: f64 = (solution.parameters()[0] - 4.0).abs() / 5.0;
    for i in 0..=100 {
        let s = 0.01 * f64::from(i);
        solution.state(0, s, &mut y);
        solution.derivative(0, s, &mut slope);
        let (sinh, cosh) = (0.5 * (2.0 * s).sinh(), (2.0 * s).cosh());
        for (found, exact) in [(y[0], sinh), (y[1], cosh)] {
            largest = largest.max((found - exact).abs() / (1.0 + exact));
        }
        assert!((slope[0] - cosh).abs() < 1e-4 && (slope[1] - 4.0 * sinh).abs() < 1e-4);
    }
    largest
}

proptest! {
    #[test]
    fn a_reversed_segment_has_the_solution_of_the_other_way(
        exponent in 5..11i32,
        control in prop_oneof![Just(Control::Error), Just(Control::Defect), Just(Control::Both)],
        joined in prop_oneof![Just(vec![]), Just(vec![0.9, 0.4]), Just(vec![0.5])],
    ) {
        let tolerance = 10f64.powi(-exponent);
        let options = Options { control, ..Options::to(tolerance) };
        let reversed = Growth { reversed: true, joined: joined.clone() };
        let forward = Growth { reversed: false, joined: joined.into_iter().rev().collect() };
        let found = solve(&reversed, &guess(), &options).unwrap();
        let other = solve(&forward, &guess(), &options).unwrap();
        prop_assert!(largest_error(&found) <= tolerance, "{}", largest_error(&found));
        let descending: Vec<f64> = other.mesh(0).iter().rev().copied().collect();
        prop_assert!(found.mesh(0).windows(2).all(|pair| pair[0] > pair[1]));
        prop_assert_eq!((found.mesh(0)[0], found.mesh(0).last()), (1.0, Some(&0.0)));
        prop_assert!(found.mesh(0).len().abs_diff(descending.len()) <= 1);
        prop_assert_eq!(found.start(0)[0], found.node(0, 0)[0]);
        prop_assert!((found.start(0)[1] - 2f64.cosh()).abs() < 10.0 * tolerance);
        prop_assert!((found.end(0)[1] - 1.0).abs() < 10.0 * tolerance);
    }
}

#[test]
fn solutions_and_descending_tables_are_guesses_of_a_reversed_segment() {
    let problem = Growth {
        reversed: true,
        joined: vec![],
    };
    let options = Options::to(1e-8);
    let solution = solve(&problem, &guess(), &options).unwrap();
    let again = solve(&problem, &solution, &options).unwrap();
    assert_eq!((again.stats().meshes, again.mesh(0)), (1, solution.mesh(0)));
    let nodes: Vec<f64> = (0..=5).rev().map(|i| 0.2 * f64::from(i)).collect();
    let table = Table {
        states: vec![nodes.iter().flat_map(|s| [*s, 1.0]).collect()],
        nodes: vec![nodes.clone()],
        parameters: vec![2.0],
    };
    assert!(largest_error(&solve(&problem, &table, &options).unwrap()) < 1e-8);
    let ascending = Table {
        nodes: vec![nodes.into_iter().rev().collect()],
        ..table
    };
    let error = solve(&problem, &ascending, &options).unwrap_err();
    assert!(matches!(error, bvp::Error::GuessMesh { segment: 0, .. }));
    let kappa = |problem: &Growth, solution: &Solution| solution.conditioning(problem).unwrap();
    let forward = Growth {
        reversed: false,
        joined: vec![],
    };
    let other = solve(&forward, &guess(), &options).unwrap();
    let [a, b] = [kappa(&problem, &solution), kappa(&forward, &other)];
    assert!((a.kappa / b.kappa - 1.0).abs() < 0.05, "{a:?} {b:?}");
}

/// A layer of the forward direction at s = 0: dy/ds = −1000 (y − cos s), y(0) = 2 at the end of a
/// reversed segment.
#[test]
fn a_layer_at_the_end_of_a_reversed_segment_is_resolved() {
    let rate = 1000.0;
    let equations = FiniteDifferences {
        segments: vec![Segment::on(1, 2.0, 0.0)],
        parameters: 0,
        condition_count: 1,
        rhs: |_: usize, s: f64, y: &[f64], _p: &[f64], dy: &mut [f64]| {
            dy[0] = -rate * (y[0] - s.cos());
        },
        conditions: |at: Ends<'_, f64>, _p: &[f64], r: &mut [f64]| r[0] = at.end(0)[0] - 2.0,
    };
    let guess = Constant {
        states: vec![vec![0.0]],
        parameters: vec![],
    };
    let check = check_jacobians(&equations, &FiniteDifferences::of(&equations), &guess);
    assert!(check.difference < 1e-6);
    let solution = solve(&equations, &guess, &Options::to(1e-8)).unwrap();
    let particular = |s: f64| rate * (rate * s.cos() + s.sin()) / (1.0 + rate * rate);
    let mut y = [0.0];
    for i in 0..=1000 {
        let s = 2.0 * (1e-3 * f64::from(i)).powi(4);
        solution.state(0, s, &mut y);
        let exact = particular(s) + (2.0 - particular(0.0)) * (-rate * s).exp();
        assert!((y[0] - exact).abs() < 1e-7, "{s}: {} {exact}", y[0]);
    }
}
