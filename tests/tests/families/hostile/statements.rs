//! Statements that no sane caller makes.

use super::{Meshed, Plain};
use bvp::{Error, Options, Scheme, Segment, solve};

#[test]
fn segments_that_are_none() {
    let none = Plain {
        segments: vec![],
        ..Plain::default()
    };
    assert!(matches!(none.solved(), Err(Error::NoSegments)));
    let stateless = Plain {
        segments: vec![Segment::new(1), Segment::new(0)],
        ..Plain::default()
    };
    assert!(matches!(
        stateless.solved(),
        Err(Error::NoStates { segment: 1 })
    ));
    let ends = [
        (0.0, 0.0),
        (f64::NAN, 1.0),
        (0.0, f64::INFINITY),
        (f64::NEG_INFINITY, f64::INFINITY),
        (-f64::MAX, f64::MAX),
    ];
    for (from, to) in ends {
        let solved = Plain::on(from, to).solved();
        assert!(
            matches!(solved, Err(Error::Interval { segment: 0, .. })),
            "{from} to {to}: {solved:?}"
        );
    }
}

#[test]
fn intervals_as_short_as_numbers_allow() {
    let shortest = f64::from_bits(1);
    let ends = [
        (0.0, shortest),
        (0.0, 100.0 * shortest),
        (0.0, f64::MIN_POSITIVE),
        (1.0, 1.0 + f64::EPSILON),
        (1.0, 1.0 + 5.0 * f64::EPSILON),
        (1e300, 1e300 * (1.0 + f64::EPSILON)),
    ];
    for (from, to) in ends {
        for retries in [0, 3] {
            let (plain, options) = (
                Plain::on(from, to),
                Options {
                    retries,
                    ..Options::default()
                },
            );
            match solve(&plain, &plain.guess(0.5), &options) {
                Ok(solution) => assert!((solution.end(0)[0] - 1.0).abs() < 1e-5, "{from} to {to}"),
                Err(error) => assert!(!error.to_string().is_empty()),
            }
        }
    }
}

#[test]
fn long_intervals() {
    for to in [1e10, 1e100, 1e300] {
        match Plain::on(0.0, to).solved() {
            Ok(solution) => assert!(solution.end(0)[0].abs() < 1e-5, "to {to}"),
            Err(error) => assert!(!error.to_string().is_empty()),
        }
    }
}

#[test]
fn counts_beyond_all_memory() {
    let huge = usize::MAX / 2;
    for states in [huge, usize::MAX] {
        let plain = Plain {
            segments: vec![Segment::new(states); 2],
            count: Some(2),
            ..Plain::default()
        };
        let outcome = solve(
            &plain,
            &Meshed(vec![vec![0.0, 1.0]; 2]),
            &Options::default(),
        );
        assert!(outcome.is_err(), "{states} states");
    }
    let many = Plain {
        parameters: huge,
        count: Some(2),
        ..Plain::default()
    };
    let outcome = solve(&many, &Meshed(vec![vec![0.0, 1.0]]), &Options::default());
    assert!(matches!(outcome, Err(Error::ConditionCount { .. })));
    let plain = Plain::default();
    for initial_intervals in [huge, usize::MAX] {
        let options = Options {
            initial_intervals,
            ..Options::default()
        };
        let outcome = solve(&plain, &plain.guess(0.5), &options);
        assert!(
            matches!(outcome, Err(Error::FirstMesh { .. })),
            "{outcome:?}"
        );
    }
    let unlimited = Options {
        max_intervals: usize::MAX,
        max_newton_steps: usize::MAX,
        retries: usize::MAX,
        ..Options::default()
    };
    solve(&plain, &plain.guess(0.5), &unlimited).expect("no limits");
}

#[test]
fn conditions_that_ignore_the_unknowns() {
    for value in [0.0, 1.0] {
        for count in [1, 2, 5] {
            let segments = vec![Segment::new(1); count];
            let plain = Plain {
                segments,
                weight: 0.0,
                value,
                ..Plain::default()
            };
            let outcome = plain.solved();
            assert!(
                matches!(outcome, Err(Error::SingularConditions { .. })),
                "{outcome:?}"
            );
        }
    }
    let parameter = Plain {
        parameters: 3,
        weight: 0.0,
        ..Plain::default()
    };
    assert!(matches!(
        parameter.solved(),
        Err(Error::SingularConditions { .. })
    ));
}

#[test]
fn values_that_are_no_numbers() {
    for value in [f64::NAN, f64::INFINITY] {
        let asked = Plain {
            value,
            ..Plain::default()
        }
        .solved();
        assert!(
            matches!(asked, Err(Error::NonFiniteCondition { condition: 0, .. })),
            "{asked:?}"
        );
        let fast = Plain {
            size: value,
            ..Plain::default()
        }
        .solved();
        assert!(
            matches!(
                fast,
                Err(Error::NonFiniteRhs {
                    segment: 0,
                    component: 0,
                    ..
                })
            ),
            "{fast:?}"
        );
    }
}

#[test]
fn a_thousand_states() {
    let plain = Plain {
        segments: vec![Segment::new(1000)],
        ..Plain::default()
    };
    let options = Options {
        scheme: Some(Scheme::Gauss { stages: 2 }),
        initial_intervals: 1,
        ..Options::to(1e-2)
    };
    let solution = solve(&plain, &plain.guess(0.5), &options).expect("a thousand decays");
    assert!(
        solution
            .end(0)
            .iter()
            .all(|y| (y - (-1f64).exp()).abs() < 1e-2)
    );
}

#[test]
fn joined_points_that_are_none() {
    for points in [
        &[0.0][..],
        &[1.0],
        &[f64::NAN],
        &[-1.0],
        &[2.0],
        &[0.5, 0.5],
        &[0.7, 0.3],
        &[f64::INFINITY],
    ] {
        let segments = vec![Segment::new(1).joined(points)];
        let joined = Plain {
            segments,
            ..Plain::default()
        }
        .solved();
        assert!(
            matches!(joined, Err(Error::Joined { segment: 0, .. })),
            "{points:?}: {joined:?}"
        );
    }
    // Next to the ends and to each other.
    let close = [
        f64::from_bits(1),
        0.5,
        0.5 + f64::EPSILON,
        1.0 - f64::EPSILON,
    ];
    let segments = vec![Segment::new(1).joined(&close)];
    if let Ok(solution) = (Plain {
        segments,
        ..Plain::default()
    })
    .solved()
    {
        assert!((solution.end(0)[0] - (-1f64).exp()).abs() < 1e-5);
    }
}

#[test]
fn values_at_the_ends_of_the_range_of_numbers() {
    for value in [
        1e300,
        -1e300,
        f64::MAX,
        1e-300,
        f64::MIN_POSITIVE,
        f64::from_bits(1),
    ] {
        let asked = Plain {
            value,
            ..Plain::default()
        };
        if let Ok(solution) = asked.solved() {
            let exact = value * (-1f64).exp();
            assert!(
                (solution.end(0)[0] - exact).abs() <= 1e-5 * (1.0 + exact.abs()),
                "{value}"
            );
        }
        let plain = Plain::default();
        if let Ok(solution) = solve(&plain, &plain.guess(value), &Options::default()) {
            assert!(
                (solution.end(0)[0] - (-1f64).exp()).abs() < 1e-5,
                "from {value}"
            );
        }
        let weighted = Plain {
            weight: value,
            ..Plain::default()
        };
        if let Ok(solution) = weighted.solved() {
            assert!(
                (solution.end(0)[0] - (-1f64).exp()).abs() < 1e-5,
                "weighted by {value}"
            );
        }
        let fast = Plain {
            size: value,
            ..Plain::default()
        };
        if let Ok(solution) = fast.solved() {
            let exact = (-value).exp();
            assert!(
                (solution.end(0)[0] - exact).abs() < 1e-5 * (1.0 + exact),
                "rate {value}"
            );
        }
    }
}
