//! The units in which the equations of a drive are pure numbers of order one.

use super::Over;
use super::numbers::Numbers;
use crate::{Belt, SpanTension, TwoPulleys};
use bvp::Real;

/// The units of a drive or a loop. A scaled quantity times its unit is the quantity in SI.
///
/// ```text
/// forces F, T          F_ref           lengths s, x on pulley i    Rᵢ
/// mass flow G          m ω_d R_d       line loads p, f             F_ref/Rᵢ
/// belt speed V         ω_d R_d         displacement u              F_ref Rᵢ/EA
/// angular speed ωᵢ     ω_d R_d/Rᵢ      torque                      F_ref Rᵢ
/// ```
///
/// The driver d turns at 1, and every other pulley at 1 where nothing slips or stretches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Units<S = f64> {
    /// Reference force `F_ref`, N; positive.
    pub(crate) force: f64,
    /// Circumferential speed `ω_d R_d` of the driver, m/s.
    pub(crate) speed: S,
    /// Mass per unstretched length, kg/m.
    pub(super) mass_per_length: S,
    /// Axial stiffness EA, N.
    pub(super) axial_stiffness: S,
}

impl Units {
    /// Of a belt and its driver's circumferential speed in m/s, with a reference force in N.
    pub(crate) fn new(belt: &Belt, speed: f64, force: f64) -> Self {
        Self {
            force,
            speed,
            mass_per_length: belt.mass_per_length,
            axial_stiffness: belt.axial_stiffness,
        }
    }

    /// Unit of torque on a pulley, N·m.
    pub(crate) fn torque(&self, radius: f64) -> f64 {
        self.force * radius
    }

    /// Unit of power, W.
    pub(crate) fn power(&self) -> f64 {
        self.force * self.speed
    }

    /// Unit of the mass flow, kg/s.
    pub(crate) fn mass_flow(&self) -> f64 {
        self.mass_per_length * self.speed
    }

    /// Unit of the angular speed of a pulley, rad/s.
    pub(crate) fn angular_speed(&self, radius: f64) -> f64 {
        self.speed / radius
    }
}

impl<S: Real> Units<S> {
    /// Unit of line loads on a pulley of a radius in m, N/m.
    pub(crate) fn line_load(&self, radius: S) -> S {
        S::from_f64(self.force) / radius
    }

    /// Unit of the displacement on a pulley, m: the stretch of a length R under `F_ref`.
    pub(crate) fn displacement(&self, radius: S) -> S {
        radius * self.force / self.axial_stiffness
    }

    /// The belt as a moving string, in these units.
    pub(crate) fn strand(&self) -> Strand<S> {
        Strand {
            inertia: self.mass_per_length * self.speed.powi(2) / self.force,
            compliance: S::from_f64(self.force) / self.axial_stiffness,
        }
    }

    /// Scaled radial stiffness k R²/`F_ref` on a pulley, from k in N/m².
    pub(crate) fn radial_stiffness(&self, stiffness: S, radius: S) -> S {
        stiffness * radius / self.line_load(radius)
    }

    /// Scaled friction stiffness `k_f` R²/EA on a pulley, from `k_f` in N/m².
    pub(crate) fn friction_stiffness(&self, stiffness: S, radius: S) -> S {
        stiffness * self.displacement(radius) / self.line_load(radius)
    }
}

/// The units of a drive with two pulleys.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scales {
    /// Those that both pulleys share.
    pub(crate) units: Units,
    /// Pitch radii of the driven pulley and of the driver, m.
    pub(crate) radius: [f64; 2],
}

impl Scales {
    /// Units by the largest prescribed tension: tensions are then of order one at every load.
    pub(crate) fn new(drive: &TwoPulleys) -> Self {
        let force = drive.load.tight.value().max(drive.load.slack.value());
        Self::with_force(drive, force)
    }

    /// Units with a given reference force in N, to compare states of different loads.
    pub(crate) fn with_force(drive: &TwoPulleys, force: f64) -> Self {
        let numbers = Numbers::new(drive);
        Self {
            units: numbers.units(force),
            radius: numbers.radius,
        }
    }
}

/// The belt as a string in steady motion, scaled: everything that follows from F and G alone.
///
/// ```text
/// F = T − G V,  V = (G/m)(1 + T/EA)   ⇔   T = (F + c G²)/(1 − c e G²),  V = G (1 + e T)
/// c = m (ω_d R_d)²/F_ref,  e = F_ref/EA
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Strand<S = f64> {
    /// Centrifugal tension c of the reference speed.
    pub(crate) inertia: S,
    /// Strain e of the reference force.
    pub(crate) compliance: S,
}

impl<S: Real> Strand<S> {
    /// Belt tension T from the tractive tension F and the mass flow G.
    pub(crate) fn tension<T: Over<S>>(&self, tractive: T, flow: T) -> T {
        let momentum = flow * flow * self.inertia;
        (tractive + momentum) / (T::from_f64(1.0) - momentum * self.compliance)
    }

    /// Tractive tension F from the belt tension T and the mass flow G.
    pub(crate) fn tractive<T: Over<S>>(&self, tension: T, flow: T) -> T {
        tension - flow * self.speed(tension, flow) * self.inertia
    }

    /// The tension by which a span is prescribed, tractive or of the belt, from F and G.
    pub(crate) fn prescribed<T: Over<S>>(&self, span: SpanTension, tractive: T, flow: T) -> T {
        match span {
            SpanTension::Tractive(_) => tractive,
            _ => self.tension(tractive, flow),
        }
    }

    /// Belt speed V.
    pub(crate) fn speed<T: Over<S>>(&self, tension: T, flow: T) -> T {
        flow * (self.strain(tension) + 1.0)
    }

    /// Relative change of the belt speed V per tractive tension F, (dV/dF)/V, where they are T and V.
    pub(crate) fn stretching<T: Over<S>>(&self, tension: T, speed: T) -> T {
        let stretch = self.strain(tension) + 1.0;
        let flow = speed / stretch;
        let stiffening = T::from_f64(1.0) - flow * flow * (self.inertia * self.compliance);
        T::from(self.compliance) / (stretch * stiffening)
    }

    /// Strain T/EA.
    pub(crate) fn strain<T: Over<S>>(&self, tension: T) -> T {
        tension * self.compliance
    }
}

impl Strand {
    /// Tractive tension F of a span, from the tension by which it is prescribed and G.
    pub(crate) fn tractive_of(&self, span: SpanTension, flow: f64) -> f64 {
        match span {
            SpanTension::Tractive(tractive) => tractive,
            tension => self.tractive(tension.value(), flow),
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::{BeltKind, FrictionLaw, Load, VBelt};

    /// A V-belt with a mass, an axial and a radial stiffness and a half-angle of the groove, SI.
    pub(in crate::vbelt) fn v_belt([mass, axial, radial, half_angle]: [f64; 4]) -> Belt {
        Belt {
            ribs: 1,
            mass_per_length: mass,
            axial_stiffness: axial,
            kind: BeltKind::V(VBelt {
                radial_stiffness: radial,
                half_angle,
                height: None,
            }),
        }
    }

    /// Tractive tensions of the slack and the tight span in N.
    pub(in crate::vbelt) fn tractive(slack: f64, tight: f64) -> Load {
        Load {
            slack: SpanTension::Tractive(slack),
            tight: SpanTension::Tractive(tight),
        }
    }

    /// The drive of Kim (2009), table 3, with unequal radii if asked for.
    pub(in crate::vbelt) fn kim(law: FrictionLaw, driven_radius: f64) -> TwoPulleys {
        TwoPulleys {
            belt: v_belt([0.108, 120e3, 900e3, 18_f64.to_radians()]),
            friction_coefficient: 0.4,
            law,
            driver_radius: 0.25,
            driver_speed: 1000.0 * std::f64::consts::PI / 30.0,
            driven_radius,
            centre_distance: 1.393_327_732_346_075,
            load: tractive(100.0, 700.0),
        }
    }

    #[test]
    fn tension_and_tractive_tension_are_inverse() {
        let strand = Scales::new(&kim(FrictionLaw::Coulomb, 0.2)).units.strand();
        for (tractive, flow) in [(0.1, 0.97), (1.0, 0.93), (0.0, 1.02)] {
            let tension = strand.tension(tractive, flow);
            assert!((strand.tractive(tension, flow) - tractive).abs() < 1e-15);
        }
    }

    #[test]
    fn units_turn_scaled_tensions_into_newtons() {
        let drive = kim(FrictionLaw::Coulomb, 0.2);
        let scales = Scales::new(&drive).units;
        let (m, stiffness) = (drive.belt.mass_per_length, drive.belt.axial_stiffness);
        let (force, flow) = (433.0, 2.7);
        let expected = (force + flow * flow / m) / (1.0 - flow * flow / (m * stiffness));
        let tension = scales
            .strand()
            .tension(force / scales.force, flow / scales.mass_flow());
        assert!((tension * scales.force / expected - 1.0).abs() < 1e-14);
        let speed = scales.strand().speed(tension, flow / scales.mass_flow()) * scales.speed;
        assert!((speed / (flow / m * (1.0 + expected / stiffness)) - 1.0).abs() < 1e-14);
    }
}
