//! u'' + (p₁ π)² u = 0, u(0) = p₂, u(1) = 0, ∫ u² = p₃: with p₂ = 0 every integer p₁ is a branch
//! point of u = 0, from which a vertical branch leads off.

use crate::{assert_close, family, first, labelled, of, to};
use bvp::{Ends, Family, Problem, Real, Segment};
use continuation::{Branch, Direction, HalfBranch, Kind, Options, Point};
use std::f64::consts::PI;

struct Eigenproblem;

impl Problem for Eigenproblem {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(3, 0.0, 1.0)]
    }

    fn parameters(&self) -> usize {
        3
    }

    fn condition_count(&self) -> usize {
        4
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) {
        let wave = p[0] * PI;
        dy[0] = y[1];
        dy[1] = -wave * wave * y[0];
        dy[2] = y[0] * y[0];
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] - p[1];
        r[1] = at.end(0)[0];
        r[2] = at.start(0)[2];
        r[3] = at.end(0)[2] - p[2];
    }
}

#[test]
fn every_integer_is_a_branch_point_however_long_the_steps() {
    // The largest step passes two of them.
    let parameters = [0.5, 0.0, 0.0];
    let (mut system, z) = family(&Eigenproblem, 0, &[1], &[0.0; 3], &parameters, &to(1e-8));
    let options = Options::within(0.5, 10.5);
    let branch = Branch::new(&mut system, &z, Direction::Increasing, &options).unwrap();
    let (points, _) = labelled(branch);
    let found: Vec<f64> = of(&points, Kind::BranchPoint)
        .iter()
        .map(|p| p.point.lambda())
        .collect();
    assert_eq!(found.len(), 10, "{found:?}");
    for (n, found) in (1..).zip(found) {
        assert_close(found, f64::from(n), 1e-8);
    }
    assert!(of(&points, Kind::LimitPoint).is_empty());
}

#[test]
fn a_vertical_branch_is_followed_and_left_with_its_norm_held() {
    let parameters = [0.5, 0.0, 0.0];
    let (mut system, z) = family(&Eigenproblem, 0, &[1], &[0.0; 3], &parameters, &to(1e-10));
    let options = Options::within(0.5, 3.5);
    let branch = Branch::new(&mut system, &z, Direction::Increasing, &options).unwrap();
    let (mut there, crossing) = first(branch, Kind::BranchPoint);
    let norm = |_: &Family<'_>, point: &Point| point.z[point.z.len() - 2] - 1.0;
    let branch = Branch::switch(&mut there, &crossing, HalfBranch::Forward, &options).unwrap();
    let (system, normed) = first(branch.event(norm), Kind::Event(0));
    assert_close(normed.lambda(), 1.0, 1e-10);

    // p₂ against p₁ with p₃ = 1 held, from there.
    let solution = system.solution(&normed.z);
    let held = Family::new(&Eigenproblem, 0, &[2], &solution, &to(1e-10));
    let (mut system, z) = held.unwrap();
    let targets = vec![1.3, 1.5, 2.0, 2.75];
    let options = Options {
        targets: targets.clone(),
        ..Options::within(0.9, 3.0)
    };
    let branch = Branch::new(&mut system, &z, Direction::Increasing, &options).unwrap();
    let (points, _) = labelled(branch);
    let found = of(&points, Kind::Target);
    assert_eq!(found.len(), targets.len());
    for (found, p) in found.iter().zip(targets) {
        let wave = PI * p;
        let exact = wave.sin() / (0.5 - (2.0 * wave).sin() / (4.0 * wave)).sqrt();
        let p2 = found.point.z[found.point.z.len() - 2];
        assert!(
            (p2.abs() - exact.abs()).abs() < 1e-9,
            "{p2} instead of {exact}"
        );
    }
    assert!(of(&points, Kind::BranchPoint).is_empty());
}
