//! The states of a loop under a rising load, as a curve whose points are only good enough on the way.

use bvp::{Family, Solution};
use continuation::{Cause, System};

/// A discretised family of states. Its mesh follows the solution, but its labelled points are not refined until their
/// error is below the tolerance: they are guesses of states to come, and where friction has kinks halving the mesh
/// changes the derivatives beside these by 1e-4 however fine it is, so that a branch ended where it began.
#[derive(Clone)]
pub(super) struct Rising<'a>(pub(super) Family<'a>);

impl Rising<'_> {
    /// The state at a point.
    pub(super) fn solution(&self, z: &[f64]) -> Solution {
        self.0.solution(z)
    }
}

impl System for Rising<'_> {
    fn unknowns(&self) -> usize {
        System::unknowns(&self.0)
    }

    fn residual(&mut self, z: &[f64], g: &mut [f64]) {
        System::residual(&mut self.0, z, g);
    }

    fn linearise(&mut self, z: &[f64]) -> Result<(), Cause> {
        System::linearise(&mut self.0, z)
    }

    fn particular(&mut self, r: &[f64], v: &mut [f64]) {
        System::particular(&mut self.0, r, v);
    }

    fn null_vector(&mut self, t: &mut [f64]) {
        System::null_vector(&mut self.0, t);
    }

    fn groups(&self, group: &mut [usize], share: &mut [f64]) {
        System::groups(&self.0, group, share);
    }

    fn adapted(&mut self, vectors: &mut [Vec<f64>]) -> Result<Option<Self>, Cause> {
        Ok(System::adapted(&mut self.0, vectors)?.map(Self))
    }

    fn tolerance(&self) -> f64 {
        System::tolerance(&self.0)
    }
}
