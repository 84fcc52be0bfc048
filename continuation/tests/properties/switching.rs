//! From a branch to the one that crosses it.

use crate::systems::{circle, pitchfork, transcritical};
use crate::{assert_close, finish, of, trace};
use bvp::Real;
use continuation::Direction::Increasing;
use continuation::{
    Branch, DenseSystem, Differentiable, Error, HalfBranch, Kind, Options, Point, Stop,
};

fn options() -> Options {
    Options::within(-1.0, 2.0)
}

fn branch_point(system: &mut DenseSystem, start: &[f64]) -> Point {
    let (points, _) = trace(system, start, Increasing, &options());
    of(&points, Kind::BranchPoint)[0].clone()
}

#[test]
fn both_halves_of_a_pitchfork_are_followed_to_the_bound() {
    let mut system = pitchfork(0.0);
    let crossing = branch_point(&mut system, &[0.0, -1.0]);
    let side = crossing.other.as_ref().unwrap()[0].signum();
    for (half, side) in [(HalfBranch::Forward, side), (HalfBranch::Backward, -side)] {
        let branch = Branch::switch(&mut system, &crossing, half, &options()).unwrap();
        let (points, stop) = finish(branch);
        assert_eq!(points[0].kind, Kind::Start);
        for point in &points[1..] {
            // λ = x², not the old branch x = 0
            assert!(point.z[0] * side > 0.0);
            assert!((point.lambda() - point.z[0] * point.z[0]).abs() < 1e-8);
        }
        assert_close(&points.last().unwrap().z, &[side * 2f64.sqrt(), 2.0], 1e-14);
        assert!(matches!(stop, Stop::Bound { lambda: 2.0 }));
        assert!(
            points
                .iter()
                .all(|p| matches!(p.kind, Kind::Start | Kind::Regular | Kind::Bound))
        );
    }
}

#[test]
fn both_halves_of_a_transcritical_point_are_followed() {
    let mut system = transcritical();
    let crossing = branch_point(&mut system, &[-0.3, -1.0]);
    let mut ends = Vec::new();
    for half in [HalfBranch::Forward, HalfBranch::Backward] {
        let branch = Branch::switch(&mut system, &crossing, half, &options()).unwrap();
        let (points, _) = finish(branch);
        assert!(points.iter().all(|p| (p.z[0] + p.z[1] - 0.1).abs() < 1e-8));
        ends.push(points.last().unwrap().lambda());
    }
    ends.sort_by(f64::total_cmp);
    assert_eq!(ends, [-1.0, 2.0]);
}

/// x = s u with u (u² + (λ − c)² − r²) = 0 crosses u = 0 at λ = c ± r; the other unknowns are far from zero. Found
/// at s = 170, c = 3.04, r = 0.042: the rate of λ along the other branch, zero but for 1e-9, made the size of x
/// 1e9 and more, and 500 r was accepted for u.
#[test]
fn no_unit_of_a_pitchfork_hides_that_a_point_is_no_solution() {
    let mut closed = 0;
    for (i, scale) in [0.1, 1.0, 10.0, 85.0, 170.0, 1e3].into_iter().enumerate() {
        for (j, radius) in [0.041, 0.15, 0.4, 0.9].into_iter().enumerate() {
            let centre = 2.3 + 0.13 * i as f64 + 0.07 * j as f64;
            let equation = move |x: f64, lambda: f64| {
                let u = x / scale;
                u * (u * u + (lambda - centre).powi(2) - radius * radius)
            };
            let mut system = DenseSystem::new(3, &[0.0], 0, move |x, p, g| {
                let u = x[0] / scale;
                g[0] = equation(x[0], p[0]);
                g[1] = x[1] - 0.7 * u * u - p[0];
                g[2] = x[2] + 1.1 * u * u - 0.4 * p[0];
            });
            let options = Options::within(0.0, 5.0);
            let (points, _) = trace(&mut system, &[0.0; 4], Increasing, &options);
            let crossings = of(&points, Kind::BranchPoint);
            for crossing in crossings {
                for half in [HalfBranch::Forward, HalfBranch::Backward] {
                    let Ok(branch) = Branch::switch(&mut system, crossing, half, &options) else {
                        continue;
                    };
                    let (points, stop) = finish(branch);
                    for point in &points {
                        let miss = equation(point.z[0], point.lambda());
                        assert!(
                            miss.abs() < 1e-6,
                            "s {scale}, r {radius}, {half:?}: {:?} misses by {miss:e}",
                            point.z
                        );
                    }
                    closed += usize::from(matches!(stop, Stop::Closed));
                }
            }
        }
    }
    assert!(closed >= 60, "{closed} of 96 are closed");
}

/// The same loops in units down to 1e-3 of the other unknowns', with exact derivatives. In the size of the others
/// these are needles, on which a step led past the far end onto u = 0: 64 of 96 were closed.
#[test]
fn loops_in_units_smaller_than_those_of_the_others_are_closed() {
    struct Loop {
        scale: f64,
        centre: f64,
        radius: f64,
    }
    impl Differentiable for Loop {
        fn residual<T: Real>(&self, x: &[T], p: &[T], g: &mut [T]) {
            let (u, way) = (x[0] / self.scale, p[0] - self.centre);
            g[0] = u * (u * u + way * way - self.radius * self.radius);
            g[1] = x[1] - u * u * 0.7 - p[0];
            g[2] = x[2] + u * u * 1.1 - p[0] * 0.4;
        }
    }
    let mut closed = 0;
    for (i, scale) in [1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3].into_iter().enumerate() {
        for (j, radius) in [0.15, 0.3, 0.6, 0.9].into_iter().enumerate() {
            let equations = Loop {
                scale,
                centre: 2.3 + 0.13 * i as f64 + 0.07 * j as f64,
                radius,
            };
            let mut system = DenseSystem::exact(3, &[0.0], 0, equations);
            let options = Options::within(0.0, 5.0);
            let (points, _) = trace(&mut system, &[0.0; 4], Increasing, &options);
            for crossing in of(&points, Kind::BranchPoint) {
                for half in [HalfBranch::Forward, HalfBranch::Backward] {
                    let branch = Branch::switch(&mut system, crossing, half, &options);
                    let is_closed = |branch| matches!(finish(branch).1, Stop::Closed);
                    closed += usize::from(branch.is_ok_and(is_closed));
                }
            }
        }
    }
    assert!(closed >= 92, "{closed} of 96 are closed");
}

#[test]
fn a_limit_point_right_behind_a_branch_point_is_found() {
    // x (λ − x − 20 x²) = 0: λ = x + 20 x² turns at x = −1/40, λ = −1/80.
    let mut system = DenseSystem::new(1, &[0.0], 0, |x, p, g| {
        g[0] = x[0] * (p[0] - x[0] - 20.0 * x[0] * x[0]);
    });
    let crossing = branch_point(&mut system, &[0.0, -1.0]);
    let mut limits = Vec::new();
    for half in [HalfBranch::Forward, HalfBranch::Backward] {
        let branch = Branch::switch(&mut system, &crossing, half, &options()).unwrap();
        let (points, stop) = finish(branch);
        assert!(matches!(stop, Stop::Bound { lambda: 2.0 }));
        limits.extend(of(&points, Kind::LimitPoint).into_iter().cloned());
    }
    assert_eq!(limits.len(), 1);
    assert_close(&limits[0].z, &[-1.0 / 40.0, -1.0 / 80.0], 1e-10);
}

#[test]
fn points_without_a_second_branch_are_refused() {
    let (points, _) = trace(
        &mut circle(),
        &[1.0, 0.0],
        Increasing,
        &Options::within(-2.0, 2.0),
    );
    let limit = of(&points, Kind::LimitPoint)[0];
    let error = Branch::switch(&mut circle(), limit, HalfBranch::Forward, &options()).err();
    assert!(matches!(error, Some(Error::NoSecondBranch)));
}

#[test]
fn a_direction_without_a_branch_is_refused() {
    // A branch point whose other direction is not one of the second branch: as good as none.
    let mut system = pitchfork(0.0);
    let mut crossing = branch_point(&mut system, &[0.0, -1.0]);
    let [parallel, tangent] = [crossing.other.clone().unwrap(), crossing.tangent.clone()];
    let between = |share: f64| -> Vec<f64> {
        parallel
            .iter()
            .zip(&tangent)
            .map(|(a, b)| (1.0 - share) * a + share * b)
            .collect()
    };
    crossing.other = Some(between(0.5));
    let error = Branch::switch(&mut system, &crossing, HalfBranch::Forward, &options()).err();
    assert!(matches!(error, Some(Error::Switch { .. })), "{error:?}");
    // Slightly off it is found all the same.
    crossing.other = Some(between(0.1));
    let branch = Branch::switch(&mut system, &crossing, HalfBranch::Forward, &options()).unwrap();
    let (points, _) = finish(branch);
    assert!((points.last().unwrap().z[0].abs() - 2f64.sqrt()).abs() < 1e-12);
}

#[test]
fn a_branch_goes_straight_on_from_a_branch_point() {
    let mut system = pitchfork(0.0);
    let crossing = branch_point(&mut system, &[0.0, -1.0]);
    let (points, _) = finish(Branch::resume(&mut system, &crossing, &options()).unwrap());
    assert!(points.iter().all(|point| point.z[0].abs() < 1e-12));
    assert_eq!(points.last().unwrap().lambda(), 2.0);
    assert!(of(&points, Kind::BranchPoint).is_empty());
}

#[test]
fn every_half_of_two_coupled_modes_is_followed_with_either_derivatives() {
    let residual = |x: &[f64], p: &[f64], g: &mut [f64]| {
        g[0] = x[0] * (p[0] - x[0] * x[0] - 2.0 * x[1] * x[1]);
        g[1] = x[1] * (p[0] - 0.5 - x[1] * x[1] - 0.5 * x[0] * x[0]);
    };
    let plain = DenseSystem::new(2, &[0.0], 0, residual);
    let exact = plain.clone().with_jacobian(|x, p, j| {
        let (a, b) = (x[0] * x[0], x[1] * x[1]);
        let first = [p[0] - 3.0 * a - 2.0 * b, -4.0 * x[0] * x[1], x[0]];
        let second = [-x[0] * x[1], p[0] - 0.5 - 3.0 * b - 0.5 * a, x[1]];
        j[..3].copy_from_slice(&first);
        j[3..].copy_from_slice(&second);
    });
    let options = Options::within(-1.0, 2.0);
    for mut system in [plain, exact] {
        let (points, _) = trace(&mut system, &[0.0, 0.0, -1.0], Increasing, &options);
        let crossings: Vec<Point> = of(&points, Kind::BranchPoint)
            .into_iter()
            .cloned()
            .collect();
        assert_eq!(crossings.len(), 2);
        for crossing in &crossings {
            for half in [HalfBranch::Forward, HalfBranch::Backward] {
                let branch = Branch::switch(&mut system, crossing, half, &options).unwrap();
                let (points, stop) = finish(branch);
                assert!(matches!(stop, Stop::Bound { lambda: 2.0 }), "{stop}");
                // Both meet the branch of mixed modes at λ = 1.
                let again = of(&points, Kind::BranchPoint);
                assert_eq!(again.len(), 1);
                assert!((again[0].lambda() - 1.0).abs() < 1e-9);
            }
        }
    }
}
