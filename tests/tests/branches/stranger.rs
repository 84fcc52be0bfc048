//! Somebody's problem, from its equations to a labelled branch.

use bvp::{Constant, Ends, Family, Problem, Real, Segment};
use continuation::{Branch, Direction, Kind, Options};

/// A first-order reaction with heat release in a slab (Aris): y'' = φ² y exp(20 · 0.4 (1 − y) /
/// (1 + 0.4 (1 − y))), y'(0) = 0, y(1) = 1, with λ = φ.
struct Slab;

impl Problem for Slab {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, 0.0, 1.0)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn condition_count(&self) -> usize {
        2
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) {
        let heat = (-y[0] + 1.0) * 0.4;
        dy[0] = y[1];
        dy[1] = p[0] * p[0] * y[0] * (heat * 20.0 / (heat + 1.0)).exp();
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[1];
        r[1] = at.end(0)[0] - 1.0;
    }
}

#[test]
fn a_branch_of_a_new_problem_takes_ten_lines() {
    let guess = Constant {
        states: vec![vec![1.0, 0.0]],
        parameters: vec![0.0],
    };
    let (mut family, z) = Family::new(&Slab, 0, &[], &guess, &bvp::Options::default()).unwrap();
    let options = Options {
        targets: vec![0.3],
        ..Options::within(0.0, 1.0)
    };
    let mut branch = Branch::new(&mut family, &z, Direction::Increasing, &options).unwrap();
    let mut found = Vec::new();
    while let Some(point) = branch.next() {
        let solution = branch.system().solution(&point.z);
        found.push((
            point.kind,
            point.lambda(),
            solution.end(0)[1] / point.lambda().powi(2),
        ));
    }
    // An S: ignition and extinction, and between them three states.
    let kinds: Vec<Kind> = found
        .iter()
        .map(|row| row.0)
        .filter(|k| *k != Kind::Regular)
        .collect();
    let (target, limit) = (Kind::Target, Kind::LimitPoint);
    assert_eq!(
        kinds,
        [
            Kind::Start,
            target,
            limit,
            target,
            limit,
            target,
            Kind::Bound
        ]
    );
    let limits: Vec<f64> = found
        .iter()
        .filter(|row| row.0 == limit)
        .map(|row| row.1)
        .collect();
    assert!(limits[1] < 0.3 && 0.3 < limits[0], "{limits:?}");
}
