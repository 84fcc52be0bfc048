//! Numerical failures: the variant, its numbers and the iterate it carries.

use crate::exact::exponential;
use bvp::{
    Constant, Control, Ends, Equations, Error, FiniteDifferences, Guess, Options, Scheme, Segment,
    Shape, solve,
};

pub(crate) type Rhs = fn(usize, f64, &[f64], &[f64], &mut [f64]);
pub(crate) type Conditions = fn(Ends<'_, f64>, &[f64], &mut [f64]);

/// y' = y on \[0, 1\] with y(0) = 1; the tests replace what they need.
pub(crate) fn growth() -> FiniteDifferences<Rhs, Conditions> {
    FiniteDifferences {
        segments: vec![Segment::new(1)],
        parameters: 0,
        condition_count: 1,
        rhs: |_, _, y, _, dy| dy[0] = y[0],
        conditions: |at, _, r| r[0] = at.start(0)[0] - 1.0,
    }
}

/// Constant states, the same on every segment.
pub(crate) fn states(states: &[f64]) -> Constant {
    Constant {
        states: vec![states.to_vec(); 2],
        parameters: vec![],
    }
}

/// A numerical failure: its iterate is finite and can be asked for everything.
pub(crate) fn numerical(equations: &dyn Equations, guess: &dyn Guess, options: &Options) -> Error {
    let error = solve(equations, guess, options).unwrap_err();
    let best = error.best().expect("an iterate");
    for (segment, shape) in equations.shape().segments.iter().enumerate() {
        let mut y = vec![0.0; shape.states];
        best.state(segment, 0.5 * (shape.from + shape.to), &mut y);
        assert!(y.iter().all(|y| y.is_finite()));
        assert_eq!(best.defects(segment).len(), best.mesh(segment).len() - 1);
    }
    error
}

#[test]
fn conditions_that_do_not_determine_the_solution() {
    let mut problem = growth();
    problem.segments = vec![Segment::new(2)];
    problem.condition_count = 2;
    problem.rhs = |_, _, y, _, dy| {
        dy[0] = y[1];
        dy[1] = y[0];
    };
    problem.conditions = |at, _, r| {
        r[0] = at.start(0)[0] - 1.0;
        r[1] = r[0];
    };
    let error = numerical(&problem, &states(&[1.0, 0.0]), &Options::default());
    assert!(matches!(error, Error::SingularConditions { .. }));
}

#[test]
fn stages_that_have_no_solution() {
    // The midpoint rule on y' = 4y with h = ½: M = 1 − 4h/2 = 0.
    let mut problem = growth();
    problem.rhs = |_, _, y, _, dy| dy[0] = 4.0 * y[0];
    let mut options = Options {
        scheme: Some(Scheme::Gauss { stages: 1 }),
        tolerance: 1e-2,
        initial_intervals: 2,
        max_intervals: 2,
        control: Control::Defect,
        ..Options::default()
    };
    // Central differences would miss the exact zero.
    let exact = exponential(4.0);
    let error = numerical(&*exact.equations, &states(&[1.0, 0.0]), &options);
    assert!(matches!(
        error,
        Error::SingularNode {
            segment: 0,
            node: 0,
            ..
        }
    ));
    // With room for a finer mesh it is no obstacle.
    options.max_intervals = 10_000;
    assert!(solve(&*exact.equations, &states(&[1.0, 0.0]), &options).is_ok());
    assert!(solve(&problem, &states(&[1.0]), &options).is_ok());
}

#[test]
fn values_that_are_not_finite() {
    let options = Options::default();
    let mut problem = growth();
    problem.rhs = |_, _, y, _, dy| dy[0] = y[0].ln();
    let error = numerical(&problem, &states(&[-1.0]), &options);
    let Error::NonFiniteRhs {
        segment: 0,
        s,
        component: 0,
        ..
    } = error
    else {
        panic!("{error}")
    };
    assert!(s > 0.0 && s < 0.025);

    problem = growth();
    problem.segments = vec![Segment::new(2)];
    problem.condition_count = 2;
    problem.rhs = |_, _, y, _, dy| dy[0] = y[1];
    problem.conditions = |at, _, r| r[..2].copy_from_slice(at.start(0));
    let error = numerical(&problem, &states(&[0.0; 2]), &options);
    assert!(matches!(error, Error::NonFiniteRhs { component: 1, .. }));

    problem.rhs = |_, _, y, _, dy| dy.copy_from_slice(y);
    problem.conditions = |at, _, r| r[0] = at.start(0)[0];
    let error = numerical(&problem, &states(&[0.0; 2]), &options);
    assert!(matches!(
        error,
        Error::NonFiniteCondition { condition: 1, .. }
    ));
}

#[test]
fn damping_leaves_the_domain_of_a_logarithm_alone() {
    // y' = y ln p, y(0) = 1, y(1) = 0.01: the first full step makes p negative.
    let mut problem = growth();
    problem.parameters = 1;
    problem.condition_count = 2;
    problem.rhs = |_, _, y, p, dy| dy[0] = y[0] * p[0].ln();
    problem.conditions = |at, _, r| {
        r[0] = at.start(0)[0] - 1.0;
        r[1] = at.end(0)[0] - 0.01;
    };
    let guess = Constant {
        states: vec![vec![1.0]],
        parameters: vec![3.0],
    };
    let solution = solve(&problem, &guess, &Options::default()).unwrap();
    assert!((solution.parameters()[0] - 0.01).abs() < 1e-8);
    // With no room to move at all the place is reported.
    problem.rhs = |_, _, y, p, dy| {
        let allowed = (p[0] - 3.0).abs() < 1e-9;
        dy[0] = if allowed { y[0] * p[0].ln() } else { f64::NAN };
    };
    let error = numerical(&problem, &guess, &Options::default());
    assert!(matches!(error, Error::NonFiniteRhs { component: 0, .. }));
}

#[test]
fn no_convergence_and_its_numbers() {
    // Bratu beyond its fold at λ = 3.51: no solution.
    let mut problem = growth();
    problem.segments = vec![Segment::new(2)];
    problem.condition_count = 2;
    problem.rhs = |_, _, y, _, dy| {
        dy[0] = y[1];
        dy[1] = -4.0 * y[0].exp();
    };
    problem.conditions = |at, _, r| {
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0];
    };
    let error = numerical(&problem, &states(&[0.0; 2]), &Options::default());
    let Error::NoConvergence {
        correction,
        steps,
        tolerance,
        ..
    } = error
    else {
        panic!("{error}")
    };
    assert!(correction > 1e-3 && steps > 0);
    // Corrections are to be this much smaller than the tolerance of the solution.
    assert!((tolerance / 3e-8 - 1.0).abs() < 1e-15);
}

/// y' = 1 / (10⁻⁸ + (s − ½)²): a bump far narrower than an interval.
pub(crate) fn bump() -> FiniteDifferences<Rhs, Conditions> {
    let mut problem = growth();
    problem.rhs = |_, s, _, _, dy| dy[0] = 1.0 / (1e-8 + (s - 0.5) * (s - 0.5));
    problem
}

#[test]
fn the_mesh_limit_and_its_numbers() {
    for control in [Control::Error, Control::Defect] {
        let options = Options {
            max_intervals: 20,
            control,
            ..Options::default()
        };
        let error = numerical(&bump(), &states(&[0.0]), &options);
        let Error::MeshLimit {
            needed,
            limit: 20,
            defect,
            error: estimate,
            tolerance: 1e-6,
            ref best,
            ..
        } = error
        else {
            panic!("{error}")
        };
        assert!(needed > 20 && defect > 1e-6 && estimate > 1e-6);
        assert_eq!(best.defect(), defect);
        assert_eq!(best.error_estimate().unwrap_or(f64::INFINITY), estimate);
    }
    assert!(solve(&bump(), &states(&[0.0]), &Options::default()).is_ok());
}

/// y' = y + 1, + 3 right of 1/√2.
pub(crate) fn jump() -> FiniteDifferences<Rhs, Conditions> {
    let mut problem = growth();
    problem.rhs = |_, s, y, _, dy| {
        dy[0] = y[0]
            + if s < std::f64::consts::FRAC_1_SQRT_2 {
                1.0
            } else {
                3.0
            };
    };
    problem
}

#[test]
fn a_jump_inside_a_segment_is_located_where_the_defect_is_to_be_small() {
    let place = std::f64::consts::FRAC_1_SQRT_2;
    // Points at both ends of every interval cannot overlook it.
    let options = Options {
        scheme: Some(Scheme::LobattoIIIA { stages: 3 }),
        control: Control::Defect,
        ..Options::default()
    };
    let error = numerical(&jump(), &states(&[1.0]), &options);
    let Error::Unresolved {
        segment: 0,
        s,
        length,
        meshes,
        defect,
        error: _,
        tolerance: 1e-6,
        ..
    } = error
    else {
        panic!("{error}")
    };
    assert!((s - place).abs() < 1e-12 && length < 1e-12, "{error}");
    assert!(meshes > 1 && defect > 1e-6);
}

/// y' = y, y(0) = 1 with a derivative of the condition far too large.
pub(crate) struct WrongJacobian;

impl Equations for WrongJacobian {
    fn shape(&self) -> Shape {
        Shape::new(vec![Segment::new(1)], 0)
    }

    fn evaluate_rhs(&self, _: usize, _s: f64, y: &[f64], _p: &[f64], dy: &mut [f64]) {
        dy[0] = y[0];
    }

    fn rhs_jacobian(
        &self,
        _: usize,
        _s: f64,
        y: &[f64],
        _p: &[f64],
        dy: &mut [f64],
        jacobian: &mut [f64],
    ) {
        dy[0] = y[0];
        jacobian[0] = 1.0;
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, _p: &[f64], r: &mut [f64]) {
        r[0] = at.start(0)[0] - 1.0;
    }

    fn conditions_jacobian(
        &self,
        at: Ends<'_, f64>,
        _p: &[f64],
        r: &mut [f64],
        jacobian: &mut [f64],
    ) {
        r[0] = at.start(0)[0] - 1.0;
        jacobian.copy_from_slice(&[1e12, 0.0]);
    }
}

#[test]
fn a_violated_condition_is_no_success() {
    let options = Options {
        control: Control::Defect,
        ..Options::default()
    };
    let error = numerical(&WrongJacobian, &states(&[0.0]), &options);
    let Error::ConditionViolated {
        condition: 0,
        residual,
        tolerance,
        ref best,
    } = error
    else {
        panic!("{error}")
    };
    assert!((residual - 1.0).abs() < 1e-6 && tolerance < 1e-5);
    assert_eq!(best.condition_residual(), residual);
}
