//! How a branch goes on where its friction zones change.

use super::carried::Carried;
use super::limit::Coordinate;
use super::path::{Effort, Path, Solved, Stuck};

/// The constants of a drive differ by less than this share of 1 + |value| between a state with zones that it has
/// no longer and the one that has others there. Most differ by less than 1e-6.
const SAME: f64 = 1e-3;

/// Steps in the logarithm of the wrap of the driver, or of the driven speed, after which a zone that has appeared is sought.
/// On one drive an arc of 0.02 rad, beside whose birth the load has its limit point, was not found without such a step.
const ALONG: [f64; 3] = [0.0, 1e-3, 1e-2];

impl Path<'_> {
    /// A solution with its zones found anew. Where Newton's method does not come from the old ones to the new, as
    /// where the belt that sticks begins to slip elastically behind, the state is sought from nothing.
    pub(super) fn with_other_zones(&mut self, here: &Solved) -> Result<Solved, Stuck> {
        self.keep_zones(here.clone(), Effort::Full)
            .or_else(|stuck| self.anew(here).ok_or(stuck))
    }

    /// As [`Path::with_other_zones`], at another tight tension. With the zone that has appeared the tension may have its
    /// limit point below that of `here`, so that another quantity is held instead, and a little farther along where the
    /// zone is too short to be found, but at no more than `largest`. The states with it may begin at a smaller tension, and
    /// lead to larger ones.
    pub(super) fn with_other_zones_beside_limit(
        &mut self,
        here: &Solved,
        largest: f64,
    ) -> Option<Solved> {
        let coordinates = [Coordinate::DriverLength, Coordinate::DrivenSpeed];
        let mut ways = coordinates.into_iter().flat_map(|coordinate| {
            ALONG
                .into_iter()
                .map(move |step| (coordinate, coordinate.beyond(here, step)))
        });
        ways.find_map(|(coordinate, value)| {
            let held = self.at(coordinate, value, here, Effort::Full).ok()?;
            let other = self.keep_zones(held, Effort::Full).ok()?;
            let problem = other.problem.clone();
            let problem = problem.with_tight_tension(other.tight_tension().min(largest));
            self.attempt(problem, &Carried(&other), Effort::Full).ok()
        })
    }

    /// A state of vector EPP friction without zones with those that it shows, if they are found.
    pub(super) fn with_zones_shown(&mut self, here: &Solved) -> Option<Solved> {
        let solved = self.zones_shown_by(here);
        solved.filter(|solved| is_same(solved, here))
    }

    /// A state at which elastic friction pulls with the slip with a belt that sticks there, if it is found.
    pub(super) fn with_belt_at_rest(&mut self, pulled: &Solved) -> Option<Solved> {
        let resting = self.come_to_rest(pulled)?;
        let solved = self.finish_obeying(resting).ok();
        solved.filter(|solved| is_same(solved, pulled))
    }

    /// The state of the drive from nothing, if it is `here` but for the zones.
    fn anew(&mut self, here: &Solved) -> Option<Solved> {
        let solved = self.with_direction();
        solved.filter(|solved| is_same(solved, here))
    }
}

/// Whether two states are the same but for the zones.
fn is_same(one: &Solved, other: &Solved) -> bool {
    one.change_to(&other.constants()) <= SAME
}
