//! Statements that are refused: the variant, its numbers and its message.

use crate::failures::{growth, states};
use bvp::{
    Constant, Control, Equations, Error, Function, Guess, Options, Scheme, Segment, Table, solve,
};

/// The error of a statement: it carries no iterate.
fn statement(equations: &dyn Equations, guess: &dyn Guess, options: &Options) -> Error {
    let error = solve(equations, guess, options).unwrap_err();
    assert!(error.best().is_none());
    error
}

#[test]
fn incomplete_statements() {
    let options = Options::default();
    let guess = states(&[1.0]);

    let mut problem = growth();
    problem.condition_count = 3;
    let error = statement(&problem, &guess, &options);
    assert!(matches!(
        error,
        Error::ConditionCount {
            conditions: 3,
            unknowns: 1,
            states: 1,
            parameters: 0
        }
    ));
    assert_eq!(
        error.to_string(),
        "3 conditions given, 1 needed: 1 for the states and 0 for the parameters"
    );

    problem = growth();
    problem.segments.clear();
    let error = statement(&problem, &guess, &options);
    assert!(matches!(error, Error::NoSegments));
    assert_eq!(error.to_string(), "a problem needs at least one segment");

    problem = growth();
    problem.segments.push(Segment::new(0));
    let error = statement(&problem, &guess, &options);
    assert!(matches!(error, Error::NoStates { segment: 1 }));
    assert_eq!(error.to_string(), "segment 1 has no states");

    for (from, to) in [(1.0, 1.0), (0.0, f64::NAN), (0.0, f64::INFINITY)] {
        problem = growth();
        problem.segments = vec![Segment::on(1, from, to)];
        let error = statement(&problem, &guess, &options);
        assert!(matches!(error, Error::Interval { segment: 0, .. }));
        assert_eq!(
            error.to_string(),
            format!("segment 0 runs from {from} to {to}; its ends must differ and be finite")
        );
    }
}

#[test]
fn options_out_of_range() {
    let guess = states(&[1.0]);
    for tolerance in [0.0, -1e-6, 1e-14, 0.5, f64::NAN] {
        let options = Options {
            tolerance,
            ..Options::default()
        };
        let error = statement(&growth(), &guess, &options);
        assert!(matches!(error, Error::Tolerance { .. }));
        assert_eq!(
            error.to_string(),
            format!("tolerance {tolerance:e} is outside 1e-13 to 1e-1")
        );
    }
    for scheme in [
        Scheme::Gauss { stages: 0 },
        Scheme::Gauss { stages: 8 },
        Scheme::LobattoIIIA { stages: 2 },
        Scheme::LobattoIIIA { stages: 5 },
    ] {
        let options = Options {
            scheme: Some(scheme),
            ..Options::default()
        };
        let error = statement(&growth(), &guess, &options);
        assert!(matches!(error, Error::Stages { scheme: found } if found == scheme));
        assert_eq!(
            error.to_string(),
            format!("{scheme:?} is not provided: Gauss has 1 to 7 stages, Lobatto IIIA has 3 or 4")
        );
    }
    let options = Options {
        initial_intervals: 0,
        ..Options::default()
    };
    let error = statement(&growth(), &guess, &options);
    assert!(matches!(error, Error::NoIntervals));
    assert_eq!(
        error.to_string(),
        "at least one initial interval per segment is needed"
    );
    let options = Options {
        max_intervals: 9,
        ..Options::default()
    };
    let error = statement(&growth(), &guess, &options);
    assert!(matches!(
        error,
        Error::FirstMesh {
            intervals: 10,
            limit: 9
        }
    ));
    assert_eq!(
        error.to_string(),
        "the first mesh has 10 intervals, 9 allowed"
    );
}

#[test]
fn guesses_that_do_not_fit() {
    let options = Options::default();
    for nodes in [
        vec![vec![0.0, 0.5]],
        vec![vec![0.1, 1.0]],
        vec![vec![0.0, 0.6, 0.4, 1.0]],
        vec![vec![0.0, 0.5, 0.5, 1.0]],
        vec![vec![0.0, f64::NAN, 1.0]],
        vec![vec![0.0]],
        vec![],
        vec![vec![0.0, 1.0]; 2],
    ] {
        let guess = Table {
            states: nodes.iter().map(|nodes| vec![1.0; nodes.len()]).collect(),
            nodes,
            parameters: vec![],
        };
        let error = statement(&growth(), &guess, &options);
        assert!(matches!(
            error,
            Error::GuessMesh {
                segment: 0,
                from: 0.0,
                to: 1.0
            }
        ));
        assert_eq!(
            error.to_string(),
            "the mesh of the guess for segment 0 must run from 0 to 1 without turning back"
        );
    }

    let error = statement(&growth(), &states(&[f64::NAN]), &options);
    assert!(matches!(error, Error::Guess { segment: 0, s: 0.0 }));
    assert_eq!(
        error.to_string(),
        "the guess is not finite in segment 0 at s = 0"
    );
    // Finite at the nodes but not in between.
    let guess = Function {
        state: |_: usize, s: f64| {
            [if (0.51..0.59).contains(&s) {
                f64::NAN
            } else {
                1.0
            }]
        },
        parameters: vec![],
    };
    let as_stated = Options {
        control: Control::Defect,
        ..options.clone()
    };
    let error = statement(&growth(), &guess, &as_stated);
    assert!(matches!(error, Error::Guess { segment: 0, s: 0.5 }));

    let mut problem = growth();
    problem.parameters = 2;
    problem.condition_count = 3;
    let guess = Constant {
        states: vec![vec![1.0]],
        parameters: vec![1.0, f64::INFINITY],
    };
    let error = statement(&problem, &guess, &options);
    assert!(matches!(error, Error::GuessParameter { parameter: 1 }));
    assert_eq!(error.to_string(), "the guess of parameter 1 is not finite");
}

#[test]
fn guesses_of_another_shape() {
    let options = Options::default();
    let few = Constant::default();
    let many = states(&[1.0, 2.0]);
    let table = Table {
        nodes: vec![vec![0.0, 0.5, 1.0]],
        states: vec![vec![1.0; 4]],
        parameters: vec![],
    };
    let guesses: [(&dyn Guess, usize, usize); 3] = [(&few, 0, 1), (&many, 2, 1), (&table, 4, 3)];
    for (guess, count, need) in guesses {
        let error = statement(&growth(), guess, &options);
        assert!(matches!(
            error,
            Error::GuessStates { segment: 0, found, needed } if found == count && needed == need
        ));
        assert_eq!(
            error.to_string(),
            format!("the guess has {count} numbers for the states of segment 0, {need} needed")
        );
    }

    let mut problem = growth();
    problem.segments = vec![Segment::new(2)];
    problem.condition_count = 2;
    let solution = solve(&growth(), &states(&[1.0]), &options).unwrap();
    let error = statement(&problem, &solution, &options);
    let nodes = solution.mesh(0).len();
    assert!(matches!(
        error,
        Error::GuessStates { segment: 0, found, needed } if found == nodes && needed == 2 * nodes
    ));

    problem = growth();
    problem.parameters = 1;
    problem.condition_count = 2;
    let function = Function {
        state: |_: usize, _: f64| [1.0],
        parameters: vec![1.0, 2.0],
    };
    let constant = Constant {
        states: vec![vec![1.0]],
        parameters: vec![],
    };
    let guesses: [(&dyn Guess, usize); 3] = [(&function, 2), (&constant, 0), (&solution, 0)];
    for (guess, count) in guesses {
        let error = statement(&problem, guess, &options);
        assert!(matches!(
            error,
            Error::GuessParameters { found, needed: 1 } if found == count
        ));
        assert_eq!(
            error.to_string(),
            format!("the guess has {count} parameters, 1 needed")
        );
    }
}
