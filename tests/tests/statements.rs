//! The statements of the reference problems against their solutions and against differences.

use bvp::{Ends, Equations, Shape};
use reference_problems::{Case, all, case, exact_problems, scaled_error};
use std::collections::HashSet;

/// Numbers that fill \[−1, 1\] evenly, the same in every run: multiples of the golden ratio.
struct Spread(f64);

impl Spread {
    fn next(&mut self) -> f64 {
        self.0 = (self.0 + 0.618_033_988_749_894_9).fract();
        2.0 * self.0 - 1.0
    }

    /// The values, each moved by up to a tenth of 1 + |value|.
    fn around(&mut self, values: &[f64]) -> Vec<f64> {
        let moved = |v: &f64| v + 0.1 * (1.0 + v.abs()) * self.next();
        values.iter().map(moved).collect()
    }
}

/// The states of a reference table at all ends, laid out as [`Ends`] wants them.
fn reference_ends(case: &Case) -> Vec<f64> {
    let mut ends = Vec::new();
    for (index, segment) in case.equations.shape().segments.iter().enumerate() {
        for end in [segment.from, segment.to] {
            let mut points = case.reference.points.iter();
            let point = points.find(|(s, x, _)| *s == index && *x == end);
            ends.extend(&point.expect("a row for every end").2);
        }
    }
    ends
}

/// Asserts a row-major Jacobian of `function` at `z` equal to central differences.
fn assert_jacobian(
    what: &str,
    jacobian: &[f64],
    z: &[f64],
    rows: usize,
    function: impl Fn(&[f64], &mut [f64]),
) {
    let columns = z.len();
    let mut value = vec![f64::NAN; rows];
    function(z, &mut value);
    let row_size = |i: usize| {
        let row = &jacobian[i * columns..(i + 1) * columns];
        row.iter().fold(1.0, |max, v: &f64| v.abs().max(max))
    };
    for j in 0..columns {
        // Both truncation and rounding of the difference are below 1e-9 of the second derivative.
        let h = 1e-6 * (1.0 + z[j].abs());
        let at = |step: f64| {
            let mut moved = z.to_vec();
            moved[j] += step;
            let mut value = vec![f64::NAN; rows];
            function(&moved, &mut value);
            value
        };
        let (plus, minus) = (at(h), at(-h));
        for i in 0..rows {
            let difference = (plus[i] - minus[i]) / (2.0 * h);
            let exact = jacobian[i * columns + j];
            let rounding = 8.0 * f64::EPSILON * value[i].abs() / h;
            assert!(
                (difference - exact).abs() <= 1e-6 * row_size(i) + rounding,
                "{what}: element ({i}, {j}) is {exact}, by differences {difference}"
            );
        }
    }
}

/// Asserts both Jacobians of a statement near given points and ends.
fn assert_jacobians(
    name: &str,
    equations: &dyn Equations,
    points: &[(usize, f64, Vec<f64>)],
    ends: &[f64],
    parameters: &[f64],
) {
    let shape = equations.shape();
    let k = shape.parameters;
    let mut spread = Spread(0.1);
    for (segment, x, y) in points {
        let (n, segment, x) = (y.len(), *segment, *x);
        // Every collocation point lies inside its segment; right-hand sides may be singular at its
        // ends.
        let of = &shape.segments[segment];
        if x <= of.from || x >= of.to {
            continue;
        }
        let z = [spread.around(y), spread.around(parameters)].concat();
        let mut dy = vec![f64::NAN; n];
        let mut jacobian = vec![f64::NAN; n * (n + k)];
        equations.rhs_jacobian(segment, x, &z[..n], &z[n..], &mut dy, &mut jacobian);
        let what = format!("{name}, right-hand side at {x}");
        assert_jacobian(&what, &jacobian, &z, n, |z, dy| {
            equations.evaluate_rhs(segment, x, &z[..n], &z[n..], dy);
        });
    }
    let z = [spread.around(ends), spread.around(parameters)].concat();
    let count = shape.conditions;
    let mut r = vec![f64::NAN; count];
    let mut jacobian = vec![f64::NAN; count * z.len()];
    let (ends, p) = z.split_at(ends.len());
    let at = Ends::new(&shape.segments, ends);
    equations.conditions_jacobian(at, p, &mut r, &mut jacobian);
    let what = format!("{name}, conditions");
    assert_jacobian(&what, &jacobian, &z, count, |z, r| {
        let (ends, p) = z.split_at(ends.len());
        equations.evaluate_conditions(Ends::new(&shape.segments, ends), p, r);
    });
}

/// The conditions at the given ends.
fn conditions(equations: &dyn Equations, ends: &[f64], parameters: &[f64]) -> Vec<f64> {
    let shape = equations.shape();
    let mut r = vec![f64::NAN; shape.conditions];
    let at = Ends::new(&shape.segments, ends);
    equations.evaluate_conditions(at, parameters, &mut r);
    r
}

#[test]
fn every_case_is_complete() {
    let cases = all();
    assert_eq!(cases.len(), 89);
    let ids: HashSet<&str> = cases.iter().map(|case| case.id).collect();
    assert_eq!(ids.len(), 89, "names are unique");
    for case in &cases {
        let (id, equations) = (case.id, &case.equations);
        let Shape {
            segments,
            parameters: k,
            conditions,
        } = equations.shape();
        let states: usize = segments.iter().map(|segment| segment.states).sum();
        assert_eq!(conditions, states + k, "{id}");
        assert_eq!(case.parameter_guess.len(), k, "{id}");
        assert_eq!(case.reference.parameters.len(), k, "{id}");
        assert!(case.initial_intervals >= segments.len(), "{id}");
        assert!(!case.name.is_empty() && !case.source.is_empty(), "{id}");
        let key = |point: &(usize, f64, Vec<f64>)| (point.0, point.1);
        assert!(
            case.reference.points.is_sorted_by(|a, b| key(a) < key(b)),
            "{id}"
        );
        for (segment, x, y) in &case.reference.points {
            let of = &segments[*segment];
            assert_eq!(y.len(), of.states, "{id}");
            assert!(of.from <= *x && *x <= of.to, "{id}: no point {x}");
            let mut guess = vec![f64::NAN; of.states];
            (case.guess)(*segment, *x, &mut guess);
            assert!(guess.iter().chain(y).all(|v| v.is_finite()), "{id} at {x}");
        }
    }
}

#[test]
fn a_case_is_found_by_name() {
    let found = case("E31").expect("the case with free final time");
    assert_eq!(found.equations.shape().parameters, 2);
    assert!(case("T99").is_none());
}

#[test]
fn the_error_is_scaled_and_keeps_not_a_number() {
    assert_eq!(scaled_error(&[1.0, 4.0], &[1.0, 3.0]), 0.25);
    assert!(scaled_error(&[f64::NAN, 4.0], &[1.0, 3.0]).is_nan());
    assert!(scaled_error(&[4.0, f64::NAN], &[3.0, 1.0]).is_nan());
}

#[test]
fn the_reference_solutions_meet_the_conditions() {
    for case in all() {
        let ends = reference_ends(&case);
        let size = ends.iter().fold(1.0, |max, v: &f64| v.abs().max(max));
        let r = conditions(&*case.equations, &ends, &case.reference.parameters);
        for (i, r) in r.iter().enumerate() {
            assert!(r.abs() <= 1e-9 * size, "{}: condition {i} is {r}", case.id);
        }
    }
}

#[test]
fn the_jacobians_equal_differences() {
    for case in all() {
        let ends = reference_ends(&case);
        let (points, parameters) = (&case.reference.points, &case.reference.parameters);
        assert_jacobians(case.id, &*case.equations, points, &ends, parameters);
    }
}

#[test]
fn the_exact_solutions_solve_their_problems() {
    for problem in exact_problems() {
        let (equations, p) = (&*problem.equations, &problem.parameters);
        let (mut points, mut ends) = (Vec::new(), Vec::new());
        for (index, segment) in equations.shape().segments.iter().enumerate() {
            let solution = |x: f64| {
                let mut y = vec![f64::NAN; segment.states];
                (problem.solution)(index, x, &mut y);
                y
            };
            let length = segment.to - segment.from;
            for tenth in 1..10 {
                let x = segment.from + length * f64::from(tenth) / 10.0;
                let y = solution(x);
                let mut dy = vec![f64::NAN; segment.states];
                equations.evaluate_rhs(index, x, &y, p, &mut dy);
                let slopes = differences(solution, x, 1e-3 * length);
                let error = scaled_error(&slopes, &dy);
                assert!(
                    error < 1e-9,
                    "{}: slope off by {error} at {x}",
                    problem.name
                );
                points.push((index, x, y));
            }
            ends.extend(solution(segment.from));
            ends.extend(solution(segment.to));
        }
        for r in conditions(equations, &ends, p) {
            assert!(r.abs() < 1e-13, "{}: condition is {r}", problem.name);
        }
        assert_jacobians(problem.name, equations, &points, &ends, p);
    }
}

/// Derivative of `y` at `x` by central differences of order 6 with step `h`.
fn differences(y: impl Fn(f64) -> Vec<f64>, x: f64, h: f64) -> Vec<f64> {
    let mut slopes = vec![0.0; y(x).len()];
    for (step, weight) in [(1.0, 45.0), (2.0, -9.0), (3.0, 1.0)] {
        let (plus, minus) = (y(x + step * h), y(x - step * h));
        for (slope, (plus, minus)) in slopes.iter_mut().zip(plus.iter().zip(minus)) {
            *slope += weight * (plus - minus) / (60.0 * h);
        }
    }
    slopes
}
