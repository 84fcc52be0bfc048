//! Boundary value problems as systems: the feature `bvp`.

use crate::difficulty::Cause;
use crate::system::system::{System, TwoParameter};
use bvp::Family;

/// The discretised family is a system as it is: the parameter of the family is λ, the mesh follows the
/// solution, and labelled points have an estimate of their discretisation error.
///
/// [`System::derivative_along`] is not known: a family has the Jacobians of its equations, but not whether
/// they are exact. By the central differences of [`bvp::FiniteDifferences`], accurate to 1e-10, second
/// derivatives over steps of 5e-3 would have errors of 2e-8, where second differences of G have 1e-9.
impl System for Family<'_> {
    fn unknowns(&self) -> usize {
        Family::unknowns(self)
    }

    fn residual(&mut self, z: &[f64], g: &mut [f64]) {
        Family::residual(self, z, g);
    }

    fn linearise(&mut self, z: &[f64]) -> Result<(), Cause> {
        Ok(Family::linearise(self, z)?)
    }

    fn particular(&mut self, r: &[f64], v: &mut [f64]) {
        Family::particular(self, r, v);
    }

    fn null_vector(&mut self, t: &mut [f64]) {
        Family::null_vector(self, t);
    }

    fn groups(&self, group: &mut [usize], share: &mut [f64]) {
        Family::groups(self, group, share);
    }

    fn adapted(&mut self, vectors: &mut [Vec<f64>]) -> Result<Option<Self>, Cause> {
        Ok(Family::adapted(self, vectors)?)
    }

    fn refined(&self, vectors: &mut [Vec<f64>]) -> Option<Self> {
        Family::refined(self, vectors)
    }

    fn tolerance(&self) -> f64 {
        Family::tolerance(self)
    }
}

/// μ is the first of the parameters that the family holds.
///
/// # Panics
/// If the family holds none.
impl TwoParameter for Family<'_> {
    fn second(&self) -> f64 {
        self.held(first_held(self))
    }

    fn set_second(&mut self, value: f64) {
        let second = first_held(self);
        self.hold(second, value);
    }
}

fn first_held(family: &Family<'_>) -> usize {
    let first = family.held_parameters().next();
    first.expect("a parameter that the family holds, to be the second one")
}
