//! Vector EPP friction.
//!
//! Where the plastic rate sets in gradually, in proportion to a power of |B|/μ, the equations have no zones, and
//! Newton's method finds their solution from soft bristles if friction is soft, too. Then friction is made as stiff as it
//! is. The higher the power, the more clearly it shows the zones in which friction is elastic and in which it is at its
//! limit. These become segments. Where no state is found with the zones that are seen, as where stiff friction is elastic
//! on arcs on which the belt hardly slips, the power is raised until it has no effect: that falls with its square.

use super::obeyed::obeys_friction;
use super::{Asked, GREAT_STEP, START_STIFFNESS};
use crate::vbelt::carried::Carried;
use crate::vbelt::path::{Effort, Path, Solved, Stuck};
use crate::vbelt::piece::ROUNDING;
use crate::vbelt::zones::Cut;
use crate::vbelt::{BeltProblem, Law};

/// Multiples of the stiffness of the start at which gradual friction is entered, if friction is not softer, in the order
/// in which they are tried: stiffer friction is nearer to that which is asked for.
const SOFTER: [f64; 2] = [5.0, 1.0];
/// How accurately gradual friction is solved, in the order in which that is tried. The slip that decides where friction
/// is elastic is a small difference of the speeds of belt and pulley.
const EFFORTS: [Effort; 2] = [Effort::Careful, Effort::Full];
/// Halves of the powers of |B|/μ, each twice as large as the one before, of which the first ...
const BLUNTEST: i32 = 2;
/// ... to this one show zones, ...
const SHOWS_ZONES: i32 = 16;
/// ... and the largest that is tried: of 800 random drives one needed 256.
const SHARPEST: i32 = 1024;
/// A power has no effect if twice the power changes the constants by no more than this share of the tolerance: a third of
/// the change is left then.
const NO_EFFECT: f64 = 0.1;
const LEFT: f64 = 1.0 / 3.0;
/// Half of the power with which curves of states are followed: with 16 the first limit of a drive with soft friction takes
/// 3.1 s in place of 0.4 s.
pub(in crate::vbelt) const FOLLOWED: i32 = 4;
/// Length over which the traction is led on the way: the mesh resolves it easily.
const FIRST_LEAD: f64 = 1e-2;
/// Share of the tolerance to which a state is solved whose friction does not obey its law otherwise. Where friction is
/// stiff, errors of the slip look like elastic zones.
const PRECISE: f64 = 1e-2;
/// The smallest such tolerance, near to rounding.
const FINEST: f64 = 1e-12;

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

    /// Vector EPP friction without zones, as stiff as it is and so sharp that curves of states are followed with it; softer
    /// and blunt where that is not found.
    pub(super) fn enter_vector<A: Asked>(
        &mut self,
        asked: &A,
        bristles: &Solved<A::Problem>,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        let gradual = self.gradual(asked, bristles, SOFTER[SOFTER.len() - 1])?;
        let sharp = self.sharp(asked, gradual.clone());
        Ok(sharp.unwrap_or(gradual))
    }

    /// Gradual friction made as stiff as it is asked for, and as sharp as curves of states are followed with.
    fn sharp<A: Asked>(
        &mut self,
        asked: &A,
        gradual: Solved<A::Problem>,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        let effort = Effort::Careful;
        let mut here = self.stiffened(gradual, scaled_stiffness(asked), effort)?;
        let mut half = BLUNTEST;
        while half <= FOLLOWED {
            let sharper = with_sharpness(&here.problem, half);
            let sharper = sharper.with_laws(|law, _| law.with_rounding(ROUNDING));
            here = self
                .attempt(sharper, &Carried(&here), effort)
                .map_err(|cause| Stuck::after(here, cause))?;
            half *= 2;
        }
        Ok(here)
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
        self.attempt(problem.clone(), &Carried(bristles), Effort::Start)
            .map_err(|cause| Stuck::before(&problem, bristles.clone(), cause))
    }

    /// Vector EPP friction from that whose plastic rate sets in gradually.
    pub(super) fn vector_by_zones<A: Asked>(
        &mut self,
        asked: &A,
        gradual: Solved<A::Problem>,
    ) -> Result<Solved<A::Problem>, Stuck<A::Problem>> {
        let asked = scaled_stiffness(asked);
        let problem = gradual.problem.with_laws(|law, _| law.with_rounding(0.0));
        let gradual = Solved { problem, ..gradual };
        let (mut wrong, mut failure) = (None, None);
        for effort in EFFORTS {
            let mut here = match self.stiffened(gradual.clone(), asked, effort) {
                Ok(stiff) => stiff,
                Err(stuck) => {
                    failure = Some(stuck);
                    continue;
                }
            };
            let mut half = BLUNTEST;
            while half <= SHARPEST {
                let sharper = with_sharpness(&here.problem, half);
                let sharper = match self.attempt(sharper, &Carried(&here), effort) {
                    Ok(sharper) => sharper,
                    Err(cause) => {
                        failure = Some(Stuck::after(here, cause));
                        break;
                    }
                };
                let effect = sharper.change_to(&here.constants());
                here = sharper;
                if half <= SHOWS_ZONES {
                    for cut in cuts(&here) {
                        match self.vector_from(&cut, &here, effort) {
                            Ok(solved) if obeys_friction(&solved, self.tolerance) => {
                                return Ok(solved);
                            }
                            Ok(solved) => wrong = Some(solved),
                            Err(stuck) => failure = Some(stuck),
                        }
                    }
                }
                if half >= SHOWS_ZONES && effect <= NO_EFFECT * self.tolerance {
                    match self.finish(here) {
                        Ok(solved) if obeys_friction(&solved, self.tolerance) => {
                            self.smoothing_effect += LEFT * effect;
                            return Ok(solved);
                        }
                        Ok(solved) => wrong = Some(solved),
                        Err(stuck) => failure = Some(stuck),
                    }
                    break;
                }
                half *= 2;
            }
        }
        // The checks of a state say what is wrong with it.
        wrong.map_or_else(|| Err(failure.expect("efforts are tried")), Ok)
    }

    /// A state with the zones that one without any shows, if it is found and friction obeys its law.
    pub(in crate::vbelt) fn zones_shown_by(&mut self, gradual: &Solved) -> Option<Solved> {
        cuts(gradual).find_map(|cut| {
            let solved = self.vector_from(&cut, gradual, Effort::Full).ok()?;
            obeys_friction(&solved, self.tolerance).then_some(solved)
        })
    }

    /// Gradual friction with the scaled stiffness that is asked for.
    fn stiffened<P: BeltProblem>(
        &mut self,
        gradual: Solved<P>,
        asked: f64,
        effort: Effort,
    ) -> Result<Solved<P>, Stuck<P>> {
        let soft = stiffness(&gradual.problem);
        if soft >= asked {
            return Ok(gradual);
        }
        let range = [soft, asked].map(f64::ln);
        self.follow(gradual, range, GREAT_STEP, effort, with_stiffness)
    }

    /// From the zones that gradual friction shows to a state.
    fn vector_from<P: BeltProblem>(
        &mut self,
        cut: &Cut<'_, P>,
        seen: &Solved<P>,
        effort: Effort,
    ) -> Result<Solved<P>, Stuck<P>> {
        let problem = cut.apply(seen.problem.clone());
        let zones = self
            .attempt(problem.clone(), cut, effort)
            .map_err(|cause| Stuck::before(&problem, seen.clone(), cause))?;
        let zones = self.split_zones(zones, effort)?;
        let asked = self.tolerance;
        match self.finish(zones.clone()) {
            Ok(solved) if obeys_friction(&solved, asked) => Ok(solved),
            _ => {
                self.tolerance = (PRECISE * asked).max(FINEST);
                let precise = self.finish(zones);
                self.tolerance = asked;
                precise
            }
        }
    }
}

/// The zones of gradual friction, in the order in which they are tried: each elastic arc as it is seen, or all of them as
/// one, with the traction as it is or at its limit where the belt slips.
fn cuts<P: BeltProblem>(gradual: &Solved<P>) -> impl Iterator<Item = Cut<'_, P>> {
    let of = [Cut::of, Cut::with_one_elastic_zone];
    let is_one = Cut::of(gradual).is_like(&Cut::with_one_elastic_zone(gradual));
    let kinds = of.into_iter().take(if is_one { 1 } else { 2 });
    kinds.flat_map(|of| [of(gradual), of(gradual).at_limit()])
}

/// The scaled stiffness that is asked for.
fn scaled_stiffness<A: Asked>(asked: &A) -> f64 {
    stiffness(&asked.problem(asked.law(), FIRST_LEAD))
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
        if let Law::Vector { onset, .. } = &mut law {
            onset.sharpness = half;
        }
        law
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vbelt::laws::AtLoad;
    use crate::vbelt::scaling::tests::kim;
    use crate::{Drive, FrictionLaw};

    /// By how much constants without zones differ from those with them, with each half of the power of |B|/μ.
    fn without_zones<const N: usize>(stiffness: f64, halves: [i32; N]) -> [f64; N] {
        let drive = Drive::from(kim(FrictionLaw::VectorEpp { stiffness }, 0.25));
        let mut path = Path::new(&drive, 1e-6);
        let asked = AtLoad {
            drive: &drive,
            tight: path.target(),
        };
        let start = path.cold(&asked, asked.softest(), Effort::Start).unwrap();
        let zones = path.vector(&asked, &start).unwrap();
        assert!(zones.problem.is_split());
        let gradual = path.gradual(&asked, &start, SOFTER[0]).unwrap();
        let stiff = scaled_stiffness(&asked);
        let stiff = path.stiffened(gradual, stiff, Effort::Full).unwrap();
        halves.map(|half| {
            let sharp = with_sharpness(&stiff.problem, half);
            let sharp = path.attempt(sharp, &Carried(&stiff), Effort::Full).unwrap();
            let sharp = path.finish(sharp).unwrap();
            assert!(!sharp.problem.is_split());
            // Its neighbours are as sharp.
            let neighbour = path.neighbour(&sharp).unwrap();
            let Law::Vector { onset, .. } = neighbour.problem.law() else {
                panic!("{:?}", neighbour.problem.law());
            };
            assert_eq!(onset.sharpness, half);
            sharp.change_to(&zones.constants())
        })
    }

    #[test]
    fn a_sharp_onset_without_zones_is_the_law() {
        // Measured are 9.1e-7, 1.9e-8 and 3.1e-8, 2.9e-9: the order is 1.9 and 1.1, where the arcs are long and short.
        let [blunt, sharp] = without_zones(8.1e6, [32, 256]);
        assert!(sharp < 5e-8 && sharp < 0.05 * blunt, "{blunt} {sharp}");
        let [blunt, sharp] = without_zones(1e8, [32, 256]);
        assert!(sharp < 1e-8 && sharp < 0.2 * blunt, "{blunt} {sharp}");
        // This belt slips everywhere: what is left, 8e-12, is the effect of δ.
        let [blunt] = without_zones(1e9, [4]);
        assert!(blunt < 1e-10, "{blunt}");
    }
}
