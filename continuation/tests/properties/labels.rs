//! Targets, bounds and events.

use crate::systems::{circle, cusp, tank};
use crate::{assert_close, finish, of, trace};
use continuation::Direction::{Decreasing, Increasing};
use continuation::{Branch, DenseSystem, Kind, Options, Predictor, Stop};

/// A parabola λ = 1 − x².
fn parabola() -> DenseSystem {
    DenseSystem::new(1, &[0.0], 0, |x, p, g| g[0] = p[0] - 1.0 + x[0] * x[0])
        .with_jacobian(|x, _, j| j.copy_from_slice(&[2.0 * x[0], 1.0]))
}

#[test]
fn targets_are_hit_exactly_as_often_as_they_are_passed() {
    let targets = vec![0.1, 0.1 + 1e-10, 1.0 / 3.0, 0.9];
    let options = Options {
        targets: targets.clone(),
        ..Options::within(0.0, 2.0)
    };
    let (points, _) = trace(&mut parabola(), &[-1.0, 0.0], Increasing, &options);
    let found = of(&points, Kind::Target);
    let expected: Vec<f64> = targets
        .iter()
        .chain(targets.iter().rev())
        .copied()
        .collect();
    assert_eq!(found.len(), expected.len());
    for (i, (point, target)) in found.iter().zip(expected).enumerate() {
        assert_eq!(point.lambda().to_bits(), target.to_bits());
        let x = (1.0 - target).sqrt();
        assert_close(&[point.z[0]], &[if i < 4 { -x } else { x }], 1e-13);
    }
}

#[test]
fn a_target_on_both_sides_of_a_limit_point_within_one_step_is_met_twice() {
    let options = Options {
        targets: vec![1.0 - 1e-8],
        largest_step: 0.3,
        first_step: 0.3,
        ..Options::within(0.0, 2.0)
    };
    let (points, _) = trace(&mut parabola(), &[-0.3, 0.91], Increasing, &options);
    let kinds: Vec<Kind> = points.iter().map(|point| point.kind).collect();
    let at = kinds.iter().position(|kind| *kind == Kind::Target).unwrap();
    assert_eq!(
        kinds[at..at + 3],
        [Kind::Target, Kind::LimitPoint, Kind::Target]
    );
    assert_close(
        &[points[at].z[0], points[at + 2].z[0]],
        &[-1e-4, 1e-4],
        1e-12,
    );
    assert!(points[at].arclength < points[at + 1].arclength);
}

#[test]
fn a_target_at_a_limit_point_is_met_there() {
    let options = Options {
        targets: vec![1.0],
        ..Options::within(0.0, 2.0)
    };
    let (points, stop) = trace(&mut parabola(), &[-1.0, 0.0], Increasing, &options);
    assert_eq!(of(&points, Kind::LimitPoint).len(), 1);
    let targets = of(&points, Kind::Target);
    assert!(!targets.is_empty() && targets.len() <= 2);
    for target in targets {
        assert_eq!(target.lambda(), 1.0);
        assert!(target.z[0].abs() < 1e-7);
    }
    assert!(matches!(stop, Stop::Bound { lambda: 0.0 }));
}

#[test]
fn bounds_are_landed_on_exactly() {
    for bound in [0.25, 0.7, 1.0 / 3.0] {
        let options = Options {
            targets: vec![bound],
            ..Options::within(-0.5, bound)
        };
        let (points, stop) = trace(&mut tank(15.0), &[0.0; 3], Increasing, &options);
        let last = points.last().unwrap();
        assert_eq!(
            (last.kind, last.lambda().to_bits()),
            (Kind::Bound, bound.to_bits())
        );
        assert!(matches!(stop, Stop::Bound { lambda } if lambda == bound));
        let targets = of(&points, Kind::Target);
        assert_eq!(targets.len(), 1);
        assert_close(&targets[0].z, &last.z, 1e-13);
    }
}

#[test]
fn a_start_on_a_bound_is_left_inwards_or_not_at_all() {
    let options = Options::within(0.0, 0.5);
    let (points, stop) = trace(&mut parabola(), &[-1.0, 0.0], Decreasing, &options);
    assert_eq!(points.len(), 1);
    assert!(matches!(stop, Stop::Bound { lambda: 0.0 }));
    let (points, stop) = trace(&mut parabola(), &[-1.0, 0.0], Increasing, &options);
    assert!(points.len() > 2);
    assert!(matches!(stop, Stop::Bound { lambda: 0.5 }));
}

#[test]
fn a_circle_between_its_own_limit_points_as_bounds_ends_well() {
    let (points, stop) = trace(
        &mut circle(),
        &[1.0, 0.0],
        Increasing,
        &Options::within(-1.0, 1.0),
    );
    assert!(matches!(stop, Stop::Closed | Stop::Bound { .. }), "{stop}");
    assert!(
        points
            .iter()
            .all(|p| (p.z[0].hypot(p.z[1]) - 1.0).abs() < 1e-8)
    );
}

#[test]
fn events_are_zeros_of_their_functions_and_nothing_else() {
    let mut system = cusp(-1.0);
    let options = Options::within(-2.0, 2.0);
    let branch = Branch::new(&mut system, &[-1.0, -2.0], Increasing, &options)
        .unwrap()
        .event(|_, point| point.z[0] - 0.3)
        .event(|_, _| 0.0)
        .event(|_, point| 1.0 / (point.z[0] - 0.1))
        .event(|_, point| match point.z[0] {
            x if x < 0.2 => f64::NAN,
            x => x - 0.5,
        })
        .event(|_, point| (point.z[0] - 0.123).ln())
        .event(|_, point| (point.z[0] + 0.4).signum());
    let (points, stop) = finish(branch);
    assert!(matches!(stop, Stop::Bound { lambda: 2.0 }));
    let events: Vec<(Kind, f64)> = points
        .iter()
        .filter(|point| matches!(point.kind, Kind::Event(_)))
        .map(|point| (point.kind, point.z[0]))
        .collect();
    let expected = [(5, -0.4), (0, 0.3), (3, 0.5)];
    assert_eq!(events.len(), expected.len(), "{events:?}");
    for ((kind, x), (index, exact)) in events.iter().zip(expected) {
        assert_eq!(*kind, Kind::Event(index));
        assert!((x - exact).abs() < 1e-13);
    }
}

#[test]
fn events_of_the_tangent_and_the_arclength_are_met_to_rounding() {
    // λ = 1 − x² has the slope −2x. Steps this short keep the linearisation of the predicted point, and
    // wherever a node lies an event lies near it.
    let places: Vec<f64> = (-180..=180).map(|i| f64::from(i) / 200.0).collect();
    let options = Options {
        weights: Some(vec![1.0; 2]),
        largest_step: 0.04,
        predictor: Predictor::Tangent,
        ..Options::within(0.0, 2.0)
    };
    let mut system = parabola();
    let mut branch = Branch::new(&mut system, &[-1.0, 0.0], Increasing, &options).unwrap();
    for &x in &places {
        branch = branch.event(move |_, point| point.tangent[1] + 2.0 * x * point.tangent[0]);
    }
    branch = branch.event(|_, point| point.arclength - 1.5);
    let (points, _) = finish(branch);
    for (index, &x) in places.iter().enumerate() {
        let [event] = of(&points, Kind::Event(index))[..] else {
            panic!("one place with this slope");
        };
        assert_close(&event.z, &[x, 1.0 - x * x], 1e-11);
    }
    let [event] = of(&points, Kind::Event(places.len()))[..] else {
        panic!("one place at this arclength");
    };
    assert_close(&[event.arclength], &[1.5], 1e-12);
}

#[test]
fn labelled_points_of_a_step_come_in_order() {
    let options = Options {
        targets: vec![0.3, 0.5, 0.7],
        first_step: 0.2,
        ..Options::within(0.0, 2.0)
    };
    let mut system = parabola();
    let branch = Branch::new(&mut system, &[-1.0, 0.0], Increasing, &options)
        .unwrap()
        .event(|_, point| point.z[1] - 0.4)
        .event(|_, point| point.z[0] + 0.6);
    let (points, _) = finish(branch);
    assert!(
        points
            .windows(2)
            .all(|pair| pair[0].arclength <= pair[1].arclength)
    );
    assert!(points.windows(2).all(|pair| pair[0].z[0] <= pair[1].z[0]));
    assert_eq!(of(&points, Kind::Event(0)).len(), 2);
    assert_eq!(of(&points, Kind::Event(1)).len(), 1);
}
