//! A drive as its engineer describes it, in SI units.

pub(crate) mod belt_loop;
pub(crate) mod layout;

/// A two-pulley belt drive and its load: everything a drive file states.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// A name for outputs and figures.
    pub title: Option<String>,
    /// The belt.
    pub belt: Belt,
    /// Coefficient of friction μ > 0 between belt and pulleys.
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

/// Mechanical properties of a belt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Belt {
    /// Mass m per unstretched length, kg/m.
    pub mass_per_length: f64,
    /// Axial stiffness EA, N.
    pub axial_stiffness: f64,
    /// What kind of belt it is.
    pub kind: BeltKind,
    /// Number of ribs, or of equal belts side by side, that the other numbers are for; at least 1. It only
    /// matters to what is reported per rib.
    pub ribs: u32,
}

/// The kind of a belt, with what only that kind has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BeltKind {
    /// A V-belt, which sinks into the groove of each pulley.
    V(VBelt),
    /// A flat belt, which runs on the rim of each pulley.
    Flat {
        /// How the normal force follows from the tension.
        normal_force: NormalForce,
    },
}

impl Belt {
    /// What the belt has as a V-belt.
    ///
    /// # Panics
    /// If it is none: the models of V-belts are only asked about V-belts.
    pub(crate) fn v(&self) -> &VBelt {
        match &self.kind {
            BeltKind::V(belt) => belt,
            BeltKind::Flat { .. } => panic!("a V-belt was expected"),
        }
    }
}

/// A V-belt in its groove.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VBelt {
    /// Radial stiffness k: line load per radial penetration, N/m².
    pub radial_stiffness: f64,
    /// Half groove angle β in rad, between a groove face and the plane of rotation; 0 < β < π/2.
    pub half_angle: f64,
    /// Height of the cross-section, m, if known: how deep the belt may sink into the groove.
    pub height: Option<f64>,
}

/// How the normal force n per length follows from the tension T of a flat belt on a pulley of radius
/// R; G is the mass flow, V the belt speed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NormalForce {
    /// n = T/R, as in Kim (2009): the inertia of the belt acts along the pulley only.
    Thesis,
    /// n = (T − G V)/R, small strains.
    #[default]
    Inertia,
    /// n = (T − G V)/R, finite strains: displacement and friction stiffness in the coordinate of the
    /// unstretched belt.
    Exact,
}

impl NormalForce {
    /// Every convention.
    pub const ALL: [Self; 3] = [Self::Thesis, Self::Inertia, Self::Exact];

    /// The name of the convention in drive files and outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Thesis => "thesis",
            Self::Inertia => "inertia",
            Self::Exact => "exact",
        }
    }
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

/// What is prescribed for the two spans.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Tension of the slack span.
    pub slack: SpanTension,
    /// Tension of the tight span; at least that of the slack span.
    pub tight: SpanTension,
}

/// What the tension of a span is prescribed by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpanTension {
    /// Tractive tension F = T − G V, N.
    Tractive(f64),
    /// Belt tension T, N.
    Belt(f64),
    /// Torque of the driven pulley, N·m, not negative: the tension follows from that of the other
    /// span. One span at most; flat belts only.
    DrivenTorque(f64),
}

impl SpanTension {
    /// The prescribed number, N or N·m, whatever it is.
    pub fn value(self) -> f64 {
        match self {
            Self::Tractive(value) | Self::Belt(value) | Self::DrivenTorque(value) => value,
        }
    }

    /// Another number of the same kind.
    pub(crate) fn with_value(self, value: f64) -> Self {
        match self {
            Self::Tractive(_) => Self::Tractive(value),
            Self::Belt(_) => Self::Belt(value),
            Self::DrivenTorque(_) => Self::DrivenTorque(value),
        }
    }
}
