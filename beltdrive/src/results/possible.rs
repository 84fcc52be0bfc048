//! What holds of every state that is shown, examined on the numbers that are shown.

use crate::{BeltKind, Check, Impossible, Profile, PulleyState, Role, SteadyState};

/// Share of the accuracy that a pressure may be negative by, relative to the largest one. At the ends of the
/// contact it is zero, as accurately as Newton's method meets a condition: a thousandth of the tolerance on a
/// branch, rounding in a state that is solved for itself.
const AT_ENDS: f64 = 1e-3;

/// The checks of what is shown.
pub(crate) fn checks(state: &SteadyState) -> [Check; 8] {
    examine(state).map(|(check, _)| check)
}

/// Why a state is that of no drive, if it is none.
pub(crate) fn fault(state: &SteadyState) -> Option<Impossible> {
    let mut faults = examine(state)
        .into_iter()
        .filter(|(check, _)| !check.holds());
    faults.next().map(|(_, reason)| reason)
}

/// The relative accuracy of the quadrature over the closed form of flat belts, which has about eleven digits.
pub(crate) const OF_CLOSED_FORM: f64 = 1e-9;

/// The relative accuracy of integrals along the belt.
fn accuracy(state: &SteadyState) -> f64 {
    match state.drive.belt.kind {
        BeltKind::V(_) => 10.0 * state.convergence.tolerance,
        BeltKind::Flat { .. } => OF_CLOSED_FORM,
    }
}

/// The checks, each with what it means to fail it.
fn examine(state: &SteadyState) -> [(Check, Impossible); 8] {
    let accuracy = accuracy(state);
    [
        waves(state),
        tension(state),
        pressure(state, accuracy),
        friction(state, accuracy),
        friction_loss(state, accuracy),
        balance(state, accuracy),
        efficiency(state, accuracy),
        lengths(state),
    ]
}

/// D = EA − m c² > 0.
fn waves(state: &SteadyState) -> (Check, Impossible) {
    let belt = &state.drive.belt;
    let speed = state.mass_flow.abs() / belt.mass_per_length;
    let waves = (belt.axial_stiffness / belt.mass_per_length).sqrt();
    let check = Check {
        name: "belt slower than axial waves",
        deviation: positive((speed / waves).powi(2) - 1.0),
        limit: 0.0,
    };
    (check, Impossible::FasterThanWaves { speed, waves })
}

/// T > 0 and F > 0 along both pulleys, at whose ends they are those of the spans.
fn tension(state: &SteadyState) -> (Check, Impossible) {
    let belt = worst(state, |profile, point| -profile.tension[point]);
    let pressing = worst(state, |profile, point| -profile.tractive_tension[point]);
    let tractive = belt.value < 0.0;
    let place = if tractive { pressing } else { belt };
    let check = Check {
        name: "tensions positive",
        deviation: positive(place.value) / state.tight_tension.abs(),
        limit: 0.0,
    };
    let reason = Impossible::Slack {
        tractive,
        pulley: place.pulley,
        angle: place.angle,
        tension: -place.value,
    };
    (check, reason)
}

/// p ≥ 0.
fn pressure(state: &SteadyState, accuracy: f64) -> (Check, Impossible) {
    let place = worst(state, |profile, point| -profile.normal_force[point]);
    let largest = largest_pressure(state);
    let check = Check {
        name: "normal pressure not negative",
        deviation: positive(place.value / largest),
        limit: AT_ENDS * accuracy,
    };
    let reason = Impossible::Pulls {
        pulley: place.pulley,
        angle: place.angle,
        force: -place.value,
        largest,
    };
    (check, reason)
}

/// |f| ≤ μ p.
fn friction(state: &SteadyState, accuracy: f64) -> (Check, Impossible) {
    let mu = state.drive.pair().friction_coefficient;
    let excess = |profile: &Profile, point: usize| {
        profile.friction_force[point].abs() - mu * profile.normal_force[point]
    };
    let place = worst(state, excess);
    let check = Check {
        name: "friction within its limit",
        deviation: positive(place.value / (mu * largest_pressure(state))),
        limit: accuracy,
    };
    let reason = Impossible::ExcessFriction {
        pulley: place.pulley,
        angle: place.angle,
        friction: place.friction,
        limit: mu * place.pressure,
    };
    (check, reason)
}

/// The powers of a state, W.
struct Powers {
    given: f64,
    taken: f64,
    friction: f64,
    compression: f64,
    /// What their errors are relative to: tight tension times belt speed.
    scale: f64,
}

impl Powers {
    fn of(state: &SteadyState) -> Self {
        let [driver, driven] = [&state.driver, &state.driven];
        Self {
            given: driver.torque * driver.angular_speed,
            taken: driven.torque * driven.angular_speed,
            friction: state.friction_loss,
            compression: state.compression_power,
            scale: state.tight_tension.abs() * state.mass_flow / state.drive.belt.mass_per_length,
        }
    }

    fn check(&self, name: &'static str, deviation: f64, limit: f64) -> (Check, Impossible) {
        let deviation = deviation / self.scale;
        let check = Check {
            name,
            deviation,
            limit,
        };
        let Self {
            given,
            taken,
            friction,
            compression,
            ..
        } = *self;
        let reason = Impossible::Powers {
            given,
            taken,
            friction,
            compression,
        };
        (check, reason)
    }
}

/// The power lost is that of friction and compression.
fn balance(state: &SteadyState, accuracy: f64) -> (Check, Impossible) {
    let powers = Powers::of(state);
    let lost = powers.given - powers.taken;
    let unexplained = lost - powers.friction - powers.compression;
    powers.check("power balance", unexplained.abs(), accuracy)
}

/// Friction takes power.
fn friction_loss(state: &SteadyState, accuracy: f64) -> (Check, Impossible) {
    let powers = Powers::of(state);
    let gained = positive(-powers.friction);
    powers.check("friction loss not negative", gained, accuracy)
}

/// The driven pulley takes no more than the driver gives.
fn efficiency(state: &SteadyState, accuracy: f64) -> (Check, Impossible) {
    let powers = Powers::of(state);
    let gained = positive(powers.taken - powers.given);
    powers.check("efficiency from 0 to 1", gained, accuracy)
}

/// Belt and spans have a length.
fn lengths(state: &SteadyState) -> (Check, Impossible) {
    let lengths = [
        ("belt", state.belt_length),
        ("slack span", state.slack_span),
        ("tight span", state.tight_span),
    ];
    let longest = lengths.iter().map(|(_, length)| length.abs());
    let longest = longest.fold(0.0, f64::max);
    let [mut shortest, others @ ..] = lengths;
    for other in others {
        if other.1 < shortest.1 || other.1.is_nan() {
            shortest = other;
        }
    }
    let (name, length) = shortest;
    let check = Check {
        name: "lengths of belt and spans positive",
        deviation: positive(-length / longest),
        limit: 0.0,
    };
    (check, Impossible::Length { name, length })
}

/// A point of a profile.
#[derive(Clone, Copy)]
struct Place {
    pulley: Role,
    angle: f64,
    friction: f64,
    pressure: f64,
    /// What was measured there.
    value: f64,
}

/// The point of both profiles where a measure is largest, or not a number.
fn worst(state: &SteadyState, measure: impl Fn(&Profile, usize) -> f64) -> Place {
    let mut worst = Place {
        pulley: Role::Driven,
        angle: 0.0,
        friction: 0.0,
        pressure: 0.0,
        value: f64::NEG_INFINITY,
    };
    let pulleys = [(Role::Driven, &state.driven), (Role::Driver, &state.driver)];
    for (pulley, PulleyState { profile, .. }) in pulleys {
        for point in 0..profile.angle.len() {
            let value = measure(profile, point);
            if value > worst.value || value.is_nan() {
                worst = Place {
                    pulley,
                    angle: profile.angle[point],
                    friction: profile.friction_force[point],
                    pressure: profile.normal_force[point],
                    value,
                };
            }
        }
    }
    worst
}

/// The largest normal force per length on both pulleys, N/m.
fn largest_pressure(state: &SteadyState) -> f64 {
    worst(state, |profile, point| profile.normal_force[point]).value
}

/// By how much a number exceeds zero; what is not a number stays so.
fn positive(value: f64) -> f64 {
    if value <= 0.0 { 0.0 } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::samples::{flat, v_belt};

    /// The names of the checks that a state fails.
    fn failed(state: &SteadyState) -> Vec<&'static str> {
        let failed = checks(state).into_iter().filter(|check| !check.holds());
        failed.map(|check| check.name).collect()
    }

    /// A made-up state, which fails no check but that of its made-up powers.
    fn state() -> SteadyState {
        let mut state = v_belt::loaded();
        let power = |pulley: &PulleyState| pulley.torque * pulley.angular_speed;
        state.friction_loss = power(&state.driver) - power(&state.driven);
        assert_eq!(failed(&state), [""; 0]);
        state
    }

    fn assert_fault(change: impl Fn(&mut SteadyState), name: &str, words: &str) {
        let mut state = state();
        change(&mut state);
        assert!(failed(&state).contains(&name), "{name}");
        let text = fault(&state).unwrap().to_string();
        assert!(text.contains(words), "{text}");
    }

    #[test]
    fn every_fault_is_seen_and_said() {
        assert_fault(
            |state| state.mass_flow = -160.0,
            "belt slower than axial waves",
            "1481.48 m/s, faster than axial waves run along it, sqrt(EA/m) = 1054.09 m/s",
        );
        assert_fault(
            |state| state.driver.profile.tractive_tension[100] = -3.5,
            "tensions positive",
            "the tractive tension on the driver falls to -3.5 N",
        );
        assert_fault(
            |state| {
                state.driven.profile.tension[100] = -4.5;
                state.driven.profile.tractive_tension[100] = -75.5;
            },
            "tensions positive",
            "the belt tension on the driven pulley falls to -4.5 N",
        );
        assert_fault(
            |state| *state.driver.profile.normal_force.last_mut().unwrap() = -4.2,
            "normal pressure not negative",
            "pull at the driver instead of pressing on it: normal force -4.2 N/m",
        );
        assert_fault(
            |state| *state.driver.profile.friction_force.last_mut().unwrap() = 5.0,
            "friction within its limit",
            "friction on the driver would be 5 N/m and can be 0 N/m",
        );
        assert_fault(
            |state| state.friction_loss *= 1.001,
            "power balance",
            "but friction takes",
        );
        assert_fault(
            |state| {
                state.friction_loss = -1.0;
            },
            "friction loss not negative",
            "friction takes -1 W",
        );
        assert_fault(
            |state| state.driven.torque *= 1.1,
            "efficiency from 0 to 1",
            "reach the driven pulley",
        );
        assert_fault(
            |state| state.belt_length = -4.1,
            "lengths of belt and spans positive",
            "the belt would be -4.1 m long",
        );
    }

    #[test]
    fn what_is_not_a_number_is_a_fault() {
        let faults: [fn(&mut SteadyState); 6] = [
            |state| state.mass_flow = f64::NAN,
            |state| state.driver.profile.tension[7] = f64::NAN,
            |state| state.driven.profile.tractive_tension[7] = f64::NAN,
            |state| state.driven.profile.normal_force[7] = f64::NAN,
            |state| state.driven.profile.friction_force[7] = f64::NAN,
            |state| state.tight_span = f64::NAN,
        ];
        for (index, change) in faults.into_iter().enumerate() {
            let mut state = state();
            change(&mut state);
            assert!(fault(&state).is_some(), "{index}");
        }
    }

    #[test]
    fn flat_belts_are_examined_to_the_digits_of_their_closed_form() {
        let state = flat::coulomb();
        assert_eq!(accuracy(&state), 1e-9);
        assert_eq!(accuracy(&v_belt::loaded()), 1e-7);
    }
}
