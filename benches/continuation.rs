//! How long does a step along a curve of solutions take, on the problems of `benches/auto-07p/`?
//!
//! Processor time of a whole curve, its limit points located, over the number of accepted steps. The
//! mesh is fixed and has as many intervals, with four Gauss points each, as AUTO-07p was given.
//! "As AUTO" measures the length of a step as AUTO does and takes no longer ones than AUTO; "own
//! steps" are the default ones, at least as far along the curve.

#[path = "../continuation/examples/banded/bratu.rs"]
mod banded;
#[path = "continuation/problems.rs"]
mod problems;
mod processor_time;

use bvp::{Constant, Control, Equations, Family, Scheme};
use continuation::{Branch, Cause, Direction, Kind, Options, System};
use criterion::{BenchmarkId, Criterion, SamplingMode};
use problems::{Bratu, Copies, Swirl};
use processor_time::processor_time;

/// Limit points are met with this accuracy: those of Bratu's problem on ten intervals differ by
/// 1.9e-10 from the exact ones, and AUTO's have eleven digits.
const ACCURACY: f64 = 3e-10;
/// Gauss points per interval.
const STAGES: usize = 4;

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
    limit_points: Vec<f64>,
    auto: Auto,
    /// Weights of the squares in AUTO's arclength.
    weights: Vec<f64>,
}

/// What AUTO does.
#[derive(Clone, Copy)]
struct Auto {
    /// Its longest step.
    step: f64,
    /// The length of the curve that it follows.
    length: f64,
}

/// How a curve was followed.
#[derive(Default)]
struct Run {
    steps: usize,
    /// Steps to the first limit point, the one that passes it included.
    steps_to_limit: usize,
    factorisations: usize,
    /// In AUTO's arclength, as a polygon.
    length: f64,
    /// Largest error of a limit point.
    error: f64,
}

impl<S: System> Task<S> {
    /// A curve with one limit point, from λ = 0 upwards. In AUTO's arclength every function counts
    /// as this `sum` of squares.
    fn new(name: String, system: S, limit_point: f64, auto: Auto, sum: f64) -> Self {
        let unknowns = system.unknowns();
        let (mut group, mut weights) = (vec![0; unknowns - 1], vec![0.0; unknowns - 1]);
        system.groups(&mut group, &mut weights);
        weights.iter_mut().for_each(|share| *share *= sum);
        weights.push(1.0);
        let factorisations = 0;
        Self {
            name,
            system: Fixed {
                system,
                factorisations,
            },
            start: vec![0.0; unknowns],
            direction: Direction::Increasing,
            bounds: [0.0, 4.0],
            limit_points: vec![limit_point],
            auto,
            weights,
        }
    }

    /// The default steps.
    fn own(&self) -> Options {
        let [low, high] = self.bounds;
        Options::within(low, high)
    }

    /// AUTO's arclength and longest step.
    fn as_auto(&self, accuracy: f64) -> Options {
        Options {
            weights: Some(self.weights.clone()),
            first_step: self.auto.step,
            largest_step: self.auto.step,
            accuracy,
            ..self.own()
        }
    }

    /// Follows the curve as far as AUTO does and checks its limit points.
    fn follow(&mut self, options: &Options) -> Run {
        self.system.factorisations = 0;
        let name = &self.name;
        let (mut run, mut last) = (Run::default(), self.start.clone());
        let mut limit_points = self.limit_points.iter();
        let mut branch = Branch::new(&mut self.system, &self.start, self.direction, options)
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        while run.length < self.auto.length {
            let Some(point) = branch.next() else {
                panic!("{name}: {:?}", branch.into_stop());
            };
            match point.kind {
                Kind::Regular => {
                    let pairs = last.iter().zip(&point.z);
                    let squares = pairs
                        .zip(&self.weights)
                        .map(|((a, b), w)| w * (a - b) * (a - b));
                    run.length += squares.sum::<f64>().sqrt();
                    run.steps += 1;
                    last = point.z;
                }
                Kind::LimitPoint => {
                    if run.steps_to_limit == 0 {
                        run.steps_to_limit = run.steps + 1;
                    }
                    let exact = limit_points.next().expect("no more limit points");
                    run.error = run.error.max((point.lambda() - exact).abs());
                }
                _ => {}
            }
        }
        assert_eq!(limit_points.len(), 0, "{name}: limit points missing");
        assert!(
            run.error < ACCURACY,
            "{name}: limit points off by {}",
            run.error
        );
        drop(branch);
        run.factorisations = self.system.factorisations;
        run
    }

    /// Times the steps of one setting.
    fn bench(&mut self, criterion: &mut Criterion, setting: &str, options: &Options) {
        let mut group = criterion.benchmark_group("continuation, one step");
        group.sample_size(10).sampling_mode(SamplingMode::Flat);
        let mut printed = false;
        group.bench_function(BenchmarkId::new(&self.name, setting), |b| {
            b.iter_custom(|iterations| {
                let start = processor_time();
                let runs: Vec<Run> = (0..iterations).map(|_| self.follow(options)).collect();
                let time = processor_time() - start;
                if !std::mem::replace(&mut printed, true) {
                    print(&self.name, setting, &runs[0]);
                }
                time.div_f64(runs[0].steps as f64)
            });
        });
        group.finish();
    }
}

/// Prints what a curve took, for the table beside AUTO.
fn print(name: &str, setting: &str, run: &Run) {
    let Run {
        steps,
        steps_to_limit,
        error,
        ..
    } = run;
    let factorisations = run.factorisations as f64 / *steps as f64;
    eprintln!(
        "\n{name}, {setting}: {steps} steps, {steps_to_limit} to the first limit point, \
         {factorisations:.2} factorisations per step, limit points off by {error:.1e}"
    );
}

/// A family of boundary value problems from a constant solution with this value of its parameter, on
/// equal intervals.
fn family<'a>(
    name: String,
    equations: &'a dyn Equations,
    intervals: usize,
    (state, parameter): (&[f64], f64),
    limit_point: f64,
    auto: Auto,
) -> Task<Family<'a>> {
    let guess = Constant {
        states: vec![state.to_vec()],
        parameters: vec![parameter],
    };
    let options = bvp::Options {
        scheme: Some(Scheme::Gauss { stages: STAGES }),
        initial_intervals: intervals,
        control: Control::Defect,
        ..bvp::Options::default()
    };
    let family = Family::new(equations, 0, &[], &guess, &options);
    let (family, start) = family.expect("an exact solution");
    let values = state.len() * (intervals * (1 + STAGES) + 1);
    assert_eq!(
        start.len(),
        values + 1,
        "{name}: as many intervals as asked for"
    );
    let task = Task::new(name, family, limit_point, auto, 1.0);
    Task { start, ..task }
}

fn bratu(criterion: &mut Criterion) {
    for intervals in [10, 100, 1000] {
        let name = format!("bratu, {intervals} intervals");
        let auto = Auto {
            step: 0.05,
            length: 22.85,
        };
        let mut task = family(
            name,
            &Bratu,
            intervals,
            (&[0.0; 2], 0.0),
            3.513_830_719_125,
            auto,
        );
        task.bench(criterion, "as AUTO, 1e-7", &task.as_auto(1e-7));
        task.bench(criterion, "as AUTO, 1e-10", &task.as_auto(1e-10));
        task.bench(criterion, "own steps", &task.own());
    }
}

fn swirl(criterion: &mut Criterion) {
    let start: (&[f64], f64) = (&[0.0, 0.0, 1.0, 0.0, 0.0], 1.0);
    // To s = -1.377.
    let auto = Auto {
        step: 0.1,
        length: 8.03,
    };
    let mut task = family(
        "swirl".to_owned(),
        &Swirl,
        100,
        start,
        -0.159_885_864_87,
        auto,
    );
    task.limit_points.push(0.158_110_063_96);
    task.direction = Direction::Decreasing;
    task.bounds = [-2.0, 1.0];
    task.bench(criterion, "as AUTO, 1e-7", &task.as_auto(1e-7));
    task.bench(criterion, "as AUTO, 1e-10", &task.as_auto(1e-10));
    task.bench(criterion, "own steps", &task.own());
}

fn copies(criterion: &mut Criterion) {
    for (equations, limit_point, length) in [
        (4, 3.479_680_832_4, 9.9),
        (8, 3.479_664_205_9, 9.9),
        (16, 3.479_625_292_3, 11.9),
        (32, 3.479_587_664_3, 14.9),
        (64, 3.479_553_906_1, 17.9),
    ] {
        let name = format!("copies, {equations} equations");
        let (copies, zero) = (Copies::new(equations), vec![0.0; equations]);
        let auto = Auto { step: 0.1, length };
        let mut task = family(name, &copies, 50, (&zero, 0.0), limit_point, auto);
        task.bench(criterion, "as AUTO, 1e-7", &task.as_auto(1e-7));
        if equations <= 16 {
            task.bench(criterion, "as AUTO, 1e-10", &task.as_auto(1e-10));
        }
        task.bench(criterion, "own steps", &task.own());
    }
}

fn points(criterion: &mut Criterion) {
    let points = 999;
    let auto = Auto {
        step: 1.0,
        length: 29.0,
    };
    let (name, system) = (format!("points, {points} equations"), banded::bratu(points));
    let mut task = Task::new(name, system, 3.513_828_891_029_4, auto, points as f64);
    task.bench(criterion, "as AUTO, 1e-7", &task.as_auto(1e-7));
    task.bench(criterion, "own steps", &task.own());
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    bratu(&mut criterion);
    swirl(&mut criterion);
    copies(&mut criterion);
    points(&mut criterion);
    criterion.final_summary();
}
