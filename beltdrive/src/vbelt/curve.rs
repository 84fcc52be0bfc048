//! A family of drives as a system for continuation.

use super::family::DriveFamily;
use bvp::Family;
use continuation::{Cause, System, TwoParameter};

/// A discretised family of drives, over one entry or over two of which the second is held.
#[derive(Clone)]
pub(super) struct Curve<'a> {
    pub(super) family: Family<'a>,
    /// The same drives with a smaller ε. A labelled point is compared with that of these drives on
    /// the halved mesh, so that its error is that of both.
    pub(super) finer: Option<&'a DriveFamily>,
    /// Index of the second entry among the parameters.
    pub(super) second: usize,
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
        let halved = self.family.refined(vectors)?;
        let family = match self.finer {
            Some(finer) => halved.exchanged(finer).ok()?,
            None => halved,
        };
        Some(Self { family, ..*self })
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
