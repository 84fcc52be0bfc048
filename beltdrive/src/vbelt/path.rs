//! Steps on the way to a steady state: solving one problem from a guess, and following a family of
//! problems from a solved member to the one that is wanted. What the families are is in `laws`.

use super::carried::Carried;
use super::laws::Astray;
use super::steps::Steps;
use super::zones::Cut;
use super::{BeltProblem, DRIVEN, DRIVER, DriveProblem, Law};
use crate::{Drive, FrictionLaw, TraceConvergence};
use bvp::{Control, Options, Scheme, Solution, Stats};

/// A solve with at most so many Newton steps lets the next step of a homotopy be twice as long.
pub(super) const EASY: usize = 8;
/// Mesh intervals that a rough solution may have, unless its guess has more.
const ROUGH_INTERVALS: usize = 500;
/// Mesh intervals that a solution may have whose error is estimated. With 10 000 the estimate was out of reach
/// for 2 of 20 elastic-plastic drives that hardly slip.
const FINAL_INTERVALS: usize = 40_000;
/// Mesh intervals that one may have with a shorter ℓ that only shows whether friction pulls with the slip because it lags behind. Of
/// 590 random drives at light loads two have more than 740, and are found with this, too; where the traction is a wrong one the
/// mesh grows with every shorter ℓ: with 40 000 the limit of one drive takes 65 s in place of 13 s.
const LAGGING_INTERVALS: usize = 1_000;
/// Mesh intervals that one may have whose error is estimated only where that costs little.
const LIGHT_INTERVALS: usize = 4_000;

/// How accurately a problem is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Effort {
    /// As `Rough`, from a guess that is no neighbour: with patience.
    Start,
    /// Good enough to be the guess of a neighbour.
    Rough,
    /// As `Rough`, where the slip is too small to be seen by that.
    Careful,
    /// To the tolerance asked for.
    Full,
    /// The same on a mesh for the error: where the belt hardly slips its slip has no digit left by which a defect of its
    /// direction could be told, and none that matters.
    Close,
    /// The same, to see whether friction lags behind the slip.
    Lagging,
    /// To the tolerance asked for, with an estimate of the global error.
    Final,
    /// As `Final`, where that costs little.
    Light,
}

impl Effort {
    /// Whether it is only good enough on the way.
    pub(super) fn is_rough(self) -> bool {
        matches!(self, Self::Start | Self::Rough | Self::Careful)
    }

    /// How a problem is solved with it, if the final tolerance is this.
    pub(super) fn options(self, tolerance: f64) -> Options {
        let (tolerance, stages, max_newton_steps) = match self {
            Self::Start => (tolerance.max(1e-2), 4, 40),
            Self::Rough => (tolerance.max(1e-2), 4, 16),
            Self::Careful => (tolerance.max(1e-4), 5, 16),
            Self::Full | Self::Close | Self::Lagging | Self::Final | Self::Light => {
                (tolerance, 6, 30)
            }
        };
        Options {
            tolerance,
            scheme: Some(Scheme::Gauss { stages }),
            // Of a solve from the guess: a better first mesh saves Newton steps where one problem
            // is all there is.
            initial_intervals: if self == Self::Final { 40 } else { 16 },
            max_newton_steps,
            // A rough solution that needs more is none: the step to it was too long.
            max_intervals: match self {
                Self::Rough | Self::Careful => ROUGH_INTERVALS,
                Self::Start | Self::Full => Options::default().max_intervals,
                Self::Close | Self::Final => FINAL_INTERVALS,
                Self::Lagging => LAGGING_INTERVALS,
                Self::Light => LIGHT_INTERVALS,
            },
            // A shorter step of the homotopy is a better answer to a failure than a finer mesh, and another load than a start that
            // fails: with two retries the same states and limits of 240 random drives are found, and one more of a belt pressed by 5.8
            // times what its groove carries at rest; 12 loads of 30 times the slack tension are refused with scalar EPP friction in 29 s
            // in place of 7.6 s, without link-time optimisation.
            retries: 0,
            control: match self {
                Self::Final | Self::Light => Control::Both,
                Self::Close | Self::Lagging => Control::Error,
                _ => Control::Defect,
            },
            ..Options::default()
        }
    }
}

/// Which meshes are for the error alone of states whose friction slides and whose belt sticks nowhere; the others are for the
/// defect. Where the belt sticks at rest, speeds are off by more than the estimate tells, and friction may be seen to pull with the
/// slip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ForError {
    /// None.
    Never,
    /// Those of answers. Speeds, torques, losses and wraps of the drive of Kim (2009) have the errors from 102 to 8000 N that they have
    /// on meshes for the defect, of 99 intervals in place of 61 at 700 N.
    Answers,
    /// All that are not rough: of branches, of which nothing is told but points, whose meshes are for the error, too. With meshes for
    /// the defect in the states with which the pieces of branches begin, limits of 140 Coulomb drives take a sixth more time.
    All,
}

impl ForError {
    /// Whether such a state with this effort is one of them.
    fn holds(self, effort: Effort) -> bool {
        match self {
            Self::Never => false,
            Self::Answers => effort == Effort::Final,
            Self::All => matches!(effort, Effort::Full | Effort::Final),
        }
    }
}

/// A problem and its solution.
#[derive(Clone, Debug)]
pub(crate) struct Solved<P = DriveProblem> {
    pub(super) problem: P,
    pub(super) solution: Solution,
}

impl Solved {
    /// Scaled speed ω₁ of the driven pulley.
    pub(super) fn driven_speed(&self) -> f64 {
        self.problem.omega(DRIVEN, self.solution.parameters())
    }

    /// Scaled tight tension, prescribed or found.
    pub(super) fn tight_tension(&self) -> f64 {
        self.problem.tight_tension(self.solution.parameters())
    }

    /// Scaled contact length of the driver.
    pub(super) fn driver_length(&self) -> f64 {
        self.problem
            .contact_length(DRIVER, self.solution.parameters())
    }
}

impl<P: BeltProblem> Solved<P> {
    /// States where the belt enters a pulley.
    pub(super) fn entry(&self, pulley: usize) -> &[f64] {
        self.solution.start(self.problem.zones(pulley).start)
    }

    /// States where the belt leaves a pulley.
    pub(super) fn exit(&self, pulley: usize) -> &[f64] {
        self.solution.end(self.problem.zones(pulley).end - 1)
    }

    /// Whether it is solved to a tolerance with a law whose direction is smoothed.
    pub(super) fn is_resolved(&self, law: FrictionLaw, tolerance: f64) -> bool {
        let here = self.problem.law();
        let follows = match here {
            Law::Normalised { .. } => true,
            Law::Sliding { lead, .. } => lead > 0.0,
            Law::Vector { .. } => self.problem.is_split(),
            Law::Bristle { .. } => false,
        };
        let same = match (law, here.elastic()) {
            (FrictionLaw::Coulomb | FrictionLaw::VectorEpp { .. }, None) => follows,
            (FrictionLaw::Epp { .. }, Some(elastic)) => follows && elastic.weight == 1.0,
            _ => false,
        };
        let error = self.solution.error_estimate();
        same && error.unwrap_or(self.solution.defect()) <= tolerance
    }

    /// The constants that an engineer reads: pure numbers of order one.
    pub(super) fn constants(&self) -> Vec<f64> {
        self.problem.constants(&self.solution)
    }

    /// The largest change from these constants to others, as a share of 1 + |value|.
    pub(super) fn change_to(&self, others: &[f64]) -> f64 {
        let pairs = self.constants().into_iter().zip(others);
        pairs
            .map(|(one, other)| (one - other).abs() / (1.0 + other.abs()))
            .fold(0.0, f64::max)
    }
}

/// The way was not found to its end.
#[derive(Debug)]
pub(super) struct Stuck<P = DriveProblem> {
    /// The last problem that was solved, if any.
    pub(super) last: Option<Box<Solved<P>>>,
    /// Why the next one was not.
    pub(super) cause: bvp::Error,
    /// Where it went astray.
    pub(super) astray: Astray,
}

impl<P: BeltProblem> Stuck<P> {
    /// Stuck on the way on from a solved problem to one with the same zones.
    pub(super) fn after(last: Solved<P>, cause: bvp::Error) -> Self {
        let astray = Astray::of(&last.problem, &cause);
        let last = Some(Box::new(last));
        Self {
            last,
            cause,
            astray,
        }
    }

    /// Stuck on the way on from a solved problem to one with other zones.
    pub(super) fn before(problem: &P, last: Solved<P>, cause: bvp::Error) -> Self {
        let astray = Astray::of(problem, &cause);
        let last = Some(Box::new(last));
        Self {
            last,
            cause,
            astray,
        }
    }
}

/// Mesh intervals of a guess; none if it has no mesh.
fn intervals(guess: &dyn bvp::Guess) -> usize {
    let mesh = guess.mesh().unwrap_or_default();
    mesh.iter().map(|nodes| nodes.len() - 1).sum()
}

/// The search for one steady state of a drive or a loop, and what it has cost so far.
pub(super) struct Path<'a> {
    pub(super) drive: &'a Drive,
    pub(super) tolerance: f64,
    /// Cost of all problems solved or tried.
    pub(super) stats: Stats,
    /// Number of problems solved or tried.
    pub(super) problems: usize,
    /// Relative effect of the last ℓ or ε on the constants of the drive.
    pub(super) smoothing_effect: f64,
    /// Which meshes of states whose friction slides are for the error alone.
    pub(super) for_error: ForError,
    /// The largest scaled tight tension under which a state is known, to which a limit below it is none; zero at first.
    pub(super) reached: f64,
    /// Whether the load of the drive was raised in vain from one at which its belt locks.
    pub(super) was_raised_in_vain: bool,
}

impl<'a> Path<'a> {
    pub(super) fn new(drive: &'a Drive, tolerance: f64) -> Self {
        Self {
            drive,
            tolerance,
            stats: Stats::default(),
            problems: 0,
            smoothing_effect: 0.0,
            for_error: ForError::Never,
            reached: 0.0,
            was_raised_in_vain: false,
        }
    }

    /// The same of states from which branches are followed.
    pub(super) fn of_branch(drive: &'a Drive, tolerance: f64) -> Self {
        Self::new(drive, tolerance).with_meshes(ForError::All)
    }

    /// The same with these meshes for the error alone.
    pub(super) fn with_meshes(self, for_error: ForError) -> Self {
        Self { for_error, ..self }
    }

    /// Counts a problem that was solved or tried.
    pub(super) fn count(&mut self, outcome: &Result<Solution, bvp::Error>) {
        let cost = match outcome {
            Ok(solution) => Some(solution.stats()),
            Err(error) => error.best().map(Solution::stats),
        };
        self.problems += 1;
        self.stats += cost.copied().unwrap_or_default();
    }

    /// Counts a branch that was followed, its states as problems.
    pub(super) fn count_trace(&mut self, trace: &TraceConvergence) {
        self.problems += trace.continuation_steps;
        self.stats.newton_steps += trace.newton_iterations;
        self.stats.rhs_evaluations += trace.rhs_evaluations;
        self.stats.factorisations += trace.factorisations;
    }

    /// The effort with which a problem is solved for one that is asked for.
    fn made_for_error<P: BeltProblem>(&self, problem: &P, effort: Effort) -> Effort {
        match problem.law() {
            Law::Sliding { .. } if self.for_error.holds(effort) && !problem.sticks() => {
                Effort::Close
            }
            _ => effort,
        }
    }

    /// Whether a solution is what an effort with an estimate of the error would find.
    pub(super) fn is_solved_with<P: BeltProblem>(
        &self,
        solved: &Solved<P>,
        effort: Effort,
    ) -> bool {
        let within = |size: f64| size <= self.tolerance;
        let solution = &solved.solution;
        let has_mesh = match self.made_for_error(&solved.problem, effort) {
            Effort::Close => true,
            Effort::Final => within(solution.defect()),
            _ => false,
        };
        has_mesh && solution.error_estimate().is_some_and(within)
    }

    /// Solves one problem from a guess.
    pub(super) fn attempt<P: BeltProblem>(
        &mut self,
        problem: P,
        guess: &dyn bvp::Guess,
        effort: Effort,
    ) -> Result<Solved<P>, bvp::Error> {
        let effort = self.made_for_error(&problem, effort);
        let known = intervals(guess);
        let mut options = effort.options(self.tolerance);
        options.max_intervals = options.max_intervals.max(known);
        // Only guesses that know the state have a mesh.
        options.from_neighbour = known > 0;
        let outcome = bvp::solve(&problem, guess, &options);
        self.count(&outcome);
        outcome.map(|solution| Solved { problem, solution })
    }

    /// A solution corrected once, for another problem near by: to first order the solution of that.
    pub(super) fn corrected<P: BeltProblem>(
        &mut self,
        solved: &Solved<P>,
        problem: &P,
    ) -> Result<Solution, bvp::Error> {
        let outcome = solved.solution.corrected(problem);
        self.count(&outcome);
        outcome
    }

    /// Follows the family `member(t)` from its solved member at the beginning of a range of t to the one
    /// at its end.
    pub(super) fn follow<P: BeltProblem>(
        &mut self,
        start: Solved<P>,
        range: [f64; 2],
        first_step: f64,
        effort: Effort,
        member: impl Fn(&P, f64) -> P,
    ) -> Result<Solved<P>, Stuck<P>> {
        self.follow_to(start, range, first_step, [effort; 2], member)
    }

    /// The same with one effort on the way and another one for the last step, if the end is found with that; its zones are those
    /// shown before it then.
    pub(super) fn follow_to<P: BeltProblem>(
        &mut self,
        start: Solved<P>,
        range: [f64; 2],
        first_step: f64,
        [effort, last]: [Effort; 2],
        member: impl Fn(&P, f64) -> P,
    ) -> Result<Solved<P>, Stuck<P>> {
        let (mut here, mut steps) = (start, Steps::new(range, first_step));
        while let Some(next) = steps.next() {
            let problem = member(&here.problem, next);
            if next == range[1]
                && last != effort
                && let Ok(end) = self.onward(&here, problem.clone(), last)
            {
                return Ok(end);
            }
            match self.onward(&here, problem, effort) {
                Ok(solved) => {
                    steps.solved(next, solved.solution.stats().newton_steps <= EASY);
                    here = match effort.is_rough() && next != range[1] {
                        true => solved,
                        false => self.keep_zones(solved, effort)?,
                    };
                }
                Err(cause) => {
                    if !steps.failed(next) {
                        return Err(Stuck::after(here, cause));
                    }
                }
            }
        }
        Ok(here)
    }

    /// Solves a neighbouring problem, with the zones that a solution shows if it is found with them. Another solution for the zones
    /// alone is saved so on the way.
    fn onward<P: BeltProblem>(
        &mut self,
        here: &Solved<P>,
        problem: P,
        effort: Effort,
    ) -> Result<Solved<P>, bvp::Error> {
        if problem.has_junctions() {
            let cut = Cut::of(here);
            if !cut.is_kept()
                && let Ok(solved) = self.attempt(cut.apply(problem.clone()), &cut, effort)
            {
                return Ok(solved);
            }
        }
        self.attempt(problem, &Carried(here), effort)
    }

    /// Solves the same problem again, with more effort.
    pub(super) fn again<P: BeltProblem>(
        &mut self,
        solved: Solved<P>,
        effort: Effort,
    ) -> Result<Solved<P>, Stuck<P>> {
        self.attempt(solved.problem.clone(), &Carried(&solved), effort)
            .map_err(|cause| Stuck::after(solved, cause))
    }
}
