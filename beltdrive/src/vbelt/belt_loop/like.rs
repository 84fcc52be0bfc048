//! A loop under the load of a state of it, with any law of friction.

use super::super::carried::Carried;
use super::super::laws::Asked;
use super::super::path::{Effort, Solved};
use super::problem::LoopProblem;
use crate::{Drive, FrictionLaw};

/// A loop whose steady state is asked for near one with another law, and with one zone on every pulley.
pub(super) struct Like<'s> {
    drive: &'s Drive,
    near: &'s Solved<LoopProblem>,
}

impl<'s> Like<'s> {
    pub(super) fn new(drive: &'s Drive, near: &'s Solved<LoopProblem>) -> Self {
        Self { drive, near }
    }
}

impl Asked for Like<'_> {
    type Problem = LoopProblem;

    const FIRST: Effort = Effort::Start;

    fn drive(&self) -> &Drive {
        self.drive
    }

    fn problem(&self, law: FrictionLaw, lag: f64) -> LoopProblem {
        self.near.problem.clone().with_law(self.drive, law, lag)
    }

    fn guess<'p>(&'p self, _: &'p LoopProblem) -> impl bvp::Guess + 'p {
        Carried(self.near)
    }
}
