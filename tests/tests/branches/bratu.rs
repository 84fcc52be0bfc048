//! u'' + λ eᵘ = 0, u(0) = u(1) = 0: u = 2 ln(cosh s / cosh(2 s (x − ½))), λ = 8 s² / cosh² s.

use crate::{Labelled, assert_close, family, labelled, of, to};
use bvp::{Ends, Problem, Real, Segment};
use continuation::{Branch, Direction, Kind, Options, Point, Stop};

struct Bratu;

impl Problem for Bratu {
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
        dy[1] = -p[0] * y[0].exp();
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0];
    }
}

/// λ with u'(0) on the lower and on the upper branch.
const TABLE: [(f64, f64, f64); 9] = [
    (0.5, 0.261_277_310_159_016_5, 12.999_833_998_386_52),
    (1.0, 0.549_352_728_775_270_8, 10.846_899_019_389_452),
    (1.5, 0.873_234_785_561_013_5, 9.423_851_172_570_993),
    (2.0, 1.248_217_517_758_202_7, 8.268_763_180_545_195),
    (2.5, 1.704_359_459_396_917_5, 7.209_284_639_692_581),
    (3.0, 2.319_602_258_081_586_4, 6.103_381_294_149_141),
    (3.25, 2.769_373_336_106_399_4, 5.439_120_430_380_915),
    (3.5, 3.703_967_031_156_578, 4.306_550_837_417_965),
    (3.51, 3.842_977_463_552_538, 4.159_931_349_688_695),
];
/// λ with u'(0) far up.
const TAIL: [(f64, f64); 2] = [
    (0.171_641_687_427_314_8, 15.989_268_795_825_073),
    (0.007_078_045_652_735_818, 23.999_705_079_619_094),
];
const LIMIT: f64 = 3.513_830_719_125_161;

fn trace(tolerance: f64) -> Vec<Labelled> {
    let (mut system, z) = family(&Bratu, 0, &[], &[0.0; 2], &[0.1], &to(tolerance));
    let table = TABLE.iter().map(|row| row.0);
    let targets = table.chain(TAIL.iter().map(|row| row.0)).collect();
    let options = Options {
        targets,
        ..Options::within(0.005, 4.0)
    };
    let branch = Branch::new(&mut system, &z, Direction::Increasing, &options).unwrap();
    let (points, stop) = labelled(branch);
    assert!(matches!(stop, Stop::Bound { lambda: 0.005 }), "{stop}");
    points
}

/// What the estimate of a relative error must exceed a tenth of, but for rounding.
#[track_caller]
fn assert_bounded(error: f64, estimate: f64, rounding: f64) {
    assert!(
        error <= 10.0 * estimate + rounding,
        "error {error:.1e}, estimate {estimate:.1e}"
    );
}

#[test]
fn the_limit_point_is_found_to_twelve_digits() {
    let points = trace(1e-12);
    let limits = of(&points, Kind::LimitPoint);
    assert_eq!(limits.len(), 1);
    assert_close(limits[0].point.lambda(), LIMIT, 1e-12);
    assert_close(limits[0].start[1], 4.0, 1e-10);
}

#[test]
fn the_estimates_bound_the_errors_of_all_labelled_points() {
    for tolerance in [1e-3, 1e-5, 1e-7, 1e-9, 1e-11] {
        let points = trace(tolerance);
        let limits = of(&points, Kind::LimitPoint);
        assert_eq!(limits.len(), 1);
        let [lambda, states] = limits[0].error();
        assert_bounded((limits[0].point.lambda() - LIMIT).abs(), lambda, 1e-12);
        assert_bounded((limits[0].start[1] / 4.0 - 1.0).abs(), states, 1e-11);
        let targets = of(&points, Kind::Target);
        let exact: Vec<(f64, f64)> = TABLE
            .iter()
            .map(|row| (row.0, row.1))
            .chain(TABLE.iter().rev().map(|row| (row.0, row.2)))
            .chain(TAIL)
            .collect();
        // The first of the tail is passed on the lower branch, too.
        assert_eq!(targets.len(), exact.len() + 1, "tolerance {tolerance}");
        for (lambda, slope) in exact {
            let with = targets
                .iter()
                .filter(|found| found.point.lambda() == lambda);
            let best = with.min_by(|a, b| {
                (a.start[1] - slope)
                    .abs()
                    .total_cmp(&(b.start[1] - slope).abs())
            });
            let found = best.unwrap();
            let error = (found.start[1] / slope - 1.0).abs();
            let [lambda_error, states] = found.error();
            assert_eq!(lambda_error, 0.0);
            assert!(states <= tolerance);
            assert_bounded(error, states, 1e-12);
        }
    }
}

#[test]
fn a_doubled_mesh_changes_neither_steps_nor_arclength() {
    let trace = |intervals: usize| {
        let options = bvp::Options {
            initial_intervals: intervals,
            ..to(1e-6)
        };
        let (mut system, z) = family(&Bratu, 0, &[], &[0.0; 2], &[0.0], &options);
        let options = Options {
            targets: vec![1.0, 3.0],
            ..Options::within(-1.0, 4.0)
        };
        let options = Options {
            steps: 16,
            ..options
        };
        let branch = Branch::new(&mut system, &z, Direction::Increasing, &options).unwrap();
        branch.collect::<Vec<_>>()
    };
    let [coarse, fine] = [40, 80].map(trace);
    let kinds = |points: &[Point]| points.iter().map(|point| point.kind).collect::<Vec<_>>();
    assert_eq!(kinds(&coarse), kinds(&fine));
    for (coarse, fine) in coarse.iter().zip(&fine).skip(1) {
        assert_close(coarse.arclength, fine.arclength, 2e-3);
    }
}
