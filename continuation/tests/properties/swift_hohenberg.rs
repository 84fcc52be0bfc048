//! The trivial branch of the Swift-Hohenberg equation, with branch points in dense succession.

use crate::{of, trace};
use continuation::Direction::Increasing;
use continuation::{Kind, Options, SparseSystem, Stop};
use std::f64::consts::PI;

/// 0 = λ u − (1 + d²/dx²)² u − u³ on 0 ≤ x ≤ L with u = u'' = 0 at both ends, by differences at these
/// interior points.
fn swift_hohenberg(points: usize, length: f64) -> SparseSystem {
    let square = (length / (points + 1) as f64).powi(-2);
    // 1 + d²/dx², applied twice.
    let apply = move |u: &[f64]| -> Vec<f64> {
        let at = |i: Option<usize>| i.and_then(|i| u.get(i)).copied().unwrap_or(0.0);
        let place = |i: usize| {
            let ends = at(i.checked_sub(1)) + at(Some(i + 1));
            u[i] + square * (ends - 2.0 * u[i])
        };
        (0..points).map(place).collect()
    };
    let residual = move |u: &[f64], p: &[f64], g: &mut [f64]| {
        for ((g, operator), u) in g.iter_mut().zip(apply(&apply(u))).zip(u) {
            *g = p[0] * u - operator - u.powi(3);
        }
    };
    let (centre, side) = (1.0 - 2.0 * square, square);
    SparseSystem::new(points, &[0.0], 0, residual, move |u, p, put| {
        for (i, u) in u.iter().enumerate() {
            let ends = [i > 0, i + 1 < points]
                .iter()
                .filter(|inside| **inside)
                .count();
            let operator = centre * centre + ends as f64 * side * side;
            put(i, i, p[0] - operator - 3.0 * u * u);
            put(i, points, *u);
            for (shift, value) in [(1, 2.0 * centre * side), (2, side * side)] {
                if i >= shift {
                    put(i, i - shift, -value);
                    put(i - shift, i, -value);
                }
            }
        }
    })
    .with_groups(&vec![0; points])
}

/// The eigenvalues (1 − 4/h² sin²(kπh/2L))² of the operator between bounds, in order.
fn eigenvalues(points: usize, length: f64, [low, high]: [f64; 2]) -> Vec<f64> {
    let h = length / (points + 1) as f64;
    let eigenvalue = |k: usize| {
        let sine = (0.5 * k as f64 * PI * h / length).sin();
        (1.0 - (2.0 / h * sine).powi(2)).powi(2)
    };
    let all = (1..=points).map(eigenvalue);
    let mut inside: Vec<f64> = all.filter(|value| (low..high).contains(value)).collect();
    inside.sort_by(f64::total_cmp);
    inside
}

/// The branch points found, those there are, and the number of points.
fn branch_points(points: usize, length: f64, bounds: [f64; 2]) -> (Vec<f64>, Vec<f64>, usize) {
    let mut system = swift_hohenberg(points, length);
    let mut start = vec![0.0; points + 1];
    start[points] = bounds[0];
    let options = Options::within(bounds[0], bounds[1]);
    let (all, stop) = trace(&mut system, &start, Increasing, &options);
    assert!(matches!(stop, Stop::Bound { .. }), "{stop}");
    let found = of(&all, Kind::BranchPoint);
    let found = found.iter().map(|point| point.lambda()).collect();
    (found, eigenvalues(points, length, bounds), all.len())
}

/// How many branch points are missed on the lengths from 20 to 59, how many there are, and the number of
/// points.
fn survey() -> [usize; 3] {
    let (mut missed, mut all, mut steps) = (0, 0, 0);
    for i in 0..40 {
        let length = 20.0 + f64::from(i);
        let (found, exact, count) = branch_points(100, length, [-0.1, 0.9]);
        let near = |value: &&f64| found.iter().any(|found| (found - **value).abs() < 1e-6);
        assert!(
            found
                .iter()
                .all(|found| exact.iter().any(|value| (found - value).abs() < 1e-6))
        );
        missed += exact.len() - exact.iter().filter(near).count();
        all += exact.len();
        steps += count;
    }
    [missed, all, steps]
}

/// Measured: none missed.
#[test]
fn nearly_every_branch_point_of_the_trivial_branch_is_found() {
    let [missed, all, steps] = survey();
    println!("{missed} of {all} missed, {steps} points");
    assert!(missed <= 2, "{missed} of {all}");
}

/// Measured: all 49 found. Before the second null vector was followed, 26 of 43 were missed.
#[test]
#[ignore = "2000 unknowns"]
fn nearly_every_branch_point_of_a_long_interval_is_found() {
    let (found, exact, _) = branch_points(2000, 200.0, [-0.1, 0.5]);
    println!("{} of {}", found.len(), exact.len());
    let near = |value: &&f64| found.iter().any(|found| (found - **value).abs() < 1e-6);
    let missed: Vec<&f64> = exact.iter().filter(|value| !near(value)).collect();
    println!("missed: {missed:?}");
    assert!(missed.len() <= 2);
}
