//! What can be measured on a running drive, by name.

use super::loop_state::{LoopState, PulleyState, SpanState};
use crate::quantity::Measure;
use crate::{Drive, Duty};

/// A number of a steady state that can be measured.
#[derive(Clone, Debug)]
pub struct Measured {
    name: String,
    measure: Measure,
    of: Of,
}

/// Where the number stands in a state.
#[derive(Clone, Copy, Debug)]
enum Of {
    /// Of a pulley, with its sign.
    Pulley(usize, f64, fn(&PulleyState) -> f64),
    /// Of the span that leaves a pulley.
    Span(usize, fn(&SpanState) -> f64),
    /// Of the whole drive, if it has the number.
    Whole(fn(&LoopState) -> Option<f64>),
}

/// A number of a part of a drive: name, measure, where it stands.
type Row<P> = (&'static str, Measure, fn(&P) -> f64);

/// The magnitude of a force.
fn norm([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

/// What a pulley has.
const OF_PULLEY: [Row<PulleyState>; 6] = [
    ("angular_speed", Measure::AngularSpeed, |pulley| {
        pulley.angular_speed
    }),
    ("speed_loss", Measure::Share, |pulley| pulley.speed_loss),
    ("wrap_angle", Measure::Angle, |pulley| pulley.wrap),
    ("slip_arc", Measure::Angle, |pulley| pulley.slip_arc),
    ("hub_load", Measure::Force, |pulley| norm(pulley.hub_load)),
    ("rest_hub_load", Measure::Force, |pulley| {
        norm(pulley.rest_hub_load)
    }),
];

/// What a pulley takes from the belt, and the driver gives to it.
const EXCHANGED: [Row<PulleyState>; 2] = [
    ("torque", Measure::Torque, |pulley| pulley.torque),
    ("power", Measure::Power, |pulley| pulley.power),
];

/// What a span has, after the name of the pulley that it leaves.
const OF_SPAN: [Row<SpanState>; 4] = [
    ("exit_tension", Measure::Force, |span| span.tension),
    ("exit_tractive_tension", Measure::Force, |span| {
        span.tractive_tension
    }),
    ("exit_frequency", Measure::Frequency, |span| span.frequency),
    ("exit_rest_frequency", Measure::Frequency, |span| {
        span.rest_frequency
    }),
];

/// A number of the whole drive: name, measure, where it stands.
type WholeRow = (&'static str, Measure, fn(&LoopState) -> Option<f64>);

/// What the whole drive has.
const OF_WHOLE: [WholeRow; 4] = [
    ("loop.rest_tension", Measure::Force, |state| {
        Some(state.rest_tension)
    }),
    ("loop.power_loss", Measure::Loss, |state| {
        Some(state.power_loss)
    }),
    ("loop.efficiency", Measure::Share, |state| state.efficiency),
    ("loop.belt_length", Measure::Length, |state| {
        Some(state.unstretched_length)
    }),
];

impl Measured {
    /// Everything that can be measured on a drive, by pulleys and spans in belt order.
    pub fn all(drive: &Drive) -> Vec<Self> {
        let mut all = Vec::new();
        for (index, pulley) in drive.pulleys.iter().enumerate() {
            let mut add = |name: &str, measure, of| {
                let name = format!("{}.{name}", pulley.name);
                all.push(Self { name, measure, of });
            };
            for (name, measure, of) in OF_PULLEY {
                add(name, measure, Of::Pulley(index, 1.0, of));
            }
            let sign = match pulley.duty {
                Duty::Driver(_) => -1.0,
                _ => 1.0,
            };
            for (name, measure, of) in EXCHANGED {
                add(name, measure, Of::Pulley(index, sign, of));
            }
            for (name, measure, of) in OF_SPAN {
                add(name, measure, Of::Span(index, of));
            }
        }
        all.extend(OF_WHOLE.map(|(name, measure, of)| Self {
            name: name.to_owned(),
            measure,
            of: Of::Whole(of),
        }));
        all
    }

    /// Its name, such as `driven.angular_speed`; `driver.exit_tension` is the tension of the span that leaves the
    /// pulley `driver`.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What it measures.
    pub fn measure(&self) -> Measure {
        self.measure
    }

    /// Its value in a state of the drive, SI; `None` if the state has none.
    ///
    /// # Panics
    /// If the state is that of a drive with fewer pulleys.
    pub fn of(&self, state: &LoopState) -> Option<f64> {
        match self.of {
            Of::Pulley(index, sign, of) => Some(sign * of(&state.pulleys[index])),
            Of::Span(index, of) => Some(of(&state.spans[index])),
            Of::Whole(of) => of(state),
        }
    }
}
