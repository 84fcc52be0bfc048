//! Regular singular points at an end: orders, meshes, limits.

use super::intervals;
use crate::exact::Exact;
use crate::order::{COUNTS, errors, on_uniform_mesh, slope};
use bvp::{Constant, Ends, Error, Guess, Options, Problem, Real, Scheme, Segment, solve};

/// Diffusion with a linear source in a sphere: y″ + (2/s) y′ + w² y = 0, y′(0) = 0,
/// y(1) = sin(w)/w with y = sin(ws)/(ws).
struct Sphere {
    w: f64,
    /// Whether the limit y″ = −w² y/3 at s = 0 is written.
    limit: bool,
}

impl Problem for Sphere {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2)]
    }

    fn rhs<T: Real>(&self, _: usize, s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        let source = y[0] * (self.w * self.w);
        dy[0] = y[1];
        dy[1] = if self.limit && s.value() == 0.0 {
            -source / 3.0
        } else {
            -y[1] / s * 2.0 - source
        };
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[1];
        r[1] = at.end(0)[0] - self.w.sin() / self.w;
    }
}

fn sphere(w: f64, limit: bool) -> Exact {
    Exact {
        name: "sphere",
        equations: Box::new(Sphere { w, limit }),
        states: |w, s, y| {
            let x = w * s;
            // The first terms of the series where the closed form cancels.
            y[0] = if x < 1e-2 {
                1.0 - x * x / 6.0 + x.powi(4) / 120.0
            } else {
                x.sin() / x
            };
            y[1] = if x < 1e-2 {
                w * x * (-1.0 / 3.0 + x * x / 30.0 - x.powi(4) / 840.0)
            } else {
                w * (x.cos() - x.sin() / x) / x
            };
        },
        w,
        parameters: vec![],
    }
}

#[test]
fn orders_at_a_singular_point() {
    let schemes = (1..=7).map(|stages| (Scheme::Gauss { stages }, false));
    let lobatto = [3, 4].map(|stages| (Scheme::LobattoIIIA { stages }, true));
    for (scheme, limit) in schemes.chain(lobatto) {
        let problem = sphere(2.0 * scheme.order() as f64, limit);
        let of_mesh =
            |&n: &usize| Some((n, errors(&problem, &on_uniform_mesh(&problem, scheme, n)?)));
        let measured: Vec<_> = COUNTS.iter().filter_map(of_mesh).collect();
        let [nodes, between] = [0, 1].map(|kind| {
            let column: Vec<_> = measured.iter().map(|(n, e)| (*n, e[kind])).collect();
            slope(&column)
        });
        // Beyond that of the continuous solution the order at the nodes is not certain any more.
        let theory = scheme.dense_order() as f64;
        assert!((between - theory).abs() < 0.2, "{scheme:?}: {between}");
        assert!(nodes > theory - 0.2, "{scheme:?}: {nodes}");
    }
}

#[test]
fn a_singular_point_is_no_place_to_refine_and_its_slope_is_right() {
    for tolerance in [1e-3, 1e-6, 1e-9] {
        for options in [
            Options::to(tolerance),
            Options {
                tolerance,
                ..Options::default()
            },
        ] {
            let w = 10.0;
            let problem = sphere(w, false);
            let guess = Constant {
                states: vec![vec![0.0; 2]],
                parameters: vec![],
            };
            let solution = solve(&*problem.equations, &guess, &options).unwrap();
            let (mut y, mut exact) = ([0.0; 2], [0.0; 2]);
            let mut error = 0.0f64;
            for i in 0..=1000 {
                let s = 0.001 * f64::from(i);
                solution.state(0, s, &mut y);
                problem.state(0, s, &mut exact);
                let both = y.iter().zip(exact);
                error = both.fold(error, |e, (y, x)| e.max((y - x).abs() / (1.0 + x.abs())));
            }
            let estimate = solution.error_estimate().unwrap();
            assert!(error < 1.3 * tolerance, "{error:e}");
            assert!(
                (0.3..3.0).contains(&(estimate / error)),
                "{estimate:e} {error:e}"
            );
            let first = solution.mesh(0)[1] * intervals(&solution) as f64;
            assert!(first > 0.4, "{first}");
            solution.derivative(0, 0.0, &mut y);
            let exact = -w * w / 3.0;
            assert!((y[1] / exact - 1.0).abs() < 1e2 * tolerance, "{}", y[1]);
        }
    }
}

#[test]
fn schemes_with_points_at_the_ends_need_the_limit_at_a_singular_point() {
    let guess = Constant {
        states: vec![vec![1.0, 0.0]],
        parameters: vec![],
    };
    let options = Options {
        scheme: Some(Scheme::LobattoIIIA { stages: 3 }),
        ..Options::default()
    };
    let error = solve(
        &Sphere {
            w: 2.0,
            limit: false,
        },
        &guess,
        &options,
    )
    .unwrap_err();
    assert!(matches!(
        error,
        Error::NonFiniteRhs {
            segment: 0,
            s: 0.0,
            component: 1,
            ..
        }
    ));
    assert!(
        solve(
            &Sphere {
                w: 2.0,
                limit: true
            },
            &guess,
            &options
        )
        .is_ok()
    );
}

/// y′ = y/(2s), y(1) = 1 with y = √s; in t = √s if `stretched`.
struct Root {
    stretched: bool,
}

impl Problem for Root {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(1)]
    }

    fn rhs<T: Real>(&self, _: usize, s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[0] / s * if self.stretched { 1.0 } else { 0.5 };
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.end(0)[0] - 1.0;
    }
}

#[test]
fn a_fractional_power_asks_for_tiny_intervals_and_its_root_for_a_few() {
    let guess = Constant {
        states: vec![vec![1.0]],
        parameters: vec![],
    };
    let options = Options::to(1e-6);
    let solution = solve(&Root { stretched: false }, &guess, &options).unwrap();
    assert!(solution.start(0)[0].abs() < 1e-5);
    assert!(solution.mesh(0)[1] < 1e-6, "{:e}", solution.mesh(0)[1]);
    assert!(intervals(&solution) > 20 && solution.stats().meshes > 5);
    let solution = solve(&Root { stretched: true }, &guess, &options).unwrap();
    assert!(solution.start(0)[0].abs() < 1e-12);
    assert_eq!((intervals(&solution), solution.stats().meshes), (3, 1));
}
