//! Systems with sparse Jacobians.

use crate::systems::{pitchfork, tank};
use crate::{assert_close, of, trace};
use bvp::Real;
use continuation::Direction::{Decreasing, Increasing};
use continuation::{
    Branch, Cause, DenseSystem, Differentiable, Difficulty, Error, Kind, LimitPointCurve, Options,
    Point, SparseSystem, System,
};
use std::f64::consts::PI;

/// The tank of the dense systems.
fn sparse_tank(p2: f64) -> SparseSystem {
    let residual = |u: &[f64], p: &[f64], g: &mut [f64]| {
        let rate = p[0] * (1.0 - u[0]) * u[1].exp();
        g[0] = rate - u[0];
        g[1] = p[1] * rate - (1.0 + p[2]) * u[1];
    };
    SparseSystem::new(2, &[0.0, p2, 3.0], 0, residual, |u, p, put| {
        let heat = u[1].exp();
        let (rise, slope) = (p[0] * heat, (1.0 - u[0]) * heat);
        put(0, 0, -rise);
        put(0, 0, -1.0);
        put(0, 1, p[0] * slope);
        put(0, 2, slope);
        put(1, 0, -p[1] * rise);
        put(1, 1, p[1] * p[0] * slope - 1.0 - p[2]);
        put(1, 2, p[1] * slope);
        put(1, 3, p[0] * slope);
    })
    .with_second(1)
}

/// x (λ − x²) = imperfection.
fn sparse_pitchfork() -> SparseSystem {
    let residual = |x: &[f64], p: &[f64], g: &mut [f64]| g[0] = x[0] * (p[0] - x[0] * x[0]);
    SparseSystem::new(1, &[0.0], 0, residual, |x, p, put| {
        put(0, 0, p[0] - 3.0 * x[0] * x[0]);
        put(0, 1, x[0]);
    })
}

/// u'' + λ sin u = 0, u(0) = u(1) = 0 by differences at these interior points.
fn column(points: usize) -> SparseSystem {
    let square = ((points + 1) as f64).powi(-2);
    let residual = move |u: &[f64], p: &[f64], g: &mut [f64]| {
        let at = |i: usize| {
            if i == 0 || i == points + 1 {
                0.0
            } else {
                u[i - 1]
            }
        };
        for (i, g) in g.iter_mut().enumerate() {
            *g = at(i) - 2.0 * at(i + 1) + at(i + 2) + square * p[0] * u[i].sin();
        }
    };
    SparseSystem::new(points, &[0.0], 0, residual, move |u, p, put| {
        for (i, u) in u.iter().enumerate() {
            if i > 0 {
                put(i, i - 1, 1.0);
                put(i - 1, i, 1.0);
            }
            put(i, i, square * p[0] * u.cos() - 2.0);
            put(i, points, square * u.sin());
        }
    })
    .with_groups(&vec![0; points])
}

/// The labelled points of both systems are the same.
fn assert_same<S: System, T: System>(
    mut sparse: S,
    mut dense: T,
    start: &[f64],
    options: &Options,
) {
    let labelled = |points: Vec<Point>| -> Vec<Point> {
        let labelled = points.into_iter().filter(|p| p.kind != Kind::Regular);
        labelled.collect()
    };
    let found = labelled(trace(&mut sparse, start, Increasing, options).0);
    let expected = labelled(trace(&mut dense, start, Increasing, options).0);
    assert!(expected.len() > 2);
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(&expected) {
        assert_eq!(found.kind, expected.kind);
        assert_close(&found.z, &expected.z, 1e-9);
        assert_close(&found.tangent, &expected.tangent, 1e-6);
    }
}

#[test]
fn sparse_systems_have_the_branches_of_dense_ones() {
    let options = Options::within(0.0, 0.3);
    assert_same(sparse_tank(18.0), tank(18.0), &[0.0; 3], &options);
    let options = Options {
        targets: vec![0.5],
        ..Options::within(-1.0, 1.0)
    };
    assert_same(sparse_pitchfork(), pitchfork(0.0), &[0.0, -1.0], &options);
}

#[test]
fn the_limit_points_of_a_sparse_system_are_followed_to_their_cusp() {
    let mut system = sparse_tank(18.0);
    let (points, _) = trace(
        &mut system,
        &[0.0; 3],
        Increasing,
        &Options::within(0.0, 0.3),
    );
    let limit = of(&points, Kind::LimitPoint)[0].z.clone();
    let mut curve = LimitPointCurve::new(sparse_tank(18.0), &limit).unwrap();
    let start = curve.start(&limit);
    let options = Options::within(10.0, 20.0);
    let (points, _) = trace(&mut curve, &start, Decreasing, &options);
    let [cusp] = of(&points, Kind::Cusp)[..] else {
        panic!("one cusp");
    };
    assert_close(&cusp.z, &[0.5, 2.0, (-2.0f64).exp(), 16.0], 1e-8);
}

#[test]
fn every_pitchfork_of_a_large_system_is_found() {
    // Of the differences at 4/h² sin²(kπh/2); on u = 0 the column of λ is zero.
    let points = 400;
    let mut system = column(points);
    let start = vec![0.0; points + 1];
    let options = Options::within(0.0, 300.0);
    let (found, _) = trace(&mut system, &start, Increasing, &options);
    let found: Vec<f64> = of(&found, Kind::BranchPoint)
        .iter()
        .map(|p| p.lambda())
        .collect();
    assert_eq!(found.len(), 5, "{found:?}");
    let h = 1.0 / (points + 1) as f64;
    for (k, found) in (1..).zip(found) {
        let exact = (2.0 / h * (0.5 * f64::from(k) * PI * h).sin()).powi(2);
        assert_close(&[found], &[exact], 1e-8);
    }
}

#[test]
fn orientation_and_null_vector_are_those_of_the_determinant() {
    // Round the circle x² + λ² = 1, where each unknown is left over in turn, det [J; tᵀ] > 0.
    let residual = |x: &[f64], p: &[f64], g: &mut [f64]| g[0] = x[0] * x[0] + p[0] * p[0] - 1.0;
    let mut system = SparseSystem::new(1, &[0.0], 0, residual, |x, p, put| {
        put(0, 0, 2.0 * x[0]);
        put(0, 1, 2.0 * p[0]);
    });
    for i in 0..100 {
        let (sine, cosine) = (0.1 * f64::from(i)).sin_cos();
        system.linearise(&[cosine, sine]).unwrap();
        let mut t = [0.0; 2];
        system.null_vector(&mut t);
        let determinant = 2.0 * cosine * t[1] - 2.0 * sine * t[0];
        assert!(determinant > 0.0 && (cosine * t[0] + sine * t[1]).abs() < 1e-14);
        let mut v = [f64::NAN; 2];
        system.particular(&[3.0], &mut v);
        assert!((2.0 * cosine * v[0] + 2.0 * sine * v[1] - 3.0).abs() < 1e-13);
        assert!(t.iter().chain(&v).all(|x| x.abs() < 20.0));
    }
}

#[test]
fn entries_that_are_none_are_refused() {
    let refused = |row: usize, column: usize, value: f64| -> Cause {
        let residual = |x: &[f64], p: &[f64], g: &mut [f64]| g[0] = x[0] - p[0];
        let mut system = SparseSystem::new(1, &[0.0], 0, residual, move |_, _, put| {
            put(0, 0, 1.0);
            put(row, column, value);
        });
        let options = Options::within(-1.0, 1.0);
        match Branch::new(&mut system, &[0.0; 2], Increasing, &options) {
            Err(Error::Start(Difficulty::Linearisation(cause))) => cause,
            _ => panic!("refused for its jacobian"),
        }
    };
    assert_eq!(
        refused(1, 0, 1.0).to_string(),
        "the jacobian has no entry (1, 0)"
    );
    assert_eq!(
        refused(0, 2, 1.0).to_string(),
        "the jacobian has no entry (0, 2)"
    );
    assert_eq!(
        refused(0, 1, f64::NAN).to_string(),
        "the jacobian is not finite"
    );
}

/// Uᵢ₋₂ − 4 Uᵢ₋₁ + 6 Uᵢ − … with a cubic: a pentadiagonal system, and one state too many in one equation.
struct Beam {
    wide: bool,
}

impl Differentiable for Beam {
    fn residual<T: Real>(&self, u: &[T], p: &[T], g: &mut [T]) {
        let at = |i: usize, shift: usize| {
            let place = (i + shift).checked_sub(2).and_then(|place| u.get(place));
            place.copied().unwrap_or(T::ZERO)
        };
        for i in 0..u.len() {
            let ends = at(i, 0) + at(i, 4);
            let next = at(i, 1) + at(i, 3);
            g[i] = ends - next * 4.0 + u[i] * 6.0 - p[0] * u[i] + u[i].powi(3) - p[1];
        }
        if self.wide {
            g[3] += u[9] * 1e-3;
        }
    }
}

#[test]
fn sparse_systems_with_exact_derivatives_have_the_branches_of_dense_ones() {
    let n: usize = 20;
    let pattern: Vec<(usize, usize)> = (0..n * n)
        .map(|k| (k / n, k % n))
        .filter(|(i, j)| i.abs_diff(*j) <= 2)
        .collect();
    let options = Options::within(0.0, 1.0);
    let start = vec![0.0; n + 1];
    let parameters = [0.0, 0.01];
    let groups = vec![0; n];
    let mut sparse = SparseSystem::exact(n, &parameters, 0, &pattern, Beam { wide: false });
    sparse = sparse.with_groups(&groups);
    let (points, _) = trace(&mut sparse, &start, Increasing, &options);
    let mut dense = DenseSystem::exact(n, &parameters, 0, Beam { wide: false });
    let (others, _) = trace(&mut dense, &start, Increasing, &options);
    let ends = [&points, &others].map(|points| points[points.len() - 1].z.clone());
    assert_close(&ends[0], &ends[1], 1e-9);
    // A dependence that the pattern does not name is not overlooked.
    let mut wide = SparseSystem::exact(n, &parameters, 0, &pattern, Beam { wide: true });
    let refused = Branch::new(&mut wide, &start, Increasing, &options)
        .err()
        .unwrap();
    assert!(
        refused
            .to_string()
            .contains("equation 3 depends on states outside")
    );
}
