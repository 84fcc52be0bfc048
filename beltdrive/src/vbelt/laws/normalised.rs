//! Coulomb and EPP friction with a normalised direction, for drives whose state is not found with a direction
//! of its own: loads so near to none (within 0.6 % on the drive of Kim 2009) that the slip of the turn changes
//! its sense, and some of elastic friction. Branches are followed with it.

use super::finish::with_smoothing;
use super::{RESOLVED, SMALL_STEP};
use crate::FrictionLaw;
use crate::vbelt::DriveProblem;
use crate::vbelt::carried::Carried;
use crate::vbelt::path::{Effort, Path, Solved, Stuck};

/// Normalisations ε of the slip direction with which friction is entered, the first that
/// works: of the order of the largest slip.
pub(in crate::vbelt) const FIRST_EPSILONS: [f64; 3] = [1e-3, 1e-2, 1e-1];

impl Path<'_> {
    /// The law of the drive with a normalised direction.
    pub(super) fn normalised(&mut self, start: Solved, tight: f64) -> Result<Solved, Stuck> {
        let entered = self.enter_normalised(start, |path, epsilon| {
            let problem = path.problem(path.drive.law, epsilon, tight);
            // EPP friction without its share is Coulomb friction and adds only the displacement.
            problem.with_direction(false).with_epp_weight(0.0)
        })?;
        if let FrictionLaw::Coulomb = self.drive.law {
            let sharp = self.lower_epsilon(entered, RESOLVED)?;
            return self.finish(sharp);
        }
        self.epp_by_zones(&entered, tight)
            .or_else(|stuck| {
                let other = self.epp_at_last(&entered, tight);
                self.farther(stuck, other)
            })
            .or_else(|stuck| {
                let other = self.epp_as_a_whole(&entered, tight);
                self.farther(stuck, other)
            })
    }

    /// From bristles to friction with a normalised direction at the first large ε that works.
    fn enter_normalised(
        &mut self,
        start: Solved,
        problem: impl Fn(&Self, f64) -> DriveProblem,
    ) -> Result<Solved, Stuck> {
        let [first, others @ ..] = FIRST_EPSILONS;
        let mut outcome = self.attempt(problem(self, first), &Carried(&start), Effort::Rough);
        for epsilon in others {
            if outcome.is_err() {
                outcome = self.attempt(problem(self, epsilon), &Carried(&start), Effort::Rough);
            }
        }
        outcome.map_err(|cause| Stuck::after(start, cause))
    }

    /// EPP friction entered at a large ε, its zones made segments there.
    fn epp_by_zones(&mut self, unblended: &Solved, tight: f64) -> Result<Solved, Stuck> {
        let blended = self.blend(unblended.clone(), tight)?;
        let split = self.split_zones(blended, Effort::Rough)?;
        let sharp = self.lower_epsilon(split, RESOLVED)?;
        self.finish(sharp)
    }

    /// Coulomb friction sharpened first, then EPP friction and its zones.
    fn epp_at_last(&mut self, unblended: &Solved, tight: f64) -> Result<Solved, Stuck> {
        let sharp = self.lower_epsilon(unblended.clone(), RESOLVED)?;
        let blended = self.blend(sharp, tight)?;
        let split = self.split_zones(blended, Effort::Rough)?;
        self.finish(split)
    }

    /// EPP friction across its kinks, which costs mesh intervals but needs no zones.
    fn epp_as_a_whole(&mut self, unblended: &Solved, tight: f64) -> Result<Solved, Stuck> {
        let blended = self.blend(unblended.clone(), tight)?;
        let sharp = self.lower_epsilon(blended, RESOLVED)?;
        self.finish(sharp)
    }

    /// EPP friction at the same ε, by growing its share.
    fn blend(&mut self, unblended: Solved, tight: f64) -> Result<Solved, Stuck> {
        let epp = self
            .problem(self.drive.law, unblended.problem.smoothing(), tight)
            .with_direction(false);
        let member = |_: &DriveProblem, share| epp.clone().with_epp_weight(share);
        self.follow(unblended, [0.0, 1.0], 1.0, Effort::Rough, member)
    }

    /// The outcome of another way, or the way that came farther: to a state that only lacks a smaller ε.
    fn farther(&self, stuck: Stuck, other: Result<Solved, Stuck>) -> Result<Solved, Stuck> {
        let resolved = |stuck: &Stuck| {
            let last = stuck.last.as_ref();
            last.is_some_and(|last| last.is_resolved(self.drive.law, self.tolerance))
        };
        match other {
            Err(other) if resolved(&stuck) && !resolved(&other) => Err(stuck),
            outcome => outcome,
        }
    }

    /// Lowers ε roughly in great steps, or carefully in small ones where the slip is too small for
    /// that.
    fn lower_epsilon(&mut self, start: Solved, epsilon: f64) -> Result<Solved, Stuck> {
        let range = [start.problem.smoothing().ln(), epsilon.ln()];
        let fallback = start.clone();
        self.smooth_less(start, epsilon, Effort::Rough)
            .or_else(|_| self.follow(fallback, range, SMALL_STEP, Effort::Careful, with_smoothing))
    }
}
