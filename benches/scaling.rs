//! How does the cost of one Newton solve grow with the intervals and with the states?
//!
//! Expected: linear in the intervals; between quadratic and cubic in the states, once they are many.
//! Processor time of linear problems on a mesh of exactly so many intervals, and of a nonlinear
//! one with up to 100 states from a zero guess to its error estimate. At the end the fastest runs are
//! printed as tables, with the exponent α of time ∝ sizeᵅ between neighbouring columns.

#[path = "scaling/problems.rs"]
mod problems;
mod processor_time;

use bvp::{Control, Equations, Options, Scheme, Solution, Table, solve};
use criterion::{BenchmarkId, Criterion, SamplingMode};
use problems::{ReactionDiffusion, Rotation};
use processor_time::processor_time;
use std::hint::black_box;
use std::time::Duration;

/// The zero guess on equal intervals.
fn guess(states: usize, intervals: usize) -> Table {
    let nodes = (0..=intervals).map(|i| i as f64 / intervals as f64);
    Table {
        nodes: vec![nodes.collect()],
        states: vec![vec![0.0; states * (intervals + 1)]],
        parameters: vec![],
    }
}

/// Solves with four stages on the mesh of the guess, which must do.
fn solved(equations: &dyn Equations, guess: &Table, control: Control) -> Solution {
    let options = Options {
        tolerance: 1e-3,
        scheme: Some(Scheme::Gauss { stages: 4 }),
        max_intervals: guess.nodes[0].len(),
        control,
        ..Options::default()
    };
    let solution = solve(equations, guess, &options).expect("a well-posed problem");
    assert_eq!(solution.mesh(0), guess.nodes[0], "the mesh of the guess");
    solution
}

/// A kind of problem, to be solved in several sizes.
struct Bench<'a> {
    /// Heading and name of the function.
    names: [&'a str; 2],
    control: Control,
    /// Size and the fastest of all solutions.
    fastest: Vec<(usize, Duration)>,
}

impl<'a> Bench<'a> {
    fn new(names: [&'a str; 2], control: Control) -> Self {
        Self {
            names,
            control,
            fastest: vec![],
        }
    }

    /// Times one size.
    fn time(
        &mut self,
        criterion: &mut Criterion,
        equations: &dyn Equations,
        intervals: usize,
        size: usize,
    ) {
        let guess = guess(equations.shape().segments[0].states, intervals);
        let mut fastest = Duration::MAX;
        let mut group = criterion.benchmark_group(self.names[0]);
        group.sampling_mode(SamplingMode::Flat);
        group.bench_function(BenchmarkId::new(self.names[1], size), |b| {
            b.iter_custom(|iterations| {
                let runs = (0..iterations).map(|_| {
                    let start = processor_time();
                    black_box(solved(equations, black_box(&guess), self.control));
                    let time = processor_time() - start;
                    fastest = fastest.min(time);
                    time
                });
                runs.sum()
            });
        });
        group.finish();
        // Not if the filter of the command line leaves it out.
        if fastest < Duration::MAX {
            self.fastest.push((size, fastest));
        }
    }

    /// Prints the fastest solutions and the exponents of their growth as a table.
    fn print(&self) {
        let [heading, function] = self.names;
        let cells = |cell: &dyn Fn(usize) -> String| -> String {
            (0..self.fastest.len())
                .map(|i| format!(" {} |", cell(i)))
                .collect()
        };
        let exponent = |i: usize| {
            let (now, before) = (self.fastest[i], self.fastest[i - 1]);
            (now.1.as_secs_f64() / before.1.as_secs_f64()).ln()
                / (now.0 as f64 / before.0 as f64).ln()
        };
        println!("\n{heading}\n");
        println!("|  |{}", cells(&|i| self.fastest[i].0.to_string()));
        println!("| --- |{}", cells(&|_| "---:".to_owned()));
        println!(
            "| {function} |{}",
            cells(&|i| format!("{:.4} ms", 1e3 * self.fastest[i].1.as_secs_f64()))
        );
        let exponents = cells(&|i| {
            if i == 0 {
                String::new()
            } else {
                format!("{:.2}", exponent(i))
            }
        });
        println!("| exponent |{exponents}");
    }
}

fn main() {
    let short = Duration::from_millis(500);
    let criterion = Criterion::default()
        .warm_up_time(short)
        .measurement_time(4 * short);
    let mut criterion = criterion.sample_size(10).configure_from_args();
    let newton = |heading| Bench::new([heading, "one Newton solve"], Control::Defect);

    let mut by_intervals = newton("intervals, 4 states");
    for intervals in [100, 1_000, 10_000, 100_000] {
        by_intervals.time(&mut criterion, &Rotation::new(4), intervals, intervals);
    }
    let mut by_states = newton("states, 50 intervals");
    for states in [2, 4, 8, 16, 32, 64, 100] {
        by_states.time(&mut criterion, &Rotation::new(states), 50, states);
    }
    let mut nonlinear = Bench::new(
        [
            "states, reaction with diffusion, 20 intervals",
            "solution with its estimate",
        ],
        Control::Both,
    );
    for lines in [5, 10, 25, 50] {
        nonlinear.time(
            &mut criterion,
            &ReactionDiffusion::new(lines),
            20,
            2 * lines,
        );
    }

    criterion.final_summary();
    for bench in [by_intervals, by_states, nonlinear] {
        bench.print();
    }
}
