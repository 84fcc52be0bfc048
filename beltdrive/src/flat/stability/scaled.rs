//! The problem in units of the length that moves, ℓ, and of the wave speed c.
//!
//! ```text
//! x = (s − s_0)/ℓ,  σ = λ ℓ/c,  M = v/c,  δ = 1 − M²,  k = κ ℓ²/EA,  e = η ℓ
//! f'' = 2 a f' + b f,   a = (M σ + e/2)/δ,            b = (σ² + k)/δ
//!                       a = (M σ + e δ/2)/δ,          b = (σ² + k − e M σ)/δ   (Conservative)
//! outlet:  f' = 0,   or   δ f' = M σ f
//! ```

use super::{AxialMotion, LinearisedForm};
use faer::c64;

/// A stretch of the belt with constant coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Zone {
    /// Where it starts.
    pub(super) start: f64,
    /// Its length.
    pub(super) length: f64,
    /// Friction stiffness k.
    pub(super) stiffness: f64,
    /// Slip rate e.
    pub(super) slip: f64,
}

/// The scaled problem.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Scaled {
    /// Its form.
    pub(super) form: LinearisedForm,
    /// Ratio M of belt speed and wave speed.
    pub(super) mach: f64,
    /// Stiffness of the moving belt δ = 1 − M², positive.
    pub(super) delta: f64,
    /// The zones that move, one or two, none empty.
    pub(super) zones: Vec<Zone>,
    /// Unit c/ℓ of eigenvalues, 1/s.
    pub(super) rate: f64,
}

/// The coefficients of the differential equation in a zone, and their derivatives with respect to
/// σ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coefficients {
    /// a.
    pub(super) a: c64,
    /// da/dσ.
    pub(super) a_slope: f64,
    /// b.
    pub(super) b: c64,
    /// db/dσ.
    pub(super) b_slope: c64,
}

impl Scaled {
    /// The scaled problem of a motion below its critical speed in which something moves.
    pub(super) fn new(motion: &AxialMotion, form: LinearisedForm) -> Self {
        let c = motion.critical_speed();
        let moving = motion.length - motion.fixed_end();
        let mach = motion.speed / c;
        let elastic = motion.elastic.map(|stiffness| Zone {
            start: 0.0,
            length: motion.transition / moving,
            stiffness: stiffness * moving * moving / motion.axial_stiffness,
            slip: 0.0,
        });
        let slip = Zone {
            start: elastic.map_or(0.0, |zone| zone.length),
            length: (motion.length - motion.transition) / moving,
            stiffness: 0.0,
            slip: motion.slip_rate * moving,
        };
        let zones = elastic.into_iter().chain([slip]);
        Self {
            form,
            mach,
            delta: (1.0 - mach) * (1.0 + mach),
            zones: zones.filter(|zone| zone.length > 0.0).collect(),
            rate: c / moving,
        }
    }

    /// The coefficients of a zone.
    pub(super) fn coefficients(&self, zone: &Zone, sigma: c64) -> Coefficients {
        let (mach, delta) = (self.mach, self.delta);
        let (half_slip, coupling) = match self.form {
            LinearisedForm::Thesis | LinearisedForm::NaturalOutlet => (0.5 * zone.slip, 0.0),
            LinearisedForm::Conservative => (0.5 * zone.slip * delta, zone.slip * mach),
        };
        Coefficients {
            a: (sigma * mach + half_slip) / delta,
            a_slope: mach / delta,
            b: (sigma * (sigma - coupling) + zone.stiffness) / delta,
            b_slope: (sigma * 2.0 - coupling) / delta,
        }
    }
}
