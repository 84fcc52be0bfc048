//! What a person is told of a failure.

use crate::exact::exponential;
use crate::failures::{WrongJacobian, bump, growth, jump, numerical, states};
use crate::reports::report;
use bvp::{
    Constant, Control, Equations, Error, FiniteDifferences, Guess, Options, Scheme, Segment,
    Unknown,
};

/// A numerical failure whose message is one line and whose iterate has a report.
fn failure(equations: &dyn Equations, guess: &dyn Guess, options: &Options) -> Error {
    let error = numerical(equations, guess, options);
    assert!(!error.to_string().contains('\n'));
    report(error.best().expect("an iterate"));
    error
}

/// Two states with y₁' = y₂, y₂' = y₁.
fn hyperbola() -> FiniteDifferences<crate::failures::Rhs, crate::failures::Conditions> {
    let mut problem = growth();
    problem.segments = vec![Segment::on(2, 0.0, 2.0)];
    problem.condition_count = 2;
    problem.rhs = |_, _, y, _, dy| {
        dy[0] = y[1];
        dy[1] = y[0];
    };
    problem
}

#[test]
fn conditions_that_depend_on_each_other() {
    let guess = states(&[1.0, 0.0]);
    let mut problem = hyperbola();
    problem.conditions = |at, _, r| {
        r[0] = at.start(0)[0] - 1.0;
        r[1] = 3.0 * at.start(0)[0] - 3.0;
    };
    let error = failure(&problem, &guess, &Options::default());
    assert_eq!(
        error.to_string(),
        "singular Newton matrix: the conditions do not determine the solution locally; \
         component 0 of segment 0 at s = 2 is free; \
         replace one of the conditions 0, 1, which depend on each other"
    );
    // A condition that is none.
    problem.conditions = |at, _, r| {
        r[0] = at.start(0)[1];
        r[1] = 0.0;
    };
    let error = failure(&problem, &guess, &Options::default());
    assert_eq!(
        error.to_string(),
        "singular Newton matrix: the conditions do not determine the solution locally; \
         component 0 of segment 0 at s = 2 is free; \
         replace condition 1, which follows from the equations and the other conditions"
    );
}

#[test]
fn a_parameter_that_no_condition_determines() {
    // y(0) determines y, and so y(1) says nothing of p.
    let mut problem = growth();
    problem.parameters = 1;
    problem.condition_count = 2;
    problem.conditions = |at, _, r| {
        r[0] = at.start(0)[0] - 1.0;
        r[1] = at.end(0)[0] - 2.0;
    };
    let guess = Constant {
        states: vec![vec![1.0]],
        parameters: vec![0.0],
    };
    let error = failure(&problem, &guess, &Options::default());
    let Error::SingularConditions {
        ref conditions,
        free: Some(Unknown::Parameter { index: 0 }),
        ..
    } = error
    else {
        panic!("{error}")
    };
    assert_eq!(conditions, &[0, 1]);
    assert_eq!(
        error.to_string(),
        "singular Newton matrix: the conditions do not determine the solution locally; \
         parameter 0 is free; replace one of the conditions 0, 1, which depend on each other"
    );
}

#[test]
fn a_large_system_names_only_a_few_conditions() {
    // Every state is fixed at the start but for the last, whose condition is the sum of all others.
    let n = 40;
    let mut problem = growth();
    problem.segments = vec![Segment::new(n)];
    problem.condition_count = n;
    problem.rhs = |_, _, _, _, dy| dy.fill(0.0);
    problem.conditions = |at, _, r| {
        let (last, others) = r.split_last_mut().expect("conditions");
        others.copy_from_slice(&at.start(0)[..others.len()]);
        *last = others.iter().sum();
    };
    let error = failure(&problem, &states(&vec![1.0; n]), &Options::default());
    assert_eq!(
        error.to_string(),
        "singular Newton matrix: the conditions do not determine the solution locally; \
         component 39 of segment 0 at s = 0 is free; \
         replace one of the conditions 0, 1, 2, 3, …, which depend on each other"
    );
}

#[test]
fn stages_that_have_no_solution() {
    // The midpoint rule on y' = 4y with h = ½.
    let options = Options {
        scheme: Some(Scheme::Gauss { stages: 1 }),
        tolerance: 1e-2,
        initial_intervals: 2,
        max_intervals: 2,
        control: Control::Defect,
        ..Options::default()
    };
    let error = failure(&*exponential(4.0).equations, &states(&[1.0, 0.0]), &options);
    assert_eq!(
        error.to_string(),
        "singular Newton matrix in segment 0 at node 0, s = 0; start on other intervals"
    );
}

#[test]
fn values_that_are_not_finite() {
    let mut problem = growth();
    problem.rhs = |_, _, y, _, dy| dy[0] = y[0].ln();
    let error = failure(&problem, &states(&[-1.0]), &Options::default());
    let Error::NonFiniteRhs { s, .. } = error else {
        panic!("{error}")
    };
    assert_eq!(
        error.to_string(),
        format!(
            "right-hand side of component 0 is not finite in segment 0 at s = {s}; \
             write every component and keep the guess inside its domain"
        )
    );
    problem = growth();
    problem.conditions = |at, _, r| r[0] = at.start(0)[0].sqrt();
    let error = failure(&problem, &states(&[-1.0]), &Options::default());
    assert_eq!(
        error.to_string(),
        "condition 0 is not finite or was not written; keep the guess inside its domain"
    );
}

#[test]
fn no_convergence_says_where() {
    // Bratu's problem beyond its fold in the second component of the second segment; the rest is
    // linear.
    let mut problem = growth();
    problem.segments = vec![Segment::new(1), Segment::on(3, 1.0, 2.0)];
    problem.condition_count = 4;
    problem.rhs = |segment, _, y, _, dy| {
        if segment == 0 {
            dy[0] = y[0];
        } else {
            dy[0] = y[0];
            dy[1] = y[2];
            dy[2] = -4.0 * y[1].exp();
        }
    };
    problem.conditions = |at, _, r| {
        r[0] = at.start(0)[0] - 1.0;
        r[1] = at.start(1)[0] - 1.0;
        r[2] = at.start(1)[1];
        r[3] = at.end(1)[1];
    };
    let guess = Constant {
        states: vec![vec![1.0], vec![1.0, 0.0, 0.0]],
        parameters: vec![],
    };
    let error = failure(&problem, &guess, &Options::default());
    let Error::NoConvergence {
        correction,
        steps,
        tolerance,
        largest:
            Some(Unknown::State {
                segment: 1,
                s,
                component,
            }),
        ..
    } = error
    else {
        panic!("{error}")
    };
    assert!((1.0..=2.0).contains(&s) && component > 0);
    assert_eq!(
        error.to_string(),
        format!(
            "newton: relative correction {correction:.1e} of component {component} of segment 1 \
             at s = {s} after {steps} steps, tolerance {tolerance:.1e}; \
             try a better guess, or solve_embedded from an easier problem"
        )
    );
    let lines = report(error.best().unwrap());
    assert_eq!(lines[1], "error       not known, no estimate");
    assert_eq!(
        lines[2],
        "defect      not known: this iterate did not converge"
    );
    assert_eq!(lines[3], "conditions  not known");
}

#[test]
fn a_parameter_that_does_not_converge_is_named() {
    // p² + 1 = 0.
    let mut problem = growth();
    problem.parameters = 1;
    problem.condition_count = 2;
    problem.conditions = |at, p, r| {
        r[0] = at.start(0)[0] - 1.0;
        r[1] = p[0] * p[0] + 1.0;
    };
    let guess = Constant {
        states: vec![vec![1.0]],
        parameters: vec![0.7],
    };
    let message = failure(&problem, &guess, &Options::default()).to_string();
    assert!(
        message.starts_with("newton: relative correction "),
        "{message}"
    );
    assert!(message.contains(" of parameter 0 after "), "{message}");
}

#[test]
fn the_mesh_limit_says_what_is_missing() {
    let options = Options {
        max_intervals: 20,
        ..Options::default()
    };
    let error = failure(&bump(), &states(&[0.0]), &options);
    let Error::MeshLimit {
        needed,
        defect,
        error: estimate,
        s,
        ..
    } = error
    else {
        panic!("{error}")
    };
    assert!((s - 0.5).abs() < 0.11);
    let estimate = if estimate.is_finite() {
        format!("{estimate:.1e}")
    } else {
        "not known".to_owned()
    };
    assert_eq!(
        error.to_string(),
        format!(
            "mesh limit: {needed} intervals needed, 20 allowed; defect {defect:.1e}, \
             estimated error {estimate}, tolerance 1.0e-6; worst in segment 0 near s = {s}; \
             raise max_intervals or the tolerance"
        )
    );
}

#[test]
fn a_jump_is_to_be_a_joined_point() {
    let options = Options {
        scheme: Some(Scheme::LobattoIIIA { stages: 3 }),
        control: Control::Defect,
        ..Options::default()
    };
    let error = failure(&jump(), &states(&[1.0]), &options);
    let Error::Unresolved {
        s,
        length,
        meshes,
        defect,
        ..
    } = error
    else {
        panic!("{error}")
    };
    assert_eq!(
        error.to_string(),
        format!(
            "defect {defect:.1e}, estimated error not known, tolerance 1.0e-6 after {meshes} \
             meshes; worst in segment 0 near s = {s}, interval length {length:.1e}; \
             a kink or jump of the right-hand side needs a joined point there, a layer inside \
             solve_embedded from a wider one"
        )
    );
}

#[test]
fn a_violated_condition_points_at_its_derivatives() {
    let options = Options {
        control: Control::Defect,
        ..Options::default()
    };
    let error = failure(&WrongJacobian, &states(&[0.0]), &options);
    let Error::ConditionViolated { tolerance, .. } = error else {
        panic!("{error}")
    };
    assert_eq!(
        error.to_string(),
        format!(
            "condition 0 violated: residual 1.0e0, tolerance {tolerance:.1e}; \
             compare its derivatives with check_jacobians"
        )
    );
    let lines = report(error.best().unwrap());
    assert_eq!(
        lines[3],
        "conditions  1.0e0, the largest residual: condition 0"
    );
}
