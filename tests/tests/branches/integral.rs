//! u'' + λ eᵘ = 0, u(0) − u(1) = p₂, ∫ u = 0: a limit point for every p₂.

use crate::{assert_close, family, first, to};
use bvp::{Ends, Problem, Real, Segment};
use continuation::{Branch, Direction, Kind, LimitPointCurve, Options, Stop};

struct Integral;

impl Problem for Integral {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(3, 0.0, 1.0)]
    }

    fn parameters(&self) -> usize {
        2
    }

    fn condition_count(&self) -> usize {
        3
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -p[0] * y[0].exp();
        dy[2] = y[0];
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] - at.end(0)[0] - p[1];
        r[1] = at.start(0)[2];
        r[2] = at.end(0)[2];
    }
}

/// p₂ and λ of the limit points.
const TABLE: [(f64, f64); 8] = [
    (0.5, 11.842_684_389_488_813),
    (1.0, 11.603_854_053_727_493),
    (2.0, 10.711_490_673_098_759),
    (3.0, 9.418_830_585_122_97),
    (4.0, 7.934_950_202_765_486),
    (5.0, 6.443_921_930_744_237),
    (6.0, 5.073_356_473_149_195),
    (7.0, 3.891_607_781_698_417),
];

#[test]
fn the_limit_points_are_followed_in_two_parameters() {
    let (mut system, z) = family(&Integral, 0, &[1], &[0.0; 3], &[0.0; 2], &to(1e-10));
    let options = Options::within(0.0, 15.0);
    let branch = Branch::new(&mut system, &z, Direction::Increasing, &options).unwrap();
    let (system, limit) = first(branch, Kind::LimitPoint);
    assert_close(limit.lambda(), 11.923_790_200_647_666, 1e-10);

    let mut curve = LimitPointCurve::new(system, &limit.z).unwrap();
    let start = curve.start(&limit.z);
    let targets = TABLE.iter().map(|row| row.0).collect();
    let options = Options {
        targets,
        ..Options::within(-1.0, 8.0)
    };
    let mut branch = Branch::new(&mut curve, &start, Direction::Increasing, &options)
        .unwrap()
        .event(|_, point| point.z[point.z.len() - 2] - 3.0);
    let points: Vec<_> = branch.by_ref().collect();
    assert!(matches!(
        branch.into_stop(),
        Some(Stop::Bound { lambda: 8.0 })
    ));
    let lambda = |z: &[f64]| z[z.len() - 2];
    let targets: Vec<_> = points
        .iter()
        .filter(|point| point.kind == Kind::Target)
        .collect();
    assert_eq!(targets.len(), TABLE.len());
    for (target, (p2, exact)) in targets.iter().zip(TABLE) {
        assert_eq!(target.lambda(), p2);
        assert_close(lambda(&target.z), exact, 1e-10);
    }
    let end = points.last().unwrap();
    assert_close(lambda(&end.z), 2.920_397_020_504_151, 1e-10);
    let events: Vec<_> = points
        .iter()
        .filter(|point| point.kind == Kind::Event(0))
        .collect();
    assert_eq!(events.len(), 1);
    assert_close(events[0].lambda(), 7.909_158_283_277_689, 1e-10);
    // λ is largest where p₂ = 0, which is where both derivatives of ψ say so.
    assert!(
        points
            .iter()
            .all(|p| !matches!(p.kind, Kind::Cusp | Kind::LimitPoint))
    );
}
