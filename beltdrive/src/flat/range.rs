//! The values of an entry that a drive carries.

use super::closed_form::{ClosedForm, Refusal};
use crate::input::Key;
use crate::{Drive, Load, SpanTension, StateErrors, StateSummary, TwoPulleys};
use web_time::Instant;

/// Factor between the values at which an end of the range is looked for.
const STEP: f64 = 1.1;
/// Most of these steps: an end is sought up to 1e6 times the value and down to a millionth.
const STEPS: usize = 145;
/// Bisections after which two doubles of one sign are neighbours.
const BISECTIONS: usize = 80;
/// Relative change of a value over which the sensitivity of a state is measured, and the error of a
/// located value that it stands for.
const PROBE: f64 = 1e-9;
const LOCATED: f64 = 1e-15;

/// The drives that differ in one entry.
pub(super) struct Members<'d> {
    /// The drive.
    pub(super) drive: &'d Drive,
    /// The entry.
    pub(super) key: Key,
}

/// An end of the range: the last value that the drive carries.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    /// The value, SI.
    pub(super) value: f64,
    /// Why there is no state beyond.
    pub(super) refusal: Refusal,
}

impl<'d> Members<'d> {
    pub(super) fn new(drive: &'d Drive, key: &Key) -> Self {
        Self { drive, key: *key }
    }

    /// The drive with a value of the entry.
    pub(super) fn drive_at(&self, value: f64) -> Drive {
        let mut drive = self.drive.clone();
        self.key.set(&mut drive, value);
        drive
    }

    /// The steady state with a value of the entry.
    pub(super) fn at(&self, value: f64) -> Result<ClosedForm, Refusal> {
        ClosedForm::find(&self.drive_at(value).pair())
    }

    /// The summary of the steady state with a value of the entry, which the drive carries.
    pub(super) fn summary(&self, value: f64) -> Option<StateSummary> {
        let drive = self.drive_at(value);
        let solved = ClosedForm::find(&drive.pair()).ok()?;
        let state = super::state::steady_state(&drive, &solved, Instant::now());
        Some(StateSummary::from(&state))
    }

    /// Estimated errors of the state at a located value: what its last digit changes, from the change
    /// over a small distance towards `inside`.
    pub(super) fn errors(&self, value: f64, inside: f64) -> Option<StateErrors> {
        let state = self.summary(value)?;
        let probe = value + (inside - value).signum() * PROBE * value.abs();
        let near = self.summary(probe)?;
        let change = |quantity: fn(&StateSummary) -> f64, unit: f64| {
            (quantity(&state) - quantity(&near)).abs() / unit
        };
        let sensitivity = change(
            |state| state.driven.angular_speed,
            state.driver.angular_speed,
        )
        .max(change(|state| state.efficiency, 1.0))
        .max(change(|state| state.tight_tension, state.tight_tension));
        let relative = state.error_estimate.unwrap_or(0.0) + sensitivity * LOCATED / PROBE;
        Some(StateErrors::relative(&state, self.drive, relative))
    }

    /// The end of the range between a value that the drive carries and one that it does not.
    pub(super) fn end_between(&self, inside: f64, outside: f64) -> Option<End> {
        let (value, beyond) = boundary(inside, outside, |value| self.at(value).is_ok());
        let refusal = self.at(beyond).err()?;
        Some(End { value, refusal })
    }

    /// The end of the range from a value that the drive carries upwards or downwards, but not beyond a
    /// limit; `None` if it carries all of them.
    pub(super) fn end_towards(&self, value: f64, limit: f64) -> Option<End> {
        let mut inside = value;
        for _ in 0..STEPS {
            let next = match limit > value {
                true => (inside * STEP).min(limit),
                false => (inside / STEP).max(limit),
            };
            if next == inside {
                return None;
            }
            if self.at(next).is_err() {
                return self.end_between(inside, next);
            }
            inside = next;
        }
        None
    }

    /// The last value that [`Members::end_towards`] looks at.
    pub(super) fn last_towards(&self, value: f64, limit: f64) -> f64 {
        let steps = i32::try_from(STEPS).unwrap_or(i32::MAX);
        match limit > value {
            true => (value * STEP.powi(steps)).min(limit),
            false => (value / STEP.powi(steps)).max(limit),
        }
    }

    /// The values of the entry that a drive can have at all; a load ends where it transmits no torque.
    pub(super) fn domain(&self) -> [f64; 2] {
        let drive = self.drive.pair();
        let [slack, tight] = [drive.load.slack, drive.load.tight];
        let by_tensions = ![slack, tight]
            .iter()
            .any(|span| matches!(span, SpanTension::DrivenTorque(_)));
        let radii = drive.driver_radius + drive.driven_radius;
        let open = [f64::MIN_POSITIVE, f64::INFINITY];
        match self.key.path() {
            "load.driven_torque" => [0.0, f64::INFINITY],
            path if path.starts_with("load.tight") && by_tensions => [self.equal(slack), open[1]],
            path if path.starts_with("load.slack") && by_tensions => [open[0], self.equal(tight)],
            "layout.centre_distance" => [radii * (1.0 + PROBE), open[1]],
            "pulleys.driver.radius" => [open[0], drive.centre_distance - drive.driven_radius],
            "pulleys.driven.radius" => [open[0], drive.centre_distance - drive.driver_radius],
            _ => open,
        }
    }

    /// The value of this span's tension at which both spans have the same.
    fn equal(&self, other: SpanTension) -> f64 {
        let load = Load {
            slack: other,
            tight: other,
        };
        let drive = TwoPulleys {
            load,
            ..self.drive.pair()
        };
        match ClosedForm::find(&drive) {
            Ok(idle) if self.is_tractive() != matches!(other, SpanTension::Tractive(_)) => {
                let [tension, _] = idle.tension;
                let kinetic = drive.belt.mass_per_length * idle.speed * idle.speed;
                let share = 1.0 - kinetic / drive.belt.axial_stiffness;
                match self.is_tractive() {
                    true => tension * share - kinetic,
                    false => tension,
                }
            }
            _ => other.value(),
        }
    }

    /// A driven torque that changes the tension of a span by a thousandth, N·m.
    fn small_torque(&self) -> f64 {
        let drive = self.drive.pair();
        let spans = [drive.load.slack, drive.load.tight];
        let tensions = spans.map(|span| match span {
            SpanTension::DrivenTorque(_) => 0.0,
            tension => tension.value(),
        });
        1e-3 * tensions[0].max(tensions[1]) * drive.driven_radius
    }

    /// Whether the entry is a tractive tension.
    fn is_tractive(&self) -> bool {
        self.key.path().contains("tractive")
    }

    /// A value between the ends of the range: that of the drive, or one that is easier to carry. Steps
    /// of equal ratios do not lead away from no torque: a small one takes its place.
    pub(super) fn carried(&self) -> Result<f64, Refusal> {
        let value = match self.key.get(self.drive) {
            0.0 => self.small_torque(),
            value => value,
        };
        let refusal = match self.at(value) {
            Ok(_) => return Ok(value),
            Err(refusal) => refusal,
        };
        let [low, high] = self.domain();
        let ladder = |step: f64, limit: f64| {
            let mut value = value;
            (0..STEPS).map_while(move |_| {
                let last = value;
                value = match step > 1.0 {
                    true => (value * step).min(limit),
                    false => (value * step).max(limit),
                };
                (value != last).then_some(value)
            })
        };
        let mut easier = ladder(1.0 / STEP, low).chain(ladder(STEP, high));
        easier.find(|&value| self.at(value).is_ok()).ok_or(refusal)
    }
}

/// Neighbouring doubles between which something that holds at the first of two values and not at the
/// second ceases to hold, by bisection.
pub(super) fn boundary(
    mut inside: f64,
    mut outside: f64,
    holds: impl Fn(f64) -> bool,
) -> (f64, f64) {
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (inside + outside);
        if middle == inside || middle == outside {
            break;
        }
        match holds(middle) {
            true => inside = middle,
            false => outside = middle,
        }
    }
    (inside, outside)
}
