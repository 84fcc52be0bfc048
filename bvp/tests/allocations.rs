//! Newton's iteration allocates nothing: more linearisations allocate no more.
//!
//! A program of one thread, since the thread of a test harness allocates at times of its own.

use bvp::{Control, Ends, Options, Problem, Real, Segment, Stats, Table, solve};

/// The allocator of the system, which counts.
#[global_allocator]
static ALLOCATOR: dhat::Alloc = dhat::Alloc;

/// y'' = (3/2) y², y(0) = 4, y(1) = 1 on both segments, on the second beside u' = p u, u(0) = 1,
/// u(1) = 2.
struct Power;

impl Problem for Power {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2), Segment::new(3)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = y[0] * y[0] * 1.5;
        if let Some(du) = dy.get_mut(2) {
            *du = y[2] * p[0];
        }
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] - 4.0;
        r[1] = at.end(0)[0] - 1.0;
        r[2] = at.start(1)[0] - 4.0;
        r[3] = at.end(1)[0] - 1.0;
        r[4] = at.start(1)[2] - 1.0;
        r[5] = at.end(1)[2] - 2.0;
    }
}

/// The allocations of a solution from a constant guess on 20 intervals, and its work.
fn cost(value: f64) -> (u64, Stats) {
    let nodes: Vec<f64> = (0..=20).map(|i| f64::from(i) / 20.0).collect();
    let guess = Table {
        states: [2, 3].map(|n| vec![value; n * nodes.len()]).to_vec(),
        nodes: vec![nodes; 2],
        parameters: vec![value],
    };
    let options = Options {
        control: Control::Defect,
        retries: 0,
        ..Options::to(1e-4)
    };
    let before = dhat::HeapStats::get().total_blocks;
    let solution = solve(&Power, &guess, &options).unwrap();
    let count = dhat::HeapStats::get().total_blocks - before;
    assert_eq!(solution.stats().meshes, 1);
    (count, *solution.stats())
}

fn main() {
    let _profiler = dhat::Profiler::builder().testing().build();
    // What is computed once, the coefficients of the scheme, is computed here.
    cost(1.0);
    let (few, few_stats) = cost(1.0);
    let (many, many_stats) = cost(200.0);
    assert!(
        many_stats.factorisations >= few_stats.factorisations + 5,
        "{few_stats:?} {many_stats:?}"
    );
    assert_eq!(few, many, "{few_stats:?} {many_stats:?}");
}
