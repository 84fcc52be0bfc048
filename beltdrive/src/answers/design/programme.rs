//! The step of a search: what minimises a quadratic model within linear limits and a box.

use super::least_distance::{dot, least_distance};

/// Weight of the proximal term beside gradients of order 1 and steps of order 1. A linear programme is reached in a few
/// repetitions of any weight; with this one the distances of the least-distance problem stay below 1e2, which costs
/// four of sixteen digits.
const PROXIMAL: f64 = 1e-3;

/// Most repetitions, and the change of a step in units of its box below which they end.
const REPETITIONS: usize = 60;
const SETTLED: f64 = 1e-13;

/// A function with its gradient.
#[derive(Clone, Debug)]
pub(super) struct Linear {
    pub(super) value: f64,
    pub(super) gradient: Vec<f64>,
}

impl Linear {
    /// The largest value on a box about the place.
    fn highest(&self, within: &[[f64; 2]]) -> f64 {
        let reach = { self.gradient.iter().zip(within) }
            .map(|(slope, [low, high])| (slope * low).max(slope * high));
        self.value + reach.sum::<f64>()
    }

    /// Its value after a step.
    pub(super) fn after(&self, change: &[f64]) -> f64 {
        self.value + dot(&self.gradient, change)
    }
}

/// Minimises ½ dᵀBd + `max_j (f_j + g_jᵀd)` with `c_i + a_iᵀd ≤ r` and d in a box that contains 0.
pub(super) struct Programme<'p> {
    /// B, positive semidefinite.
    pub(super) curvature: &'p [Vec<f64>],
    /// f and g; at least one.
    pub(super) pieces: &'p [Linear],
    /// c and a.
    pub(super) limits: &'p [Linear],
    /// r.
    pub(super) relaxed: f64,
    /// The lower and the upper end of each component of d.
    pub(super) within: &'p [[f64; 2]],
}

/// A step.
#[derive(Clone, Debug)]
pub(super) struct Step {
    /// d.
    pub(super) change: Vec<f64>,
    /// The multipliers of the pieces, which add up to 1.
    pub(super) pieces: Vec<f64>,
    /// The multipliers of the limits.
    pub(super) limits: Vec<f64>,
}

/// What a row of a programme is.
#[derive(Clone, Copy)]
enum Row {
    Piece(usize),
    Limit(usize),
    End,
}

impl Programme<'_> {
    /// The step; `None` if no step of the box is within the limits.
    pub(super) fn step(&self) -> Option<Step> {
        let size = self.within.len();
        let radius = self.within.iter().flatten().map(|end| end.abs());
        let radius = radius.fold(0.0, f64::max);
        let slopes = self.pieces.iter().flat_map(|piece| &piece.gradient);
        let bent = self.curvature.iter().flatten().map(|part| part * radius);
        let scale = slopes.copied().chain(bent);
        let scale = scale.map(f64::abs).fold(f64::MIN_POSITIVE.sqrt(), f64::max);
        let radius = if radius > 0.0 { radius } else { 1.0 };
        let top = self.pieces.iter().map(|piece| piece.value);
        let top = top.fold(f64::NEG_INFINITY, f64::max);

        // The rows G (p, s) ≥ h with p = d/radius and the level s of the pieces over scale · radius.
        let mut rows: Vec<(Row, Vec<f64>, f64, f64)> = Vec::new();
        let lowest = |piece: &Linear| 2.0 * piece.value - piece.highest(&self.mirrored());
        let floor = self
            .pieces
            .iter()
            .map(lowest)
            .fold(f64::NEG_INFINITY, f64::max);
        for (index, piece) in self.pieces.iter().enumerate() {
            if piece.highest(self.within) < floor {
                continue;
            }
            let mut row: Vec<_> = piece.gradient.iter().map(|slope| -slope / scale).collect();
            row.push(1.0);
            rows.push((
                Row::Piece(index),
                row,
                (piece.value - top) / (scale * radius),
                1.0,
            ));
        }
        for (index, limit) in self.limits.iter().enumerate() {
            if limit.highest(self.within) < self.relaxed {
                continue;
            }
            let norm = dot(&limit.gradient, &limit.gradient).sqrt();
            if norm == 0.0 {
                match limit.value <= self.relaxed {
                    true => continue,
                    false => return None,
                }
            }
            let mut row: Vec<_> = limit.gradient.iter().map(|slope| -slope / norm).collect();
            row.push(0.0);
            let bound = (limit.value - self.relaxed) / (norm * radius);
            rows.push((Row::Limit(index), row, bound, norm));
        }
        for (index, [low, high]) in self.within.iter().enumerate() {
            for (sign, end) in [(1.0, low), (-1.0, high)] {
                let mut row = vec![0.0; size + 1];
                row[index] = sign;
                rows.push((Row::End, row, sign * end / radius, 1.0));
            }
        }
        let (place, multipliers) = self.solve(&rows, radius / scale)?;
        let mut step = Step {
            change: { place[..size].iter().zip(self.within) }
                .map(|(part, [low, high])| (part * radius).clamp(*low, *high))
                .collect(),
            pieces: vec![0.0; self.pieces.len()],
            limits: vec![0.0; self.limits.len()],
        };
        for ((what, _, _, norm), multiplier) in rows.iter().zip(multipliers) {
            match *what {
                Row::Piece(index) => step.pieces[index] = multiplier,
                Row::Limit(index) => step.limits[index] = multiplier * scale / norm,
                Row::End => {}
            }
        }
        Some(step)
    }

    /// The box of the steps against those of the box.
    fn mirrored(&self) -> Vec<[f64; 2]> {
        self.within
            .iter()
            .map(|[low, high]| [-high, -low])
            .collect()
    }

    /// The place (p, s) and the multipliers of its rows: proximal steps, each of which is a least-distance problem in
    /// z = Lᵀ p + L⁻¹ q with H = L Lᵀ.
    fn solve(
        &self,
        rows: &[(Row, Vec<f64>, f64, f64)],
        factor: f64,
    ) -> Option<(Vec<f64>, Vec<f64>)> {
        let size = self.within.len();
        let mut matrix = vec![vec![0.0; size + 1]; size + 1];
        for (row, bent) in self.curvature.iter().enumerate() {
            for (column, part) in bent.iter().enumerate() {
                matrix[row][column] = part * factor;
            }
        }
        for (index, row) in matrix.iter_mut().enumerate() {
            row[index] += PROXIMAL;
        }
        let lower = cholesky(matrix);
        let turned: Vec<_> = rows
            .iter()
            .map(|(_, row, ..)| forward(&lower, row))
            .collect();
        let mut place = vec![0.0; size + 1];
        let mut multipliers = vec![0.0; rows.len()];
        for _ in 0..REPETITIONS {
            let mut slope: Vec<_> = place.iter().map(|part| -PROXIMAL * part).collect();
            slope[size] += 1.0;
            let shift = forward(&lower, &slope);
            let bounds: Vec<_> = { rows.iter().zip(&turned) }
                .map(|((_, _, bound, _), row)| bound + dot(row, &shift))
                .collect();
            let (distance, found) = least_distance(&turned, &bounds)?;
            let right: Vec<_> = distance.iter().zip(&shift).map(|(z, q)| z - q).collect();
            let next = backward(&lower, &right);
            let moved = next.iter().zip(&place).map(|(new, old)| (new - old).abs());
            let moved = moved.fold(0.0, f64::max);
            (place, multipliers) = (next, found);
            if moved <= SETTLED {
                break;
            }
        }
        Some((place, multipliers))
    }
}

/// L with L Lᵀ = H.
fn cholesky(mut matrix: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let size = matrix.len();
    for column in 0..size {
        for row in column..size {
            let known = dot(&matrix[row][..column], &matrix[column][..column]);
            let part = matrix[row][column] - known;
            matrix[row][column] = match row == column {
                // Below the proximal term only by rounding.
                true => part.max(PROXIMAL * 1e-6).sqrt(),
                false => part / matrix[column][column],
            };
        }
    }
    matrix
}

/// L⁻¹ x.
fn forward(lower: &[Vec<f64>], right: &[f64]) -> Vec<f64> {
    let mut found = Vec::with_capacity(right.len());
    for (row, part) in lower.iter().zip(right) {
        let index = found.len();
        found.push((part - dot(&row[..index], &found)) / row[index]);
    }
    found
}

/// L⁻ᵀ x.
fn backward(lower: &[Vec<f64>], right: &[f64]) -> Vec<f64> {
    let mut found = right.to_vec();
    for index in (0..right.len()).rev() {
        let known: f64 = (index + 1..right.len())
            .map(|row| lower[row][index] * found[row])
            .sum();
        found[index] = (found[index] - known) / lower[index][index];
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn linear(value: f64, gradient: [f64; 2]) -> Linear {
        Linear {
            value,
            gradient: gradient.to_vec(),
        }
    }

    #[test]
    fn a_linear_programme_ends_in_its_corner_with_its_multipliers() {
        // min −x − 2 y with x + y ≤ 1, x and y in [−1, 1]: (0, 1) with multipliers 1 and 1.
        let step = Programme {
            curvature: &[vec![0.0; 2], vec![0.0; 2]],
            pieces: &[linear(5.0, [-1.0, -2.0])],
            limits: &[linear(-1.0, [1.0, 1.0]), linear(-9.0, [1.0, 0.0])],
            relaxed: 0.0,
            within: &[[-1.0, 1.0]; 2],
        }
        .step()
        .unwrap();
        assert!(step.change[0].abs() < 1e-10, "{step:?}");
        assert!((step.change[1] - 1.0).abs() < 1e-10, "{step:?}");
        assert!(
            (step.limits[0] - 1.0).abs() < 1e-10 && step.limits[1] == 0.0,
            "{step:?}"
        );
    }

    #[test]
    fn the_least_of_the_largest_of_two_pieces() {
        // max(x, −2 x + 3) is least at 1, with weights 2/3 and 1/3.
        let step = Programme {
            curvature: &[vec![0.0; 2], vec![0.0; 2]],
            pieces: &[linear(0.0, [1.0, 0.0]), linear(3.0, [-2.0, 0.0])],
            limits: &[],
            relaxed: 0.0,
            within: &[[-4.0, 4.0], [-4.0, 4.0]],
        }
        .step()
        .unwrap();
        assert!((step.change[0] - 1.0).abs() < 1e-11, "{step:?}");
        assert!((step.pieces[0] - 2.0 / 3.0).abs() < 1e-10);
    }

    #[test]
    fn a_quadratic_programme_on_a_limit() {
        // min x² + y² − 2 x − 4 y with x + y ≤ 1: (0, 1) with multiplier 2.
        let step = Programme {
            curvature: &[vec![2.0, 0.0], vec![0.0, 2.0]],
            pieces: &[linear(0.0, [-2.0, -4.0])],
            limits: &[linear(-1.0, [1.0, 1.0])],
            relaxed: 0.0,
            within: &[[-3.0, 3.0]; 2],
        }
        .step()
        .unwrap();
        assert!(step.change[0].abs() < 1e-10 && (step.change[1] - 1.0).abs() < 1e-10);
        assert!((step.limits[0] - 2.0).abs() < 1e-9, "{step:?}");
    }

    #[test]
    fn limits_that_no_step_reaches_have_none() {
        let step = Programme {
            curvature: &[vec![0.0; 2], vec![0.0; 2]],
            pieces: &[linear(0.0, [1.0, 0.0])],
            limits: &[linear(3.0, [1.0, 0.0])],
            relaxed: 0.0,
            within: &[[-1.0, 1.0]; 2],
        };
        assert!(step.step().is_none());
    }
}
