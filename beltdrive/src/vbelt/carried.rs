//! A solution as the guess of a neighbouring problem.

use super::path::Solved;
use super::{DRIVER, LAW, Law, MAX_STATES};

/// A solution as the guess of a problem with another parameter, of another law (states that the law
/// does not have are left out, those that it adds begin at zero) or with the tight tension unknown.
pub(super) struct Carried<'a>(pub(super) &'a Solved);

impl bvp::Guess for Carried<'_> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let solution = &self.0.solution;
        let known = solution.segments()[segment].states;
        let mut states = [0.0; MAX_STATES];
        solution.state(segment, s, &mut states[..known]);
        let is_bristle = matches!(self.0.problem.groove(DRIVER).law, Law::Bristle { .. });
        if is_bristle && y.len() < known {
            states[LAW..].fill(0.0);
        }
        y.copy_from_slice(&states[..y.len()]);
    }

    fn parameters(&self, p: &mut [f64]) {
        let known = self.0.solution.parameters();
        let common = known.len().min(p.len());
        p[..common].copy_from_slice(&known[..common]);
        p[common..].fill(self.0.tight_tension());
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        bvp::Guess::mesh(&self.0.solution)
    }
}

/// A solution as the guess for the member of a family with these values of its entries.
pub(super) struct Member<'a> {
    pub(super) solution: Carried<'a>,
    pub(super) values: &'a [f64],
}

impl bvp::Guess for Member<'_> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        self.solution.state(segment, s, y);
    }

    fn parameters(&self, p: &mut [f64]) {
        let (constants, entries) = p.split_at_mut(p.len() - self.values.len());
        self.solution.parameters(constants);
        entries.copy_from_slice(self.values);
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        self.solution.mesh()
    }
}
