//! The back of a V-belt on a flat pulley: local mechanics at a point of the contact.
//!
//! The back presses with p = F/R per length and slips by e = 1 − ω R/V along the rim, per unit of its own
//! speed. Friction q against that slip changes the tension, dF/ds = q, with the laws of the grooves in one
//! direction, which is that of the slip, or that of bristles:
//!
//! ```text
//! Coulomb   q = μ p e/|e|,  |e| = sqrt(e² + ε²), where ℓ/R takes the part of ε if there is one
//! EPP       q = k_f u, −μ p ≤ q ≤ μ p,  du/ds = (V − ω R)/c
//! bristle   q = p B,        dB/ds = κ (e − |e| B/μ)
//! vector    q = b as long as |b| < μ p, else μ p in its sense,  db/ds = k_f e
//! ```
//!
//! EPP friction is that of flat belts: du/ds is (T − `T_o`)/EA with the tension at which this belt would run as fast
//! as this rim. A tension that all pulleys share would leave the friction of a short contact a fixed multiple of the
//! load, so that a loop in which it is too small would not carry any load, however light.

use super::super::Strand;
use super::super::groove::Law;
use bvp::Real;

/// Index of the tractive tension F among the states; that of the friction law follows it, if there is one.
pub(super) const TENSION: usize = 0;
pub(super) const LAW: usize = 1;

/// The back of the belt on one pulley: constants of the local mechanics, scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Back {
    pub(super) strand: Strand,
    /// Coefficient of friction μ.
    pub(super) friction_coefficient: f64,
    pub(super) law: Law,
}

/// All local quantities at one point of the contact, scaled.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rubbing<T> {
    /// Belt tension T.
    pub(super) tension: T,
    /// Belt speed V.
    pub(super) speed: T,
    /// Slip e.
    pub(super) slip: T,
    /// Friction force q on the belt per length, positive against positive slip.
    pub(super) friction: T,
    /// Magnitude of the slip.
    size: T,
    /// Slip velocity over the speed of the unstretched belt, (V − ω R)/c.
    creep: T,
}

impl Back {
    /// Number of states of the contact but for the elongation.
    pub(super) fn states(&self) -> usize {
        self.displacement() + usize::from(self.law.elastic().is_some())
    }

    /// Whether friction of its law is elastic below its limit.
    pub(super) fn is_elastic(&self) -> bool {
        let is_of_bristles = matches!(self.law, Law::Bristle { .. } | Law::Vector { .. });
        is_of_bristles || self.law.elastic().is_some()
    }

    /// Index of the displacement u of EPP friction among the states.
    fn displacement(&self) -> usize {
        LAW + usize::from(matches!(self.law, Law::Bristle { .. } | Law::Vector { .. }))
    }

    /// The contact in `state`, on a pulley of rim speed ν `rim_speed`, with the mass flow `flow`.
    pub(super) fn at<T: Real>(&self, state: &[T], rim_speed: T, flow: T) -> Rubbing<T> {
        let tractive = state[TENSION];
        let tension = self.strand.tension(tractive, flow);
        let speed = self.strand.speed(tension, flow);
        let strain = self.strand.strain(tension);
        let creep = (T::ONE - rim_speed) + strain;
        let slip = creep / (strain + 1.0);
        let epsilon = match self.law {
            // Only keeps the derivative of |e| finite where e = 0.
            Law::Bristle { .. } | Law::Vector { .. } => 1e-20,
            Law::Normalised { .. } | Law::Sliding { .. } => self.law.smoothing(),
        };
        let size = (slip * slip + epsilon.powi(2)).sqrt();
        let limit = tractive * self.friction_coefficient;
        let within = |friction: T| friction.min(limit).max(-limit);
        let slipping = match self.law {
            Law::Bristle { .. } => limit * (state[LAW] / self.friction_coefficient),
            Law::Vector { .. } => within(state[LAW]),
            Law::Normalised { .. } | Law::Sliding { .. } => limit * (slip / size),
        };
        let friction = self.law.elastic().map_or(slipping, |elastic| {
            let held = within(state[self.displacement()] * elastic.stiffness);
            slipping + (held - slipping) * elastic.weight
        });
        Rubbing {
            tension,
            speed,
            slip,
            friction,
            size,
            creep,
        }
    }

    /// Derivatives of the states with respect to the arc length.
    pub(super) fn rates<T: Real>(&self, at: &Rubbing<T>, state: &[T], rates: &mut [T]) {
        rates[TENSION] = at.friction;
        match self.law {
            Law::Bristle { stiffness, .. } => {
                let saturation = at.size / self.friction_coefficient;
                rates[LAW] = (at.slip - saturation * state[LAW]) * stiffness;
            }
            Law::Vector { stiffness, .. } => rates[LAW] = at.slip * stiffness,
            Law::Normalised { .. } | Law::Sliding { .. } => {}
        }
        if self.law.elastic().is_some() {
            // In the unit of u, in which a tension is its strain.
            rates[self.displacement()] = at.creep / self.strand.compliance;
        }
    }
}
