//! Points of the Sobol' sequence, scrambled, each computed from its index alone.

mod direction_numbers;

use super::SweepRow;
use super::mixing::{fraction, key, mixed};
use direction_numbers::{DIRECTIONS, Direction};

/// The first points of the Sobol' sequence in ranges (I. M. Sobol', USSR Comput. Math. Math. Phys. 7, 1967), with
/// the direction numbers of S. Joe and F. Y. Kuo (2008), in the order of the Gray code.
///
/// The first 2ᵏ points, and each 2ᵏ that follow, have one point in each of 2ᵏ equal strata of every number, and are spread as
/// evenly over several numbers as such points can be. They are scrambled (A. B. Owen, *Randomly permuted (t,m,s)-nets and
/// (t,s)-sequences*, 1995), which keeps that: each point alone is uniformly distributed, samples of
/// several seeds show how far their means are off, and the first point is not the corner of all lower ends. Means of smooth
/// functions over 2ᵏ points are off by about N^(−3/2) in place of N^(−1/2) (A. B. Owen, Ann. Statist. 25, 1997).
///
/// A row does not depend on how many there are: a larger sample begins with the rows of a smaller one.
#[derive(Clone, Debug, PartialEq)]
pub struct Sobol {
    ranges: Vec<[f64; 2]>,
    count: usize,
    seed: u64,
    /// Of each number, what each bit of the index adds to its point, as bits behind the binary point.
    columns: Vec<[u64; BITS]>,
}

/// Bits of an index and of a point.
const BITS: usize = u64::BITS as usize;

/// Bits of a point that a double has room for: those that are scrambled.
const SCRAMBLED: u32 = f64::MANTISSA_DIGITS;

impl Sobol {
    /// The most numbers that may vary.
    pub const MOST_NUMBERS: usize = DIRECTIONS.len() + 1;

    /// A sample of so many rows of the ranges of some numbers, SI; scrambled alike for the same seed.
    ///
    /// # Panics
    /// If there are more numbers than [`Sobol::MOST_NUMBERS`].
    #[must_use]
    pub fn new(ranges: Vec<[f64; 2]>, count: usize, seed: u64) -> Self {
        let first = std::array::from_fn(|bit| 1 << (BITS - 1 - bit));
        let others = DIRECTIONS.iter().map(columns);
        let columns: Vec<_> = { std::iter::once(first).chain(others) }
            .take(ranges.len())
            .collect();
        assert_eq!(columns.len(), ranges.len(), "not too many numbers");
        Self {
            ranges,
            count,
            seed,
            columns,
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
            let numbers = self.ranges.iter().zip(&self.columns).enumerate();
            let values = numbers.map(|(number, (&[from, to], columns))| {
                let point = scrambled(point(columns, index as u64), key(self.seed, number));
                from + fraction(point) * (to - from)
            });
            SweepRow::new(values.collect())
        })
    }
}

/// What each bit of an index adds to a point (P. Bratley, B. L. Fox, ACM Trans. Math. Softw. 14, 1988, eq. 2 and 3).
fn columns(&(polynomial, initial): &Direction) -> [u64; BITS] {
    let degree = initial.len();
    let mut columns = [0; BITS];
    for bit in 0..BITS {
        columns[bit] = match initial.get(bit) {
            Some(number) => number << (BITS - 1 - bit),
            None => {
                let oldest = columns[bit - degree];
                let terms = (1..=degree).filter(|term| polynomial >> (degree - term) & 1 == 1);
                terms.fold(oldest >> degree, |sum, term| sum ^ columns[bit - term])
            }
        };
    }
    columns
}

/// The bits of a point behind the binary point.
fn point(columns: &[u64; BITS], index: u64) -> u64 {
    let gray = index ^ index >> 1;
    let bits = columns.iter().enumerate();
    let bits = bits.filter(|(bit, _)| gray >> bit & 1 == 1);
    bits.fold(0, |sum, (_, column)| sum ^ column)
}

/// A point with each bit turned, or not, at random, depending on the bits before it.
fn scrambled(point: u64, key: u64) -> u64 {
    (0..SCRAMBLED).fold(point, |turned, bit| {
        // The bits before, behind a one that says how many they are.
        let before = 1 << bit | point.checked_shr(u64::BITS - bit).unwrap_or(0);
        turned ^ (mixed(key ^ mixed(before)) & 1) << (u64::BITS - 1 - bit)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The points that are not scrambled, with 2⁻³² for one.
    fn plain(numbers: usize, count: u64) -> Vec<Vec<u64>> {
        let sobol = Sobol::new(vec![[0.0, 1.0]; numbers], 0, 0);
        let row = |index| {
            let points = sobol.columns.iter().map(|columns| point(columns, index));
            points.map(|point| point >> 32).collect()
        };
        (0..count).map(row).collect()
    }

    /// The points of a seed, with 2⁻³² for one.
    fn turned(numbers: usize, count: usize, seed: u64) -> Vec<Vec<u64>> {
        let sobol = Sobol::new(vec![[0.0, 4_294_967_296.0]; numbers], count, seed);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "from 0 to below 2³²"
        )]
        let whole = |value: f64| value as u64;
        let rows = sobol.rows(0).map(|row| row.values);
        rows.map(|row| row.into_iter().map(whole).collect())
            .collect()
    }

    #[test]
    fn the_first_points_are_those_of_the_sequence() {
        let points = plain(5, 8);
        let sixteenths = points.iter().map(|row| row.iter().map(|value| value >> 28));
        let sixteenths: Vec<_> = sixteenths.map(Iterator::collect::<Vec<_>>).collect();
        let expected = [
            [0, 0, 0, 0, 0],
            [8, 8, 8, 8, 8],
            [12, 4, 4, 4, 12],
            [4, 12, 12, 12, 4],
            [6, 6, 10, 14, 6],
            [14, 14, 2, 6, 14],
            [10, 2, 14, 10, 10],
            [2, 10, 6, 2, 2],
        ];
        assert_eq!(sixteenths, expected);
        // All direction numbers that are tabulated take part in 1024 points; the sum is that of `scipy.stats.qmc.Sobol`
        // (SciPy 1.17).
        let mut sum = 0;
        for (row, index) in plain(Sobol::MOST_NUMBERS, 1024).iter().zip(1..) {
            for (value, number) in row.iter().zip(1..) {
                sum += (value >> 22) * index * number;
            }
        }
        assert_eq!(sum, 384_522_938_624_u64);
    }

    #[test]
    fn every_stratum_of_every_number_has_one_row_of_each_power_of_two() {
        let most = Sobol::MOST_NUMBERS;
        for rows in [plain(most, 256), turned(most, 256, 5)] {
            for bits in 0..=8 {
                for block in rows.chunks(1 << bits) {
                    for number in 0..most {
                        let mut strata: Vec<_> =
                            block.iter().map(|row| row[number] >> (32 - bits)).collect();
                        strata.sort_unstable();
                        assert!(strata.into_iter().eq(0..1 << bits), "{number}");
                    }
                }
            }
        }
    }

    /// Boxes of 2⁻ᵏ of the volume, with edges of powers of two, hold as many of 2ᵐ points as they must if k ≤ m − t, where t is
    /// the sum of the degrees of the polynomials less one each (Sobol', 1967).
    #[test]
    fn boxes_hold_their_share_of_the_points() {
        let degree = |number: usize| number.checked_sub(1).map_or(1, |at| DIRECTIONS[at].1.len());
        for numbers in [[0, 1], [1, 2], [4, 5], [9, 10], [2, 7], [0, 52], [14, 3]] {
            let t: usize = numbers.iter().map(|&number| degree(number) - 1).sum();
            let m = 12;
            let most = numbers[0].max(numbers[1]) + 1;
            for rows in [plain(most, 1 << m), turned(most, 1 << m, 3)] {
                let k = m - t;
                for first in 0..=k {
                    let mut counts = vec![0; 1 << k];
                    for row in &rows {
                        let [x, y] = numbers.map(|number| row[number]);
                        let at = (x >> (32 - first)) << (k - first) | y >> (32 - (k - first));
                        counts[usize::try_from(at).unwrap()] += 1;
                    }
                    assert!(counts.iter().all(|count| *count == 1 << t), "{numbers:?}");
                }
            }
        }
    }

    #[test]
    fn rows_are_known_by_index_and_seed() {
        let ranges = vec![[0.0, 1.0], [-2.0, 2.0], [5.0, 6.0]];
        let of = |count, seed| Sobol::new(ranges.clone(), count, seed);
        let rows =
            |sobol: &Sobol, from| -> Vec<_> { sobol.rows(from).map(|row| row.values).collect() };
        let all = rows(&of(1000, 7), 0);
        assert_eq!(rows(&of(1000, 7), 400), all[400..]);
        assert_eq!(rows(&of(300, 7), 0), all[..300]);
        assert_ne!(rows(&of(1000, 8), 0), all);
        for row in &all {
            for (value, [from, to]) in row.iter().zip(&ranges) {
                assert!((*from..*to).contains(value));
            }
        }
        // Far on in the sequence, where a sample of the greatest size ends.
        let last = of(1_000_000_000_000, 7).rows(999_999_999_999).next();
        assert!((5.0..6.0).contains(&last.unwrap().values[2]));
    }

    /// The root mean square of the errors of the mean of a function of four numbers, over seeds.
    fn error(count: usize) -> f64 {
        let seeds = 1..=16;
        let square = |seed| {
            let sobol = Sobol::new(vec![[0.0, 1.0]; 4], count, seed);
            let value = |row: SweepRow| -> f64 { row.values.iter().map(|x| x.exp()).product() };
            let mean = sobol.rows(0).map(value).sum::<f64>() / count as f64;
            let expected = std::f64::consts::E - 1.0;
            (mean / expected.powi(4) - 1.0).powi(2)
        };
        (seeds.clone().map(square).sum::<f64>() / seeds.count() as f64).sqrt()
    }

    #[test]
    fn means_of_smooth_functions_converge_faster_than_random_ones() {
        // Of e^x the mean square is (e² − 1)/2, that is 1.0820 of the square of its mean; of four factors 1.3707. Random
        // points are off by √(0.3707/N).
        let random = |count: usize| (0.3707 / count as f64).sqrt();
        let errors = [256, 4096].map(|count| error(count) / random(count));
        assert!(errors[0] < 0.1 && errors[1] < 0.02, "{errors:?}");
        // N^(−3/2) less a power of the logarithm, where random points give N^(−1/2).
        assert!(errors[1] < errors[0] / 6.0, "{errors:?}");
    }
}
