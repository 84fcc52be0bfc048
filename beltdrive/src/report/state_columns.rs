//! The scalars of a state as columns of CSV: one list for branches, limits and limit curves.

use super::{rows, slip_arc};
use crate::input::Key;
use crate::{BeltKind, Drive, PulleySummary, StateSummary};

/// A scalar of a state, in the unit that its name states.
#[derive(Clone, Copy)]
pub(super) struct StateColumn {
    /// Name with unit.
    pub(super) key: &'static str,
    quantity: Quantity,
}

/// How a scalar follows from a state.
#[derive(Clone, Copy)]
enum Quantity {
    /// Every state has it.
    Known(fn(&StateSummary) -> f64),
    /// There may be none.
    Optional(fn(&StateSummary) -> Option<f64>),
    /// A word about the drive, the same for all states.
    Word(&'static str),
}

impl StateColumn {
    /// The value as text, at full precision; empty where there is none.
    pub(super) fn text(&self, state: &StateSummary) -> String {
        rows::optional(match self.quantity {
            Quantity::Known(quantity) => Some(quantity(state)),
            Quantity::Optional(quantity) => quantity(state),
            Quantity::Word(word) => return word.to_owned(),
        })
    }
}

const fn column(key: &'static str, quantity: fn(&StateSummary) -> f64) -> StateColumn {
    let quantity = Quantity::Known(quantity);
    StateColumn { key, quantity }
}

const fn optional(key: &'static str, quantity: fn(&StateSummary) -> Option<f64>) -> StateColumn {
    let quantity = Quantity::Optional(quantity);
    StateColumn { key, quantity }
}

/// The scalars of the states of a drive without those that are entries with columns of their own; of a
/// flat belt with the convention for its normal force.
pub(super) fn columns_beside(drive: &Drive, keys: &[Key]) -> Vec<StateColumn> {
    let of_kind = match drive.belt.kind {
        BeltKind::V(_) => Vec::new(),
        BeltKind::Flat { normal_force } => {
            let quantity = Quantity::Word(normal_force.name());
            let convention = StateColumn {
                key: "normal_force",
                quantity,
            };
            [ENTRY_COLUMNS.as_slice(), &[convention]].concat()
        }
    };
    let own: Vec<_> = keys.iter().map(Key::column).collect();
    let beside = |column: &StateColumn| own.iter().all(|own| own != column.key);
    let all = STATE_COLUMNS.into_iter().chain(of_kind);
    all.filter(beside).collect()
}

/// The scalars of every state.
const STATE_COLUMNS: [StateColumn; 27] = [
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
    column("driver_slip_arc_deg", |state| slip(&state.driver)),
    column("driven_slip_arc_deg", |state| slip(&state.driven)),
];

/// How a flat belt enters the pulleys.
const ENTRY_COLUMNS: [StateColumn; 6] = [
    optional("driver_reference_tension_N", |state| {
        reference_tension(&state.driver)
    }),
    optional("driver_entry_strain", |state| strain(&state.driver)),
    optional("driver_smallest_friction_stiffness_N_per_m2", |state| {
        smallest_stiffness(&state.driver)
    }),
    optional("driven_reference_tension_N", |state| {
        reference_tension(&state.driven)
    }),
    optional("driven_entry_strain", |state| strain(&state.driven)),
    optional("driven_smallest_friction_stiffness_N_per_m2", |state| {
        smallest_stiffness(&state.driven)
    }),
];

fn entry(pulley: &PulleySummary) -> f64 {
    pulley.inclination[0].to_degrees()
}

fn exit(pulley: &PulleySummary) -> f64 {
    pulley.inclination[1].to_degrees()
}

fn slip(pulley: &PulleySummary) -> f64 {
    slip_arc(&pulley.zones).to_degrees()
}

fn reference_tension(pulley: &PulleySummary) -> Option<f64> {
    pulley.entry.map(|entry| entry.reference_tension)
}

fn strain(pulley: &PulleySummary) -> Option<f64> {
    pulley.entry.map(|entry| entry.strain)
}

fn smallest_stiffness(pulley: &PulleySummary) -> Option<f64> {
    pulley.entry.and_then(|entry| entry.smallest_stiffness)
}
