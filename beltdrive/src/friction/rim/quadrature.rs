//! Where a zone changes quickly: places for profiles, and integrals along the belt.

use super::contact::{Contact, Place};
use super::zone::{ContactZone, Friction};
use bvp::Real;

/// Beyond so many decay lengths before the end of a zone nothing changes, to rounding.
const DECAY_LENGTHS: f64 = 40.0;

/// Nodes and weights of Gauss quadrature with six nodes on (−1, 1), one half of each; the other half
/// mirrors them (Abramowitz and Stegun, table 25.4).
const GAUSS: [[f64; 2]; 3] = [
    [0.238_619_186_083_196_9, 0.467_913_934_572_691],
    [0.661_209_386_466_264_5, 0.360_761_573_048_138_6],
    [0.932_469_514_203_152, 0.171_324_492_379_170_36],
];

impl<S: Real> Contact<S> {
    /// Shares of a zone that bound panels on which all quantities are smooth, finer towards the end,
    /// where displacements and slip velocities grow exponentially.
    pub(crate) fn panels(&self, zone: &ContactZone<S>) -> Vec<f64> {
        let decays = match &zone.friction {
            Friction::Adhesion => S::ZERO,
            Friction::Slip => self.arc.slip_rate * (zone.end - zone.start.arc_length),
            Friction::Developing(law) => law.own().decay_lengths(self, zone),
        };
        let decays = decays.value();
        // Panels of two thirds of a decay length.
        let panel = (2.0 / 3.0 / decays).min(0.25);
        let graded = (DECAY_LENGTHS.min(decays) / decays).min(1.0);
        let steps = (graded / panel).ceil();
        let mut shares = vec![0.0];
        if graded < 1.0 {
            shares.push(1.0 - graded);
        }
        let mut step = 1.0;
        while step <= steps {
            shares.push(1.0 - graded * (1.0 - step / steps));
            step += 1.0;
        }
        shares
    }

    /// The integrals of functions of the place over the arc length of the whole contact.
    pub(crate) fn integrals<const N: usize>(
        &self,
        functions: impl Fn(&Place<S>) -> [S; N],
    ) -> [S; N] {
        let mut sums = [S::ZERO; N];
        for zone in &self.zones {
            add(&mut sums, self.all_over(zone, &functions), S::ONE);
        }
        sums
    }

    /// The integral of a function of the place over one zone.
    pub(crate) fn over(&self, zone: &ContactZone<S>, function: &impl Fn(&Place<S>) -> S) -> S {
        let [integral] = self.all_over(zone, &|place| [function(place)]);
        integral
    }

    /// How much longer the belt in a zone is than without tension, m.
    pub(crate) fn elongation_by_quadrature(&self, zone: &ContactZone<S>) -> S {
        self.over(zone, &|place| self.arc.belt.elongation(place.traction))
    }

    /// As [`Self::over`], of several functions.
    pub(crate) fn all_over<const N: usize>(
        &self,
        zone: &ContactZone<S>,
        functions: &impl Fn(&Place<S>) -> [S; N],
    ) -> [S; N] {
        let integrand = |share: S| {
            let place = self.at(zone, share);
            let per_share = self.arc_per_share(zone, &place);
            functions(&place).map(|value| value * per_share)
        };
        let mut sums = [S::ZERO; N];
        for panel in self.panels(zone).windows(2) {
            let parts = integrals([panel[0], panel[1]].map(S::from_f64), integrand);
            add(&mut sums, parts, S::ONE);
        }
        sums
    }

    /// Arc length per share of a zone, at a place, m.
    fn arc_per_share(&self, zone: &ContactZone<S>, place: &Place<S>) -> S {
        match &zone.friction {
            Friction::Developing(law) => law.own().arc_per_share(self, zone, place),
            Friction::Adhesion | Friction::Slip => zone.end - zone.start.arc_length,
        }
    }
}

/// The integral of a smooth function over a panel.
pub(crate) fn integral<S: Real>(ends: [S; 2], function: impl Fn(S) -> S) -> S {
    let [integral] = integrals(ends, |place| [function(place)]);
    integral
}

/// The integrals of smooth functions over a panel.
pub(crate) fn integrals<S: Real, const N: usize>(
    [from, to]: [S; 2],
    functions: impl Fn(S) -> [S; N],
) -> [S; N] {
    let [middle, half] = [from + to, to - from].map(|whole| whole * 0.5);
    let mut sums = [S::ZERO; N];
    for [node, weight] in GAUSS {
        for end in [middle - half * node, middle + half * node] {
            add(&mut sums, functions(end), half * weight);
        }
    }
    sums
}

/// Adds parts with a weight to sums.
fn add<S: Real, const N: usize>(sums: &mut [S; N], parts: [S; N], weight: S) {
    for (sum, part) in sums.iter_mut().zip(parts) {
        *sum += weight * part;
    }
}
