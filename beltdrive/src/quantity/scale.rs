//! How accurate the numbers of a state are.

use super::{Measure, Quantity, Subject, Value};
use crate::{LeastSlip, Zone};

/// What the errors of the numbers of a state are relative to; by default they are none.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Scale {
    /// Relative error of the state.
    pub(super) error: f64,
    /// Largest belt tension, N.
    pub(super) tension: f64,
    /// What a difference of two powers is relative to, W.
    pub(super) power: f64,
}

impl Scale {
    /// The same for a number that has a relative error of its own beside that of the state.
    pub(super) fn with(self, error: f64) -> Self {
        Self {
            error: error.max(self.error),
            ..self
        }
    }

    /// A number whose error is relative to itself.
    pub(super) fn relative(
        &self,
        key: &'static str,
        label: &'static str,
        measure: Measure,
        value: impl Into<Option<f64>>,
    ) -> Quantity {
        let value = value.into();
        self.against(key, label, measure, value, value.unwrap_or(0.0))
    }

    /// A number whose error is relative to a scale of its own unit, as that of a difference.
    pub(super) fn against(
        &self,
        key: &'static str,
        label: &'static str,
        measure: Measure,
        value: impl Into<Option<f64>>,
        scale: f64,
    ) -> Quantity {
        Quantity::number(key, label, measure, value, self.error * scale.abs())
    }

    /// An angle.
    pub(super) fn angle(
        &self,
        key: &'static str,
        label: &'static str,
        value: impl Into<Option<f64>>,
    ) -> Quantity {
        self.against(key, label, Measure::Angle, value, 1.0)
    }

    /// A force that is a sum of tensions.
    pub(super) fn force(
        &self,
        key: &'static str,
        label: &'static str,
        value: impl Into<Option<f64>>,
    ) -> Quantity {
        self.against(key, label, Measure::Force, value, self.tension)
    }

    /// A difference of two powers.
    pub(super) fn power(
        &self,
        key: &'static str,
        label: &'static str,
        value: impl Into<Option<f64>>,
    ) -> Quantity {
        self.against(key, label, Measure::Power, value, self.power)
    }

    /// A loss of power.
    pub(super) fn loss(
        &self,
        key: &'static str,
        label: &'static str,
        value: impl Into<Option<f64>>,
    ) -> Quantity {
        self.against(key, label, Measure::Loss, value, self.power)
    }

    /// The force of the belt on the hub of a pulley: its components, its magnitude and its direction, of these
    /// keys.
    pub(super) fn hub_load(
        &self,
        [force, magnitude, direction]: [&'static str; 3],
        label: &'static str,
        [x, y]: [f64; 2],
    ) -> [Quantity; 3] {
        [
            Quantity::data(force, Measure::Force, Value::Pair([x, y])),
            self.force(magnitude, label, x.hypot(y)),
            self.angle(direction, "  direction from x", y.atan2(x)),
        ]
    }

    /// How little a belt slips in a groove, and how long the arc is on which it hardly does.
    pub(super) fn least_slip(&self, least: &LeastSlip) -> [Quantity; 2] {
        // Of a small slip its order is what matters.
        let slip = least.slip.max(ROUNDED_SLIP);
        let error = (0.005 * slip).max(least.normalised);
        let arc = || least.locked.map_or(0.0, |[from, to]| to - from);
        let locked = least.tells_locked().then(arc);
        [
            Quantity::number(
                "smallest_slip",
                "smallest slip, of V",
                Measure::Number,
                slip,
                error,
            ),
            self.angle("locked_arc", "arc below 1e-7 of V", locked),
        ]
    }

    /// Where a belt at full friction hardly slips.
    pub(super) fn locked(&self, least: Option<&LeastSlip>) -> [Quantity; 2] {
        let end = |end: usize| least.and_then(|least| least.locked.map(|ends| ends[end]));
        [
            self.angle("locked_from", "", end(0)),
            self.angle("locked_to", "", end(1)),
        ]
    }

    /// Friction zones, for programs.
    pub(super) fn zones(&self, zones: &[Zone]) -> Quantity {
        let zones = zones.iter().map(|zone| {
            let kind = Quantity::word("kind", "", zone.kind.name().to_owned());
            let [from, to] = [("from", zone.from), ("to", zone.to)]
                .map(|(key, angle)| self.angle(key, "", angle));
            Subject::new("", vec![kind, from, to])
        });
        Quantity::data("zones", Measure::Number, Value::List(zones.collect()))
    }
}

/// The key of a hub load, of its magnitude and of its direction.
pub(super) const HUB_LOAD: [&str; 3] = ["hub_load", "hub_load_magnitude", "hub_load_direction"];

/// A slip below this is rounding: the speeds whose difference it is are of the order of one.
const ROUNDED_SLIP: f64 = 1e-15;
