//! Random V-belt drives of a wide family.

use super::random::Random;
use beltdrive::{Belt, BeltKind, FrictionLaw, Load, SpanTension, TwoPulleys, VBelt};
use std::f64::consts::PI;

/// Uniform in the logarithm.
fn scale(random: &mut Random, low: f64, high: f64) -> f64 {
    random.between(low.ln(), high.ln()).exp()
}

/// A law by its number: Coulomb, scalar and vector EPP friction, bristles.
fn law(number: usize, random: &mut Random) -> FrictionLaw {
    let stiffness = scale(random, 1e6, 1e9);
    let bristles = scale(random, 300.0, 2e4);
    match number {
        0 => FrictionLaw::Coulomb,
        1 => FrictionLaw::Epp { stiffness },
        2 => FrictionLaw::VectorEpp { stiffness },
        _ => FrictionLaw::Bristle {
            stiffness: bristles,
        },
    }
}

/// A drive with the law of a number and a tension ratio in a range: soft and stiff belts and grooves, ratios from 1:4 to
/// 4:1, near and far pulleys.
pub(crate) fn drive(random: &mut Random, number: usize, [low, high]: [f64; 2]) -> TwoPulleys {
    loop {
        let driver_radius = scale(random, 0.02, 0.4);
        let driven_radius = driver_radius * scale(random, 0.25, 4.0);
        let slack = scale(random, 20.0, 800.0);
        let ratio = scale(random, low, high);
        let radial_stiffness = scale(random, 3e5, 3e7);
        let half_angle = random.between(11.0, 21.0).to_radians();
        let smallest = driver_radius.min(driven_radius);
        // A belt that sinks through a tenth of the smaller pulley is of no use.
        let depth = slack * ratio / (radial_stiffness * smallest * half_angle.tan());
        let drive = TwoPulleys {
            belt: Belt {
                ribs: 1,
                mass_per_length: scale(random, 0.03, 0.6),
                axial_stiffness: scale(random, 1e4, 5e5),
                kind: BeltKind::V(VBelt {
                    radial_stiffness,
                    half_angle,
                    height: None,
                }),
            },
            friction_coefficient: random.between(0.15, 0.8),
            law: law(number, random),
            driver_radius,
            driver_speed: scale(random, 100.0, 6000.0) * PI / 30.0,
            driven_radius,
            centre_distance: (driver_radius + driven_radius) * random.between(1.05, 4.0),
            load: Load {
                slack: SpanTension::Tractive(slack),
                tight: SpanTension::Tractive(slack * ratio),
            },
        };
        let speed = drive.driver_speed * driver_radius;
        let waves = drive.belt.axial_stiffness / drive.belt.mass_per_length;
        if speed < 60.0 && speed * speed < 0.1 * waves && depth < 0.1 * smallest {
            return drive;
        }
    }
}
