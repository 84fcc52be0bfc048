//! From a loop to its steady state: rest, then the running loop, cold or by raising the load.

use super::super::path::{Path, Solved};
use super::at_rest::rest_near;
use super::rest::{Known, Rest, RestProblem};
use super::round::Target;
use super::running::{Running, running};
use super::state::state;
use crate::mechanics::tensioner::within_travel;
use crate::results::difficulty;
use crate::results::loop_state::{LoopState, RestState};
use crate::{Closure, Drive, SolveError};

/// The search for the steady state of a loop.
pub(super) type Search<'l> = Path<'l>;

/// A loop at rest and running.
struct Found<'l> {
    at_rest: RestProblem,
    rest: Rest,
    running: Running<'l>,
}

/// The steady state of a loop with a V-belt.
pub(crate) fn solve(drive: &Drive, tolerance: f64) -> Result<LoopState, SolveError> {
    let mut search = Search::new(drive, tolerance);
    let Found {
        at_rest,
        rest,
        running,
    } = search.search()?;
    state(&mut search, &rest, &at_rest, &running.solved)
}

/// As [`solve`], with what takes longer than the state: the torque margin of every pulley and the load limit.
pub(crate) fn solve_with_margins(drive: &Drive, tolerance: f64) -> Result<LoopState, SolveError> {
    let mut search = Search::new(drive, tolerance);
    let Found {
        at_rest,
        rest,
        running,
    } = search.search()?;
    let solved = &running.solved;
    let mut found = state(&mut search, &rest, &at_rest, solved)?;
    let Ok(rough) = running.roughly(&mut search) else {
        return Ok(found);
    };
    for (index, pulley) in found.pulleys.iter_mut().enumerate() {
        pulley.torque_margin = solved.torque_margin(index, &rough, tolerance);
        pulley.torque_capacity = pulley
            .torque_margin
            .map(|margin| margin * pulley.torque.abs());
    }
    found.load_limit = search.load_limit(solved, rough).ok().flatten();
    Ok(found)
}

/// The loop at rest, where the closure is one of it.
pub(crate) fn at_rest(drive: &Drive, tolerance: f64) -> Result<RestState, SolveError> {
    let mut search = Search::new(drive, tolerance);
    let Err(known) = closed_by(drive.closure) else {
        return Err(SolveError::NotFound {
            what: "state at rest",
        });
    };
    let start = drive.start_coordinate();
    let (_, rest) = rest_near(&mut search, known, start, &drive.layout(start)?)?;
    within_travel(drive, rest.coordinate)?;
    Ok(RestState {
        tension: rest.tension,
        unstretched_length: rest.unstretched,
        coordinate: rest.coordinate,
    })
}

/// What the closure asks of the running belt, or else what it says of the belt at rest.
fn closed_by(closure: Closure) -> Result<Target, Known> {
    match closure {
        Closure::UnstretchedLength(length) => Err(Known::Length(length)),
        Closure::SetupTension(tension) => Err(Known::Tension(tension)),
        Closure::RestCoordinate(_) => Err(Known::Equilibrium),
        Closure::SpanTension { span, tension } => Ok(Target::Tension { span, tension }),
        Closure::SpanTractiveTension { span, tension } => Ok(Target::Tractive { span, tension }),
        Closure::BothSpans(_) => unreachable!("two pulleys are solved as two pulleys"),
    }
}

impl<'l> Search<'l> {
    /// The loop at rest and running, in the order in which the closure gives them.
    fn search(&mut self) -> Result<Found<'l>, SolveError> {
        let drive = self.drive;
        let start = drive.start_coordinate();
        let layout = drive.layout(start)?;
        let target = match closed_by(drive.closure) {
            Ok(target) => target,
            Err(known) => {
                let (at_rest, rest) = rest_near(self, known, start, &layout)?;
                within_travel(drive, rest.coordinate)?;
                let target = Target::Length(rest.unstretched);
                let running = running(self, target, Some(&rest), rest.coordinate)?;
                return self.found(at_rest, rest, running);
            }
        };
        let running = running(self, target, None, start)?;
        let problem = &running.solved.problem;
        let [length, _] = running.solved.round(|round| round.lengths());
        let coordinate = problem.coordinate(running.solved.solution.parameters());
        let layout = drive.layout(coordinate)?;
        let (at_rest, rest) = rest_near(self, Known::Length(length), coordinate, &layout)?;
        self.found(at_rest, rest, running)
    }

    fn found(
        &self,
        at_rest: RestProblem,
        rest: Rest,
        running: Running<'l>,
    ) -> Result<Found<'l>, SolveError> {
        let Solved { problem, solution } = &running.solved;
        let coordinate = problem.coordinate(solution.parameters());
        for coordinate in [rest.coordinate, coordinate] {
            within_travel(self.drive, coordinate)?;
        }
        Ok(Found {
            at_rest,
            rest,
            running,
        })
    }
}

/// The error of a search that came to a share of the load.
pub(super) fn lost(reached: f64, cause: &bvp::Error) -> SolveError {
    SolveError::Unreached {
        reached,
        cause: difficulty::of_solver(cause),
    }
}
