//! A system that counts what is asked of it.

use continuation::{Cause, System};

/// Numbers of calls.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Counts {
    pub(crate) residuals: usize,
    pub(crate) linearisations: usize,
    pub(crate) solutions: usize,
    /// The most vectors that the branch has handed over to be re-expressed.
    pub(crate) vectors: usize,
}

/// A system and its counts.
pub(crate) struct Counting<S> {
    pub(crate) system: S,
    pub(crate) counts: Counts,
}

impl<S> Counting<S> {
    pub(crate) fn new(system: S) -> Self {
        Self {
            system,
            counts: Counts::default(),
        }
    }
}

impl<S: System> System for Counting<S> {
    fn unknowns(&self) -> usize {
        self.system.unknowns()
    }

    fn residual(&mut self, z: &[f64], g: &mut [f64]) {
        self.counts.residuals += 1;
        self.system.residual(z, g);
    }

    fn linearise(&mut self, z: &[f64]) -> Result<(), Cause> {
        self.counts.linearisations += 1;
        self.system.linearise(z)
    }

    fn particular(&mut self, r: &[f64], v: &mut [f64]) {
        self.counts.solutions += 1;
        self.system.particular(r, v);
    }

    fn null_vector(&mut self, t: &mut [f64]) {
        self.system.null_vector(t);
    }

    fn groups(&self, group: &mut [usize], share: &mut [f64]) {
        self.system.groups(group, share);
    }

    fn adapted(&mut self, vectors: &mut [Vec<f64>]) -> Result<Option<Self>, Cause> {
        self.counts.vectors = self.counts.vectors.max(vectors.len());
        let counts = self.counts;
        let adapted = self.system.adapted(vectors)?;
        Ok(adapted.map(|system| Self { system, counts }))
    }
}
