//! The states of a loop as its load rises, followed by continuation in the factor on all torques, to a load
//! that is asked for or to where no state carries more.

use super::super::BeltProblem;
use super::super::groove::{Law, Regime};
use super::super::path::{Effort, Solved};
use super::super::piece::{ACCURACY, ACCURACY_OF_DIRECTION};
use super::super::zones::Cut;
use super::levelling::Levelling;
use super::problem::LoopProblem;
use super::rising::Rising;
use super::slipping::Slipping;
use super::solve::Search;
use super::stiffening::Judge;
use super::unknowns::FLOW;
use crate::SolveError;
use crate::results::difficulty;
use bvp::{Control, Family, Options, Problem, Scheme, Solution};
use continuation::{Branch, Direction, Kind, Point};
use std::f64::consts::FRAC_PI_2;

/// Tolerance of the states on the way, which are only guesses of those to come, ...
const ROUGH: f64 = 1e-4;
/// ... and where meshes are for their error, as with bristles: these are half as fine as for the defect and the rating of
/// `spb-fan` takes half the time. With 1e-4 two curves with stiff bristles in it were lost, and two of `kim2009`.
const ROUGH_ERROR: f64 = 3e-5;
/// A limit is known to this share of the tolerance of the states: at a limit point the error of a state changes the load
/// in second order. With tolerances of 1e-3 and 1e-4, limits of two V-belts with bristles and three with Coulomb
/// friction are off by 4e-5 of the tolerance and less, against 1e-7.
const OF_LIMIT: f64 = 1e-2;

/// The most mesh intervals: a point that needs more is approached by a shorter step. Four times as many found no more
/// limits on five loops, and took 31 s in place of 3 s to find none with elastic friction on four grooves.
const MAX_INTERVALS: usize = 1000;
/// The most steps of a piece, and the most pieces.
const STEPS: usize = 300;
const MAX_PIECES: usize = 40;
/// Where zones have changed on the way to a limit point the step is taken again with steps divided by this, at most so
/// often.
const REFINEMENT: f64 = 4.0;
const MAX_REFINEMENTS: i32 = 4;
const ABRUPT: &str = "the states change too abruptly there to be followed";

/// ε of Coulomb friction with which a limit is found once more, from the last state below it: friction is too small by
/// about ε²/2 of the slip squared. With 10⁻³, the largest load of a small pulley was 3 % too low.
pub(super) const SHARPER: f64 = 1e-4;

/// The ε with which loads are sought that are below the limit without ε and above that with [`SHARPER`]: there were
/// 0.9 % between the two on a loop with a small pulley.
const STILL_SHARPER: [f64; 3] = [SHARPER, 1e-5, 1e-6];
/// States below a limit from which a smaller ε is tried, in turn: the last one may be too near.
const LOWER: usize = 4;

/// Factor between loads up to which that of a state is raised in turn.
const DOUBLED: f64 = 2.0;
/// Largest load factor that is tried: beyond it the torques are but rounding errors of the driver's.
pub(super) const LARGEST_FACTOR: f64 = 1e9;

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

impl Search<'_> {
    /// How far all torques of a state can be raised until a pulley slips grossly: from the state itself if the direction
    /// of its friction is a state, and where that is not followed to its end from a rough one; `None` if that is not at
    /// all, or farther than anything that was tried.
    pub(super) fn load_limit(
        &mut self,
        state: &Solved<LoopProblem>,
        rough: Option<Solved<LoopProblem>>,
    ) -> Option<Top> {
        if self.drive.is_idle() {
            return None;
        }
        if state.problem.has_direction()
            && let Ok(top) = self.limit_from(state, state.clone())
        {
            return top;
        }
        self.limit_from(state, rough?).ok().flatten()
    }

    /// The same from one solution of a state.
    fn limit_from(
        &mut self,
        state: &Solved<LoopProblem>,
        begin: Solved<LoopProblem>,
    ) -> Result<Option<Top>, SolveError> {
        let problem = begin.problem.with_torques(state.solution.parameters());
        let mut slipping = Slipping::default();
        let begin = Solved { problem, ..begin };
        let found = self.rise(&begin, DOUBLED, LARGEST_FACTOR, Some(&mut slipping))?;
        Ok(found.map(|(mut limit, from)| {
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

    /// Raises the load from a state to a factor on all torques, above that of the state; near the largest load with a
    /// smaller ε, if the direction of friction is normalised. With what is known of the curve before, it ends where a
    /// pulley begins to slip grossly if no limit point comes, else nowhere before a limit point.
    pub(super) fn climb(
        &mut self,
        from: &Solved<LoopProblem>,
        to: f64,
        mut slipping: Option<&mut Slipping>,
    ) -> Climbed {
        match self.climb_as_it_is(from, to, slipping.as_deref_mut()) {
            Climbed::Limit(mut blunt) if blunt.top.is_last => {
                let last = blunt.below.last();
                let Some(last) = last.filter(|last| last.problem.smoothing() > SHARPER) else {
                    return Climbed::Limit(blunt);
                };
                let sharper = self.smooth_less(last.clone(), SHARPER, Effort::Rough);
                match sharper.map(|sharper| self.climb_as_it_is(&sharper, to, slipping)) {
                    Err(_) | Ok(Climbed::Lost { .. }) => Climbed::Limit(blunt),
                    Ok(Climbed::Limit(mut sharp)) => {
                        blunt.below.append(&mut sharp.below);
                        sharp.below = blunt.below;
                        Climbed::Limit(sharp)
                    }
                    Ok(climbed) => climbed,
                }
            }
            climbed => climbed,
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

    /// As [`Search::climb`], with the same ε, in pieces on which the zones of friction stay the same.
    fn climb_as_it_is(
        &mut self,
        from: &Solved<LoopProblem>,
        to: f64,
        slipping: Option<&mut Slipping>,
    ) -> Climbed {
        let mut way = Way {
            from,
            to,
            slipping,
            below: Vec::new(),
            refused: None,
        };
        let (mut here, mut refinements) = (from.clone(), 0);
        for _ in 0..MAX_PIECES {
            let reached = here.factor();
            match self.piece(&here, &mut way, refinements) {
                Piece::Ends(climbed) => return climbed,
                Piece::Shorter(last) if refinements < MAX_REFINEMENTS => {
                    (here, refinements) = (*last, refinements + 1);
                }
                Piece::Shorter(_) => return lost(reached, ABRUPT),
                Piece::Changes(state) => match self.keep_zones(*state, Effort::Full) {
                    Ok(next) => {
                        let cut = Cut::of(&next);
                        way.refused = (!cut.is_kept()).then(|| cut.regimes());
                        (here, refinements) = (next, 0);
                    }
                    Err(stuck) => return lost(reached, difficulty::of_solver(&stuck.cause)),
                },
            }
        }
        lost(here.factor(), ABRUPT)
    }

    /// A piece of a climb.
    fn piece(
        &mut self,
        from: &Solved<LoopProblem>,
        way: &mut Way<'_, '_>,
        refinements: i32,
    ) -> Piece {
        let begin = from.factor();
        let free = from.problem.clone().with_unknown_factor();
        let unknown = Problem::parameters(&free) - 1;
        let options = on_the_way(self.tolerance, free.law());
        let guess = WithFactor {
            solution: &from.solution,
            factor: begin,
        };
        let to = way.to;
        let (mut curve, z) = match Family::new(&free, unknown, &[], &guess, &options) {
            Ok((family, z)) => (Rising(family), z),
            Err(error) => return Piece::lost(begin, difficulty::of_solver(&error)),
        };
        let branch_options = followed([begin.min(0.0), to], &options, free.law(), refinements);
        let direction = Direction::Increasing;
        let mut branch = match Branch::new(&mut curve, &z, direction, &branch_options) {
            Ok(branch) => branch,
            Err(error) => return Piece::lost(begin, difficulty::of_branch(&error)),
        };
        let moving: Vec<_> = (0..free.pulleys())
            .filter_map(|pulley| Some((pulley, free.unknowns.speeds[pulley]?)))
            .collect();
        let lengths = match free.has_junctions() {
            true => free.first_length()..free.first_length() + free.zoning().count(),
            false => 0..0,
        };
        for index in moving.iter().map(|&(_, index)| index).chain(lengths) {
            branch = branch.event(move |_, point| point.z[point.z.len() - 1 - unknown + index]);
        }
        let (mut reached, mut levelling) = (begin, Levelling::default());
        let mut before: Option<Solved<LoopProblem>> = None;
        while let Some(point) = branch.next() {
            let factor = point.lambda();
            let solution = || branch.system().solution(&point.z);
            let here = || Solved {
                problem: free.clone().with_factor(point.lambda()),
                solution: solution(),
            };
            let error = limit_accuracy(self.tolerance);
            let limit = |factor, slips: Option<usize>, below: Vec<_>| {
                let at = here();
                let of_curve = || most_slowed(&at, &point);
                let (pulley, overhangs) = slips.map_or_else(of_curve, |pulley| (pulley, false));
                let top = Top {
                    factor,
                    pulley,
                    overhangs,
                    is_last: true,
                    error,
                };
                Piece::Ends(Climbed::Limit(Box::new(Limit { top, at, below })))
            };
            let is_turn = point.kind == Kind::LimitPoint;
            let stands = |index: usize| (index < moving.len()).then(|| moving[index].0);
            if is_turn || matches!(point.kind, Kind::Event(index) if stands(index).is_some()) {
                // A zone may have changed on the way there.
                if let Some(last) = &before
                    && !way.is_kept(&here())
                {
                    return Piece::Shorter(Box::new(last.clone()));
                }
            }
            let below = |way: &mut Way<'_, '_>| std::mem::take(&mut way.below);
            match point.kind {
                Kind::LimitPoint => return limit(factor, None, below(way)),
                Kind::Event(index) => {
                    return match stands(index) {
                        Some(pulley) => limit(factor, Some(pulley), below(way)),
                        None => Piece::Changes(Box::new(here())),
                    };
                }
                Kind::Bound if factor == to => {
                    let solution = solution();
                    self.stats.newton_steps += solution.stats().newton_steps;
                    let problem = free.clone().with_factor(to);
                    let guess = WithFactor {
                        solution: &solution,
                        factor: to,
                    };
                    return match self.attempt(problem, &guess, Effort::Rough) {
                        Ok(solved) => Piece::Ends(Climbed::Reached(Box::new(solved))),
                        Err(cause) => Piece::lost(reached, difficulty::of_solver(&cause)),
                    };
                }
                _ => {
                    let here = here();
                    if !way.is_kept(&here) {
                        return Piece::Changes(Box::new(here));
                    }
                    if let Some(factor) = levelling.top(&point, factor) {
                        return limit(factor, None, below(way));
                    }
                    if let Some(slipping) = way.slipping.as_deref_mut()
                        && slipping.has_slowed(&here)
                    {
                        let slip = self.gross_slip(slipping, way.from);
                        return Piece::Ends(Climbed::Limit(Box::new(slip)));
                    }
                    reached = factor;
                    before = Some(here.clone());
                    way.below.push(here);
                }
            }
        }
        Piece::lost(reached, ABRUPT)
    }
}

/// What a climb has to keep in mind from piece to piece.
struct Way<'w, 's> {
    /// Where it began.
    from: &'w Solved<LoopProblem>,
    /// The factor to which it leads.
    to: f64,
    slipping: Option<&'s mut Slipping>,
    /// The states on the way, in order.
    below: Vec<Solved<LoopProblem>>,
    /// Zones that the first state of a piece shows and Newton's method refused.
    refused: Option<Vec<Vec<Regime>>>,
}

impl Way<'_, '_> {
    /// Whether the zones of a state are its segments, if they have to be.
    fn is_kept(&self, here: &Solved<LoopProblem>) -> bool {
        if !here.problem.has_junctions() {
            return true;
        }
        let cut = Cut::of(here);
        cut.is_kept() || self.refused.as_ref() == Some(&cut.regimes())
    }
}

/// How a piece of a climb ends.
enum Piece {
    /// With the climb.
    Ends(Climbed),
    /// At a state whose zones are others.
    Changes(Box<Solved<LoopProblem>>),
    /// Behind a state from which it is to be followed in shorter steps.
    Shorter(Box<Solved<LoopProblem>>),
}

impl Piece {
    fn lost(reached: f64, cause: &'static str) -> Self {
        Self::Ends(lost(reached, cause))
    }
}

fn lost(reached: f64, cause: &'static str) -> Climbed {
    Climbed::Lost { reached, cause }
}

/// How states on the way are solved with a law, if the final tolerance is this. Beside a kink of elastic friction the defect
/// shows what an error does not: twice as many curves with it are lost on meshes for the error.
pub(super) fn on_the_way(tolerance: f64, law: Law) -> Options {
    let (control, rough) = match law {
        Law::Bristle { elastic: None, .. } | Law::Sliding { elastic: None, .. } => {
            (Control::Error, ROUGH_ERROR)
        }
        _ => (Control::Defect, ROUGH),
    };
    Options {
        tolerance: tolerance.max(rough),
        scheme: Some(Scheme::Gauss { stages: 5 }),
        control,
        max_intervals: MAX_INTERVALS,
        ..Options::default()
    }
}

/// How a curve of states that are solved with these options is followed within bounds, its steps shortened so often.
pub(super) fn followed(
    [low, high]: [f64; 2],
    options: &Options,
    law: Law,
    refinements: i32,
) -> continuation::Options {
    let usual = continuation::Options::within(low, high);
    let shorter = REFINEMENT.powi(refinements);
    let accuracy = match law {
        Law::Sliding { .. } => ACCURACY_OF_DIRECTION,
        _ => ACCURACY,
    };
    continuation::Options {
        steps: STEPS,
        first_step: usual.first_step / shorter,
        largest_step: usual.largest_step / shorter,
        accuracy: accuracy * options.tolerance,
        ..usual
    }
}

/// What ends the load at a limit point: where the belt overhangs, or the pulley that slips, whose speed falls most against
/// that of the belt; and whether it overhangs.
fn most_slowed(solved: &Solved<LoopProblem>, point: &Point) -> (usize, bool) {
    let problem = &solved.problem;
    let p = solved.solution.parameters();
    let moved = &point.tangent[point.tangent.len() - p.len()..];
    let of_belt = moved[FLOW] / p[FLOW];
    let touched = (0..problem.pulleys()).filter(|&pulley| !problem.is_idle(pulley));
    let slowed = touched.map(|pulley| {
        let of_pulley = problem.unknowns.speeds[pulley].map(|index| moved[index]);
        let of_pulley = of_pulley.unwrap_or(0.0) / problem.omega(pulley, p);
        ((of_pulley - of_belt).abs(), pulley)
    });
    let (_, slips) = slowed.fold(
        (0.0, 0),
        |most, next| if next.0 > most.0 { next } else { most },
    );
    let ends = solved.round(|round| round.end_angles());
    let steep = ends.iter().position(|ends| ends.exit.abs() > FRAC_PI_2);
    (steep.unwrap_or(slips), steep.is_some())
}

/// A solution as the guess of a problem with or without the factor as its last parameter.
struct WithFactor<'a> {
    solution: &'a Solution,
    factor: f64,
}

impl bvp::Guess for WithFactor<'_> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        self.solution.state(segment, s, y);
    }

    fn parameters(&self, p: &mut [f64]) {
        let known = self.solution.parameters();
        let common = known.len().min(p.len());
        p[..common].copy_from_slice(&known[..common]);
        p[common..].fill(self.factor);
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        bvp::Guess::mesh(self.solution)
    }
}
