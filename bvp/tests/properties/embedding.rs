//! A parameter followed from an easy value to a hard one.

use crate::failures::states;
use bvp::{
    Constant, Embedding, Ends, Error, Guess, Options, Problem, Real, Segment, Solution, solve,
    solve_embedded,
};

/// What the tests solve, with a parameter p that is given.
#[derive(Clone, Copy, PartialEq)]
enum Equation {
    /// p y'' = 1 − y'², y(−1) = y(1) = 1: a corner of width p.
    Corner,
    /// y'' = −p eʸ, y(−1) = y(1) = 0: no solution beyond p = 3.513830719 / 4, where two meet.
    Bratu,
    /// y'' = p sinh p y, y(0) = 1, y(1) = 0: Troesch's problem with its layer at zero, where numbers
    /// resolve it.
    Troesch,
}

struct Given {
    equation: Equation,
    /// The value of p, where the problem itself says it.
    value: Option<f64>,
}

impl Problem for Given {
    fn segments(&self) -> Vec<Segment> {
        match self.equation {
            Equation::Corner | Equation::Bratu => vec![Segment::on(2, -1.0, 1.0)],
            Equation::Troesch => vec![Segment::new(2)],
        }
    }

    fn parameters(&self) -> usize {
        1
    }

    fn condition_count(&self) -> usize {
        2 + usize::from(self.value.is_some())
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = match self.equation {
            Equation::Corner => (-y[1] * y[1] + 1.0) / p[0],
            Equation::Bratu => -p[0] * y[0].exp(),
            Equation::Troesch => p[0] * (p[0] * y[0]).sinh(),
        };
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let (left, right) = match self.equation {
            Equation::Corner => (1.0, 1.0),
            Equation::Bratu => (0.0, 0.0),
            Equation::Troesch => (1.0, 0.0),
        };
        r[0] = at.start(0)[0] - left;
        r[1] = at.end(0)[0] - right;
        if let Some(value) = self.value {
            r[2] = p[0] - value;
        }
    }
}

fn zero() -> Constant {
    Constant {
        states: vec![vec![0.0; 2]],
        parameters: vec![0.0],
    }
}

fn follow(equation: Equation, from: f64, to: f64) -> Result<Solution, Error> {
    let problem = Given {
        equation,
        value: None,
    };
    let parameter = 0;
    let embedding = Embedding {
        parameter,
        from,
        to,
    };
    solve_embedded(&problem, &embedding, &zero(), &Options::default())
}

/// The same problem stated with the value, from the same guess, unaided.
fn direct(equation: Equation, value: f64) -> Result<Solution, Error> {
    let problem = Given {
        equation,
        value: Some(value),
    };
    let mut guess = zero();
    guess.parameters[0] = value;
    let options = Options {
        retries: 0,
        ..Options::default()
    };
    solve(&problem, &guess, &options)
}

#[test]
fn a_corner_sharper_than_newtons_method_can_guess() {
    let epsilon = 1e-6;
    assert!(direct(Equation::Corner, epsilon).is_err());
    let solution = follow(Equation::Corner, 1.0, epsilon).unwrap();
    assert_eq!(solution.parameters(), [epsilon]);
    assert!(solution.error_estimate().unwrap() <= 1e-6);
    // y = 1 + ε ln (cosh(s/ε) / cosh(1/ε)), with the exponentials of 1/ε cancelled.
    let rounded = |s: f64| (-2.0 * s.abs() / epsilon).exp().ln_1p();
    let mut y = [0.0; 2];
    for i in -50..=50 {
        for s in [f64::from(i) / 50.0, f64::from(i) * 1e-7] {
            solution.state(0, s, &mut y);
            let exact = [s.abs() + epsilon * rounded(s), (s / epsilon).tanh()];
            assert!((y[0] - exact[0]).abs() < 1e-6, "{s}: {y:?}");
            assert!((y[1] - exact[1]).abs() < 1e-5, "{s}: {y:?}");
        }
    }
}

#[test]
fn troeschs_problem_with_a_slope_of_1e10() {
    let mu = 50.0;
    let solution = follow(Equation::Troesch, 1.0, mu).unwrap();
    // y'² = 2 cosh μy − 2 + y'(1)², and y'(1) is below 10⁻²⁰.
    let exact = -2.0 * (mu / 2.0).sinh();
    let slope = solution.start(0)[1];
    assert!((slope / exact - 1.0).abs() < 1e-6, "{slope} {exact}");
}

#[test]
fn what_can_be_solved_at_once_is() {
    let aided = follow(Equation::Bratu, 0.0, 0.5).unwrap();
    let unaided = direct(Equation::Bratu, 0.5).unwrap();
    let (aided, unaided) = (aided.stats(), unaided.stats());
    assert_eq!(aided.rhs_evaluations, unaided.rhs_evaluations);
    assert_eq!(aided.factorisations, unaided.factorisations);
}

#[test]
fn the_cost_is_that_of_the_whole_way() {
    let solution = follow(Equation::Corner, 1.0, 1e-4).unwrap();
    let last = solve(
        &Given {
            equation: Equation::Corner,
            value: Some(1e-4),
        },
        &solution,
        &Options::default(),
    )
    .unwrap();
    let (all, last) = (solution.stats(), last.stats());
    assert!(all.meshes > 4 * last.meshes, "{all:?}");
    assert!(all.newton_steps > all.meshes && all.rhs_evaluations > 4 * last.rhs_evaluations);
}

#[test]
fn beyond_a_fold_the_error_says_how_far_the_solutions_go() {
    let fold = 3.513_830_719 / 4.0;
    for wanted in [0.8785, 1.0, 10.0] {
        let error = follow(Equation::Bratu, 0.0, wanted).unwrap_err();
        let message = error.to_string();
        let Error::Unreached {
            parameter: 0,
            reached,
            to,
            cause,
            best,
        } = error
        else {
            panic!("{message}")
        };
        assert!(reached < fold && reached > 0.998 * fold, "{reached}");
        assert_eq!(to, wanted);
        assert!(cause.best().is_some());
        assert_eq!(
            message,
            format!("parameter 0 reached {reached} on the way to {to}: {cause}")
        );
        assert_eq!(best.parameters(), [reached]);
        assert!(best.defect() <= 1e-6 && best.stats().meshes > 10);
    }
}

#[test]
fn without_a_start_there_is_no_way() {
    let error = follow(Equation::Bratu, 2.0, 3.0).unwrap_err();
    assert!(matches!(error, Error::NoConvergence { .. }), "{error}");
    assert_eq!(error.best().unwrap().parameters(), [2.0]);
}

#[test]
fn an_embedding_is_checked_before_any_arithmetic() {
    let corner = |value| Given {
        equation: Equation::Corner,
        value,
    };
    let solve = |value, embedding: Embedding, guess: &dyn Guess| {
        let options = Options::default();
        solve_embedded(&corner(value), &embedding, guess, &options).unwrap_err()
    };
    let good = Embedding {
        parameter: 0,
        from: 1.0,
        to: 0.1,
    };
    for bad in [
        Embedding {
            parameter: 1,
            ..good
        },
        Embedding {
            from: f64::NAN,
            ..good
        },
        Embedding {
            to: f64::INFINITY,
            ..good
        },
    ] {
        let error = solve(None, bad, &zero());
        assert!(matches!(error, Error::Embedding { parameters: 1, .. }));
    }
    let error = solve(
        None,
        Embedding {
            parameter: 3,
            ..good
        },
        &zero(),
    );
    assert_eq!(
        error.to_string(),
        "parameter 3 of 1 cannot be led from 1 to 0.1"
    );
    let error = solve(Some(1.0), good, &zero());
    assert!(matches!(error, Error::ConditionCount { .. }), "{error}");
    let error = solve(None, good, &states(&[0.0; 2]));
    assert!(matches!(error, Error::GuessParameters { .. }), "{error}");
}
