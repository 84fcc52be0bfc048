//! Prediction of the next point.

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

    /// Predicts the point a step h from z₀ at arclength s₀ with unit tangent t₀: the polynomial
    ///
    /// ```text
    /// z₀ + t₀ h + c₂ h² + c₃ h³        through the points before
    /// ```
    ///
    /// of as high a degree as there are points, by divided differences with s₀ counted twice.
    pub(crate) fn predict(&self, z: &[f64], t: &[f64], arclength: f64, h: f64, to: &mut Vec<f64>) {
        to.clear();
        to.extend(z.iter().zip(t).map(|(z, t)| z + h * t));
        let places: Vec<f64> = self.arclengths.iter().map(|s| s - arclength).collect();
        match places[..] {
            [] => {}
            [a] => {
                // [s₀ s₀ a] = ([s₀ a] − t) / a
                for (i, to) in to.iter_mut().enumerate() {
                    let second = ((self.points[0][i] - z[i]) / a - t[i]) / a;
                    *to += second * h * h;
                }
            }
            [a, b, ..] => {
                for (i, to) in to.iter_mut().enumerate() {
                    let first = (self.points[0][i] - z[i]) / a;
                    let next = (self.points[1][i] - self.points[0][i]) / (b - a);
                    let second = (first - t[i]) / a;
                    let third = ((next - first) / b - second) / b;
                    *to += (second + third * (h - a)) * h * h;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_predicted_exactly() {
        let curve = |s: f64| vec![1.0 + s - 2.0 * s * s + 0.5 * s * s * s];
        let slope = |s: f64| vec![1.0 - 4.0 * s + 1.5 * s * s];
        let mut history = History::default();
        for s in [0.0, 0.3, 0.4] {
            history.push(curve(s), s);
        }
        let mut found = Vec::new();
        history.predict(&curve(0.9), &slope(0.9), 0.9, 0.35, &mut found);
        assert!((found[0] - curve(1.25)[0]).abs() < 1e-13);
    }
}
