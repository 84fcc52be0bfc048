//! Branches of boundary value problems, against closed forms.

mod bratu;
mod eigenproblem;
mod elastica;
mod integral;
mod stranger;

use bvp::{Constant, Equations, Family, Options, Scheme};
use continuation::{Branch, Kind, Point, Stop, System};

/// Options with a tolerance and a scheme that suits it.
fn to(tolerance: f64) -> Options {
    let stages = if tolerance < 1e-9 { 6 } else { 4 };
    Options {
        tolerance,
        scheme: Some(Scheme::Gauss { stages }),
        ..Options::default()
    }
}

/// The family through a constant solution, one segment, and its first point.
fn family<'a>(
    equations: &'a dyn Equations,
    parameter: usize,
    held: &[usize],
    states: &[f64],
    parameters: &[f64],
    options: &Options,
) -> (Family<'a>, Vec<f64>) {
    let (states, parameters) = (vec![states.to_vec()], parameters.to_vec());
    let guess = Constant { states, parameters };
    Family::new(equations, parameter, held, &guess, options).unwrap()
}

/// A labelled point and its solution at the left end.
struct Labelled {
    point: Point,
    start: Vec<f64>,
}

impl Labelled {
    fn error(&self) -> [f64; 2] {
        let error = self.point.error.expect("an error estimate");
        [error.lambda, error.states]
    }
}

/// The labelled points of a branch, and why it ended.
fn labelled(mut branch: Branch<'_, Family<'_>>) -> (Vec<Labelled>, Stop) {
    let mut found = Vec::new();
    while let Some(point) = branch.next() {
        if point.kind != Kind::Regular {
            let start = branch.system().solution(&point.z).start(0).to_vec();
            found.push(Labelled { point, start });
        }
    }
    (found, branch.into_stop().unwrap())
}

/// Those of a kind.
fn of(points: &[Labelled], kind: Kind) -> Vec<&Labelled> {
    points
        .iter()
        .filter(|labelled| labelled.point.kind == kind)
        .collect()
}

/// The first branch point of a kind on the branch, and the system there.
fn first<'a, S: System + Clone>(mut branch: Branch<'a, S>, kind: Kind) -> (S, Point) {
    while let Some(point) = branch.next() {
        if point.kind == kind {
            return (branch.system().clone(), point);
        }
    }
    panic!("no {kind:?}: {}", branch.into_stop().unwrap());
}

/// Asserts a relative error.
#[track_caller]
fn assert_close(found: f64, exact: f64, tolerance: f64) {
    let error = (found / exact - 1.0).abs();
    assert!(
        error <= tolerance,
        "{found} instead of {exact}: error {error:.1e}"
    );
}
