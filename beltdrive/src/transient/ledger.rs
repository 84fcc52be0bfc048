//! Where the energy of a run goes.

use super::state::AcrossParts;
use super::system::System;

/// Largest share of the turnover that may not be accounted for. The residual falls with the square of the cell
/// length; the load step of the documentation leaves 1.5e-7 at 120 cells and 4e-8 at 240, so that more than this is
/// a mesh too coarse for what happens on it.
pub(crate) const BOUND: f64 = 1e-4;

/// Energy since the start of a run, J:
///
/// work of the axles + work of gravity and of run-out on the spans = change of kinetic and strain energy + loss in
/// damping + work into the contact + work into the compression of a V-belt.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Ledger {
    /// Work that all axles have done on the pulleys: of motors less of loads.
    pub work: f64,
    /// Work of gravity on the spans; 0 unless they move across.
    pub gravity: f64,
    /// Work of the run-out of pulleys on the spans, which is not taken from their axles; 0 unless they move across.
    pub run_out: f64,
    /// Change of the kinetic energy of pulleys and belt and the strain energy of the belt.
    pub stored: f64,
    /// Work lost in axial damping.
    pub damped: f64,
    /// Work lost in the damping of the motion of the spans across.
    pub damped_across: f64,
    /// Work that went into the contact between belt and pulleys: sliding, bristle energy carried out where the belt
    /// leaves, and the change of bristle energy.
    pub contact: f64,
    /// Work that went into the compression of a V-belt between the faces of the grooves, ∫∫ k x tan β (∂x/∂t − v sin θ) ds
    /// dt; 0 of flat belts.
    pub compression: f64,
    /// What the residual is measured by: the energy at the start and all work without regard to sign.
    pub turnover: f64,
}

impl Ledger {
    /// The ledger of a state, of a run that started with an energy in J.
    pub(crate) fn of(system: &System, state: &[f64], at_start: f64) -> Self {
        let parts = &system.parts;
        let across = parts.across.as_ref();
        let of = |place: fn(&AcrossParts) -> usize| across.map_or(0.0, |own| state[place(own)]);
        Self {
            gravity: of(|own| own.gravity),
            run_out: of(|own| own.run_out),
            damped_across: of(|own| own.damped),
            work: state[parts.work.clone()].iter().sum(),
            stored: system.energy(state) - at_start,
            damped: state[parts.damped],
            contact: state[parts.contact],
            compression: 0.0,
            turnover: at_start + state[parts.turnover],
        }
    }

    /// Energy that is not accounted for, J.
    #[must_use]
    pub fn residual(&self) -> f64 {
        let given = self.work + self.gravity + self.run_out;
        given - self.stored - self.damped - self.damped_across - self.contact - self.compression
    }

    /// Whether it closes.
    pub(crate) fn closes(&self) -> bool {
        self.residual().abs() <= BOUND * self.turnover
    }
}
