//! u'' + λ sin u = 0, u'(0) = u'(1) = 0: pitchforks at (n π)² on u = 0, with
//! λ = (2 n K(sin(a/2)))² for a = u(0).

use crate::{assert_close, family, first, labelled, of, to};
use bvp::{Ends, Family, Problem, Real, Segment};
use continuation::{Branch, Direction, HalfBranch, Kind, Options, Stop};
use std::f64::consts::PI;

struct Elastica;

impl Problem for Elastica {
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
        dy[0] = y[1];
        dy[1] = -p[0] * y[0].sin();
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[1];
        r[1] = at.end(0)[1];
    }
}

/// |u(0)| with λ on the first of the branches; λ of the n-th is n² times that.
const TABLE: [(f64, f64); 7] = [
    (0.1, 9.881_952_339_037_88),
    (0.5, 10.185_001_081_195_277),
    (1.0, 11.222_418_475_789_072),
    (1.5, 13.325_657_225_813_946),
    (2.0, 17.429_593_485_145_992),
    (2.5, 26.641_922_888_814_76),
    (3.0, 65.250_363_103_238_13),
];

#[test]
fn the_straight_state_has_all_its_pitchforks() {
    let (mut system, z) = family(&Elastica, 0, &[], &[0.0; 2], &[1.0], &to(1e-9));
    let options = Options::within(1.0, 400.0);
    let branch = Branch::new(&mut system, &z, Direction::Increasing, &options).unwrap();
    let (points, stop) = labelled(branch);
    assert!(matches!(stop, Stop::Bound { lambda: 400.0 }));
    let crossings = of(&points, Kind::BranchPoint);
    assert_eq!(crossings.len(), 6);
    for (n, crossing) in (1..).zip(crossings) {
        let exact = (f64::from(n) * PI).powi(2);
        assert_close(crossing.point.lambda(), exact, 1e-9);
        let [lambda, _] = crossing.error();
        assert!((crossing.point.lambda() - exact).abs() <= 10.0 * lambda + 1e-12 * exact);
    }
    assert!(of(&points, Kind::LimitPoint).is_empty());
}

#[test]
fn the_upright_state_has_none() {
    let (mut system, z) = family(&Elastica, 0, &[], &[PI, 0.0], &[1.0], &to(1e-9));
    let options = Options::within(1.0, 400.0);
    let branch = Branch::new(&mut system, &z, Direction::Increasing, &options).unwrap();
    let (points, _) = labelled(branch);
    let kinds: Vec<Kind> = points.iter().map(|labelled| labelled.point.kind).collect();
    assert_eq!(kinds, [Kind::Start, Kind::Bound]);
}

#[test]
fn both_halves_of_the_first_three_pitchforks_are_followed() {
    let (mut system, z) = family(&Elastica, 0, &[], &[0.0; 2], &[1.0], &to(1e-9));
    let mut at = (system.clone(), z);
    for n in 1..=3 {
        let square = f64::from(n * n);
        let ahead = Options::within(1.0, 100.0);
        let branch = Branch::new(&mut system, &at.1, Direction::Increasing, &ahead).unwrap();
        let (there, crossing) = first(branch, Kind::BranchPoint);
        let mut sides = 0.0;
        for half in [HalfBranch::Forward, HalfBranch::Backward] {
            let mut system = there.clone();
            let options = Options {
                targets: vec![],
                ..Options::within(1.0, 67.0 * square)
            };
            let mut branch = Branch::switch(&mut system, &crossing, half, &options).unwrap();
            for (height, _) in TABLE {
                branch = branch.event(move |system: &Family<'_>, point| {
                    system.solution(&point.z).start(0)[0].abs() - height
                });
            }
            let (points, stop) = labelled(branch);
            assert!(matches!(stop, Stop::Bound { .. }), "{stop}");
            for (index, (height, lambda)) in TABLE.into_iter().enumerate() {
                let events = of(&points, Kind::Event(index));
                assert_eq!(events.len(), 1, "n = {n}, u(0) = {height}");
                assert_close(events[0].point.lambda(), lambda * square, 1e-9);
                assert_close(events[0].start[0].abs(), height, 1e-12);
                let [lambda, states] = events[0].error();
                assert!(states <= 1e-9 && lambda / events[0].point.lambda() <= 1e-9);
            }
            sides += points.last().unwrap().start[0].signum();
            assert!(of(&points, Kind::BranchPoint).is_empty());
        }
        assert_eq!(sides, 0.0);
        // On from behind the branch point.
        let lambda = crossing.lambda() * 1.2;
        at = family(&Elastica, 0, &[], &[0.0; 2], &[lambda], &to(1e-9));
        system = at.0.clone();
    }
}
