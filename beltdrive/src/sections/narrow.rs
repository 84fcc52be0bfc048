//! Narrow V-belts.

use super::Source::{
    Dealer, GatesGrooves, Iso8419, Megadyne, OptibeltCatalogue, OptibeltGrooves, RmaGlossary,
};
use super::estimates::{Wedge, axial_stiffness, pitch_line_depth, transverse_modulus};
use super::figure::{degrees, mm};
use super::groove::{above, to};
use super::{Family, Figure, GrooveRule, GrooveStep, Section, Source};

/// What differs from section to section of the datum system, lengths in mm.
struct Row {
    name: &'static str,
    /// Top width, height, datum width.
    size: [f64; 3],
    /// The wedge angle, where a maker's drawing shows it.
    wedge: Option<Wedge>,
    smallest: f64,
    /// Mass per length, kg/m: of the catalogue and of the dealer.
    mass: [f64; 2],
    grooves: &'static [GrooveRule],
}

const fn iso(row: Row) -> Section {
    let [top, height, datum] = row.size;
    let [mass, other] = row.mass;
    let (low, high) = if mass < other {
        (mass, other)
    } else {
        (other, mass)
    };
    let sizes: &[Source] = match row.wedge {
        Some(_) => &[OptibeltCatalogue, Dealer, Megadyne],
        None => &[OptibeltCatalogue, Dealer],
    };
    Section {
        name: row.name,
        also: "",
        family: Family::NarrowIso,
        top_width: mm(top, sizes),
        height: mm(height, sizes),
        datum_width: mm(datum, &[OptibeltGrooves, Dealer]),
        pitch_line_depth: match row.wedge {
            Some(wedge) => pitch_line_depth(top, datum, wedge, &[OptibeltGrooves, Megadyne]),
            None => None,
        },
        pitch_line_height: None,
        wedge_angle: match row.wedge {
            Some(wedge) => degrees(wedge.degrees(), &[Megadyne]),
            None => None,
        },
        grooves: row.grooves,
        smallest_diameter: mm(row.smallest, &[OptibeltGrooves, Dealer]),
        mass: Some(Figure::printed(mass, &[OptibeltCatalogue, Dealer]).within(low, high)),
        axial_stiffness: axial_stiffness(mass),
        transverse_modulus: transverse_modulus(),
    }
}

const fn din(steps: &'static [GrooveStep]) -> GrooveRule {
    GrooveRule {
        standard: "DIN 2211",
        steps,
        sources: &[OptibeltGrooves],
    }
}

/// In the datum system, from small to large.
pub(super) const ISO: [Section; 4] = [
    iso(Row {
        name: "SPZ",
        size: [9.7, 8.0, 8.5],
        wedge: None,
        smallest: 63.0,
        mass: [0.074, 0.065],
        grooves: &[din(&[to(80.0, 34.0), above(38.0)])],
    }),
    iso(Row {
        name: "SPA",
        size: [12.7, 10.0, 11.0],
        wedge: None,
        smallest: 90.0,
        mass: [0.123, 0.115],
        grooves: &[din(&[to(118.0, 34.0), above(38.0)])],
    }),
    iso(Row {
        name: "SPB",
        size: [16.3, 13.0, 14.0],
        wedge: Some(Wedge::Degrees38),
        smallest: 140.0,
        mass: [0.195, 0.200],
        grooves: &[din(&[to(190.0, 34.0), above(38.0)])],
    }),
    iso(Row {
        name: "SPC",
        size: [22.0, 18.0, 19.0],
        wedge: Some(Wedge::Degrees38),
        smallest: 224.0,
        mass: [0.377, 0.350],
        grooves: &[din(&[to(315.0, 34.0), above(38.0)])],
    }),
];

/// A section of the effective system from its top width, its height and the effective width of its groove in mm,
/// its mass per length in kg/m, and what is known of pulleys.
const fn rma(
    [name, also]: [&'static str; 2],
    [top, height, effective]: [f64; 3],
    mass: Figure,
    smallest_diameter: Option<Figure>,
    grooves: &'static [GrooveRule],
) -> Section {
    Section {
        name,
        also,
        family: Family::NarrowRma,
        top_width: mm(top, &[RmaGlossary]),
        height: mm(height, &[OptibeltCatalogue]),
        datum_width: mm(effective, &[Iso8419]),
        pitch_line_depth: None,
        pitch_line_height: None,
        wedge_angle: None,
        grooves,
        smallest_diameter,
        mass: Some(mass),
        axial_stiffness: axial_stiffness(mass.value),
        transverse_modulus: transverse_modulus(),
    }
}

const fn gates(steps: &'static [GrooveStep]) -> GrooveRule {
    GrooveRule {
        standard: "RMA/MPTA IP-22",
        steps,
        sources: &[GatesGrooves],
    }
}

/// In the effective system, from small to large.
pub(super) const RMA: [Section; 3] = [
    rma(
        ["3V", "9N"],
        [9.5, 8.0, 8.9],
        Figure::printed(0.074, &[OptibeltCatalogue]),
        None,
        &[gates(&[
            to(90.0, 36.0),
            to(150.0, 38.0),
            to(300.0, 40.0),
            above(42.0),
        ])],
    ),
    rma(
        ["5V", "15N"],
        [15.9, 13.0, 15.2],
        Figure::printed(0.195, &[OptibeltCatalogue]),
        None,
        &[gates(&[to(250.0, 38.0), to(400.0, 40.0), above(42.0)])],
    ),
    rma(
        ["8V", "25N"],
        [25.4, 23.0, 25.4],
        Figure::printed(0.575, &[OptibeltCatalogue, Dealer]).within(0.52, 0.575),
        mm(315.0, &[Dealer]),
        &[gates(&[to(400.0, 38.0), to(560.0, 40.0), above(42.0)])],
    ),
];
