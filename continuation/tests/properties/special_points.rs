//! Limit points and branch points are located to rounding.

use crate::systems::{
    circle, cusp, differenced_tank, isola, on_isola, pitchfork, tank, transcritical,
};
use crate::{assert_close, of, steps, trace};
use continuation::Direction::{Decreasing, Increasing};
use continuation::{Branch, DenseSystem, Kind, Options, Point, Predictor, Stop};

/// The weights of the plane of x and λ.
fn euclidean(options: Options) -> Options {
    Options {
        weights: Some(vec![1.0, 1.0]),
        ..options
    }
}

#[test]
fn the_circle_is_closed_and_has_two_limit_points() {
    let options = euclidean(Options::within(-2.0, 2.0));
    let (points, stop) = trace(&mut circle(), &[1.0, 0.0], Increasing, &options);
    let limits = of(&points, Kind::LimitPoint);
    assert_eq!(limits.len(), 2);
    assert_close(&limits[0].z, &[0.0, 1.0], 1e-14);
    assert_close(&limits[1].z, &[0.0, -1.0], 1e-14);
    assert!(matches!(stop, Stop::Closed));
    let last = points.last().unwrap();
    assert_eq!((last.kind, &last.z), (Kind::Closed, &points[0].z));
    assert_close(&[last.arclength], &[std::f64::consts::TAU], 1e-5);
}

#[test]
fn a_limit_point_is_a_start_and_is_labelled_once() {
    let options = euclidean(Options::within(-2.0, 2.0));
    let (points, stop) = trace(&mut circle(), &[0.0, -1.0], Increasing, &options);
    let kinds: Vec<Kind> = points.iter().map(|point| point.kind).collect();
    assert_eq!(kinds[..2], [Kind::Start, Kind::LimitPoint]);
    let limits = of(&points, Kind::LimitPoint);
    assert_eq!(limits.len(), 2);
    assert_close(&limits[1].z, &[0.0, 1.0], 1e-14);
    assert!(matches!(stop, Stop::Closed));
}

#[test]
fn the_cusp_form_has_two_limit_points_or_none() {
    for (mu, count) in [(1.0, 2), (0.01, 2), (-0.1, 0)] {
        let start = [-1.5, -1.5f64.powi(3) + 1.5 * mu];
        let (points, _) = trace(
            &mut cusp(mu),
            &start,
            Increasing,
            &Options::within(-4.0, 4.0),
        );
        let limits = of(&points, Kind::LimitPoint);
        assert_eq!(limits.len(), count, "mu = {mu}");
        for (limit, side) in limits.iter().zip([-1.0, 1.0]) {
            let x = side * (mu / 3.0).sqrt();
            assert_close(&limit.z, &[x, x.powi(3) - mu * x], 1e-13);
        }
    }
}

#[test]
fn two_limit_points_within_one_step_are_found() {
    // They are 2.3e-3 apart in x and 1.5e-9 in λ; steps are a hundred times as long.
    let mu = 4e-6;
    let start = [-1.5, -1.5f64.powi(3) + 1.5 * mu];
    let (points, _) = trace(
        &mut cusp(mu),
        &start,
        Increasing,
        &Options::within(-4.0, 4.0),
    );
    let limits = of(&points, Kind::LimitPoint);
    assert_eq!(limits.len(), 2);
    assert!(steps(&points) < 60);
    let x = (mu / 3.0f64).sqrt();
    assert_close(&[limits[0].z[0], limits[1].z[0]], &[-x, x], 1e-8);
}

#[test]
fn isolas_are_closed_and_have_their_limit_points() {
    for (kappa, folds) in [
        (0.05, [7.639_320_225_002_103, 52.360_679_774_997_9]),
        (0.055, [8.826_026_383_728_287, 37.454_965_351_808_9]),
        (0.06, [11.111_111_111_111_11, 25.0]),
    ] {
        let options = Options::within(1.0, 100.0);
        let (points, stop) = trace(&mut isola(kappa), &on_isola(kappa), Increasing, &options);
        let limits = of(&points, Kind::LimitPoint);
        assert_eq!(limits.len(), 2, "kappa = {kappa}");
        assert_close(&limits[0].z, &[0.5, folds[1]], 1e-12);
        assert_close(&limits[1].z, &[0.5, folds[0]], 1e-12);
        assert!(matches!(stop, Stop::Closed));
    }
}

#[test]
fn the_extremes_of_an_isola_are_events_and_its_length_is_known() {
    let kappa = 0.05;
    let options = euclidean(Options {
        largest_step: 3.0,
        ..Options::within(1.0, 100.0)
    });
    let mut system = isola(kappa);
    // ∂G/∂τ = 0
    let slope = |_: &DenseSystem, point: &Point| {
        let [a, tau] = [point.z[0], point.z[1]];
        a * (1.0 - a) - 2.0 * kappa * (1.0 + kappa * tau)
    };
    let branch = Branch::new(&mut system, &on_isola(kappa), Increasing, &options).unwrap();
    let points: Vec<_> = branch.event(slope).collect();
    let extremes = of(&points, Kind::Event(0));
    assert_eq!(extremes.len(), 2);
    assert_close(&extremes[0].z, &[0.723_606_797_749_979, 20.0], 1e-13);
    assert_close(&extremes[1].z, &[0.276_393_202_250_021, 20.0], 1e-13);
    let length = points.last().unwrap().arclength;
    assert_close(&[length], &[89.479_721_39], 1e-5);
}

/// p₂, then u₁, u₂ and p₁ of the limit points.
const TANKS: [(f64, &[[f64; 3]]); 4] = [
    (14.0, &[]),
    (15.0, &[]),
    (
        17.0,
        &[
            [
                0.378_732_187_481_833_5,
                1.609_611_796_797_792_4,
                0.121_901_160_810_782_91,
            ],
            [
                0.621_267_812_518_166_5,
                2.640_388_203_202_207_6,
                0.117_014_750_426_703_86,
            ],
        ],
    ),
    (
        18.0,
        &[
            [1.0 / 3.0, 1.5, 0.111_565_080_074_214_91],
            [2.0 / 3.0, 3.0, 0.099_574_136_735_727_89],
        ],
    ),
];

#[test]
fn the_stirred_tank_has_its_limit_points() {
    for (p2, exact) in TANKS {
        let options = Options::within(0.0, 0.5);
        for (mut system, tolerance) in [(tank(p2), 1e-12), (differenced_tank(p2), 1e-11)] {
            let (points, stop) = trace(&mut system, &[0.0; 3], Increasing, &options);
            let limits = of(&points, Kind::LimitPoint);
            assert_eq!(limits.len(), exact.len(), "p2 = {p2}");
            for (limit, exact) in limits.iter().zip(exact) {
                assert_close(&limit.z, exact, tolerance);
            }
            assert!(matches!(stop, Stop::Bound { lambda: 0.5 }));
        }
    }
}

#[test]
fn the_stirred_tank_has_a_vertical_inflection_at_the_cusp() {
    // No limit point, two that coincide, or two next to each other by rounding.
    let options = Options::within(0.0, 0.5);
    let (points, stop) = trace(&mut tank(16.0), &[0.0; 3], Increasing, &options);
    let limits = of(&points, Kind::LimitPoint);
    assert!(limits.len().is_multiple_of(2));
    for limit in limits {
        assert_close(&[limit.lambda()], &[(-2.0f64).exp()], 1e-10);
    }
    assert!(matches!(stop, Stop::Bound { .. }));
}

#[test]
fn a_pitchfork_is_met_from_either_branch() {
    let options = Options::within(-1.0, 2.0);
    for (start, direction) in [([0.0, -1.0], Increasing), ([1.0, 1.0], Decreasing)] {
        let (points, _) = trace(&mut pitchfork(0.0), &start, direction, &options);
        let crossings = of(&points, Kind::BranchPoint);
        assert_eq!(crossings.len(), 1);
        assert_close(&crossings[0].z, &[0.0, 0.0], 1e-12);
        assert!(of(&points, Kind::LimitPoint).is_empty());
        let other = crossings[0].other.as_ref().unwrap();
        // The other branch is the parabola from the line, the line from the parabola.
        let along = usize::from(start[0] != 0.0);
        assert!(other[along].abs() > 0.1 && other[1 - along].abs() < 1e-8);
    }
}

#[test]
fn a_transcritical_point_is_met_with_the_direction_of_the_other_line() {
    let options = Options::within(-1.0, 2.0);
    let (points, _) = trace(&mut transcritical(), &[-0.3, -1.0], Increasing, &options);
    let crossings = of(&points, Kind::BranchPoint);
    assert_eq!(crossings.len(), 1);
    assert_close(&crossings[0].z, &[0.3 / 13.0, 1.0 / 13.0], 1e-14);
    let [tangent, other] = [&crossings[0].tangent, crossings[0].other.as_ref().unwrap()];
    assert!((tangent[0] / tangent[1] - 0.3).abs() < 1e-9);
    assert!((other[0] / other[1] + 1.0).abs() < 1e-9);
}

#[test]
fn branch_points_close_together_are_all_found() {
    // x ((λ − a)(λ − b)(λ − c) − x²) = 0 with two branch points in a small part of a step.
    let at = [0.4, 0.43, 1.2];
    let mut system = DenseSystem::new(1, &[0.0], 0, move |x, p, g| {
        g[0] = x[0] * (at.iter().map(|a| p[0] - a).product::<f64>() - x[0] * x[0]);
    });
    let (points, _) = trace(
        &mut system,
        &[0.0, -1.0],
        Increasing,
        &Options::within(-1.0, 2.0),
    );
    let found: Vec<f64> = of(&points, Kind::BranchPoint)
        .iter()
        .map(|p| p.lambda())
        .collect();
    assert_close(&found, &at, 1e-11);
}

#[test]
fn imperfect_pitchforks_are_followed_without_a_label() {
    for imperfection in [1e-3, -1e-3, 1e-6] {
        let mut system = pitchfork(imperfection);
        let options = Options::within(-1.0, 2.0);
        let (points, _) = trace(&mut system, &[0.0, -1.0], Increasing, &options);
        let labelled = points.iter().filter(|point| point.kind != Kind::Regular);
        let kinds: Vec<Kind> = labelled.map(|point| point.kind).collect();
        assert_eq!(kinds, [Kind::Start, Kind::Bound], "{imperfection}");
        // x (λ − x²) has the sign of the imperfection; x has the other one below the parabola.
        let end = points.last().unwrap().z[0];
        assert!(
            (end + 2f64.sqrt().copysign(imperfection)).abs() < 1e-3,
            "{end}"
        );
    }
}

#[test]
fn the_tangent_predicts_the_same_points_in_more_steps() {
    let options = Options::within(0.0, 0.3);
    let plain = Options {
        predictor: Predictor::Tangent,
        ..options.clone()
    };
    let [polynomial, tangent] =
        [options, plain].map(|options| trace(&mut tank(18.0), &[0.0; 3], Increasing, &options).0);
    assert!(steps(&tangent) > steps(&polynomial));
    let [polynomial, tangent] = [&polynomial, &tangent].map(|p| of(p, Kind::LimitPoint));
    assert_eq!((polynomial.len(), tangent.len()), (2, 2));
    for (polynomial, tangent) in polynomial.iter().zip(&tangent) {
        assert_close(&polynomial.z, &tangent.z, 1e-12);
    }
}

#[test]
fn hairpins_are_followed_round_their_tips_and_not_cut_across() {
    for width in [1e-1, 1e-2, 1e-3] {
        // λ = 1 − (x / width)²
        let mut system = DenseSystem::new(1, &[0.0], 0, move |x, p, g| {
            g[0] = p[0] - 1.0 + (x[0] / width).powi(2);
        })
        .with_jacobian(move |x, _, j| j.copy_from_slice(&[2.0 * x[0] / width.powi(2), 1.0]));
        let options = euclidean(Options::within(0.0, 2.0));
        let (points, stop) = trace(&mut system, &[-width, 0.0], Increasing, &options);
        assert!(matches!(stop, Stop::Bound { lambda: 0.0 }), "{stop}");
        assert!(points.windows(2).all(|pair| pair[0].z[0] <= pair[1].z[0]));
        let limits = of(&points, Kind::LimitPoint);
        assert_eq!(limits.len(), 1);
        assert_close(&limits[0].z, &[0.0, 1.0], 1e-13);
        assert_close(&points.last().unwrap().z, &[width, 0.0], 1e-13);
    }
}
