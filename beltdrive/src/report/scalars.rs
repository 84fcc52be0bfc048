//! The scalars of a state as JSON: the same keys wherever a state stands.

use super::slip_arc;
use crate::{Entry, PulleySummary, StateSummary, Zone, ZoneKind};
use serde::Serialize;

/// The scalars of a state. Angles are in degrees, everything else is SI.
#[derive(Serialize)]
#[expect(non_snake_case, reason = "the keys carry units")]
pub(super) struct Scalars {
    mass_flow_kg_per_s: f64,
    belt_length_m: f64,
    slack_span_m: f64,
    tight_span_m: f64,
    efficiency: f64,
    friction_loss_W: f64,
    compression_power_W: f64,
    speed_loss: f64,
    driver: PulleyScalars,
    driven: PulleyScalars,
    tension_N: Spans,
    tractive_tension_N: Spans,
}

impl From<&StateSummary> for Scalars {
    fn from(state: &StateSummary) -> Self {
        Self {
            mass_flow_kg_per_s: state.mass_flow,
            belt_length_m: state.belt_length,
            slack_span_m: state.slack_span,
            tight_span_m: state.tight_span,
            efficiency: state.efficiency,
            friction_loss_W: state.friction_loss,
            compression_power_W: state.compression_power,
            speed_loss: state.speed_loss,
            driver: PulleyScalars::from(&state.driver),
            driven: PulleyScalars::from(&state.driven),
            tension_N: Spans {
                slack: state.slack_tension,
                tight: state.tight_tension,
            },
            tractive_tension_N: Spans {
                slack: state.slack_tractive_tension,
                tight: state.tight_tractive_tension,
            },
        }
    }
}

#[derive(Serialize)]
#[expect(non_snake_case, reason = "the keys carry units")]
struct PulleyScalars {
    angular_speed_rad_per_s: f64,
    torque_N_m: f64,
    power_W: f64,
    wrap_angle_deg: f64,
    geometric_wrap_angle_deg: f64,
    max_penetration_m: f64,
    inclination_deg: [f64; 2],
    slip_arc_deg: f64,
    #[serde(flatten)]
    entry: Option<EntryScalars>,
    zones: Vec<ZoneReport>,
}

impl From<&PulleySummary> for PulleyScalars {
    fn from(pulley: &PulleySummary) -> Self {
        Self {
            angular_speed_rad_per_s: pulley.angular_speed,
            torque_N_m: pulley.torque,
            power_W: pulley.power(),
            wrap_angle_deg: pulley.wrap_angle.to_degrees(),
            geometric_wrap_angle_deg: pulley.geometric_wrap_angle.to_degrees(),
            max_penetration_m: pulley.max_penetration,
            inclination_deg: pulley.inclination.map(f64::to_degrees),
            slip_arc_deg: slip_arc(&pulley.zones).to_degrees(),
            entry: pulley.entry.as_ref().map(EntryScalars::from),
            zones: pulley.zones.iter().map(ZoneReport::from).collect(),
        }
    }
}

/// How a flat belt enters a pulley; a V-belt has none of these keys.
#[derive(Serialize)]
#[expect(non_snake_case, reason = "the keys carry units")]
struct EntryScalars {
    reference_tension_N: f64,
    entry_strain: f64,
    smallest_friction_stiffness_N_per_m2: Option<f64>,
}

impl From<&Entry> for EntryScalars {
    fn from(entry: &Entry) -> Self {
        Self {
            reference_tension_N: entry.reference_tension,
            entry_strain: entry.strain,
            smallest_friction_stiffness_N_per_m2: entry.smallest_stiffness,
        }
    }
}

#[derive(Serialize)]
struct ZoneReport {
    kind: ZoneKind,
    from_deg: f64,
    to_deg: f64,
}

impl From<&Zone> for ZoneReport {
    fn from(zone: &Zone) -> Self {
        Self {
            kind: zone.kind,
            from_deg: zone.from.to_degrees(),
            to_deg: zone.to.to_degrees(),
        }
    }
}

#[derive(Serialize)]
struct Spans {
    slack: f64,
    tight: f64,
}
