//! Equations that are evaluated at many points in a call.

use bvp::{Constant, Ends, Equations, Options, Problem, Real, Segment, Shape, solve};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Bratu's problem, y'' + p eʸ = 0 with y = 0 at both ends, and p such that y = 1 in the middle.
struct Bratu;

impl Problem for Bratu {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, 0.0, 0.5)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -(p[0] * y[0].exp());
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0] - 1.0;
        r[2] = at.end(0)[1];
    }
}

/// The same, with the numbers of calls: for one point and for many.
#[derive(Default)]
struct Counted {
    single: AtomicUsize,
    together: AtomicUsize,
    points: AtomicUsize,
}

fn add(to: &AtomicUsize, count: usize) {
    to.fetch_add(count, Ordering::Relaxed);
}

impl Equations for Counted {
    fn shape(&self) -> Shape {
        Bratu.shape()
    }

    fn evaluate_rhs(&self, segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]) {
        add(&self.single, 1);
        Bratu.evaluate_rhs(segment, s, y, p, dy);
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
        add(&self.single, 1);
        Bratu.rhs_jacobian(segment, s, y, p, dy, jacobian);
    }

    fn is_vectorised(&self) -> bool {
        true
    }

    fn evaluate_rhs_at(&self, segment: usize, s: &[f64], y: &[f64], p: &[f64], dy: &mut [f64]) {
        add(&self.together, 1);
        add(&self.points, s.len());
        Bratu.evaluate_rhs_at(segment, s, y, p, dy);
    }

    fn rhs_jacobian_at(
        &self,
        segment: usize,
        s: &[f64],
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobians: &mut [f64],
    ) {
        add(&self.together, 1);
        add(&self.points, s.len());
        Bratu.rhs_jacobian_at(segment, s, y, p, dy, jacobians);
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]) {
        Bratu.evaluate_conditions(at, p, r);
    }

    fn conditions_jacobian(
        &self,
        at: Ends<'_, f64>,
        p: &[f64],
        r: &mut [f64],
        jacobian: &mut [f64],
    ) {
        Bratu.conditions_jacobian(at, p, r, jacobian);
    }
}

#[test]
fn many_points_in_a_call_change_no_digit() {
    let guess = Constant {
        states: vec![vec![1.0, 1.0]],
        parameters: vec![1.0],
    };
    for tolerance in [1e-4, 1e-8, 1e-12] {
        let options = Options::to(tolerance);
        let alone = solve(&Bratu, &guess, &options).unwrap();
        let counted = Counted::default();
        let together = solve(&counted, &guess, &options).unwrap();
        assert_eq!(together.mesh(0), alone.mesh(0));
        assert_eq!(together.parameters(), alone.parameters());
        assert_eq!(together.end(0), alone.end(0));
        assert_eq!(together.defects(0), alone.defects(0));
        assert_eq!(together.error_estimate(), alone.error_estimate());

        let [single, calls, points] = [&counted.single, &counted.together, &counted.points]
            .map(|count| count.load(Ordering::Relaxed));
        assert_eq!(
            together.stats().rhs_evaluations,
            alone.stats().rhs_evaluations
        );
        println!("{tolerance:e}: {single} points alone, {points} in {calls} calls");
        assert!(points >= 20 * calls && points > single);
    }
}
