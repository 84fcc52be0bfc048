//! The scalars of a steady state, which tables of many states show, and their errors.

use crate::{Drive, Entry, LeastSlip, PulleyState, SteadyState, Zone};

/// A steady state without its profiles. SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct StateSummary {
    /// Mass flow G through every cross-section, kg/s.
    pub mass_flow: f64,
    /// Unstretched length of the whole belt, m.
    pub belt_length: f64,
    /// Length of the free slack span, m.
    pub slack_span: f64,
    /// Length of the free tight span, m.
    pub tight_span: f64,
    /// Belt tension T in the slack span, N.
    pub slack_tension: f64,
    /// Belt tension T in the tight span, N.
    pub tight_tension: f64,
    /// Tractive tension F = T − G V in the slack span, N.
    pub slack_tractive_tension: f64,
    /// Tractive tension F = T − G V in the tight span, N.
    pub tight_tractive_tension: f64,
    /// Speed loss s = 1 − ω₁ R₁ / (ω₂ R₂) of the driven pulley 1 against the driver 2; 0 where the
    /// driver stands still.
    pub speed_loss: f64,
    /// Power taken by the driven pulley over power given by the driver, as in [`SteadyState`].
    pub efficiency: f64,
    /// Power lost in friction, W.
    pub friction_loss: f64,
    /// Power spent on compressing the belt, W, as in [`SteadyState`].
    pub compression_power: f64,
    /// The driver.
    pub driver: PulleySummary,
    /// The driven pulley.
    pub driven: PulleySummary,
    /// Estimated relative error of the state, where it was estimated.
    pub error_estimate: Option<f64>,
}

/// The state of one pulley without its profile.
#[derive(Clone, Debug, PartialEq)]
pub struct PulleySummary {
    /// Angular speed, rad/s.
    pub angular_speed: f64,
    /// Torque between belt and pulley, N·m; positive in the sense of power transmission.
    pub torque: f64,
    /// Angle swept by the belt on the pulley, rad.
    pub wrap_angle: f64,
    /// The wrap angle of the pitch circles, rad, as in [`PulleyState`].
    pub geometric_wrap_angle: f64,
    /// Largest penetration of the belt into the groove, m.
    pub max_penetration: f64,
    /// Inclination θ of the belt to the local circle at entry and exit, rad; positive outward.
    pub inclination: [f64; 2],
    /// Friction zones in the order in which the belt passes them.
    pub zones: Vec<Zone>,
    /// How the belt enters the pulley; of flat belts.
    pub entry: Option<Entry>,
    /// Where the belt hardly slips; of V-belts.
    pub least_slip: Option<LeastSlip>,
}

/// Estimated absolute errors of the scalars of a state, in their units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StateErrors {
    /// Of the efficiency.
    pub efficiency: f64,
    /// Of the driver.
    pub driver: PulleyErrors,
    /// Of the driven pulley.
    pub driven: PulleyErrors,
}

/// Estimated absolute errors of the scalars of one pulley.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PulleyErrors {
    /// Of the angular speed, rad/s.
    pub angular_speed: f64,
    /// Of the torque, N·m.
    pub torque: f64,
    /// Of the wrap angle, rad.
    pub wrap_angle: f64,
    /// Of the largest penetration, m.
    pub max_penetration: f64,
    /// Of the inclinations at entry and exit, rad.
    pub inclination: [f64; 2],
}

impl StateErrors {
    /// The errors of a state of a drive with a relative error.
    pub(crate) fn relative(state: &StateSummary, drive: &Drive, relative: f64) -> Self {
        let pulley = |pulley: &PulleySummary, radius: f64| PulleyErrors {
            angular_speed: relative * state.driver.angular_speed,
            // A torque is a difference of tensions.
            torque: relative * state.tight_tension * radius,
            wrap_angle: relative * pulley.wrap_angle,
            max_penetration: relative * pulley.max_penetration,
            inclination: [relative * steepest(state); 2],
        };
        Self {
            efficiency: relative,
            driver: pulley(&state.driver, drive.pair().driver_radius),
            driven: pulley(&state.driven, drive.pair().driven_radius),
        }
    }
}

/// The largest inclination at the ends of both pulleys.
fn steepest(state: &StateSummary) -> f64 {
    let ends = [state.driver.inclination, state.driven.inclination].concat();
    ends.into_iter()
        .fold(0.0, |m: f64, theta| m.max(theta.abs()))
}

impl PulleySummary {
    /// Power between belt and pulley, W.
    pub fn power(&self) -> f64 {
        self.torque * self.angular_speed
    }
}

impl From<&SteadyState> for StateSummary {
    fn from(state: &SteadyState) -> Self {
        let speed_at_pitch = |pulley: &PulleyState, radius| pulley.angular_speed * radius;
        let driver = speed_at_pitch(&state.driver, state.drive.pair().driver_radius);
        let driven = speed_at_pitch(&state.driven, state.drive.pair().driven_radius);
        let convergence = &state.convergence;
        Self {
            mass_flow: state.mass_flow,
            belt_length: state.belt_length,
            slack_span: state.slack_span,
            tight_span: state.tight_span,
            slack_tension: state.slack_tension,
            tight_tension: state.tight_tension,
            slack_tractive_tension: state.slack_tractive_tension,
            tight_tractive_tension: state.tight_tractive_tension,
            speed_loss: speed_loss([driven, driver]),
            efficiency: state.efficiency,
            friction_loss: state.friction_loss,
            compression_power: state.compression_power,
            driver: PulleySummary::from(&state.driver),
            driven: PulleySummary::from(&state.driven),
            error_estimate: Some(
                convergence
                    .error_estimate
                    .max(convergence.slip_normalisation_effect),
            ),
        }
    }
}

/// Speed loss of the driven pulley against the driver from the speeds of their rims, m/s.
pub(crate) fn speed_loss([driven, driver]: [f64; 2]) -> f64 {
    match driver == 0.0 {
        true => 0.0,
        false => 1.0 - driven / driver,
    }
}

impl From<&PulleyState> for PulleySummary {
    fn from(pulley: &PulleyState) -> Self {
        Self {
            angular_speed: pulley.angular_speed,
            torque: pulley.torque,
            wrap_angle: pulley.wrap_angle,
            geometric_wrap_angle: pulley.geometric_wrap_angle,
            max_penetration: pulley.max_penetration,
            inclination: pulley.inclination,
            zones: pulley.zones.clone(),
            entry: pulley.entry,
            least_slip: pulley.least_slip,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::samples::v_belt;

    #[test]
    fn a_standing_driver_loses_no_speed() {
        assert_eq!(StateSummary::from(&v_belt::idle()).speed_loss, 0.0);
        let state = StateSummary::from(&v_belt::loaded());
        assert!((state.speed_loss - 0.02).abs() < 1e-12);
    }
}
