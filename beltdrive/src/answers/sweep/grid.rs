//! All combinations of values.

use super::SweepRow;

/// All combinations of the values of some numbers. The last number varies fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    axes: Vec<Vec<f64>>,
    count: usize,
}

impl Grid {
    /// The combinations of the values of each number, SI.
    ///
    /// # Panics
    /// If there are more than fit a `usize`; see [`Grid::count_of`].
    #[must_use]
    pub fn new(axes: Vec<Vec<f64>>) -> Self {
        let count = Self::count_of(&axes).expect("a number of rows that fits");
        Self { axes, count }
    }

    /// The number of combinations, if it fits.
    #[must_use]
    pub fn count_of(axes: &[Vec<f64>]) -> Option<usize> {
        let mut axes = axes.iter();
        axes.try_fold(1_usize, |count, axis| count.checked_mul(axis.len()))
    }

    /// The number of rows.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// The rows from one on; computed as they are asked for.
    pub fn rows(&self, from: usize) -> impl Iterator<Item = SweepRow> {
        (from..self.count).map(|index| {
            let mut rest = index;
            let mut values: Vec<_> = { self.axes.iter().rev() }
                .map(|axis| {
                    let value = axis[rest % axis.len()];
                    rest /= axis.len();
                    value
                })
                .collect();
            values.reverse();
            SweepRow::new(values)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_number_varies_fastest_and_rows_may_begin_anywhere() {
        let grid = Grid::new(vec![vec![1.0, 2.0], vec![10.0, 20.0, 30.0]]);
        assert_eq!(grid.count(), 6);
        let rows: Vec<_> = grid.rows(0).map(|row| row.values).collect();
        assert_eq!(rows[0], [1.0, 10.0]);
        assert_eq!(rows[2], [1.0, 30.0]);
        assert_eq!(rows[3], [2.0, 10.0]);
        let last: Vec<_> = grid.rows(4).map(|row| row.values).collect();
        assert_eq!(last, rows[4..]);
        assert!(grid.rows(6).next().is_none());
        let huge = vec![vec![0.0; 1 << 16]; 5];
        assert_eq!(Grid::count_of(&huge), None);
    }
}
