//! The numeric entries of a drive file that a branch can be traced over.

use super::{
    schema,
    traceable::{ENTRIES, Traceable},
};
use crate::drive::Number;
use crate::quantity::{Measure, UnitSystem};
use crate::{Drive, TwoPulleys};

/// A numeric entry of the drive file on which the steady state depends.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    entry: &'static Traceable,
    measure: Measure,
}

impl Key {
    /// Every entry that applies to a drive closed by the tensions of both spans, in the order of the drive file;
    /// none for another drive.
    pub fn all(drive: &Drive) -> impl Iterator<Item = Self> {
        ENTRIES
            .iter()
            .filter_map(Self::of)
            .filter(|key| key.applies(drive))
    }

    /// The entry of what a drive is loaded with: the driven torque where it is given, the tight
    /// tension otherwise.
    ///
    /// # Panics
    /// If the drive is not closed by the tensions of both spans.
    pub fn load(drive: &Drive) -> Self {
        let [tractive, belt] = schema::TIGHT;
        [schema::TORQUE, tractive, belt]
            .into_iter()
            .find_map(|path| Self::all(drive).find(|key| key.path() == path))
            .expect("a drive closed by both tensions has a load")
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
        self.measure.shown(UnitSystem::Si).symbol
    }

    /// The name of the entry in JSON and CSV, with its unit: the last part of its path, after the
    /// pulley where it belongs to one.
    pub fn column(&self) -> String {
        self.stem() + self.measure.stored().0
    }

    /// The name in JSON and CSV without its unit.
    pub(crate) fn stem(&self) -> String {
        match self.path().strip_prefix("pulleys.") {
            Some(name) => name.replace('.', "_"),
            None => schema::split(self.path()).1.to_owned(),
        }
    }

    /// What it measures.
    pub(crate) fn measure(&self) -> Measure {
        self.measure
    }

    /// A value in SI units in the unit of reports.
    pub fn reported(&self, value: f64) -> f64 {
        value * self.measure.stored().1
    }

    /// The value in a drive, SI.
    ///
    /// # Panics
    /// If the entry does not apply to the drive, such as a parameter of another friction law.
    pub fn get(&self, drive: &Drive) -> f64 {
        self.entry.get(drive).expect(OF_THIS_DRIVE)
    }

    /// Changes the value in a drive, SI.
    ///
    /// # Panics
    /// As [`Key::get`].
    pub fn set(&self, drive: &mut Drive, value: f64) {
        self.entry.set(drive, value).expect(OF_THIS_DRIVE);
    }

    /// Which number of a drive it is.
    ///
    /// # Panics
    /// As [`Key::get`].
    pub(crate) fn number(&self, drive: &TwoPulleys) -> Number {
        self.entry.number(drive).expect(OF_THIS_DRIVE)
    }

    /// Whether a drive has the entry.
    pub(super) fn applies(&self, drive: &Drive) -> bool {
        self.entry.get(drive).is_some()
    }

    /// The key of an entry, unless its dimension has no unit in reports.
    fn of(entry: &'static Traceable) -> Option<Self> {
        let dimension = schema::quantity_rule(entry.path)?.dimension;
        let measure = dimension.measure()?;
        Some(Self { entry, measure })
    }
}

/// What [`Key::get`] and [`Key::set`] expect.
const OF_THIS_DRIVE: &str = "an entry of this drive";

/// Keys are the same if their paths are.
impl PartialEq for Key {
    fn eq(&self, other: &Self) -> bool {
        self.path() == other.path()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::friction::ROWS;
    use crate::{examples, input};

    /// An example with overrides.
    type Variant = (&'static str, &'static [&'static str]);

    fn drive((example, overrides): (&str, &[&str])) -> Drive {
        let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
        let text = examples::find(example).unwrap().text;
        input::parse(example, text, &overrides).unwrap()
    }

    const VARIANTS: [Variant; 6] = [
        ("kim2009", &[]),
        ("kim2009", &["friction.law=epp", "load.tight_tension=800 N"]),
        (
            "kim2009",
            &["friction.law=bristle", "load.slack_tension=150 N"],
        ),
        ("kim2009-flat", &["friction.law=creep-rate"]),
        ("flat-unequal", &[]),
        (
            "flat-unequal",
            &["load.slack_tension=", "load.tight_tension=1 kN"],
        ),
    ];

    /// The variants, and a drive with each friction law and its parameter.
    fn variants() -> impl Iterator<Item = (&'static str, Vec<String>)> {
        let own = |(example, overrides): Variant| {
            let overrides = overrides.iter().map(|text| (*text).to_owned());
            (example, overrides.collect())
        };
        let laws = ROWS.iter().copied().map(|row| {
            let example = match row.in_grooves {
                true => "kim2009",
                false => "kim2009-flat",
            };
            let law = format!("friction.law={}", row.name);
            let parameter = row.parameter.as_ref();
            let parameter = parameter.map(|of| format!("{}={}", of.path, of.example));
            (example, [law].into_iter().chain(parameter).collect())
        });
        VARIANTS.into_iter().map(own).chain(laws)
    }

    #[test]
    fn every_entry_applies_to_some_drive_and_is_the_one_of_the_file() {
        let mut found = Vec::new();
        for (example, overrides) in variants() {
            let overrides: Vec<_> = overrides.iter().map(String::as_str).collect();
            let original = drive((example, &overrides));
            for key in Key::all(&original) {
                let value = 1.1 * key.get(&original);
                let assignment = format!("{}={value:e}", key.path());
                let overrides = [&overrides[..], &[assignment.as_str()]].concat();
                let mut changed = original.clone();
                key.set(&mut changed, value);
                assert_eq!(changed, drive((example, &overrides)), "{assignment}");
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
        for (example, overrides) in variants() {
            let overrides: Vec<_> = overrides.iter().map(String::as_str).collect();
            columns.extend(Key::all(&drive((example, &overrides))).map(|key| key.column()));
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
            "velocity_m_per_s",
            "centre_distance_m",
            "driven_torque_N_m",
        ] {
            assert!(columns.iter().any(|name| name == column), "{column}");
        }
    }

    #[test]
    fn the_load_is_the_driven_torque_or_else_the_tight_tension() {
        let paths = VARIANTS.map(|variant| Key::load(&drive(variant)).path());
        let [tractive, belt, .., slack_and_torque, tight_and_torque] = paths;
        assert_eq!(tractive, "load.tight_tractive_tension");
        assert_eq!(belt, "load.tight_tension");
        assert_eq!([slack_and_torque, tight_and_torque], [schema::TORQUE; 2]);
    }

    #[test]
    fn entries_apply_where_they_matter() {
        let paths = |variant| {
            let drive = drive(variant);
            Key::all(&drive).map(|key| key.path()).collect::<Vec<_>>()
        };
        let common = ["belt.mass_per_length", "belt.axial_stiffness"];
        let pulleys = [
            "pulleys.driver.radius",
            "pulleys.driver.speed",
            "pulleys.driven.radius",
            "layout.centre_distance",
        ];
        let creep_rate = ["friction.coefficient", "friction.velocity"];
        let load = ["load.slack_tension", "load.tight_tension"];
        assert_eq!(
            paths(VARIANTS[3]),
            [&common[..], &creep_rate, &pulleys, &load].concat()
        );
        let epp = ["friction.coefficient", "friction.stiffness"];
        let load = ["load.tight_tension", "load.driven_torque"];
        assert_eq!(
            paths(VARIANTS[5]),
            [&common[..], &epp, &pulleys, &load].concat()
        );
    }

    #[test]
    fn angles_are_reported_in_degrees() {
        let drive = drive(VARIANTS[0]);
        let mut keys = Key::all(&drive);
        let angle = keys.find(|key| key.path() == "groove.half_angle").unwrap();
        assert_eq!(angle.unit(), "°");
        assert!((angle.reported(angle.get(&drive)) - 18.0).abs() < 1e-12);
    }
}
