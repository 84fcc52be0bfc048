//! Guesses and meshes that do not fit or are no numbers.

use super::{Meshed, Plain};
use bvp::{Constant, Control, Error, Function, Options, Segment, Table, solve};

#[test]
fn guesses_that_are_no_numbers() {
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let plain = Plain {
            parameters: 1,
            ..Plain::default()
        };
        let mut guess = plain.guess(0.5);
        guess.states[0][0] = value;
        let outcome = solve(&plain, &guess, &Options::default());
        assert!(
            matches!(outcome, Err(Error::Guess { segment: 0, .. })),
            "{outcome:?}"
        );
        let mut guess = plain.guess(0.5);
        guess.parameters[0] = value;
        let outcome = solve(&plain, &guess, &Options::default());
        assert!(
            matches!(outcome, Err(Error::GuessParameter { parameter: 0 })),
            "{outcome:?}"
        );
        let state = move |_: usize, s: f64| [if s > 0.99 { value } else { 0.5 }];
        let one = Plain::default();
        let outcome = solve(
            &one,
            &Function {
                state,
                parameters: vec![],
            },
            &Options::default(),
        );
        assert!(matches!(outcome, Err(Error::Guess { .. })), "{outcome:?}");
    }
}

#[test]
fn guesses_of_another_shape() {
    let plain = Plain {
        segments: vec![Segment::new(2), Segment::new(1)],
        parameters: 1,
        ..Plain::default()
    };
    let shapes: [Vec<Vec<f64>>; 5] = [
        vec![],
        vec![vec![0.0; 2]],
        vec![vec![0.0; 3], vec![0.0]],
        vec![vec![], vec![]],
        vec![vec![0.0], vec![0.0; 2]],
    ];
    for states in shapes {
        let guess = Constant {
            states,
            parameters: vec![0.0],
        };
        let outcome = solve(&plain, &guess, &Options::default());
        assert!(
            matches!(outcome, Err(Error::GuessStates { .. })),
            "{outcome:?}"
        );
    }
    for parameters in [vec![], vec![0.0; 2]] {
        let guess = Constant {
            states: vec![vec![0.0; 2], vec![0.0]],
            parameters,
        };
        let outcome = solve(&plain, &guess, &Options::default());
        assert!(
            matches!(outcome, Err(Error::GuessParameters { .. })),
            "{outcome:?}"
        );
    }
    let table = |nodes: Vec<Vec<f64>>, states: Vec<Vec<f64>>| {
        let guess = Table {
            nodes,
            states,
            parameters: vec![0.0],
        };
        solve(&plain, &guess, &Options::default())
    };
    let nodes = vec![0.0, 0.5, 1.0];
    let outcome = table(
        vec![nodes.clone(), nodes.clone()],
        vec![vec![0.0; 6], vec![0.0; 2]],
    );
    assert!(
        matches!(
            outcome,
            Err(Error::GuessStates {
                segment: 1,
                found: 2,
                needed: 3
            })
        ),
        "{outcome:?}"
    );
    let outcome = table(vec![nodes.clone(), nodes.clone()], vec![vec![0.0; 6]]);
    assert!(
        matches!(outcome, Err(Error::GuessStates { segment: 1, .. })),
        "{outcome:?}"
    );
    assert!(matches!(
        table(vec![nodes], vec![vec![0.0; 6]]),
        Err(Error::GuessMesh { .. })
    ));
    assert!(matches!(
        table(vec![], vec![]),
        Err(Error::GuessMesh { .. })
    ));
}

#[test]
fn functions_of_another_number_of_states() {
    let plain = Plain::default();
    for late in [0, 2] {
        // One state at the start, another number of them farther on.
        let state = move |_: usize, s: f64| vec![0.5; if s > 0.3 { late } else { 1 }];
        let guess = Function {
            state,
            parameters: vec![],
        };
        let outcome = solve(&plain, &guess, &Options::default());
        assert!(matches!(outcome, Err(Error::Guess { .. })), "{outcome:?}");
    }
}

#[test]
fn meshes_that_are_none() {
    let plain = Plain::default();
    let meshes: [Vec<Vec<f64>>; 10] = [
        vec![],
        vec![vec![]],
        vec![vec![0.0]],
        vec![vec![0.0, 0.0, 1.0]],
        vec![vec![0.0, 0.5, 0.5, 1.0]],
        vec![vec![0.0, 1.0, 1.0]],
        vec![vec![0.0, 0.7, 0.3, 1.0]],
        vec![vec![0.0, f64::NAN, 1.0]],
        vec![vec![0.0, 0.9]],
        vec![vec![0.0, 1.0], vec![0.0, 1.0]],
    ];
    for mesh in meshes {
        let outcome = solve(&plain, &Meshed(mesh.clone()), &Options::default());
        assert!(
            matches!(outcome, Err(Error::GuessMesh { segment: 0, .. })),
            "{mesh:?}: {outcome:?}"
        );
    }
    // Nodes as close as numbers allow are a mesh.
    let close = vec![
        0.0,
        f64::from_bits(1),
        0.5,
        0.5 + f64::EPSILON,
        1.0 - f64::EPSILON,
        1.0,
    ];
    for control in [Control::Error, Control::Defect] {
        let options = Options {
            control,
            ..Options::default()
        };
        let solution = solve(&plain, &Meshed(vec![close.clone()]), &options);
        if let Ok(solution) = solution {
            assert!((solution.end(0)[0] - (-1f64).exp()).abs() < 1e-5);
        }
    }
}
