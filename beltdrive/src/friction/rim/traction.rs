//! The belt in steady motion: how tension, traction, stretch and normal force belong together.

use crate::NormalForce;
use bvp::Real;

/// A flat belt that moves with a given speed, under one convention for its normal force.
///
/// With the speed c = G/m of the unstretched belt, the belt speed is V = c (1 + T/EA). Along a pulley
/// friction f per length changes the traction P,
///
/// ```text
/// dP/dσ = ± f        P − P_o = D u′ = D (T − T_o)/EA        D = EA − m v²
/// ```
///
/// in a coordinate σ along the belt with ds/dσ = α + β P, and slipping friction is μ n per arc length s
/// with n = a P/μ. The conventions differ in these numbers only:
///
/// ```text
///            P              v    a            α      β      σ
/// thesis     T D/EA         V_L  μ EA/(D R)   1      0      arc length s
/// inertia    T − G V        c    μ/R          1      0      arc length s
/// exact      T − G V        c    μ/R          EA/D   1/D    length of the unstretched belt
/// ```
///
/// with `V_L` the speed of the slack span: of the slackest one where there are more than two, so that one D
/// serves all pulleys and their torques balance. Source: Kim (2009), equations 3, 52-58 (thesis); the balance of
/// momentum of an element, Bechtel, Vohra, Jacob and Carlson (2000), for the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Traction<S = f64> {
    /// Dynamic stiffness D = EA − m v², N; positive.
    pub(crate) stiffness: S,
    /// Axial stiffness EA, N.
    axial_stiffness: S,
    /// What the inertia of the belt takes off the tension at T = 0: m c², N; 0 for `thesis`.
    pub(crate) inertia: S,
    /// Slip rate of a pulley of radius 1 m with a coefficient of friction 1: a R/μ.
    slip_rate: S,
    /// The stretch ds/dσ = α + β P.
    stretch: [S; 2],
}

impl<S: Real> Traction<S> {
    /// The belt with mass m per length, kg/m, and axial stiffness EA, N. `speed` is v of the table
    /// above, m/s.
    ///
    /// The stiffness D is not positive from the critical speed on, sqrt(EA/m).
    pub(crate) fn new(
        convention: NormalForce,
        mass_per_length: S,
        axial_stiffness: S,
        speed: S,
    ) -> Self {
        let kinetic = mass_per_length * speed * speed;
        let stiffness = axial_stiffness - kinetic;
        let exact = [axial_stiffness / stiffness, S::ONE / stiffness];
        let plain = [S::ONE, S::ZERO];
        let (inertia, slip_rate, stretch) = match convention {
            NormalForce::Thesis => (S::ZERO, axial_stiffness / stiffness, plain),
            NormalForce::Inertia => (kinetic, S::ONE, plain),
            NormalForce::Exact => (kinetic, S::ONE, exact),
        };
        Self {
            stiffness,
            axial_stiffness,
            inertia,
            slip_rate,
            stretch,
        }
    }

    /// The traction P of a tension T, N.
    pub(crate) fn of_tension(&self, tension: S) -> S {
        tension * self.stiffness / self.axial_stiffness - self.inertia
    }

    /// The tension T of a traction P, N.
    pub(crate) fn tension(&self, traction: S) -> S {
        self.axial_stiffness * self.strain(traction)
    }

    /// The strain T/EA of the belt at a traction P.
    pub(crate) fn strain(&self, traction: S) -> S {
        (traction + self.inertia) / self.stiffness
    }

    /// Elongation 1 − 1/(1 + T/EA) per length of the stretched belt, at a traction P: (P + m c²)/(P + S)
    /// with S of [`Self::offset`].
    pub(crate) fn elongation(&self, traction: S) -> S {
        (traction + self.inertia) / (self.offset() + traction)
    }

    /// S = D (1 + T/EA) − P, N.
    pub(crate) fn offset(&self) -> S {
        self.stiffness + self.inertia
    }

    /// Slip rate a on a pulley, 1/m: traction grows in a slip zone as exp(± a s).
    pub(crate) fn slip_rate(&self, friction_coefficient: S, radius: S) -> S {
        friction_coefficient / radius * self.slip_rate
    }

    /// The stretch ds/dσ at a traction P.
    pub(crate) fn stretch(&self, traction: S) -> S {
        let [alpha, beta] = self.stretch;
        alpha + beta * traction
    }

    /// Coefficient β of the stretch, 1/N.
    pub(crate) fn stretch_slope(&self) -> S {
        self.stretch[1]
    }

    /// Coefficient α of the stretch.
    pub(crate) fn stretch_offset(&self) -> S {
        self.stretch[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tension_and_traction_are_inverse() {
        for convention in NormalForce::ALL {
            let traction = Traction::new(convention, 0.1036, 80_068.0, 9.7);
            let tension = traction.tension(traction.of_tension(716.7));
            assert!((tension - 716.7).abs() < 1e-10, "{convention:?}");
        }
    }

    #[test]
    fn the_exact_stretch_is_that_of_the_belt() {
        let exact = Traction::new(NormalForce::Exact, 0.8288, 8000.0, 1.2);
        let stretch = exact.stretch(exact.of_tension(664.5));
        assert!((stretch - (1.0 + 664.5 / 8000.0)).abs() < 1e-14);
    }
}
