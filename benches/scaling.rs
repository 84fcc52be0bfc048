//! How does the cost of one Newton solve grow with the intervals and with the states?
//!
//! Expected: linear in the intervals; cubic in the states, once they are many.

use bvp::{Ends, Equations, GlobalError, Options, Segment, Solution, Table, solve};
use criterion::{BenchmarkId, Criterion, Throughput};
use std::hint::black_box;

/// y′ = A y with a full antisymmetric A; the first half of the states is 1 at s = 0, the others
/// are 1 at s = 1. The Jacobian costs no more than to copy A.
struct Rotation {
    segments: [Segment; 1],
    a: Vec<f64>,
}

impl Rotation {
    fn new(states: usize) -> Self {
        let mut a = vec![0.0; states * states];
        for i in 0..states {
            for j in 0..i {
                // Spread over [−1, 1] and of bounded norm.
                let value = ((i * 7 + j * 13) as f64).sin() / states as f64;
                a[i * states + j] = value;
                a[j * states + i] = -value;
            }
        }
        Self {
            segments: [Segment::new(states)],
            a,
        }
    }

    fn states(&self) -> usize {
        self.segments[0].states
    }
}

impl Equations for Rotation {
    fn segments(&self) -> &[Segment] {
        &self.segments
    }

    fn parameters(&self) -> usize {
        0
    }

    fn condition_count(&self) -> usize {
        self.states()
    }

    fn rhs(&self, _: usize, _: f64, y: &[f64], _: &[f64], dy: &mut [f64]) {
        for (dy, row) in dy.iter_mut().zip(self.a.chunks_exact(y.len())) {
            *dy = row.iter().zip(y).map(|(a, y)| a * y).sum();
        }
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
        self.rhs(segment, s, y, p, dy);
        jacobian.copy_from_slice(&self.a);
    }

    fn conditions(&self, at: Ends<'_, f64>, _: &[f64], r: &mut [f64]) {
        let half = self.states() / 2;
        for (i, r) in r.iter_mut().enumerate() {
            let end = if i < half { at.start(0) } else { at.end(0) };
            *r = end[i] - 1.0;
        }
    }

    fn conditions_jacobian(&self, ends: &[f64], p: &[f64], r: &mut [f64], jacobian: &mut [f64]) {
        self.conditions(Ends::new(&self.segments, ends), p, r);
        let n = self.states();
        jacobian.fill(0.0);
        for i in 0..n {
            let column = if i < n / 2 { i } else { n + i };
            jacobian[i * 2 * n + column] = 1.0;
        }
    }
}

/// The zero guess on equal intervals.
fn guess(states: usize, intervals: usize) -> Table {
    let nodes = (0..=intervals).map(|i| i as f64 / intervals as f64);
    Table {
        nodes: vec![nodes.collect()],
        states: vec![vec![0.0; states * (intervals + 1)]],
        parameters: vec![],
    }
}

/// Solves the linear problem on the mesh of the guess: one factorisation and nothing more.
fn newton(equations: &Rotation, guess: &Table) -> Solution {
    let options = Options {
        tolerance: 1e-3,
        max_intervals: 20_000,
        global_error: GlobalError::Skip,
        ..Options::default()
    };
    solve(equations, guess, &options).expect("a well-posed linear problem")
}

fn bench(
    criterion: &mut Criterion,
    name: &str,
    sizes: impl Iterator<Item = (usize, usize, usize)>,
) {
    let mut group = criterion.benchmark_group(name);
    for (states, intervals, shown) in sizes {
        let (equations, guess) = (Rotation::new(states), guess(states, intervals));
        let stats = *newton(&equations, &guess).stats();
        assert_eq!((stats.meshes, stats.factorisations), (1, 1));
        group.throughput(Throughput::Elements(intervals as u64));
        let id = BenchmarkId::new("one Newton solve", shown);
        group.bench_function(id, |b| b.iter(|| newton(&equations, black_box(&guess))));
    }
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let intervals = (0..8).map(|i| 100 << i);
    let sizes = intervals.map(|intervals| (4, intervals, intervals));
    bench(&mut criterion, "intervals, 4 states", sizes);
    let states = [2, 4, 8, 16, 32, 64].into_iter();
    let sizes = states.map(|states| (states, 200, states));
    bench(&mut criterion, "states, 200 intervals", sizes);
    criterion.final_summary();
}
