//! A sparse Jacobian with the row of one unknown.

use crate::system::sparse_lu::{Columns, SparseLu};

/// J and the row of the unknown that is left over, with the rows of J scaled to a largest entry of one:
///
/// ```text
/// ┌ R J ┐ n
/// │     │          e the unit vector of the unknown
/// └ eᵀ  ┘ 1
/// ```
#[derive(Clone)]
pub(crate) struct Bordered {
    matrix: Columns,
    /// Where every listed entry of J is added.
    place: Vec<usize>,
    row_scale: Vec<f64>,
    lu: SparseLu,
}

impl Bordered {
    /// The structure of the listed entries of J, of its diagonal and of the row of `free`; `None` where
    /// there is no memory for it.
    pub(crate) fn new(listed: &[(usize, usize, f64)], n: usize, free: usize) -> Option<Self> {
        let own = listed.iter().map(|&(row, column, _)| (column, row));
        let diagonal = (0..n).map(|i| (i, i)).chain([(free, n)]);
        let mut pattern: Vec<(usize, usize)> = own.clone().chain(diagonal).collect();
        pattern.sort_unstable();
        pattern.dedup();
        let place = own.map(|entry| pattern.binary_search(&entry).unwrap_or(0));
        let starts = (0..=n + 1).map(|column| pattern.partition_point(|entry| entry.0 < column));
        let matrix = Columns {
            starts: starts.collect(),
            rows: pattern.iter().map(|&(_, row)| row).collect(),
            values: vec![0.0; pattern.len()],
        };
        Some(Self {
            place: place.collect(),
            row_scale: vec![1.0; n],
            lu: SparseLu::new(&matrix)?,
            matrix,
        })
    }

    /// Factors the matrix with these values, or, where a pivot vanishes, one within rounding of it;
    /// false where there is none without vanishing pivots.
    pub(crate) fn factor(&mut self, listed: &[(usize, usize, f64)]) -> bool {
        let n = self.row_scale.len();
        let Columns { rows, values, .. } = &mut self.matrix;
        values.fill(0.0);
        for (&(_, _, value), &place) in listed.iter().zip(&self.place) {
            values[place] += value;
        }
        self.row_scale.fill(0.0);
        for (&row, value) in rows.iter().zip(values.iter()) {
            if row < n {
                self.row_scale[row] = self.row_scale[row].max(value.abs());
            }
        }
        for scale in &mut self.row_scale {
            *scale = if *scale > 0.0 { scale.recip() } else { 1.0 };
        }
        for (&row, value) in rows.iter().zip(values) {
            match self.row_scale.get(row) {
                Some(scale) => *value *= scale,
                None => *value = 1.0,
            }
        }
        if self.lu.factor(&self.matrix) {
            return true;
        }
        for (place, value) in self.matrix.values.iter_mut().enumerate() {
            // Pseudorandom numbers, so that no minor of the perturbed matrix vanishes: multiples of
            // the golden ratio, modulo one.
            let share = (place as f64 * 0.618_033_988_749_895).fract();
            *value += f64::EPSILON * (0.5 + share);
        }
        self.lu.factor(&self.matrix)
    }

    /// The vector with J t = 0 and the orientation det \[J; tᵀ\] > 0: the determinant has the sign of
    /// det \[J; eᵀ\] times that of the unknown that is left over.
    pub(crate) fn null_vector(&self, t: &mut [f64]) {
        t.fill(0.0);
        t[self.row_scale.len()] = self.lu.sign();
        self.lu.solve(t);
    }

    /// The vector with J v = r and zero for the unknown that is left over.
    pub(crate) fn particular(&self, r: &[f64], v: &mut [f64]) {
        for ((v, r), scale) in v.iter_mut().zip(r).zip(&self.row_scale) {
            *v = r * scale;
        }
        v[r.len()] = 0.0;
        self.lu.solve(v);
    }
}
