//! A look at the right-hand side where no mesh has looked.
//!
//! The defect of a solution is known at the points of a rule, and a right-hand side with a jump or a
//! narrow peak between them looks smooth. Before a solution is accepted, its defect is therefore evaluated
//! at further places, at
//!
//! * both ends of every interval, just inside: a jump in the gaps next to the nodes, where no point of the
//!   rule lies, is seen there. Nearer to a node it changes the solution by less than the tolerance;
//! * pseudo-random places in between, other ones each time.
//!
//! On a segment of the length L, with K places in all, a peak of the width w is missed with the probability
//! (1 − w / L)^K, where K is at least 64 and, for N intervals, at least N, besides the 2N next to the nodes.
//! A place once found is looked at again on every later mesh.

use crate::accuracy::segment_look::SegmentLook;
use crate::discretisation::iterate::Iterate;
use crate::discretisation::mesh::{Mesh, split};
use crate::discretisation::powers::Powers;
use crate::discretisation::tableau::Tableau;
use crate::kernels::specialise::{outlined, specialise};
use crate::problem::held::Held;
use crate::result::quality::Defects;
use crate::result::stats::Stats;
use crate::shares::{PARTS, PLACES};

/// The places looked at so far.
#[derive(Clone, Debug)]
pub(crate) struct FurtherPlaces {
    /// The last member of the additive recurrence with the golden ratio, equidistributed in \[0, 1).
    last: f64,
    /// Segments and places where an unseen defect was found.
    found: Vec<(usize, f64)>,
    /// The solution on the interval that is looked at.
    powers: Powers,
}

impl FurtherPlaces {
    pub(crate) fn new() -> Self {
        Self {
            last: 0.5,
            found: vec![],
            powers: Powers::default(),
        }
    }

    /// The mesh with all intervals cut in which an unseen defect adds more to the solution `x` than is
    /// allowed, or in which the right-hand side is not finite though the mesh has not met that; `None` if there
    /// is none. Where it is finite at a state within the tolerance the place is passed over: the solution may
    /// touch the end of the domain.
    pub(crate) fn look(
        &mut self,
        equations: &Held<'_>,
        t: &Tableau,
        mesh: &Mesh,
        (x, defects): (&Iterate, &Defects),
        tolerance: f64,
        stats: &mut Stats,
    ) -> Option<Mesh> {
        let mut finer = None;
        for (index, nodes) in mesh.iter().enumerate() {
            let mut segment = SegmentLook {
                equations,
                t,
                x,
                index,
                nodes,
                local: &defects.local[index],
                tolerance,
                found: &mut self.found,
                cut: vec![],
                powers: &mut self.powers,
                stats,
            };
            let [m, n] = segment.size();
            segment.powers.resize([m, n]);
            let intervals = nodes.len() - 1;
            let mut places = [0.0; PLACES];
            let places = &mut places[..PLACES.div_ceil(intervals)];
            places.fill_with(|| next(&mut self.last));
            specialise!(n in [1, 2, 3, 4, 5, 6] => specialise!(m in [6, 7] =>
                outlined(|| segment.everywhere([m, n], places))));
            segment.again();
            let SegmentLook { cut, .. } = segment;
            if !cut.is_empty() {
                let mut pieces = vec![1; intervals];
                cut.into_iter().for_each(|i| pieces[i] = PARTS);
                finer.get_or_insert_with(|| mesh.clone())[index] = split(nodes, &pieces);
            }
        }
        finer
    }
}

/// Goes on from the last place in \[0, 1) to the next one.
fn next(last: &mut f64) -> f64 {
    const INVERSE_GOLDEN_RATIO: f64 = 0.618_033_988_749_894_8;
    *last += INVERSE_GOLDEN_RATIO;
    if *last >= 1.0 {
        *last -= 1.0;
    }
    *last
}
