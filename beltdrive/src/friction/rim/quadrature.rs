//! Where a zone changes quickly: places for profiles, and integrals along the belt.

use super::contact::{Contact, Place};
use super::zone::{ContactZone, Friction};

/// Beyond so many decay lengths before the end of a zone nothing changes, to rounding.
const DECAY_LENGTHS: f64 = 40.0;

/// Nodes and weights of Gauss quadrature with six nodes on (−1, 1), one half of each; the other half
/// mirrors them (Abramowitz and Stegun, table 25.4).
const GAUSS: [[f64; 2]; 3] = [
    [0.238_619_186_083_196_9, 0.467_913_934_572_691],
    [0.661_209_386_466_264_5, 0.360_761_573_048_138_6],
    [0.932_469_514_203_152, 0.171_324_492_379_170_36],
];

impl Contact {
    /// Shares of a zone that bound panels on which all quantities are smooth, finer towards the end,
    /// where displacements and slip velocities grow exponentially.
    pub(crate) fn panels(&self, zone: &ContactZone) -> Vec<f64> {
        let decays = match &zone.friction {
            Friction::Adhesion => 0.0,
            Friction::Slip => self.arc.slip_rate * (zone.end - zone.start.arc_length),
            Friction::Developing(law) => law.decay_lengths(self, zone),
        };
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
        functions: impl Fn(&Place) -> [f64; N],
    ) -> [f64; N] {
        let mut sums = [0.0; N];
        for zone in &self.zones {
            add(&mut sums, self.all_over(zone, &functions), 1.0);
        }
        sums
    }

    /// The integral of a function of the place over one zone.
    pub(crate) fn over(&self, zone: &ContactZone, function: &impl Fn(&Place) -> f64) -> f64 {
        let [integral] = self.all_over(zone, &|place| [function(place)]);
        integral
    }

    /// How much longer the belt in a zone is than without tension, m.
    pub(crate) fn elongation_by_quadrature(&self, zone: &ContactZone) -> f64 {
        self.over(zone, &|place| self.arc.belt.elongation(place.traction))
    }

    /// As [`Self::over`], of several functions.
    pub(crate) fn all_over<const N: usize>(
        &self,
        zone: &ContactZone,
        functions: &impl Fn(&Place) -> [f64; N],
    ) -> [f64; N] {
        let integrand = |share: f64| {
            let place = self.at(zone, share);
            let per_share = self.arc_per_share(zone, &place);
            functions(&place).map(|value| value * per_share)
        };
        let mut sums = [0.0; N];
        for panel in self.panels(zone).windows(2) {
            let parts = integrals([panel[0], panel[1]], integrand);
            add(&mut sums, parts, 1.0);
        }
        sums
    }

    /// Arc length per share of a zone, at a place, m.
    fn arc_per_share(&self, zone: &ContactZone, place: &Place) -> f64 {
        match &zone.friction {
            Friction::Developing(law) => law.arc_per_share(self, zone, place),
            Friction::Adhesion | Friction::Slip => zone.end - zone.start.arc_length,
        }
    }
}

/// The integral of a smooth function over a panel.
pub(crate) fn integral(ends: [f64; 2], function: impl Fn(f64) -> f64) -> f64 {
    let [integral] = integrals(ends, |place| [function(place)]);
    integral
}

/// The integrals of smooth functions over a panel.
pub(crate) fn integrals<const N: usize>(
    [from, to]: [f64; 2],
    functions: impl Fn(f64) -> [f64; N],
) -> [f64; N] {
    let [middle, half] = [0.5 * (from + to), 0.5 * (to - from)];
    let mut sums = [0.0; N];
    for [node, weight] in GAUSS {
        for end in [middle - half * node, middle + half * node] {
            add(&mut sums, functions(end), half * weight);
        }
    }
    sums
}

/// Adds parts with a weight to sums.
fn add<const N: usize>(sums: &mut [f64; N], parts: [f64; N], weight: f64) {
    for (sum, part) in sums.iter_mut().zip(parts) {
        *sum += weight * part;
    }
}
