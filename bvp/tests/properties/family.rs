//! Families of solutions: the flat system and its walks.

use bvp::{Constant, Ends, Error, Family, Options, Problem, Real, Scheme, Segment, solve};

/// u'' + λ eᵘ = 0, u(0) = u(1) = 0, on any number of segments between the given nodes.
pub(crate) struct Bratu(Vec<Segment>);

impl Bratu {
    pub(crate) fn new(nodes: &[f64]) -> Self {
        let pairs = nodes.windows(2);
        Self(pairs.map(|pair| Segment::on(2, pair[0], pair[1])).collect())
    }

    pub(crate) fn family(&self, options: &Options) -> (Family<'_>, Vec<f64>) {
        let guess = Constant {
            states: vec![vec![0.0; 2]; self.0.len()],
            parameters: vec![1.0],
        };
        Family::new(self, 0, &[], &guess, options).unwrap()
    }
}

impl Problem for Bratu {
    fn segments(&self) -> Vec<Segment> {
        self.0.clone()
    }

    fn parameters(&self) -> usize {
        1
    }

    fn condition_count(&self) -> usize {
        2 * self.0.len()
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -p[0] * y[0].exp();
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        let last = self.0.len() - 1;
        r[0] = at.start(0)[0];
        r[1] = at.end(last)[0];
        for i in 0..last {
            r[2 * i + 2] = at.end(i)[0] - at.start(i + 1)[0];
            r[2 * i + 3] = at.end(i)[1] - at.start(i + 1)[1];
        }
    }
}

/// The same with u(0) − u(1) = p₁ and ∫ u = p₂.
struct Loaded;

impl Problem for Loaded {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(3)]
    }

    fn parameters(&self) -> usize {
        3
    }

    fn condition_count(&self) -> usize {
        4
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -p[0] * y[0].exp();
        dy[2] = y[0];
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.start(0)[0] - at.end(0)[0] - p[1];
        r[2] = at.start(0)[2];
        r[3] = at.end(0)[2] - p[2];
    }
}

/// u'' + λ sin u = 0, u'(0) = u'(1) = 0.
struct Neumann;

impl Problem for Neumann {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn condition_count(&self) -> usize {
        2
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -p[0] * y[0].sin();
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[1];
        r[1] = at.end(0)[1];
    }
}

/// The family of [`Loaded`] near u = 0, λ = 1.
pub(crate) fn loaded(
    parameter: usize,
    held: &[usize],
    options: &Options,
) -> (Family<'static>, Vec<f64>) {
    let guess = Constant {
        states: vec![vec![0.0; 3]],
        parameters: vec![1.0, 0.1, 0.08],
    };
    Family::new(&Loaded, parameter, held, &guess, options).unwrap()
}

/// The family of [`Neumann`] at u = 0, λ = 5.
pub(crate) fn neumann(options: &Options) -> (Family<'static>, Vec<f64>) {
    let guess = Constant {
        states: vec![vec![0.0; 2]],
        parameters: vec![5.0],
    };
    Family::new(&Neumann, 0, &[], &guess, options).unwrap()
}

/// The inner product.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The Newton corrections at `z` with the entry `fixed` kept, until they are rounding: their sizes.
pub(crate) fn correct(family: &mut Family<'_>, z: &mut [f64], fixed: usize) -> Vec<f64> {
    let n = family.unknowns() - 1;
    let (mut g, mut v, mut t) = (vec![0.0; n], vec![0.0; n + 1], vec![0.0; n + 1]);
    let mut sizes = vec![];
    while sizes.last().is_none_or(|size| *size > 1e-9) && sizes.len() < 10 {
        family.residual(z, &mut g);
        family.linearise(z).unwrap();
        family.particular(&g, &mut v);
        family.null_vector(&mut t);
        let along = v[fixed] / t[fixed];
        let mut size: f64 = 0.0;
        for (z, (v, t)) in z.iter_mut().zip(v.iter().zip(&t)) {
            let change = v - along * t;
            size = size.max(change.abs() / (1.0 + z.abs()));
            *z -= change;
        }
        sizes.push(size);
    }
    assert!(sizes.len() < 10, "{sizes:?}");
    sizes
}

/// Few unknowns, for dense matrices.
pub(crate) fn small() -> Options {
    Options {
        tolerance: 1e-1,
        scheme: Some(Scheme::Gauss { stages: 2 }),
        initial_intervals: 3,
        ..Options::default()
    }
}

#[test]
fn bratus_limit_point_is_a_point_like_any_other() {
    let bratu = Bratu::new(&[0.0, 1.0]);
    let options = Options {
        tolerance: 1e-10,
        ..Options::default()
    };
    let (mut family, mut z) = bratu.family(&options);
    // Unknown 1 is u'(0).
    while z[1] < 4.0 {
        z[1] = (z[1] + 0.5).min(4.0);
        correct(&mut family, &mut z, 1);
    }
    let n = family.unknowns() - 1;
    assert!((z[n] - 3.513_830_719_125_161).abs() < 1e-9, "{}", z[n]);
    let mut t = vec![0.0; n + 1];
    family.linearise(&z).unwrap();
    family.null_vector(&mut t);
    assert!(t[n].abs() < 1e-8 * dot(&t, &t).sqrt());
}

#[test]
fn pseudo_arclength_rounds_bratus_limit_point() {
    let bratu = Bratu::new(&[0.0, 0.5, 1.0]);
    let (mut family, mut z) = bratu.family(&Options::default());
    let n = family.unknowns() - 1;
    let (mut g, mut v) = (vec![0.0; n], vec![0.0; n + 1]);
    let (mut t, mut now) = (vec![0.0; n + 1], vec![0.0; n + 1]);
    let mut largest: f64 = 0.0;
    family.linearise(&z).unwrap();
    family.null_vector(&mut t);
    let forward = t[n].signum();
    // λ rises to 3.51 and falls again on the upper solutions.
    while z[n] > 0.9 {
        let step = 0.5 * forward / dot(&t, &t).sqrt();
        z.iter_mut().zip(&t).for_each(|(z, t)| *z += step * t);
        for _ in 0..4 {
            family.residual(&z, &mut g);
            family.linearise(&z).unwrap();
            family.particular(&g, &mut v);
            family.null_vector(&mut now);
            let along = dot(&v, &t) / dot(&now, &t);
            z.iter_mut()
                .zip(v.iter().zip(&now))
                .for_each(|(z, (v, t))| *z -= v - along * t);
        }
        assert!(dot(&t, &now) > 0.0, "no jump of the direction");
        t.copy_from_slice(&now);
        largest = largest.max(z[n]);
    }
    assert!((3.45..3.514).contains(&largest), "{largest}");
    // The upper solution at λ = 0.9 … has a larger slope than the limit point.
    assert!(z[1] > 9.0);
    assert!(t[n] * forward < 0.0);
}

#[test]
fn parameters_are_held_until_they_are_changed() {
    // λ is determined by the given ∫ u = p₂, u(1) = −p₁ held.
    let options = Options::default();
    let (mut family, mut z) = loaded(2, &[1], &options);
    let n = family.unknowns() - 1;
    assert_eq!((family.held(1), z[n]), (0.1, 0.08));
    assert!(
        z[n - 1].abs() > 0.1,
        "λ stands before the parameter of the family"
    );
    let before = family.solution(&z);
    assert!((before.end(0)[0] + 0.1).abs() < 1e-10);
    family.hold(1, -0.2);
    correct(&mut family, &mut z, n);
    let after = family.solution(&z);
    assert_eq!(after.parameters()[1], -0.2);
    assert!((after.end(0)[0] - 0.2).abs() < 1e-10);
    assert!((after.end(0)[2] - 0.08).abs() < 1e-10);
    assert_eq!(after.parameters()[0], z[n - 1]);
}

#[test]
fn a_point_is_a_solution() {
    let options = Options::default();
    let bratu = Bratu::new(&[0.0, 1.0]);
    let (family, z) = bratu.family(&options);
    assert_eq!(family.tolerance(), options.tolerance);
    let solution = family.solution(&z);
    assert!(solution.defect() <= options.tolerance && solution.condition_residual() < 1e-12);
    assert_eq!(solution.error_estimate(), None);
    let mut y = [0.0; 2];
    solution.state(0, 0.5, &mut y);
    // The last correction of Newton's method was below 0.03 tolerances.
    assert!((y[0] - 0.140_539_214_400).abs() < 1e-8, "{}", y[0]);
}

#[test]
fn groups_are_functions_and_their_shares_sum_to_one() {
    let bratu = Bratu::new(&[0.0, 0.3, 1.0]);
    let cases = [
        (bratu.family(&small()).0, 4),
        (loaded(0, &[1], &small()).0, 4),
    ];
    for (family, count) in cases {
        let n = family.unknowns() - 1;
        let (mut group, mut share) = (vec![usize::MAX; n], vec![f64::NAN; n]);
        family.groups(&mut group, &mut share);
        let mut sums = vec![0.0; count];
        for (&group, &share) in group.iter().zip(&share) {
            assert!(share >= 0.0);
            sums[group] += share;
        }
        assert!(
            sums.iter().all(|sum: &f64| (sum - 1.0).abs() < 1e-14),
            "{sums:?}"
        );
    }
}

#[test]
fn values_that_are_not_finite_are_reported() {
    let bratu = Bratu::new(&[0.0, 1.0]);
    let (mut family, mut z) = bratu.family(&Options::default());
    z[0] = 1e4;
    let mut g = vec![0.0; z.len() - 1];
    family.residual(&z, &mut g);
    assert!(g.iter().all(|g| g.is_nan()));
    let error = family.linearise(&z).unwrap_err();
    assert!(matches!(
        error,
        Error::NonFiniteRhs {
            segment: 0,
            component: 1,
            ..
        }
    ));
    assert_eq!(error.best().unwrap().start(0)[0], 1e4);
    let error = family.adapted(&mut [z.clone()]).err().unwrap();
    assert!(matches!(error, Error::NonFiniteRhs { .. }));
    let solution = family.solution(&z);
    assert_eq!(solution.defect(), f64::INFINITY);
}

#[test]
fn statements_of_a_family_are_checked() {
    let options = Options::default();
    let guess = Constant {
        states: vec![vec![0.0; 3]],
        parameters: vec![1.0, 0.1, 0.08],
    };
    let error = |parameter: usize, held: &[usize]| {
        let family = Family::new(&Loaded, parameter, held, &guess, &options);
        family.err().unwrap()
    };
    for (own, held, named) in [(3, 1, 3), (0, 4, 4), (1, 1, 1)] {
        assert!(matches!(
            error(own, &[held]),
            Error::FamilyParameter { parameter, parameters: 3 } if parameter == named
        ));
    }
    for (held, needed) in [(&[][..], 5), (&[1, 2], 3)] {
        assert!(matches!(
            error(0, held),
            Error::ConditionCount { conditions: 4, unknowns, states: 3, .. } if unknowns == needed
        ));
    }
    assert_eq!(
        solve(&Loaded, &guess, &options).unwrap_err().to_string(),
        "4 conditions given, 6 needed: 3 for the states and 3 for the parameters; \
         with fewer, the solutions form a Family"
    );
}
