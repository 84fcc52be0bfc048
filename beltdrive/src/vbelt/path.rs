//! The way from a drive to its steady state: a start that always converges, then the friction law
//! that was asked for.
//!
//! ```text
//! frictionless guess ──▶ soft bristles ──▶ Coulomb, ε falling
//!                              │              └──▶ EPP blended in, zones, ε falling
//!                              └─────────▶ the bristles of the drive, κ rising
//! ```
//!
//! Bristle friction has no 0/0 and no kink, and Newton's method finds its solution from the
//! guess. Every arrow is one Newton solve where that converges; where it does not, the parameter
//! moves in steps that grow on success and shrink on failure. Solutions on the way are rough.

use super::carried::Carried;
use super::zones::Split;
use super::{ANGLE, DRIVEN, DRIVER, DriveProblem, Guess, Scales};
use crate::{Drive, FrictionLaw};
use bvp::{Function, GlobalError, Options, Scheme, Solution, Stats};
use std::f64::consts::LN_10;

/// Bristle stiffness of the start, κ R/μ: friction is fully developed after a thousandth of a
/// radius of sliding, so that its layers are no finer than those of seating.
const START_STIFFNESS: f64 = 1000.0;
/// Normalisations ε of the slip direction with which Coulomb friction is entered, the first that
/// works: of the order of the largest slip.
const FIRST_EPSILONS: [f64; 3] = [1e-3, 1e-2, 1e-1];
/// ε at which the profile is first resolved to the tolerance.
const RESOLVED_EPSILON: f64 = 1e-7;
/// ε below which slip velocities drown in the rounding of the speeds they are differences of.
const SMALLEST_EPSILON: f64 = 1e-12;
/// The effect of ε may be this share of the tolerance.
const EPSILON_SHARE: f64 = 0.3;
/// First steps of a homotopy in ln ε or ln κ: a factor of 10, or of 3 where that failed.
const GREAT_STEP: f64 = LN_10;
const SMALL_STEP: f64 = 1.1;
/// A solve with at most so many Newton steps lets the next step of a homotopy be twice as long.
const EASY: usize = 8;
/// A homotopy ends when its steps have shrunk to this fraction of the first.
const SHORTEST_STEP: f64 = 0.02;

/// Zones are found anew at most so often; if they still change, the check of the state says so.
const MAX_SPLITS: usize = 8;

/// How accurately a problem is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Effort {
    /// Good enough to be the guess of a neighbour.
    Rough,
    /// As `Rough`, where the slip is too small to be seen by that.
    Careful,
    /// To the tolerance asked for.
    Full,
    /// To the tolerance asked for, with an estimate of the global error.
    Final,
}

/// A problem and its solution.
#[derive(Clone, Debug)]
pub(crate) struct Solved {
    pub(super) problem: DriveProblem,
    pub(super) solution: Solution,
}

impl Solved {
    /// Scaled speed ω₁ of the driven pulley.
    pub(super) fn driven_speed(&self) -> f64 {
        self.solution.parameters()[DriveProblem::DRIVEN_SPEED]
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

    /// The constants of the drive that an engineer reads: speed of the driven pulley, mass flow
    /// and both wraps. Pure numbers of order one.
    fn constants(&self) -> [f64; 4] {
        let p = self.solution.parameters();
        let wrap = |pulley| self.solution.end(self.problem.zones(pulley).end - 1)[ANGLE];
        [
            p[DriveProblem::DRIVEN_SPEED],
            p[DriveProblem::MASS_FLOW],
            wrap(DRIVEN),
            wrap(DRIVER),
        ]
    }
}

/// The way was not found to its end.
#[derive(Debug)]
pub(super) struct Stuck {
    /// The last problem that was solved, if any.
    pub(super) last: Option<Box<Solved>>,
    /// Why the next one was not.
    pub(super) cause: bvp::Error,
}

/// The search for one steady state and what it has cost so far.
pub(super) struct Path<'a> {
    pub(super) drive: &'a Drive,
    pub(super) scales: Scales,
    pub(super) tolerance: f64,
    /// Cost of all problems solved or tried.
    pub(super) stats: Stats,
    /// Number of problems solved or tried.
    pub(super) problems: usize,
    /// Relative effect of the last ε on the constants of the drive.
    pub(super) epsilon_effect: f64,
}

impl<'a> Path<'a> {
    pub(super) fn new(drive: &'a Drive, tolerance: f64) -> Self {
        Self {
            drive,
            scales: Scales::new(drive),
            tolerance,
            stats: Stats::default(),
            problems: 0,
            epsilon_effect: 0.0,
        }
    }

    /// The drive with another friction law, at the scaled tight tension `tight`.
    fn problem(&self, law: FrictionLaw, epsilon: f64, tight: f64) -> DriveProblem {
        let drive = Drive {
            law,
            ..self.drive.clone()
        };
        DriveProblem::new(&drive, self.scales, epsilon).with_tight_tension(tight)
    }

    /// Solves one problem from a guess.
    pub(super) fn attempt(
        &mut self,
        problem: DriveProblem,
        guess: &dyn bvp::Guess,
        effort: Effort,
    ) -> Result<Solved, bvp::Error> {
        let (tolerance, stages, max_newton_steps) = match effort {
            Effort::Rough => (self.tolerance.max(1e-2), 4, 16),
            Effort::Careful => (self.tolerance.max(1e-4), 5, 16),
            Effort::Full | Effort::Final => (self.tolerance, 6, 30),
        };
        let options = Options {
            tolerance,
            scheme: Scheme::Gauss { stages },
            // Of a solve from the guess: a better first mesh saves Newton steps where one problem
            // is all there is.
            initial_intervals: if effort == Effort::Final { 40 } else { 16 },
            max_newton_steps,
            // A shorter step of the homotopy is a better answer to a failure than a finer mesh.
            retries: 0,
            global_error: match effort {
                Effort::Final => GlobalError::HalvedMesh,
                _ => GlobalError::Skip,
            },
            ..Options::default()
        };
        self.problems += 1;
        let outcome = bvp::solve(&problem, guess, &options);
        let cost = match &outcome {
            Ok(solution) => Some(solution.stats()),
            Err(error) => error.best().map(Solution::stats),
        };
        self.stats += cost.copied().unwrap_or_default();
        outcome.map(|solution| Solved { problem, solution })
    }

    /// Follows the family `member(t)` from its solved member at t = `from` to the one at `to`, in
    /// steps that double when they are easy and shrink when they fail.
    pub(super) fn follow(
        &mut self,
        start: Solved,
        [from, to]: [f64; 2],
        first_step: f64,
        effort: Effort,
        member: impl Fn(&DriveProblem, f64) -> DriveProblem,
    ) -> Result<Solved, Stuck> {
        let (mut here, mut t, mut step) = (start, from, first_step);
        while t != to {
            let next = if (to - t).abs() <= 1.2 * step {
                to
            } else {
                t + step.copysign(to - t)
            };
            match self.attempt(member(&here.problem, next), &Carried(&here), effort) {
                Ok(solved) => {
                    if solved.solution.stats().newton_steps <= EASY {
                        step *= 2.0;
                    }
                    let zoned = solved.problem.is_split();
                    here = if zoned {
                        self.split_zones(solved, effort)?
                    } else {
                        solved
                    };
                    t = next;
                }
                Err(cause) => {
                    step = 0.4 * (next - t).abs();
                    if step < SHORTEST_STEP * first_step {
                        let last = Some(Box::new(here));
                        return Err(Stuck { last, cause });
                    }
                }
            }
        }
        Ok(here)
    }

    /// The steady state with the law of the drive at the scaled tight tension `tight`, from
    /// nothing.
    pub(super) fn at_load(&mut self, tight: f64) -> Result<Solved, Stuck> {
        let radius = self.drive.driver_radius.min(self.drive.driven_radius);
        let soft = START_STIFFNESS * self.drive.friction_coefficient / radius;
        let bristles =
            |path: &Self, stiffness| path.problem(FrictionLaw::Bristle { stiffness }, 0.0, tight);
        let FrictionLaw::Bristle { stiffness } = self.drive.law else {
            let start = self.cold(bristles(self, soft), Effort::Rough)?;
            let coulomb = self.enter_coulomb(start, tight)?;
            if let FrictionLaw::Coulomb = self.drive.law {
                let sharp = self.lower_epsilon(coulomb, RESOLVED_EPSILON)?;
                return self.finish(sharp);
            }
            return self
                .enter_epp(coulomb.clone(), tight)
                .and_then(|epp| self.lower_epsilon(epp, RESOLVED_EPSILON))
                .or_else(|_| {
                    let sharp = self.lower_epsilon(coulomb, RESOLVED_EPSILON)?;
                    self.enter_epp(sharp, tight)
                })
                .and_then(|epp| self.finish(epp));
        };
        if let Ok(solved) = self.cold(bristles(self, stiffness), Effort::Final) {
            return Ok(solved);
        }
        let start = self.cold(bristles(self, soft), Effort::Rough)?;
        let range = [soft.ln(), stiffness.ln()];
        let member = |problem: &DriveProblem, t: f64| problem.clone().with_bristles(t.exp());
        let stiffer = self.follow(start, range, GREAT_STEP, Effort::Rough, member)?;
        self.finish(stiffer)
    }

    /// The steady state of the drive from that of a neighbouring drive with a law of the same kind,
    /// at the same ε and with the same zones.
    pub(super) fn neighbour(&mut self, solved: &Solved) -> Result<Solved, bvp::Error> {
        self.scales = Scales::with_force(self.drive, solved.problem.scales().force);
        let zones = [DRIVEN, DRIVER].map(|pulley| {
            let segments = solved.problem.zones(pulley);
            segments
                .map(|i| solved.problem.regime(i))
                .collect::<Vec<_>>()
        });
        let problem = DriveProblem::new(self.drive, self.scales, solved.problem.epsilon())
            .with_zones(&zones[DRIVEN], &zones[DRIVER]);
        self.attempt(problem, &Carried(solved), Effort::Final)
    }

    /// Solves a problem from the frictionless guess.
    fn cold(&mut self, problem: DriveProblem, effort: Effort) -> Result<Solved, Stuck> {
        let guess = Guess::new(&problem);
        let mut parameters = vec![0.0; bvp::Problem::parameters(&problem)];
        guess.parameters(&mut parameters);
        let start = Function {
            state: |segment: usize, s: f64, y: &mut [f64]| guess.state(segment, s, y),
            parameters,
        };
        self.attempt(problem.clone(), &start, effort)
            .map_err(|cause| Stuck { last: None, cause })
    }

    /// Solves the same problem again, with more effort.
    pub(super) fn again(&mut self, solved: Solved, effort: Effort) -> Result<Solved, Stuck> {
        self.attempt(solved.problem.clone(), &Carried(&solved), effort)
            .map_err(|cause| Stuck {
                last: Some(Box::new(solved)),
                cause,
            })
    }

    /// From bristles to Coulomb friction with a large ε.
    fn enter_coulomb(&mut self, start: Solved, tight: f64) -> Result<Solved, Stuck> {
        let [first, others @ ..] = FIRST_EPSILONS;
        let coulomb = |path: &Self, epsilon| path.problem(FrictionLaw::Coulomb, epsilon, tight);
        let mut outcome = self.attempt(coulomb(self, first), &Carried(&start), Effort::Rough);
        for epsilon in others {
            if outcome.is_err() {
                outcome = self.attempt(coulomb(self, epsilon), &Carried(&start), Effort::Rough);
            }
        }
        outcome.map_err(|cause| Stuck {
            last: Some(Box::new(start)),
            cause,
        })
    }

    /// From Coulomb to EPP friction at the same ε: its share grows, then its zones become segments.
    fn enter_epp(&mut self, start: Solved, tight: f64) -> Result<Solved, Stuck> {
        let epp = self.problem(self.drive.law, start.problem.epsilon(), tight);
        // With no share of it the law only adds the displacement.
        let unblended = self
            .attempt(
                epp.clone().with_epp_weight(0.0),
                &Carried(&start),
                Effort::Rough,
            )
            .map_err(|cause| Stuck {
                last: Some(Box::new(start)),
                cause,
            })?;
        let member = |_: &DriveProblem, share| epp.clone().with_epp_weight(share);
        let blended = self.follow(unblended, [0.0, 1.0], 1.0, Effort::Rough, member)?;
        self.split_zones(blended, Effort::Rough)
    }

    /// Solves EPP friction with its zones as segments, until every zone is of the kind it was
    /// taken for.
    fn split_zones(&mut self, solved: Solved, effort: Effort) -> Result<Solved, Stuck> {
        let mut here = solved;
        for _ in 0..MAX_SPLITS {
            let Some(split) = Split::of(&here) else {
                break;
            };
            let outcome = self.attempt(split.problem(&here), &split.guess(&here), effort);
            here = match outcome {
                Ok(solved) => solved,
                Err(cause) => {
                    let last = Some(Box::new(here));
                    return Err(Stuck { last, cause });
                }
            };
        }
        Ok(here)
    }

    /// Solves to the tolerance, and lowers ε until its effect is below that.
    pub(super) fn finish(&mut self, rough: Solved) -> Result<Solved, Stuck> {
        if let FrictionLaw::Bristle { .. } = self.drive.law {
            return self.again(rough, Effort::Final);
        }
        let mut here = self.again(rough, Effort::Final)?;
        here = self.split_zones(here, Effort::Final)?;
        loop {
            let epsilon = here.problem.epsilon();
            let range = [epsilon.ln(), (0.1 * epsilon).ln()];
            let finer = self.follow(here.clone(), range, GREAT_STEP, Effort::Full, with_epsilon)?;
            let constants = here.constants().into_iter().zip(finer.constants());
            let change = constants
                .map(|(a, b)| (a - b).abs() / (1.0 + b.abs()))
                .fold(0.0, f64::max);
            // The effect vanishes at least as fast as ε: ten ninths of the change were that of
            // the larger ε, one ninth is that of the smaller.
            self.epsilon_effect = change / 0.9;
            if self.epsilon_effect <= EPSILON_SHARE * self.tolerance {
                return self.with_estimate(here);
            }
            self.epsilon_effect = change / 9.0;
            if self.epsilon_effect <= EPSILON_SHARE * self.tolerance || epsilon <= SMALLEST_EPSILON
            {
                return self.with_estimate(finer);
            }
            here = finer;
        }
    }

    /// A solution with an estimate of its global error.
    fn with_estimate(&mut self, solved: Solved) -> Result<Solved, Stuck> {
        match solved.solution.error_estimate() {
            Some(_) => Ok(solved),
            None => self.again(solved, Effort::Final),
        }
    }

    /// Lowers ε roughly in great steps, or carefully in small ones where the slip is too small for
    /// that.
    fn lower_epsilon(&mut self, start: Solved, epsilon: f64) -> Result<Solved, Stuck> {
        let from = start.problem.epsilon().ln();
        let fallback = start.clone();
        let range = [from, epsilon.ln()];
        self.follow(start, range, GREAT_STEP, Effort::Rough, with_epsilon)
            .or_else(|_| self.follow(fallback, range, SMALL_STEP, Effort::Careful, with_epsilon))
    }
}

/// The same problem with the slip normalised by ε = eᵗ.
fn with_epsilon(problem: &DriveProblem, t: f64) -> DriveProblem {
    problem.clone().with_epsilon(t.exp())
}
