//! A belt as its engineer describes it, in SI units.

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
