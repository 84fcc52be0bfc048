//! Coulomb and EPP friction with a normalised direction, for drives whose state is not found with a direction
//! of its own: loads at which the slip of the turn just changes its sense (within 0.03 % on the drive of Kim 2009), stiff
//! belts without load, and some of elastic friction.

use super::finish::with_smoothing;
use super::{Asked, RESOLVED, SMALL_STEP};
use crate::FrictionLaw;
use crate::vbelt::BeltProblem;
use crate::vbelt::carried::Carried;
use crate::vbelt::path::{Effort, Path, Solved, Stuck};

/// Normalisations ε of the slip direction with which friction is entered, the first that
/// works: of the order of the largest slip.
const FIRST_EPSILONS: [f64; 3] = [1e-3, 1e-2, 1e-1];

impl Path<'_> {
    /// The law of the drive with a normalised direction.
    pub(super) fn normalised<A: Asked>(
        &mut self,
        asked: &A,
        start: Solved<A::Problem>,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        self.normalised_to(asked, start, Self::finish)
    }

    /// Coulomb friction with a smaller ε, to the tolerance.
    pub(super) fn sharper_normalised<P: BeltProblem>(
        &mut self,
        entered: Solved<P>,
    ) -> Result<Solved<P>, Stuck<P>> {
        let sharp = self.lower_epsilon(entered, RESOLVED)?;
        self.finish(sharp)
    }

    /// The law of the drive with a normalised direction and the smallest ε that is reached where its effect is not
    /// below the tolerance, with an estimate of the error where that costs little.
    pub(super) fn normalised_roughly<A: Asked>(
        &mut self,
        asked: &A,
        start: Solved<A::Problem>,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        self.normalised_to(asked, start, |path, sharp| {
            let solved = match path.resolve(sharp) {
                Err(Stuck {
                    last: Some(last), ..
                }) if last.is_resolved(asked.law(), path.tolerance) => *last,
                outcome => outcome?,
            };
            let estimated = path.again(solved.clone(), Effort::Light);
            Ok(estimated.unwrap_or(solved))
        })
    }

    fn normalised_to<A: Asked>(
        &mut self,
        asked: &A,
        start: Solved<A::Problem>,
        finish: impl Fn(&mut Self, Solved<A::Problem>) -> Result<Solved<A::Problem>, Stuck<A::Problem>>,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        let entered = self.enter_normalised(asked, start)?;
        if let FrictionLaw::Coulomb = asked.law() {
            let sharp = self.lower_epsilon(entered, RESOLVED)?;
            return finish(self, sharp);
        }
        let zones = self.epp_by_zones(asked, &entered);
        zones
            .and_then(|sharp| finish(self, sharp))
            .or_else(|stuck| {
                let other = self.epp_at_last(asked, &entered);
                let other = other.and_then(|sharp| finish(self, sharp));
                self.farther(asked.law(), stuck, other)
            })
            .or_else(|stuck| {
                let other = self.epp_as_a_whole(asked, &entered);
                let other = other.and_then(|sharp| finish(self, sharp));
                self.farther(asked.law(), stuck, other)
            })
    }

    /// From bristles to friction with a normalised direction at the first large ε that works.
    pub(super) fn enter_normalised<A: Asked>(
        &mut self,
        asked: &A,
        start: Solved<A::Problem>,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        let problem = |epsilon| {
            let problem = asked.problem(asked.law(), epsilon);
            // EPP friction without its share is Coulomb friction and adds only the displacement.
            problem.with_direction(false).with_epp_weight(0.0)
        };
        let [first, others @ ..] = FIRST_EPSILONS;
        let mut outcome = self.attempt(problem(first), &Carried(&start), Effort::Rough);
        for epsilon in others {
            if outcome.is_err() {
                outcome = self.attempt(problem(epsilon), &Carried(&start), Effort::Rough);
            }
        }
        outcome.map_err(|cause| Stuck::before(&problem(first), start, cause))
    }

    /// EPP friction entered at a large ε, its zones made segments there.
    fn epp_by_zones<A: Asked>(
        &mut self,
        asked: &A,
        unblended: &Solved<A::Problem>,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        let blended = self.blend_normalised(asked, unblended)?;
        let split = self.split_zones(blended, Effort::Rough)?;
        self.lower_epsilon(split, RESOLVED)
    }

    /// Coulomb friction sharpened first, then EPP friction and its zones.
    fn epp_at_last<A: Asked>(
        &mut self,
        asked: &A,
        unblended: &Solved<A::Problem>,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        let sharp = self.lower_epsilon(unblended.clone(), RESOLVED)?;
        let blended = self.blend_normalised(asked, &sharp)?;
        self.split_zones(blended, Effort::Rough)
    }

    /// EPP friction across its kinks, which costs mesh intervals but needs no zones.
    fn epp_as_a_whole<A: Asked>(
        &mut self,
        asked: &A,
        unblended: &Solved<A::Problem>,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        let blended = self.blend_normalised(asked, unblended)?;
        self.lower_epsilon(blended, RESOLVED)
    }

    /// EPP friction at the same ε, by growing its share.
    fn blend_normalised<A: Asked>(
        &mut self,
        asked: &A,
        unblended: &Solved<A::Problem>,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        let epp = asked.problem(asked.law(), unblended.problem.smoothing());
        self.blend(unblended, &epp.with_direction(false))
    }

    /// The outcome of another way, or the way that came farther: to a state that only lacks a smaller ε.
    fn farther<P: BeltProblem>(
        &self,
        law: FrictionLaw,
        stuck: Stuck<P>,
        other: Result<Solved<P>, Stuck<P>>,
    ) -> Result<Solved<P>, Stuck<P>> {
        let resolved = |stuck: &Stuck<P>| {
            let last = stuck.last.as_ref();
            last.is_some_and(|last| last.is_resolved(law, self.tolerance))
        };
        match other {
            Err(other) if resolved(&stuck) && !resolved(&other) => Err(stuck),
            outcome => outcome,
        }
    }

    /// Lowers ε in small and careful steps, or where these get stuck roughly in great ones. Rough states on the way do
    /// not show the slip, and the states behind them take longer than is won: without load 0.6 s in place of 0.1 s on the
    /// drive of Kim (2009).
    fn lower_epsilon<P: BeltProblem>(
        &mut self,
        start: Solved<P>,
        epsilon: f64,
    ) -> Result<Solved<P>, Stuck<P>> {
        let range = [start.problem.smoothing().ln(), epsilon.ln()];
        let fallback = start.clone();
        self.follow(start, range, SMALL_STEP, Effort::Careful, with_smoothing)
            .or_else(|_| self.smooth_less(fallback, epsilon, Effort::Rough))
    }
}
