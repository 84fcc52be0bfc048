//! Flat belts: polyurethane with steel or aramid cords, numbers per width.

use super::Source::GatesMectrol;
use super::figure::mm;
use super::{Family, Figure, Section};

/// A section from its name, its height and the smallest diameter in mm, its mass per length and width in kg/m per cm,
/// and its stiffness in N per mm of width.
const fn section(
    name: &'static str,
    height: f64,
    smallest: f64,
    mass: f64,
    stiffness: f64,
) -> Section {
    Section {
        name,
        also: "",
        family: Family::Flat,
        top_width: None,
        height: mm(height, &[GatesMectrol]),
        datum_width: None,
        pitch_line_depth: None,
        pitch_line_height: None,
        wedge_angle: None,
        grooves: &[],
        smallest_diameter: mm(smallest, &[GatesMectrol]),
        mass: Some(Figure::printed(mass * 1e2, &[GatesMectrol])),
        axial_stiffness: Some(Figure::printed(stiffness * 1e3, &[GatesMectrol])),
        transverse_modulus: None,
    }
}

/// From thin to thick.
pub(super) const SECTIONS: [Section; 8] = [
    section("F8-steel", 2.0, 50.0, 0.033, 19_085.0),
    section("F8-aramid", 2.0, 50.0, 0.026, 10_635.0),
    section("FL8-steel", 2.0, 60.0, 0.043, 37_410.0),
    section("FX9-aramid", 2.3, 75.0, 0.025, 15_760.0),
    section("F12-steel", 3.0, 50.0, 0.046, 19_085.0),
    section("F12-aramid", 3.0, 50.0, 0.039, 10_635.0),
    section("FL12-steel", 3.0, 75.0, 0.066, 58_600.0),
    section("FX12-aramid", 3.0, 100.0, 0.035, 22_760.0),
];
