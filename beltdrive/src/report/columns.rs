//! The columns of a profile as programs read them: one list for JSON and CSV.

use crate::Profile;

/// A quantity along the belt, in the unit that its name states.
pub(super) struct Column {
    /// Name with unit.
    pub(super) key: &'static str,
    quantity: fn(&Profile) -> &[f64],
    unit: fn(f64) -> f64,
}

impl Column {
    /// The values along the belt, from entry to exit.
    pub(super) fn values(&self, profile: &Profile) -> Vec<f64> {
        (self.quantity)(profile)
            .iter()
            .map(|&value| (self.unit)(value))
            .collect()
    }

    const fn si(key: &'static str, quantity: fn(&Profile) -> &[f64]) -> Self {
        Self {
            key,
            quantity,
            unit: std::convert::identity,
        }
    }

    const fn degrees(key: &'static str, quantity: fn(&Profile) -> &[f64]) -> Self {
        Self {
            key,
            quantity,
            unit: f64::to_degrees,
        }
    }
}

/// All quantities of a profile.
pub(super) const COLUMNS: [Column; 10] = [
    Column::degrees("angle_deg", |profile| &profile.angle),
    Column::si("arc_length_m", |profile| &profile.arc_length),
    Column::si("tension_N", |profile| &profile.tension),
    Column::si("tractive_tension_N", |profile| &profile.tractive_tension),
    Column::degrees("inclination_deg", |profile| &profile.inclination),
    Column::si("penetration_m", |profile| &profile.penetration),
    Column::si("displacement_m", |profile| &profile.displacement),
    Column::degrees("sliding_angle_deg", |profile| &profile.sliding_angle),
    Column::si("normal_force_N_per_m", |profile| &profile.normal_force),
    Column::si("friction_force_N_per_m", |profile| &profile.friction_force),
];
