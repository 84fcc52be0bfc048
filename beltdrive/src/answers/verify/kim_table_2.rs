//! Kim (2009), table 2: the flat belt at three stiffnesses of its friction.

use super::drives::{Failure, kim_flat, state};
use super::{Comparison, Criterion, Published, Section, computed};
use crate::{Drive, PulleyState, SteadyState, ZoneKind};

const SPEED: &str = "the thesis has the speed from its finite-element model; here it follows from the \
                     tensions, ω₁/ω₂ = (EA + T_o1)/(EA + T_o2)";
const TORQUE: &str = "the thesis contradicts itself: its tensions have the torque \
                      (716.7 N − 155.1 N) R = 45.6 N·m";
const STIFFNESS: &str = "computed at the smallest stiffness at which the driven pulley slips, which the \
                         thesis prints rounded: the arcs of the driven pulley are then no test, the \
                         other numbers are";

/// A column of the table.
pub(super) struct Column {
    title: &'static str,
    /// Printed friction stiffness, N/m²; the smallest at which the driven pulley slips if none.
    stiffness: Option<f64>,
    /// Printed tensions of the slack and of the tight span, N.
    pub(super) printed_tensions: [Published; 2],
    /// Transition and slip arc of the driven pulley, then of the driver, rad.
    pub(super) arcs: [Published; 4],
    reference_tension: &'static str,
    strain: Published,
    /// The computed driven speed where it is not the printed one, rad/s.
    speed: Option<f64>,
    /// The computed torque, likewise, N·m.
    torque: Option<f64>,
}

/// The table.
pub(super) const COLUMNS: [Column; 3] = [
    Column {
        title: "Table 2, k_f = 2.8e7 N/m², T_L = 156.2 N, T_H = 712.2 N",
        stiffness: None,
        printed_tensions: [Published::new("156.2"), Published::new("712.2")],
        arcs: [
            Published::new("3.14"),
            Published::with_place("0", -2),
            Published::new("2.34"),
            Published::new("0.80"),
        ],
        reference_tension: "146.4",
        strain: Published::new("1.2e-4"),
        speed: None,
        torque: None,
    },
    Column {
        title: "Table 2, k_f = 2.0e8 N/m², T_L = 155.1 N, T_H = 716.7 N",
        stiffness: Some(2.0e8),
        printed_tensions: [Published::new("155.1"), Published::new("716.7")],
        arcs: [
            Published::new("2.16"),
            Published::new("0.98"),
            Published::new("2.08"),
            Published::new("1.06"),
        ],
        reference_tension: "155.1",
        strain: Published::new("2.5e-7"),
        speed: Some(119.1657),
        torque: Some(45.6245),
    },
    Column {
        title: "Table 2, k_f = 8.1e9 N/m², T_L = 158.3 N, T_H = 707.1 N",
        stiffness: Some(8.1e9),
        printed_tensions: [Published::new("158.3"), Published::new("707.1")],
        arcs: [
            Published::new("1.93"),
            Published::new("1.21"),
            Published::new("1.93"),
            Published::new("1.21"),
        ],
        reference_tension: "158.3",
        // The other strains are printed to 1e-8 at least.
        strain: Published::with_place("0", -8),
        speed: Some(119.1847),
        torque: None,
    },
];

pub(super) fn sections() -> Vec<Section> {
    COLUMNS.iter().map(Column::section).collect()
}

impl Column {
    /// Tensions of the slack and of the tight span, N.
    pub(super) fn tensions(&self) -> [f64; 2] {
        self.printed_tensions.map(|tension| tension.value())
    }

    fn drive(&self) -> Result<Drive, Failure> {
        let stiffness = match self.stiffness {
            Some(printed) => printed,
            None => smallest_stiffness(self.tensions())?,
        };
        kim_flat(stiffness, self.tensions())
    }

    fn section(&self) -> Section {
        let solved = self.drive().and_then(|drive| state(&drive));
        let row = |quantity, unit, published, criterion, number: fn(&SteadyState) -> f64| {
            let number = computed(&solved, number);
            Comparison::new(quantity, unit, published, criterion, number)
        };
        let digits = Criterion::Digits;
        let [transition, slip] = ["transition, driven pulley", "slip arc, driven pulley"];
        let [on_driver, driver_slip] = ["transition, driver", "slip arc, driver"];
        let mut comparisons = vec![
            row(transition, "rad", self.arcs[0], digits, |s| {
                transition_angle(&s.driven)
            }),
            row(slip, "rad", self.arcs[1], digits, |s| slip_arc(&s.driven)),
            row(on_driver, "rad", self.arcs[2], digits, |s| {
                transition_angle(&s.driver)
            }),
            row(driver_slip, "rad", self.arcs[3], digits, |s| {
                slip_arc(&s.driver)
            }),
            row(
                "reference tension T_o, driven pulley",
                "N",
                Published::new(self.reference_tension),
                digits,
                |s| {
                    s.driven
                        .entry
                        .map_or(f64::NAN, |entry| entry.reference_tension)
                },
            ),
            row(
                "entry strain, driven pulley",
                "",
                self.strain,
                digits,
                |s| s.driven.entry.map_or(f64::NAN, |entry| entry.strain),
            ),
            row(
                "driven speed ω₁",
                "rad/s",
                Published::new("119.1"),
                self.speed
                    .map_or(digits, |speed| Criterion::known(SPEED, speed, 5e-4)),
                |s| s.driven.angular_speed,
            ),
            row(
                "torque",
                "N·m",
                Published::new("45"),
                self.torque
                    .map_or(digits, |torque| Criterion::known(TORQUE, torque, 1e-3)),
                |s| s.driven.torque,
            ),
        ];
        if self.stiffness.is_none() {
            let arcs_and_entry = comparisons.drain(..6);
            let mut remarked: Vec<_> = arcs_and_entry.map(|row| row.remarked(STIFFNESS)).collect();
            remarked.append(&mut comparisons);
            comparisons = remarked;
        }
        Section {
            title: self.title,
            comparisons,
        }
    }
}

/// The friction stiffness below which the driven pulley does not slip at these tensions, N/m².
pub(super) fn smallest_stiffness(tensions: [f64; 2]) -> Result<f64, Failure> {
    // It depends on the tensions only, not on the stiffness of the drive.
    let state = state(&kim_flat(2.0e8, tensions)?)?;
    let entry = state.driven.entry;
    let smallest = entry.and_then(|entry| entry.smallest_stiffness);
    smallest.ok_or(Failure::Missing("a smallest stiffness"))
}

/// The column with the smallest stiffness.
pub(super) const SOFTEST: &Column = &COLUMNS[0];

/// The column with the greatest stiffness, and that stiffness, N/m².
pub(super) const STIFFEST: (&Column, f64) = (&COLUMNS[2], 8.1e9);

/// Where the belt begins to slip, rad from the entry.
pub(super) fn transition_angle(pulley: &PulleyState) -> f64 {
    pulley.wrap_angle - slip_arc(pulley)
}

/// The arc at the exit over which the belt slips, rad.
pub(super) fn slip_arc(pulley: &PulleyState) -> f64 {
    let slipping = pulley
        .zones
        .iter()
        .filter(|zone| zone.kind == ZoneKind::Slip);
    slipping.map(|zone| zone.to - zone.from).sum()
}
