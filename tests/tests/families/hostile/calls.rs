//! Options out of range, and the other calls of the crate with what does not belong to them.

use super::Plain;
use bvp::{
    Embedding, Error, Family, Options, Scheme, Segment, check_jacobians, solve, solve_embedded,
};

#[test]
fn options_out_of_range() {
    let plain = Plain::default();
    let outcome = |options: &Options| solve(&plain, &plain.guess(0.5), options);
    for tolerance in [
        f64::INFINITY,
        f64::NAN,
        0.0,
        -1e-6,
        f64::MIN_POSITIVE,
        1e300,
    ] {
        let found = outcome(&Options::to(tolerance));
        assert!(
            matches!(found, Err(Error::Tolerance { .. })),
            "{tolerance}: {found:?}"
        );
    }
    for stages in [0, 8, usize::MAX] {
        for scheme in [Scheme::Gauss { stages }, Scheme::LobattoIIIA { stages }] {
            let found = outcome(&Options {
                scheme: Some(scheme),
                ..Options::default()
            });
            assert!(
                matches!(found, Err(Error::Stages { .. })),
                "{scheme:?}: {found:?}"
            );
        }
    }
    let found = outcome(&Options {
        initial_intervals: 0,
        ..Options::default()
    });
    assert!(matches!(found, Err(Error::NoIntervals)));
    for max_intervals in [0, 1, 2] {
        let found = outcome(&Options {
            max_intervals,
            ..Options::default()
        });
        assert!(matches!(found, Err(Error::FirstMesh { .. })), "{found:?}");
    }
    let stepless = outcome(&Options {
        max_newton_steps: 0,
        ..Options::default()
    });
    assert!(
        matches!(stepless, Err(Error::NoConvergence { .. })),
        "{stepless:?}"
    );
}

#[test]
fn conditioning_of_another_problem() {
    let plain = Plain::default();
    let solution = plain.solved().expect("a decay");
    let others = [
        Plain {
            segments: vec![],
            ..Plain::default()
        },
        Plain {
            segments: vec![Segment::new(2)],
            ..Plain::default()
        },
        Plain {
            segments: vec![Segment::new(0)],
            ..Plain::default()
        },
        Plain {
            segments: vec![Segment::new(1); 2],
            ..Plain::default()
        },
        Plain {
            parameters: 1,
            ..Plain::default()
        },
        Plain {
            count: Some(0),
            ..Plain::default()
        },
        Plain {
            weight: 0.0,
            ..Plain::default()
        },
        Plain {
            weight: f64::NAN,
            ..Plain::default()
        },
        Plain {
            size: f64::INFINITY,
            ..Plain::default()
        },
        Plain::on(0.0, 2.0),
        Plain::on(0.0, 0.0),
    ];
    for other in others {
        let outcome = solution.conditioning(&other);
        assert!(outcome.is_err(), "{other:?}: {outcome:?}");
    }
    // Of an iterate that is no solution, too.
    let error = Plain {
        weight: 0.0,
        ..Plain::default()
    }
    .solved()
    .expect_err("nothing is asked");
    assert!(
        error
            .best()
            .expect("an iterate")
            .conditioning(&plain)
            .is_ok()
    );
}

#[test]
fn embeddings_that_lead_nowhere() {
    let plain = Plain {
        parameters: 1,
        count: Some(1),
        ..Plain::default()
    };
    let guess = plain.guess(0.5);
    let outcome = |parameter, from, to| {
        solve_embedded(
            &plain,
            &Embedding {
                parameter,
                from,
                to,
            },
            &guess,
            &Options::default(),
        )
    };
    for (parameter, from, to) in [
        (1, 0.0, 1.0),
        (usize::MAX, 0.0, 1.0),
        (0, f64::NAN, 1.0),
        (0, 0.0, f64::INFINITY),
    ] {
        let found = outcome(parameter, from, to);
        assert!(matches!(found, Err(Error::Embedding { .. })), "{found:?}");
    }
    for (from, to) in [
        (1.0, 1.0),
        (0.0, -0.0),
        (1e300, -1e300),
        (f64::MAX, f64::MIN_POSITIVE),
    ] {
        if let Ok(solution) = outcome(0, from, to) {
            assert!(solution.parameters()[0] == to, "{from} to {to}");
        }
    }
    let whole = Plain {
        parameters: 1,
        ..Plain::default()
    };
    let embedding = Embedding {
        parameter: 0,
        from: 0.0,
        to: 1.0,
    };
    let outcome = solve_embedded(&whole, &embedding, &guess, &Options::default());
    assert!(
        matches!(outcome, Err(Error::ConditionCount { .. })),
        "{outcome:?}"
    );
    let none = Plain::default();
    let outcome = solve_embedded(&none, &embedding, &none.guess(0.0), &Options::default());
    assert!(
        matches!(outcome, Err(Error::Embedding { .. })),
        "{outcome:?}"
    );
}

#[test]
fn families_that_are_none() {
    let plain = Plain {
        parameters: 2,
        count: Some(1),
        ..Plain::default()
    };
    let (guess, options) = (plain.guess(0.5), Options::default());
    let family = |parameter, held: &[usize]| {
        Family::new(&plain, parameter, held, &guess, &options).map(|(_, z)| z)
    };
    for (parameter, held) in [
        (2, &[0][..]),
        (usize::MAX, &[]),
        (0, &[0]),
        (0, &[1, 1]),
        (0, &[7]),
    ] {
        let found = family(parameter, held);
        assert!(
            matches!(found, Err(Error::FamilyParameter { .. })),
            "{found:?}"
        );
    }
    assert!(matches!(family(0, &[]), Err(Error::ConditionCount { .. })));
    let mut nothing = plain.guess(0.5);
    nothing.parameters.clear();
    let found = Family::new(&plain, 0, &[1], &nothing, &options).map(|(_, z)| z);
    assert!(
        matches!(found, Err(Error::GuessParameters { .. })),
        "{found:?}"
    );
    let mut unknown = plain.guess(0.5);
    unknown.parameters[0] = f64::NAN;
    let found = Family::new(&plain, 0, &[1], &unknown, &options).map(|(_, z)| z);
    assert!(found.is_err(), "{found:?}");
    let empty = Plain {
        segments: vec![],
        parameters: 1,
        count: Some(0),
        ..Plain::default()
    };
    let found = Family::new(&empty, 0, &[], &empty.guess(0.5), &options).map(|(_, z)| z);
    assert!(matches!(found, Err(Error::NoSegments)), "{found:?}");
    let stateless = Plain {
        segments: vec![Segment::new(0)],
        ..empty
    };
    let found = Family::new(&stateless, 0, &[], &stateless.guess(0.5), &options).map(|(_, z)| z);
    assert!(
        matches!(found, Err(Error::NoStates { segment: 0 })),
        "{found:?}"
    );
}

#[test]
fn jacobians_that_are_no_numbers() {
    let plain = Plain::default();
    for value in [f64::NAN, f64::INFINITY] {
        let other = Plain {
            size: value,
            ..Plain::default()
        };
        assert!(
            !check_jacobians(&plain, &other, &plain.guess(0.5))
                .difference
                .is_finite()
        );
    }
    assert!(
        check_jacobians(&plain, &plain, &plain.guess(f64::NAN))
            .difference
            .is_nan()
    );
    assert!(check_jacobians(&plain, &plain, &plain.guess(1e300)).difference == 0.0);
}

#[test]
fn places_outside_the_solution() {
    let solution = Plain::default().solved().expect("a decay");
    let mut y = [0.0];
    for s in [-1.0, 2.0, 1e300, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        solution.state(0, s, &mut y);
        solution.derivative(0, s, &mut y);
    }
}
