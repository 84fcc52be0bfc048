//! The scalars of a state as columns of CSV: one list for branches, limits and limit curves.

use crate::input::Key;
use crate::{PulleySummary, StateSummary};

/// A scalar of a state, in the unit that its name states.
pub(super) struct StateColumn {
    /// Name with unit.
    pub(super) key: &'static str,
    quantity: fn(&StateSummary) -> f64,
}

impl StateColumn {
    /// The value as text, at full precision.
    pub(super) fn text(&self, state: &StateSummary) -> String {
        (self.quantity)(state).to_string()
    }
}

const fn column(key: &'static str, quantity: fn(&StateSummary) -> f64) -> StateColumn {
    StateColumn { key, quantity }
}

/// The scalars of a state without those that are entries with columns of their own.
pub(super) fn columns_beside(keys: &[Key]) -> Vec<StateColumn> {
    let own: Vec<_> = keys.iter().map(Key::column).collect();
    let beside = |column: &StateColumn| own.iter().all(|own| own != column.key);
    STATE_COLUMNS.into_iter().filter(beside).collect()
}

const STATE_COLUMNS: [StateColumn; 25] = [
    column("mass_flow_kg_per_s", |state| state.mass_flow),
    column("belt_length_m", |state| state.belt_length),
    column("slack_span_m", |state| state.slack_span),
    column("tight_span_m", |state| state.tight_span),
    column("efficiency", |state| state.efficiency),
    column("friction_loss_W", |state| state.friction_loss),
    column("speed_loss", |state| state.speed_loss),
    column("slack_tension_N", |state| state.slack_tension),
    column("tight_tension_N", |state| state.tight_tension),
    column("slack_tractive_tension_N", |state| {
        state.slack_tractive_tension
    }),
    column("tight_tractive_tension_N", |state| {
        state.tight_tractive_tension
    }),
    column("driver_angular_speed_rad_per_s", |state| {
        state.driver.angular_speed
    }),
    column("driver_torque_N_m", |state| state.driver.torque),
    column("driver_power_W", |state| state.driver.power()),
    column("driver_wrap_angle_deg", |state| {
        state.driver.wrap_angle.to_degrees()
    }),
    column("driver_max_penetration_m", |state| {
        state.driver.max_penetration
    }),
    column("driver_entry_inclination_deg", |state| entry(&state.driver)),
    column("driver_exit_inclination_deg", |state| exit(&state.driver)),
    column("driven_angular_speed_rad_per_s", |state| {
        state.driven.angular_speed
    }),
    column("driven_torque_N_m", |state| state.driven.torque),
    column("driven_power_W", |state| state.driven.power()),
    column("driven_wrap_angle_deg", |state| {
        state.driven.wrap_angle.to_degrees()
    }),
    column("driven_max_penetration_m", |state| {
        state.driven.max_penetration
    }),
    column("driven_entry_inclination_deg", |state| entry(&state.driven)),
    column("driven_exit_inclination_deg", |state| exit(&state.driven)),
];

fn entry(pulley: &PulleySummary) -> f64 {
    pulley.inclination[0].to_degrees()
}

fn exit(pulley: &PulleySummary) -> f64 {
    pulley.inclination[1].to_degrees()
}
