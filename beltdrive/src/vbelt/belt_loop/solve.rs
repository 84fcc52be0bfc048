//! From a loop to its steady state: rest, then the running loop, cold or by raising the load.

use super::super::path::Effort;
use super::at_rest::rest_near;
use super::problem::{LoopProblem, Target};
use super::rest::{Cost, Known, Rest, RestProblem};
use super::running::{Running, running};
use super::state::state;
use crate::drive::belt_loop::{BeltLoop, Closure};
use crate::mechanics::tensioner::within_travel;
use crate::results::difficulty;
use crate::results::loop_error::LoopError;
use crate::results::loop_state::LoopState;
use bvp::{Ends, Problem, Solution};

/// A problem and its solution.
#[derive(Clone, Debug)]
pub(super) struct Solved {
    pub(super) problem: LoopProblem,
    pub(super) solution: Solution,
}

impl Solved {
    /// Calls `view` with the states at both ends of all segments, and the parameters.
    pub(super) fn with_ends<R>(&self, view: impl FnOnce(&Ends<'_, f64>, &[f64]) -> R) -> R {
        let segments = self.problem.segments();
        let values =
            (0..segments.len()).flat_map(|i| [self.solution.start(i), self.solution.end(i)]);
        let values: Vec<f64> = values.flatten().copied().collect();
        view(&Ends::new(&segments, &values), self.solution.parameters())
    }
}

/// The search for one steady state.
pub(super) struct Search<'l> {
    pub(super) belt_loop: &'l BeltLoop,
    pub(super) tolerance: f64,
    pub(super) cost: Cost,
    /// Relative effect of the last ε on the parameters.
    pub(super) epsilon_effect: f64,
}

/// A loop at rest and running.
struct Found {
    at_rest: RestProblem,
    rest: Rest,
    running: Running,
}

/// The steady state of a loop with a V-belt.
pub(crate) fn solve(belt_loop: &BeltLoop, tolerance: f64) -> Result<LoopState, LoopError> {
    let mut search = Search::new(belt_loop, tolerance);
    let Found {
        at_rest,
        rest,
        running,
    } = search.find()?;
    state(&mut search, &rest, &at_rest, &running.solved)
}

/// As [`solve`], with what takes longer than the state: the torque margin of every pulley and the load limit.
pub(crate) fn solve_with_margins(
    belt_loop: &BeltLoop,
    tolerance: f64,
) -> Result<LoopState, LoopError> {
    let mut search = Search::new(belt_loop, tolerance);
    let Found {
        at_rest,
        rest,
        running: Running { solved, rough },
    } = search.find()?;
    let mut found = state(&mut search, &rest, &at_rest, &solved)?;
    for (index, pulley) in found.pulleys.iter_mut().enumerate() {
        pulley.torque_margin = solved.torque_margin(index, &rough, tolerance);
        pulley.torque_capacity = pulley
            .torque_margin
            .map(|margin| margin * pulley.torque.abs());
    }
    found.load_limit = search.load_limit(rough).ok().flatten();
    Ok(found)
}

impl<'l> Search<'l> {
    fn new(belt_loop: &'l BeltLoop, tolerance: f64) -> Self {
        Self {
            belt_loop,
            tolerance,
            cost: Cost::default(),
            epsilon_effect: 0.0,
        }
    }

    /// The loop at rest and running, in the order in which the closure gives them.
    fn find(&mut self) -> Result<Found, LoopError> {
        let belt_loop = self.belt_loop;
        let start = match (belt_loop.closure, belt_loop.tensioner()) {
            (Closure::RestCoordinate(coordinate), _) => coordinate,
            (_, Some((_, tensioner))) => tensioner.start_coordinate,
            (_, None) => 0.0,
        };
        let layout = belt_loop.layout(start)?;
        let target = match belt_loop.closure {
            Closure::UnstretchedLength(length) => Err(Known::Length(length)),
            Closure::SetupTension(tension) => Err(Known::Tension(tension)),
            Closure::RestCoordinate(_) => Err(Known::Equilibrium),
            Closure::SpanTension { span, tension } => Ok(Target::Tension { span, tension }),
            Closure::SpanTractiveTension { span, tension } => {
                Ok(Target::Tractive { span, tension })
            }
        };
        let target = match target {
            Ok(target) => target,
            Err(known) => {
                let (at_rest, rest) = rest_near(self, known, start, &layout)?;
                within_travel(belt_loop, rest.coordinate)?;
                let target = Target::Length(rest.unstretched);
                let running = running(self, target, Some(&rest), rest.coordinate)?;
                return self.found(at_rest, rest, running);
            }
        };
        let running = running(self, target, None, start)?;
        let problem = &running.solved.problem;
        let (length, coordinate) = running.solved.with_ends(|at, p| {
            let [unstretched, _] = problem.lengths(at, p);
            (unstretched, problem.coordinate(p))
        });
        let layout = belt_loop.layout(coordinate)?;
        let (at_rest, rest) = rest_near(self, Known::Length(length), coordinate, &layout)?;
        self.found(at_rest, rest, running)
    }

    fn found(
        &self,
        at_rest: RestProblem,
        rest: Rest,
        running: Running,
    ) -> Result<Found, LoopError> {
        let Solved { problem, solution } = &running.solved;
        let coordinate = problem.coordinate(solution.parameters());
        for coordinate in [rest.coordinate, coordinate] {
            within_travel(self.belt_loop, coordinate)?;
        }
        Ok(Found {
            at_rest,
            rest,
            running,
        })
    }

    pub(super) fn lost(&self, reached: f64, cause: &bvp::Error) -> LoopError {
        LoopError::NotConverged {
            reached,
            cause: difficulty::of_solver(cause),
        }
    }

    /// Solves one problem from a guess.
    pub(super) fn attempt(
        &mut self,
        problem: LoopProblem,
        guess: &dyn bvp::Guess,
        effort: Effort,
    ) -> Result<Solved, bvp::Error> {
        let outcome = bvp::solve(&problem, guess, &effort.options(self.tolerance));
        self.cost.count(&outcome);
        outcome.map(|solution| Solved { problem, solution })
    }
}
