//! The way from a drive to its steady state: a start that always converges, then the friction law
//! that was asked for.
//!
//! ```text
//! frictionless guess ──▶ soft bristles ──▶ sliding, ℓ falling: Coulomb
//!                              │    └────▶ bristles of elastic friction ──▶ zones, sliding, ℓ falling: EPP
//!                              └─────────▶ the bristles of the drive, κ rising
//! ```
//!
//! Bristle friction has no 0/0 and no kink, and Newton's method finds its solution from the
//! guess. Every arrow is one Newton solve where that converges; where it does not, the parameter
//! moves in steps that grow on success and shrink on failure. Solutions on the way are rough. A state of
//! Coulomb or EPP friction that is not found in this way is sought once more with a normalised direction.

mod epp;
mod finish;
mod normalised;
mod sliding;

use super::carried::Carried;
use super::path::{Effort, Path, Solved, Stuck};
use super::{DriveProblem, Scales};
use crate::FrictionLaw;
use std::f64::consts::LN_10;

pub(super) use finish::{EFFECT_SHARE, RESOLVED, SMALLEST};
pub(super) use normalised::FIRST_EPSILONS;

/// Bristle stiffness of the start, κ R/μ: friction is fully developed after a thousandth of a
/// radius of sliding, so that its layers are no finer than those of seating.
pub(super) const START_STIFFNESS: f64 = 1000.0;
/// First steps of a homotopy in ln ℓ, ln ε or ln κ: a factor of 10, or of 3 where that failed.
pub(super) const GREAT_STEP: f64 = LN_10;
pub(super) const SMALL_STEP: f64 = 1.1;

impl Path<'_> {
    /// The steady state with the law of the drive at the scaled tight tension `tight`, from
    /// nothing.
    pub(super) fn at_load(&mut self, tight: f64) -> Result<Solved, Stuck> {
        if let FrictionLaw::Bristle { stiffness } = self.drive.law {
            return self.bristles(stiffness, tight);
        }
        let soft = FrictionLaw::Bristle {
            stiffness: self.soft(),
        };
        let start = self.cold(self.problem(soft, 0.0, tight), Effort::Start)?;
        let follows = match (self.has_direction, self.drive.law) {
            (true, FrictionLaw::Coulomb) => self.coulomb(&start, tight),
            (true, _) => self.epp(&start, tight),
            (false, _) => None,
        };
        match follows {
            Some(solved) => Ok(solved),
            None => self.normalised(start, tight),
        }
    }

    /// The stiffness κ of the bristles of the start, 1/m.
    fn soft(&self) -> f64 {
        let radius = self.drive.driver_radius.min(self.drive.driven_radius);
        START_STIFFNESS * self.drive.friction_coefficient / radius
    }

    /// Bristles of a stiffness in 1/m, from nothing or from softer ones.
    fn bristles(&mut self, stiffness: f64, tight: f64) -> Result<Solved, Stuck> {
        let problem = |path: &Self, stiffness| {
            let law = FrictionLaw::Bristle { stiffness };
            path.problem(law, 0.0, tight)
        };
        if let Ok(solved) = self.cold(problem(self, stiffness), Effort::Final) {
            return Ok(solved);
        }
        let start = self.cold(problem(self, self.soft()), Effort::Start)?;
        let stiffer = self.with_bristles(start, [self.soft(), stiffness])?;
        self.finish(stiffer)
    }

    /// A solution with bristles of one stiffness in 1/m made one with another.
    fn with_bristles(&mut self, start: Solved, stiffness: [f64; 2]) -> Result<Solved, Stuck> {
        let member = |problem: &DriveProblem, t: f64| problem.clone().with_bristles(t.exp());
        let range = stiffness.map(f64::ln);
        self.follow(start, range, GREAT_STEP, Effort::Rough, member)
    }

    /// The steady state as by [`Path::at_load`], but with the shortest ℓ or smallest ε that was reached where its
    /// effect is not below the tolerance: good enough to follow a branch from it.
    pub(super) fn start(&mut self, tight: f64) -> Result<Solved, Stuck> {
        match self.at_load(tight) {
            Err(Stuck {
                last: Some(last), ..
            }) if last.is_resolved(self.drive.law, self.tolerance) => Ok(*last),
            outcome => outcome,
        }
    }

    /// The steady state of the drive from that of a neighbouring drive with a law of the same kind,
    /// at the same ℓ or ε and with the same zones.
    pub(super) fn neighbour(&mut self, solved: &Solved) -> Result<Solved, bvp::Error> {
        self.scales = Scales::with_force(self.drive, solved.problem.scales().units.force);
        let problem = DriveProblem::new(self.drive, self.scales, solved.problem.smoothing())
            .with_direction(solved.problem.has_direction())
            .with_zones(solved.problem.regimes());
        self.attempt(problem, &Carried(solved), Effort::Final)
    }
}
