//! Poly-V belts: numbers of one rib.

use super::Source::{ContiTech, OptibeltCatalogue, OptibeltRibbed};
use super::estimates::axial_stiffness;
use super::figure::mm;
use super::{Family, Figure, Section};

/// A section from its name, the distance between its ribs, the height of the belt at two makers, the height of
/// the pitch line above the pulley at them and the smallest diameter, in mm, and the mass of a rib per length in kg/m.
const fn section(
    name: &'static str,
    also: &'static str,
    rib: f64,
    [height, other_height]: [f64; 2],
    [line, other_line]: [f64; 2],
    smallest: f64,
    mass: f64,
) -> Section {
    let (low, high) = if line < other_line {
        (line, other_line)
    } else {
        (other_line, line)
    };
    Section {
        name,
        also,
        family: Family::PolyV,
        top_width: None,
        height: Some(
            Figure::printed(height / 1e3, &[OptibeltRibbed, ContiTech])
                .within(height / 1e3, other_height / 1e3),
        ),
        datum_width: mm(rib, &[OptibeltCatalogue, OptibeltRibbed, ContiTech]),
        pitch_line_depth: None,
        pitch_line_height: Some(
            Figure::printed(line / 1e3, &[OptibeltRibbed, ContiTech]).within(low / 1e3, high / 1e3),
        ),
        wedge_angle: None,
        grooves: &[],
        smallest_diameter: mm(smallest, &[OptibeltRibbed, ContiTech]),
        mass: Some(Figure::printed(mass, &[ContiTech, OptibeltRibbed])),
        axial_stiffness: axial_stiffness(mass),
        transverse_modulus: None,
    }
}

/// From small to large.
pub(super) const SECTIONS: [Section; 5] = [
    section("PH", "H", 1.60, [2.5, 2.7], [0.8, 0.8], 13.0, 0.005),
    section("PJ", "J", 2.34, [3.3, 3.8], [1.25, 1.2], 20.0, 0.009),
    section("PK", "K", 3.56, [4.6, 5.0], [1.6, 1.5], 45.0, 0.021),
    section("PL", "L", 4.70, [7.0, 7.5], [3.5, 3.0], 75.0, 0.037),
    section("PM", "M", 9.40, [13.0, 14.5], [5.0, 4.0], 180.0, 0.120),
];
