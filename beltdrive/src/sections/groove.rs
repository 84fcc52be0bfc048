//! Groove angles of pulleys by their diameters.

use super::{Figure, Source};

/// Groove angles by the diameter of the pulley.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrooveRule {
    /// The standard.
    pub standard: &'static str,
    /// Angles, from small pulleys to large ones; the last has no largest diameter.
    pub steps: &'static [GrooveStep],
    /// Where it is from.
    pub sources: &'static [Source],
}

/// An angle of grooves up to a diameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrooveStep {
    /// Largest pitch diameter with this angle, m; `None` for all above.
    pub up_to: Option<f64>,
    /// Angle between the faces of the groove, rad.
    pub angle: f64,
}

/// The groove of a pulley.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Groove {
    /// Angle between its faces, rad: twice the half angle β.
    pub angle: f64,
    /// By which rule.
    pub rule: GrooveRule,
}

impl Groove {
    /// The half angle β in rad, with its source.
    pub fn half_angle(&self) -> Figure {
        Figure::printed(0.5 * self.angle, self.rule.sources)
    }
}

impl GrooveRule {
    /// The groove of a pulley of a pitch diameter in m.
    ///
    /// # Panics
    /// Never: every rule has a last step without a largest diameter.
    pub fn groove(&self, diameter: f64) -> Groove {
        // A diameter that was read in another unit may be off by rounding.
        let reaches = |limit: f64| diameter <= limit * (1.0 + 4.0 * f64::EPSILON);
        let is_wide_enough = |step: &&GrooveStep| step.up_to.is_none_or(reaches);
        let step = self.steps.iter().find(is_wide_enough);
        Groove {
            angle: step.expect("a last step").angle,
            rule: *self,
        }
    }
}

/// A step up to a diameter in mm.
pub(super) const fn to(diameter: f64, degrees: f64) -> GrooveStep {
    GrooveStep {
        up_to: Some(diameter / 1e3),
        angle: degrees.to_radians(),
    }
}

/// The step above all others.
pub(super) const fn above(degrees: f64) -> GrooveStep {
    GrooveStep {
        up_to: None,
        angle: degrees.to_radians(),
    }
}
