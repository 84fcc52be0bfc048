//! Prediction of the next point.

use crate::curve::curve::ahead;

/// The number of earlier points that the prediction uses.
const MEMORY: usize = 2;

/// The last points of a branch with their arclengths, newest first.
#[derive(Clone, Debug, Default)]
pub(crate) struct History {
    pub(crate) points: Vec<Vec<f64>>,
    pub(crate) arclengths: Vec<f64>,
}

impl History {
    /// Takes in a point that has been left.
    pub(crate) fn push(&mut self, z: Vec<f64>, arclength: f64) {
        self.points.insert(0, z);
        self.arclengths.insert(0, arclength);
        self.points.truncate(MEMORY);
        self.arclengths.truncate(MEMORY);
    }

    /// Predicts the point a step h from z₀ at arclength s₀ with unit tangent t₀, and its derivative with
    /// respect to h: the polynomial
    ///
    /// ```text
    /// z₀ + t₀ h + c₂ h² + c₃ h³        through the points before
    /// ```
    ///
    /// of as high a degree as there are points, by divided differences with s₀ counted twice.
    pub(crate) fn predict(
        &self,
        z: &[f64],
        t: &[f64],
        arclength: f64,
        h: f64,
    ) -> (Vec<f64>, Vec<f64>) {
        let mut to = ahead(z, t, h);
        let mut rate = t.to_vec();
        let places: Vec<f64> = self.arclengths.iter().map(|s| s - arclength).collect();
        match places[..] {
            [] => {}
            [a] => {
                // [s₀ s₀ a] = ([s₀ a] − t) / a
                for (i, (to, rate)) in to.iter_mut().zip(&mut rate).enumerate() {
                    let second = ((self.points[0][i] - z[i]) / a - t[i]) / a;
                    *to += second * h * h;
                    *rate += 2.0 * second * h;
                }
            }
            [a, b, ..] => {
                for (i, (to, rate)) in to.iter_mut().zip(&mut rate).enumerate() {
                    let first = (self.points[0][i] - z[i]) / a;
                    let next = (self.points[1][i] - self.points[0][i]) / (b - a);
                    let second = (first - t[i]) / a;
                    let third = ((next - first) / b - second) / b;
                    *to += (second + third * (h - a)) * h * h;
                    *rate += (2.0 * second + third * (3.0 * h - 2.0 * a)) * h;
                }
            }
        }
        (to, rate)
    }

    /// The relative rate at which the error of the prediction grows at h: it is proportional to
    /// h² (h − a) (h − b), with the points before at a and b.
    pub(crate) fn growth_of_error(&self, arclength: f64, h: f64) -> f64 {
        let before = self.arclengths.iter();
        let others: f64 = before.map(|s| (h - (s - arclength)).recip()).sum();
        2.0 / h + others
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_in_direction_tells_of_that_in_place() {
        let mut history = History::default();
        for s in [-0.4, -0.3] {
            history.push(vec![f64::powi(s, 4)], s);
        }
        // Of the prediction of s⁴ from s = 0.
        let (place, rate) = history.predict(&[0.0], &[0.0], 0.0, 0.2);
        let error = [0.2f64.powi(4) - place[0], 4.0 * 0.2f64.powi(3) - rate[0]];
        let growth = history.growth_of_error(0.0, 0.2);
        assert!((error[1] / growth - error[0]).abs() < 1e-15);
    }

    #[test]
    fn a_cubic_is_predicted_exactly() {
        let curve = |s: f64| vec![1.0 + s - 2.0 * s * s + 0.5 * s * s * s];
        let slope = |s: f64| vec![1.0 - 4.0 * s + 1.5 * s * s];
        let mut history = History::default();
        for s in [0.0, 0.3, 0.4] {
            history.push(curve(s), s);
        }
        let (found, rate) = history.predict(&curve(0.9), &slope(0.9), 0.9, 0.35);
        assert!((found[0] - curve(1.25)[0]).abs() < 1e-13);
        assert!((rate[0] - slope(1.25)[0]).abs() < 1e-12);
    }
}
