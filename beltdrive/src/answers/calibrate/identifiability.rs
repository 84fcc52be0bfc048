//! What the derivatives at a solution say of the free numbers: how well they are determined, and what cannot be told
//! apart.

use super::least_squares::{Derivatives, Fit};
use crate::input::FileKey;

/// Numbers with a larger correlation are reported: the interval of each is more than 3.2 = (1 − 0.95²)^(−1/2) times
/// as wide as if the other were known.
const CORRELATED: f64 = 0.95;

/// Parts of a combination below this share of the largest are not named.
const NAMED: f64 = 0.1;

/// Coordinates with a larger standard error are open. A positive number whose best value is zero is followed down to where
/// no reading depends on it any more: on a flat belt that of the logarithm of its mass was then 1e9 to 1e12.
const OPEN: f64 = 1e6;

/// By how much the first number of a combination is changed where its effect is told.
const CHANGE: f64 = 0.1;

/// Numbers that the rows cannot tell apart, or one that they say nothing of.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Ambiguity {
    /// The numbers, each with its relative change where the first is raised by 10 %.
    pub combination: Vec<(String, f64)>,
    /// By how many standard deviations this changes all readings together, the root of the sum of squares; `None` if
    /// no standard deviation is known.
    pub effect: Option<f64>,
    /// The correlation of the two numbers; `None` if the rows leave the combination open.
    pub correlation: Option<f64>,
}

/// The singular values and vectors of the derivatives.
pub(super) struct Spectrum<'f> {
    derivatives: &'f Derivatives,
    /// The scatter in units of that of the derivatives, if it is known.
    scale: Option<f64>,
}

impl<'f> Spectrum<'f> {
    pub(super) fn new(fit: &'f Fit, scale: Option<f64>) -> Self {
        Self {
            derivatives: &fit.derivatives,
            scale,
        }
    }

    pub(super) fn singular_values(&self) -> Vec<f64> {
        self.derivatives.values.clone()
    }

    /// Whether a singular value is none but for the errors of the derivatives, or next to the scatter.
    fn is_open(&self, index: usize) -> bool {
        let Derivatives { values, error, .. } = self.derivatives;
        let largest = values.first().copied().unwrap_or_default();
        // The errors of several columns add up.
        values[index] <= 10.0 * error * largest
            || self.scale.is_some_and(|scale| scale > OPEN * values[index])
    }

    /// (JᵀJ)⁻¹ without the open directions, and of each number whether it takes part in one.
    fn covariance(&self) -> (Vec<Vec<f64>>, Vec<bool>) {
        let count = self.derivatives.right.len();
        let mut covariance = vec![vec![0.0; count]; count];
        let mut is_part = vec![false; count];
        for (index, vector) in self.derivatives.right.iter().enumerate() {
            if self.is_open(index) {
                let largest = vector
                    .iter()
                    .fold(0.0, |most: f64, part| most.max(part.abs()));
                for (is_part, part) in is_part.iter_mut().zip(vector) {
                    *is_part |= part.abs() > NAMED * largest;
                }
                continue;
            }
            let value = self.derivatives.values[index];
            for row in 0..count {
                for column in 0..count {
                    covariance[row][column] += vector[row] * vector[column] / (value * value);
                }
            }
        }
        (covariance, is_part)
    }

    /// Standard errors of the coordinates in units of the scatter; `None` for those that are open.
    pub(super) fn relative_errors(&self) -> Vec<Option<f64>> {
        let (covariance, is_open) = self.covariance();
        let errors = covariance.iter().enumerate().zip(is_open);
        let errors = errors.map(|((index, row), is_open)| (!is_open).then(|| row[index].sqrt()));
        errors.collect()
    }

    /// The correlations; `None` if a direction is open.
    pub(super) fn correlation(&self) -> Option<Vec<Vec<f64>>> {
        let (covariance, is_open) = self.covariance();
        if is_open.contains(&true) {
            return None;
        }
        let roots: Vec<_> = covariance
            .iter()
            .enumerate()
            .map(|(index, row)| row[index].sqrt())
            .collect();
        let correlation = covariance.iter().zip(&roots).map(|(row, root)| {
            let row = row.iter().zip(&roots);
            row.map(|(value, other)| value / (root * other)).collect()
        });
        Some(correlation.collect())
    }

    /// What the rows cannot tell apart.
    pub(super) fn ambiguities(&self, keys: &[FileKey]) -> Vec<Ambiguity> {
        let open = (0..self.derivatives.right.len()).filter(|&index| self.is_open(index));
        let open =
            open.map(|index| self.ambiguity(&self.derivatives.right[index], keys, Some(0.0), None));
        let open: Vec<_> = open.collect();
        match self.correlation() {
            None => open,
            Some(correlation) => {
                let mut pairs = Vec::new();
                for (one, row) in correlation.iter().enumerate() {
                    for (other, &value) in row.iter().enumerate().skip(one + 1) {
                        if value.abs() > CORRELATED {
                            pairs.push((one, other, value));
                        }
                    }
                }
                pairs
                    .into_iter()
                    .map(|(one, other, value)| self.pair(one, other, value, keys))
                    .collect()
            }
        }
    }

    /// Two numbers with a correlation: in the direction in which they vary together.
    fn pair(&self, one: usize, other: usize, correlation: f64, keys: &[FileKey]) -> Ambiguity {
        let (covariance, _) = self.covariance();
        let ratio = (covariance[other][other] / covariance[one][one]).sqrt();
        let mut direction = vec![0.0; keys.len()];
        direction[one] = 1.0;
        direction[other] = correlation.signum() * ratio;
        // |J d|, by the singular values.
        let Derivatives { right, values, .. } = self.derivatives;
        let parts = right.iter().zip(values).map(|(vector, value)| {
            let along: f64 = vector.iter().zip(&direction).map(|(a, b)| a * b).sum();
            (along * value).powi(2)
        });
        let change = parts.sum::<f64>().sqrt();
        let largest = direction[one].abs();
        let effect = self.scale.map(|scale| CHANGE / largest * change / scale);
        self.ambiguity(&direction, keys, effect, Some(correlation))
    }

    /// The combination along a direction.
    fn ambiguity(
        &self,
        direction: &[f64],
        keys: &[FileKey],
        effect: Option<f64>,
        correlation: Option<f64>,
    ) -> Ambiguity {
        let largest = direction
            .iter()
            .fold(0.0, |most: f64, part| most.max(part.abs()));
        let named = keys.iter().zip(direction);
        let named: Vec<_> = named
            .filter(|(_, part)| part.abs() > NAMED * largest)
            .collect();
        let first = named.first().map_or(1.0, |(_, part)| **part);
        let combination = named.into_iter().map(|(key, part)| {
            // Of logarithms.
            (
                key.path().to_owned(),
                (1.0 + CHANGE).powf(part / first) - 1.0,
            )
        });
        Ambiguity {
            combination: combination.collect(),
            effect,
            correlation,
        }
    }
}
