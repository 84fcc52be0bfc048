//! Scalar EPP friction of a drive, from a smaller load at which its belt locks.
//!
//! Under one load the belt may come to rest where it slips least under elastic friction, or pass that place and come to rest farther
//! on with friction that is reversed by then, or nowhere. Bristles lead to any of these states. From the integrals of a belt that
//! locks it comes to rest at the first place, and from there the load is raised as it is when a drive is loaded.

use super::locked::integrals;
use super::{Asked, AtLoad};
use crate::FrictionLaw;
use crate::vbelt::path::{Effort, Path, Solved};

/// Powers of this of the ratio of the load to the slack tension are the smaller loads, ...
const LIGHTER: f64 = 0.85;
/// ... and so many of them are looked at, in less than 1 ms where a belt does not come to rest, and longer where it is held and finds
/// no exit. One drive locks between 1.015 and 1.017 times the slack tension alone: nine powers, from 0.8 down to 0.01, found that from
/// five of ten loads, these from nine.
const SMALLER: i32 = 20;
/// The most integrals that meet from which a state is sought: on soft friction none may be found, with twice as many in 1.4 times the
/// time.
const GUESSES: usize = 2;

impl Path<'_> {
    /// The state of a drive with scalar EPP friction to which that of a belt that locks leads as its load is raised, if it is found
    /// and friction obeys its law; sought once.
    pub(super) fn raised_from_locked(&mut self, asked: &AtLoad<'_>) -> Option<Solved> {
        if self.was_raised_in_vain {
            return None;
        }
        let raised = self.raise_from_locked(asked);
        self.was_raised_in_vain = raised.is_none();
        raised
    }

    fn raise_from_locked(&mut self, asked: &AtLoad<'_>) -> Option<Solved> {
        let FrictionLaw::Epp { .. } = asked.law() else {
            return None;
        };
        let (drive, slack) = (asked.drive, self.slack());
        let smaller =
            (1..=SMALLER).map(|times| slack * (asked.tight / slack).powf(LIGHTER.powi(times)));
        let from = smaller
            .filter_map(|tight| integrals(&AtLoad { drive, tight }, asked.law()))
            .take(GUESSES)
            .find_map(|(problem, guess)| self.solved_from_integrals(problem, &guess))?;
        let raised = self.with_load(from, asked.tight, Effort::Rough);
        self.finish_obeying(raised.ok()?).ok()
    }
}
