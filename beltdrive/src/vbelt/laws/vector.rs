//! Vector EPP friction.
//!
//! Where the plastic rate sets in gradually, in proportion to a power of |B|/μ, the equations have no zones, and
//! Newton's method finds their solution from soft bristles if friction is soft, too. The higher the power, the more
//! clearly it shows the zones in which friction is elastic and in which it is at its limit. With these as segments
//! friction is made as stiff as it is.

use super::obeyed::obeys_friction;
use super::{Asked, GREAT_STEP, START_STIFFNESS};
use crate::vbelt::carried::Carried;
use crate::vbelt::path::{Effort, Path, Solved, Stuck};
use crate::vbelt::zones::Cut;
use crate::vbelt::{BeltProblem, Law};

/// Multiples of the stiffness of the start up to which friction is found at once, in the order in which they are
/// tried: with stiffer friction zones change less on the way.
const SOFTER: [f64; 2] = [5.0, 1.0];
/// Halves of the powers of |B|/μ with which zones are sought, in this order.
const SHARPNESS: [i32; 2] = [2, 4];
/// Length over which the traction is led on the way: the mesh resolves it easily.
const FIRST_LEAD: f64 = 1e-2;

impl Path<'_> {
    /// Vector EPP friction by way of bristles.
    pub(super) fn vector<A: Asked>(
        &mut self,
        asked: &A,
        bristles: &Solved<A::Problem>,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        let mut failure = None;
        for softer in SOFTER {
            let found = self
                .gradual(asked, bristles, softer)
                .and_then(|gradual| self.vector_by_zones(asked, gradual));
            match found {
                Ok(solved) => return Ok(solved),
                Err(stuck) => failure = Some(stuck),
            }
        }
        Err(failure.expect("more than one stiffness is tried"))
    }

    /// Vector EPP friction whose plastic rate sets in gradually.
    pub(super) fn enter_vector<A: Asked>(
        &mut self,
        asked: &A,
        bristles: &Solved<A::Problem>,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        self.gradual(asked, bristles, SOFTER[SOFTER.len() - 1])
    }

    /// From bristles to vector EPP friction that is at most some times as stiff as bristles of the start, and whose
    /// plastic rate sets in gradually.
    fn gradual<A: Asked>(
        &mut self,
        asked: &A,
        bristles: &Solved<A::Problem>,
        softer: f64,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        let problem = asked.problem(asked.law(), FIRST_LEAD);
        let softer = stiffness(&problem).min(softer * START_STIFFNESS);
        let problem = with_stiffness(&problem, softer.ln());
        self.attempt(problem, &Carried(bristles), Effort::Start)
            .map_err(|cause| Stuck::after(bristles.clone(), cause))
    }

    /// Vector EPP friction from that whose plastic rate sets in gradually.
    pub(super) fn vector_by_zones<A: Asked>(
        &mut self,
        asked: &A,
        gradual: Solved<A::Problem>,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        let asked = stiffness(&asked.problem(asked.law(), FIRST_LEAD));
        let (mut here, mut wrong, mut failure) = (gradual, None, None);
        for sharpness in SHARPNESS {
            let sharper = with_sharpness(&here.problem, sharpness);
            here = match self.attempt(sharper, &Carried(&here), Effort::Start) {
                Ok(sharper) => sharper,
                Err(cause) => return Err(Stuck::after(here, cause)),
            };
            for cut in [Cut::of(&here), Cut::with_one_elastic_zone(&here)] {
                match self.vector_from(&cut, &here, asked) {
                    Ok(solved) if obeys_friction(&solved, self.tolerance) => return Ok(solved),
                    Ok(solved) => wrong = Some(solved),
                    Err(stuck) => failure = Some(stuck),
                }
            }
        }
        // The checks of a state say what is wrong with it.
        wrong.map_or_else(|| Err(failure.expect("powers are tried")), Ok)
    }

    /// From zones of soft friction to a state with the scaled stiffness that is asked for.
    fn vector_from<P: BeltProblem>(
        &mut self,
        cut: &Cut<'_, P>,
        seen: &Solved<P>,
        asked: f64,
    ) -> Result<Solved<P>, Stuck<P>> {
        let zones = self
            .attempt(cut.apply(seen.problem.clone()), cut, Effort::Rough)
            .map_err(|cause| Stuck::after(seen.clone(), cause))?;
        let zones = self.split_zones(zones, Effort::Rough)?;
        let range = [stiffness(&zones.problem), asked].map(f64::ln);
        let stiff = self.follow(zones, range, GREAT_STEP, Effort::Rough, with_stiffness)?;
        self.finish(stiff)
    }
}

/// The scaled stiffness of vector EPP friction.
fn stiffness<P: BeltProblem>(problem: &P) -> f64 {
    match problem.law() {
        Law::Vector { stiffness, .. } => stiffness,
        _ => panic!("vector EPP friction was expected"),
    }
}

/// The same problem with a scaled stiffness of eᵗ.
fn with_stiffness<P: BeltProblem>(problem: &P, t: f64) -> P {
    let share = t.exp() / stiffness(problem);
    problem.clone().with_laws(|mut law, _| {
        if let Law::Vector { stiffness, .. } = &mut law {
            *stiffness *= share;
        }
        law
    })
}

/// The same problem with another power of |B|/μ.
fn with_sharpness<P: BeltProblem>(problem: &P, half: i32) -> P {
    problem.clone().with_laws(|mut law, _| {
        if let Law::Vector { sharpness, .. } = &mut law {
            *sharpness = half;
        }
        law
    })
}
