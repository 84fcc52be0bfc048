//! The units of the equations, in which their residuals are, change nothing.

use crate::{assert_close, of, steps, trace};
use bvp::{Constant, Ends, Family, Problem, Real, Segment};
use continuation::Direction::{Decreasing, Increasing};
use continuation::{DenseSystem, Kind, LimitPointCurve, Options, Point};
use std::f64::consts::PI;

/// Powers of ten by which the two equations of a system are multiplied.
const POWERS: [i32; 5] = [-12, -5, 0, 7, 12];

type Residual = fn(&[f64], &[f64], &mut [f64]);

/// A system of two equations that are multiplied by these powers of ten.
fn multiplied(residual: Residual, parameters: &[f64], powers: [i32; 2]) -> DenseSystem {
    DenseSystem::new(2, parameters, 0, move |x, p, g| {
        residual(x, p, g);
        for (g, power) in g.iter_mut().zip(powers) {
            *g *= 10f64.powi(power);
        }
    })
}

/// The stirred tank with two limit points, λ = p₁ and μ = p₂.
fn tank(u: &[f64], p: &[f64], g: &mut [f64]) {
    let rate = p[0] * (1.0 - u[0]) * u[1].exp();
    g[0] = rate - u[0];
    g[1] = p[1] * rate - 4.0 * u[1];
}

/// Two cells with an enzyme: two limit points and two branch points.
fn cells(x: &[f64], p: &[f64], g: &mut [f64]) {
    let rate = |s: f64| 100.0 * s / (1.0 + s + s * s);
    g[0] = p[0] - x[0] + x[1] - x[0] - rate(x[0]);
    g[1] = p[0] - x[1] + x[0] - x[1] - rate(x[1]);
}

/// Decoupled pitchforks a tenth apart.
fn pitchforks(x: &[f64], p: &[f64], g: &mut [f64]) {
    g[0] = x[0] * (p[0] - x[0] * x[0]);
    g[1] = x[1] * (p[0] - 0.1 - x[1] * x[1]);
}

/// Asserts that two traces have the same steps and the same labelled points, relative to the size of λ.
#[track_caller]
fn assert_same(points: &[Point], first: &[Point], size: f64) {
    assert_eq!(steps(points), steps(first));
    let labelled = |points: &[Point]| -> Vec<Point> {
        let labels = points.iter().filter(|point| point.kind != Kind::Regular);
        labels.cloned().collect()
    };
    let [points, first] = [points, first].map(labelled);
    assert_eq!(points.len(), first.len());
    for (point, first) in points.iter().zip(&first) {
        assert_eq!(point.kind, first.kind);
        assert_close(&[point.lambda() / size], &[first.lambda() / size], 1e-9);
    }
}

#[test]
fn equations_multiplied_by_any_powers_of_ten_have_the_same_curves() {
    let problems: [(Residual, [f64; 2], [usize; 2]); 3] = [
        (tank, [0.0, 0.5], [2, 0]),
        (cells, [0.0, 100.0], [2, 2]),
        (pitchforks, [-1.0, 1.0], [0, 2]),
    ];
    for (residual, [low, high], counts) in problems {
        let traced = |powers: [i32; 2]| {
            let mut system = multiplied(residual, &[0.0, 18.0], powers);
            let (start, options) = ([0.0, 0.0, low], Options::within(low, high));
            trace(&mut system, &start, Increasing, &options).0
        };
        let first = traced([0, 0]);
        let found = [Kind::LimitPoint, Kind::BranchPoint].map(|kind| of(&first, kind).len());
        assert_eq!(found, counts);
        for (a, b) in POWERS.iter().flat_map(|a| POWERS.map(|b| (*a, b))) {
            assert_same(&traced([a, b]), &first, 1.0);
        }
    }
}

#[test]
fn equations_multiplied_by_any_powers_of_ten_have_the_same_curve_of_limit_points() {
    let traced = |powers: [i32; 2]| {
        let limit = [1.0 / 3.0, 1.5, 0.5 * (-1.5f64).exp()];
        let system = multiplied(tank, &[limit[2], 18.0], powers).with_second(1);
        let mut curve = LimitPointCurve::new(system, &limit).unwrap();
        let (start, options) = (curve.start(&limit), Options::within(10.0, 20.0));
        trace(&mut curve, &start, Decreasing, &options).0
    };
    let first = traced([0, 0]);
    assert_eq!(of(&first, Kind::Cusp).len(), 1);
    for (a, b) in POWERS.iter().flat_map(|a| POWERS.map(|b| (*a, b))) {
        assert_same(&traced([a, b]), &first, 1.0);
    }
}

/// A column of unit length with bending stiffness B, N m², under a load P, N: θ' = M/B, M' = −P sin θ, with hinged
/// ends, M(0) = M(1) = 0, in any unit.
struct Column {
    stiffness: f64,
    unit: f64,
}

impl Problem for Column {
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
        dy[0] = y[1] / self.stiffness;
        dy[1] = -p[0] * y[0].sin();
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[1] / self.unit;
        r[1] = at.end(0)[1] / self.unit;
    }
}

#[test]
fn a_column_of_any_stiffness_has_its_critical_loads() {
    for stiffness in [1.0, 1e-3, 2e-9, 2e9] {
        let traced = |unit: f64, absolute: Vec<f64>| {
            let guess = Constant {
                states: vec![vec![0.0; 2]],
                parameters: vec![stiffness],
            };
            let options = bvp::Options {
                absolute,
                tolerance: 1e-10,
                ..bvp::Options::default()
            };
            let column = Column { stiffness, unit };
            let (mut family, start) = Family::new(&column, 0, &[], &guess, &options).unwrap();
            let options = Options::within(stiffness, 100.0 * stiffness);
            trace(&mut family, &start, Increasing, &options).0
        };
        let first = traced(1.0, vec![1.0, stiffness, stiffness]);
        let loads = of(&first, Kind::BranchPoint);
        let loads: Vec<f64> = loads.iter().map(|p| p.lambda() / stiffness).collect();
        let exact = [1.0, 2.0, 3.0].map(|n: f64| (n * PI).powi(2));
        assert_close(&loads, &exact, 1e-9);
        for power in POWERS {
            let points = traced(10f64.powi(power), vec![1.0, stiffness, stiffness]);
            assert_same(&points, &first, stiffness);
            assert_eq!(of(&points, Kind::BranchPoint).len(), 3);
        }
    }
}
