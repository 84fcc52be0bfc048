//! Branch points beside kinks of G, where its equations switch, and beside limit points, and a start beside a bend.

use crate::systems::pitchfork;
use crate::{assert_close, of, trace};
use continuation::Direction::{Decreasing, Increasing};
use continuation::{Branch, DenseSystem, Kind, Options};

/// The positive part of u and its derivative.
fn positive(u: f64) -> [f64; 2] {
    if u > 0.0 { [u, 1.0] } else { [0.0, 0.0] }
}

/// x (λ + k (u⁺ − u₀⁺) − x²) = 0 with a kink where u = a x + b λ − d is zero: a pitchfork at the origin, where u is
/// u₀.
fn switched([a, b]: [f64; 2], d: f64, k: f64) -> [DenseSystem; 2] {
    let offset = positive(-d)[0];
    let plain = DenseSystem::new(1, &[0.0], 0, move |x, p, g| {
        let bend = positive(a * x[0] + b * p[0] - d)[0] - offset;
        g[0] = x[0] * (p[0] + k * bend - x[0] * x[0]);
    });
    let exact = plain.clone().with_jacobian(move |x, p, j| {
        let [u, slope] = positive(a * x[0] + b * p[0] - d);
        let square = x[0] * x[0];
        j[0] = p[0] + k * (u - offset) - 3.0 * square + k * a * slope * x[0];
        j[1] = x[0] * (1.0 + k * b * slope);
    });
    [plain, exact]
}

#[test]
fn branch_points_beside_a_kink_are_located_with_both_directions() {
    let distances = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 3e-6];
    let distances = distances.into_iter().flat_map(|d| [d, -d]);
    for (d, k) in distances.flat_map(|d| [1.0, 10.0, 1e3].map(|k| (d, k))) {
        for across in [[0.0, 1.0], [1.0, 0.0], [1.0, 1.0]] {
            for (exact, mut system) in [false, true].into_iter().zip(switched(across, d, k)) {
                let options = Options::within(-1.0, 2.0);
                let (points, _) = trace(&mut system, &[0.0, -1.0], Increasing, &options);
                let crossings = of(&points, Kind::BranchPoint);
                assert_eq!(crossings.len(), 1, "{across:?}, d = {d:e}, k = {k}");
                assert!(!crossings[0].approximate);
                let [x, lambda] = crossings[0].z[..] else {
                    unreachable!("two unknowns")
                };
                assert!(
                    x.abs() < 1e-9 && lambda.abs() < 1e-9,
                    "{across:?}, d = {d:e}, k = {k}: {lambda:e}"
                );
                if !exact && d.abs() < 1e-4 {
                    // The Jacobian by differences does not resolve a kink so close.
                    continue;
                }
                // On the side of the branch point d λ = −k du⁺ along the other branch.
                let slope = if d < 0.0 { k } else { 0.0 };
                let rate = -slope * across[0] / (1.0 + slope * across[1]);
                let other = crossings[0].other.as_ref().unwrap();
                assert_close(&[other[1] / other[0]], &[rate], 1e-6);
            }
        }
    }
}

/// λ = 1 − x₁² with a pitchfork of x₂ at x₁ = c.
fn turning(c: f64) -> DenseSystem {
    DenseSystem::new(2, &[0.0], 0, move |x, p, g| {
        g[0] = p[0] - 1.0 + x[0] * x[0];
        g[1] = x[1] * (x[0] - c - x[1] * x[1]);
    })
}

#[test]
fn limit_points_beside_a_branch_point_are_found() {
    for c in [1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 3e-8]
        .map(|c| [c, -c])
        .as_flattened()
    {
        let options = Options::within(0.0, 2.0);
        let start = [-1.0, 0.0, 0.0];
        let (points, _) = trace(&mut turning(*c), &start, Increasing, &options);
        let labelled = [Kind::LimitPoint, Kind::BranchPoint].map(|kind| of(&points, kind));
        assert_eq!(labelled.each_ref().map(Vec::len), [1, 1], "c = {c:e}");
        let [limit, crossing] = labelled.map(|points| points[0]);
        assert!(!limit.approximate && !crossing.approximate);
        assert!(limit.z[0].abs() < 1e-9 && (crossing.z[0] - c).abs() < 1e-10);
        assert_eq!(limit.arclength < crossing.arclength, *c > 0.0, "c = {c:e}");
    }
}

#[test]
fn a_branch_that_turns_at_a_pitchfork_has_no_limit_point_there() {
    for amplitude in [0.0, 1e-15, 1e-14, 1e-13] {
        for phase in 0..10 {
            let mut system = DenseSystem::new(1, &[0.0], 0, move |x, p, g| {
                let wild = x[0] * 12_345.678 + p[0] * 9_876.54 + f64::from(phase);
                let noise = (wild.sin() * 43_758.545_3).rem_euclid(1.0) - 0.5;
                g[0] = x[0] * (p[0] - x[0] * x[0] + amplitude * noise);
            });
            let options = Options::within(-1.0, 2.0);
            let (points, _) = trace(&mut system, &[1.0, 1.0], Decreasing, &options);
            let labelled = [Kind::LimitPoint, Kind::BranchPoint].map(|kind| of(&points, kind));
            let counts = labelled.each_ref().map(Vec::len);
            assert_eq!(counts, [0, 1], "{amplitude:e}, phase {phase}");
        }
    }
    let options = Options::within(-1.0, 2.0);
    let (points, _) = trace(&mut pitchfork(0.0), &[1.0, 1.0], Decreasing, &options);
    assert!(of(&points, Kind::LimitPoint).is_empty());
}

#[test]
fn a_start_is_exact_where_the_jacobian_changes_on_its_last_steps() {
    // Steps by the Jacobian of the guess did not contract in the end, and were taken for rounding at 1.4e-9.
    let width = 1e-9;
    let mut system = DenseSystem::new(1, &[0.0], 0, move |x, p, g| {
        let from = x[0] - 1.0;
        g[0] = from + 1.5 * width * (from / width).tanh() - p[0];
    })
    .with_jacobian(move |x, _, j| {
        j[0] = 1.0 + 1.5 / ((x[0] - 1.0) / width).cosh().powi(2);
        j[1] = -1.0;
    });
    let options = Options::within(-1.0, 1.0);
    let mut branch = Branch::new(&mut system, &[1.0005, 0.0], Increasing, &options).unwrap();
    let first = branch.next().unwrap();
    assert!((first.z[0] - 1.0).abs() < 1e-15, "{:e}", first.z[0] - 1.0);
}
