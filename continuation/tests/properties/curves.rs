//! Curves of limit points and of branch points in two parameters.

use crate::systems::{cusp, differenced_tank, isola, tank};
use crate::{assert_close, finish, of, trace};
use continuation::Direction::{Decreasing, Increasing};
use continuation::{
    Branch, BranchPointCurve, DenseSystem, Difficulty, Error, Kind, LimitPointCurve, Options, Stop,
};

#[test]
fn the_cusp_form_has_one_cusp_and_the_limit_points_lie_on_its_curve() {
    let first = [1.0, -2.0];
    let mut curve = LimitPointCurve::new(cusp(3.0), &first).unwrap();
    let start = curve.start(&first);
    let options = Options {
        targets: vec![2.0],
        ..Options::within(-1.0, 4.0)
    };
    let (points, stop) = trace(&mut curve, &start, Decreasing, &options);
    for point in &points {
        // x, then λ = −2 x³ and μ = 3 x²
        let x = point.z[0];
        assert_close(&point.z, &[x, -2.0 * x.powi(3), 3.0 * x * x], 1e-8);
    }
    let cusps = of(&points, Kind::Cusp);
    assert_eq!(cusps.len(), 1);
    assert_close(&cusps[0].z, &[0.0, 0.0, 0.0], 1e-10);
    assert!(of(&points, Kind::LimitPoint).is_empty());
    let targets = of(&points, Kind::Target);
    let x = (2.0f64 / 3.0).sqrt();
    assert_close(&targets[0].z, &[x, -2.0 * x.powi(3), 2.0], 1e-12);
    assert_close(&targets[1].z, &[-x, 2.0 * x.powi(3), 2.0], 1e-12);
    assert!(matches!(stop, Stop::Bound { lambda: 4.0 }));
}

#[test]
fn the_limit_points_of_the_stirred_tank_meet_in_a_cusp() {
    let first = [1.0 / 3.0, 1.5, 0.5 * (-1.5f64).exp()];
    for (system, tolerance) in [(tank(18.0), 1e-9), (differenced_tank(18.0), 1e-8)] {
        let mut curve = LimitPointCurve::new(system, &first).unwrap();
        let start = curve.start(&first);
        let options = Options {
            targets: vec![17.0],
            ..Options::within(10.0, 20.0)
        };
        let (points, _) = trace(&mut curve, &start, Decreasing, &options);
        let cusps = of(&points, Kind::Cusp);
        assert_eq!(cusps.len(), 1);
        assert_close(&cusps[0].z, &[0.5, 2.0, (-2.0f64).exp(), 16.0], tolerance);
        let targets = of(&points, Kind::Target);
        assert_close(
            &[targets[0].z[2], targets[1].z[2]],
            &[0.121_901_160_810_782_91, 0.117_014_750_426_703_86],
            1e-11,
        );
        assert_eq!(targets[0].lambda().to_bits(), 17f64.to_bits());
    }
}

#[test]
fn an_isola_is_born_at_an_extreme_of_its_limit_points() {
    let first = [0.5, 7.639_320_225_002_103];
    let mut curve = LimitPointCurve::new(isola(0.05), &first).unwrap();
    let start = curve.start(&first);
    let options = Options::within(0.01, 0.1);
    let (points, stop) = trace(&mut curve, &start, Increasing, &options);
    let births = of(&points, Kind::LimitPoint);
    assert_eq!(births.len(), 1);
    assert_close(&[births[0].lambda()], &[1.0 / 16.0], 1e-13);
    assert_close(&births[0].z, &[0.5, 16.0, 1.0 / 16.0], 1e-9);
    assert!(of(&points, Kind::Cusp).is_empty());
    for point in &points {
        let tau = point.z[1];
        assert!((point.lambda() - (0.5 * tau.sqrt() - 1.0) / tau).abs() < 1e-9);
    }
    assert!(matches!(stop, Stop::Bound { lambda: 0.01 }));
}

#[test]
fn the_limit_points_need_not_be_near_the_given_point() {
    // From a point off the limit point by a few percent: the start of the curve is corrected.
    let first = [1.03, -1.95];
    let mut curve = LimitPointCurve::new(cusp(3.0), &first).unwrap();
    let start = curve.start(&first);
    let (points, _) = trace(&mut curve, &start, Increasing, &Options::within(-1.0, 4.0));
    assert_close(&points[0].z, &[1.0, -2.0, 3.0], 1e-12);
}

/// x₁ (λ − μ² − x₁²) = 0, x₂ = λ x₁: branch points at λ = μ².
fn two_branches() -> DenseSystem {
    DenseSystem::new(2, &[0.25, 0.5], 0, |x, p, g| {
        g[0] = x[0] * (p[0] - p[1] * p[1] - x[0] * x[0]);
        g[1] = x[1] - p[0] * x[0];
    })
    .with_second(1)
}

#[test]
fn branch_points_are_followed_in_two_parameters() {
    let first = [0.0, 0.0, 0.25];
    let mut curve = BranchPointCurve::new(two_branches(), &first).unwrap();
    let start = curve.start(&first);
    let options = Options {
        targets: vec![0.8],
        ..Options::within(-1.0, 1.0)
    };
    for direction in [Increasing, Decreasing] {
        let (points, stop) = trace(&mut curve, &start, direction, &options);
        for point in &points {
            let mu = point.lambda();
            assert_close(&point.z, &[0.0, 0.0, mu * mu, 0.0, mu], 1e-8);
        }
        assert!(matches!(stop, Stop::Bound { .. }), "{stop}");
        let targets = of(&points, Kind::Target);
        assert_eq!(targets.len(), usize::from(direction == Increasing));
        for target in targets {
            assert_close(&target.z, &[0.0, 0.0, 0.64, 0.0, 0.8], 1e-11);
        }
    }
}

#[test]
fn branch_points_that_do_not_persist_end_the_curve() {
    // μ breaks the pitchfork at λ = 0.
    let system = DenseSystem::new(2, &[0.0, 0.0], 0, |x, p, g| {
        g[0] = x[0] * (p[0] - x[0] * x[0]) + p[1];
        g[1] = x[1] - x[0];
    });
    let first = [0.0; 3];
    let mut curve = BranchPointCurve::new(system.with_second(1), &first).unwrap();
    let start = curve.start(&first);
    let options = Options::within(-1.0, 1.0);
    match Branch::new(&mut curve, &start, Increasing, &options) {
        // The saddle goes on and is recognised as none, or there is no curve at all.
        Ok(branch) => {
            let (points, stop) = finish(branch);
            let Stop::StepTooSmall { difficulty, .. } = stop else {
                panic!("{stop}")
            };
            assert!(
                matches!(difficulty, Difficulty::Adaptation(_)),
                "{difficulty}"
            );
            assert!(points.len() <= 2);
        }
        Err(error) => assert!(
            matches!(error, Error::Start(_) | Error::SingularStart),
            "{error}"
        ),
    }
}
