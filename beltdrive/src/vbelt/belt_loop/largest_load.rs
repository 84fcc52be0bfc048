//! The largest load of a loop with a V-belt, fast from that at another speed.
//!
//! Speed enters through the momentum flow alone. A state a little below the largest load at one speed is turned into
//! one at another speed by a single Newton solve, and the load is raised from there: the way from no load, which
//! takes most of the time, is gone once. States with bristles go from one speed to another, since those with Coulomb or EPP
//! friction have zones that change with it; the load is raised with that friction itself where it is found from them.

use super::super::belt_problem::BeltProblem;
use super::super::groove::TENSION;
use super::super::path::{Effort, Solved};
use super::at_rest::rest_near;
use super::climb::Limit;
use super::guess::tractive_tensions;
use super::like::Like;
use super::pieces::ROUGH;
use super::problem::LoopProblem;
use super::round::Target;
use super::running::{SLOW, is_safe, presses};
use super::slipping::{Slipping, is_slipping};
use super::solve::{Search, lost};
use super::start::Start;
use super::stiffening::Judge;
use crate::results::largest_load::{LargestLoad, LoadEnd};
use crate::{Drive, SolveError};

/// Shares of the expected load from which it is raised, in turn. Near lift-off there are states above the largest load
/// that does not slip grossly.
const SHARES: [f64; 4] = [0.25, 0.05, 0.01, 1e-3];

/// The load of a state from which others are found, as a share of the largest: nearer to a limit point Newton's method
/// finds the state beyond it.
pub(super) const BELOW: f64 = 0.97;

/// Parts of that share which are tried in turn at another speed, and of a load from which the direction of friction is
/// found. With EPP friction the largest load falls faster than the tension: by the first alone, three of the six first speeds
/// of `kim2009-epp` were begun from nothing, which took 14 s of 21 s.
const LOWER: [f64; 3] = [1.0, 0.8, 0.5];

/// The same of a state with bristles from which exact Coulomb or EPP friction is found, in turn: soft bristles carry a few
/// per cent more or less.
const WELL_BELOW: [f64; 3] = [0.85, 0.6, 0.4];

/// Factor between loads up to which the load is raised.
const RAISED: f64 = 4.0;

/// Tolerance of states with bristles whose load is raised only to find others from them: with that of other curves the
/// rating of `kim2009-epp` takes a quarter longer.
const ROUGHLY_RAISED: f64 = 1e-3;

/// Largest factor on the expected load that is tried.
const LARGEST: f64 = 1e6;

/// A state a little below the largest load.
#[derive(Clone, Debug)]
pub(crate) struct NearLargestLoad {
    below: Solved<LoopProblem>,
    /// The largest load there.
    factor: f64,
}

/// The factor on all torques, expected to be about `expected`, up to which a loop has a steady state. The states from which
/// the load is raised are no more accurate than those on the way: with a tolerance of 1e-6 in place of 1e-4 ratings took a
/// quarter longer, and no limit changed by more than its error.
pub(crate) fn largest_load(
    drive: &Drive,
    near: Option<&NearLargestLoad>,
    expected: f64,
    tolerance: f64,
) -> Result<(LargestLoad, NearLargestLoad), SolveError> {
    let mut search = Search::new(drive, tolerance.max(ROUGH));
    if let Some(near) = near
        && let Some(below) = near.at_speed(&mut search, expected)
        && let Ok(found) = search.raised(below, None, expected)
    {
        return Ok(found);
    }
    let begin = search.loaded(expected)?;
    let below = search.raised_bristles(&begin, expected);
    search.raised(begin, below, expected)
}

impl NearLargestLoad {
    /// The same share of another load at another speed, or less where that is beyond the largest.
    fn at_speed(&self, search: &mut Search<'_>, expected: f64) -> Option<Solved<LoopProblem>> {
        let share = self.below.factor() / self.factor;
        LOWER
            .into_iter()
            .find_map(|lower| self.with_share(lower * share, search, expected))
    }

    /// A share of another load at another speed.
    fn with_share(
        &self,
        share: f64,
        search: &mut Search<'_>,
        expected: f64,
    ) -> Option<Solved<LoopProblem>> {
        let problem = &self.below.problem;
        let squares = [problem.units.speed, search.drive.rim_speed()].map(|speed| speed * speed);
        let [from, to] = squares;
        if from == to {
            return Some(self.below.clone());
        }
        // The limit falls about in proportion to the square of the speed, and tensions with it.
        let force = problem.units.force;
        let member = |problem: &LoopProblem, square: f64| {
            let part = (square - from) / (to - from);
            let factor = self.factor + part * (expected - self.factor);
            let force = force * factor / self.factor;
            let problem = problem.clone().at_speed(square.sqrt(), force);
            problem.with_factor(share * factor)
        };
        let step = (to - from).abs();
        let found = search.follow(self.below.clone(), squares, step, Effort::Rough, member);
        // From a state that slips grossly the load would rise beyond where it began to.
        found.ok().filter(is_begin)
    }
}

impl Search<'_> {
    /// A state below the largest load, from nothing.
    fn loaded(&mut self, expected: f64) -> Result<Solved<LoopProblem>, SolveError> {
        let drive = self.drive;
        let coordinate = drive.start_coordinate();
        let layout = drive.layout(coordinate)?;
        let (target, rest, coordinate) = match Target::of(drive.closure) {
            Ok(target) => (target, None, coordinate),
            Err(known) => {
                let (_, rest) = rest_near(self, known, coordinate, &layout)?;
                let at = rest.coordinate;
                (Target::Length(rest.unstretched), Some(rest.tension), at)
            }
        };
        let layout = drive.layout(coordinate)?;
        // A belt that sinks into its grooves is less taut than one that does not.
        let expected = match presses(self, target, &layout)? {
            Some(unsunk) => {
                let idle = tractive_tensions(drive, &layout, target, rest, 0.0);
                expected * idle[0] / unsunk
            }
            None => expected,
        };
        let whole = Start::new(drive, layout, target, rest, coordinate);
        let mut cause = None;
        for share in SHARES {
            let start = whole.under(share * expected);
            if !start.is_taut() {
                continue;
            }
            match self.enter_bristles(&start) {
                Ok(rough) if is_begin(&rough) => return Ok(rough),
                Ok(_) => {}
                Err(stuck) => cause = Some(stuck.cause),
            }
        }
        Err(match cause {
            Some(cause) => lost(0.0, &cause),
            None => SolveError::Unreached {
                reached: 0.0,
                cause: "the belt would have to push in a span even under hardly any load",
            },
        })
    }

    /// The load of a state with bristles raised to a little below the largest, if exact friction is to be found from it:
    /// curves with that take far longer. From a quarter of the load the first limit of `kim2009-epp` took 0.64 s.
    fn raised_bristles(
        &mut self,
        from: &Solved<LoopProblem>,
        expected: f64,
    ) -> Option<Solved<LoopProblem>> {
        if self.follows_law() {
            return None;
        }
        let mut rough = Search::new(self.drive, self.tolerance.max(ROUGHLY_RAISED));
        let (limit, _) = rough.end(from, expected).ok()?;
        Some(self.below(limit, from.clone()))
    }

    /// The load of a state with bristles raised to the largest, with Coulomb or EPP friction whose direction is a state
    /// if that is found from it or from one under more load.
    fn raised(
        &mut self,
        from: Solved<LoopProblem>,
        higher: Option<Solved<LoopProblem>>,
        expected: f64,
    ) -> Result<(LargestLoad, NearLargestLoad), SolveError> {
        let directed = {
            let mut bristles = higher.iter().chain([&from]);
            bristles.find_map(|bristles| self.directed_limit(bristles, expected))
        };
        let limit = match directed {
            Some(limit) => limit,
            None => self.limit(&from, expected)?,
        };
        let found = answer(self.drive, &limit);
        let below = self.below(limit, from);
        let factor = found.factor;
        Ok((found, NearLargestLoad { below, factor }))
    }

    /// The largest load with Coulomb or EPP friction whose direction is a state, from a state with bristles.
    fn directed_limit(&mut self, bristles: &Solved<LoopProblem>, expected: f64) -> Option<Limit> {
        if self.follows_law() {
            return None;
        }
        let mut shares = LOWER.into_iter();
        let directed = shares.find_map(|share| self.directed(bristles, share))?;
        self.limit(&directed, expected).ok()
    }

    /// A share of the load of a state with bristles, with Coulomb or EPP friction whose direction is a state.
    fn directed(&mut self, from: &Solved<LoopProblem>, share: f64) -> Option<Solved<LoopProblem>> {
        let lower = match share {
            1.0 => from.clone(),
            _ => self.at_factor(from, share * from.factor(), Effort::Rough)?,
        };
        self.with_direction_near(&Like::new(self.drive, &lower), &lower)
            .filter(is_begin)
    }

    /// The largest load of the curve on which that of a state is raised.
    fn limit(&mut self, from: &Solved<LoopProblem>, expected: f64) -> Result<Limit, SolveError> {
        let (mut limit, begin) = self.end(from, expected)?;
        self.without_bristles(&mut limit, &begin, Judge::GrossSlip);
        Ok(limit)
    }

    /// The end of the curve on which the load of a state is raised, and where the last climb to it began.
    fn end(
        &mut self,
        from: &Solved<LoopProblem>,
        expected: f64,
    ) -> Result<(Limit, Solved<LoopProblem>), SolveError> {
        let mut slipping = Slipping::judged(Judge::GrossSlip);
        let times = RAISED * (0.5 * expected / from.factor()).max(1.0);
        let found = self.rise(from, times, LARGEST * expected, Some(&mut slipping))?;
        found.ok_or(SolveError::NotFound {
            what: "largest load",
        })
    }

    /// The state from which others are found: on the way to the limit, or with bristles raised from that with which it
    /// began.
    fn below(&mut self, limit: Limit, begin: Solved<LoopProblem>) -> Solved<LoopProblem> {
        let (top, from) = (limit.top.factor, begin.factor());
        let is_below = |state: &Solved<LoopProblem>| {
            !state.problem.has_direction() && (from..=BELOW * top).contains(&state.factor())
        };
        if let Some(below) = limit.below.into_iter().rev().find(is_below) {
            return below;
        }
        let factors = WELL_BELOW.map(|share| share * top);
        let mut higher = factors.into_iter().filter(|factor| *factor > from);
        let raised = higher.find_map(|factor| {
            self.at_factor(&begin, factor, Effort::Rough)
                .filter(is_begin)
        });
        raised.unwrap_or(begin)
    }
}

/// Whether the load can be raised from a state to the largest: one of a drive, below it.
pub(super) fn is_begin(state: &Solved<LoopProblem>) -> bool {
    is_safe(state) && !is_slipping(state)
}

/// The largest load as it is told.
fn answer(drive: &Drive, limit: &Limit) -> LargestLoad {
    let Limit { top, at, .. } = limit;
    let (problem, p) = (&at.problem, at.solution.parameters());
    let rise = top.factor / at.factor();
    let ends = at.round(|round| round.end_angles());
    let torque = |pulley: usize| {
        if problem.is_idle(pulley) {
            return 0.0;
        }
        let [behind, before] = [
            at.entry(pulley)[TENSION] * ends[pulley].entry.cos(),
            at.exit(pulley)[TENSION] * ends[pulley].exit.cos(),
        ];
        rise * (before - behind) * problem.units.torque(problem.pitch_radius(pulley))
    };
    let driver = drive.driver();
    let speed = |pulley: usize| {
        problem.omega(pulley, p) * problem.units.angular_speed(problem.pitch_radius(pulley))
    };
    let powers = (0..problem.pulleys()).map(|pulley| torque(pulley) * speed(pulley));
    let taken = powers.filter(|power| *power > 0.0).sum();
    let turns = (0..problem.pulleys()).all(|pulley| problem.omega(pulley, p) > SLOW);
    LargestLoad {
        factor: top.factor,
        end: match (top.overhangs, top.is_last) {
            (true, _) => LoadEnd::Overhangs(top.pulley),
            (false, true) => LoadEnd::Slips(top.pulley),
            (false, false) => LoadEnd::GrowingSlip(top.pulley),
        },
        driver_torque: -torque(driver),
        power_out: turns.then_some(taken),
        error: top.error,
    }
}
