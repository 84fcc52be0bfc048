//! The stability of the axial motion as JSON: complete, at full precision, every key with its unit.

use super::meaning::meaning;
use super::words::{form_description, form_key, least_stable};
use crate::input::Key;
use crate::report::{belt::BeltReport, json::pretty, value::Named};
use crate::{AxialMode, FormStability, Onset, PulleyStability, ShapePoint, Stability};
use serde::{Serialize, Serializer};
use std::f64::consts::TAU;

/// The eigenvalues on both pulleys, in every form, as pretty-printed JSON; of the first modes with
/// their shapes.
pub fn json(stability: &Stability) -> String {
    let drive = &stability.drive;
    let key = Key::load(drive);
    pretty(&Report {
        title: drive.title.as_deref(),
        belt: BeltReport::from(drive),
        friction_law: drive.law.name(),
        load: Named(key, key.get(drive)),
        critical_speed_m_per_s: stability.critical_speed,
        driver: PulleyReport::of(key, &stability.driver),
        driven: PulleyReport::of(key, &stability.driven),
        meaning: meaning(stability),
        seconds: stability.seconds,
    })
}

#[derive(Serialize)]
struct Report<'a> {
    title: Option<&'a str>,
    #[serde(flatten)]
    belt: BeltReport,
    friction_law: &'static str,
    load: Named,
    critical_speed_m_per_s: f64,
    driver: PulleyReport<'a>,
    driven: PulleyReport<'a>,
    meaning: String,
    seconds: f64,
}

#[derive(Serialize)]
struct PulleyReport<'a> {
    belt_speed_m_per_s: f64,
    contact_length_m: f64,
    /// Where slip begins, from the entry.
    transition_m: f64,
    slips: bool,
    forms: Forms<'a>,
}

impl<'a> PulleyReport<'a> {
    fn of(key: Key, on: &'a PulleyStability) -> Self {
        Self {
            belt_speed_m_per_s: on.belt_speed,
            contact_length_m: on.contact_length,
            transition_m: on.transition,
            slips: on.transition < on.contact_length,
            forms: Forms(key, &on.forms),
        }
    }
}

/// The forms as a map by their names.
struct Forms<'a>(Key, &'a [FormStability; 3]);

impl Serialize for Forms<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self(key, forms) = *self;
        let reports = forms.iter().map(|form| FormReport::of(key, form));
        serializer.collect_map(forms.iter().map(|form| form_key(form.form)).zip(reports))
    }
}

#[derive(Serialize)]
struct FormReport<'a> {
    description: &'static str,
    modes: Vec<ModeReport<'a>>,
    largest_growth: LargestGrowth,
    high_mode_limit_per_s: f64,
    grows: bool,
    /// Eigenvalues in the box by the argument principle, all of them found.
    counted: usize,
    #[serde(rename = "box")]
    within: BoxReport,
    onset: Option<OnsetReport>,
}

impl<'a> FormReport<'a> {
    fn of(key: Key, form: &'a FormStability) -> Self {
        let modes = form.modes.iter().enumerate();
        let [growth_bound_per_s, angular_frequency_bound_rad_per_s] = form.within;
        Self {
            description: form_description(form.form),
            modes: modes
                .map(|(index, mode)| ModeReport::of(index + 1, mode))
                .collect(),
            largest_growth: LargestGrowth {
                growth_per_s: form.largest_growth(),
                mode: least_stable(form).1,
            },
            high_mode_limit_per_s: form.high_mode_limit,
            grows: form.is_unstable(),
            counted: form.counted,
            within: BoxReport {
                growth_bound_per_s,
                angular_frequency_bound_rad_per_s,
            },
            onset: match form.onset {
                Some(Onset::At { load, mode }) => Some(OnsetReport {
                    load: Named(key, load),
                    mode,
                }),
                Some(Onset::Never) | None => None,
            },
        }
    }
}

/// The mode is null where all grow or decay alike.
#[derive(Serialize)]
struct LargestGrowth {
    growth_per_s: f64,
    mode: Option<usize>,
}

/// Bounds of the magnitudes of the real and imaginary part.
#[derive(Serialize)]
struct BoxReport {
    growth_bound_per_s: f64,
    angular_frequency_bound_rad_per_s: f64,
}

/// The load from which on a motion grows; `mode` is null for the high ones.
#[derive(Serialize)]
struct OnsetReport {
    #[serde(flatten)]
    load: Named,
    mode: Option<usize>,
}

#[derive(Serialize)]
struct ModeReport<'a> {
    number: usize,
    growth_per_s: f64,
    angular_frequency_rad_per_s: f64,
    #[serde(rename = "frequency_Hz")]
    frequency_hz: f64,
    method_difference: f64,
    grows: bool,
    #[serde(skip_serializing_if = "Shape::is_empty")]
    shape: Shape<'a>,
}

impl<'a> ModeReport<'a> {
    fn of(number: usize, mode: &'a AxialMode) -> Self {
        Self {
            number,
            growth_per_s: mode.growth,
            angular_frequency_rad_per_s: mode.frequency,
            frequency_hz: mode.frequency / TAU,
            method_difference: mode.difference,
            grows: mode.grows(),
            shape: Shape(&mode.shape),
        }
    }
}

/// A shape as columns.
struct Shape<'a>(&'a [ShapePoint]);

impl Shape<'_> {
    fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl Serialize for Shape<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        type Column = (&'static str, fn(&ShapePoint) -> f64);
        let columns: [Column; 3] = [
            ("arc_length_m", |point| point.arc_length),
            ("real", |point| point.value[0]),
            ("imaginary", |point| point.value[1]),
        ];
        let values = |of: fn(&ShapePoint) -> f64| self.0.iter().map(of).collect::<Vec<_>>();
        serializer.collect_map(columns.map(|(name, of)| (name, values(of))))
    }
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;
    use serde_json::Value;

    #[test]
    fn is_complete() {
        let stability = sample::stability();
        let report: Value = serde_json::from_str(&json(&stability)).unwrap();
        assert_eq!(report["load"]["tight_tractive_tension_N"], 420.0);
        let driver = &report["driver"];
        assert_eq!(driver["slips"], true);
        let thesis = &driver["forms"]["thesis"];
        assert_eq!(thesis["modes"].as_array().unwrap().len(), sample::MODES);
        let second = &thesis["modes"][1];
        assert_eq!(second["number"], 2);
        assert_eq!(second["angular_frequency_rad_per_s"], 20_000.0);
        assert_eq!(second["frequency_Hz"], 20_000.0 / TAU);
        assert_eq!(second["grows"], false);
        assert_eq!(thesis["largest_growth"]["mode"], 4);
        assert_eq!(thesis["grows"], false);
        assert!(driver["forms"]["conservative"]["largest_growth"]["mode"].is_null());
        assert_eq!(thesis["onset"]["tight_tractive_tension_N"], 480.0);
        assert_eq!(thesis["onset"]["mode"], 2);
        assert_eq!(thesis["box"]["growth_bound_per_s"], 90.0);
        assert_eq!(thesis["counted"], 8);
        assert!(report["driven"]["forms"]["thesis"]["onset"].is_null());
        assert!(driver["forms"]["conservative"]["onset"].is_null());
        let natural = &driver["forms"]["natural_outlet"];
        assert!(natural["onset"]["mode"].is_null() && natural["grows"] == true);
        assert!(report["meaning"].as_str().unwrap().contains("480 N"));
    }

    #[test]
    fn the_first_modes_have_a_shape() {
        let stability = sample::stability();
        let report: Value = serde_json::from_str(&json(&stability)).unwrap();
        let modes = &report["driven"]["forms"]["thesis"]["modes"];
        let shape = &modes[0]["shape"];
        for column in ["arc_length_m", "real", "imaginary"] {
            let values = shape[column].as_array().unwrap();
            assert_eq!(values.len(), stability.driven.forms[0].modes[0].shape.len());
        }
        assert_eq!(shape["arc_length_m"][0], 0.0);
        assert!(modes[3].get("shape").is_none());
    }
}
