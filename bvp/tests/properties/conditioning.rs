//! Conditioning constants are those of the closed form, and what rounding hides is refused.

use crate::exact::{bratu, exponential, limit_cycle, swing, three_point, wavenumber};
use crate::failures::{growth, states};
use bvp::{
    Conditioning, Constant, Control, Ends, Equations, Error, Options, Problem, Real, Segment,
    Solution, solve,
};
use std::f64::consts::PI;

/// y″ = c y, y(0) = 0, y(length) = 1.
struct Linear {
    c: f64,
    segments: [Segment; 1],
}

impl Linear {
    fn new(c: f64, length: f64) -> Self {
        let segments = [Segment::on(2, 0.0, length)];
        Self { c, segments }
    }
}

impl Problem for Linear {
    fn segments(&self) -> Vec<Segment> {
        self.segments.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = y[0] * self.c;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0] - 1.0;
    }
}

/// ε y″ = x y′ − y, y(−1) = 1, y(1) = 2: a multiple of x is a solution that the conditions fix through
/// layers only, exp(1/(2 ε)) times as much as they are changed.
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

/// Of a linear problem on equal intervals, short enough for the trapezoidal rule of γ₁ and to be kept
/// at this tolerance.
fn on_a_fine_mesh(equations: &dyn Equations) -> Conditioning {
    let options = Options {
        tolerance: 1e-2,
        initial_intervals: 256,
        control: Control::Defect,
        ..Options::default()
    };
    let shape = equations.shape();
    let guess = Constant {
        parameters: vec![0.0; shape.parameters],
        ..states(&vec![0.0; shape.segments[0].states])
    };
    let solution = solve(equations, &guess, &options).unwrap();
    solution.conditioning(equations).unwrap()
}

/// Compares κ, κ₁, κ₂, γ₁ and σ.
fn assert_near(found: Conditioning, expected: [f64; 5], accuracy: f64) {
    let names = ["κ", "κ₁", "κ₂", "γ₁", "σ"];
    let Conditioning {
        kappa,
        kappa1,
        kappa2,
        gamma1,
        sigma,
        ..
    } = found;
    let found = [kappa, kappa1, kappa2, gamma1, sigma];
    for ((found, expected), name) in found.iter().zip(expected).zip(names) {
        let error = (found / expected - 1.0).abs();
        assert!(error < accuracy, "{name}: {found} for {expected}");
    }
}

#[test]
fn an_initial_value_problem_that_grows() {
    // y' = 5 y on [0, 1]: Y Q⁻¹ = exp(5 s), G = exp(5 (s − t)) for t < s.
    let mut problem = growth();
    problem.rhs = |_, _, y, _, dy| dy[0] = 5.0 * y[0];
    let first = 5f64.exp();
    let (second, mean) = ((first - 1.0) / 5.0, (first - 1.0) / 5.0);
    let expected = [first + second, first, second, mean, first / mean];
    assert_near(on_a_fine_mesh(&problem), expected, 1e-4);
}

#[test]
fn values_at_both_ends() {
    // The norm of Y Q⁻¹ is that of its second row, (cosh s + cosh(4 − s)) / sinh 4; that of G
    // is largest at the ends too, 1 + (cosh 4 − 1) / sinh 4.
    let (first, mean) = (1.0 / 2f64.tanh(), 0.5);
    let second = 1.0 + 2f64.tanh();
    let expected = [first + second, first, second, mean, first / mean];
    assert_near(on_a_fine_mesh(&Linear::new(1.0, 4.0)), expected, 1e-4);
}

#[test]
fn a_parameter_is_a_constant_state() {
    // y' = p, y(0) = 0, y(1) = 1: p = β₁ − β₀ − ∫ q at every s, and y no larger.
    let mut problem = growth();
    (problem.parameters, problem.condition_count) = (1, 2);
    problem.rhs = |_, _, _, p, dy| dy[0] = p[0];
    problem.conditions = |at, _, r| {
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0] - 1.0;
    };
    assert_near(on_a_fine_mesh(&problem), [3.0, 2.0, 1.0, 2.0, 1.0], 1e-6);
}

#[test]
fn segments_are_seen_as_one() {
    // y = β₀ + ∫ q on [0, 1], and on [1, 3] with β₁ more.
    let mut problem = growth();
    problem.segments = vec![Segment::new(1), Segment::on(1, 1.0, 3.0)];
    problem.condition_count = 2;
    problem.rhs = |_, _, _, _, dy| dy[0] = 0.0;
    problem.conditions = |at, _, r| {
        r[0] = at.start(0)[0] - 1.0;
        r[1] = at.start(1)[0] - at.end(0)[0];
    };
    let expected = [5.0, 2.0, 3.0, 5.0 / 3.0, 6.0 / 5.0];
    assert_near(on_a_fine_mesh(&problem), expected, 1e-6);
}

#[test]
fn layers_are_stiff_and_well_conditioned() {
    // y″ = w² y: the slope has κ₁ = w in layers of width 1/w at both ends, and the mean 2.
    for w in [10.0, 100.0] {
        let found = on_a_fine_mesh(&Linear::new(w * w, 1.0));
        let first = w / (0.5 * w).tanh();
        assert!((found.kappa1 / first - 1.0).abs() < 1e-6, "{found:?}");
        assert!(
            (found.sigma / (0.5 * first) - 1.0).abs() < 0.02,
            "{found:?}"
        );
        assert!(found.rounding < 1e-13, "{found:?}");
    }
}

/// y″ + (1 + δ)² y = 0 on [0, π], next to an eigenvalue.
fn near_the_eigenvalue(delta: f64) -> Linear {
    Linear::new(-(1.0 + delta).powi(2), PI)
}

#[test]
fn near_an_eigenvalue_everything_grows_as_the_inverse_distance() {
    for delta in [1e-2, 1e-4, 1e-6] {
        let found = on_a_fine_mesh(&near_the_eigenvalue(delta));
        // (1 + |cos(π + πδ)|) / sin(πδ).
        let first = 2.0 / (PI * delta);
        assert!((found.kappa1 / first - 1.0).abs() < 0.02, "{found:?}");
        // (∫ |sin| + ∫ |cos|) / sin(πδ).
        let second = 4.0 / (PI * delta);
        assert!((found.kappa2 / second - 1.0).abs() < 0.02, "{found:?}");
    }
}

fn from_zero(equations: &dyn Equations, tolerance: f64) -> Result<Solution, Error> {
    let options = Options {
        tolerance,
        ..Options::default()
    };
    solve(equations, &states(&[0.0, 0.0]), &options)
}

/// The rounding of a refusal as ill-conditioned and its text.
fn refusal(outcome: Result<Solution, Error>, asked: f64) -> f64 {
    let error = outcome.unwrap_err();
    let Error::IllConditioned {
        rounding,
        condition,
        tolerance,
        ..
    } = error
    else {
        panic!("{error}")
    };
    assert_eq!(tolerance, asked);
    assert!((condition / (rounding / f64::EPSILON) - 2.0).abs() < 1e-12);
    let text = error.to_string();
    // A number of which no digit is known is not printed.
    let start = match rounding < 1.0 {
        true => format!("ill-conditioned: rounding errors change the solution by {rounding:.1e}"),
        false => "ill-conditioned: rounding errors leave no digit of the solution,".to_owned(),
    };
    assert!(text.starts_with(&start), "{text}");
    let best = error.best().expect("an iterate");
    assert!(best.start(0).iter().all(|y| y.is_finite()));
    rounding
}

#[test]
fn an_eigenvalue_too_near_is_refused() {
    for (delta, tolerance) in [(1e-6, 1e-6), (1e-9, 1e-3)] {
        let solution = from_zero(&near_the_eigenvalue(delta), tolerance).unwrap();
        // y = sin((1 + δ) s) / sin((1 + δ) π).
        let exact = ((1.0 + delta) * PI / 2.0).sin() / ((1.0 + delta) * PI).sin();
        let mut y = [f64::NAN; 2];
        solution.state(0, PI / 2.0, &mut y);
        assert!((y[0] / exact - 1.0).abs() < tolerance, "{delta:e}: {y:?}");
    }
    for (delta, tolerance) in [(1e-12, 1e-6), (1e-15, 1e-3)] {
        let rounding = refusal(from_zero(&near_the_eigenvalue(delta), tolerance), tolerance);
        // A sin((1 + δ) π) wrong by one unit roundoff u changes the amplitude by u/(πδ) of it; the signs of
        // what is rounded are random.
        assert!(
            rounding * PI * delta > f64::EPSILON / 200.0,
            "{delta:e}: {rounding:e}"
        );
    }
}

#[test]
fn a_solution_fixed_through_layers_is_refused_when_they_are_thin() {
    for tolerance in [1e-3, 1e-6] {
        let solution = from_zero(&TwoLayers { eps: 0.1 }, tolerance).unwrap();
        let mut y = [f64::NAN; 2];
        solution.state(0, 0.0, &mut y);
        assert!((y[1] - 0.5).abs() < tolerance);
    }
    // Where Newton's method ends at a solution of the rounded equations, and where it does not end.
    for (eps, tolerance) in [(1e-2, 1e-3), (1e-4, 1e-3), (1e-4, 1e-6), (1e-6, 1e-3)] {
        let rounding = refusal(from_zero(&TwoLayers { eps }, tolerance), tolerance);
        assert!(rounding > tolerance, "{eps:e}: {rounding:e}");
    }
}

#[test]
fn rounding_is_refused_from_a_neighbour_too() {
    let near = from_zero(&near_the_eigenvalue(1e-6), 1e-6).unwrap();
    let thick = from_zero(&TwoLayers { eps: 0.018 }, 1e-6).unwrap();
    for (equations, guess, tolerance) in [
        (&near_the_eigenvalue(1e-12) as &dyn Equations, &near, 1e-6),
        (&TwoLayers { eps: 0.016 }, &thick, 1e-6),
    ] {
        let options = Options {
            tolerance,
            from_neighbour: true,
            ..Options::default()
        };
        let rounding = refusal(solve(equations, guess, &options), tolerance);
        assert!(rounding > 1e-3 * tolerance, "{rounding:e}");
    }
}

#[test]
fn a_known_solution_of_a_well_conditioned_problem_is_found_again() {
    let problems = [
        exponential(50.0),
        bratu(1.5),
        wavenumber(3.0),
        limit_cycle(2.0),
        three_point(5.0 * PI),
        swing(1.0),
    ];
    for problem in &problems {
        let solution = solve(&*problem.equations, problem, &Options::default()).unwrap();
        let found = solution.conditioning(&*problem.equations).unwrap();
        assert!(found.rounding < 1e-13, "{}: {found:?}", problem.name);
        assert!(found.kappa >= found.kappa1.max(found.kappa2), "{found:?}");
    }
}

#[test]
fn a_solution_of_other_equations_is_refused() {
    let solution = from_zero(&Linear::new(1.0, 1.0), 1e-6).unwrap();
    let error = solution.conditioning(&growth()).unwrap_err();
    assert!(matches!(error, Error::GuessStates { segment: 0, .. }));
    let error = solution.conditioning(&Linear::new(1.0, 2.0)).unwrap_err();
    assert!(matches!(error, Error::GuessMesh { segment: 0, .. }));
}
