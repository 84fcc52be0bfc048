//! A solution as the guess of a neighbouring problem.

use super::path::Solved;
use super::{BeltProblem, DriveProblem, Law, MAX_STATES};

/// A solution as the guess of a problem with another parameter, of another law (states that the law
/// does not have are left out, those that it adds begin at zero) or with a parameter more.
pub(super) struct Carried<'a, P = DriveProblem>(pub(super) &'a Solved<P>);

impl<P: BeltProblem> bvp::Guess for Carried<'_, P> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let Solved { problem, solution } = self.0;
        let known = solution.segments()[segment].states;
        let mut states = [0.0; MAX_STATES];
        solution.state(segment, s, &mut states[..known]);
        let law = problem.law_states(segment);
        // The states behind those of the law stay the last ones.
        let behind = known - law.end;
        let end = y.len() - behind;
        y[end..].copy_from_slice(&states[law.end..known]);
        if matches!(problem.law(), Law::Bristle { .. }) && end < law.end {
            states[law.start..].fill(0.0);
        }
        states[law.end..].fill(0.0);
        y[..end].copy_from_slice(&states[..end]);
    }

    fn parameters(&self, p: &mut [f64]) {
        let Solved { problem, solution } = self.0;
        let known = solution.parameters();
        let common = known.len().min(p.len());
        p[..common].copy_from_slice(&known[..common]);
        p[common..].fill(problem.behind_lengths(solution));
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        bvp::Guess::mesh(&self.0.solution)
    }
}

/// Two solutions of neighbouring problems with the same states as the guess of the next one at an equal step.
pub(super) struct Extrapolated<'a, P> {
    pub(super) last: &'a Solved<P>,
    pub(super) before: &'a Solved<P>,
}

impl<P: BeltProblem> bvp::Guess for Extrapolated<'_, P> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let mut before = [0.0; MAX_STATES];
        let before = &mut before[..y.len()];
        self.last.solution.state(segment, s, y);
        self.before.solution.state(segment, s, before);
        for (next, before) in y.iter_mut().zip(before) {
            *next += *next - *before;
        }
    }

    fn parameters(&self, p: &mut [f64]) {
        let known = [self.last, self.before].map(|solved| solved.solution.parameters());
        for (next, (last, before)) in p.iter_mut().zip(known[0].iter().zip(known[1])) {
            *next = last + (last - before);
        }
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        bvp::Guess::mesh(&self.last.solution)
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
