//! Families of solutions that the conditions leave.

use bvp::{Constant, Ends, Error, Function, Options, Problem, Real, Segment, Solution, solve};
use std::f64::consts::PI;

/// Autonomous equations over their period, without a condition on the phase.
enum Orbit {
    /// ẍ = μ (1 − x²) ẋ − x.
    VanDerPol { mu: f64 },
    /// ẋ = x − x y, ẏ = a (x y − y).
    LotkaVolterra { a: f64 },
    /// ẍ = −sin x, round and round: x grows by 2π.
    Rotating,
    /// ẋ = ω ẏ, ẏ = −ω x.
    Rotation,
}

struct Periodic {
    orbit: Orbit,
    period: f64,
}

impl Problem for Periodic {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2)]
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        let (x, v) = (y[0], y[1]);
        let f = match self.orbit {
            Orbit::VanDerPol { mu } => [v, -(x * x - 1.0) * v * mu - x],
            Orbit::LotkaVolterra { a } => [x - x * v, (x * v - v) * a],
            Orbit::Rotating => [v, -x.sin()],
            Orbit::Rotation => [v, -x],
        };
        for (dy, f) in dy.iter_mut().zip(f) {
            *dy = f * self.period;
        }
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        let turn = match self.orbit {
            Orbit::Rotating => 2.0 * PI,
            _ => 0.0,
        };
        r[0] = at.end(0)[0] - at.start(0)[0] - turn;
        r[1] = at.end(0)[1] - at.start(0)[1];
    }
}

/// The orbit from a state by classical Runge-Kutta steps, as a guess.
fn along(problem: &Periodic, from: [f64; 2]) -> Vec<[f64; 2]> {
    let slope = |y: [f64; 2]| {
        let mut dy = [0.0; 2];
        problem.rhs(0, 0.0, &y, &[], &mut dy);
        dy
    };
    let h = 1.0 / 2000.0;
    let step = |y: &[f64; 2]| {
        let add = |k: [f64; 2], c: f64| [y[0] + c * h * k[0], y[1] + c * h * k[1]];
        let k1 = slope(*y);
        let k2 = slope(add(k1, 0.5));
        let k3 = slope(add(k2, 0.5));
        let k4 = slope(add(k3, 1.0));
        let next = |i: usize| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
        Some([next(0), next(1)])
    };
    std::iter::successors(Some(from), step).take(2001).collect()
}

fn attempt(problem: &Periodic, from: [f64; 2], tolerance: f64) -> Result<Solution, Error> {
    let orbit = along(problem, from);
    let guess = Function {
        state: |_: usize, s: f64| {
            // The last of 2000 equal steps that begins before s.
            let step = (1..2000u16).rev().find(|&k| f64::from(k) <= 2000.0 * s);
            let k = step.unwrap_or(0);
            let share = 2000.0 * s - f64::from(k);
            let [before, after] = [k, k + 1].map(|k| orbit[usize::from(k)]);
            [0, 1].map(|i| before[i] + share * (after[i] - before[i]))
        },
        parameters: vec![],
    };
    solve(problem, &guess, &Options::to(tolerance))
}

#[test]
fn an_orbit_without_a_phase_is_refused_as_a_family_of_shifts() {
    // Periods of Van der Pol's oscillator by a stable integration to 1e-13, of the rotating pendulum
    // from ẋ = 3 by the elliptic integral 4 K(4/9) / 3.
    let orbits = [
        (
            Orbit::VanDerPol { mu: 1.0 },
            6.663_286_859_323_126,
            [2.008_619_860_874_843, 0.0],
        ),
        (Orbit::Rotation, 2.0 * PI, [1.0, 0.5]),
        (Orbit::Rotation, 2.0 * PI, [-0.2, 3.0]),
    ];
    for (orbit, period, from) in orbits {
        let problem = Periodic { orbit, period };
        for tolerance in [1e-2, 1e-3, 1e-6, 1e-9] {
            match attempt(&problem, from, tolerance) {
                Err(error @ Error::SingularConditions { .. }) => {
                    let text = error.to_string();
                    assert!(text.contains("family") || text.contains("free"), "{text}");
                }
                Err(Error::IllConditioned { .. }) => {}
                Err(error) => panic!("{tolerance:e}: {error}"),
                // A state of rest is a periodic solution, too.
                Ok(solution) => {
                    let rest = solution.start(0).iter().all(|y| y.abs() < 1e-6);
                    assert!(rest, "{tolerance:e}: {:?}", solution.start(0));
                }
            }
        }
    }
}

#[test]
fn the_shift_of_van_der_pols_orbit_is_named() {
    let problem = Periodic {
        orbit: Orbit::VanDerPol { mu: 1.0 },
        period: 6.663_286_859_323_126,
    };
    // Beside a singular matrix rounding decides where Newton's method goes: some guesses go to the state of rest,
    // which is a periodic solution, too.
    for tolerance in [1e-2, 1e-3, 1e-6, 1e-9] {
        let mut shifts = 0;
        for amplitude in [1.8, 1.9, 2.0, 2.1, 2.2] {
            let guess = Function {
                state: |_: usize, s: f64| {
                    let angle = 2.0 * PI * s;
                    [amplitude * angle.cos(), -amplitude * angle.sin()]
                },
                parameters: vec![],
            };
            match solve(&problem, &guess, &Options::to(tolerance)) {
                Err(error) => {
                    assert!(
                        matches!(error, Error::SingularConditions { shift: true, .. }),
                        "{tolerance:e}: {error}"
                    );
                    assert!(error.to_string().contains("shift of s"), "{error}");
                    shifts += 1;
                }
                Ok(solution) => assert!(solution.start(0).iter().all(|y| y.abs() < 1e-6)),
            }
        }
        assert!(shifts > 0, "{tolerance:e}");
    }
}

#[test]
fn orbits_that_come_in_families_are_refused() {
    for (orbit, period, from) in [
        (Orbit::LotkaVolterra { a: 1.0 }, 6.5, [1.0, 0.5]),
        (Orbit::Rotating, 3.0, [0.0, 2.5]),
    ] {
        let problem = Periodic { orbit, period };
        for tolerance in [1e-3, 1e-6, 1e-9] {
            if let Ok(solution) = attempt(&problem, from, tolerance) {
                let [mut slope, y] = [[0.0; 2], [solution.start(0)[0], solution.start(0)[1]]];
                problem.rhs(0, 0.0, &y, &[], &mut slope);
                // Only a state of rest is isolated.
                assert!(slope.iter().all(|f| f.abs() < 1e-6), "{tolerance:e}: {y:?}");
            }
        }
    }
}

/// The period of Van der Pol's limit cycle, which attracts, and its point with v = 0 on the right.
fn limit_cycle(mu: f64) -> (f64, [f64; 2]) {
    let (mut period, mut from) = (2.0 * PI, [2.0, 0.0]);
    for _ in 0..60 {
        let problem = Periodic {
            orbit: Orbit::VanDerPol { mu },
            period,
        };
        let end = along(&problem, from)[2000];
        let mut slope = [0.0; 2];
        problem.rhs(0, 0.0, &end, &[], &mut slope);
        let late = end[1] / slope[1];
        period *= 1.0 - late;
        from = [end[0] - late * slope[0], 0.0];
    }
    (period, from)
}

#[test]
fn a_limit_cycle_that_a_coarse_mesh_seems_to_fix_is_refused() {
    for i in 0..40 {
        let mu = 0.15 * 6f64.powf(f64::from(i) / 40.0);
        let (period, from) = limit_cycle(mu);
        let problem = Periodic {
            orbit: Orbit::VanDerPol { mu },
            period,
        };
        for off in [0.0, 1e-6, 1e-3, 1e-2] {
            if let Ok(solution) = attempt(&problem, [from[0] + off, off], 1e-3) {
                let rest = solution.start(0).iter().all(|y| y.abs() < 1e-6);
                assert!(rest, "{mu} {off}: {:?}", solution.start(0));
            }
        }
    }
}

/// y'' + (k π)² y = q sin(m π s), m ≠ k, with zero ends: sin(k π s) may be added.
struct Resonance {
    k: f64,
    q: f64,
    m: f64,
}

impl Problem for Resonance {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2)]
    }

    fn rhs<T: Real>(&self, _segment: usize, s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = (s * (self.m * PI)).sin() * self.q - y[0] * (self.k * PI).powi(2);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0];
    }
}

#[test]
fn a_resonance_is_refused() {
    for k in [1.0, 2.0, 3.0] {
        for (q, value) in [(10.0, 0.0), (100.0, 1.0)] {
            for tolerance in [1e-3, 1e-6, 1e-9] {
                let guess = Constant {
                    states: vec![vec![value, 0.0]],
                    parameters: vec![],
                };
                let problem = Resonance { k, q, m: k + 1.0 };
                let outcome = solve(&problem, &guess, &Options::to(tolerance));
                assert!(outcome.is_err(), "k = {k}, q = {q}, {value}, {tolerance:e}");
            }
        }
    }
}

/// The load makes less of it than the tolerance, so that any mesh resolves the solution, also one with a wave
/// of the resonance on every interval.
#[test]
fn a_resonance_that_a_load_hardly_shows_is_refused() {
    for k in [3.0, 4.0, 5.0, 6.0, 7.0] {
        for beyond in [1.0, 2.0, 3.0] {
            for q in [-0.15, -0.07, -0.02, 0.01, 0.03, 0.2] {
                let guess = Constant {
                    states: vec![vec![0.0, 0.0]],
                    parameters: vec![],
                };
                let problem = Resonance {
                    k,
                    q,
                    m: k + beyond,
                };
                let outcome = solve(&problem, &guess, &Options::to(1e-3));
                assert!(outcome.is_err(), "k = {k}, {beyond}, q = {q}");
            }
        }
    }
}

/// y' = −(c/s) (y − u/ε), where u = p − w is a small difference: y feels a change of p a hundred times, and what a
/// forced condition leaves at s = 0 decays as s^(−c), which no mesh resolves. The solution y = 1 is isolated.
struct StiffSingularEnd;

impl Problem for StiffSingularEnd {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = T::ZERO;
        dy[1] = ((p[0] - y[0]) * 100.0 - y[1]) * 40.0 / s;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let y = at.start(0);
        r[0] = p[0] - 1.0;
        r[1] = y[0] - 0.99;
        r[2] = y[1] - (p[0] - y[0]) * 100.0;
    }
}

#[test]
fn a_layer_that_no_mesh_resolves_at_a_singular_end_is_no_direction_of_a_family() {
    let guess = Constant {
        states: vec![vec![0.9, 0.5]],
        parameters: vec![1.0],
    };
    for tolerance in [1e-3, 1e-6] {
        let options = Options {
            tolerance,
            ..Options::default()
        };
        let solution = solve(&StiffSingularEnd, &guess, &options).unwrap();
        let mut y = [0.0; 2];
        solution.state(0, 0.3, &mut y);
        assert!((y[1] - 1.0).abs() < tolerance, "{}", y[1]);
        assert!(solution.stats().factorisations <= 5);
    }
}
