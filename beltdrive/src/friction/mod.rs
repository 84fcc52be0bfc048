//! Friction between belt and pulley: one file a law.

pub(crate) mod coulomb;
pub(crate) mod creep_rate;
pub(crate) mod epp;
pub(crate) mod rim;

/// How the friction force depends on slip. The coefficient μ is common to all laws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrictionLaw {
    /// Full friction μ p against the slip velocity.
    Coulomb,
    /// Elastic/perfectly-plastic: `f = min(k_f |u|, μ p)` along the slip velocity.
    Epp {
        /// Stiffness `k_f` per length, N/m².
        stiffness: f64,
    },
    /// Vector bristles in the groove face with stiffness proportional to the pressure; V-belts only.
    Bristle {
        /// Bristle stiffness κ, 1/m; the micro-slip length is μ/κ.
        stiffness: f64,
    },
    /// Friction grows with the slip velocity v up to its Coulomb value, `μ n min(|v|/v_s, 1)`; flat belts
    /// only (Leamy and Wasfy, 2002).
    CreepRate {
        /// Slip velocity `v_s` at which friction is fully developed, m/s.
        velocity: f64,
    },
}

impl FrictionLaw {
    /// The name of the law in drive files and outputs.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Coulomb => "coulomb",
            Self::Epp { .. } => "epp",
            Self::Bristle { .. } => "bristle",
            Self::CreepRate { .. } => "creep-rate",
        }
    }
}
