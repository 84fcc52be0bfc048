//! Random problems with known solutions: how often is what is returned true?

mod drawn;
mod modes;
mod shapes;

use bvp::{Ends, Equations, Guess, Options, Problem, Solution, solve};
use drawn::Drawn;
use proptest::prelude::Rng;
use proptest::test_runner::{RngAlgorithm, TestRng};
use std::ops::Range;

/// Places of every segment where errors are measured.
const PLACES: u32 = 200;
/// Errors below this, relative to 1 + |y|, are rounding.
const ROUNDING: f64 = 1e-12;
/// A guess within so much of the exact solution, in units of its size, is a good one.
const GOOD: f64 = 0.1;

/// A deterministic source of random numbers.
struct Draw(TestRng);

impl Draw {
    /// The source of one case.
    fn new(case: u32) -> Self {
        let mut seed = [0; 32];
        seed[..4].copy_from_slice(&case.to_le_bytes());
        Self(TestRng::from_seed(RngAlgorithm::ChaCha, &seed))
    }

    /// A number of \[low, high).
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A positive number of \[low, high), its logarithm distributed evenly.
    fn log_between(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    /// An integer of 0 … count − 1.
    fn below(&mut self, count: usize) -> usize {
        usize::try_from(self.0.next_u64() % count as u64).expect("less than count")
    }

    /// True with a probability.
    fn chance(&mut self, probability: f64) -> bool {
        self.between(0.0, 1.0) < probability
    }

    /// −1 or 1.
    fn sign(&mut self) -> f64 {
        if self.chance(0.5) { 1.0 } else { -1.0 }
    }
}

/// The exact solution with an error of a size, in units of its own, or the exact one at the middle
/// of every segment, everywhere.
struct Perturbed<'a> {
    exact: &'a Drawn,
    size: Option<f64>,
    phase: f64,
}

impl Guess for Perturbed<'_> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let Some(size) = self.size else {
            let segment_of = &self.exact.segments()[segment];
            let middle = 0.5 * (segment_of.from + segment_of.to);
            return self.exact.state(segment, middle, y);
        };
        self.exact.state(segment, s, y);
        for (i, y) in y.iter_mut().enumerate() {
            let wave = (3.0 * s + self.phase + i as f64).sin();
            *y += size * wave * self.exact.size(segment, i);
        }
    }

    fn parameters(&self, p: &mut [f64]) {
        Guess::parameters(self.exact, p);
        let size = self.size.unwrap_or(GOOD);
        p.iter_mut()
            .for_each(|p| *p *= 1.0 + size * self.phase.sin());
    }
}

/// How often what happened.
#[derive(Debug, Default)]
struct Tally {
    solved: usize,
    /// Cases with a good guess, and those of them that are not solved.
    good: usize,
    good_failed: usize,
    /// Another solution of the same problem was found.
    another: usize,
    /// The error of a state or parameter is more than ten times its estimate.
    underestimated: usize,
    /// An error is more than ten times the tolerance.
    inaccurate: usize,
}

/// The largest distances of a solution from another one, of every state and parameter relative to
/// 1 + |value|, each with its estimate.
fn errors(solution: &Solution, reference: &dyn Guess) -> Vec<[f64; 2]> {
    let relative = |exact: f64, found: f64| (exact - found).abs() / (1.0 + exact.abs());
    let mut all = vec![];
    for (segment, shape) in solution.segments().iter().enumerate() {
        let (mut exact, mut found) = (vec![0.0; shape.states], vec![0.0; shape.states]);
        let mut largest = vec![0.0f64; shape.states];
        for place in 0..=PLACES {
            let theta = f64::from(place) / f64::from(PLACES);
            let s = shape.from + (shape.to - shape.from) * theta;
            reference.state(segment, s, &mut exact);
            solution.state(segment, s, &mut found);
            for (largest, (a, b)) in largest.iter_mut().zip(exact.iter().zip(&found)) {
                *largest = largest.max(relative(*a, *b));
            }
        }
        let estimates = solution.state_errors(segment).expect("an estimate");
        all.extend(largest.iter().zip(estimates).map(|(a, b)| [*a, *b]));
    }
    let found = solution.parameters();
    let mut exact = vec![0.0; found.len()];
    reference.parameters(&mut exact);
    let estimates = solution.parameter_errors().expect("an estimate");
    for ((a, b), estimate) in exact.iter().zip(found).zip(estimates) {
        all.push([relative(*a, *b), *estimate]);
    }
    all
}

fn largest(errors: &[[f64; 2]]) -> f64 {
    errors.iter().fold(0.0, |m, [error, _]| m.max(*error))
}

/// Every condition of a success holds, relative to the size of its terms.
fn check_conditions(problem: &Drawn, solution: &Solution, tolerance: f64) {
    let segments = 0..solution.segments().len();
    let ends = segments.flat_map(|i| [solution.start(i), solution.end(i)].concat());
    let (mut all, p): (Vec<f64>, _) = (ends.collect(), solution.parameters());
    let shape = problem.shape();
    let count = shape.conditions;
    let (mut r, mut jacobian) = (
        vec![f64::NAN; count],
        vec![f64::NAN; count * (all.len() + p.len())],
    );
    let at = Ends::new(&shape.segments, &all);
    problem.conditions_jacobian(at, p, &mut r, &mut jacobian);
    all.extend(p);
    for (r, row) in r.iter().zip(jacobian.chunks_exact(all.len())) {
        let scale: f64 = row.iter().zip(&all).map(|(a, z)| (a * z).abs()).sum();
        assert!(
            r.abs() <= 1.001 * tolerance * scale.max(1.0),
            "{r:e} of {scale:e}"
        );
    }
}

/// Another solution of the problem near the one that was found, if that is no bad approximation of
/// the exact one: what it becomes at a far smaller tolerance.
fn another(problem: &Drawn, found: &Solution, tolerance: f64) -> Option<Solution> {
    let sharper = (1e-3 * tolerance).max(1e-11);
    let options = Options {
        tolerance: sharper,
        scheme: Options::to(sharper).scheme,
        ..Options::default()
    };
    let again = solve(problem, found, &options).ok()?;
    (largest(&errors(&again, problem)) > 10.0 * tolerance).then_some(again)
}

/// Solves one case, counts what happened and prints what should not.
fn count(case: u32, tally: &mut Tally) {
    let mut draw = Draw::new(case);
    let problem = Drawn::draw(&mut draw);
    let size = (!draw.chance(0.2)).then(|| draw.log_between(1e-3, 1.0));
    let phase = draw.between(0.0, 6.0);
    let exact = &problem;
    let guess = Perturbed { exact, size, phase };
    let options = match case % 4 {
        0 => Options::to(1e-3),
        1 => Options::to(1e-6),
        2 => Options::to(1e-9),
        _ => Options::default(),
    };
    let good = size.is_some_and(|size| size <= GOOD);
    tally.good += usize::from(good);
    let solution = match solve(&problem, &guess, &options) {
        Ok(solution) => solution,
        Err(error) => {
            tally.good_failed += usize::from(good);
            println!("case {case}, guess within {size:?}: {error}");
            return;
        }
    };
    tally.solved += 1;
    check_conditions(&problem, &solution, options.tolerance);
    let inaccurate = |errors: &[[f64; 2]]| largest(errors) > 10.0 * options.tolerance;
    let mut found = errors(&solution, &problem);
    if inaccurate(&found)
        && let Some(another) = another(&problem, &solution, options.tolerance)
    {
        tally.another += 1;
        tally.good_failed += usize::from(good);
        found = errors(&solution, &another);
    }
    let is_under = |[error, estimate]: &[f64; 2]| *error > ROUNDING.max(10.0 * estimate);
    let underestimated = found.iter().any(is_under);
    tally.underestimated += usize::from(underestimated);
    tally.inaccurate += usize::from(inaccurate(&found));
    if underestimated || inaccurate(&found) {
        println!("case {case}, errors and estimates: {found:?}");
    }
}

fn survey(cases: Range<u32>) {
    let number = cases.len();
    let mut tally = Tally::default();
    cases.for_each(|case| count(case, &mut tally));
    println!("{number} cases: {tally:?}");
    assert!(100 * tally.underestimated <= tally.solved, "{tally:?}");
    assert!(100 * tally.inaccurate <= tally.solved, "{tally:?}");
    assert!(50 * tally.good_failed <= tally.good, "{tally:?}");
    // Most of the cases test something.
    assert!(
        4 * tally.solved >= 3 * number && 3 * tally.good >= number,
        "{tally:?}"
    );
}

#[test]
fn random_problems_are_solved_and_their_errors_are_known() {
    survey(0..200);
}

#[test]
#[ignore = "takes minutes"]
fn many_random_problems_are_solved_and_their_errors_are_known() {
    survey(0..12_000);
}
