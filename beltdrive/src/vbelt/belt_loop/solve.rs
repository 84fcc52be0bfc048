//! From a loop to its steady state: rest, then the running loop, cold or by raising the load.

use super::super::path::{Path, Solved};
use super::at_rest::rest_near;
use super::climb::Top;
use super::elastic_limit::{Unelastic, with_torques};
use super::problem::LoopProblem;
use super::rest::{Known, Rest, RestProblem};
use super::round::Target;
use super::running::{Running, neighbouring, running};
use super::state::state;
use crate::mechanics::tensioner::within_travel;
use crate::results::difficulty;
use crate::results::loop_state::{LoadLimit, LoopState, RestState};
use crate::{Drive, FrictionLaw, SolveError};
use std::cell::OnceCell;

/// The search for the steady state of a loop.
pub(super) type Search<'l> = Path<'l>;

/// A solved loop, from which that of a drive that differs little is found fast.
#[derive(Clone, Debug)]
pub(crate) struct LoopNeighbour {
    drive: Drive,
    at_rest: RestProblem,
    rest: Rest,
    solved: Solved<LoopProblem>,
    /// That from which it was found.
    before: Option<Box<Solved<LoopProblem>>>,
    /// Force across each span at rest, as in [`SpanState::deflection_force`](crate::belt_loop::SpanState).
    deflections: Vec<Option<f64>>,
}

/// A loop at rest and running.
pub(super) struct Found<'l> {
    pub(super) at_rest: RestProblem,
    pub(super) rest: Rest,
    pub(super) running: Running<'l>,
}

/// The steady state of a loop with a V-belt.
pub(crate) fn solve(drive: &Drive, tolerance: f64) -> Result<LoopState, SolveError> {
    let mut search = Search::new(drive, tolerance);
    let Found {
        at_rest,
        rest,
        running,
    } = search.search()?;
    state(&mut search, &rest, &at_rest, &running.solved, None)
}

/// As [`solve`], with what the next neighbour is found from; from a neighbour itself where there is one and friction
/// is that of bristles, whose zones need not be found.
pub(crate) fn solve_from(
    drive: &Drive,
    neighbour: Option<&LoopNeighbour>,
    tolerance: f64,
) -> Result<(LoopState, LoopNeighbour), SolveError> {
    if let Some(near) = neighbour
        && let Some(found) = near.step_to(drive, tolerance)
    {
        return Ok(found);
    }
    let mut search = Search::new(drive, tolerance);
    let Found {
        at_rest,
        rest,
        running,
    } = search.search()?;
    LoopNeighbour::of(&mut search, at_rest, rest, running.solved, None)
}

impl LoopNeighbour {
    /// The answer, and what the next one is found from.
    fn of(
        search: &mut Search<'_>,
        at_rest: RestProblem,
        rest: Rest,
        solved: Solved<LoopProblem>,
        deflections: Option<&[Option<f64>]>,
    ) -> Result<(LoopState, Self), SolveError> {
        let state = state(search, &rest, &at_rest, &solved, deflections)?;
        let deflections = state.spans.iter().map(|span| span.deflection_force);
        let neighbour = Self {
            drive: search.drive.clone(),
            deflections: deflections.collect(),
            at_rest,
            rest,
            solved,
            before: None,
        };
        Ok((state, neighbour))
    }

    /// The state of a drive by Newton's method from this one; `None` if that does not find one that is certainly below
    /// the largest load.
    fn step_to(&self, drive: &Drive, tolerance: f64) -> Option<(LoopState, Self)> {
        let (FrictionLaw::Bristle { .. }, FrictionLaw::Bristle { .. }) =
            (self.drive.law, drive.law)
        else {
            return None;
        };
        let mut search = Search::new(drive, tolerance);
        let known = drive
            .is_at_rest_as(&self.drive)
            .then_some((&self.at_rest, &self.rest));
        let solved = |search: &mut Search<'_>, rest, target, coordinate| {
            let near = [Some(&self.solved), self.before.as_deref()];
            neighbouring(search, near, target, rest, coordinate)
        };
        let start = drive.start_coordinate();
        let layout = drive.layout(start).ok()?;
        let (at_rest, rest, solved) = match Target::of(drive.closure) {
            Ok(target) => {
                let solved = solved(&mut search, None, target, start)?;
                let (at_rest, rest) = search.rest_of(&solved).ok()?;
                (at_rest, rest, solved)
            }
            Err(at_rest) => {
                let (at_rest, rest) = match known {
                    Some((at_rest, rest)) => (at_rest.clone(), rest.clone()),
                    None => rest_near(&mut search, at_rest, start, &layout).ok()?,
                };
                let target = Target::Length(rest.unstretched);
                let solved = solved(&mut search, Some(&rest), target, rest.coordinate)?;
                (at_rest, rest, solved)
            }
        };
        search.within_travel(&rest, &solved).ok()?;
        let deflections = known.map(|_| &self.deflections[..]);
        let (state, next) = Self::of(&mut search, at_rest, rest, solved, deflections).ok()?;
        let before = Some(Box::new(self.solved.clone()));
        Some((state, Self { before, ..next }))
    }

    /// The same, of which no step before it is known.
    pub(crate) fn at_a_turn(mut self) -> Self {
        self.before = None;
        self
    }

    /// How far all torques can be raised, found by raising them; as [`Search::load_limit`].
    pub(crate) fn load_limit(&self, tolerance: f64) -> Option<Top> {
        let mut search = Search::new(&self.drive, tolerance);
        search.load_limit(&self.solved, |search| {
            let found = search.search().ok()?;
            found.running.roughly(search).ok()
        })
    }
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
    let mut found = state(&mut search, &rest, &at_rest, solved, None)?;
    let rough = OnceCell::new();
    let rough = |search: &mut Search<'_>| {
        let rough = rough.get_or_init(|| {
            let rough = running.roughly(search).ok()?;
            Some((search.with_stiffer_ones(&rough), rough))
        });
        rough.as_ref()
    };
    for (index, pulley) in found.pulleys.iter_mut().enumerate() {
        let stiffer = |search: &mut Search<'_>| rough(search).map(|(stiffer, _)| stiffer);
        let Some([margin, error]) = search.torque_margin(solved, index, stiffer) else {
            continue;
        };
        pulley.torque_margin = Some(margin);
        pulley.torque_capacity = Some(margin * pulley.torque.abs());
        pulley.torque_margin_error = error / margin;
    }
    let of_torques = with_torques(drive, &found);
    let start = running.start.of(&of_torques);
    let elastic = Unelastic::of(&start).and_then(|unelastic| {
        Search::new(&of_torques, tolerance).elastic_limit(&start, &unelastic)
    });
    let limit = match elastic {
        Some((limit, _)) => Some(limit.top),
        None => search.load_limit(solved, |search| {
            rough(search).map(|(_, rough)| rough.clone())
        }),
    };
    found.load_limit = limit.map(|top| LoadLimit {
        factor: top.factor,
        pulley: top.pulley,
        error: top.error,
    });
    Ok(found)
}

/// The loop at rest, where the closure is one of it.
pub(crate) fn at_rest(drive: &Drive, tolerance: f64) -> Result<RestState, SolveError> {
    let mut search = Search::new(drive, tolerance);
    let Err(known) = Target::of(drive.closure) else {
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

impl<'l> Search<'l> {
    /// The loop at rest and running, in the order in which the closure gives them.
    pub(super) fn search(&mut self) -> Result<Found<'l>, SolveError> {
        let drive = self.drive;
        let start = drive.start_coordinate();
        let layout = drive.layout(start)?;
        let target = match Target::of(drive.closure) {
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
        let (at_rest, rest) = self.rest_of(&running.solved)?;
        self.found(at_rest, rest, running)
    }

    fn found(
        &self,
        at_rest: RestProblem,
        rest: Rest,
        running: Running<'l>,
    ) -> Result<Found<'l>, SolveError> {
        self.within_travel(&rest, &running.solved)?;
        Ok(Found {
            at_rest,
            rest,
            running,
        })
    }

    /// The belt of a running loop at rest.
    fn rest_of(
        &mut self,
        running: &Solved<LoopProblem>,
    ) -> Result<(RestProblem, Rest), SolveError> {
        let [length, _] = running.round(|round| round.lengths());
        let coordinate = running.problem.coordinate(running.solution.parameters());
        let layout = self.drive.layout(coordinate)?;
        rest_near(self, Known::Length(length), coordinate, &layout)
    }

    /// Refuses a tensioner beyond its stops, at rest and running.
    pub(super) fn within_travel(
        &self,
        rest: &Rest,
        running: &Solved<LoopProblem>,
    ) -> Result<(), SolveError> {
        let Solved { problem, solution } = running;
        for coordinate in [rest.coordinate, problem.coordinate(solution.parameters())] {
            within_travel(self.drive, coordinate)?;
        }
        Ok(())
    }
}

/// The error of a search that came to a share of the load.
pub(super) fn lost(reached: f64, cause: &bvp::Error) -> SolveError {
    SolveError::Unreached {
        reached,
        cause: difficulty::of_solver(cause),
    }
}
