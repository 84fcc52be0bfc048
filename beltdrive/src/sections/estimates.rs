//! Stiffness that makers do not print, estimated from belts that were measured.

use super::{Figure, Kind, Source};

/// EA/m, N·m/kg, with the range of measured belts: 0.52e6 (PK ribs, from resonances) to 2.05e6 (PK ribs, from
/// creep); a V-belt has 1.11e6 and a flat belt 0.77e6. Its root is the speed of axial waves, here 1 km/s.
const SPECIFIC_STIFFNESS: (f64, [f64; 2]) = (1.0e6, [0.5e6, 2.0e6]);

/// Modulus across a V-belt, Pa: that of rubber of 80 Shore A. It is at least the 0.95 `MPa` that k = 900 kN/m² of the
/// belt in Kim's thesis comes to at its A section. Layers of fibres across the belt make it stiffer than rubber:
/// `examples/spb-fan.toml` reaches the 95 to 98 % efficiency of well-designed drives at 10 to 35 `MPa`, 97 % at 17 `MPa`.
const TRANSVERSE_MODULUS: (f64, [f64; 2]) = (17.0e6, [1.0e6, 35.0e6]);

/// Axial stiffness of a belt or rib with a mass per length in kg/m.
pub(super) const fn axial_stiffness(mass: f64) -> Option<Figure> {
    let (value, [low, high]) = SPECIFIC_STIFFNESS;
    Some(Figure {
        value: value * mass,
        range: Some([low * mass, high * mass]),
        kind: Kind::Estimate,
        sources: &[Source::Kim2009, Source::AccessoryDrives],
    })
}

/// Modulus across a V-belt.
pub(super) const fn transverse_modulus() -> Option<Figure> {
    let (value, range) = TRANSVERSE_MODULUS;
    Some(Figure {
        value,
        range: Some(range),
        kind: Kind::Estimate,
        sources: &[Source::Ruess, Source::Kim2009, Source::GatesEfficiency],
    })
}

/// Depth of the line of a V-belt where it is as wide as its datum width in mm below its back, between faces at a
/// wedge angle in degrees.
pub(super) const fn pitch_line_depth(
    top_width: f64,
    datum_width: f64,
    wedge: Wedge,
    sources: &'static [Source],
) -> Option<Figure> {
    Some(Figure {
        value: 0.5 * (top_width - datum_width) / 1e3 / wedge.tangent_of_half(),
        range: None,
        kind: Kind::Derived,
        sources,
    })
}

/// A wedge angle of a V-belt.
#[derive(Clone, Copy)]
pub(super) enum Wedge {
    /// 38°.
    Degrees38,
    /// 40°.
    Degrees40,
}

impl Wedge {
    /// The angle in degrees.
    pub(super) const fn degrees(self) -> f64 {
        match self {
            Self::Degrees38 => 38.0,
            Self::Degrees40 => 40.0,
        }
    }

    /// The tangent of half the angle, which has no function that can be evaluated beforehand.
    const fn tangent_of_half(self) -> f64 {
        match self {
            Self::Degrees38 => 0.344_327_613_289_665_2,
            Self::Degrees40 => 0.363_970_234_266_202_4,
        }
    }
}
