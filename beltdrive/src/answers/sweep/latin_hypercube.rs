//! Latin hypercube samples, each computed from its index alone.

use super::SweepRow;
use super::mixing::{fraction, key, mixed};

/// A Latin hypercube sample of ranges (M. D. `McKay`, R. J. Beckman, W. J. Conover, Technometrics 21, 1979): the range of
/// each number is parted into as many equal strata as there are rows, and every stratum has one row, at a random place
/// within it.
///
/// A row is computed from its index: which stratum it has is a random permutation of the indices by a Feistel network
/// that is walked until it ends among them (J. Black, P. Rogaway, *Ciphers with arbitrary finite domains*, CT-RSA
/// 2002), so that samples of any size take no memory and any part of them can be had alone.
#[derive(Clone, Debug, PartialEq)]
pub struct LatinHypercube {
    ranges: Vec<[f64; 2]>,
    count: usize,
    seed: u64,
}

/// Rounds of the Feistel network. Four suffice in theory (M. Luby, C. Rackoff, SIAM J. Comput. 17, 1988), where halves are
/// large; samples of some ten rows have halves of two bits.
const ROUNDS: u64 = 8;

impl LatinHypercube {
    /// A sample of so many rows of the ranges of some numbers, SI; the same for the same seed.
    #[must_use]
    pub fn new(ranges: Vec<[f64; 2]>, count: usize, seed: u64) -> Self {
        Self {
            ranges,
            count,
            seed,
        }
    }

    /// The number of rows.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// The rows from one on; computed as they are asked for.
    pub fn rows(&self, from: usize) -> impl Iterator<Item = SweepRow> {
        (from..self.count).map(|index| {
            let ranges = self.ranges.iter().enumerate();
            let values = ranges.map(|(number, &[from, to])| {
                let key = key(self.seed, number);
                let stratum = permuted(index as u64, self.count as u64, key);
                let share = (stratum as f64 + fraction(mixed(key ^ mixed(!(index as u64)))))
                    / self.count as f64;
                from + share * (to - from)
            });
            SweepRow::new(values.collect())
        })
    }
}

/// Where a random permutation of the whole numbers below `count` takes one of them.
fn permuted(index: u64, count: u64, key: u64) -> u64 {
    // Both halves have as many bits, so that the network permutes the numbers below the next power of four.
    let bits = (u64::BITS - (count - 1).leading_zeros()).div_ceil(2).max(1);
    let mask = (1_u64 << bits) - 1;
    let mut at = index;
    loop {
        let [mut left, mut right] = [at >> bits, at & mask];
        for round in 0..ROUNDS {
            let turned = mixed(key.wrapping_add(round) ^ mixed(right)) & mask;
            [left, right] = [right, left ^ turned];
        }
        at = left << bits | right;
        if at < count {
            return at;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(count: usize, seed: u64) -> Vec<Vec<f64>> {
        let sample = LatinHypercube::new(vec![[0.0, 1.0], [-2.0, 2.0], [5.0, 6.0]], count, seed);
        sample.rows(0).map(|row| row.values).collect()
    }

    #[test]
    fn every_stratum_of_every_number_has_one_row() {
        for count in [1, 2, 3, 7, 10, 64, 1000] {
            let rows = sample(count, 1);
            for (number, [from, to]) in [[0.0, 1.0], [-2.0, 2.0], [5.0, 6.0]]
                .into_iter()
                .enumerate()
            {
                let mut strata = vec![0; count];
                for row in &rows {
                    let share = (row[number] - from) / (to - from);
                    assert!((0.0..1.0).contains(&share));
                    // A value may be rounded onto the edge of its stratum.
                    #[expect(
                        clippy::cast_possible_truncation,
                        clippy::cast_sign_loss,
                        reason = "below count"
                    )]
                    let stratum = (share * count as f64 + 1e-9) as usize;
                    strata[stratum.min(count - 1)] += 1;
                }
                assert!(strata.iter().all(|&rows| rows == 1), "{count} {number}");
            }
        }
    }

    #[test]
    fn rows_are_known_by_index_and_seed() {
        let rows = sample(100, 7);
        let again = LatinHypercube::new(vec![[0.0, 1.0], [-2.0, 2.0], [5.0, 6.0]], 100, 7);
        let from_40: Vec<_> = again.rows(40).map(|row| row.values).collect();
        assert_eq!(from_40, rows[40..]);
        assert_ne!(rows, sample(100, 8));
    }

    #[test]
    fn numbers_and_neighbours_are_not_correlated() {
        let rows = sample(4000, 3);
        // Uniform numbers from 0 to 1 have a variance of 1/12; the correlation of independent ones has a standard
        // deviation of 1/√4000 = 0.016.
        let scaled = |row: &Vec<f64>, number: usize| match number {
            0 => row[0] - 0.5,
            1 => row[1] / 4.0,
            _ => row[2] - 5.5,
        };
        let correlation = |pairs: &[(f64, f64)]| {
            12.0 * pairs.iter().map(|(one, other)| one * other).sum::<f64>() / pairs.len() as f64
        };
        for (one, other) in [(0, 1), (0, 2), (1, 2)] {
            let pairs: Vec<_> = rows
                .iter()
                .map(|row| (scaled(row, one), scaled(row, other)))
                .collect();
            assert!(correlation(&pairs).abs() < 0.065, "{one} {other}");
        }
        for number in 0..3 {
            let pairs: Vec<_> = rows
                .windows(2)
                .map(|rows| (scaled(&rows[0], number), scaled(&rows[1], number)))
                .collect();
            assert!(correlation(&pairs).abs() < 0.065, "{number}");
        }
    }
}
