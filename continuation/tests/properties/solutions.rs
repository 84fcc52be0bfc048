//! Solutions by deflation and by homotopy.

use crate::assert_close;
use crate::systems::{cusp, on_isola, washed_out};
use continuation::{Branch, Direction, Error, Kind, Options, Stop, deflate, homotopy};

#[test]
fn deflation_finds_the_isola_from_the_trivial_branch() {
    let options = Options::within(1.0, 100.0);
    let mut system = washed_out(0.05);
    // Continuation of the trivial branch meets nothing.
    let trivial = vec![1.0, 16.0];
    let branch = Branch::new(&mut system, &trivial, Direction::Increasing, &options).unwrap();
    assert!(
        branch
            .into_iter()
            .all(|p| !matches!(p.kind, Kind::BranchPoint | Kind::LimitPoint))
    );

    let mut known = vec![trivial];
    for _ in 0..2 {
        known.push(deflate(&mut system, &known, &[0.9, 16.0], &options).unwrap());
    }
    let mut found = [known[1][0], known[2][0]];
    found.sort_by(f64::total_cmp);
    let upper = on_isola(0.05)[0];
    assert_close(&found, &[1.0 - upper, upper], 1e-12);
    let none = deflate(&mut system, &known, &[0.9, 16.0], &options);
    assert!(
        matches!(none, Err(Error::Deflation { .. } | Error::Start(_))),
        "{none:?}"
    );
}

#[test]
fn deflation_finds_all_of_three_solutions() {
    // x³ = x
    let mut known: Vec<Vec<f64>> = Vec::new();
    let options = Options::within(-1.0, 1.0);
    for _ in 0..3 {
        known.push(deflate(&mut cusp(1.0), &known, &[0.4, 0.0], &options).unwrap());
    }
    let mut found: Vec<f64> = known.iter().map(|z| z[0]).collect();
    found.sort_by(f64::total_cmp);
    assert_close(&found, &[-1.0, 0.0, 1.0], 1e-13);
    assert!(known.iter().all(|z| z[1] == 0.0));
}

#[test]
fn deflation_checks_what_it_is_given() {
    let options = Options::within(-1.0, 1.0);
    let wrong = deflate(&mut cusp(1.0), &[vec![1.0]], &[0.4, 0.0], &options);
    assert!(matches!(
        wrong,
        Err(Error::StartCount {
            given: 1,
            unknowns: 2
        })
    ));
    let wrong = deflate(&mut cusp(1.0), &[], &[0.4], &options);
    assert!(matches!(
        wrong,
        Err(Error::StartCount {
            given: 1,
            unknowns: 2
        })
    ));
}

#[test]
fn homotopy_reaches_its_goal_round_limit_points() {
    // λ = x³ − x from x = −1.3…: beyond the limit points.
    let options = Options::within(-4.0, 4.0);
    let start = [-1.5, -1.5f64.powi(3) + 1.5];
    let point = homotopy(&mut cusp(1.0), &start, 1.875, &options).unwrap();
    assert_eq!(point.lambda(), 1.875);
    assert_close(&point.z, &[1.5, 1.875], 1e-13);
    let point = homotopy(&mut cusp(1.0), &point.z, -1.875, &options).unwrap();
    assert_close(&point.z, &[-1.5, -1.875], 1e-13);
    let same = homotopy(&mut cusp(1.0), &point.z, -1.875, &options).unwrap();
    assert_eq!(same.kind, Kind::Start);
}

#[test]
fn a_homotopy_that_does_not_arrive_says_where_and_why() {
    let options = Options::within(1.0, 100.0);
    let error = homotopy(&mut washed_out(0.05), &on_isola(0.05), 60.0, &options).unwrap_err();
    let Error::Homotopy {
        goal, stop, last, ..
    } = error
    else {
        panic!("{error}")
    };
    assert_eq!(goal, 60.0);
    assert!(matches!(stop, Stop::Closed));
    assert_eq!(last.kind, Kind::Closed);
}
