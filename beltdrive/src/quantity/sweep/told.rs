//! The numbers of a steady state in the columns of a sweep.

use crate::belt_loop::{LoopState, PulleyState, SpanState};
use crate::quantity::two_pulleys::is_v;
use crate::quantity::{Measure, Quantity, Value, words};
use crate::{Drive, PulleySummary, StateSummary};
use std::borrow::Cow;

/// The number of a state, SI, if the state has it.
type Of<S> = Box<dyn Fn(&S) -> Option<f64> + Send + Sync>;

/// A number of a state `S`.
pub(super) struct Told<S> {
    key: Cow<'static, str>,
    measure: Measure,
    of: Of<S>,
}

impl<S> Told<S> {
    fn new(
        key: impl Into<Cow<'static, str>>,
        measure: Measure,
        of: impl Fn(&S) -> Option<f64> + Send + Sync + 'static,
    ) -> Self {
        Self {
            key: key.into(),
            measure,
            of: Box::new(of),
        }
    }

    /// Its column, without a value.
    pub(super) fn column(&self) -> Quantity {
        number(self.key.clone(), self.measure)
    }

    /// Its value.
    pub(super) fn value(&self, state: &S) -> Value {
        Value::Number((self.of)(state))
    }
}

/// The column of a number.
pub(super) fn number(key: impl Into<Cow<'static, str>>, measure: Measure) -> Quantity {
    Quantity::number(key, "", measure, None, 0.0)
}

/// The numbers of two pulleys that are closed by the tensions of both spans, under their keys in `trace`.
pub(super) fn of_drive(drive: &Drive) -> Vec<Told<StateSummary>> {
    type OfWhole = fn(&StateSummary) -> f64;
    type OfPulley = fn(&PulleySummary) -> Option<f64>;
    let is_v = is_v(drive);
    let whole: [(&str, Measure, OfWhole); 11] = [
        ("belt_length", Measure::Length, |state| state.belt_length),
        ("slack_span", Measure::Length, |state| state.slack_span),
        ("tight_span", Measure::Length, |state| state.tight_span),
        ("mass_flow", Measure::MassFlow, |state| state.mass_flow),
        ("speed_loss", Measure::Share, |state| state.speed_loss),
        ("efficiency", Measure::Share, |state| state.efficiency),
        ("friction_loss", Measure::Loss, |state| state.friction_loss),
        ("slack_tension", Measure::Force, |state| state.slack_tension),
        ("tight_tension", Measure::Force, |state| state.tight_tension),
        ("slack_tractive_tension", Measure::Force, |state| {
            state.slack_tractive_tension
        }),
        ("tight_tractive_tension", Measure::Force, |state| {
            state.tight_tractive_tension
        }),
    ];
    let mut told: Vec<_> = { whole.into_iter() }
        .map(|(key, measure, of)| Told::new(key, measure, move |state| Some(of(state))))
        .collect();
    let of_any: [(&str, Measure, OfPulley); 5] = [
        ("angular_speed", Measure::AngularSpeed, |pulley| {
            Some(pulley.angular_speed)
        }),
        ("torque", Measure::Torque, |pulley| Some(pulley.torque)),
        ("power", Measure::Power, |pulley| Some(pulley.power())),
        ("wrap_angle", Measure::Angle, |pulley| {
            Some(pulley.wrap_angle)
        }),
        ("slip_arc", Measure::Angle, |pulley| {
            Some(words::slip_arc(&pulley.zones))
        }),
    ];
    let of_v: [(&str, Measure, OfPulley); 3] = [
        ("max_penetration", Measure::Length, |pulley| {
            Some(pulley.max_penetration)
        }),
        ("entry_inclination", Measure::Angle, |pulley| {
            Some(pulley.inclination[0])
        }),
        ("exit_inclination", Measure::Angle, |pulley| {
            Some(pulley.inclination[1])
        }),
    ];
    let of_flat: [(&str, Measure, OfPulley); 1] =
        [("reference_tension", Measure::Force, |pulley| {
            Some(pulley.entry?.reference_tension)
        })];
    let own = if is_v { &of_v[..] } else { &of_flat };
    for (name, is_driver) in [("driver", true), ("driven", false)] {
        for &(key, measure, of) in of_any.iter().chain(own) {
            let key = format!("{name}_{key}");
            told.push(Told::new(key, measure, move |state: &StateSummary| {
                of(if is_driver {
                    &state.driver
                } else {
                    &state.driven
                })
            }));
        }
    }
    if is_v {
        told.push(Told::new(
            "compression_power",
            Measure::Loss,
            |state: &StateSummary| Some(state.compression_power),
        ));
    }
    told.push(Told::new(
        "error_estimate",
        Measure::Number,
        |state: &StateSummary| state.error_estimate,
    ));
    told
}

/// The numbers of any other drive, under their keys in `trace`.
pub(super) fn of_loop(drive: &Drive) -> Vec<Told<LoopState>> {
    type OfWhole = fn(&LoopState) -> Option<f64>;
    type OfPulley = fn(&PulleyState) -> f64;
    type OfSpan = fn(&SpanState) -> f64;
    let whole: [(&str, Measure, OfWhole); 10] = [
        ("belt_length_unstretched", Measure::Length, |state| {
            Some(state.unstretched_length)
        }),
        ("belt_length_running", Measure::Length, |state| {
            Some(state.length)
        }),
        ("mass_flow", Measure::MassFlow, |state| {
            Some(state.mass_flow)
        }),
        ("rest_tension", Measure::Force, |state| {
            Some(state.rest_tension)
        }),
        ("largest_tension", Measure::Force, |state| {
            let tensions = state.spans.iter().map(|span| span.tension);
            tensions.reduce(f64::max)
        }),
        ("smallest_tractive_tension", Measure::Force, |state| {
            let tensions = state.spans.iter().map(|span| span.tractive_tension);
            tensions.reduce(f64::min)
        }),
        ("power_in", Measure::Power, |state| Some(state.power_in)),
        ("power_out", Measure::Power, |state| Some(state.power_out)),
        ("power_loss", Measure::Loss, |state| Some(state.power_loss)),
        ("efficiency", Measure::Share, |state| state.efficiency),
    ];
    let mut told: Vec<_> = { whole.into_iter() }
        .map(|(key, measure, of)| Told::new(key, measure, of))
        .collect();
    let of_pulley: [(&str, Measure, OfPulley); 8] = [
        ("angular_speed", Measure::AngularSpeed, |pulley| {
            pulley.angular_speed
        }),
        ("torque", Measure::Torque, |pulley| pulley.torque),
        ("power", Measure::Power, |pulley| pulley.power),
        ("wrap_angle", Measure::Angle, |pulley| pulley.wrap),
        ("slip_arc", Measure::Angle, |pulley| pulley.slip_arc),
        ("speed_loss", Measure::Share, |pulley| pulley.speed_loss),
        ("hub_load_magnitude", Measure::Force, |pulley| {
            let [x, y] = pulley.hub_load;
            x.hypot(y)
        }),
        ("hub_load_rest_magnitude", Measure::Force, |pulley| {
            let [x, y] = pulley.rest_hub_load;
            x.hypot(y)
        }),
    ];
    let of_span: [(&str, Measure, OfSpan); 4] = [
        ("tension", Measure::Force, |span| span.tension),
        ("tractive_tension", Measure::Force, |span| {
            span.tractive_tension
        }),
        ("length", Measure::Length, |span| span.length),
        ("frequency", Measure::Frequency, |span| span.frequency),
    ];
    for (index, pulley) in drive.pulleys.iter().enumerate() {
        for (key, measure, of) in of_pulley {
            let key = format!("pulleys.{}.{key}", pulley.name);
            let of = move |state: &LoopState| Some(of(&state.pulleys[index]));
            told.push(Told::new(key, measure, of));
        }
    }
    for (index, pulley) in drive.pulleys.iter().enumerate() {
        for (key, measure, of) in of_span {
            let key = format!("spans.{}.{key}", pulley.name);
            let of = move |state: &LoopState| Some(of(&state.spans[index]));
            told.push(Told::new(key, measure, of));
        }
    }
    told.push(Told::new(
        "error_estimate",
        Measure::Number,
        |state: &LoopState| Some(state.relative_error()),
    ));
    told
}
