//! Small quadratic programmes by least distances: C. L. Lawson and R. J. Hanson, Solving Least Squares Problems (1974),
//! chapter 23, with nonnegative least squares.

use faer::Mat;
use faer::linalg::solvers::SolveLstsq;

/// Multipliers and gradients below this are rounding: the data are of order one, and a solution of some ten rows is
/// known to about 1e-15.
const ROUNDING: f64 = 1e-12;

/// Changes of the passive set of nonnegative least squares for each of its columns, beyond which it turns in a circle:
/// Lawson and Hanson count half as many.
const CHANGES: usize = 6;

/// The shortest x with G x ≥ h and the multipliers λ ≥ 0 of its rows, x = Gᵀ λ; `None` if no x has G x ≥ h.
pub(super) fn least_distance(g: &[Vec<f64>], h: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
    let size = g.first().map_or(0, Vec::len);
    let columns: Vec<Vec<f64>> = { g.iter().zip(h) }
        .map(|(row, bound)| row.iter().copied().chain([*bound]).collect())
        .collect();
    let mut target = vec![0.0; size];
    target.push(1.0);
    let weights = nonnegative(&columns, &target);
    let residual = residual(&columns, &weights, &target);
    let last = residual[size];
    // Without a solution h is a nonnegative combination that cancels all rows of G, and nothing is left.
    if last < ROUNDING {
        return None;
    }
    let x = residual[..size].iter().map(|part| -part / last).collect();
    let multipliers = weights.iter().map(|weight| weight / last).collect();
    Some((x, multipliers))
}

/// The weights, none of them negative, with which the columns add up to the target best, in least squares.
fn nonnegative(columns: &[Vec<f64>], target: &[f64]) -> Vec<f64> {
    let count = columns.len();
    let mut weights = vec![0.0; count];
    let mut passive = vec![false; count];
    for _ in 0..CHANGES * count {
        let left = residual(columns, &weights, target);
        let gradient = |index: usize| {
            let norm = dot(&columns[index], &columns[index]).sqrt().max(1.0);
            dot(&columns[index], &left) / norm
        };
        let best = (0..count)
            .filter(|&index| !passive[index])
            .max_by(|&one, &other| gradient(one).total_cmp(&gradient(other)));
        let Some(entering) = best.filter(|&index| gradient(index) > ROUNDING) else {
            break;
        };
        passive[entering] = true;
        let mut is_first = true;
        loop {
            let found = least_squares(columns, &passive, target);
            // A column that depends on those of the passive set cannot enter it.
            if is_first && found[entering] <= 0.0 {
                passive[entering] = false;
                return weights;
            }
            is_first = false;
            let leaving = (0..count).filter(|&index| passive[index] && found[index] <= 0.0);
            let share = leaving
                .map(|index| weights[index] / (weights[index] - found[index]))
                .fold(1.0, f64::min);
            for index in 0..count {
                weights[index] += share * (found[index] - weights[index]);
            }
            if share >= 1.0 {
                break;
            }
            for index in 0..count {
                if passive[index] && (found[index] <= 0.0 && weights[index] <= ROUNDING) {
                    passive[index] = false;
                    weights[index] = 0.0;
                }
            }
        }
    }
    weights
}

/// The target less the columns with their weights.
fn residual(columns: &[Vec<f64>], weights: &[f64], target: &[f64]) -> Vec<f64> {
    let mut left = target.to_vec();
    for (column, weight) in columns.iter().zip(weights) {
        for (left, part) in left.iter_mut().zip(column) {
            *left -= weight * part;
        }
    }
    left
}

/// The weights of the passive columns that fit the target best; 0 for the others.
fn least_squares(columns: &[Vec<f64>], passive: &[bool], target: &[f64]) -> Vec<f64> {
    let used: Vec<_> = (0..columns.len()).filter(|&index| passive[index]).collect();
    let mut weights = vec![0.0; columns.len()];
    if used.len() > target.len() {
        return weights;
    }
    let matrix = Mat::from_fn(target.len(), used.len(), |row, column| {
        columns[used[column]][row]
    });
    let right = Mat::from_fn(target.len(), 1, |row, _| target[row]);
    let found = matrix.col_piv_qr().solve_lstsq(&right);
    for (place, index) in used.into_iter().enumerate() {
        weights[index] = found[(place, 0)];
    }
    weights
}

pub(super) fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_point_of_a_half_plane_and_of_a_corner() {
        // x + y ≥ 2.
        let (x, multipliers) = least_distance(&[vec![1.0, 1.0]], &[2.0]).unwrap();
        assert!((x[0] - 1.0).abs() < 1e-14 && (x[1] - 1.0).abs() < 1e-14);
        assert!((multipliers[0] - 1.0).abs() < 1e-14);
        // x ≥ 3, y ≥ −1: the second does not bind.
        let rows = [vec![1.0, 0.0], vec![0.0, 1.0]];
        let (x, multipliers) = least_distance(&rows, &[3.0, -1.0]).unwrap();
        assert!((x[0] - 3.0).abs() < 1e-13 && x[1].abs() < 1e-13, "{x:?}");
        assert!((multipliers[0] - 3.0).abs() < 1e-13 && multipliers[1] == 0.0);
        // The same row twice: the multipliers share it.
        let rows = [vec![1.0, 0.0], vec![1.0, 0.0]];
        let (x, multipliers) = least_distance(&rows, &[3.0, 3.0]).unwrap();
        assert!((x[0] - 3.0).abs() < 1e-13);
        assert!((multipliers.iter().sum::<f64>() - 3.0).abs() < 1e-13);
    }

    #[test]
    fn contradictions_have_no_point() {
        let rows = [vec![1.0, 0.0], vec![-1.0, 0.0]];
        assert!(least_distance(&rows, &[1.0, 0.0]).is_none());
    }
}
