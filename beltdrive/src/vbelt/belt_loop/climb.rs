//! The states of a loop as its load rises, followed by continuation in the factor on all torques, to a load
//! that is asked for or to where no state carries more.

use super::super::BeltProblem;
use super::super::carried::Carried;
use super::super::groove::Law;
use super::super::laws::FOLLOWED;
use super::super::path::{Effort, Solved};
use super::super::piece::{FINER, WHOLE};
use super::levelling::Levelling;
use super::pieces::{Lost, Place, ROUGH};
use super::problem::LoopProblem;
use super::slipping::Slipping;
use super::solve::Search;
use super::stiffening::{Judge, is_followed};
use crate::SolveError;
use crate::results::difficulty;
use continuation::Point;
use std::f64::consts::FRAC_PI_2;

/// A limit is known to this share of the tolerance of the states: at a limit point the error of a state changes the load
/// in second order. With tolerances of 1e-3 and 1e-4, limits of two V-belts with bristles and three with Coulomb
/// friction are off by 4e-5 of the tolerance and less, against 1e-7.
const OF_LIMIT: f64 = 1e-2;

/// ε of Coulomb friction with which a limit is found once more, from the last state below it: friction is too small by
/// about ε²/2 of the slip squared. With 10⁻³, the largest load of a small pulley was 3 % too low.
pub(super) const SHARPER: f64 = 1e-4;

/// The ε with which loads are sought that are below the limit without ε and above that with [`SHARPER`]: there were
/// 0.9 % between the two on a loop with a small pulley.
const STILL_SHARPER: [f64; 3] = [SHARPER, 1e-5, 1e-6];
/// States below a limit from which sharper friction is tried, in turn: the last one may be too near.
const LOWER: usize = 4;

/// Factor between loads up to which that of a state is raised in turn.
pub(super) const DOUBLED: f64 = 2.0;
/// Largest load factor that is tried: beyond it the torques are but rounding errors of the driver's.
pub(super) const LARGEST_FACTOR: f64 = 1e9;

/// The half of the power of vector EPP friction with which a limit is found at last: with 16 limits at which the belt overhangs
/// are 1e-3 too low, with 64 1e-4.
const SHARPEST: i32 = 64;
/// Share of the change by friction that is [`FINER`] times as sharp that is left of the effect then.
const LEFT_BY_SHARPER: f64 = WHOLE - 1.0;
/// Relative error of a limit with vector EPP friction as sharp as it is followed with: it is up to 1.4 % too low.
const BLUNT: f64 = 0.02;
/// Relative error of a limit with softer friction than that of the loop: one of two pulleys was 6 % too low.
const SOFTENED: f64 = 0.1;

/// Where a climb ends.
pub(super) enum Climbed {
    /// At the load that was asked for.
    Reached(Box<Solved<LoopProblem>>),
    /// At the largest load.
    Limit(Box<Limit>),
    /// It was not followed farther than to this factor.
    Lost { reached: f64, cause: &'static str },
}

/// The end of a climb at the largest load.
pub(super) struct Limit {
    pub(super) top: Top,
    /// The last state, at the largest load but for a share of it that is not shown.
    pub(super) at: Solved<LoopProblem>,
    /// The states on the way, in order.
    pub(super) below: Vec<Solved<LoopProblem>>,
}

/// The largest load of a loop.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Top {
    /// The factor on all torques.
    pub(crate) factor: f64,
    /// The pulley that slips, or where the belt overhangs.
    pub(crate) pulley: usize,
    /// Whether the belt overhangs itself there instead of slipping.
    pub(crate) overhangs: bool,
    /// Whether there is no state under more load, or else a pulley that slips ever more.
    pub(crate) is_last: bool,
    /// Estimated error of the factor, relative.
    pub(crate) error: f64,
}

impl Top {
    /// Whether the same ends the load.
    pub(super) fn ends_as(&self, other: &Self) -> bool {
        let end = |top: &Self| (top.overhangs, top.is_last);
        end(self) == end(other)
    }
}

/// Relative accuracy of a limit of the equations as they are, if states are solved to this tolerance.
pub(crate) fn limit_accuracy(tolerance: f64) -> f64 {
    OF_LIMIT * tolerance.max(ROUGH)
}

/// What a law adds to the relative error of a limit of its curve: nothing, but for vector EPP friction, which is followed
/// without zones.
pub(super) fn without_zones(law: Law) -> f64 {
    match law {
        Law::Vector { onset, .. } if onset.sharpness < FOLLOWED => SOFTENED,
        Law::Vector { .. } => BLUNT,
        _ => 0.0,
    }
}

impl Search<'_> {
    /// How far all torques of a state can be raised until a pulley slips grossly: from the state itself if the direction
    /// of its friction is a state, and where that is not followed to its end from a rough one; `None` if that is not at
    /// all, or farther than anything that was tried, or if the end may not be the largest load.
    pub(super) fn load_limit(
        &mut self,
        state: &Solved<LoopProblem>,
        rough: impl FnOnce(&mut Self) -> Option<Solved<LoopProblem>>,
    ) -> Option<Top> {
        if self.drive.is_idle() {
            return None;
        }
        if is_followed(state)
            && let Ok(top) = self.limit_from(state, state.clone())
        {
            return top;
        }
        let rough = rough(self)?;
        self.limit_from(state, rough).ok().flatten()
    }

    /// The same from one solution of a state.
    fn limit_from(
        &mut self,
        state: &Solved<LoopProblem>,
        begin: Solved<LoopProblem>,
    ) -> Result<Option<Top>, SolveError> {
        let problem = begin.problem.with_torques(state.solution.parameters());
        let mut slipping = Slipping::judged(Judge::LimitPointOrSlip);
        let begin = Solved { problem, ..begin };
        let found = self.rise(&begin, DOUBLED, LARGEST_FACTOR, Some(&mut slipping))?;
        let largest = found.filter(|(limit, _)| limit.is_largest());
        Ok(largest.map(|(mut limit, from)| {
            self.without_bristles(&mut limit, &from, Judge::LimitPointOrSlip);
            limit.top
        }))
    }

    /// The limit of the curve on which the load of a state is raised, up to a factor on all torques, and the state from
    /// which the last climb to it began; `None` if there is none up to there. A climb goes from one power of `times` the
    /// load to the next.
    pub(super) fn rise(
        &mut self,
        from: &Solved<LoopProblem>,
        times: f64,
        largest: f64,
        mut slipping: Option<&mut Slipping>,
    ) -> Result<Option<(Limit, Solved<LoopProblem>)>, SolveError> {
        let (mut here, mut to) = (from.clone(), times * from.factor());
        while to < largest {
            match self.climb(&here, to, slipping.as_deref_mut()) {
                Climbed::Reached(solved) => here = *solved,
                Climbed::Limit(limit) => return Ok(Some((*limit, here))),
                Climbed::Lost { reached, cause } => {
                    return Err(SolveError::Unreached { reached, cause });
                }
            }
            to *= times;
        }
        Ok(None)
    }

    /// Raises the load from a state to a factor on all torques, above that of the state; near the largest load with
    /// sharper friction, if it is a vector that sets in gradually or its direction is normalised. With what is known of the curve before, it ends where a
    /// pulley begins to slip grossly if no limit point comes, else nowhere before a limit point.
    pub(super) fn climb(
        &mut self,
        from: &Solved<LoopProblem>,
        to: f64,
        mut slipping: Option<&mut Slipping>,
    ) -> Climbed {
        let mut climbed = self.climb_as_it_is(from, to, slipping.as_deref_mut());
        let mut before = Vec::new();
        while let Climbed::Limit(blunt) = &mut climbed
            && blunt.top.is_last
            && let Some(begin) = self.sharper_below(&blunt.below)
        {
            let mut next = self.climb_as_it_is(&begin, to, slipping.as_deref_mut());
            match &mut next {
                Climbed::Reached(_) => {}
                Climbed::Lost { .. } => break,
                Climbed::Limit(sharp) => {
                    let factors = [blunt.top.factor, sharp.top.factor];
                    if let Some(error) = self.error_by_sharper(begin.problem.law(), factors) {
                        sharp.top.error = error;
                    }
                    before.append(&mut blunt.below);
                }
            }
            climbed = next;
        }
        if let Climbed::Limit(limit) = &mut climbed {
            before.append(&mut limit.below);
            limit.below = before;
        }
        climbed
    }

    /// The relative error of a limit or a largest torque with a law, from the one with a blunter law before it, if they are vector
    /// EPP friction.
    pub(super) fn error_by_sharper(&self, law: Law, [blunt, sharp]: [f64; 2]) -> Option<f64> {
        let Law::Vector { .. } = law else {
            return None;
        };
        let change = (sharp / blunt - 1.0).abs();
        Some(limit_accuracy(self.tolerance) + LEFT_BY_SHARPER * change)
    }

    /// The highest of some states of a curve with sharper friction, if its end is found with that.
    pub(super) fn sharper_below<P: BeltProblem>(
        &mut self,
        below: &[Solved<P>],
    ) -> Option<Solved<P>> {
        let mut highest = below.iter().rev().take(LOWER);
        highest.find_map(|state| self.sharper_at_end(state))
    }

    /// A state of a curve with sharper friction than along it, if its end is found with that and the state is found.
    fn sharper_at_end<P: BeltProblem>(&mut self, state: &Solved<P>) -> Option<Solved<P>> {
        match state.problem.law() {
            Law::Vector { onset, .. } if (FOLLOWED..SHARPEST).contains(&onset.sharpness) => {
                let finer = state.problem.clone().with_laws(|law, _| law.finer(FINER));
                self.attempt(finer, &Carried(state), Effort::Rough).ok()
            }
            Law::Vector { .. } => None,
            _ if state.problem.smoothing() > SHARPER => {
                let sharper = self.smooth_less(state.clone(), SHARPER, Effort::Rough);
                sharper.ok()
            }
            _ => None,
        }
    }

    /// The state under a load beyond a limit that an ε of its own brings about, with a smaller one.
    pub(super) fn climb_sharper(&mut self, limit: Limit, to: f64) -> Option<Solved<LoopProblem>> {
        let mut below = limit.below;
        for epsilon in STILL_SHARPER {
            let mut highest = below.iter().rev().take(LOWER);
            let sharper = highest.find_map(|state| {
                let sharper = self.smooth_less(state.clone(), epsilon, Effort::Rough);
                sharper.ok()
            })?;
            match self.climb_as_it_is(&sharper, to, None) {
                Climbed::Reached(reached) => return Some(*reached),
                Climbed::Limit(limit) => below = limit.below,
                Climbed::Lost { .. } => return None,
            }
        }
        None
    }

    /// As [`Search::climb`], with the same ε.
    fn climb_as_it_is(
        &mut self,
        from: &Solved<LoopProblem>,
        to: f64,
        mut slipping: Option<&mut Slipping>,
    ) -> Climbed {
        let moving: Vec<_> = (0..from.problem.pulleys())
            .filter(|&pulley| pulley != from.problem.driver)
            .filter_map(|pulley| Some((pulley, from.problem.unknowns.rim_speeds[pulley]?)))
            .collect();
        let watched: Vec<_> = moving.iter().map(|&(_, index)| index).collect();
        let (mut levelling, mut below) = (Levelling::default(), Vec::new());
        let mut reached = from.factor();
        let error = limit_accuracy(self.tolerance) + without_zones(from.problem.law());
        let climbed = self.along(from, [0.0, to], &watched, |search, place, point, here| {
            let factor = point.lambda();
            let top = match place {
                Place::LimitPoint => Some((factor, most_slowed(&here, point))),
                Place::Zero(index) => Some((factor, (moving[index].0, false))),
                Place::Way => levelling
                    .top(point, factor)
                    .map(|factor| (factor, most_slowed(&here, point))),
                Place::End => {
                    return Some(match search.at_point(here) {
                        Ok(solved) => Climbed::Reached(Box::new(solved)),
                        Err(cause) => Climbed::Lost {
                            reached,
                            cause: difficulty::of_solver(&cause),
                        },
                    });
                }
            };
            if let Some(slipping) = slipping.as_deref_mut()
                && slipping.ends(&here, top.is_some())
            {
                return Some(Climbed::Limit(Box::new(search.gross_slip(slipping, from))));
            }
            if let Some((factor, (pulley, overhangs))) = top {
                let top = Top {
                    factor,
                    pulley,
                    overhangs,
                    is_last: true,
                    error,
                };
                let (at, below) = (here, std::mem::take(&mut below));
                return Some(Climbed::Limit(Box::new(Limit { top, at, below })));
            }
            reached = factor;
            below.push(here);
            None
        });
        climbed.unwrap_or_else(|Lost { reached, cause }| Climbed::Lost { reached, cause })
    }
}

/// What ends the load at a limit point: where the belt overhangs, or the pulley that slips, whose speed falls most against
/// that of the belt; and whether it overhangs.
fn most_slowed(solved: &Solved<LoopProblem>, point: &Point) -> (usize, bool) {
    let problem = &solved.problem;
    let p = solved.solution.parameters();
    let moved = &point.tangent[point.tangent.len() - p.len()..];
    let slowed = (0..problem.pulleys()).filter_map(|pulley| {
        let index = problem.unknowns.rim_speeds[pulley]?;
        Some(((moved[index] / p[index]).abs(), pulley))
    });
    let (_, slips) = slowed.fold(
        (0.0, 0),
        |most, next| if next.0 > most.0 { next } else { most },
    );
    let ends = solved.round(|round| round.end_angles());
    let steep = ends.iter().position(|ends| ends.exit.abs() > FRAC_PI_2);
    (steep.unwrap_or(slips), steep.is_some())
}
