//! A family of boundary value problems as a system for continuation.

use bvp::Family;
use continuation::{Cause, System, TwoParameter};

/// A discretised family, one of whose held parameters may be the second one.
#[derive(Clone)]
pub struct Curve<'a> {
    /// The family.
    pub family: Family<'a>,
    /// Index of the second parameter, held at first.
    pub second: usize,
}

impl System for Curve<'_> {
    fn unknowns(&self) -> usize {
        self.family.unknowns()
    }

    fn residual(&mut self, z: &[f64], g: &mut [f64]) {
        self.family.residual(z, g);
    }

    fn linearise(&mut self, z: &[f64]) -> Result<(), Cause> {
        Ok(self.family.linearise(z)?)
    }

    fn particular(&mut self, r: &[f64], v: &mut [f64]) {
        self.family.particular(r, v);
    }

    fn null_vector(&mut self, t: &mut [f64]) {
        self.family.null_vector(t);
    }

    fn groups(&self, group: &mut [usize], share: &mut [f64]) {
        self.family.groups(group, share);
    }

    fn adapt(&mut self, z: &[f64], vectors: &mut [Vec<f64>]) -> Result<bool, Cause> {
        Ok(self.family.adapt(z, vectors)?)
    }

    fn refined(&self, vectors: &mut [Vec<f64>]) -> Option<Self> {
        let family = self.family.refined(vectors)?;
        Some(Self { family, ..*self })
    }

    fn tolerance(&self) -> f64 {
        self.family.tolerance()
    }
}

impl TwoParameter for Curve<'_> {
    fn second(&self) -> f64 {
        self.family.held(self.second)
    }

    fn set_second(&mut self, value: f64) {
        self.family.hold(self.second, value);
    }
}
