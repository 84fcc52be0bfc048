//! Linear systems with a band and a border.
//!
//! Neighbours in the loop make a band. The border has what couples to all of it: the cell at which the loop is cut
//! open, and the pulleys.
//!
//! ```text
//! [A B] [x]   [f]        A: band    S = D − C A⁻¹ B
//! [C D] [y] = [g]        y = S⁻¹ (g − C A⁻¹ f)    x = A⁻¹ f − A⁻¹ B y
//! ```

/// A band matrix and its LU factors with row interchanges (Golub and Van Loan, Matrix Computations, 4.3).
#[derive(Debug, Default)]
struct Band {
    /// Entries below and above the diagonal in a row of the matrix.
    below: usize,
    above: usize,
    /// The rows one after the other, each with room for `2 below + above + 1` entries, what interchanges fill included;
    /// the diagonal stands after `below` of them.
    rows: Vec<f64>,
    /// The row with which each was interchanged.
    pivots: Vec<usize>,
}

impl Band {
    fn width(&self) -> usize {
        2 * self.below + self.above + 1
    }

    /// A matrix of zeros.
    fn clear(&mut self, count: usize, below: usize, above: usize) {
        (self.below, self.above) = (below, above);
        self.rows.clear();
        self.rows.resize(count * self.width(), 0.0);
        self.pivots.clear();
        self.pivots.resize(count, 0);
    }

    fn at(&self, row: usize, column: usize) -> usize {
        row * self.width() + self.below + column - row
    }

    fn add(&mut self, row: usize, column: usize, value: f64) {
        let at = self.at(row, column);
        self.rows[at] += value;
    }

    /// Factorises the matrix; whether it is regular.
    fn factorise(&mut self) -> bool {
        let (count, width, below) = (self.pivots.len(), self.width(), self.below);
        let reach = below + self.above;
        let place = |row: usize, column: usize| row * width + below + column - row;
        for column in 0..count {
            let last = (column + below).min(count - 1);
            let size = |row: usize| self.rows[place(row, column)].abs();
            let pivot = (column..=last).fold(column, |best, row| match size(row) > size(best) {
                true => row,
                false => best,
            });
            let largest = size(pivot);
            if largest == 0.0 || !largest.is_finite() {
                return false;
            }
            self.pivots[column] = pivot;
            let length = reach.min(count - 1 - column) + 1;
            let offset = (column + 1) * width;
            let (upper, lower) = self.rows.split_at_mut(offset);
            let upper = &mut upper[place(column, column)..][..length];
            if pivot > column {
                let other = place(pivot, column) - offset;
                upper.swap_with_slice(&mut lower[other..other + length]);
            }
            let per_pivot = upper[0].recip();
            for row in column + 1..=last {
                let lower = &mut lower[place(row, column) - offset..][..length];
                let factor = lower[0] * per_pivot;
                lower[0] = factor;
                if factor != 0.0 {
                    for (to, from) in lower[1..].iter_mut().zip(&upper[1..]) {
                        *to -= factor * from;
                    }
                }
            }
        }
        true
    }

    /// Solves for a right-hand side in its place.
    fn solve(&self, side: &mut [f64]) {
        let (count, reach) = (self.pivots.len(), self.below + self.above);
        for column in 0..count {
            side.swap(column, self.pivots[column]);
            let value = side[column];
            if value != 0.0 {
                let last = (column + self.below).min(count - 1);
                let under = side[column + 1..=last].iter_mut();
                for (row, to) in (column + 1..).zip(under) {
                    *to -= self.rows[self.at(row, column)] * value;
                }
            }
        }
        for row in (0..count).rev() {
            let last = (row + reach).min(count - 1);
            let diagonal = self.at(row, row);
            let upper = &self.rows[diagonal + 1..=diagonal + last - row];
            let known: f64 = { upper.iter().zip(&side[row + 1..=last]) }
                .map(|(entry, value)| entry * value)
                .sum();
            side[row] = (side[row] - known) / self.rows[diagonal];
        }
    }
}

/// A matrix with a band and a border, factorised.
#[derive(Debug)]
pub(super) struct Bordered {
    /// Unknowns of the band; those of the border stand after them.
    inner: usize,
    border: usize,
    band: Band,
    /// S.
    complement: Band,
    /// The columns of A⁻¹ B.
    right: Vec<f64>,
    /// The rows of C.
    lower: Vec<f64>,
}

impl Bordered {
    /// Room for a matrix with so many unknowns in the band and in the border.
    pub(super) fn new(inner: usize, border: usize) -> Self {
        Self {
            inner,
            border,
            band: Band::default(),
            complement: Band::default(),
            right: vec![0.0; inner * border],
            lower: vec![0.0; inner * border],
        }
    }

    /// Factorises the matrix with entries at rows and columns, of which those of the same place are added; whether it
    /// is regular.
    pub(super) fn factorise(&mut self, entries: &[(usize, usize, f64)]) -> bool {
        let (inner, border) = (self.inner, self.border);
        let in_band = |entry: &&(usize, usize, f64)| entry.0 < inner && entry.1 < inner;
        let (mut below, mut above) = (0, 0);
        for &(row, column, _) in entries.iter().filter(in_band) {
            below = below.max(row.saturating_sub(column));
            above = above.max(column.saturating_sub(row));
        }
        self.band.clear(inner, below, above);
        let full = border.saturating_sub(1);
        self.complement.clear(border, full, full);
        self.right.fill(0.0);
        self.lower.fill(0.0);
        for &(row, column, value) in entries {
            match (row < inner, column < inner) {
                (true, true) => self.band.add(row, column, value),
                (true, false) => self.right[(column - inner) * inner + row] += value,
                (false, true) => self.lower[(row - inner) * inner + column] += value,
                (false, false) => self.complement.add(row - inner, column - inner, value),
            }
        }
        if !self.band.factorise() {
            return false;
        }
        for column in 0..border {
            let right = &mut self.right[column * inner..][..inner];
            self.band.solve(right);
            for row in 0..border {
                let lower = &self.lower[row * inner..][..inner];
                let product: f64 = lower.iter().zip(&*right).map(|(c, x)| c * x).sum();
                self.complement.add(row, column, -product);
            }
        }
        self.complement.factorise()
    }

    /// Solves for a right-hand side in its place.
    pub(super) fn solve(&self, side: &mut [f64]) {
        let (first, second) = side.split_at_mut(self.inner);
        self.band.solve(first);
        for (row, value) in second.iter_mut().enumerate() {
            let lower = &self.lower[row * self.inner..][..self.inner];
            *value -= lower.iter().zip(&*first).map(|(c, x)| c * x).sum::<f64>();
        }
        self.complement.solve(second);
        for (column, value) in second.iter().enumerate() {
            let right = &self.right[column * self.inner..][..self.inner];
            for (to, x) in first.iter_mut().zip(right) {
                *to -= x * value;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Bordered;

    #[test]
    fn a_bordered_matrix_is_solved_as_a_full_one() {
        // The first pivot is zero, so that rows are interchanged.
        let rows = [
            [0.0, 2.0, 0.0, 0.5, 1.0],
            [3.0, 1.0, -1.0, 0.0, 2.0],
            [0.0, 4.0, 0.5, -2.0, 0.0],
            [1.0, 0.0, 2.0, 5.0, -1.0],
            [0.5, -1.0, 3.0, 1.0, 0.0],
        ];
        let known = [1.0, -2.0, 3.0, 0.5, -1.5];
        let entries = rows.iter().enumerate().flat_map(|(row, values)| {
            let values = values
                .iter()
                .enumerate()
                .filter(|(_, value)| **value != 0.0);
            values.map(move |(column, value)| (row, column, *value))
        });
        let entries: Vec<_> = entries.collect();
        let mut side = rows.map(|row| row.iter().zip(known).map(|(a, x)| a * x).sum::<f64>());
        let mut matrix = Bordered::new(3, 2);
        assert!(matrix.factorise(&entries));
        matrix.solve(&mut side);
        for (found, known) in side.into_iter().zip(known) {
            assert!((found - known).abs() < 1e-13, "{found} {known}");
        }
        assert!(!matrix.factorise(&[(0, 0, 1.0)]));
    }
}
