//! What the stability of the axial motion depends on.

use crate::results::stability::LinearisedForm;

/// The belt on one pulley, with the steady state about which it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct AxialMotion {
    /// Mass per length m, kg/m.
    pub(crate) mass_per_length: f64,
    /// Axial stiffness EA, N.
    pub(crate) axial_stiffness: f64,
    /// Belt speed v, m/s; not negative.
    pub(crate) speed: f64,
    /// Length of contact L, m.
    pub(crate) length: f64,
    /// End s* of the elastic zone, where slip begins, m; L where the belt does not slip.
    pub(crate) transition: f64,
    /// Friction stiffness `k_f` of the elastic zone, N/m²; none where friction is rigid.
    pub(crate) elastic: Option<f64>,
    /// Rate η at which the tension grows along the slip zone, 1/m: F' = η F with F = T − G v where
    /// the normal force is F/R. It is +μ/R on the driven pulley and −μ/R on the driver.
    pub(crate) slip_rate: f64,
}

impl AxialMotion {
    /// Speed of axial waves c = √(EA/m) in the belt at rest, m/s, which is the critical belt speed:
    /// D = 0 there.
    pub(crate) fn critical_speed(&self) -> f64 {
        (self.axial_stiffness / self.mass_per_length).sqrt()
    }

    /// Place from which on the belt moves, m: 0, or s* under rigid friction.
    pub(crate) fn fixed_end(&self) -> f64 {
        if self.elastic.is_some() {
            0.0
        } else {
            self.transition
        }
    }

    /// The limit of Re λ over high modes, 1/s. With the length ℓ that moves and the length of the
    /// slip zone `l_s` it is
    ///
    /// ```text
    /// Thesis         (c² − v²)/(2 c ℓ) ln((c − v)/(c + v)) − η v l_s/(2 ℓ)
    /// NaturalOutlet  −η v l_s/(2 ℓ)
    /// Conservative   0
    /// ```
    ///
    /// from the product of all reflections and gains of a short wave that travels to the outlet
    /// and back. High are modes of frequencies well above √(`k_f`/m); those of a belt with an
    /// elastic zone oscillate about the limit, closer and closer.
    pub(crate) fn high_mode_limit(&self, form: LinearisedForm) -> f64 {
        let (c, v) = (self.critical_speed(), self.speed);
        let moving = self.length - self.fixed_end();
        let gain = -0.5 * self.slip_rate * v * (self.length - self.transition) / moving;
        let reflection = -(c * c - v * v) / (c * moving) * (v / c).atanh();
        match form {
            LinearisedForm::Thesis => reflection + gain,
            LinearisedForm::NaturalOutlet => gain,
            LinearisedForm::Conservative => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::examples::driven;

    #[test]
    fn waves_are_faster_than_the_belt() {
        let motion = driven(800.0);
        assert!((motion.critical_speed() - 879.12).abs() < 0.005);
    }
}
