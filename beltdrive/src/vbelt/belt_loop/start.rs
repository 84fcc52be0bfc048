//! A loop under a share of its load, before it is solved.

use super::super::Units;
use super::super::laws::Asked;
use super::super::path::Effort;
use super::guess::LoopGuess;
use super::problem::LoopProblem;
use super::round::Target;
use crate::drive::layout::Layout;
use crate::{Drive, FrictionLaw};

/// A loop under a share of its load.
#[derive(Clone)]
pub(super) struct Start<'l> {
    pub(super) drive: &'l Drive,
    pub(super) layout: Layout,
    pub(super) target: Target,
    /// Tractive tensions of the spans without creep, N.
    pub(super) tractive: Vec<f64>,
    /// Coordinate of the tensioner, rad or m.
    pub(super) coordinate: f64,
    /// The share of the load.
    pub(super) factor: f64,
}

impl Start<'_> {
    /// Whether the belt pulls in all spans.
    pub(super) fn is_taut(&self) -> bool {
        self.tractive.iter().all(|&tension| tension > 0.0)
    }
}

impl Asked for Start<'_> {
    type Problem = LoopProblem;

    /// A coarse mesh takes two thirds of the time of a mesh that could be the final one.
    const FIRST: Effort = Effort::Start;

    fn drive(&self) -> &Drive {
        self.drive
    }

    fn problem(&self, law: FrictionLaw, lag: f64) -> LoopProblem {
        let drive = self.drive;
        let force = self.tractive.iter().copied().fold(0.0, f64::max);
        let units = Units::new(&drive.belt, drive.rim_speed(), force);
        LoopProblem::new(drive, &self.layout, units, self.target, law, lag).with_factor(self.factor)
    }

    fn guess<'p>(&'p self, problem: &'p LoopProblem) -> impl bvp::Guess + 'p {
        LoopGuess::new(problem, &self.tractive, self.coordinate)
    }
}
