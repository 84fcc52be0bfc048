//! From a loop to its steady state: rest, then the running loop, cold or by raising the load.

use super::super::path::Effort;
use super::climb::{Climbed, Top};
use super::guess::{groove_compliances, tractive_tensions};
use super::laws::Start;
use super::problem::{LoopProblem, Target};
use super::rest::{Cost, Known, Rest, RestProblem};
use super::rest_guess::RestGuess;
use super::state::state;
use crate::drive::belt_loop::{BeltLoop, Closure};
use crate::drive::layout::Layout;
use crate::mechanics::tensioner::{Towards, equilibrium, length_derivatives, within_travel};
use crate::results::difficulty;
use crate::results::loop_error::LoopError;
use crate::results::loop_state::{LoadLimit, LoopState};
use bvp::{Ends, Problem, Solution};

/// Shares of the load that are tried in turn from nothing; from all but the first the load is then raised.
const SHARES: [f64; 7] = [1.0, 0.5, 0.2, 0.05, 0.01, 1e-3, 0.0];
/// Where the belt leaves a pulley more steeply than this, or a pulley loses more than this share of its
/// speed, a state may lie beyond the largest load.
const STEEP: f64 = 1.3;
const SLOW: f64 = 0.5;
/// Largest load factor that is tried: beyond it the torques are but rounding errors of the driver's.
const LARGEST_FACTOR: f64 = 1e9;

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

    /// Whether the state may lie beyond the largest load.
    fn may_be_beyond(&self) -> bool {
        let p = self.solution.parameters();
        let ends = self.with_ends(|at, _| self.problem.end_angles(at));
        let mut segments = 0..self.problem.pulley_of.len();
        ends.iter().any(|ends| ends.exit > STEEP)
            || segments.any(|segment| self.problem.omega(segment, p) < SLOW)
    }

    /// Whether the belt pulls in all spans, turns every pulley forwards and touches it.
    fn is_drive(&self) -> bool {
        let p = self.solution.parameters();
        let segments = self.problem.pulley_of.len();
        p[0] > 0.0
            && (0..segments).all(|segment| {
                p[self.problem.length_index(segment)] > 0.0
                    && self.problem.omega(segment, p) > 0.0
                    && self.solution.end(segment)[0] > 0.0
            })
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

/// A running loop.
struct Running {
    /// To the tolerance.
    solved: Solved,
    /// Roughly, to raise the load from. Coulomb friction has a large ε there, which matters little where the belt
    /// slips (margins change by 1e-6) and makes the way there easy: with a small one neither the driver of three
    /// grooves had a margin nor their loop a load limit.
    rough: Solved,
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

    /// How far all torques can be raised from a state, found by raising them; `None` if that is not at all, or
    /// farther than anything that was tried.
    fn load_limit(&mut self, from: Solved) -> Result<Option<LoadLimit>, LoopError> {
        let mut pulleys = self.belt_loop.pulleys.iter();
        if pulleys.all(|pulley| pulley.duty.torque_at(1.0) == 0.0) {
            return Ok(None);
        }
        let (mut here, mut to) = (from, 2.0);
        while to < LARGEST_FACTOR {
            match self.climb(&here, to) {
                Climbed::Reached(solved) => here = *solved,
                Climbed::Limit(Top { factor, pulley, .. }) => {
                    return Ok(Some(LoadLimit { factor, pulley }));
                }
                Climbed::Lost { reached, cause } => {
                    return Err(LoopError::NotConverged { reached, cause });
                }
            }
            to *= 2.0;
        }
        Ok(None)
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
                let (at_rest, rest) = self.rest(known, start, &layout)?;
                within_travel(belt_loop, rest.coordinate)?;
                let target = Target::Length(rest.unstretched);
                let running = self.running(target, Some(&rest), rest.coordinate)?;
                return self.found(at_rest, rest, running);
            }
        };
        let running = self.running(target, None, start)?;
        let problem = &running.solved.problem;
        let (length, coordinate) = running.solved.with_ends(|at, p| {
            let [unstretched, _] = problem.lengths(at, p);
            (unstretched, problem.coordinate(p))
        });
        let layout = belt_loop.layout(coordinate)?;
        let (at_rest, rest) = self.rest(Known::Length(length), coordinate, &layout)?;
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

    /// The belt at rest, from where its pitch line would be with grooves that yield.
    pub(super) fn rest(
        &mut self,
        known: Known,
        start: f64,
        layout: &Layout,
    ) -> Result<(RestProblem, Rest), LoopError> {
        let belt_loop = self.belt_loop;
        let axial = belt_loop.belt.axial_stiffness;
        let (coordinate, tension) = match known {
            Known::Length(length) => {
                let grooves = groove_compliances(belt_loop, layout);
                let compliance = length / axial + grooves.iter().sum::<f64>();
                let tension = |layout: &Layout| (layout.length() - length) / compliance;
                let found = equilibrium(belt_loop, start, Towards::Force, "at rest", |layout| {
                    Ok([tension(layout), compliance.recip()])
                });
                match found {
                    Err(_) if tension(layout) <= 0.0 => (start, tension(layout)),
                    found => {
                        let (coordinate, layout) = found?;
                        (coordinate, tension(&layout))
                    }
                }
            }
            Known::Tension(tension) => {
                let found = equilibrium(belt_loop, start, Towards::Newton, "at rest", |_| {
                    Ok([tension, 0.0])
                });
                (found?.0, tension)
            }
            Known::Equilibrium => {
                let tension = belt_loop
                    .tensioner()
                    .map_or(f64::NAN, |(pulley, tensioner)| {
                        let guide = &tensioner.guide;
                        let [slope, _] = length_derivatives(layout, pulley, guide, start);
                        tensioner.load_at(start)[0] / slope
                    });
                (start, tension)
            }
        };
        if tension <= 0.0 {
            return Err(LoopError::Slack { tension });
        }
        let layout = belt_loop.layout(coordinate)?;
        let problem = RestProblem::new(belt_loop, &layout, tension, known);
        let problem = match known {
            Known::Equilibrium => problem.held(coordinate),
            _ => problem,
        };
        let pressed = |(pulley, largest): (usize, f64)| LoopError::PressedThrough {
            pulley: belt_loop.pulleys[pulley].name.clone(),
            largest,
        };
        let guess = RestGuess::new(&problem, tension, coordinate).map_err(pressed)?;
        let outcome = problem.solve(&guess, self.tolerance, &mut self.cost);
        let rest = outcome.map_err(|cause| self.lost(0.0, &cause))?;
        match rest.tension > 0.0 {
            true => Ok((problem, rest)),
            false => Err(LoopError::Slack {
                tension: rest.tension,
            }),
        }
    }

    fn lost(&self, reached: f64, cause: &bvp::Error) -> LoopError {
        LoopError::NotConverged {
            reached,
            cause: difficulty::of_solver(cause),
        }
    }

    /// The running loop under its whole load: at once where Newton's method finds it and it cannot lie
    /// beyond the largest load, else by raising a share of the load.
    fn running(
        &mut self,
        target: Target,
        rest: Option<&Rest>,
        coordinate: f64,
    ) -> Result<Running, LoopError> {
        let layout = self.belt_loop.layout(coordinate)?;
        self.presses(target, &layout)?;
        let start = |factor: f64| {
            let tractive = tractive_tensions(self.belt_loop, &layout, target, rest, factor);
            Start {
                layout: &layout,
                target,
                tractive,
                coordinate,
                factor,
            }
        };
        let [whole, shares @ ..] = SHARES.map(start);
        let direct = match whole.is_taut() {
            true => self
                .rough(&whole)
                .and_then(|rough| self.sharpened(rough))
                .map_err(Some),
            false => Err(None),
        };
        let is_safe = |solved: &Solved| solved.is_drive() && !solved.may_be_beyond();
        let direct = match direct {
            Ok(running) if is_safe(&running.solved) => return Ok(running),
            other => other,
        };
        for share in shares.iter().filter(|share| share.is_taut()) {
            match self.rough(share) {
                Ok(rough) if is_safe(&rough) => return self.raise(&rough),
                _ => {}
            }
        }
        match direct {
            Ok(running) if running.solved.is_drive() => Ok(running),
            Err(Some(cause)) => Err(self.lost(0.0, &cause)),
            _ => Err(LoopError::NotConverged {
                reached: 0.0,
                cause: "the belt would have to push in a span even under hardly any load",
            }),
        }
    }

    /// Whether a belt between fixed centres presses on its pulleys without torques. Where it hardly presses
    /// it does not sink either: the tension of its pitch line decides.
    fn presses(&self, target: Target, layout: &Layout) -> Result<(), LoopError> {
        let (Target::Length(length), None) = (target, self.belt_loop.tensioner()) else {
            return Ok(());
        };
        let (belt, rim) = (self.belt_loop.belt, self.belt_loop.rim_speed());
        let strain = (layout.length() - length) / length;
        let flow = belt.mass_per_length * rim / (1.0 + strain);
        let tractive_tension = belt.axial_stiffness * strain - flow * rim;
        match tractive_tension > 0.0 {
            true => Ok(()),
            false => Err(LoopError::LiftsOff {
                tractive_tension,
                speed: rim,
                is_loaded: false,
            }),
        }
    }

    /// Raises the load of a state to the whole.
    fn raise(&mut self, from: &Solved) -> Result<Running, LoopError> {
        match self.climb(from, 1.0) {
            Climbed::Reached(rough) => {
                let outcome = self.sharpened(*rough);
                outcome.map_err(|cause| self.lost(1.0, &cause))
            }
            Climbed::Limit(Top {
                factor,
                pulley,
                overhangs,
            }) => Err(LoopError::Overloaded {
                pulley: self.belt_loop.pulleys[pulley].name.clone(),
                load_factor: factor,
                overhangs,
            }),
            Climbed::Lost { reached, cause } => Err(LoopError::NotConverged { reached, cause }),
        }
    }

    /// The running loop to the tolerance, from a rough one with a large ε.
    fn sharpened(&mut self, rough: Solved) -> Result<Running, bvp::Error> {
        let solved = self.sharpen(rough.clone())?;
        Ok(Running { solved, rough })
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

impl Start<'_> {
    /// Whether the belt pulls in all spans.
    fn is_taut(&self) -> bool {
        self.tractive.iter().all(|&tension| tension > 0.0)
    }
}
