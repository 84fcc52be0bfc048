//! How long does a step along a curve of solutions take, on the problems of `benches/auto-07p/`?
//!
//! The mesh is fixed, its number of intervals that of AUTO-07p, with four Gauss points each. "As
//! AUTO" measures the arclength as AUTO does and takes its longest step, so that there are about as
//! many; "own steps" are the default ones over the same part of the curve. Shown is the time of a
//! whole curve, its limit points located, over the number of its accepted steps.

#[path = "../continuation/examples/banded/bratu.rs"]
mod banded;
#[path = "continuation/problems.rs"]
mod problems;

use bvp::{Constant, Equations, Family, GlobalError};
use continuation::{Branch, Cause, Direction, Kind, Options, System};
use criterion::{BenchmarkId, Criterion, SamplingMode};
use problems::{Bratu, Copies, Swirl};
use reference_problems::Curve;
use std::hint::black_box;
use std::time::{Duration, SystemTime};

/// A system on a fixed mesh that counts its factorisations.
struct Fixed<S> {
    system: S,
    factorisations: usize,
}

impl<S: System> System for Fixed<S> {
    fn unknowns(&self) -> usize {
        self.system.unknowns()
    }

    fn residual(&mut self, z: &[f64], g: &mut [f64]) {
        self.system.residual(z, g);
    }

    fn linearise(&mut self, z: &[f64]) -> Result<(), Cause> {
        self.factorisations += 1;
        self.system.linearise(z)
    }

    fn particular(&mut self, r: &[f64], v: &mut [f64]) {
        self.system.particular(r, v);
    }

    fn null_vector(&mut self, t: &mut [f64]) {
        self.system.null_vector(t);
    }

    fn groups(&self, group: &mut [usize], share: &mut [f64]) {
        self.system.groups(group, share);
    }
}

/// A curve to be followed.
struct Task<S> {
    name: String,
    system: Fixed<S>,
    start: Vec<f64>,
    direction: Direction,
    bounds: [f64; 2],
    /// AUTO's longest step, and the length of the curve that it follows.
    step: f64,
    length: f64,
    /// Weights of the squares in AUTO's arclength.
    weights: Vec<f64>,
    limit_points: Vec<f64>,
}

/// The processor time of this thread so far, for it is what AUTO's times are; the time of day where
/// the system does not tell.
fn processor_time() -> Duration {
    // It is brought up to date when the thread is scheduled.
    std::thread::yield_now();
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let first = told.and_then(|told| told.split_whitespace().next()?.parse().ok());
    first.map_or_else(|| SystemTime::UNIX_EPOCH.elapsed().unwrap_or_default(), Duration::from_nanos)
}

/// How a curve was followed.
#[derive(Default)]
struct Run {
    steps: usize,
    steps_to_limit: usize,
    factorisations: usize,
    length: f64, end: f64,
    limit_points: Vec<f64>,
}

impl<S: System> Task<S> {
    /// A curve with increasing λ in an interval with one limit point, AUTO's step and number of steps.
    /// `count` is how many numbers of weight one stand for a function in AUTO's arclength.
    fn new(
        name: String,
        system: S,
        start: Vec<f64>,
        limit_point: f64,
        (step, length): (f64, f64),
        count: f64,
    ) -> Self {
        let n = start.len() - 1;
        let (mut group, mut weights) = (vec![0; n], vec![0.0; n]);
        system.groups(&mut group, &mut weights);
        weights.iter_mut().for_each(|weight| *weight *= count);
        weights.push(1.0);
        Self {
            name,
            system: Fixed { system, factorisations: 0 },
            start,
            direction: Direction::Increasing,
            bounds: [0.0, 4.0],
            step,
            length,
            weights,
            limit_points: vec![limit_point],
        }
    }

    /// AUTO's arclength and longest step.
    fn as_auto(&self, accuracy: f64) -> Options {
        Options {
            weights: Some(self.weights.clone()),
            first_step: self.step,
            largest_step: self.step,
            accuracy,
            ..self.own()
        }
    }

    /// The default steps.
    fn own(&self) -> Options {
        let [low, high] = self.bounds;
        Options::within(low, high)
    }

    /// Follows the curve as far as AUTO does.
    fn follow(&mut self, options: &Options) -> Run {
        self.system.factorisations = 0;
        let mut run = Run::default();
        let mut last = self.start.clone();
        let branch = Branch::new(&mut self.system, &self.start, self.direction, options);
        let mut branch = branch.expect("a solution at the start");
        while run.length < self.length {
            let Some(point) = branch.next() else {
                panic!("{}: {}", self.name, branch.into_stop().expect("an end"));
            };
            match point.kind {
                Kind::Regular => {
                    let squares = self.weights.iter().zip(last.iter().zip(&point.z));
                    let square: f64 = squares.map(|(w, (a, b))| w * (a - b) * (a - b)).sum();
                    run.length += square.sqrt();
                    run.steps += 1; run.end=point.lambda();
                    last = point.z;
                }
                Kind::LimitPoint => {
                    if run.limit_points.is_empty() {
                        run.steps_to_limit = run.steps + 1;
                    }
                    run.limit_points.push(point.lambda());
                }
                _ => {}
            }
        }
        drop(branch);
        run.factorisations = self.system.factorisations;
        run
    }

    /// Follows the curve, checks its limit points and prints what it took.
    fn check(&mut self, steps: &str, options: &Options) {
        let before = processor_time();
        let run = self.follow(options);
        let time = processor_time() - before;
        let name = &self.name;
        assert_eq!(run.limit_points.len(), self.limit_points.len(), "{name}");
        let pairs = run.limit_points.iter().zip(&self.limit_points);
        let error = pairs.fold(0.0, |max: f64, (found, exact)| max.max((found - exact).abs()));
        let per_step = |number: f64| number / run.steps as f64;
        eprintln!(
            "{name}, {steps}: {} steps, {} to the first limit point, {:.2} factorisations per step, \
             limit points off by {error:.1e}, {:.4} ms per step",
            run.steps,
            run.steps_to_limit,
            per_step(run.factorisations as f64),
            per_step(1e3 * time.as_secs_f64()),
        );
        println!("{:?} {} {}", run.limit_points, run.length, run.end);
    }
}

/// A family of boundary value problems on equal intervals, from a constant solution.
fn family<'a>(
    name: String,
    equations: &'a dyn Equations,
    intervals: usize,
    (states, parameter): (&[f64], f64),
    limit_point: f64,
    auto: (f64, f64),
) -> Task<Curve<'a>> {
    let guess = Constant { states: vec![states.to_vec()], parameters: vec![parameter] };
    let options = bvp::Options {
        initial_intervals: intervals,
        global_error: GlobalError::Skip,
        ..bvp::Options::default()
    };
    let family = Family::new(equations, 0, &[], &guess, &options);
    let (family, start) = family.expect("an exact solution");
    let stages = 4;
    assert_eq!(start.len(), states.len() * (intervals * (1 + stages) + 1) + 1, "the mesh is kept");
    Task::new(name, Curve { family, second: 0 }, start, limit_point, auto, 1.0)
}

fn bench<S: System>(criterion: &mut Criterion, mut task: Task<S>) {
    let settings = [
        ("as AUTO, 1e-7", task.as_auto(1e-7)),
        ("as AUTO, 1e-10", task.as_auto(1e-10)),
        ("own steps", task.own()),
    ];
    for (name, options) in &settings {
        task.check(name, options);
    }
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    for intervals in [10, 100, 1000] {
        let name = format!("bratu, {intervals} intervals");
        let task = family(name, &Bratu, intervals, (&[0.0; 2], 0.0), 3.513_830_719_125, (0.05, 22.85));
        bench(&mut criterion, task);
    }
    let state = [0.0, 0.0, 1.0, 0.0, 0.0];
    let name = "swirl, 5 equations".to_owned();
    let mut task = family(name, &Swirl, 100, (&state, 1.0), -0.159_885_864_87, (0.1, 8.03));
    task.direction = Direction::Decreasing;
    task.bounds = [-2.0, 1.0];
    task.limit_points.push(0.158_110_063_96);
    bench(&mut criterion, task);
    for (equations, limit_point, length) in [
        (4, 3.479_680_832_4, 9.9),
        (8, 3.479_664_205_9, 9.9),
        (16, 3.479_625_292_3, 11.9),
        (32, 3.479_587_664_3, 14.9),
        (64, 3.479_553_906_1, 17.9),
    ] {
        let name = format!("copies, {equations} equations");
        let copies = Copies::new(equations);
        let zero = vec![0.0; equations];
        let task = family(name, &copies, 50, (&zero, 0.0), limit_point, (0.1, length));
        bench(&mut criterion, task);
    }
    let points = 999;
    let task = Task::new(
        format!("points, {points} equations"),
        banded::Bratu::new(points),
        vec![0.0; points + 1],
        3.513_828_891_1,
        (1.0, 29.0),
        points as f64,
    );
    bench(&mut criterion, task);
    criterion.final_summary();
}
