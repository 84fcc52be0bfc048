//! Systems without exact derivatives.

use crate::hidden::assert_evaluated_within_the_bounds;
use crate::{assert_close, finish, of, trace};
use continuation::Direction::{Decreasing, Increasing};
use continuation::{Branch, DenseSystem, Kind, LimitPointCurve, Options, Stop};
use std::sync::{Arc, Mutex};

/// λ = x + height · width · (1 / cosh((x − 1/2) / width)): without and with exact derivatives.
fn bump(height: f64, width: f64) -> [DenseSystem; 2] {
    let plain = DenseSystem::new(1, &[0.0], 0, move |x, p, g| {
        let u = (x[0] - 0.5) / width;
        g[0] = p[0] - x[0] - height * width / u.cosh();
    });
    let exact = plain.clone().with_jacobian(move |x, _, j| {
        let u = (x[0] - 0.5) / width;
        j.copy_from_slice(&[-1.0 + height * u.tanh() / u.cosh(), 1.0]);
    });
    [plain, exact]
}

#[test]
fn limit_points_at_narrow_features_are_found_by_differences() {
    for width in [3e-2, 1e-2, 7e-3, 3e-3] {
        for height in [3.0, 5.0] {
            let found = bump(height, width).map(|mut system| {
                let options = Options {
                    largest_step: width,
                    steps: 10_000,
                    ..Options::within(0.0, 1.0)
                };
                let (points, stop) = trace(&mut system, &[0.2, 0.2], Increasing, &options);
                assert!(matches!(stop, Stop::Bound { .. }), "{stop}");
                let limits = of(&points, Kind::LimitPoint);
                limits.iter().map(|p| p.z[0]).collect::<Vec<f64>>()
            });
            assert_eq!(found[1].len(), 2, "width {width}, height {height}");
            assert_close(&found[0], &found[1], 1e-9);
        }
    }
}

#[test]
fn units_of_any_size_change_nothing_by_differences() {
    let units = [1.0, 1e4, 1e-4, 1e8, 1e-8];
    for (u, v) in units.iter().flat_map(|u| units.map(|v| (*u, v))) {
        // λ = x + sin(4 x)/2
        let mut system = DenseSystem::new(1, &[0.0], 0, move |x, p, g| {
            let (x, lambda) = (x[0] / u, p[0] / v);
            g[0] = lambda - x - 0.5 * (4.0 * x).sin();
        });
        let options = Options::within(0.0, 3.0 * v);
        let (points, stop) = trace(&mut system, &[0.0, 0.0], Increasing, &options);
        assert!(matches!(stop, Stop::Bound { .. }), "{u:e} {v:e}: {stop}");
        let limits = of(&points, Kind::LimitPoint);
        let found: Vec<f64> = limits.iter().map(|point| point.z[0] / u).collect();
        let (first, turn) = ((-0.5f64).acos(), std::f64::consts::TAU);
        let exact = [first, turn - first, turn + first, 2.0 * turn - first].map(|x| 0.25 * x);
        assert_eq!(found.len(), 4, "{u:e} {v:e}");
        assert_close(&found, &exact, 1e-7);
    }
}

#[test]
fn differences_stay_within_the_bounds() {
    assert_evaluated_within_the_bounds(|system, _| system);
}

#[test]
fn a_logarithm_of_the_parameter_is_followed_from_its_edge_to_a_bound() {
    // x = √λ, with G undefined for λ < 0 and beyond 2.
    let mut system = DenseSystem::new(1, &[1.0], 0, |x, p, g| {
        g[0] = if p[0] > 2.0 {
            f64::NAN
        } else {
            x[0] - p[0].sqrt()
        };
    });
    let options = Options::within(1e-6, 2.0);
    let (points, stop) = trace(&mut system, &[1.0, 1.0], Increasing, &options);
    assert!(matches!(stop, Stop::Bound { .. }), "{stop}");
    assert_close(&points[points.len() - 1].z, &[2f64.sqrt(), 2.0], 1e-12);
    let (points, stop) = trace(&mut system, &[1.0, 1.0], Decreasing, &options);
    assert!(matches!(stop, Stop::Bound { .. }), "{stop}");
    assert_close(&points[points.len() - 1].z, &[1e-3, 1e-6], 1e-12);
}

#[test]
fn curves_of_limit_points_stay_within_the_bounds_of_the_second_parameter() {
    // λ + μ x − x³ = 0 has limit points at x = ± √(μ/3).
    let seen = Arc::new(Mutex::new([f64::INFINITY, f64::NEG_INFINITY]));
    for exact in [false, true] {
        let record = Arc::clone(&seen);
        let mut system = DenseSystem::new(1, &[-2.0, 3.0], 0, move |x, p, g| {
            let mut seen = record.lock().unwrap();
            *seen = [seen[0].min(p[1]), seen[1].max(p[1])];
            g[0] = p[0] + p[1] * x[0] - x[0].powi(3);
        });
        if exact {
            system = system.with_jacobian(|x, p, j| {
                j.copy_from_slice(&[p[1] - 3.0 * x[0] * x[0], 1.0, x[0]]);
            });
        }
        let mut curve = LimitPointCurve::new(system.with_second(1), &[1.0, -2.0]).unwrap();
        let start = curve.start(&[1.0, -2.0]);
        let options = Options::within(0.75, 4.0);
        let branch = Branch::new(&mut curve, &start, Decreasing, &options).unwrap();
        *seen.lock().unwrap() = [3.0, 3.0];
        let (points, stop) = finish(branch);
        assert!(matches!(stop, Stop::Bound { .. }), "{stop}");
        assert_close(&points[points.len() - 1].z, &[0.5, -0.25, 0.75], 1e-9);
        let seen = *seen.lock().unwrap();
        assert!(seen[0] >= 0.75 && seen[1] <= 4.0, "{seen:?}");
    }
}

#[test]
fn the_second_parameter_may_have_any_unit() {
    for unit in [1e-8, 1e-4, 1.0, 1e4, 1e8] {
        let system = DenseSystem::new(1, &[-2.0, 3.0 * unit], 0, move |x, p, g| {
            g[0] = p[0] + p[1] / unit * x[0] - x[0].powi(3);
        });
        let mut curve = LimitPointCurve::new(system.with_second(1), &[1.0, -2.0]).unwrap();
        let start = curve.start(&[1.0, -2.0]);
        let options = Options::within(-unit, 4.0 * unit);
        let (points, stop) = trace(&mut curve, &start, Decreasing, &options);
        assert!(matches!(stop, Stop::Bound { .. }), "{unit:e}: {stop}");
        let cusps = of(&points, Kind::Cusp);
        assert_eq!(cusps.len(), 1, "{unit:e}");
        assert_close(&cusps[0].z[..2], &[0.0, 0.0], 1e-7);
        assert!(cusps[0].z[2].abs() < 1e-7 * unit);
    }
}

#[test]
fn noise_spoils_no_differences() {
    for exponent in 9..=13 {
        let amplitude = 10f64.powi(-exponent);
        for phase in [1.0, 2.0, 3.0] {
            // λ = x₁ + sin(3 x₁) and x₂ = x₁².
            let mut system = DenseSystem::new(2, &[0.0], 0, move |x, p, g| {
                let noise = |k: f64| {
                    let wild = (x[0] * 1.1e5 + x[1] * 2.3e5 + p[0] * 3.7e5 + k * phase).sin();
                    amplitude * ((wild * 43_758.545_3).rem_euclid(1.0) - 0.5)
                };
                g[0] = p[0] - x[0] - (3.0 * x[0]).sin() + noise(1.0);
                g[1] = x[1] - x[0] * x[0] + noise(2.0);
            });
            let options = Options::within(-1.0, 4.0);
            let (points, stop) = trace(&mut system, &[0.0; 3], Increasing, &options);
            assert!(
                matches!(stop, Stop::Bound { .. }),
                "{amplitude:e}, {phase}: {stop}"
            );
            assert_eq!(
                of(&points, Kind::LimitPoint).len(),
                4,
                "{amplitude:e}, {phase}"
            );
            assert!(of(&points, Kind::BranchPoint).is_empty());
        }
    }
}
