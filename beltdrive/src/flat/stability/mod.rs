//! The stability of the axial motion of a flat belt on one pulley.
//!
//! The belt enters the pulley at s = 0 and leaves it at s = L. It is elastic on 0 ≤ s ≤ s*, where
//! friction holds every point of the belt to one of the pulley like a spring κ = `k_f`, and slips
//! on s* ≤ s ≤ L, where κ = 0. A perturbation f(s) exp(λ t) of the axial displacement about the
//! steady state obeys
//!
//! ```text
//! m λ² f + 2 m v λ f' − D f'' + κ f + (friction perturbed in the slip zone) = 0,   D = EA − m v²
//! f(0) = 0,   f and f' continuous at s*
//! ```
//!
//! with the mass per length m, the belt speed v and the axial stiffness EA. Where slip friction
//! follows the normal force, the rate η = ±μ/R enters; what follows from it, and what happens
//! at the outlet, is a choice of [`LinearisedForm`]. Under rigid friction the belt does not move up to s*,
//! and f(s*) = 0 takes the place of f(0) = 0.
//!
//! Every eigenvalue λ is found by two independent methods, which must agree: spectral elements
//! (`spectral`) and Newton's method on the exact characteristic function (`characteristic`). The
//! winding of that function around a box (`winding`) then says whether any is missing.
//!
//! Source: D. Kim, MS thesis, Georgia Institute of Technology (2009), equations 69 to 74.

mod characteristic;
mod drive;
mod motion;
mod polynomials;
mod scaled;
mod shape;
mod spectral;
mod spectrum;
mod transfer;
mod winding;

#[cfg(test)]
mod examples;
#[cfg(test)]
mod tests;

use crate::results::stability::LinearisedForm;
pub(crate) use drive::stability;

use motion::AxialMotion;
use shape::mode_shape;
use spectrum::{Mode, Spectrum, StabilityError, spectrum};
