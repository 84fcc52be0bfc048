//! What the tracer promises, on problems with known solutions.

mod asymptotes;
#[path = "../../examples/banded/bratu.rs"]
mod bratu;
mod counting;
mod crowds;
mod curves;
mod differences;
mod failures;
mod hidden;
mod invariance;
mod kinks;
mod labels;
mod refinement;
mod rows;
mod saving;
mod sheets;
mod solutions;
mod sparse;
mod special_points;
mod steep_sheets;
mod swift_hohenberg;
mod switching;
mod systems;
mod work;

use continuation::{Branch, Direction, Kind, Options, Point, Stop, System};

/// All points of a branch and the reason why it ended.
fn trace<S: System>(
    system: &mut S,
    start: &[f64],
    direction: Direction,
    options: &Options,
) -> (Vec<Point>, Stop) {
    finish(Branch::new(system, start, direction, options).unwrap())
}

/// All points of a branch and the reason why it ended.
fn finish<S: System>(mut branch: Branch<'_, S>) -> (Vec<Point>, Stop) {
    let points = branch.by_ref().collect();
    (points, branch.into_stop().unwrap())
}

/// The points of a kind.
fn of(points: &[Point], kind: Kind) -> Vec<&Point> {
    points.iter().filter(|point| point.kind == kind).collect()
}

/// The number of steps.
fn steps(points: &[Point]) -> usize {
    let ends = |point: &&Point| matches!(point.kind, Kind::Regular | Kind::Bound | Kind::Closed);
    points.iter().filter(ends).count()
}

/// Asserts that two vectors agree to so much, relative to 1 or the entry.
#[track_caller]
fn assert_close(found: &[f64], exact: &[f64], tolerance: f64) {
    assert_eq!(found.len(), exact.len());
    for (found, exact) in found.iter().zip(exact) {
        let error = (found - exact).abs() / exact.abs().max(1.0);
        assert!(
            error <= tolerance,
            "{found} instead of {exact}: error {error:.1e}"
        );
    }
}
