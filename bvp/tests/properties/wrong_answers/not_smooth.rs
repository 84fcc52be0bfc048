//! Right-hand sides with jumps, kinks, narrow peaks and singular ends.

use super::{Score, place};
use bvp::{Constant, Ends, Equations, Error, Options, Problem, Real, Segment, Solution, solve};

fn from_zero(problem: &dyn Equations, states: usize, tolerance: f64) -> Result<Solution, Error> {
    let guess = Constant {
        states: vec![vec![0.0; states]],
        parameters: vec![],
    };
    solve(problem, &guess, &Options::to(tolerance))
}

/// y'' = −c for a < s < b, zero elsewhere and at the ends.
struct Load {
    c: f64,
    a: f64,
    b: f64,
}

impl Load {
    fn exact(&self) -> impl Fn(f64) -> f64 {
        let (a, b, half) = (self.a, self.b, 0.5 * self.c);
        let twice = move |s: f64| half * ((s - a).max(0.0).powi(2) - (s - b).max(0.0).powi(2));
        move |s| twice(1.0) * s - twice(s)
    }
}

impl Problem for Load {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2)]
    }

    fn rhs<T: Real>(&self, _segment: usize, s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        let inside = self.a < s.value() && s.value() < self.b;
        dy[0] = y[1];
        dy[1] = T::from(if inside { -self.c } else { 0.0 });
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0];
    }
}

#[test]
fn a_jump_at_any_place_is_found() {
    for tolerance in [1e-3, 1e-6, 1e-9] {
        let mut score = Score::default();
        for i in 0..100 {
            let load = Load {
                c: 100.0,
                a: place(i),
                b: 2.0,
            };
            let outcome = from_zero(&load, 2, tolerance);
            score.count(&format!("{}", load.a), tolerance, outcome, load.exact());
        }
        // Most are even solved, by intervals so short that the jump does not matter.
        assert!(score.solved >= 90, "{tolerance:e}: {score:?}");
    }
}

#[test]
fn jumps_of_any_size_are_found() {
    for (i, c) in (0..40).zip([1e-2, 1.0, 30.0, 931.0].into_iter().cycle()) {
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let a = place(i);
            let load = Load { c, a, b: a + 0.2 };
            let outcome = from_zero(&load, 2, tolerance);
            let name = format!("{c} from {a}");
            Score::default().count(&name, tolerance, outcome, load.exact());
        }
    }
}

/// y' = 1 + c \[y > θ\], y(0) = 0.
struct Switch {
    c: f64,
    theta: f64,
}

impl Problem for Switch {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(1)]
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        let beyond = y[0].value() > self.theta;
        dy[0] = T::from(if beyond { 1.0 + self.c } else { 1.0 });
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
    }
}

#[test]
fn a_jump_that_a_state_decides_on_is_where_the_state_is() {
    let mut score = Score::default();
    for c in [0.3, 3.0, 25.0, 40.0, 60.0] {
        for i in 0..20 {
            let theta = place(i);
            let outcome = from_zero(&Switch { c, theta }, 1, 1e-3);
            let name = format!("{c} from {theta}");
            score.count(&name, 1e-3, outcome, |s| s + c * (s - theta).max(0.0));
        }
    }
    // Newton's method does not see what moves the jump, and contracts by c / (1 + c).
    assert!(score.solved >= 40, "{score:?}");
}

/// y' = ± c x^(−α), with the solution x^(1 − α); x is s, or 1 − s, where numbers near the end are no nearer to
/// each other than 1e-16.
struct Power {
    alpha: f64,
    at_right_end: bool,
}

impl Power {
    fn exact(&self, s: f64) -> f64 {
        let x = if self.at_right_end { 1.0 - s } else { s };
        x.powf(1.0 - self.alpha)
    }
}

impl Problem for Power {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(1)]
    }

    fn rhs<T: Real>(&self, _segment: usize, s: T, _y: &[T], _p: &[T], dy: &mut [T]) {
        let (x, sign) = match self.at_right_end {
            true => (-s + 1.0, -1.0),
            false => (s, 1.0),
        };
        dy[0] = x.powf(-self.alpha) * (sign * (1.0 - self.alpha));
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] - self.exact(0.0);
    }
}

#[test]
fn an_infinite_slope_at_an_end_is_graded_for_or_refused() {
    let mut score = Score::default();
    for alpha in [0.1, 0.3, 0.5, 0.7, 0.8, 0.85, 0.9, 0.95] {
        for (at_right_end, tolerance) in [false, true]
            .into_iter()
            .flat_map(|right| [1e-3, 1e-6, 1e-9].map(|tolerance| (right, tolerance)))
        {
            let problem = Power {
                alpha,
                at_right_end,
            };
            let outcome = from_zero(&problem, 1, tolerance);
            let name = format!("{alpha} {at_right_end}");
            score.count(&name, tolerance, outcome, |s| problem.exact(s));
        }
    }
    assert!(score.solved >= 18, "{score:?}");
}
