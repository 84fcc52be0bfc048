//! Joined points: conditions inside a segment, right-hand sides that jump there, and the same solution as
//! of the segments on either side.

use bvp::{
    Constant, Control, Embedding, Ends, Error, Family, FiniteDifferences, Function, LeftOf,
    Options, Problem, Real, Scheme, Segment, Solution, Table, solve, solve_embedded,
};
use proptest::prelude::*;

/// y''' = −8 cos 2s with y given at 0 and at two joined points, so that y = sin 2s.
struct ThreePoints {
    joined: [f64; 2],
}

impl Problem for ThreePoints {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(3, 0.0, 2.0).joined(&self.joined)]
    }

    fn rhs<T: Real>(&self, _segment: usize, s: T, y: &[T], _p: &[T], dy: &mut [T])
    where
        f64: LeftOf<T>,
    {
        dy[0] = y[1];
        dy[1] = y[2];
        dy[2] = -8.0 * (2.0 * s).cos();
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        for (i, s) in self.joined.iter().enumerate() {
            r[i + 1] = at.joined(0, i)[0] - (2.0 * s).sin();
        }
    }
}

fn zero(states: usize, parameters: usize) -> Constant {
    Constant {
        states: vec![vec![0.0; states]],
        parameters: vec![0.0; parameters],
    }
}

fn assert_sine(solution: &Solution, tolerance: f64) {
    let (mut y, mut slope) = ([0.0; 3], [0.0; 3]);
    for i in 0..=1000 {
        let s = 0.002 * f64::from(i);
        solution.state(0, s, &mut y);
        solution.derivative(0, s, &mut slope);
        let (sin, cos) = (2.0 * s).sin_cos();
        let exact = [sin, 2.0 * cos, -4.0 * sin, -8.0 * cos];
        let found = [y[0], y[1], y[2], slope[2]];
        for (found, exact) in found.iter().zip(exact).take(3) {
            assert!((found - exact).abs() <= tolerance * (1.0 + exact.abs()));
        }
        assert!((slope[0] - y[1]).abs() < 100.0 * tolerance);
    }
}

proptest! {
    #[test]
    fn conditions_at_joined_points_give_the_exact_solution(
        first in 0.1..0.9f64,
        second in 1.0..1.9f64,
        exponent in 4..10i32,
    ) {
        let problem = ThreePoints { joined: [first, second] };
        let tolerance = 10f64.powi(-exponent);
        let solution = solve(&problem, &zero(3, 0), &Options::to(tolerance)).unwrap();
        assert_sine(&solution, tolerance);
        for s in problem.joined {
            prop_assert!(solution.mesh(0).contains(&s));
        }
        let nodes = solution.mesh(0);
        prop_assert!(nodes.windows(2).all(|pair| pair[0] < pair[1]));
        prop_assert_eq!(solution.defects(0).len(), nodes.len() - 1);
        prop_assert_eq!(solution.state_errors(0).unwrap().len(), 3);
        prop_assert_eq!(solution.segments(), problem.segments());
    }
}

/// y'' = −load beyond `place` and nothing before it, y(0) = y(1) = 0.
struct Jump {
    place: f64,
    /// Whether the load is there at the place itself.
    closed: bool,
}

const LOAD: f64 = 100.0;

impl Problem for Jump {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2).joined(&[self.place])]
    }

    fn rhs<T: Real>(&self, _segment: usize, s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        let is_loaded = s > self.place || (self.closed && s == self.place);
        dy[0] = y[1];
        dy[1] = T::from(if is_loaded { -LOAD } else { 0.0 });
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0];
    }
}

impl Jump {
    fn exact(&self, s: f64) -> f64 {
        let beyond = |s: f64| 0.5 * LOAD * (s - self.place).max(0.0).powi(2);
        beyond(1.0) * s - beyond(s)
    }
}

proptest! {
    /// Both pieces are polynomials: every scheme has them exactly, also those with points at nodes.
    #[test]
    fn a_right_hand_side_may_jump_at_a_joined_point(
        place in 0.01..0.99f64,
        closed: bool,
        gauss: bool,
        control in prop_oneof![Just(Control::Error), Just(Control::Defect)],
    ) {
        let problem = Jump { place, closed };
        let options = Options {
            scheme: Some(match gauss {
                true => Scheme::Gauss { stages: 4 },
                false => Scheme::LobattoIIIA { stages: 4 },
            }),
            control,
            ..Options::to(1e-9)
        };
        let solution = solve(&problem, &zero(2, 0), &options).unwrap();
        let mut y = [0.0; 2];
        for i in 0..=100 {
            let s = 0.01 * f64::from(i);
            solution.state(0, s, &mut y);
            let exact = problem.exact(s);
            prop_assert!((y[0] - exact).abs() < 1e-10 * (1.0 + exact.abs()), "{s}: {y:?}");
        }
    }
}

/// y'' = −p y with y(0) = 0, y'(0) = 1 and y(0.8) = sin(1.6)/2: p = 4 if y'' is that of one sine. As
/// one segment with a joined point or as two.
fn oscillator(joined: bool) -> impl bvp::Equations {
    let segments = match joined {
        true => vec![Segment::on(2, 0.0, 2.0).joined(&[0.8])],
        false => vec![Segment::on(2, 0.0, 0.8), Segment::on(2, 0.8, 2.0)],
    };
    FiniteDifferences {
        segments,
        parameters: 1,
        condition_count: if joined { 3 } else { 5 },
        rhs: |_: usize, _s: f64, y: &[f64], p: &[f64], dy: &mut [f64]| {
            dy.copy_from_slice(&[y[1], -p[0] * y[0]]);
        },
        conditions: move |at: Ends<'_, f64>, _p: &[f64], r: &mut [f64]| {
            r[0] = at.start(0)[0];
            r[1] = at.start(0)[1] - 1.0;
            if joined {
                r[2] = at.joined(0, 0)[0] - 0.5 * 1.6f64.sin();
            } else {
                r[2] = at.end(0)[0] - 0.5 * 1.6f64.sin();
                r[3] = at.end(0)[0] - at.start(1)[0];
                r[4] = at.end(0)[1] - at.start(1)[1];
            }
        },
    }
}

fn sine_guess() -> Function<impl Fn(usize, f64) -> [f64; 2]> {
    Function {
        state: |_: usize, s: f64| [0.5 * (2.0 * s).sin(), 1.0],
        parameters: vec![3.0],
    }
}

#[test]
fn a_joined_point_is_two_segments_and_their_continuity() {
    let options = Options::to(1e-8);
    let [one, two] = [true, false].map(|joined| {
        let equations = oscillator(joined);
        let solution = solve(&equations, &sine_guess(), &options).unwrap();
        let conditioning = solution.conditioning(&equations).unwrap();
        (solution, conditioning)
    });
    assert!((one.0.parameters()[0] - 4.0).abs() < 1e-7);
    assert!((one.0.end(0)[0] - 0.5 * 4f64.sin()).abs() < 1e-7);
    let difference = |a: &[f64], b: &[f64]| (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
    assert!(difference(one.0.end(0), two.0.end(1)) < 1e-8);
    // Their first meshes, and so their groups of intervals, differ.
    assert!(one.1.kappa2 > 0.0 && (one.1.kappa2 / two.1.kappa2 - 1.0).abs() < 0.05);
}

#[test]
fn solutions_and_tables_are_guesses_with_joined_points() {
    let equations = oscillator(true);
    let options = Options::to(1e-8);
    let solution = solve(&equations, &sine_guess(), &options).unwrap();
    let again = solve(&equations, &solution, &options).unwrap();
    assert_eq!(again.stats().meshes, 1);
    assert_eq!(again.mesh(0), solution.mesh(0));
    // A table need not have the joined point among its nodes.
    let nodes: Vec<f64> = (0..=8).map(|i| 0.25 * f64::from(i)).collect();
    let states = nodes
        .iter()
        .flat_map(|s| [0.5 * (2.0 * s).sin(), (2.0 * s).cos()]);
    let table = Table {
        states: vec![states.collect()],
        nodes: vec![nodes],
        parameters: vec![4.2],
    };
    let from_table = solve(&equations, &table, &options).unwrap();
    assert!((from_table.parameters()[0] - 4.0).abs() < 1e-7);
}

/// y'' = −p₀ y + p₁ with y(0) = 0 and y(1/2) = 1, p₁ free: a family of one parameter.
struct Loaded;

impl Problem for Loaded {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2).joined(&[0.5])]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn condition_count(&self) -> usize {
        2
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = p[0];
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.joined(0, 0)[0] - 1.0;
    }
}

#[test]
fn families_and_embeddings_have_joined_points() {
    // y = p s²/2 + (2 − p/4) s.
    let end = |p: f64| 0.5 * p + (2.0 - 0.25 * p);
    let (mut family, mut z) =
        Family::new(&Loaded, 0, &[], &zero(2, 1), &Options::to(1e-8)).unwrap();
    assert!((family.start(&z, 0)[1] - 2.0).abs() < 1e-10);
    *z.last_mut().unwrap() = 3.0;
    let mut g = vec![0.0; z.len() - 1];
    let mut v = vec![0.0; z.len()];
    family.linearise(&z).unwrap();
    family.residual(&z, &mut g);
    g.iter_mut().for_each(|g| *g = -*g);
    family.particular(&g, &mut v);
    z.iter_mut().zip(&v).for_each(|(z, v)| *z += v);
    let p = z[z.len() - 1];
    assert!((family.end(&z, 0)[0] - end(p)).abs() < 1e-10);
    let solution = family.solution(&z);
    assert_eq!(solution.segments(), Loaded.segments());
    assert!(solution.defect() < 1e-10 && solution.condition_residual() < 1e-10);
    assert!((solution.end(0)[0] - end(p)).abs() < 1e-10);
    let embedding = Embedding {
        parameter: 0,
        from: 0.0,
        to: 8.0,
    };
    let solution = solve_embedded(&Loaded, &embedding, &zero(2, 1), &Options::default()).unwrap();
    assert!((solution.end(0)[0] - end(8.0)).abs() < 1e-10);
}

#[test]
fn joined_points_outside_their_segment_are_refused() {
    for joined in [
        [0.0, 1.0],
        [1.0, 0.5],
        [0.5, 2.0],
        [0.5, f64::NAN],
        [0.5, 0.5],
    ] {
        let error = solve(&ThreePoints { joined }, &zero(3, 0), &Options::default()).unwrap_err();
        assert!(matches!(error, Error::Joined { segment: 0, .. }), "{error}");
    }
}

#[test]
fn errors_name_places_of_the_segment() {
    let equations = FiniteDifferences {
        segments: vec![Segment::new(1), Segment::new(1).joined(&[0.2, 0.6])],
        parameters: 0,
        condition_count: 2,
        rhs: |segment: usize, s: f64, y: &[f64], _p: &[f64], dy: &mut [f64]| {
            dy[0] = if segment == 1 && s > 0.7 {
                f64::NAN
            } else {
                -y[0]
            };
        },
        conditions: |at: Ends<'_, f64>, _p: &[f64], r: &mut [f64]| {
            r[0] = at.start(0)[0] - 1.0;
            r[1] = at.start(1)[0] - at.end(0)[0];
        },
    };
    let guess = Constant {
        states: vec![vec![0.0]; 2],
        parameters: vec![],
    };
    let error = solve(&equations, &guess, &Options::default()).unwrap_err();
    let Error::NonFiniteRhs {
        segment, s, best, ..
    } = error
    else {
        panic!("{error}");
    };
    assert_eq!(segment, 1);
    assert!(s > 0.7);
    assert_eq!(best.segments().len(), 2);
    assert!(best.mesh(1).contains(&0.6) && best.end(1).len() == 1);
}
