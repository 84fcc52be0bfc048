//! The way from a loop to its steady state: a start that converges, then the friction law that was asked
//! for, as on a drive with two pulleys.
//!
//! ```text
//! frictionless guess ──▶ soft bristles ──▶ Coulomb, ε falling
//!          │                    │                └──▶ EPP blended in, ε falling
//!          │                    └─────────▶ the bristles of the loop, κ rising
//!          └───────────▶ the bristles of the loop
//! ```

use super::super::laws::{
    EFFECT_SHARE, FIRST_EPSILONS, GREAT_STEP, RESOLVED, SMALL_STEP, SMALLEST, START_STIFFNESS,
};
use super::super::path::{EASY, Effort};
use super::super::steps::Steps;
use super::guess::LoopGuess;
use super::problem::{LoopProblem, Target};
use super::solve::{Search, Solved};
use crate::FrictionLaw;
use crate::drive::layout::Layout;

/// A loop under a share of its load, before it is solved.
pub(super) struct Start<'s> {
    pub(super) layout: &'s Layout,
    pub(super) target: Target,
    /// Tractive tensions of the spans without creep, N.
    pub(super) tractive: Vec<f64>,
    /// Coordinate of the tensioner, rad or m.
    pub(super) coordinate: f64,
    /// The share of the load.
    pub(super) factor: f64,
}

impl Start<'_> {
    /// Whether the belt pulls in all spans.
    pub(super) fn is_taut(&self) -> bool {
        self.tractive.iter().all(|&tension| tension > 0.0)
    }
}

impl Search<'_> {
    /// The state with the law of the loop, roughly and from nothing. Coulomb friction still has a large ε.
    pub(super) fn rough(&mut self, start: &Start<'_>) -> Result<Solved, bvp::Error> {
        let pulleys = self.belt_loop.pulleys.iter();
        let softest = pulleys.map(|pulley| pulley.friction_coefficient / pulley.radius);
        let soft = START_STIFFNESS * softest.fold(0.0, f64::max);
        if let FrictionLaw::Bristle { stiffness } = self.belt_loop.law {
            return self.bristles(start, stiffness, soft);
        }
        let soft = self.cold(start, soft)?;
        let mut outcome = self.enter_coulomb(&soft, start, FIRST_EPSILONS[0]);
        for epsilon in &FIRST_EPSILONS[1..] {
            if outcome.is_err() {
                outcome = self.enter_coulomb(&soft, start, *epsilon);
            }
        }
        let coulomb = outcome?;
        match self.belt_loop.law {
            FrictionLaw::Epp { .. } => {
                let blended = self.enter_epp(&coulomb, start);
                blended
                    .and_then(|blended| self.lower_epsilon(blended))
                    .or_else(|_| {
                        let sharp = self.lower_epsilon(coulomb)?;
                        self.enter_epp(&sharp, start)
                    })
            }
            _ => Ok(coulomb),
        }
    }

    /// The state to the tolerance, from a rough one.
    pub(super) fn sharpen(&mut self, rough: Solved) -> Result<Solved, bvp::Error> {
        match self.belt_loop.law {
            FrictionLaw::Coulomb => {
                let sharp = self.lower_epsilon(rough)?;
                self.finish(sharp)
            }
            _ => self.finish(rough),
        }
    }

    /// The bristles of the loop from nothing, or from softer ones.
    fn bristles(
        &mut self,
        start: &Start<'_>,
        stiffness: f64,
        soft: f64,
    ) -> Result<Solved, bvp::Error> {
        let direct = self.cold(start, stiffness);
        if direct.is_ok() || stiffness <= soft {
            return direct;
        }
        let softer = self.cold(start, soft)?;
        let range = [soft.ln(), stiffness.ln()];
        let stiffer = |problem: &LoopProblem, t: f64| problem.clone().with_bristles(t.exp());
        self.follow(softer, range, GREAT_STEP, Effort::Rough, stiffer)
    }

    /// Newton's method from the frictionless guess, with bristles of a stiffness in 1/m, on a coarse mesh: two
    /// thirds of the time of a mesh that could be the final one.
    fn cold(&mut self, start: &Start<'_>, stiffness: f64) -> Result<Solved, bvp::Error> {
        let problem = self.problem(start, FrictionLaw::Bristle { stiffness }, 0.0);
        let guess = LoopGuess::new(&problem, &start.tractive, start.coordinate);
        self.attempt(problem.clone(), &guess, Effort::Start)
    }

    fn problem(&self, start: &Start<'_>, law: FrictionLaw, epsilon: f64) -> LoopProblem {
        let belt_loop = self.belt_loop;
        let force = start.tractive.iter().copied().fold(0.0, f64::max);
        let units = super::super::Units::new(&belt_loop.belt, belt_loop.rim_speed(), force);
        let problem = LoopProblem::new(belt_loop, start.layout, units, start.target, law, epsilon);
        problem.with_factor(start.factor)
    }

    /// From bristles to Coulomb friction with a large ε.
    fn enter_coulomb(
        &mut self,
        soft: &Solved,
        start: &Start<'_>,
        epsilon: f64,
    ) -> Result<Solved, bvp::Error> {
        let problem = self.problem(start, FrictionLaw::Coulomb, epsilon);
        self.attempt(problem, &OtherLaw(soft), Effort::Rough)
    }

    /// From Coulomb to EPP friction at the same ε, by growing its share, across its kinks: the mesh resolves
    /// them.
    fn enter_epp(&mut self, coulomb: &Solved, start: &Start<'_>) -> Result<Solved, bvp::Error> {
        let epp = self.problem(start, self.belt_loop.law, coulomb.problem.epsilon());
        // With no share of it the law only adds the displacement.
        let unblended = epp.clone().with_epp_weight(0.0);
        let unblended = self.attempt(unblended, &OtherLaw(coulomb), Effort::Rough)?;
        let member = |_: &LoopProblem, share: f64| epp.clone().with_epp_weight(share);
        self.follow(unblended, [0.0, 1.0], 1.0, Effort::Rough, member)
    }

    /// Lowers ε roughly in great steps, or carefully in small ones where the slip is too small for that.
    fn lower_epsilon(&mut self, solved: Solved) -> Result<Solved, bvp::Error> {
        let to = RESOLVED;
        self.with_epsilon(solved.clone(), to, GREAT_STEP, Effort::Rough)
            .or_else(|_| self.with_epsilon(solved, to, SMALL_STEP, Effort::Careful))
    }

    /// The state with another ε.
    fn with_epsilon(
        &mut self,
        from: Solved,
        epsilon: f64,
        first_step: f64,
        effort: Effort,
    ) -> Result<Solved, bvp::Error> {
        let range = [from.problem.epsilon().ln(), epsilon.ln()];
        let member = |problem: &LoopProblem, t: f64| problem.clone().with_epsilon(t.exp());
        self.follow(from, range, first_step, effort, member)
    }

    /// Follows the family `member(t)` from its solved member at the beginning of a range of t to the one at
    /// its end.
    fn follow(
        &mut self,
        from: Solved,
        range: [f64; 2],
        first_step: f64,
        effort: Effort,
        member: impl Fn(&LoopProblem, f64) -> LoopProblem,
    ) -> Result<Solved, bvp::Error> {
        let (mut here, mut steps) = (from, Steps::new(range, first_step));
        while let Some(next) = steps.next() {
            match self.attempt(member(&here.problem, next), &here.solution, effort) {
                Ok(solved) => {
                    steps.solved(next, solved.solution.stats().newton_steps <= EASY);
                    here = solved;
                }
                Err(cause) => {
                    if !steps.failed(next) {
                        return Err(cause);
                    }
                }
            }
        }
        Ok(here)
    }

    /// Solves to the tolerance, and lowers ε until its effect is below that.
    fn finish(&mut self, rough: Solved) -> Result<Solved, bvp::Error> {
        let mut here = self.attempt(rough.problem, &rough.solution, Effort::Final)?;
        if let FrictionLaw::Bristle { .. } = self.belt_loop.law {
            return Ok(here);
        }
        loop {
            let epsilon = here.problem.epsilon();
            let finer = self.with_epsilon(here.clone(), 0.1 * epsilon, GREAT_STEP, Effort::Full)?;
            let pairs = here
                .solution
                .parameters()
                .iter()
                .zip(finer.solution.parameters());
            let change = pairs
                .map(|(a, b)| (a - b).abs() / (1.0 + b.abs()))
                .fold(0.0, f64::max);
            // The effect vanishes at least as fast as ε: ten ninths of the change were that of the larger
            // ε, one ninth is that of the smaller.
            self.epsilon_effect = change / 0.9;
            if self.epsilon_effect <= EFFECT_SHARE * self.tolerance {
                return Ok(here);
            }
            self.epsilon_effect = change / 9.0;
            here = self.attempt(finer.problem, &finer.solution, Effort::Final)?;
            if self.epsilon_effect <= EFFECT_SHARE * self.tolerance || epsilon <= SMALLEST {
                return Ok(here);
            }
        }
    }
}

/// A solution as the guess of one with another friction law: states and parameters that the law does not have
/// are left out, states that it adds begin at zero.
struct OtherLaw<'a>(&'a Solved);

impl bvp::Guess for OtherLaw<'_> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let solution = &self.0.solution;
        let known = solution.segments()[segment].states;
        let mut states = [0.0; super::super::MAX_STATES];
        solution.state(segment, s, &mut states[..known]);
        let own = self.0.problem.mechanical_states(segment);
        let last = y.len() - 1;
        y.fill(0.0);
        y[..own].copy_from_slice(&states[..own]);
        y[last] = states[known - 1];
    }

    fn parameters(&self, p: &mut [f64]) {
        let known = self.0.solution.parameters();
        let common = known.len().min(p.len());
        p[..common].copy_from_slice(&known[..common]);
        let slackest = self.0.with_ends(|at, p| self.0.problem.slackest(at, p));
        p[common..].fill(slackest);
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        bvp::Guess::mesh(&self.0.solution)
    }
}
