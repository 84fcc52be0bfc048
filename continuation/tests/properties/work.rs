//! What a branch costs.

use crate::bratu::bratu;
use crate::counting::{Counting, Counts};
use crate::systems::{tank, transcritical};
use crate::{assert_close, of, steps};
use continuation::Direction::Increasing;
use continuation::{Branch, DenseSystem, Kind, Options, Point, System};

/// The limit points of the differences with 9, 39, 99 and 399 interior points.
const DIFFERENCES: [(usize, f64); 4] = [
    (9, 3.495_493_294_28),
    (39, 3.512_687_939_5),
    (99, 3.513_647_903_97),
    (399, 3.513_819_293_51),
];
/// That of the differential equation.
const EXACT: f64 = 3.513_830_719_125_161;

fn limit_point(points: usize) -> (Point, usize) {
    let mut system = bratu(points);
    let start = vec![0.0; points + 1];
    let branch = Branch::new(&mut system, &start, Increasing, &Options::within(0.0, 4.0)).unwrap();
    let mut passed = Vec::new();
    for point in branch {
        let arrived = point.kind == Kind::LimitPoint;
        passed.push(point);
        if arrived {
            break;
        }
    }
    let steps = steps(&passed) + 1;
    (passed.pop().unwrap(), steps)
}

#[test]
fn the_limit_points_of_the_differences_are_found() {
    for (points, lambda) in DIFFERENCES {
        assert_close(&[limit_point(points).0.lambda()], &[lambda], 1e-11);
    }
}

#[test]
fn many_points_take_no_more_steps_and_lose_no_digits() {
    let (point, steps) = limit_point(999);
    assert!(steps <= 15, "{steps} steps");
    // The error of the differences is a series in h²: three of its terms from the meshes above.
    let square = |points: usize| ((points + 1) as f64).powi(-2);
    let nodes: Vec<(f64, f64)> = DIFFERENCES[1..]
        .iter()
        .map(|&(points, lambda)| (square(points), (lambda - EXACT) / square(points)))
        .collect();
    let h = square(999);
    let interpolated: f64 = (0..nodes.len())
        .map(|i| {
            let others = (0..nodes.len()).filter(|&j| j != i);
            let basis = others.map(|j| (h - nodes[j].0) / (nodes[i].0 - nodes[j].0));
            nodes[i].1 * basis.product::<f64>()
        })
        .sum();
    assert_close(&[point.lambda()], &[EXACT + h * interpolated], 1e-10);
}

/// Counts per step over a stretch without labelled points.
fn work<S: System>(system: S, start: &[f64], options: &Options) -> (Counts, usize) {
    let mut system = Counting::new(system);
    let mut branch = Branch::new(&mut system, start, Increasing, options).unwrap();
    branch.next();
    let before = branch.system().counts;
    let points: Vec<Point> = branch.by_ref().collect();
    assert!(
        points
            .iter()
            .all(|p| matches!(p.kind, Kind::Regular | Kind::Bound))
    );
    let after = branch.system().counts;
    let counts = Counts {
        residuals: after.residuals - before.residuals,
        linearisations: after.linearisations - before.linearisations,
        solutions: after.solutions - before.solutions,
        ..after
    };
    (counts, steps(&points))
}

#[test]
fn a_step_takes_about_one_linearisation() {
    let points = 999;
    let start = vec![0.0; points + 1];
    let (counts, steps) = work(bratu(points), &start, &Options::within(0.0, 3.4));
    println!("bratu: {steps} steps, {counts:?}");
    assert!(
        counts.linearisations <= 2 * steps,
        "{counts:?} in {steps} steps"
    );
    assert!(counts.residuals <= 4 * steps, "{counts:?} in {steps} steps");
    let (counts, steps) = work(tank(14.0), &[0.0; 3], &Options::within(0.0, 0.5));
    println!("tank: {steps} steps, {counts:?}");
    assert!(
        counts.linearisations <= 2 * steps,
        "{counts:?} in {steps} steps"
    );
    assert!(counts.residuals <= 4 * steps, "{counts:?} in {steps} steps");
}

#[test]
fn a_limit_point_takes_a_few_linearisations() {
    let passed = |high: f64| {
        let mut system = Counting::new(tank(18.0));
        let branch = Branch::new(
            &mut system,
            &[0.0; 3],
            Increasing,
            &Options::within(0.0, high),
        );
        let points: Vec<Point> = branch.unwrap().collect();
        (
            of(&points, Kind::LimitPoint).len(),
            steps(&points),
            system.counts,
        )
    };
    let (limits, steps, counts) = passed(0.3);
    println!("tank: {limits} limit points, {steps} steps, {counts:?}");
    assert_eq!(limits, 2);
    assert!(counts.linearisations <= 2 * steps + 15 * limits);
}

#[test]
fn limit_points_to_a_location_take_less_work_and_have_their_lambda_to_its_square() {
    let located = |location: f64| {
        let mut system = Counting::new(tank(18.0));
        let options = Options {
            location,
            ..Options::within(0.0, 0.3)
        };
        let branch = Branch::new(&mut system, &[0.0; 3], Increasing, &options);
        let points: Vec<Point> = branch.unwrap().collect();
        let limits = of(&points, Kind::LimitPoint);
        let lambdas: Vec<f64> = limits.iter().map(|point| point.lambda()).collect();
        (lambdas, system.counts)
    };
    let (exact, most) = located(0.0);
    assert_eq!(exact.len(), 2);
    for location in [1e-6, 1e-4] {
        let (lambdas, counts) = located(location);
        println!("{location:e}: {counts:?} in place of {most:?}");
        // The second derivative of λ with the arclength is below 100 there.
        assert_close(&lambdas, &exact, 100.0 * location * location + 1e-14);
        assert!(counts.residuals + 10 < most.residuals);
        assert!(counts.linearisations + 2 < most.linearisations);
    }
}

#[test]
fn branch_points_that_are_not_looked_for_are_passed_in_less_work() {
    let passed = |branch_points: bool| {
        let mut system = Counting::new(transcritical());
        let options = Options {
            branch_points,
            ..Options::within(-1.0, 1.0)
        };
        let branch = Branch::new(&mut system, &[-0.3, -1.0], Increasing, &options);
        let points: Vec<Point> = branch.unwrap().collect();
        let end = points.last().unwrap();
        assert_eq!(end.kind, Kind::Bound);
        assert_close(&end.z, &[0.3, 1.0], 1e-12);
        (of(&points, Kind::BranchPoint).len(), system.counts)
    };
    let [(found, most), (none, counts)] = [true, false].map(passed);
    println!("{counts:?} in place of {most:?}");
    assert_eq!([found, none], [1, 0]);
    assert!(counts.residuals < most.residuals && counts.linearisations < most.linearisations);
}

#[test]
fn rounding_of_a_system_does_not_shorten_steps() {
    // Noise of 2e-9 in equations that are asked for to 1e-9.
    let steps_with = |noise: f64| {
        let mut system = DenseSystem::new(1, &[0.0], 0, move |x, p, g| {
            let irregular = (1e13 * x[0] * p[0]).sin();
            g[0] = p[0] - 0.1 * x[0].powi(3) - x[0] + noise * irregular;
        })
        .with_jacobian(|x, _, j| j.copy_from_slice(&[-0.3 * x[0] * x[0] - 1.0, 1.0]));
        let options = Options {
            largest_step: 0.02,
            ..Options::within(0.0, 1.0)
        };
        let branch = Branch::new(&mut system, &[0.0, 0.0], Increasing, &options);
        steps(&branch.unwrap().collect::<Vec<_>>())
    };
    let [smooth, noisy] = [0.0, 2e-9].map(steps_with);
    assert!(noisy <= smooth + 2, "{noisy} steps in place of {smooth}");
}

#[test]
fn a_long_branch_keeps_as_many_vectors_as_a_short_one() {
    let kept = |steps: usize| {
        let mut system = Counting::new(tank(14.0));
        let (largest_step, bounds) = (1e-3, Options::within(0.0, 0.5));
        let options = Options {
            steps,
            largest_step,
            ..bounds
        };
        let branch = Branch::new(&mut system, &[0.0; 3], Increasing, &options).unwrap();
        assert_eq!(branch.count(), steps + 1);
        system.counts.vectors
    };
    assert_eq!(kept(10), kept(1000));
    assert!(kept(10) <= 8);
}
