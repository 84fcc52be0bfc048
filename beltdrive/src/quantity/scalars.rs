//! The scalars of a steady state of a drive with two pulleys: the same wherever a state stands.

use super::precision::known;
use super::scale::Scale;
use super::two_pulleys::is_v;
use super::{Measure, Quantity, USUAL, Value, words};
use crate::{Drive, PulleyErrors, PulleySummary, StateErrors, StateSummary, Zone};

/// The scalars of a state, with errors.
pub(super) struct Scalars<'a> {
    drive: &'a Drive,
    state: &'a StateSummary,
    /// Those that are known one by one.
    errors: Option<&'a StateErrors>,
    /// What the others are relative to.
    scale: Scale,
}

impl<'a> Scalars<'a> {
    /// Those of a state of a drive, which is known to a tolerance where its error is not estimated.
    pub(super) fn of(
        drive: &'a Drive,
        state: &'a StateSummary,
        tolerance: f64,
        errors: Option<&'a StateErrors>,
    ) -> Self {
        Self {
            drive,
            state,
            errors,
            scale: Scale {
                error: state
                    .error_estimate
                    .unwrap_or(tolerance)
                    .clamp(EXACT, VAGUE),
                tension: state.tight_tension,
                power: state.driver.power(),
            },
        }
    }

    /// All of them.
    pub(super) fn all(&self) -> Vec<Quantity> {
        let mut all = self.whole();
        let named = [("driver", "driver"), ("driven", "driven")].into_iter();
        all.extend(
            named
                .zip(self.pulleys())
                .map(|((key, label), pulley)| Quantity {
                    label: label.into(),
                    ..Quantity::data(key, Measure::Number, Value::Object(Some(pulley)))
                }),
        );
        all.extend(self.tensions());
        all
    }

    /// Some of them for a row of a table, by their keys in CSV, under labels of their own; all for programs.
    pub(super) fn row(&self, shown: &[(&str, &'static str)]) -> Vec<Quantity> {
        let all = self.all();
        let flat = super::flat(&all);
        let find = |key: &str| flat.iter().find(|quantity| quantity.key == key).cloned();
        let shown = shown.iter();
        let shown = shown.filter_map(|(key, label)| Some(find(key)?.shown_as(*label)));
        shown
            .chain(all.into_iter().map(Quantity::unlabelled))
            .collect()
    }

    /// Those of the drive as a whole.
    pub(super) fn whole(&self) -> Vec<Quantity> {
        let (state, scale) = (self.state, &self.scale);
        let of_v = if is_v(self.drive) {
            "compression of the belt"
        } else {
            ""
        };
        let length = |key, label, value| scale.relative(key, label, Measure::Length, value);
        let efficiency = Quantity::number(
            "efficiency",
            "efficiency",
            Measure::Share,
            state.efficiency,
            self.errors
                .map_or(self.scale.error, |errors| errors.efficiency),
        );
        vec![
            length("belt_length", "belt length, unstretched", state.belt_length),
            length("slack_span", "slack span", state.slack_span),
            length("tight_span", "tight span", state.tight_span),
            scale.relative("mass_flow", "mass flow", Measure::MassFlow, state.mass_flow),
            scale.against(
                "speed_loss",
                words::speed_loss(self.drive.belt.kind).0,
                Measure::Share,
                state.speed_loss,
                1.0,
            ),
            efficiency,
            scale.loss("friction_loss", "friction loss", state.friction_loss),
            scale.loss("compression_power", of_v, state.compression_power),
        ]
    }

    /// The tensions of the spans.
    pub(super) fn tensions(&self) -> [Quantity; 2] {
        let state = self.state;
        let tensions = |key, label: &'static str, slack, tight| Quantity {
            label: label.into(),
            error: self.scale.error * state.tight_tension.abs(),
            ..Quantity::data(
                key,
                Measure::Force,
                Value::Parts(vec![("slack", slack), ("tight", tight)]),
            )
        };
        let (belt, tractive) = ("belt tension T", "tractive tension F");
        [
            tensions("tension", belt, state.slack_tension, state.tight_tension),
            tensions(
                "tractive_tension",
                tractive,
                state.slack_tractive_tension,
                state.tight_tractive_tension,
            ),
        ]
    }

    /// Those of the driver and of the driven pulley.
    pub(super) fn pulleys(&self) -> [Vec<Quantity>; 2] {
        let errors = self.errors;
        [
            self.pulley(&self.state.driver, errors.map(|errors| &errors.driver)),
            self.pulley(&self.state.driven, errors.map(|errors| &errors.driven)),
        ]
    }

    fn pulley(&self, pulley: &PulleySummary, errors: Option<&PulleyErrors>) -> Vec<Quantity> {
        let (drive, state, scale) = (self.drive, self.state, &self.scale);
        let is_v = is_v(drive);
        let of_v = |label: &'static str| if is_v { label } else { "" };
        let error =
            |of: fn(&PulleyErrors) -> f64, size: f64| errors.map_or(scale.error * size.abs(), of);
        let number = Quantity::number;
        // A torque is a difference of tensions.
        let torque =
            state.tight_tension * drive.pair().driver_radius.max(drive.pair().driven_radius);
        let torque = error(|errors| errors.torque, torque);
        let speed = error(|errors| errors.angular_speed, state.driver.angular_speed);
        let wrap = error(|errors| errors.wrap_angle, 1.0);
        let tilts = [
            error(|errors| errors.inclination[0], 1.0),
            error(|errors| errors.inclination[1], 1.0),
        ];
        let penetration = pulley.max_penetration;
        let sunk = error(|errors| errors.max_penetration, penetration);
        let [entry, exit] = pulley.inclination;
        let degrees = pulley.inclination.map(f64::to_degrees);
        let power = torque * pulley.angular_speed.abs();
        let mut quantities = vec![
            number(
                "angular_speed",
                "speed",
                Measure::AngularSpeed,
                pulley.angular_speed,
                speed,
            ),
            number("torque", "torque", Measure::Torque, pulley.torque, torque),
            number("power", "power", Measure::Power, pulley.power(), power),
            number(
                "wrap_angle",
                "wrap angle",
                Measure::Angle,
                pulley.wrap_angle,
                wrap,
            ),
            scale.angle(
                "geometric_wrap_angle",
                of_v("of the pitch circles"),
                pulley.geometric_wrap_angle,
            ),
            number(
                "max_penetration",
                of_v("largest penetration"),
                Measure::Length,
                penetration,
                sunk,
            ),
            number(
                "entry_inclination",
                of_v("inclination at entry"),
                Measure::Angle,
                entry,
                tilts[0],
            ),
            number(
                "exit_inclination",
                of_v("inclination at exit"),
                Measure::Angle,
                exit,
                tilts[1],
            ),
            Quantity::json("inclination_deg", degrees.to_vec()),
            scale.angle("slip_arc", "slip arc", words::slip_arc(&pulley.zones)),
        ];
        if let Some(least) = pulley.least_slip {
            quantities.extend(scale.least_slip(&least));
            quantities.extend(scale.locked(Some(&least)));
        }
        if !is_v {
            let entry = pulley.entry;
            let tension = entry.map(|entry| entry.reference_tension);
            let stiffness = entry.and_then(|entry| entry.smallest_stiffness);
            quantities.extend([
                scale.against(
                    "reference_tension",
                    "reference tension T_o",
                    Measure::Force,
                    tension,
                    state.tight_tension,
                ),
                // It decays along the elastic zone: its error is relative to itself however small it is.
                scale.relative(
                    "entry_strain",
                    "entry strain",
                    Measure::Number,
                    entry.map(|entry| entry.strain),
                ),
                scale.relative(
                    "smallest_friction_stiffness",
                    "smallest k_f with slip",
                    Measure::ForcePerArea,
                    stiffness,
                ),
            ]);
        }
        quantities.push(scale.zones(&pulley.zones));
        quantities
    }

    /// A friction zone and its angles, by its place on the pulley.
    pub(super) fn extent(&self, place: usize, zone: Option<&Zone>) -> Quantity {
        let error = self.scale.error.to_degrees();
        let angle = |angle: f64| known(angle.to_degrees(), error, USUAL.into());
        let extent = zone.map(|zone| {
            let (from, to) = (angle(zone.from), angle(zone.to));
            format!("{} {from} – {to}", zone.kind.name())
        });
        Quantity {
            measure: Measure::Angle,
            ..Quantity::word("", if place == 0 { "zones" } else { "  then" }, extent)
        }
    }
}

/// Bounds of an error that decides on digits, so that some digit remains.
const EXACT: f64 = 1e-12;
const VAGUE: f64 = 0.1;
