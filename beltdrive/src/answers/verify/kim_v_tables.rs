//! Kim (2009), tables 4 and 5: the V-belt with Coulomb and with elastic/perfectly-plastic friction.

use super::drives::{kim_v, state};
use super::{Comparison, Criterion, Published, Section, computed};
use crate::SteadyState;

const ROUNDED: &str = "0.0015° beyond half a unit: a relative error of 1e-5 in the printed number is \
                       enough to round it up";
const SINGULAR: &str = "the printed row is no converged solution: the thesis divides by the cosine of the \
                        inclination, which passes through zero at 7523.08 N, at the exit of the driver";
const CUT: &str = "the computed number has the printed digits; they are cut off, not rounded";
const DRIVER: &str = "on the driver nearly everything slips, where this friction is Coulomb friction; the \
                      printed angle is 0.3° to 1.2° above that of table 4";
const AMBIGUOUS: &str = "text and program of the thesis state this friction differently, and no reading \
                         gives the printed number; with this one, f = min(k_f |u|, μ p) against the \
                         slip, two independent discretisations agree on 86.371";

const TITLES: [&str; 2] = ["wrap angle φ₁, driven pulley", "wrap angle φ₂, driver"];

/// A row of a table: driven speed in rad/s, mass flow in kg/s, and the wrap angles of the driven pulley
/// and of the driver in degrees.
struct Row {
    title: &'static str,
    law: &'static str,
    /// Printed tension of the tight span, N.
    tight: f64,
    printed: [&'static str; 4],
    criteria: [Criterion; 4],
}

const AGREES: Criterion = Criterion::Digits;

const fn coulomb(
    title: &'static str,
    tight: f64,
    printed: [&'static str; 4],
    criteria: [Criterion; 4],
) -> Row {
    Row {
        title,
        law: "coulomb",
        tight,
        printed,
        criteria,
    }
}

const fn epp(
    title: &'static str,
    tight: f64,
    printed: [&'static str; 4],
    criteria: [Criterion; 4],
) -> Row {
    let law = "epp";
    Row {
        law,
        ..coulomb(title, tight, printed, criteria)
    }
}

/// A known difference; computed numbers are far more accurate than what is allowed for here.
const fn known(reason: &'static str, expected: f64) -> Criterion {
    Criterion::known(reason, expected, 2e-4)
}

const ROWS: [Row; 8] = [
    coulomb(
        "Table 4, Coulomb friction, T_H = 700 N",
        700.0,
        ["102.7", "2.8", "194.7", "198.3"],
        [AGREES; 4],
    ),
    coulomb(
        "Table 4, Coulomb friction, T_H = 1200 N",
        1200.0,
        ["100.4", "2.7", "198.6", "204.8"],
        [AGREES; 4],
    ),
    coulomb(
        "Table 4, Coulomb friction, T_H = 3000 N",
        3000.0,
        ["87.1", "2.6", "208.4", "224.4"],
        [AGREES, AGREES, known(ROUNDED, 208.3485), AGREES],
    ),
    coulomb(
        "Table 4, Coulomb friction, T_H = 7781.2 N",
        7781.2,
        ["30.9", "2.2", "230.4", "293.8"],
        [
            known(SINGULAR, 29.7819),
            AGREES,
            known(SINGULAR, 229.9793),
            known(SINGULAR, 291.9570),
        ],
    ),
    epp(
        "Table 5, EPP friction, T_H = 700 N",
        700.0,
        ["102.7", "2.8", "194.8", "199.5"],
        [
            AGREES,
            AGREES,
            known(CUT, 194.8897),
            known(DRIVER, 198.2911),
        ],
    ),
    epp(
        "Table 5, EPP friction, T_H = 1200 N",
        1200.0,
        ["100.4", "2.7", "198.8", "205.1"],
        [
            known(CUT, 100.4506),
            AGREES,
            known(CUT, 198.8973),
            known(DRIVER, 204.7982),
        ],
    ),
    epp(
        "Table 5, EPP friction, T_H = 3000 N",
        3000.0,
        ["86.9", "2.6", "208.6", "225.6"],
        [
            known(AMBIGUOUS, 86.3713),
            AGREES,
            AGREES,
            known(DRIVER, 224.4373),
        ],
    ),
    epp(
        "Table 5, EPP friction, T_H = 7781.2 N",
        7781.2,
        ["16.9", "2.2", "227.8", "284.5"],
        [
            known(SINGULAR, 5.5134),
            AGREES,
            known(SINGULAR, 229.3269),
            known(SINGULAR, 291.8888),
        ],
    ),
];

pub(super) fn sections() -> Vec<Section> {
    ROWS.iter().map(Row::section).collect()
}

impl Row {
    fn section(&self) -> Section {
        let solved = kim_v(self.law, self.tight).and_then(|drive| state(&drive));
        let row = |column: usize, quantity, unit, number: fn(&SteadyState) -> f64| {
            Comparison::new(
                quantity,
                unit,
                Published::new(self.printed[column]),
                self.criteria[column],
                computed(&solved, number),
            )
        };
        Section {
            title: self.title,
            comparisons: vec![
                row(0, "driven speed ω₁", "rad/s", |s| s.driven.angular_speed),
                row(1, "mass flow G", "kg/s", |s| s.mass_flow),
                row(2, TITLES[0], "°", |s| s.driven.wrap_angle.to_degrees()),
                row(3, TITLES[1], "°", |s| s.driver.wrap_angle.to_degrees()),
            ],
        }
    }
}
