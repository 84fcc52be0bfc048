//! Classical V-belts.

use super::Source::{BeltService, DesignManual, Gost20889, OptibeltCatalogue, OptibeltGrooves};
use super::estimates::{Wedge, axial_stiffness, pitch_line_depth, transverse_modulus};
use super::figure::{degrees, mm};
use super::groove::{above, to};
use super::{Family, Figure, GrooveRule, GrooveStep, Section};

/// What differs from section to section, lengths in mm.
struct Row {
    name: &'static str,
    also: &'static str,
    /// Top width, height, datum width.
    size: [f64; 3],
    /// Smallest datum diameter: smaller and larger of those of the standard and of a maker.
    smallest: [f64; 2],
    /// Mass per length, kg/m.
    mass: f64,
    grooves: &'static [GrooveRule],
}

const fn section(row: Row) -> Section {
    let [top, height, datum] = row.size;
    let [low, high] = row.smallest;
    Section {
        name: row.name,
        also: row.also,
        family: Family::Classical,
        top_width: mm(top, &[OptibeltCatalogue]),
        height: mm(height, &[OptibeltCatalogue]),
        datum_width: mm(datum, &[Gost20889, OptibeltGrooves]),
        pitch_line_depth: pitch_line_depth(
            top,
            datum,
            Wedge::Degrees40,
            &[OptibeltCatalogue, Gost20889, DesignManual],
        ),
        pitch_line_height: None,
        wedge_angle: degrees(Wedge::Degrees40.degrees(), &[DesignManual, BeltService]),
        grooves: row.grooves,
        smallest_diameter: Some(
            Figure::printed(high / 1e3, &[Gost20889, OptibeltGrooves])
                .within(low / 1e3, high / 1e3),
        ),
        mass: Some(Figure::printed(row.mass, &[OptibeltCatalogue])),
        axial_stiffness: axial_stiffness(row.mass),
        transverse_modulus: transverse_modulus(),
    }
}

const fn din(steps: &'static [GrooveStep]) -> GrooveRule {
    GrooveRule {
        standard: "DIN/ISO",
        steps,
        sources: &[OptibeltGrooves],
    }
}

const fn gost(steps: &'static [GrooveStep]) -> GrooveRule {
    GrooveRule {
        standard: "GOST 20889",
        steps,
        sources: &[Gost20889],
    }
}

/// From small to large.
pub(super) const SECTIONS: [Section; 6] = [
    section(Row {
        name: "Z",
        also: "10",
        size: [10.0, 6.0, 8.5],
        smallest: [50.0, 63.0],
        mass: 0.064,
        grooves: &[
            din(&[to(80.0, 34.0), above(38.0)]),
            gost(&[
                to(71.0, 34.0),
                to(100.0, 36.0),
                to(160.0, 38.0),
                above(40.0),
            ]),
        ],
    }),
    section(Row {
        name: "A",
        also: "13",
        size: [13.0, 8.0, 11.0],
        smallest: [71.0, 90.0],
        mass: 0.109,
        grooves: &[
            din(&[to(118.0, 34.0), above(38.0)]),
            gost(&[
                to(112.0, 34.0),
                to(160.0, 36.0),
                to(400.0, 38.0),
                above(40.0),
            ]),
        ],
    }),
    section(Row {
        name: "B",
        also: "17",
        size: [17.0, 11.0, 14.0],
        smallest: [112.0, 125.0],
        mass: 0.196,
        grooves: &[
            din(&[to(190.0, 34.0), above(38.0)]),
            gost(&[
                to(160.0, 34.0),
                to(224.0, 36.0),
                to(500.0, 38.0),
                above(40.0),
            ]),
        ],
    }),
    section(Row {
        name: "C",
        also: "22",
        size: [22.0, 14.0, 19.0],
        smallest: [180.0, 200.0],
        mass: 0.324,
        grooves: &[
            din(&[to(315.0, 34.0), above(38.0)]),
            gost(&[to(315.0, 36.0), to(630.0, 38.0), above(40.0)]),
        ],
    }),
    section(Row {
        name: "D",
        also: "32",
        size: [32.0, 20.0, 27.0],
        smallest: [315.0, 355.0],
        mass: 0.668,
        grooves: &[
            din(&[to(500.0, 36.0), above(38.0)]),
            gost(&[to(450.0, 36.0), to(900.0, 38.0), above(40.0)]),
        ],
    }),
    section(Row {
        name: "E",
        also: "40",
        size: [40.0, 25.0, 32.0],
        smallest: [500.0, 500.0],
        mass: 0.958,
        grooves: &[
            din(&[to(630.0, 36.0), above(38.0)]),
            gost(&[to(560.0, 36.0), to(1120.0, 38.0), above(40.0)]),
        ],
    }),
];
