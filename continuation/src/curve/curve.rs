//! The curve of solutions of a system, and the way back to it.

use crate::curve::corrector::{Accuracy, Condition, Correction, Corrector};
use crate::curve::metric::Metric;
use crate::difficulty::Difficulty;
use crate::system::system::System;

/// Points are corrected to this share of the tolerance of the system, so that what is left of the
/// corrections is no defect: with the accuracy 1e-9 and the tolerance 1e-10 the mesh of a boundary value problem
/// grew to 240 000 unknowns, where 341 do.
const SHARE_OF_TOLERANCE: f64 = 0.01;

/// The curve G(z) = 0 of a system within bounds of λ, measured by a metric.
pub(crate) struct Curve<'a, S> {
    pub(crate) system: &'a mut S,
    pub(crate) metric: Metric,
    pub(crate) corrector: Corrector,
    /// Points between two others are located to this length; 0 stands for down to rounding.
    pub(crate) location: f64,
    /// Whether branch points are looked for.
    pub(crate) branch_points: bool,
    /// The bordering vector b of the test function for branch points.
    pub(crate) border: Vec<f64>,
    /// Another bordering vector, whose second vector turns at branch points that b overlooks: those at which it
    /// is nearly in the range of J.
    pub(crate) witness: Vec<f64>,
}

impl<'a, S: System> Curve<'a, S> {
    pub(crate) fn new(system: &'a mut S, metric: Metric, bounds: [f64; 2]) -> Self {
        Self {
            system,
            metric,
            corrector: Corrector::within(bounds),
            location: 0.0,
            branch_points: true,
            border: Vec::new(),
            witness: Vec::new(),
        }
    }

    /// Corrects `z` onto the curve and a condition by at most `limit` corrections.
    pub(crate) fn correct(
        &mut self,
        z: &mut [f64],
        condition: &Condition,
        accuracy: Accuracy,
        limit: usize,
    ) -> Result<Correction, Difficulty> {
        let (metric, goal) = (&self.metric, (accuracy, limit));
        self.corrector
            .correct(self.system, metric, z, condition, goal, false)
    }

    /// Locates a point by the last linearisation as long as that does: it was made at a place nearby.
    pub(crate) fn locate_nearby(
        &mut self,
        z: &mut [f64],
        condition: &Condition,
        limit: usize,
    ) -> Result<Correction, Difficulty> {
        let (metric, goal) = (&self.metric, (self.located(), limit));
        self.corrector
            .correct(self.system, metric, z, condition, goal, true)
    }

    /// How accurately points between two others are located.
    pub(crate) fn located(&self) -> Accuracy {
        match self.location {
            0.0 => Accuracy::Rounding,
            length => Accuracy::Length(length),
        }
    }

    /// The distances from a solution `z` of the place this `way` ahead, in the plane across `normal`, after one
    /// correction with the last linearisation and after two. The first takes away what is linear; where it leads near
    /// enough, the second distance is zero.
    pub(crate) fn approach(
        &mut self,
        z: &[f64],
        way: &[f64],
        normal: &[f64],
        is_near: impl Fn(f64) -> bool,
    ) -> Result<[f64; 2], Difficulty> {
        let (metric, corrector) = (&self.metric, &mut self.corrector);
        let n = z.len() - 1;
        let [low, high] = corrector.bounds();
        // Beyond the bounds of λ, on the other side.
        let inside = (low..=high).contains(&(z[n] + way[n]));
        let sign = if inside { 1.0 } else { -1.0 };
        let mut end: Vec<f64> = z.iter().zip(way).map(|(z, w)| z + sign * w).collect();
        let plane = Condition::plane(metric, normal, z);
        let mut distances = [0.0; 2];
        for distance in &mut distances {
            let back = corrector.chord(self.system, metric, &plane, &end)?;
            end.iter_mut().zip(back).for_each(|(e, b)| *e += b);
            *distance = metric.distance(&end, z);
            if is_near(*distance) {
                break;
            }
        }
        Ok(distances)
    }

    /// Linearises the system at `z` and returns the unit tangent as the system orients it.
    pub(crate) fn tangent(&mut self, z: &[f64]) -> Result<Vec<f64>, Difficulty> {
        self.corrector.tangent(self.system, &self.metric, z)
    }

    /// The accuracy of regular points: the one `wanted`, or finer where the tolerance of the system is.
    pub(crate) fn accuracy(&self, wanted: f64) -> f64 {
        wanted.min(SHARE_OF_TOLERANCE * self.system.tolerance())
    }

    /// The rate of λ along a unit tangent, with the range of λ as unit.
    pub(crate) fn rate(&self, tangent: &[f64]) -> f64 {
        tangent[tangent.len() - 1] / self.metric.range()
    }
}

/// The place this far along a direction.
pub(crate) fn ahead(z: &[f64], direction: &[f64], way: f64) -> Vec<f64> {
    z.iter().zip(direction).map(|(z, d)| z + way * d).collect()
}

/// Turns a tangent round.
pub(crate) fn reverse(tangent: &mut [f64]) {
    tangent.iter_mut().for_each(|t| *t = -*t);
}
