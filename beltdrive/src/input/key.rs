//! The numeric entries of a drive file that a branch can be traced over.

use super::{dimension::Dimension, schema};
use crate::{BeltKind, Drive, FrictionLaw, SpanTension, VBelt};

/// A numeric entry of the drive file on which the steady state depends.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    entry: &'static Traceable,
    unit: &'static ReportUnit,
}

/// An entry with the place of its value in a drive.
#[derive(Debug)]
struct Traceable {
    /// Its dotted path.
    path: &'static str,
    /// What it is called.
    name: &'static str,
    /// Where its value stands; `None` where the entry does not apply.
    slot: fn(&mut Drive) -> Option<&mut f64>,
}

const ENTRIES: [Traceable; 15] = [
    Traceable {
        path: "belt.mass_per_length",
        name: "mass per length",
        slot: |drive| Some(&mut drive.belt.mass_per_length),
    },
    Traceable {
        path: "belt.axial_stiffness",
        name: "axial stiffness",
        slot: |drive| Some(&mut drive.belt.axial_stiffness),
    },
    Traceable {
        path: "belt.radial_stiffness",
        name: "radial stiffness",
        slot: |drive| v_belt(drive).map(|belt| &mut belt.radial_stiffness),
    },
    Traceable {
        path: "groove.half_angle",
        name: "half groove angle",
        slot: |drive| v_belt(drive).map(|belt| &mut belt.half_angle),
    },
    Traceable {
        path: "friction.coefficient",
        name: "coefficient of friction",
        slot: |drive| Some(&mut drive.friction_coefficient),
    },
    Traceable {
        path: "friction.stiffness",
        name: "friction stiffness",
        slot: |drive| match &mut drive.law {
            FrictionLaw::Epp { stiffness } => Some(stiffness),
            _ => None,
        },
    },
    Traceable {
        path: "friction.bristle_stiffness",
        name: "bristle stiffness",
        slot: |drive| match &mut drive.law {
            FrictionLaw::Bristle { stiffness } => Some(stiffness),
            _ => None,
        },
    },
    Traceable {
        path: "pulleys.driver.radius",
        name: "driver radius",
        slot: |drive| Some(&mut drive.driver_radius),
    },
    Traceable {
        path: "pulleys.driver.speed",
        name: "driver speed",
        slot: |drive| Some(&mut drive.driver_speed),
    },
    Traceable {
        path: "pulleys.driven.radius",
        name: "driven radius",
        slot: |drive| Some(&mut drive.driven_radius),
    },
    Traceable {
        path: "layout.centre_distance",
        name: "centre distance",
        slot: |drive| Some(&mut drive.centre_distance),
    },
    Traceable {
        path: schema::SLACK[0],
        name: "slack tractive tension",
        slot: |drive| tractive(&mut drive.load.slack),
    },
    Traceable {
        path: schema::SLACK[1],
        name: "slack tension",
        slot: |drive| belt(&mut drive.load.slack),
    },
    Traceable {
        path: schema::TIGHT[0],
        name: "tight tractive tension",
        slot: |drive| tractive(&mut drive.load.tight),
    },
    Traceable {
        path: schema::TIGHT[1],
        name: "tight tension",
        slot: |drive| belt(&mut drive.load.tight),
    },
];

fn v_belt(drive: &mut Drive) -> Option<&mut VBelt> {
    match &mut drive.belt.kind {
        BeltKind::V(belt) => Some(belt),
        BeltKind::Flat { .. } => None,
    }
}

fn tractive(tension: &mut SpanTension) -> Option<&mut f64> {
    match tension {
        SpanTension::Tractive(value) => Some(value),
        _ => None,
    }
}

fn belt(tension: &mut SpanTension) -> Option<&mut f64> {
    match tension {
        SpanTension::Belt(value) => Some(value),
        _ => None,
    }
}

/// The unit in which reports show a dimension: SI, but degrees for angles.
#[derive(Debug)]
struct ReportUnit {
    dimension: Dimension,
    symbol: &'static str,
    /// The end of the names of columns.
    suffix: &'static str,
    from_si: fn(f64) -> f64,
}

const fn si(dimension: Dimension, symbol: &'static str, suffix: &'static str) -> ReportUnit {
    ReportUnit {
        dimension,
        symbol,
        suffix,
        from_si: std::convert::identity,
    }
}

const UNITS: [ReportUnit; 8] = [
    si(Dimension::NUMBER, "", ""),
    si(Dimension::FORCE, "N", "_N"),
    si(Dimension::LENGTH, "m", "_m"),
    si(Dimension::INVERSE_LENGTH, "1/m", "_per_m"),
    si(Dimension::MASS_PER_LENGTH, "kg/m", "_kg_per_m"),
    si(Dimension::FORCE_PER_AREA, "N/m²", "_N_per_m2"),
    si(Dimension::ANGULAR_SPEED, "rad/s", "_rad_per_s"),
    ReportUnit {
        dimension: Dimension::ANGLE,
        symbol: "°",
        suffix: "_deg",
        from_si: f64::to_degrees,
    },
];

impl Key {
    /// Every entry that applies to a drive, in the order of the drive file.
    pub fn all(drive: &Drive) -> impl Iterator<Item = Self> {
        ENTRIES
            .iter()
            .filter_map(Self::of)
            .filter(|key| key.applies(drive))
    }

    /// The entry of the tight tension: what a drive is loaded with.
    ///
    /// # Panics
    /// Never: every drive has one.
    pub fn tight_tension(drive: &Drive) -> Self {
        Self::all(drive)
            .find(|key| schema::TIGHT.contains(&key.path()))
            .expect("a drive has a tight tension")
    }

    /// The dotted path of the entry in the drive file.
    pub fn path(&self) -> &'static str {
        self.entry.path
    }

    /// What the entry is called in text.
    pub fn name(&self) -> &'static str {
        self.entry.name
    }

    /// The symbol of the unit in which reports show the entry: SI, but ° for angles; empty for a
    /// pure number.
    pub fn unit(&self) -> &'static str {
        self.unit.symbol
    }

    /// The name of the entry in JSON and CSV, with its unit: the last part of its path, after the
    /// pulley where it belongs to one.
    pub fn column(&self) -> String {
        let name = match self.path().strip_prefix("pulleys.") {
            Some(name) => name.replace('.', "_"),
            None => schema::split(self.path()).1.to_owned(),
        };
        name + self.unit.suffix
    }

    /// A value in SI units in the unit of reports.
    pub fn reported(&self, value: f64) -> f64 {
        (self.unit.from_si)(value)
    }

    /// The value in a drive, SI.
    ///
    /// # Panics
    /// If the entry does not apply to the drive, such as a stiffness of another friction law.
    pub fn get(&self, drive: &Drive) -> f64 {
        *self.slot(&mut drive.clone())
    }

    /// Changes the value in a drive, SI.
    ///
    /// # Panics
    /// As [`Key::get`].
    pub fn set(&self, drive: &mut Drive, value: f64) {
        *self.slot(drive) = value;
    }

    /// Whether a drive has the entry.
    pub(super) fn applies(&self, drive: &Drive) -> bool {
        (self.entry.slot)(&mut drive.clone()).is_some()
    }

    /// The key of an entry, unless its dimension has no unit in reports.
    fn of(entry: &'static Traceable) -> Option<Self> {
        let dimension = schema::quantity_rule(entry.path)?.dimension;
        let unit = UNITS.iter().find(|unit| unit.dimension == dimension)?;
        Some(Self { entry, unit })
    }

    fn slot<'d>(&self, drive: &'d mut Drive) -> &'d mut f64 {
        (self.entry.slot)(drive).expect("an entry of this drive")
    }
}

/// Keys are the same if their paths are.
impl PartialEq for Key {
    fn eq(&self, other: &Self) -> bool {
        self.path() == other.path()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{examples, input};

    /// The thesis drive with overrides.
    fn drive(overrides: &[&str]) -> Drive {
        let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
        let text = examples::find("kim2009").unwrap().text;
        input::parse("kim2009.toml", text, &overrides).unwrap()
    }

    const VARIANTS: [&[&str]; 3] = [
        &[],
        &["friction.law=epp", "load.tight_tension=800 N"],
        &["friction.law=bristle", "load.slack_tension=150 N"],
    ];

    #[test]
    fn every_entry_applies_to_some_drive_and_is_the_one_of_the_file() {
        let mut found = Vec::new();
        for overrides in VARIANTS {
            let original = drive(overrides);
            for key in Key::all(&original) {
                let value = 1.1 * key.get(&original);
                let assignment = format!("{}={value:e}", key.path());
                let overrides = [overrides, &[assignment.as_str()]].concat();
                let mut changed = original.clone();
                key.set(&mut changed, value);
                assert_eq!(changed, drive(&overrides), "{assignment}");
                assert_eq!(key.get(&changed), value);
                found.push(key.path());
            }
        }
        found.sort_unstable();
        found.dedup();
        assert_eq!(found.len(), ENTRIES.len());
    }

    #[test]
    fn columns_carry_units_and_are_unique() {
        let mut columns = Vec::new();
        for overrides in VARIANTS {
            columns.extend(Key::all(&drive(overrides)).map(|key| key.column()));
        }
        columns.sort_unstable();
        columns.dedup();
        assert_eq!(columns.len(), ENTRIES.len(), "{columns:?}");
        for column in [
            "tight_tractive_tension_N",
            "coefficient",
            "half_angle_deg",
            "driver_speed_rad_per_s",
            "bristle_stiffness_per_m",
            "centre_distance_m",
        ] {
            assert!(columns.iter().any(|name| name == column), "{column}");
        }
    }

    #[test]
    fn the_load_is_the_tight_tension_of_the_file() {
        let [tractive, belt, _] = VARIANTS.map(|overrides| Key::tight_tension(&drive(overrides)));
        assert_eq!(tractive.path(), "load.tight_tractive_tension");
        assert_eq!(belt.path(), "load.tight_tension");
        assert!(tractive != belt);
    }

    #[test]
    fn angles_are_reported_in_degrees() {
        let drive = drive(&[]);
        let mut keys = Key::all(&drive);
        let angle = keys.find(|key| key.path() == "groove.half_angle").unwrap();
        assert_eq!(angle.unit(), "°");
        assert!((angle.reported(angle.get(&drive)) - 18.0).abs() < 1e-12);
    }
}
