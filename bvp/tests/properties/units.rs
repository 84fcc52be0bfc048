//! Sizes of states and parameters: `Options::absolute`.

use bvp::{
    Constant, Control, Embedding, Ends, Equations, Error, Family, FiniteDifferences, Function,
    Guess, LeftOf, Options, Problem, Real, Segment, Shape, Solution, TwoPoint, solve,
    solve_embedded,
};
use proptest::prelude::*;

/// Two coupled oscillations and decays with u = sin 2s and w = e^(−s),
///
/// ```text
/// u'' = −4 u + w² − e^(−2s),    w'' = w + u² − sin² 2s
/// ```
///
/// whose states u, u', w, w' are measured in units.
struct Mixed {
    units: [f64; 4],
}

impl Problem for Mixed {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(4, 0.0, 3.0)]
    }

    fn rhs<T: Real>(&self, _segment: usize, s: T, y: &[T], _p: &[T], dy: &mut [T])
    where
        f64: LeftOf<T>,
    {
        let [a, b, c, d] = self.units;
        let [u, u1, w, w1] = [y[0] / a, y[1] / b, y[2] / c, y[3] / d];
        let (sine, decay) = ((2.0 * s).sin(), (-s).exp());
        dy[0] = a * u1;
        dy[1] = b * (w * w - decay * decay - 4.0 * u);
        dy[2] = c * w1;
        dy[3] = d * (w + u * u - sine * sine);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        let [a, _, c, d] = self.units;
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0] - a * 6f64.sin();
        r[2] = at.start(0)[2].powi(2) - c * c;
        r[3] = at.end(0)[3] + d * (-3f64).exp();
    }
}

impl Mixed {
    fn guess(&self) -> Constant {
        let [_, b, c, d] = self.units;
        Constant::new([0.0, b, c, -0.3 * d])
    }

    fn options(&self, tolerance: f64) -> Options {
        Options {
            absolute: self.units.to_vec(),
            ..Options::to(tolerance)
        }
    }

    /// The largest error of every state relative to its unit and |y|.
    fn error(&self, solution: &Solution) -> f64 {
        let (mut y, mut largest) = ([0.0; 4], 0.0f64);
        for i in 0..=300 {
            let s = 0.01 * f64::from(i);
            solution.state(0, s, &mut y);
            let ((sin, cos), decay) = ((2.0 * s).sin_cos(), (-s).exp());
            let exact = [sin, 2.0 * cos, decay, -decay];
            for ((y, unit), exact) in y.iter().zip(self.units).zip(exact) {
                largest = largest.max((y / unit - exact).abs() / (1.0 + exact.abs()));
            }
        }
        largest
    }
}

#[test]
fn states_of_1e8_and_1e_minus_8_are_solved_alike() {
    for units in [
        [1e8, 1e8, 1e-8, 1e-8],
        [1e-8, 1e8, 1e8, 1e-8],
        [1e8, 1e-8, 1e-8, 1e8],
    ] {
        let problem = Mixed { units };
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let solution = solve(&problem, &problem.guess(), &problem.options(tolerance)).unwrap();
            let error = problem.error(&solution);
            assert!(error <= tolerance, "{units:?}, {tolerance}: {error}");
        }
    }
}

proptest! {
    #[test]
    fn errors_are_within_the_tolerance_in_any_units(
        exponents in prop::array::uniform4(-12.0..12.0f64),
        exponent in prop_oneof![Just(-3), Just(-6), Just(-9)],
    ) {
        let problem = Mixed { units: exponents.map(|exponent| 10f64.powf(exponent)) };
        let tolerance = 10f64.powi(exponent);
        let options = problem.options(tolerance);
        let solution = solve(&problem, &problem.guess(), &options).unwrap();
        let error = problem.error(&solution);
        prop_assert!(error <= tolerance, "{:?}, {tolerance}: {error}", problem.units);
        // The solution is a guess from which nothing changes by more than its error.
        let again = solve(&problem, &solution, &options).unwrap();
        prop_assert_eq!(again.stats().meshes, 1);
        prop_assert!(problem.error(&again) <= tolerance);
    }
}

/// Equations in other units: y = unit · the number in the plain equations, and so for parameters and
/// conditions.
struct Restated<E> {
    plain: E,
    states: Vec<Vec<f64>>,
    parameters: Vec<f64>,
    conditions: Vec<f64>,
}

fn products(values: &[f64], units: &[f64]) -> Vec<f64> {
    values.iter().zip(units).map(|(a, b)| a * b).collect()
}

fn quotients(values: &[f64], units: &[f64]) -> Vec<f64> {
    values.iter().zip(units).map(|(a, b)| a / b).collect()
}

impl<E: Equations> Restated<E> {
    /// In units of powers of two without a pattern, for conditions of the same size if `alike`.
    fn new(plain: E, seed: u32, alike: bool) -> Self {
        let mut state = seed;
        let mut unit = |range: i32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let exponent = i32::try_from(state >> 16).unwrap() % (2 * range + 1) - range;
            2f64.powi(exponent)
        };
        let shape = plain.shape();
        let states = shape.segments.iter();
        let states = states.map(|segment| (0..segment.states).map(|_| unit(40)).collect());
        Self {
            states: states.collect(),
            parameters: (0..shape.parameters).map(|_| unit(40)).collect(),
            conditions: (0..shape.conditions)
                .map(|_| if alike { 1.0 } else { unit(20) })
                .collect(),
            plain,
        }
    }

    fn absolute(&self) -> Vec<f64> {
        let states = self.states.iter().flatten();
        states.chain(&self.parameters).copied().collect()
    }

    /// The units of all values at ends and joined points.
    fn ends(&self) -> Vec<f64> {
        let segments = self.plain.shape().segments;
        let each = segments.iter().zip(&self.states);
        each.flat_map(|(segment, units)| units.repeat(2 * (segment.joined.len() + 1)))
            .collect()
    }

    fn guess<'a>(&'a self, guess: &'a dyn Guess) -> RestatedGuess<'a, E> {
        RestatedGuess { of: self, guess }
    }

    /// Whether a solution is, to the last bit, the other one in these units.
    fn is(&self, solution: &Solution, plain: &Solution) {
        assert_eq!(
            solution.parameters(),
            products(plain.parameters(), &self.parameters)
        );
        for (segment, units) in self.states.iter().enumerate() {
            assert_eq!(solution.mesh(segment), plain.mesh(segment));
            assert_eq!(solution.defects(segment), plain.defects(segment));
            assert_eq!(solution.state_errors(segment), plain.state_errors(segment));
            let nodes = plain.mesh(segment);
            let [mut y, mut y_plain] = [(); 2].map(|()| vec![0.0; units.len()]);
            for pair in nodes.windows(2) {
                let s = 0.3 * pair[0] + 0.7 * pair[1];
                for (s, derivative) in [(s, false), (s, true), (pair[0], false), (pair[1], false)] {
                    let evaluate = |solution: &Solution, y: &mut [f64]| match derivative {
                        true => solution.derivative(segment, s, y),
                        false => solution.state(segment, s, y),
                    };
                    evaluate(solution, &mut y);
                    evaluate(plain, &mut y_plain);
                    assert_eq!(y, products(&y_plain, units));
                }
            }
        }
        assert_eq!(solution.parameter_errors(), plain.parameter_errors());
        assert_eq!(solution.error_estimate(), plain.error_estimate());
    }

    /// Whether it was found by the same steps, too.
    fn is_found_as(&self, solution: &Solution, plain: &Solution) {
        self.is(solution, plain);
        let [a, b] = [solution, plain].map(Solution::stats);
        assert_eq!(
            (a.newton_steps, a.rhs_evaluations, a.factorisations),
            (b.newton_steps, b.rhs_evaluations, b.factorisations)
        );
    }
}

impl<E: Equations> Equations for Restated<E> {
    fn shape(&self) -> Shape {
        self.plain.shape()
    }

    fn evaluate_rhs(&self, segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]) {
        let units = &self.states[segment];
        let (y, p) = (quotients(y, units), quotients(p, &self.parameters));
        self.plain.evaluate_rhs(segment, s, &y, &p, dy);
        dy.copy_from_slice(&products(dy, units));
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
        let units = &self.states[segment];
        let (y, p) = (quotients(y, units), quotients(p, &self.parameters));
        self.plain.rhs_jacobian(segment, s, &y, &p, dy, jacobian);
        dy.copy_from_slice(&products(dy, units));
        let columns = [&units[..], &self.parameters].concat();
        for (row, unit) in jacobian.chunks_exact_mut(columns.len()).zip(units) {
            let entries = quotients(row, &columns);
            row.copy_from_slice(&products(&entries, &vec![*unit; columns.len()]));
        }
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]) {
        let ends = quotients(at.values(), &self.ends());
        let (segments, p) = (self.shape().segments, quotients(p, &self.parameters));
        self.plain
            .evaluate_conditions(Ends::new(&segments, &ends), &p, r);
        r.copy_from_slice(&products(r, &self.conditions));
    }

    fn conditions_jacobian(
        &self,
        at: Ends<'_, f64>,
        p: &[f64],
        r: &mut [f64],
        jacobian: &mut [f64],
    ) {
        let ends = quotients(at.values(), &self.ends());
        let (segments, p) = (self.shape().segments, quotients(p, &self.parameters));
        self.plain
            .conditions_jacobian(Ends::new(&segments, &ends), &p, r, jacobian);
        r.copy_from_slice(&products(r, &self.conditions));
        let columns = [self.ends(), self.parameters.clone()].concat();
        let rows = jacobian.chunks_exact_mut(columns.len());
        for (row, unit) in rows.zip(&self.conditions) {
            let entries = quotients(row, &columns);
            row.copy_from_slice(&products(&entries, &vec![*unit; columns.len()]));
        }
    }
}

/// A guess of plain equations in the units of restated ones.
struct RestatedGuess<'a, E> {
    of: &'a Restated<E>,
    guess: &'a dyn Guess,
}

impl<E> Guess for RestatedGuess<'_, E> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        self.guess.state(segment, s, y);
        y.copy_from_slice(&products(y, &self.of.states[segment]));
    }

    fn parameters(&self, p: &mut [f64]) {
        self.guess.parameters(p);
        p.copy_from_slice(&products(p, &self.of.parameters));
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        self.guess.mesh()
    }
}

/// u'' + p eᵘ = 0 with p = 1, from right to left, divided at a joined point.
fn bratu() -> impl Equations {
    FiniteDifferences {
        segments: vec![Segment::on(2, 1.0, 0.0).joined(&[0.25])],
        parameters: 1,
        condition_count: 3,
        rhs: |_: usize, _s: f64, y: &[f64], p: &[f64], dy: &mut [f64]| {
            dy.copy_from_slice(&[y[1], -p[0] * y[0].exp()]);
        },
        conditions: |at: Ends<'_, f64>, p: &[f64], r: &mut [f64]| {
            r.copy_from_slice(&[at.start(0)[0], at.end(0)[0], p[0] - 1.0]);
        },
    }
}

/// The corner ε y'' = 1 − y'², y(−1) = y(1) = 1, on two segments, with the parameter ε.
fn corner() -> impl Equations {
    FiniteDifferences {
        segments: vec![Segment::on(2, -1.0, 0.3), Segment::on(2, 0.3, 1.0)],
        parameters: 1,
        condition_count: 4,
        rhs: |_: usize, _s: f64, y: &[f64], p: &[f64], dy: &mut [f64]| {
            dy.copy_from_slice(&[y[1], (1.0 - y[1] * y[1]) / p[0]]);
        },
        conditions: |at: Ends<'_, f64>, _p: &[f64], r: &mut [f64]| {
            r[0] = at.start(0)[0] - 1.0;
            r[1] = at.end(1)[0] - 1.0;
            r[2] = at.end(0)[0] - at.start(1)[0];
            r[3] = at.end(0)[1] - at.start(1)[1];
        },
    }
}

fn in_units<E>(of: &Restated<E>, options: &Options) -> Options
where
    E: Equations,
{
    Options {
        absolute: of.absolute(),
        ..options.clone()
    }
}

proptest! {
    /// Units of powers of two change nothing but the exponents of the numbers.
    #[test]
    fn other_units_give_the_same_digits(
        seed: u32,
        exponent in 3..10i32,
        control in prop_oneof![Just(Control::Error), Just(Control::Defect), Just(Control::Both)],
    ) {
        let guess = Constant { states: vec![vec![0.0; 2]], parameters: vec![0.5] };
        let options = Options { control, ..Options::to(10f64.powi(-exponent)) };
        let plain = solve(&bratu(), &guess, &options).unwrap();
        let restated = Restated::new(bratu(), seed, true);
        let options = in_units(&restated, &options);
        let solution = solve(&restated, &restated.guess(&guess), &options).unwrap();
        restated.is_found_as(&solution, &plain);
        let [own, expected] = [
            solution.conditioning(&restated).unwrap(),
            plain.conditioning(&bratu()).unwrap(),
        ];
        prop_assert_eq!(own, expected);
    }

    /// Also on the way of an embedding, and of the homotopy from a straight line.
    #[test]
    fn a_way_is_the_same_in_other_units(seed: u32) {
        let guess = Constant { states: vec![vec![1.0, 0.0]; 2], parameters: vec![1.0] };
        let embedding = Embedding { parameter: 0, from: 8e-3, to: 1e-3 };
        let plain = solve_embedded(&corner(), &embedding, &guess, &Options::default()).unwrap();
        prop_assert!(plain.stats().meshes > 10, "{:?}", plain.stats());
        let restated = Restated::new(corner(), seed, false);
        let unit = restated.parameters[0];
        let options = in_units(&restated, &Options::default());
        let embedding = Embedding { parameter: 0, from: 8e-3 * unit, to: 1e-3 * unit };
        let solution =
            solve_embedded(&restated, &embedding, &restated.guess(&guess), &options).unwrap();
        restated.is_found_as(&solution, &plain);
    }

    /// The best iterate of an error is in the units of the statement.
    #[test]
    fn failures_are_the_same_in_other_units(seed: u32, retries in 0..4usize) {
        let poor = Constant { states: vec![vec![60.0, 0.0]], parameters: vec![1.0] };
        let options = Options { retries, max_intervals: 40, ..Options::default() };
        let plain = solve(&bratu(), &poor, &options);
        let restated = Restated::new(bratu(), seed, false);
        let own = solve(&restated, &restated.guess(&poor), &in_units(&restated, &options));
        match (own, plain) {
            (Ok(own), Ok(plain)) => restated.is_found_as(&own, &plain),
            (Err(own), Err(plain)) => {
                prop_assert_eq!(own.to_string(), plain.to_string());
                restated.is_found_as(own.best().unwrap(), plain.best().unwrap());
            }
            (own, plain) => prop_assert!(false, "{own:?} where {plain:?}"),
        }
    }
}

#[test]
fn rescues_are_the_same_in_other_units() {
    // From 60 only the homotopy from a straight line leads to a solution.
    let poor = Constant {
        states: vec![vec![60.0, 0.0]],
        parameters: vec![1.0],
    };
    let none = Options {
        retries: 0,
        ..Options::default()
    };
    assert!(solve(&bratu(), &poor, &none).is_err());
    let plain = solve(&bratu(), &poor, &Options::default()).unwrap();
    for seed in 0..20 {
        let restated = Restated::new(bratu(), seed, false);
        let options = in_units(&restated, &Options::default());
        let solution = solve(&restated, &restated.guess(&poor), &options).unwrap();
        restated.is_found_as(&solution, &plain);
    }
}

/// y'' = −(λ/λ₀) y with y(0) = y(1) = 0 and y'(0) = π y₀, so that λ = π² λ₀ and y = y₀ sin πs.
#[test]
fn parameters_have_units() {
    for [eigenvalue, amplitude] in [[1e-14, 1e9], [1e11, 1e-10], [3e-7, 1.0]] {
        let problem = TwoPoint::new(
            [2, 1],
            [0.0, 1.0],
            move |_s, y, p, dy| dy.copy_from_slice(&[y[1], -p[0] / eigenvalue * y[0]]),
            move |start, end, _p, r| {
                use std::f64::consts::PI;
                r.copy_from_slice(&[start[0], end[0], start[1] - PI * amplitude]);
            },
        );
        let guess = Function {
            state: |_: usize, s: f64| {
                [4.0 * amplitude * s * (1.0 - s), amplitude * (3.0 - 6.0 * s)]
            },
            parameters: vec![9.0 * eigenvalue],
        };
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let options = Options {
                absolute: vec![amplitude, amplitude, eigenvalue],
                ..Options::to(tolerance)
            };
            let solution = solve(&problem, &guess, &options).unwrap();
            let found = solution.parameters()[0] / eigenvalue;
            let exact = std::f64::consts::PI.powi(2);
            assert!(
                (found - exact).abs() <= tolerance * (1.0 + exact),
                "{found}"
            );
            assert!(solution.error_estimate().unwrap() <= tolerance);
        }
    }
}

/// y' = p₀ y − p₁, y(0) = 1, on two pieces: a family in p₀ with p₁ held.
fn growth() -> impl Equations {
    FiniteDifferences {
        segments: vec![Segment::new(2).joined(&[0.6])],
        parameters: 2,
        condition_count: 2,
        rhs: |_: usize, _s: f64, y: &[f64], p: &[f64], dy: &mut [f64]| {
            dy.copy_from_slice(&[y[1], p[0] * y[0].sin() - p[1]]);
        },
        conditions: |at: Ends<'_, f64>, _p: &[f64], r: &mut [f64]| {
            r.copy_from_slice(&[at.start(0)[0] - 1.0, at.end(0)[1]]);
        },
    }
}

/// A point of a family is in the units of the statement; its system, its tangents and its meshes are those
/// of the plain problem.
#[test]
fn families_have_units() {
    let guess = Constant {
        states: vec![vec![1.0, 0.0]],
        parameters: vec![2.0, 0.25],
    };
    let plain_equations = growth();
    let plain_options = Options::to(1e-7);
    let (mut plain, z_plain) =
        Family::new(&plain_equations, 0, &[1], &guess, &plain_options).unwrap();
    for seed in 0..10 {
        let restated = Restated::new(growth(), seed, true);
        let options = in_units(&restated, &plain_options);
        let own_guess = restated.guess(&guess);
        let (mut family, z) = Family::new(&restated, 0, &[1], &own_guess, &options).unwrap();
        restated.is(&family.solution(&z), &plain.solution(&z_plain));
        let units = &restated.states[0];
        assert_eq!(
            family.start(&z, 0),
            products(plain.start(&z_plain, 0), units)
        );
        assert_eq!(family.end(&z, 0), products(plain.end(&z_plain, 0), units));
        let [own, expected] = [&z, &z_plain].map(|z| z[z.len() - 1]);
        assert_eq!(own, expected * restated.parameters[0]);
        assert_eq!(family.held(1), 0.25 * restated.parameters[1]);

        // Every unknown is that of the plain family in its unit.
        let ratio: Vec<f64> = z.iter().zip(&z_plain).map(|(a, b)| a / b).collect();
        let n = family.unknowns() - 1;
        let [mut v, mut v_plain, mut t, mut t_plain] = [(); 4].map(|()| vec![0.0; n + 1]);
        let r: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
        let [mut g, mut g_plain] = [(); 2].map(|()| vec![0.0; n]);
        family.hold(1, 0.5 * restated.parameters[1]);
        plain.hold(1, 0.5);
        let linearise =
            |family: &mut Family<'_>, z: &[f64], g: &mut [f64], v: &mut [f64], t: &mut [f64]| {
                family.residual(z, g);
                family.linearise(z).unwrap();
                family.particular(&r, v);
                family.null_vector(t);
            };
        linearise(&mut family, &z, &mut g, &mut v, &mut t);
        linearise(
            &mut plain,
            &z_plain,
            &mut g_plain,
            &mut v_plain,
            &mut t_plain,
        );
        assert_eq!(g, g_plain);
        for (i, ratio) in ratio
            .iter()
            .enumerate()
            .filter(|(_, ratio)| ratio.is_finite())
        {
            assert_eq!(v[i], v_plain[i] * ratio);
            assert_eq!(t[i], t_plain[i] * ratio);
        }

        // On a halved mesh and on one that is read again.
        let (mut vectors, mut vectors_plain) = ([z.clone(), t], [z_plain.clone(), t_plain]);
        let finer = family.refined(&mut vectors).unwrap();
        let finer_plain = plain.refined(&mut vectors_plain).unwrap();
        let [own, expected] = [
            finer.solution(&vectors[0]),
            finer_plain.solution(&vectors_plain[0]),
        ];
        restated.is(&own, &expected);
        let value = 0.5 * restated.parameters[1];
        let again = Family::on_mesh(&restated, 0, &[(1, value)], family.mesh(), &options).unwrap();
        assert_eq!(again.held(1), value);
        restated.is(
            &again.solution(&z),
            &Family::on_mesh(
                &plain_equations,
                0,
                &[(1, 0.5)],
                plain.mesh(),
                &plain_options,
            )
            .unwrap()
            .solution(&z_plain),
        );
        plain.hold(1, 0.25);
    }
}

#[test]
fn sizes_that_are_none_are_refused() {
    let problem = bratu();
    let guess = Constant {
        states: vec![vec![0.0; 2]],
        parameters: vec![0.5],
    };
    let refused = |absolute: &[f64]| {
        let options = Options {
            absolute: absolute.to_vec(),
            ..Options::default()
        };
        let error = solve(&problem, &guess, &options).unwrap_err();
        let of_family = Family::new(&growth(), 0, &[1], &guess, &options).err();
        assert!(of_family.is_some());
        error.to_string()
    };
    assert_eq!(
        refused(&[1.0]),
        "absolute has 1 numbers; needed is one for every state of all segments, 2, or also for every \
         parameter, 3, or none at all"
    );
    refused(&[1.0; 5]);
    for (position, bad) in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-310]
        .iter()
        .enumerate()
    {
        let mut absolute = vec![1.0; 3];
        let position = position % 3;
        absolute[position] = *bad;
        let error = refused(&absolute);
        let expected = format!("number {position} of absolute is {bad:e}, not positive");
        assert!(error.starts_with(&expected), "{error}");
    }
}

#[test]
fn sizes_of_states_alone_leave_parameters_at_one() {
    let guess = Constant {
        states: vec![vec![0.0; 2]],
        parameters: vec![0.5],
    };
    let solution = |absolute: &[f64]| {
        let options = Options {
            absolute: absolute.to_vec(),
            ..Options::default()
        };
        solve(&bratu(), &guess, &options).unwrap()
    };
    let [short, long] = [&[0.5, 0.3][..], &[0.5, 0.25, 1.0]].map(solution);
    assert_eq!(short.end(0), long.end(0));
    assert_eq!(short.error_estimate(), long.error_estimate());
}

/// What a solution was measured in is written and read with it.
#[test]
fn a_stored_solution_has_its_units() {
    let problem = Mixed {
        units: [1e8, 1e8, 1e-8, 1e-8],
    };
    let options = problem.options(1e-6);
    let text = serde_json::to_string(&options).unwrap();
    assert_eq!(serde_json::from_str::<Options>(&text).unwrap(), options);
    let solution = solve(&problem, &problem.guess(), &options).unwrap();
    let text = serde_json::to_string(&solution).unwrap();
    let read: Solution = serde_json::from_str(&text).unwrap();
    let [a, b] = [&solution, &read].map(|solution| solution.conditioning(&problem).unwrap());
    assert_eq!(a, b);
    assert!(a.kappa < 1e3, "{a:?}");
    let mut bad: serde_json::Value = serde_json::from_str(&text).unwrap();
    bad["absolute"][1] = 0.0.into();
    assert!(serde_json::from_value::<Solution>(bad.clone()).is_err());
    bad["absolute"] = vec![1.0].into();
    assert!(serde_json::from_value::<Solution>(bad).is_err());
}

/// A layer of height 1e-8 is invisible beside one, and is resolved where that is its size.
#[test]
fn a_small_layer_is_resolved_by_its_size() {
    let layer = TwoPoint::new(
        [2, 0],
        [0.0, 1.0],
        |_s, y, _p, dy| dy.copy_from_slice(&[y[1], 1e4 * y[0]]),
        |start, end, _p, r| r.copy_from_slice(&[start[0] - 1e-8, end[0]]),
    );
    let error = |absolute: Vec<f64>| {
        let options = Options {
            absolute,
            ..Options::to(1e-6)
        };
        let solution = solve(&layer, &Constant::new([0.0, 0.0]), &options).unwrap();
        let (mut y, mut largest) = ([0.0; 2], 0.0f64);
        for i in 0..=1000 {
            let s = 1e-3 * f64::from(i);
            solution.state(0, s, &mut y);
            largest = largest.max((y[0] * 1e8 - (-100.0 * s).exp()).abs());
        }
        largest
    };
    assert!(error(vec![]) > 0.01);
    assert!(error(vec![1e-8, 1e-6]) < 1e-6);
}

#[test]
fn an_error_of_a_statement_comes_first() {
    let options = Options {
        absolute: vec![1.0; 9],
        tolerance: 1.0,
        ..Options::default()
    };
    let error = solve(&bratu(), &Constant::new([0.0, 0.0]), &options).unwrap_err();
    assert!(matches!(error, Error::Tolerance { .. }));
}
