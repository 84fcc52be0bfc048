//! A loop under a share of its load, before it is solved.

use super::super::Units;
use super::super::laws::Asked;
use super::super::path::Effort;
use super::guess::LoopGuess;
use super::problem::LoopProblem;
use super::round::Target;
use crate::FrictionLaw;
use crate::drive::belt_loop::BeltLoop;
use crate::drive::layout::Layout;

/// A loop under a share of its load.
pub(super) struct Start<'l> {
    pub(super) belt_loop: &'l BeltLoop,
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

    fn law(&self) -> FrictionLaw {
        self.belt_loop.law
    }

    fn largest_curvature(&self) -> f64 {
        let pulleys = self.belt_loop.pulleys.iter();
        let curvatures = pulleys.map(|pulley| pulley.friction_coefficient / pulley.radius);
        curvatures.fold(0.0, f64::max)
    }

    fn problem(&self, law: FrictionLaw, lag: f64) -> LoopProblem {
        let belt_loop = self.belt_loop;
        let force = self.tractive.iter().copied().fold(0.0, f64::max);
        let units = Units::new(&belt_loop.belt, belt_loop.rim_speed(), force);
        LoopProblem::new(belt_loop, &self.layout, units, self.target, law, lag)
            .with_factor(self.factor)
    }

    fn guess<'p>(&self, problem: &'p LoopProblem) -> impl bvp::Guess + 'p {
        LoopGuess::new(problem, &self.tractive, self.coordinate)
    }
}
