//! A family of drives whose estimated error is also that of its regularisation.

use super::family::DriveFamily;
use super::piece::WHOLE;
use bvp::Family;
use continuation::{Cause, System, TwoParameter};

/// A discretised family of drives, over one entry or over two of which the second is held.
#[derive(Clone)]
pub(super) struct Curve<'a> {
    pub(super) family: Family<'a>,
    /// The same drives with a smaller ε. A labelled point is compared with that of these drives on
    /// the halved mesh, so that its error is that of both.
    pub(super) finer: Option<&'a DriveFamily>,
}

impl Curve<'_> {
    /// The relative effect of ℓ or ε on the constants of the point `z`, where there is one: their largest
    /// change by one Newton correction towards the solution with ε/4, across the curve, as a share of
    /// 1 + |value|, and [`WHOLE`] for what is left of ε then. An estimate of its order only, since
    /// the effect is not linear; inclinations inside lock zones change by more.
    pub(super) fn smoothing_effect(&self, z: &[f64]) -> Option<f64> {
        let smaller = self.finer?;
        let mut finer = self.family.exchanged(smaller).ok()?;
        let n = z.len() - 1;
        let (mut g, mut v, mut t) = (vec![0.0; n], vec![0.0; n + 1], vec![0.0; n + 1]);
        let (mut group, mut share) = (vec![0; n], vec![0.0; n]);
        finer.groups(&mut group, &mut share);
        finer.residual(z, &mut g);
        g.iter_mut().for_each(|g| *g = -*g);
        finer.linearise(z).ok()?;
        finer.particular(&g, &mut v);
        finer.null_vector(&mut t);
        let dot = |a: &[f64], b: &[f64]| -> f64 {
            let terms = share.iter().chain([&1.0]).zip(a).zip(b);
            terms.map(|((share, a), b)| share * a * b).sum()
        };
        let along = dot(&v, &t) / dot(&t, &t);
        let constants = [z, &v, &t].map(|vector| smaller.constants(vector));
        let largest = (0..constants[0].len())
            .map(|i| {
                let [z, v, t] = constants.map(|of| of[i]);
                ((v - along * t) / (1.0 + z.abs())).abs()
            })
            .fold(0.0, f64::max);
        largest.is_finite().then_some(WHOLE * largest)
    }
}

/// The system of the family but for its refined one, which has the smaller ε, and for the tolerance:
/// the effect of ε is reported and is no reason to refine the mesh.
impl System for Curve<'_> {
    fn unknowns(&self) -> usize {
        System::unknowns(&self.family)
    }

    fn residual(&mut self, z: &[f64], g: &mut [f64]) {
        System::residual(&mut self.family, z, g);
    }

    fn linearise(&mut self, z: &[f64]) -> Result<(), Cause> {
        System::linearise(&mut self.family, z)
    }

    fn particular(&mut self, r: &[f64], v: &mut [f64]) {
        System::particular(&mut self.family, r, v);
    }

    fn null_vector(&mut self, t: &mut [f64]) {
        System::null_vector(&mut self.family, t);
    }

    fn groups(&self, group: &mut [usize], share: &mut [f64]) {
        System::groups(&self.family, group, share);
    }

    fn adapted(&mut self, vectors: &mut [Vec<f64>]) -> Result<Option<Self>, Cause> {
        let adapted = System::adapted(&mut self.family, vectors)?;
        Ok(adapted.map(|family| Self { family, ..*self }))
    }

    fn refined(&self, vectors: &mut [Vec<f64>]) -> Option<Self> {
        let halved = System::refined(&self.family, vectors)?;
        let family = match self.finer {
            Some(finer) => halved.exchanged(finer).ok()?,
            None => halved,
        };
        Some(Self { family, ..*self })
    }

    fn tolerance(&self) -> f64 {
        f64::INFINITY
    }
}

impl TwoParameter for Curve<'_> {
    fn second(&self) -> f64 {
        self.family.second()
    }

    fn set_second(&mut self, value: f64) {
        self.family.set_second(value);
    }
}
