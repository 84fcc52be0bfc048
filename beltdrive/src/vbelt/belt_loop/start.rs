//! A loop under a share of its load, before it is solved.

use super::super::Units;
use super::super::laws::Asked;
use super::super::path::{Effort, Path, Solved};
use super::guess::{LoopGuess, tractive_tensions};
use super::pair::in_any_way;
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
    /// Tension of the belt at rest where the closure is one of it, N.
    rest: Option<f64>,
    /// Coordinate of the tensioner, rad or m.
    coordinate: f64,
    /// The share of the load.
    pub(super) factor: f64,
    /// Tractive tensions of the spans without creep, N.
    tractive: Vec<f64>,
}

impl<'l> Start<'l> {
    /// Of a loop under its load, laid out for the tensioner at a coordinate, with the tension
    /// of the belt at rest where the closure is one of it, N.
    pub(super) fn new(
        drive: &'l Drive,
        layout: Layout,
        target: Target,
        rest: Option<f64>,
        coordinate: f64,
    ) -> Self {
        let start = Self {
            drive,
            layout,
            target,
            rest,
            coordinate,
            factor: 1.0,
            tractive: Vec::new(),
        };
        start.under(1.0)
    }

    /// The same loop under a share of its load.
    pub(super) fn under(&self, factor: f64) -> Self {
        let Self { drive, target, .. } = *self;
        Self {
            tractive: tractive_tensions(drive, &self.layout, target, self.rest, factor),
            factor,
            ..self.clone()
        }
    }

    /// A drive in the place of another one that differs in its law or its loads, under its load.
    pub(super) fn of<'d>(&self, drive: &'d Drive) -> Start<'d> {
        let Self {
            target,
            rest,
            coordinate,
            ..
        } = *self;
        Start::new(drive, self.layout.clone(), target, rest, coordinate)
    }

    /// The factor on the load with which the first span would be without tension, if there is one.
    pub(super) fn slackened(&self) -> Option<f64> {
        let [idle, loaded] = [0.0, 1.0].map(|factor| self.under(factor).tractive);
        let spans = idle.iter().zip(&loaded);
        let falling = spans.filter(|(idle, loaded)| loaded < idle);
        let factors = falling.map(|(idle, loaded)| idle / (idle - loaded));
        factors.reduce(f64::min)
    }

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

    fn locked(
        &self,
        path: &mut Path<'_>,
        bristles: &Solved<LoopProblem>,
    ) -> Option<Solved<LoopProblem>> {
        path.by_locked_pair(self, bristles)
    }

    fn beside(
        &self,
        path: &mut Path<'_>,
        bristles: &Solved<LoopProblem>,
    ) -> Option<Solved<LoopProblem>> {
        path.by_pair(self, bristles, in_any_way)
    }
}
