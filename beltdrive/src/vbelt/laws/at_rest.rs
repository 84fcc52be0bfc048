//! A belt that comes to rest before elastic friction has grown to its limit.
//!
//! Bristles do not show that where it comes to rest just in front of that place. Sliding friction then goes on in the direction
//! in which the belt sank, and pulls with a slip that is hardly there. The belt sticks from there on, up to where it was found to
//! break away.

use super::sliding::RESOLVED_LAG_WITH_STICK;
use crate::vbelt::BeltProblem;
use crate::vbelt::path::{Effort, Path, Solved};
use crate::vbelt::zones::Cut;

impl Path<'_> {
    /// A state of elastic friction that pulls with the slip with a belt that sticks there, if it is found: roughly.
    pub(in crate::vbelt) fn come_to_rest<P: BeltProblem>(
        &mut self,
        pulled: &Solved<P>,
    ) -> Option<Solved<P>> {
        let cut = Cut::with_belt_at_rest(pulled)?;
        let problem = cut.apply(pulled.problem.clone());
        let problem = problem.with_smoothing(RESOLVED_LAG_WITH_STICK);
        let resting = self.attempt(problem, &cut, Effort::Rough).ok()?;
        self.split_zones(resting, Effort::Rough).ok()
    }
}
