//! The stability of the axial motion of a flat belt on its pulleys.

use crate::Drive;

/// A form of the linearised problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinearisedForm {
    /// Slip friction changes with the elastic tension, and the belt leaves without strain:
    ///
    /// ```text
    /// m λ² f + (2 m v λ + EA η) f' − D f'' + κ f = 0,   f'(L) = 0
    /// ```
    ///
    /// Kim (2009), equations 69 to 74.
    Thesis,
    /// The same equation with the natural outlet condition of Hamilton's principle,
    ///
    /// ```text
    /// D f'(L) = m v λ f(L)
    /// ```
    NaturalOutlet,
    /// Slip friction changes with the normal force n = (T − G V)/R, inertia included, and the
    /// outlet is natural. With the axial momentum flow P = D f' − m v λ f:
    ///
    /// ```text
    /// m λ (λ f + v f') − P' + η P + κ f = 0,   P(L) = 0
    /// ```
    ///
    /// This is the Euler-Lagrange equation of the Lagrangian density weighted by
    /// exp(−η (s − s*)): the motion is conservative and Re λ = 0.
    Conservative,
}

impl LinearisedForm {
    /// Every form.
    pub const ALL: [Self; 3] = [Self::Thesis, Self::NaturalOutlet, Self::Conservative];
}

/// Whether small axial motions of the belt about the steady state of a drive grow.
#[derive(Clone, Debug)]
pub struct Stability {
    /// The drive.
    pub drive: Drive,
    /// Speed of axial waves in the belt at rest, sqrt(EA/m), m/s: no belt runs faster steadily.
    pub critical_speed: f64,
    /// On the driver.
    pub driver: PulleyStability,
    /// On the driven pulley.
    pub driven: PulleyStability,
    /// Wall-clock seconds.
    pub seconds: f64,
}

/// The axial motion on one pulley.
#[derive(Clone, Debug)]
pub struct PulleyStability {
    /// Speed of the belt where it enters, m/s.
    pub belt_speed: f64,
    /// Length of contact, m.
    pub contact_length: f64,
    /// Where slip begins, m from the entry; the length of contact if the belt does not slip.
    pub transition: f64,
    /// The spectrum in every form of the linearised problem, in the order of [`LinearisedForm::ALL`].
    pub forms: [FormStability; 3],
}

/// The spectrum in one form of the linearised problem.
#[derive(Clone, Debug)]
pub struct FormStability {
    /// The form.
    pub form: LinearisedForm,
    /// The lowest modes in order of frequency.
    pub modes: Vec<AxialMode>,
    /// Index of the mode that grows most, or decays least, among these.
    pub least_stable: usize,
    /// What the rates of growth tend to for high modes, 1/s.
    pub high_mode_limit: f64,
    /// Number of eigenvalues in a box about zero by the argument principle, conjugates included;
    /// equal to the number found.
    pub counted: usize,
    /// The box: bounds of |Re λ| and |Im λ|, 1/s.
    pub within: [f64; 2],
    /// The load from which on a motion grows; not looked for in the conservative form, in which none
    /// does.
    pub onset: Option<Onset>,
}

/// An eigenvalue λ of the axial motion, which goes as exp(λ t), with its conjugate.
#[derive(Clone, Debug, PartialEq)]
pub struct AxialMode {
    /// Rate of growth Re λ, 1/s.
    pub growth: f64,
    /// Angular frequency Im λ, rad/s; not negative.
    pub frequency: f64,
    /// Relative difference between the two methods by which it was found.
    pub difference: f64,
    /// The shape of the motion along the belt; of the first modes only.
    pub shape: Vec<ShapePoint>,
}

/// The eigenfunction of a mode at a place. Its largest value is 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapePoint {
    /// Arc length from the entry, m.
    pub arc_length: f64,
    /// Real and imaginary part.
    pub value: [f64; 2],
}

/// Where a drive turns unstable as its load grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Onset {
    /// At a load.
    At {
        /// The load, N or N·m as [`crate::input::Key::load`].
        load: f64,
        /// Number of the mode that grows first, from 1; `None` if high modes grow as soon.
        mode: Option<usize>,
    },
    /// Nowhere up to the largest load that the drive carries.
    Never,
}

/// Relative growth |Re λ|/|λ| that is rounding.
pub(crate) const ROUNDING: f64 = 1e-9;

impl AxialMode {
    /// Whether the motion grows.
    pub fn grows(&self) -> bool {
        self.growth > ROUNDING * self.growth.hypot(self.frequency)
    }
}

impl FormStability {
    /// Whether some motion grows: one of the modes, or the high ones.
    pub fn is_unstable(&self) -> bool {
        self.high_mode_limit > 0.0 || self.modes.iter().any(AxialMode::grows)
    }

    /// The largest rate of growth Re λ among the modes, 1/s.
    pub fn largest_growth(&self) -> f64 {
        self.modes[self.least_stable].growth
    }
}
