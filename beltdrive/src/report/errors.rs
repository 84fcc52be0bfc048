//! The errors of the scalars of a state as JSON, under the keys of the scalars.

use crate::{PulleyErrors, StateErrors};
use serde::Serialize;

/// Estimated absolute errors.
#[derive(Serialize)]
pub(super) struct ErrorReport {
    efficiency: f64,
    driver: PulleyErrorReport,
    driven: PulleyErrorReport,
}

#[derive(Serialize)]
#[expect(non_snake_case, reason = "the keys carry units")]
struct PulleyErrorReport {
    angular_speed_rad_per_s: f64,
    torque_N_m: f64,
    wrap_angle_deg: f64,
    max_penetration_m: f64,
    inclination_deg: [f64; 2],
}

impl From<&StateErrors> for ErrorReport {
    fn from(errors: &StateErrors) -> Self {
        Self {
            efficiency: errors.efficiency,
            driver: PulleyErrorReport::from(&errors.driver),
            driven: PulleyErrorReport::from(&errors.driven),
        }
    }
}

impl From<&PulleyErrors> for PulleyErrorReport {
    fn from(errors: &PulleyErrors) -> Self {
        Self {
            angular_speed_rad_per_s: errors.angular_speed,
            torque_N_m: errors.torque,
            wrap_angle_deg: errors.wrap_angle.to_degrees(),
            max_penetration_m: errors.max_penetration,
            inclination_deg: errors.inclination.map(f64::to_degrees),
        }
    }
}
