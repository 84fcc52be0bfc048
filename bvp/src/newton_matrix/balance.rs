//! Units of the states in which transition blocks are eliminated.
//!
//! Reflections mix rows, and where a state is in other units than its neighbours, as a slope is on an
//! interval of nanometres, the digits of the small rows are lost in the large ones. The blocks Γ are
//! therefore balanced, D⁻¹ Γ D, by powers of two, which round nothing: E. E. Osborne, "On
//! pre-conditioning of matrices", J. ACM 7 (1960) 338-345.

use crate::kernels::dense::max_or_nan;
use crate::shares::MODERATE;

/// Balances \[Γ P\], n × (n + k) per interval, in place, if that is needed, and writes the units D, n numbers:
/// rows are divided by them, columns of states multiplied. Returns whether it was needed: units whose ratio is
/// moderate are left alone, as intervals differ in what is best for them. `sizes` is a
/// buffer of n × n numbers.
pub(super) fn balance(blocks: &mut [f64], k: usize, units: &mut [f64], sizes: &mut [f64]) -> bool {
    let n = units.len();
    units.fill(1.0);
    if n == 1 {
        return false;
    }
    largest_entries(blocks, n, k, sizes);
    if !may_differ(sizes, n) {
        return false;
    }
    // A unit goes one state farther with every sweep, and no path from state to state is longer than n.
    for _ in 0..n {
        let mut steady = true;
        for i in 0..n {
            let others = || (0..n).filter(|&j| j != i);
            let row: f64 = others().map(|j| sizes[i * n + j] * units[j]).sum();
            let column: f64 = others().map(|j| sizes[j * n + i] / units[j]).sum();
            // Entries below one do no harm: the larger ones are brought there, or to the others.
            let (row, column) = (row / units[i], column * units[i]);
            if row.max(column) <= 1.0 {
                continue;
            }
            let factor = if row > column.max(1.0) {
                (row / column).sqrt().min(row)
            } else if column > row.max(1.0) {
                (row / column).sqrt().max(1.0 / column)
            } else {
                1.0
            };
            let unit = units[i] * factor.log2().round().exp2();
            if unit.is_normal() && unit != units[i] {
                (units[i], steady) = (unit, false);
            }
        }
        if steady {
            break;
        }
    }
    let largest = units.iter().copied().fold(0.0, f64::max);
    let smallest = units.iter().copied().fold(f64::INFINITY, f64::min);
    if largest / smallest <= MODERATE {
        units.fill(1.0);
        return false;
    }
    for block in blocks.chunks_exact_mut(n * (n + k)) {
        for (row, unit) in block.chunks_exact_mut(n + k).zip(&*units) {
            for (j, x) in row.iter_mut().enumerate() {
                *x *= units.get(j).unwrap_or(&1.0) / unit;
            }
        }
    }
    true
}

/// Whether units may come to differ by more than is moderate: a state is brought to the size of the one that
/// it is coupled with most, so that two of them differ by no more than the product of the sums of couplings
/// along a path of at most n − 1 steps.
fn may_differ(sizes: &[f64], n: usize) -> bool {
    let sums = sizes.chunks_exact(n).enumerate().map(|(i, row)| {
        let others = row.iter().enumerate().filter(|(j, _)| *j != i);
        others.map(|(_, size)| size).sum::<f64>()
    });
    let largest = sums.fold(0.0, max_or_nan);
    let path = (1..n).fold(1.0, |product, _| product * largest);
    path.is_nan() || path > MODERATE
}

/// The largest |Γᵢⱼ| over all intervals, n × n, into `sizes`.
fn largest_entries(blocks: &[f64], n: usize, k: usize, sizes: &mut [f64]) {
    sizes.fill(0.0);
    for block in blocks.chunks_exact(n * (n + k)) {
        let rows = block.chunks_exact(n + k).zip(sizes.chunks_exact_mut(n));
        for (row, sizes) in rows {
            for (size, x) in sizes.iter_mut().zip(row) {
                *size = size.max(x.abs());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_in_other_units_are_balanced_exactly() {
        // The transition of y'' = y / (0.01 L)² over 0.02 L for L = 1e-10.
        let (near, far) = (2f64.cosh(), 2f64.sinh());
        let block = [near, 1e-12 * far, 7.0, 1e12 * far, near, 3.0];
        let mut balanced = block;
        let (mut units, mut sizes) = ([0.0; 2], [0.0; 4]);
        assert!(balance(&mut balanced, 1, &mut units, &mut sizes));
        for (i, row) in balanced.chunks_exact(3).enumerate() {
            for (j, x) in row.iter().enumerate() {
                let unit = units.get(j).unwrap_or(&1.0) / units[i];
                assert_eq!(*x, block[3 * i + j] * unit);
            }
        }
        let ratio = balanced[1] / balanced[3];
        assert!((0.25..4.0).contains(&ratio), "{ratio}");
    }

    #[test]
    fn moderate_and_small_couplings_are_left_alone() {
        for block in [[1.0, 30.0, 1.0, 1.0], [1.0, 1e-9, 1e-300, 1.0]] {
            let mut balanced = block;
            let (mut units, mut sizes) = ([0.0; 2], [0.0; 4]);
            assert!(!balance(&mut balanced, 0, &mut units, &mut sizes));
            assert_eq!((balanced, units), (block, [1.0; 2]));
        }
    }
}
