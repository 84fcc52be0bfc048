//! The structured elimination against dense linear algebra.

use super::AlmostBlockDiagonal;
use crate::discretisation::iterate::{Iterate, SegmentIterate};
use crate::kernels::dense::max_or_nan;
use crate::kernels::reflections::MANY;
use crate::newton_matrix::singular::Singular;
use faer::Mat;
use faer::linalg::solvers::Solve;
use proptest::prelude::*;

/// A linear problem: transition blocks and right-hand sides of every segment, and the conditions.
struct Linear {
    /// (states, intervals) of each segment.
    sizes: Vec<(usize, usize)>,
    k: usize,
    /// \[Γ P\] of each interval, row-major, for each segment.
    blocks: Vec<Vec<Vec<f64>>>,
    /// gᵢ of all intervals of a segment, one after the other.
    loads: Vec<Vec<f64>>,
    /// Jacobian and right-hand sides of the conditions.
    conditions: Vec<f64>,
    values: Vec<f64>,
}

impl Linear {
    fn random(sizes: Vec<(usize, usize)>, k: usize, mut seed: u64) -> Self {
        // Knuth's multiplicative congruential generator, mapped to [−1, 1).
        let mut number = move || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        let mut numbers =
            move |count: usize| -> Vec<f64> { (0..count).map(|_| number()).collect() };
        let states: usize = sizes.iter().map(|(n, _)| n).sum();
        Self {
            blocks: sizes
                .iter()
                .map(|&(n, intervals)| (0..intervals).map(|_| numbers(n * (n + k))).collect())
                .collect(),
            loads: sizes.iter().map(|&(n, i)| numbers(n * i)).collect(),
            conditions: numbers((states + k) * (2 * states + k)),
            values: numbers(states + k),
            sizes,
            k,
        }
    }

    /// By the structured elimination: all node states and then the parameters.
    fn structured(&self) -> Result<Vec<f64>, Singular> {
        let (states, conditions) = (self.sizes.iter().map(|size| size.0), self.values.len());
        let mut matrix = AlmostBlockDiagonal::new(states, self.k, conditions);
        matrix.resize(self.sizes.iter().map(|size| size.1));
        for (segment, blocks) in self.blocks.iter().enumerate() {
            let all = matrix.transitions_mut(segment).blocks_mut();
            all.copy_from_slice(&blocks.concat());
        }
        matrix.factor(&self.conditions)?;
        let segment = |(&(n, _), loads): (&(usize, usize), &Vec<f64>)| SegmentIterate {
            nodes: [vec![0.0; n], loads.clone()].concat(),
            stages: vec![],
        };
        let mut x = Iterate {
            segments: self.sizes.iter().zip(&self.loads).map(segment).collect(),
            p: vec![0.0; self.k],
        };
        let residuals: Vec<f64> = self.values.iter().map(|value| -value).collect();
        matrix.solve(&mut x, &residuals);
        let nodes = x.segments.into_iter().map(|s| s.nodes);
        Ok(nodes.chain([x.p]).flatten().collect())
    }

    /// The dense matrix and right-hand side, conditions first.
    fn dense(&self) -> (Mat<f64>, Mat<f64>) {
        let nodes: usize = self.sizes.iter().map(|(n, i)| n * (i + 1)).sum();
        let size = nodes + self.k;
        let (mut a, mut b) = (Mat::zeros(size, size), Mat::zeros(size, 1));
        let ends: usize = self.sizes.iter().map(|(n, _)| 2 * n).sum();
        for (row, value) in self.values.iter().enumerate() {
            b[(row, 0)] = *value;
            let coefficients = &self.conditions[row * (ends + self.k)..][..ends + self.k];
            let (mut first, mut end) = (0, 0);
            for &(n, intervals) in &self.sizes {
                for j in 0..n {
                    a[(row, first + j)] = coefficients[end + j];
                    a[(row, first + n * intervals + j)] = coefficients[end + n + j];
                }
                first += n * (intervals + 1);
                end += 2 * n;
            }
            for j in 0..self.k {
                a[(row, nodes + j)] = coefficients[ends + j];
            }
        }
        let (mut row, mut first) = (self.values.len(), 0);
        for ((&(n, _), blocks), loads) in self.sizes.iter().zip(&self.blocks).zip(&self.loads) {
            for (block, load) in blocks.iter().zip(loads.chunks(n)) {
                for (r, (row_of_block, load)) in block.chunks(n + self.k).zip(load).enumerate() {
                    for j in 0..n {
                        a[(row + r, first + j)] = -row_of_block[j];
                    }
                    for j in 0..self.k {
                        a[(row + r, nodes + j)] = -row_of_block[n + j];
                    }
                    a[(row + r, first + n + r)] = 1.0;
                    b[(row + r, 0)] = *load;
                }
                row += n;
                first += n;
            }
            first += n;
        }
        (a, b)
    }
}

fn largest(x: impl Iterator<Item = f64>) -> f64 {
    x.map(f64::abs).fold(0.0, max_or_nan)
}

proptest! {
    #[test]
    fn agrees_with_a_dense_solve(
        sizes in prop::collection::vec(
            (prop_oneof![9 => 1usize..=6, 1 => MANY..=MANY + 4], 1usize..=12),
            1..=3,
        ),
        k in 0usize..=3,
        seed: u64,
    ) {
        let problem = Linear::random(sizes, k, seed);
        let (a, b) = problem.dense();
        let reference = a.partial_piv_lu().solve(&b);
        let scale = 1.0 + largest((0..b.nrows()).map(|i| reference[(i, 0)]));
        // A large solution of so small a right-hand side is an ill-conditioned matrix.
        prop_assume!(scale < 1e3);
        let found = problem.structured();
        prop_assert!(found.is_ok(), "{found:?}");
        let found = found.unwrap();
        prop_assert_eq!(found.len(), b.nrows());
        let x = Mat::from_fn(b.nrows(), 1, |i, _| found[i]);
        let residual = &a * &x - &b;
        prop_assert!(largest((0..b.nrows()).map(|i| residual[(i, 0)])) < 1e-12 * scale);
        prop_assert!(
            largest((0..b.nrows()).map(|i| x[(i, 0)] - reference[(i, 0)])) < 1e-8 * scale
        );
    }
}

/// S. J. Wright's example (SIAM J. Sci. Comput. 14, 1993): y' = M y on 0 ≤ s ≤ 60, eigenvalues 5/6
/// and −7/6, y(0) + y(60) given.
#[test]
fn wrights_problem_is_solved_to_rounding() {
    let intervals = 200;
    let h = 60.0 / intervals as f64;
    let (cosh, sinh) = (h.cosh() * (-h / 6.0).exp(), h.sinh() * (-h / 6.0).exp());
    let problem = Linear {
        sizes: vec![(2, intervals)],
        k: 0,
        blocks: vec![vec![vec![cosh, sinh, sinh, cosh]; intervals]],
        loads: vec![vec![0.0; 2 * intervals]],
        conditions: vec![1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0],
        values: vec![1.0, 0.0],
    };
    // (1, 1) grows and (1, −1) decays.
    let exact = |i: usize| {
        let s = h * (i / 2) as f64;
        let growing = 0.5 * (5.0 / 6.0 * (s - 60.0)).exp() / (1.0 + (-50f64).exp());
        let decaying = 0.5 * (-7.0 / 6.0 * s).exp() / (1.0 + (-70f64).exp());
        growing
            + if i.is_multiple_of(2) {
                decaying
            } else {
                -decaying
            }
    };
    let found = problem.structured().unwrap();
    let error = largest(found.iter().enumerate().map(|(i, y)| y - exact(i)));
    assert!(error < 1e-12, "structured elimination: error {error:e}");

    let (a, b) = problem.dense();
    let pivoted = a.partial_piv_lu().solve(&b);
    let lost = largest((0..b.nrows()).map(|i| pivoted[(i, 0)] - exact(i)));
    assert!(
        lost.is_nan() || lost > 1e-2,
        "row pivoting was expected to fail: {lost:e}"
    );
}

#[test]
fn a_condition_given_twice_is_singular() {
    let mut problem = Linear::random(vec![(2, 5)], 0, 1);
    let first: Vec<f64> = problem.conditions[..4].to_vec();
    problem.conditions[4..].copy_from_slice(&first);
    assert_eq!(problem.structured(), Err(Singular::Ends));
}

#[test]
fn a_node_that_no_block_determines_is_named() {
    // Blocks that are not finite cannot be eliminated.
    let mut problem = Linear::random(vec![(1, 2), (2, 4)], 1, 2);
    problem.blocks[1][2][0] = f64::NAN;
    let (segment, node) = (1, 2);
    assert_eq!(problem.structured(), Err(Singular::Node { segment, node }));
}
