//! A drive as its engineer describes it, in SI units.

/// A two-pulley V-belt drive and its load: everything a drive file states.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// A name for outputs and figures.
    pub title: Option<String>,
    /// The belt.
    pub belt: Belt,
    /// Half groove angle β in rad, between a groove face and the plane of rotation; 0 < β < π/2.
    pub half_angle: f64,
    /// Coefficient of friction μ > 0 between belt and groove faces.
    pub friction_coefficient: f64,
    /// How friction depends on slip.
    pub law: FrictionLaw,
    /// Pitch radius of the driver, m.
    pub driver_radius: f64,
    /// Angular speed ω₂ of the driver, rad/s; positive.
    pub driver_speed: f64,
    /// Pitch radius of the driven pulley, m.
    pub driven_radius: f64,
    /// Distance between the pulley centres, m; greater than the sum of the radii.
    pub centre_distance: f64,
    /// The end tensions that close the drive.
    pub load: Load,
}

/// Mechanical properties of a V-belt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Belt {
    /// Mass m per unstretched length, kg/m.
    pub mass_per_length: f64,
    /// Axial stiffness EA, N.
    pub axial_stiffness: f64,
    /// Radial stiffness k: line load per radial penetration, N/m².
    pub radial_stiffness: f64,
    /// Height of the cross-section, m, if known: how deep the belt may sink into the groove.
    pub height: Option<f64>,
}

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
    /// Vector bristles in the groove face with stiffness proportional to the pressure.
    Bristle {
        /// Bristle stiffness κ, 1/m; the micro-slip length is μ/κ.
        stiffness: f64,
    },
}

impl FrictionLaw {
    /// The name of the law in drive files and outputs.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Coulomb => "coulomb",
            Self::Epp { .. } => "epp",
            Self::Bristle { .. } => "bristle",
        }
    }
}

/// The tensions of the two spans.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Tension of the slack span.
    pub slack: SpanTension,
    /// Tension of the tight span; at least that of the slack span.
    pub tight: SpanTension,
}

/// A prescribed span tension, in N.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpanTension {
    /// Tractive tension F = T − G V.
    Tractive(f64),
    /// Belt tension T.
    Belt(f64),
}

impl SpanTension {
    /// The prescribed number, N, whichever tension it is.
    pub fn value(self) -> f64 {
        match self {
            Self::Tractive(value) | Self::Belt(value) => value,
        }
    }
}
