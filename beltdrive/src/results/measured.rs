//! What can be measured on a running drive, by name.

use super::loop_state::{LoopState, PulleyState, SpanState};
use crate::quantity::Measure;
use crate::{Drive, Duty};
use bvp::Real;

/// A number of a steady state that can be measured.
#[derive(Clone, Debug)]
pub struct Measured {
    name: String,
    measure: Measure,
    of: Of,
}

/// Where the number stands in a state: the place in a list of rows.
#[derive(Clone, Copy, Debug)]
enum Of {
    /// Of a pulley, with its sign.
    Pulley(usize, f64, usize),
    /// Of the span that leaves a pulley.
    Span(usize, usize),
    /// Of the whole drive, if it has the number.
    Whole(usize),
}

/// What can be measured on a pulley, in any scalar; as [`PulleyState`].
pub(crate) struct OfPulley<S = f64> {
    pub(crate) angular_speed: S,
    pub(crate) speed_loss: S,
    pub(crate) wrap: S,
    pub(crate) slip_arc: S,
    pub(crate) hub_load: [S; 2],
    pub(crate) rest_hub_load: [S; 2],
    pub(crate) torque: S,
    pub(crate) power: S,
}

/// What can be measured on a span, in any scalar; as [`SpanState`].
pub(crate) struct OfSpan<S = f64> {
    pub(crate) tension: S,
    pub(crate) tractive_tension: S,
    pub(crate) frequency: S,
    pub(crate) rest_frequency: S,
}

/// What can be measured on the whole drive, in any scalar; as [`LoopState`].
pub(crate) struct OfWhole<S = f64> {
    pub(crate) rest_tension: S,
    pub(crate) power_loss: S,
    pub(crate) efficiency: Option<S>,
    pub(crate) unstretched_length: S,
}

/// A state that can be measured, in any scalar.
pub(crate) trait Measurable<S> {
    /// The pulley with an index.
    fn of_pulley(&self, index: usize) -> OfPulley<S>;
    /// The span that leaves it.
    fn of_span(&self, index: usize) -> OfSpan<S>;
    /// The whole.
    fn of_whole(&self) -> OfWhole<S>;
}

impl Measurable<f64> for LoopState {
    fn of_pulley(&self, index: usize) -> OfPulley {
        let PulleyState {
            angular_speed,
            speed_loss,
            wrap,
            slip_arc,
            hub_load,
            rest_hub_load,
            torque,
            power,
            ..
        } = self.pulleys[index];
        OfPulley {
            angular_speed,
            speed_loss,
            wrap,
            slip_arc,
            hub_load,
            rest_hub_load,
            torque,
            power,
        }
    }

    fn of_span(&self, index: usize) -> OfSpan {
        let SpanState {
            tension,
            tractive_tension,
            frequency,
            rest_frequency,
            ..
        } = self.spans[index];
        OfSpan {
            tension,
            tractive_tension,
            frequency,
            rest_frequency,
        }
    }

    fn of_whole(&self) -> OfWhole {
        OfWhole {
            rest_tension: self.rest_tension,
            power_loss: self.power_loss,
            efficiency: self.efficiency,
            unstretched_length: self.unstretched_length,
        }
    }
}

/// A number of a part of a drive: name, measure, where it stands.
type Row<P, S> = (&'static str, Measure, fn(&P) -> S);

/// The magnitude of a force.
fn norm<S: Real>([x, y]: [S; 2]) -> S {
    x.hypot(y)
}

/// What a pulley has; from the row [`EXCHANGED`] on what it takes from the belt, and the driver gives to it.
fn pulley_rows<S: Real>() -> [Row<OfPulley<S>, S>; 8] {
    [
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
        ("torque", Measure::Torque, |pulley| pulley.torque),
        ("power", Measure::Power, |pulley| pulley.power),
    ]
}

/// As [`pulley_rows`].
const EXCHANGED: usize = 6;

/// What a span has, after the name of the pulley that it leaves.
fn span_rows<S: Real>() -> [Row<OfSpan<S>, S>; 4] {
    [
        ("exit_tension", Measure::Force, |span| span.tension),
        ("exit_tractive_tension", Measure::Force, |span| {
            span.tractive_tension
        }),
        ("exit_frequency", Measure::Frequency, |span| span.frequency),
        ("exit_rest_frequency", Measure::Frequency, |span| {
            span.rest_frequency
        }),
    ]
}

/// What the whole drive has.
fn whole_rows<S: Real>() -> [Row<OfWhole<S>, Option<S>>; 4] {
    [
        ("loop.rest_tension", Measure::Force, |whole| {
            Some(whole.rest_tension)
        }),
        ("loop.power_loss", Measure::Loss, |whole| {
            Some(whole.power_loss)
        }),
        ("loop.efficiency", Measure::Share, |whole| whole.efficiency),
        ("loop.belt_length", Measure::Length, |whole| {
            Some(whole.unstretched_length)
        }),
    ]
}

impl Measured {
    /// Everything that can be measured on a drive, by pulleys and spans in belt order.
    pub fn all(drive: &Drive) -> Vec<Self> {
        let mut all = Vec::new();
        for (index, pulley) in drive.pulleys.iter().enumerate() {
            let mut add = |name: &str, measure, of| {
                let name = format!("{}.{name}", pulley.name);
                all.push(Self { name, measure, of });
            };
            for (row, (name, measure, _)) in pulley_rows::<f64>().into_iter().enumerate() {
                let sign = match pulley.duty {
                    Duty::Driver(_) if row >= EXCHANGED => -1.0,
                    _ => 1.0,
                };
                add(name, measure, Of::Pulley(index, sign, row));
            }
            for (row, (name, measure, _)) in span_rows::<f64>().into_iter().enumerate() {
                add(name, measure, Of::Span(index, row));
            }
        }
        let whole = whole_rows::<f64>().into_iter().enumerate();
        all.extend(whole.map(|(row, (name, measure, _))| Self {
            name: name.to_owned(),
            measure,
            of: Of::Whole(row),
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
        self.on(state)
    }

    /// As [`Self::of`], in any scalar.
    pub(crate) fn on<S: Real>(&self, state: &impl Measurable<S>) -> Option<S> {
        match self.of {
            Of::Pulley(index, sign, row) => {
                let (_, _, of) = pulley_rows()[row];
                Some(of(&state.of_pulley(index)) * sign)
            }
            Of::Span(index, row) => {
                let (_, _, of) = span_rows()[row];
                Some(of(&state.of_span(index)))
            }
            Of::Whole(row) => {
                let (_, _, of) = whole_rows()[row];
                of(&state.of_whole())
            }
        }
    }
}
