//! Curves of branch points in two parameters.
//!
//! With a bordering vector b outside the range of J the branch points of G(x, λ; μ) = 0 at fixed μ are the
//! saddles of η on the solutions of the unfolded system G + η b = 0 (see `branch_point`). The curve of branch points solves
//!
//! ```text
//! G(z; μ) + η b = 0,   φ(z, μ) = 0,    z = (x, λ)          n + 2 equations, n + 3 unknowns
//! ```
//!
//! with φ the two η components of the null space of \[J b\]. η stays zero as long as the branch point
//! persists; where it does not, the saddle goes on with η ≠ 0 and the branches part.

use crate::curve::curve::Curve;
use crate::curve::metric::Metric;
use crate::difficulty::{Cause, Difficulty};
use crate::error::{Error, check_length};
use crate::special_points::branch_point::bordering_vector;
use crate::special_points::null_space::{NullSpace, solve};
use crate::special_points::second_derivative::Precision;
use crate::system::system::{System, TwoParameter};
use crate::two_parameters::null_surface::NullSurface;

/// Saddles with η larger than this, relative to what a unit step in the null space of \[J b\] changes, are
/// no branch points.
const PERSISTENT: f64 = 1e-8;

/// The branch points of a two-parameter system as a [`System`] with unknowns (z, η, μ): its parameter
/// is μ, and η is zero.
///
/// Branch points persist in two parameters where a symmetry or a trivial branch keeps them. Where
/// they do not, the trace ends with [`Difficulty::Adaptation`].
#[derive(Clone)]
pub struct BranchPointCurve<S> {
    /// The null spaces of \[J b\].
    null_surface: NullSurface<S>,
    /// The one to whose basis φ refers.
    reference: NullSpace,
    /// Three vectors (z, η, μ) that span the null space of \[J b `G_μ`\].
    basis: [Vec<f64>; 3],
    /// Derivatives of φ along them.
    slopes: [[f64; 3]; 2],
    /// Keeps the orientation of the tangent.
    tangent: Vec<f64>,
}

impl<S: TwoParameter + Clone> BranchPointCurve<S> {
    /// The curve of branch points of `system` near the branch point `z` found at its present μ.
    ///
    /// # Errors
    /// [`Error::StartCount`] if `z` has the wrong length, [`Error::NotSpecial`] where the null space
    /// cannot be had there.
    pub fn new(system: S, z: &[f64]) -> Result<Self, Error> {
        let unknowns = system.unknowns();
        check_length(z, unknowns)?;
        let kind = "branch point";
        let border = |system: &mut S, metric: &Metric| bordered(system, metric, z);
        let null_surface = NullSurface::new(system, z, border)
            .map_err(|difficulty| Error::NotSpecial { kind, difficulty })?;
        Ok(Self {
            reference: null_surface.space().clone(),
            null_surface,
            basis: [(); 3].map(|()| vec![0.0; unknowns + 2]),
            slopes: [[0.0; 3]; 2],
            tangent: vec![0.0; unknowns + 2],
        })
    }

    /// The unknowns (z, η, μ) of a branch point `z` found at the present μ of the system.
    pub fn start(&self, z: &[f64]) -> Vec<f64> {
        [z, &[0.0, self.base().second()]].concat()
    }

    /// The system whose branch points are followed.
    pub fn base(&self) -> &S {
        &self.null_surface.base
    }

    /// The derivative of φ, where both basis vectors of the null space change at these `rates`.
    fn slope(&self, rates: &[Vec<f64>; 2]) -> Option<[f64; 2]> {
        let (space, metric) = (self.null_surface.space(), &self.null_surface.metric);
        space.eta_rate(metric, &self.reference, rates)
    }
}

impl<S: TwoParameter + Clone> System for BranchPointCurve<S> {
    fn unknowns(&self) -> usize {
        self.base().unknowns() + 2
    }

    fn residual(&mut self, z: &[f64], g: &mut [f64]) {
        let n = g.len() - 2;
        let (eta, mu) = (z[n + 1], z[n + 2]);
        self.null_surface.residual(&z[..=n], mu, &mut g[..n]);
        let border = self.null_surface.border().iter();
        g[..n]
            .iter_mut()
            .zip(border)
            .for_each(|(g, b)| *g += eta * b);
        let space = self.null_surface.null_space_at(&z[..=n], mu).cloned().ok();
        let phi = space.and_then(|space| space.eta(&self.null_surface.metric, &self.reference));
        g[n..].copy_from_slice(&phi.unwrap_or([f64::NAN; 2]));
    }

    fn set_bounds(&mut self, bounds: [f64; 2]) {
        self.null_surface.bounds = bounds;
    }

    fn linearise(&mut self, z: &[f64]) -> Result<(), Cause> {
        let n = z.len() - 3;
        self.null_surface
            .linearise(&z[..=n], z[n + 2], &self.reference)?;
        let [mut first, mut second] = self.null_surface.space().0.clone();
        first.push(0.0);
        second.push(0.0);
        // The third one is the direction with μ, orthogonal to both.
        let rate = self.null_surface.mu_derivative();
        let mut third: Vec<f64> = self
            .null_surface
            .shortest(&rate)
            .iter()
            .map(|v| -v)
            .collect();
        let norm = self
            .null_surface
            .metric
            .norm(&third[..=n])
            .hypot(third[n + 1])
            .hypot(1.0);
        third.push(1.0);
        third.iter_mut().for_each(|v| *v /= norm);
        let [along_first, along_second] = self.null_surface.own_rates();
        let along_third = self
            .null_surface
            .rates(&third[..=n], third[n + 2], Precision::Fine);
        self.basis = [first, second, third];
        for (j, rates) in [along_first, along_second, along_third].iter().enumerate() {
            let slope = self.slope(rates).ok_or(Difficulty::Singular)?;
            for (slopes, slope) in self.slopes.iter_mut().zip(slope) {
                slopes[j] = slope;
            }
        }
        let [a, b] = &self.slopes;
        let cross = [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ];
        let tangent = combine(&self.basis, cross);
        let product: f64 = tangent.iter().zip(&self.tangent).map(|(a, b)| a * b).sum();
        let sign = if product < 0.0 { -1.0 } else { 1.0 };
        self.tangent = tangent.iter().map(|t| sign * t).collect();
        Ok(())
    }

    fn particular(&mut self, r: &[f64], v: &mut [f64]) {
        let n = r.len() - 2;
        v[..n + 2].copy_from_slice(&self.null_surface.shortest(&r[..n]));
        v[n + 2] = 0.0;
        let length = self.null_surface.metric.norm(&v[..=n]);
        let mut right = [r[n], r[n + 1]];
        if length > 0.0 {
            let unit: Vec<f64> = v[..=n].iter().map(|v| v / length).collect();
            let rates = self.null_surface.rates(&unit, 0.0, Precision::Rough);
            let slope = self.slope(&rates).unwrap_or([f64::NAN; 2]);
            right
                .iter_mut()
                .zip(slope)
                .for_each(|(r, slope)| *r -= length * slope);
        }
        // The shortest a with D a = right: a = Dᵀ (D Dᵀ)⁻¹ right.
        let d = &self.slopes;
        let product = |i: usize, j: usize| (0..3).map(|k| d[i][k] * d[j][k]).sum::<f64>();
        let gram = [
            [product(0, 0), product(0, 1)],
            [product(1, 0), product(1, 1)],
        ];
        let b = solve(gram, right).unwrap_or([f64::NAN; 2]);
        let a = [0, 1, 2].map(|k| d[0][k] * b[0] + d[1][k] * b[1]);
        let along = combine(&self.basis, a);
        v.iter_mut().zip(along).for_each(|(v, a)| *v += a);
    }

    fn null_vector(&mut self, t: &mut [f64]) {
        t.copy_from_slice(&self.tangent);
    }

    fn groups(&self, group: &mut [usize], share: &mut [f64]) {
        let n = group.len() - 2;
        self.base().groups(&mut group[..n], &mut share[..n]);
        let next = group[..n].iter().max().map_or(0, |last| last + 1);
        (group[n], share[n]) = (next, 1.0);
        // η is a measure of failure, not of progress.
        (group[n + 1], share[n + 1]) = (next, 0.0);
    }

    fn adapted(&mut self, vectors: &mut [Vec<f64>]) -> Result<Option<Self>, Cause> {
        let n = vectors[0].len() - 3;
        if vectors[0][n + 1].abs() > PERSISTENT {
            return Err("the branch point does not persist: its branches part".into());
        }
        let border = |system: &mut S, metric: &Metric, z: &[f64]| bordered(system, metric, z);
        if let Some(null_surface) = self.null_surface.adapted(vectors, 2, border)? {
            let unknowns = null_surface.base.unknowns() + 2;
            return Ok(Some(Self {
                reference: null_surface.space().clone(),
                null_surface,
                basis: [(); 3].map(|()| vec![0.0; unknowns]),
                slopes: self.slopes,
                tangent: vec![0.0; unknowns],
            }));
        }
        let z = &vectors[0];
        let mut space = self.null_surface.null_space_at(&z[..=n], z[n + 2])?.clone();
        space.align(&self.null_surface.metric, &self.reference);
        self.reference = space;
        Ok(None)
    }

    fn refined(&self, vectors: &mut [Vec<f64>]) -> Option<Self> {
        let fine = self.null_surface.refined(vectors, 2)?;
        let [z @ .., _, _] = &vectors.first()?[..] else {
            return None;
        };
        let mut fine = Self::new(fine, z).ok()?;
        fine.null_surface.bounds = self.null_surface.bounds;
        Some(fine)
    }

    fn tolerance(&self) -> f64 {
        self.base().tolerance()
    }
}

/// A bordering vector for the system at `z`.
fn bordered<S: System>(
    system: &mut S,
    metric: &Metric,
    z: &[f64],
) -> Result<Option<Vec<f64>>, Difficulty> {
    let anywhere = [f64::NEG_INFINITY, f64::INFINITY];
    bordering_vector(&mut Curve::new(system, metric.clone(), anywhere), z).map(Some)
}

/// Σ aᵢ Tᵢ.
fn combine(basis: &[Vec<f64>; 3], a: [f64; 3]) -> Vec<f64> {
    let length = basis[0].len();
    let entry = |k: usize| (0..3).map(|i| a[i] * basis[i][k]).sum();
    (0..length).map(entry).collect()
}
