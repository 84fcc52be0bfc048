//! The arclength measures the curve, not the way its equations are written.

use crate::bratu::bratu;
use crate::{assert_close, of, trace};
use continuation::Direction::Increasing;
use continuation::{DenseSystem, Kind, Options, Point};

/// The stirred tank without limit points (at which copies may part), with its equations copied `copies` times, u and p₁ in other units.
fn tank(copies: usize, unit: f64, lambda_unit: f64) -> DenseSystem {
    DenseSystem::new(2 * copies, &[0.0], 0, move |u, p, g| {
        let p1 = p[0] / lambda_unit;
        for (u, g) in u.chunks_exact(2).zip(g.chunks_exact_mut(2)) {
            let [conversion, heat] = [u[0] / unit, u[1] / unit];
            let rate = p1 * (1.0 - conversion) * heat.exp();
            g[0] = rate - conversion;
            g[1] = 14.0 * rate - 4.0 * heat;
        }
    })
    .with_jacobian(move |u, p, j| {
        let (p1, columns) = (p[0] / lambda_unit, 2 * copies + 1);
        j.fill(0.0);
        for (i, u) in u.chunks_exact(2).enumerate() {
            let [conversion, heat] = [u[0] / unit, u[1] / unit];
            let slope = (1.0 - conversion) * heat.exp();
            let (rise, rate) = (p1 * heat.exp(), p1 * slope);
            let rows = [
                [-rise - 1.0, rate, slope],
                [-14.0 * rise, 14.0 * rate - 4.0, 14.0 * slope],
            ];
            for (k, [a, b, c]) in rows.into_iter().enumerate() {
                let row = &mut j[(2 * i + k) * columns..][..columns];
                (row[2 * i], row[2 * i + 1]) = (a / unit, b / unit);
                row[columns - 1] = c / lambda_unit;
            }
        }
    })
}

fn traced(copies: usize, unit: f64, lambda_unit: f64) -> Vec<Point> {
    let mut system = tank(copies, unit, lambda_unit);
    let options = Options::within(0.0, 0.5 * lambda_unit);
    trace(
        &mut system,
        &vec![0.0; 2 * copies + 1],
        Increasing,
        &options,
    )
    .0
}

#[test]
fn copies_and_units_change_neither_steps_nor_arclength() {
    let first = traced(1, 1.0, 1.0);
    for (copies, unit, lambda_unit) in [
        (2, 1.0, 1.0),
        (7, 1.0, 1.0),
        (1, 1e3, 1.0),
        (1, 1e-3, 1.0),
        (1, 1.0, 1e3),
        (1, 1.0, 1e-3),
        (3, 1e3, 1e-3),
    ] {
        let points = traced(copies, unit, lambda_unit);
        assert_eq!(points.len(), first.len());
        for (point, first) in points.iter().zip(&first) {
            assert_eq!(point.kind, first.kind);
            assert_close(&[point.arclength], &[first.arclength], 1e-7);
            assert_close(&[point.lambda() / lambda_unit], &[first.lambda()], 1e-7);
        }
    }
}

#[test]
fn samples_of_a_function_count_as_one() {
    let traced = |points: usize| {
        let start = vec![0.0; points + 1];
        let options = Options {
            targets: vec![1.0],
            ..Options::within(-1.0, 4.0)
        };
        trace(
            &mut bratu(points),
            &start,
            Increasing,
            &Options {
                steps: 25,
                ..options
            },
        )
        .0
    };
    let [coarse, fine] = [499, 1999].map(traced);
    for kind in [Kind::LimitPoint, Kind::Target] {
        let [coarse, fine] = [&coarse, &fine].map(|points| of(points, kind));
        assert_eq!(coarse.len(), fine.len());
        for (coarse, fine) in coarse.iter().zip(&fine) {
            assert!((coarse.arclength / fine.arclength - 1.0).abs() < 1e-3);
        }
    }
    let steps = |points: &[Point]| {
        points
            .iter()
            .take_while(|p| p.kind != Kind::LimitPoint)
            .count()
    };
    assert_eq!(steps(&coarse), steps(&fine));
}
