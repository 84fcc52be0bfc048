//! Derivatives of one problem from three sources, and of problems of every size.

use bvp::{
    Constant, Ends, Equations, FiniteDifferences, Function, Options, Problem, Real, Segment, Shape,
    check_jacobians, solve,
};

/// A forced pendulum with unknown duration p₀ and damping p₁, and nonlinear conditions.
struct Pendulum;

impl Problem for Pendulum {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2)]
    }

    fn parameters(&self) -> usize {
        2
    }

    fn rhs<T: Real>(&self, _: usize, s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = p[0] * y[1];
        dy[1] = p[0] * (s * 0.1 - y[0].sin() - p[1] * y[1] * y[1].abs());
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let (start, end) = (at.start(0), at.end(0));
        r[0] = start[0] - 1.0;
        r[1] = start[1] * p[0];
        r[2] = end[1] * p[0];
        r[3] = end[0] * end[0] - 0.64 + p[1] * 0.1;
    }
}

/// The same by hand.
struct ByHand;

impl Equations for ByHand {
    fn shape(&self) -> Shape {
        Shape::new(vec![Segment::new(2)], 2)
    }

    fn evaluate_rhs(&self, _: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]) {
        dy[0] = p[0] * y[1];
        dy[1] = p[0] * (0.1 * s - y[0].sin() - p[1] * y[1] * y[1].abs());
    }

    fn rhs_jacobian(
        &self,
        segment: usize,
        s: f64,
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobian: &mut [f64],
    ) {
        self.evaluate_rhs(segment, s, y, p, dy);
        let drag = y[1] * y[1].abs();
        jacobian.copy_from_slice(&[
            0.0,
            p[0],
            y[1],
            0.0,
            -p[0] * y[0].cos(),
            -2.0 * p[0] * p[1] * y[1].abs(),
            0.1 * s - y[0].sin() - p[1] * drag,
            -p[0] * drag,
        ]);
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]) {
        let (start, end) = (at.start(0), at.end(0));
        r[0] = start[0] - 1.0;
        r[1] = start[1] * p[0];
        r[2] = end[1] * p[0];
        r[3] = end[0] * end[0] - 0.64 + 0.1 * p[1];
    }

    #[rustfmt::skip]
    fn conditions_jacobian(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64], jacobian: &mut [f64]) {
        self.evaluate_conditions(at, p, r);
        let (start, end) = (at.start(0), at.end(0));
        jacobian.copy_from_slice(&[
            1.0, 0.0,  0.0,          0.0,  0.0,      0.0,
            0.0, p[0], 0.0,          0.0,  start[1], 0.0,
            0.0, 0.0,  0.0,          p[0], end[1],   0.0,
            0.0, 0.0,  2.0 * end[0], 0.0,  0.0,      0.1,
        ]);
    }
}

fn by_differences() -> impl Equations {
    FiniteDifferences {
        segments: vec![Segment::new(2)],
        parameters: 2,
        condition_count: 4,
        rhs: |segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]| {
            ByHand.evaluate_rhs(segment, s, y, p, dy);
        },
        conditions: |at: Ends<'_, f64>, p: &[f64], r: &mut [f64]| {
            ByHand.evaluate_conditions(at, p, r);
        },
    }
}

/// Half a swing from 1 to about −0.8.
fn guess() -> Function<fn(usize, f64) -> [f64; 2]> {
    Function {
        state: |_, s| {
            let angle = std::f64::consts::PI * s;
            [0.1 + 0.9 * angle.cos(), -0.9 * angle.sin()]
        },
        parameters: vec![3.3, 0.1],
    }
}

#[test]
fn three_sources_of_derivatives_agree() {
    let exact = check_jacobians(&Pendulum, &ByHand, &guess());
    assert!(exact.difference < 1e-13, "{exact:?}");
    for equations in [&Pendulum as &dyn Equations, &ByHand] {
        let check = check_jacobians(equations, &by_differences(), &guess());
        assert!(check.difference < 1e-8, "{check:?}");
        let check = check_jacobians(equations, &FiniteDifferences::of(equations), &guess());
        assert!(check.difference < 1e-8, "{check:?}");
    }
}

/// Segments of unknown lengths p₁, p₂, … with one parameter p₀ for all of them.
struct Lengths {
    segments: usize,
    states: usize,
    /// Whether it tells which parameters a segment depends on.
    tells: bool,
}

impl Problem for Lengths {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(self.states); self.segments]
    }

    fn parameters(&self) -> usize {
        1 + self.segments
    }

    fn rhs<T: Real>(&self, segment: usize, s: T, y: &[T], p: &[T], dy: &mut [T]) {
        for (state, dy) in dy.iter_mut().enumerate() {
            *dy = p[1 + segment] * (y[(state + 1) % y.len()].sin() + p[0] * y[state] * s);
        }
    }

    fn depends(&self, segment: usize, parameter: usize) -> bool {
        !self.tells || parameter == 0 || parameter == 1 + segment
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        for (r, z) in r.iter_mut().zip(at.values().iter().chain(p)) {
            *r = *z * *z;
        }
    }
}

#[test]
fn derivatives_by_parameters_of_other_segments_are_zero() {
    // The widths of one pass of dual numbers, and more parameters than one carries.
    for (segments, states) in [
        (1, 2),
        (3, 1),
        (2, 2),
        (3, 2),
        (8, 2),
        (8, 6),
        (20, 4),
        (30, 2),
    ] {
        let [told, untold] = [true, false].map(|tells| Lengths {
            segments,
            states,
            tells,
        });
        let guess = Constant {
            states: vec![vec![0.7; states]; segments],
            parameters: (0..=segments).map(|i| 1.5 + i as f64).collect(),
        };
        let check = check_jacobians(&told, &untold, &guess);
        assert_eq!(check.difference, 0.0, "{segments} {states}: {check:?}");
    }
}

#[test]
fn three_sources_of_derivatives_give_one_solution() {
    let options = Options {
        tolerance: 1e-9,
        ..Options::default()
    };
    let solutions = [&Pendulum as &dyn Equations, &ByHand, &by_differences()]
        .map(|equations| solve(equations, &guess(), &options).unwrap());
    let [exact, by_hand, differenced] = solutions;
    assert_eq!(exact.stats().newton_steps, by_hand.stats().newton_steps);
    for other in [by_hand, differenced] {
        for (a, b) in exact.parameters().iter().zip(other.parameters()) {
            assert!((a - b).abs() < 1e-10, "{a} {b}");
        }
    }
}

/// A wrong entry of a hand-written Jacobian.
struct Mistaken;

impl Equations for Mistaken {
    fn shape(&self) -> Shape {
        ByHand.shape()
    }

    fn evaluate_rhs(&self, segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]) {
        ByHand.evaluate_rhs(segment, s, y, p, dy);
    }

    fn rhs_jacobian(
        &self,
        segment: usize,
        s: f64,
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobian: &mut [f64],
    ) {
        ByHand.rhs_jacobian(segment, s, y, p, dy, jacobian);
        jacobian[4] *= 2.0;
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]) {
        ByHand.evaluate_conditions(at, p, r);
    }

    fn conditions_jacobian(
        &self,
        at: Ends<'_, f64>,
        p: &[f64],
        r: &mut [f64],
        jacobian: &mut [f64],
    ) {
        ByHand.conditions_jacobian(at, p, r, jacobian);
    }
}

#[test]
fn a_mistake_is_found_where_it_is() {
    let check = check_jacobians(&Mistaken, &Pendulum, &guess());
    assert!(check.difference > 0.1);
    let (segment, _) = check.rhs.expect("the right-hand side");
    assert_eq!((segment, check.row, check.column), (0, 1, Some(0)));
}

/// n states in a nonlinear ring, one parameter: every width of dual number.
struct Ring(Vec<Segment>);

impl Problem for Ring {
    fn segments(&self) -> Vec<Segment> {
        self.0.clone()
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, s: T, y: &[T], p: &[T], dy: &mut [T]) {
        let n = y.len();
        for i in 0..n {
            dy[i] = (y[(i + 1) % n] * p[0]).sin() - y[i] * s + y[(i + 5) % n].powi(2);
        }
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let (start, end) = (at.start(0), at.end(0));
        let n = start.len();
        for i in 0..n {
            r[i] = start[i] * end[(i + 2) % n] - p[0];
        }
        r[n] = start[0] + end[n - 1].exp();
    }
}

#[test]
fn every_number_of_directions_is_differentiated() {
    for n in 1..=30 {
        let ring = Ring(vec![Segment::new(n)]);
        let guess = Constant {
            states: vec![(0..n).map(|i| (1.0 + i as f64).sin()).collect()],
            parameters: vec![0.7],
        };
        let check = check_jacobians(&ring, &FiniteDifferences::of(&ring), &guess);
        assert!(check.difference < 1e-8, "{n}: {check:?}");
    }
}
