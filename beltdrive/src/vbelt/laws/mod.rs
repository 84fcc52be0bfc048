//! The way from a drive to its steady state: a start that always converges, then the friction law
//! that was asked for.
//!
//! ```text
//! frictionless guess ──▶ soft bristles ──▶ sliding, ℓ falling: Coulomb
//!                              │    └────▶ bristles of elastic friction ──▶ zones, sliding, ℓ falling: EPP
//!                              ├─────────▶ a gradual plastic rate ──▶ zones, k_f rising: vector EPP
//!                              └─────────▶ the bristles of the drive, κ rising
//! ```
//!
//! A belt of Coulomb or EPP friction that locks on both pulleys of a drive needs none of these: its state is put together
//! from integrals (see `locked`). Bristle friction has no 0/0 and no kink, and Newton's method finds its solution from the
//! guess. Every arrow is one Newton solve where that converges; where it does not, the parameter
//! moves in steps that grow on success and shrink on failure. Solutions on the way are rough. A state of
//! Coulomb or EPP friction that is not found in this way is sought once more with a normalised direction.

mod astray;
mod at_rest;
mod at_slip;
mod epp;
mod finish;
mod locked;
mod normalised;
mod obeyed;
mod raised;
mod sliding;
mod vector;

use super::carried::Carried;
use super::path::{Effort, Path, Solved, Stuck};
use super::zones::Cut;
use super::{BeltProblem, DriveProblem, Guess, Scales};
use crate::{Drive, FrictionLaw, TwoPulleys};
use std::f64::consts::LN_10;

pub(super) use astray::Astray;
use finish::RESOLVED;
pub(super) use obeyed::{ALLOWED, GAINED, obeys_friction, power_gained, wrong_friction};
pub(super) use sliding::WRONG_WAY;
pub(super) use vector::FOLLOWED;

/// Bristle stiffness of the start, κ R/μ: friction is fully developed after a thousandth of a
/// radius of sliding, so that its layers are no finer than those of seating.
const START_STIFFNESS: f64 = 1000.0;
/// How many times as stiff as those of the start bristles are that take the place of Coulomb friction: near the largest
/// load soft ones have no state.
const STIFFER: [f64; 3] = [1.0, 10.0, 100.0];
/// First steps of a homotopy in ln ℓ, ln ε or ln κ: a factor of 10, or of 3 where that failed.
const GREAT_STEP: f64 = LN_10;
const SMALL_STEP: f64 = 1.1;

/// A belt round pulleys whose steady state under a load is asked for.
pub(super) trait Asked {
    /// Its equations.
    type Problem: BeltProblem;

    /// How accurately bristles are solved from nothing.
    const FIRST: Effort;

    /// The drive.
    fn drive(&self) -> &Drive;

    /// The problem with any law, its direction smoothed over the length ℓ/R `lag`.
    fn problem(&self, law: FrictionLaw, lag: f64) -> Self::Problem;

    /// A state nearly without friction.
    fn guess<'p>(&'p self, problem: &'p Self::Problem) -> impl bvp::Guess + 'p;

    /// Its state where the belt locks, from soft bristles, if it is found so; sought first.
    fn locked(&self, _: &mut Path<'_>, _: &Solved<Self::Problem>) -> Option<Solved<Self::Problem>> {
        None
    }

    /// Its state from that of another one near it, with soft bristles, if there is a way to it; sought before the direction is
    /// normalised.
    fn beside(&self, _: &mut Path<'_>, _: &Solved<Self::Problem>) -> Option<Solved<Self::Problem>> {
        None
    }

    /// Its state from that of another one whose load is smaller and whose belt locks, if there is a way to it; sought where the belt
    /// of that which is found with soft bristles passes a place at which it might have come to rest.
    fn raised(&self, _: &mut Path<'_>) -> Option<Solved<Self::Problem>> {
        None
    }

    /// The friction law.
    fn law(&self) -> FrictionLaw {
        self.drive().law
    }

    /// The stiffness κ of the bristles of the start, 1/m, by the largest friction coefficient of a pulley over its radius.
    fn soft(&self) -> f64 {
        let pulleys = self.drive().pulleys.iter();
        let curvatures = pulleys.map(|pulley| pulley.friction_coefficient / pulley.radius);
        START_STIFFNESS * curvatures.fold(0.0, f64::max)
    }

    /// Those bristles.
    fn softest(&self) -> FrictionLaw {
        FrictionLaw::Bristle {
            stiffness: self.soft(),
        }
    }
}

/// A drive at a scaled tight tension.
pub(super) struct AtLoad<'d> {
    pub(super) drive: &'d Drive,
    pub(super) tight: f64,
}

impl Asked for AtLoad<'_> {
    type Problem = DriveProblem;

    const FIRST: Effort = Effort::Final;

    fn drive(&self) -> &Drive {
        self.drive
    }

    fn problem(&self, law: FrictionLaw, lag: f64) -> DriveProblem {
        let drive = TwoPulleys {
            law,
            ..self.drive.pair()
        };
        DriveProblem::new(&drive, Scales::new(&drive), lag).with_tight_tension(self.tight)
    }

    fn guess<'p>(&'p self, problem: &'p DriveProblem) -> impl bvp::Guess + 'p {
        Guess::new(problem)
    }

    fn raised(&self, path: &mut Path<'_>) -> Option<Solved> {
        path.raised_from_locked(self)
    }

    fn beside(&self, path: &mut Path<'_>, bristles: &Solved) -> Option<Solved> {
        let FrictionLaw::Epp { stiffness } = self.law() else {
            return None;
        };
        path.locked_beside(self, stiffness)
            .or_else(|| path.epp_by_carrying_bristles(self, bristles))
    }
}

impl Path<'_> {
    /// The steady state that is asked for, from nothing.
    pub(super) fn seek<A: Asked>(
        &mut self,
        asked: &A,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        if let FrictionLaw::Bristle { stiffness } = asked.law() {
            let rough = self.bristles(asked, stiffness)?;
            return self.with_estimate(rough);
        }
        let start = self.cold(asked, asked.softest(), Effort::Start)?;
        self.sharper(asked, start)
    }

    /// As [`Path::seek`], from a state at the load with a law of [`Path::enter`].
    pub(super) fn seek_from<A: Asked>(
        &mut self,
        asked: &A,
        near: &Solved<A::Problem>,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        let by_this_state = match asked.law() {
            FrictionLaw::Bristle { .. } => return self.with_estimate(near.clone()),
            FrictionLaw::Coulomb => self.sharper_normalised(near.clone()).ok(),
            FrictionLaw::VectorEpp { .. } => self.vector_by_zones(asked, near.clone()).ok(),
            _ => self.epp_by_bristles(asked, near),
        };
        if let Some(solved) = by_this_state {
            return Ok(solved);
        }
        // Soft bristles carry less than Coulomb friction: just below the largest load they have no state.
        let softest = asked.problem(asked.softest(), 0.0);
        match self.attempt(softest.clone(), &Carried(near), Effort::Start) {
            Ok(start) => self.sharper(asked, start),
            Err(cause) => Err(Stuck::before(&softest, near.clone(), cause)),
        }
    }

    /// A state with the law that is asked for or, where that changes abruptly, with one near it that does not:
    /// roughly and with one zone on every pulley, to follow curves of states from it.
    pub(super) fn enter<A: Asked>(
        &mut self,
        asked: &A,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        let start = self.enter_bristles(asked)?;
        match asked.law() {
            FrictionLaw::Coulomb => self.enter_normalised(asked, start),
            FrictionLaw::Epp { .. } => self.stiffen_to_show_zones(asked, start),
            _ => Ok(start),
        }
    }

    /// As [`Path::enter`], with soft bristles in place of Coulomb friction, and such with the limit of EPP friction in
    /// place of that.
    pub(super) fn enter_bristles<A: Asked>(
        &mut self,
        asked: &A,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        if let FrictionLaw::Bristle { stiffness } = asked.law() {
            return self.bristles(asked, stiffness);
        }
        let start = self.cold(asked, asked.softest(), Effort::Start)?;
        match asked.law() {
            FrictionLaw::VectorEpp { .. } => self.enter_vector(asked, &start),
            FrictionLaw::Epp { .. } => self.elastic_bristles(asked, &start, asked.soft()),
            _ => Ok(start),
        }
    }

    /// Bristles for a state that [`Path::enter`] began, if they are found: the softest that carry its load.
    pub(super) fn bristles_near<A: Asked>(
        &mut self,
        asked: &A,
        near: &Solved<A::Problem>,
    ) -> Option<Solved<A::Problem>> {
        let FrictionLaw::Coulomb = asked.law() else {
            return None;
        };
        STIFFER.into_iter().find_map(|stiffer| {
            let stiffness = stiffer * asked.soft();
            let problem = asked.problem(FrictionLaw::Bristle { stiffness }, 0.0);
            self.attempt(problem, &Carried(near), Effort::Start).ok()
        })
    }

    /// Coulomb or EPP friction whose direction is a state from the bristles of [`Path::enter_bristles`], if it is found.
    pub(super) fn with_direction_near<A: Asked>(
        &mut self,
        asked: &A,
        bristles: &Solved<A::Problem>,
    ) -> Option<Solved<A::Problem>> {
        match asked.law() {
            FrictionLaw::Coulomb => self.coulomb(asked, bristles),
            FrictionLaw::Epp { .. } => self.epp_by_bristles(asked, bristles),
            _ => None,
        }
    }

    /// From bristles to Coulomb or EPP friction.
    fn sharper<A: Asked>(
        &mut self,
        asked: &A,
        start: Solved<A::Problem>,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        if let FrictionLaw::VectorEpp { .. } = asked.law() {
            return self.vector(asked, &start);
        }
        let locked = asked.locked(self, &start);
        match locked.or_else(|| self.sliding_or_beside(asked, &start, true)) {
            Some(solved) => Ok(solved),
            None => self.normalised(asked, start),
        }
    }

    /// From bristles to a law whose traction, or its direction, is a state, or else, if asked for, from a state near it. Scalar EPP
    /// friction may have other states if the belt passes a place at which it might have come to rest.
    fn sliding_or_beside<A: Asked>(
        &mut self,
        asked: &A,
        start: &Solved<A::Problem>,
        or_beside: bool,
    ) -> Option<Solved<A::Problem>> {
        let found = match self.sliding(asked, start) {
            None if or_beside => asked.beside(self, start),
            sliding => sliding,
        }?;
        let is_scalar = matches!(asked.law(), FrictionLaw::Epp { .. });
        match is_scalar && Cut::of(&found).passes_rest() {
            true => asked.raised(self).or(Some(found)),
            false => Some(found),
        }
    }

    /// From bristles to Coulomb or EPP friction whose traction, or its direction, is a state.
    fn sliding<A: Asked>(
        &mut self,
        asked: &A,
        start: &Solved<A::Problem>,
    ) -> Option<Solved<A::Problem>> {
        match asked.law() {
            FrictionLaw::Coulomb => self.coulomb(asked, start),
            FrictionLaw::VectorEpp { .. } => self.vector(asked, start).ok(),
            _ => self.epp(asked, start),
        }
    }

    /// A problem from the frictionless guess.
    fn cold<A: Asked>(
        &mut self,
        asked: &A,
        law: FrictionLaw,
        effort: Effort,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        let problem = asked.problem(law, 0.0);
        let guess = asked.guess(&problem);
        self.attempt(problem.clone(), &guess, effort)
            .map_err(|cause| Stuck {
                last: None,
                astray: Astray::of(&problem, &cause),
                cause,
            })
    }

    /// Bristles of a stiffness in 1/m, from nothing or from softer ones.
    fn bristles<A: Asked>(
        &mut self,
        asked: &A,
        stiffness: f64,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        let direct = self.cold(asked, asked.law(), A::FIRST);
        if direct.is_ok() || stiffness <= asked.soft() {
            return direct;
        }
        let start = self.cold(asked, asked.softest(), Effort::Start)?;
        self.with_bristles(start, [asked.soft(), stiffness])
    }

    /// A solution with bristles of one stiffness in 1/m made one with another.
    fn with_bristles<P: BeltProblem>(
        &mut self,
        start: Solved<P>,
        stiffness: [f64; 2],
    ) -> Result<Solved<P>, Stuck<P>> {
        let member = |problem: &P, t: f64| problem.clone().with_bristles(t.exp());
        let range = stiffness.map(f64::ln);
        self.follow(start, range, GREAT_STEP, Effort::Rough, member)
    }
}

impl Path<'_> {
    /// The units of the drive.
    pub(super) fn scales(&self) -> Scales {
        Scales::new(&self.drive.pair())
    }

    /// The scaled slack tension of the drive.
    pub(super) fn slack(&self) -> f64 {
        self.drive.pair().load.slack.value() / self.scales().units.force
    }

    /// The scaled tight tension of the drive.
    pub(super) fn target(&self) -> f64 {
        self.drive.pair().load.tight.value() / self.scales().units.force
    }

    /// The steady state with the law of the drive at the scaled tight tension `tight`, from
    /// nothing.
    pub(super) fn at_load(&mut self, tight: f64) -> Result<Solved, Stuck> {
        let drive = self.drive;
        let asked = AtLoad { drive, tight };
        match self.locked(&asked) {
            Some(solved) => Ok(solved),
            None => self.seek(&asked),
        }
    }

    /// The steady state of a drive with Coulomb or scalar EPP friction whose belt locks on both pulleys, if it is found.
    pub(super) fn at_locked_load(&mut self) -> Option<Solved> {
        let (drive, tight) = (self.drive, self.target());
        self.locked(&AtLoad { drive, tight })
    }

    /// The steady state of a drive with scalar EPP friction from that of a smaller load at which its belt locks, if it is found.
    pub(super) fn raised_to_load(&mut self) -> Option<Solved> {
        let (drive, tight) = (self.drive, self.target());
        AtLoad { drive, tight }.raised(self)
    }

    /// The steady state of a drive with Coulomb or EPP friction with its direction as a state, if it is found.
    pub(super) fn with_direction(&mut self) -> Option<Solved> {
        self.directly(false)
    }

    /// The same, or from a state near it.
    pub(super) fn with_direction_or_beside(&mut self) -> Option<Solved> {
        self.directly(true)
    }

    /// A state with its direction as a state, or else, if asked for, from one near it.
    fn directly(&mut self, or_beside: bool) -> Option<Solved> {
        let (drive, tight) = (self.drive, self.target());
        if let FrictionLaw::Bristle { .. } = drive.law {
            return None;
        }
        let asked = AtLoad { drive, tight };
        self.locked(&asked).or_else(|| {
            let start = self.cold(&asked, asked.softest(), Effort::Start).ok()?;
            self.sliding_or_beside(&asked, &start, or_beside)
        })
    }

    /// The steady state without load, both spans with the scaled tension `tight`. The traction of Coulomb friction
    /// turns the other way round there than bristles show, so that its direction is normalised at once if the belt does not
    /// lock.
    pub(super) fn at_no_load(&mut self, tight: f64) -> Result<Solved, Stuck> {
        let drive = self.drive;
        let FrictionLaw::Coulomb = drive.law else {
            return self.at_load(tight);
        };
        let asked = AtLoad { drive, tight };
        if let Some(solved) = self.locked(&asked) {
            return Ok(solved);
        }
        let start = self.cold(&asked, asked.softest(), Effort::Start)?;
        self.normalised_roughly(&asked, start)
    }

    /// The steady state of the drive, if it is found, with the shortest ℓ or smallest ε that was reached where its
    /// effect is not below the tolerance: good enough to follow a branch from it.
    pub(super) fn start(&mut self) -> Option<Solved> {
        match self.at_load(self.target()) {
            Ok(solved) => Some(solved),
            Err(stuck) => stuck
                .last
                .filter(|last| last.is_resolved(self.drive.law, self.tolerance))
                .map(|last| *last),
        }
    }

    /// The steady state of the drive from that of a neighbouring drive with a law of the same kind,
    /// at the same ℓ or ε and with the same zones.
    pub(super) fn neighbour(&mut self, solved: &Solved) -> Result<Solved, bvp::Error> {
        let drive = self.drive.pair();
        let scales = Scales::with_force(&drive, solved.problem.scales().units.force);
        let problem = DriveProblem::new(&drive, scales, solved.problem.smoothing())
            .with_direction(solved.problem.has_direction())
            .with_laws(|law, _| law.with_onset_of(solved.problem.law()))
            .with_zones(&solved.problem.regimes());
        self.attempt(problem, &Carried(solved), Effort::Final)
    }
}
