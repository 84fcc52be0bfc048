//! Curves of branch points in two parameters.
//!
//! With a column b outside the range of J the branch points of G(x, λ; μ) = 0 at fixed μ are the
//! saddles of η on the surface G + η b = 0 (see `branch_point`). The curve of branch points solves
//!
//! ```text
//! G(z; μ) + η b = 0,   φ(z, μ) = 0,    z = (x, λ)          n + 2 equations, n + 3 unknowns
//! ```
//!
//! with φ the two η components of the null space of \[J b\]. η stays zero as long as the branch point
//! persists; where it does not, the saddle goes on with η ≠ 0 and the branches part.

use crate::corrector::Corrector;
use crate::limit_point_curve::{second_derivative, with_last};
use crate::metric::Metric;
use crate::null_space::{NullSpace, derivative, solve};
use crate::system::{Cause, System, TwoParameter};
use crate::{Difficulty, Error, Options, branch_point};

/// Step of the differences of φ along the null space, in the arclength norm.
const DIFFERENCE: f64 = 1e-3;
/// Step of forward differences, in the arclength norm.
const FORWARD: f64 = 1e-7;
/// Saddles higher than this, relative to what a unit step in the null space of \[J b\] changes, are
/// no branch points.
const PERSISTENT: f64 = 1e-8;

/// The branch points of a two-parameter system as a [`System`] with unknowns (z, η, μ): its parameter
/// is μ, and η is zero.
///
/// Branch points persist in two parameters where a symmetry or a trivial branch keeps them. Where
/// they do not, the trace ends with [`Stop::Adaptation`](crate::Stop::Adaptation).
#[derive(Clone)]
pub struct BranchPointCurve<S> {
    base: S,
    /// Evaluates away from the linearisation that `base` keeps.
    probe: S,
    corrector: Corrector,
    metric: Metric,
    column: Vec<f64>,
    /// The null space of \[J b\] to whose basis φ refers.
    reference: NullSpace,
    z: Vec<f64>,
    mu: f64,
    phi: [f64; 2],
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
    /// [`Error::NotSpecial`] where the null space cannot be had there.
    pub fn new(system: S, z: &[f64]) -> Result<Self, Error> {
        let kind = "branch point";
        let failed = |difficulty| Error::NotSpecial { kind, difficulty };
        let anywhere = Options::within(f64::NEG_INFINITY, f64::INFINITY);
        let mut metric = Metric::new(&system, &anywhere, z);
        metric.reach(&vec![0.0; z.len()]);
        let (mut probe, mut corrector) = (system.clone(), Corrector::anywhere());
        let column = branch_point::column(&mut probe, &metric, z).map_err(failed)?;
        let reference =
            NullSpace::at(&mut probe, &mut corrector, &metric, z, &column).map_err(failed)?;
        let unknowns = z.len() + 2;
        Ok(Self {
            base: system,
            probe,
            corrector,
            metric,
            column,
            reference,
            z: Vec::new(),
            mu: 0.0,
            phi: [0.0; 2],
            basis: [(); 3].map(|()| vec![0.0; unknowns]),
            slopes: [[0.0; 3]; 2],
            tangent: vec![0.0; unknowns],
        })
    }

    /// The unknowns (z, η, μ) of a branch point `z` found at the present μ of the system.
    pub fn start(&self, z: &[f64]) -> Vec<f64> {
        [z, &[0.0, self.base.second()]].concat()
    }

    /// φ away from the linearisation.
    fn phi(&mut self, z: &[f64], mu: f64) -> Result<[f64; 2], Difficulty> {
        self.probe.set_second(mu);
        let (probe, corrector) = (&mut self.probe, &mut self.corrector);
        let space = NullSpace::at(probe, corrector, &self.metric, z, &self.column)?;
        space.eta(&self.metric, &self.reference).ok_or(Difficulty::Singular)
    }

    /// φ moved from the linearisation by h times a direction (z, η, μ).
    fn phi_along(&mut self, direction: &[f64], h: f64) -> Result<[f64; 2], Difficulty> {
        let n = self.z.len();
        let z: Vec<f64> = self.z.iter().zip(direction).map(|(z, d)| z + h * d).collect();
        self.phi(&z, self.mu + h * direction[n + 1])
    }
}

impl<S: TwoParameter + Clone> System for BranchPointCurve<S> {
    fn unknowns(&self) -> usize {
        self.base.unknowns() + 2
    }

    fn residual(&mut self, z: &[f64], g: &mut [f64]) {
        let n = g.len() - 2;
        let (eta, mu) = (z[n + 1], z[n + 2]);
        self.probe.set_second(mu);
        self.probe.residual(&z[..=n], &mut g[..n]);
        g[..n].iter_mut().zip(&self.column).for_each(|(g, b)| *g += eta * b);
        let phi = self.phi(&z[..=n], mu).unwrap_or([f64::NAN; 2]);
        g[n..].copy_from_slice(&phi);
    }

    fn linearise(&mut self, z: &[f64]) -> Result<(), Cause> {
        let n = z.len() - 3;
        self.mu = z[n + 2];
        self.z.clear();
        self.z.extend_from_slice(&z[..=n]);
        let rate = second_derivative(&mut self.probe, &self.z, self.mu);
        self.base.set_second(self.mu);
        let (base, corrector) = (&mut self.base, &mut self.corrector);
        let space = NullSpace::at(base, corrector, &self.metric, &self.z, &self.column)?;
        self.phi = space.eta(&self.metric, &self.reference).ok_or(Difficulty::Singular)?;
        let mut v = vec![0.0; n + 1];
        base.particular(&rate, &mut v);
        v.iter_mut().for_each(|v| *v = -*v);
        v.push(0.0);
        space.project_out(&self.metric, &mut v);
        let norm = self.metric.norm(&v[..=n]).hypot(v[n + 1]).hypot(1.0);
        v.push(1.0);
        v.iter_mut().for_each(|v| *v /= norm);
        let [mut first, mut second] = space.0;
        first.push(0.0);
        second.push(0.0);
        self.basis = [first, second, v];
        for (j, direction) in self.basis.clone().iter().enumerate() {
            let slope = derivative(|h| self.phi_along(direction, h), DIFFERENCE)?;
            for i in 0..2 {
                self.slopes[i][j] = slope[i];
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
        self.base.particular(&r[..n], &mut v[..=n]);
        v[n + 1..].fill(0.0);
        let mut shortest = v[..n + 2].to_vec();
        let space = [0, 1].map(|i| self.basis[i][..n + 2].to_vec());
        NullSpace(space).project_out(&self.metric, &mut shortest);
        v[..n + 2].copy_from_slice(&shortest);
        let length = self.metric.norm(&v[..=n]);
        let mut right = [r[n], r[n + 1]];
        if length > 0.0 {
            let h = FORWARD / length;
            let moved = self.phi_along(v, h).unwrap_or([f64::NAN; 2]);
            for (i, right) in right.iter_mut().enumerate() {
                *right -= (moved[i] - self.phi[i]) / h;
            }
        }
        // The shortest a with D a = right: a = Dᵀ (D Dᵀ)⁻¹ right.
        let d = &self.slopes;
        let product = |i: usize, j: usize| (0..3).map(|k| d[i][k] * d[j][k]).sum::<f64>();
        let gram = [[product(0, 0), product(0, 1)], [product(1, 0), product(1, 1)]];
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
        self.base.groups(&mut group[..n], &mut share[..n]);
        let next = group[..n].iter().max().map_or(0, |last| last + 1);
        (group[n], share[n]) = (next, 1.0);
        // η is a measure of failure, not of progress.
        (group[n + 1], share[n + 1]) = (next, 0.0);
    }

    fn adapt(&mut self, z: &[f64], vectors: &mut [Vec<f64>]) -> Result<bool, Cause> {
        let n = z.len() - 3;
        if !(z[n + 1].abs() <= PERSISTENT) {
            return Err("the branch point does not persist: its branches part".into());
        }
        self.base.set_second(z[n + 2]);
        let changed = with_last(vectors, 2, |short| self.base.adapt(&z[..=n], short))?;
        let mut here = z[..=n].to_vec();
        if changed {
            here.clone_from(&vectors[0][..=n].to_vec());
            self.probe = self.base.clone();
            self.metric.regroup(&self.base);
            self.probe.set_second(z[n + 2]);
            self.column = branch_point::column(&mut self.probe, &self.metric, &here)?;
            self.tangent = vec![0.0; here.len() + 2];
        }
        self.metric.observe(&here);
        self.probe.set_second(z[n + 2]);
        let (probe, corrector) = (&mut self.probe, &mut self.corrector);
        self.reference = NullSpace::at(probe, corrector, &self.metric, &here, &self.column)?;
        Ok(changed)
    }

    fn refined(&self, vectors: &mut [Vec<f64>]) -> Option<Self> {
        let mut fine = with_last(vectors, 2, |short| self.base.refined(short))?;
        let [z @ .., _, mu] = &vectors.first()?[..] else {
            return None;
        };
        fine.set_second(*mu);
        Self::new(fine, z).ok()
    }

    fn tolerance(&self) -> f64 {
        self.base.tolerance()
    }
}

/// Σ aᵢ Tᵢ.
fn combine(basis: &[Vec<f64>; 3], a: [f64; 3]) -> Vec<f64> {
    let length = basis[0].len();
    let entry = |k: usize| (0..3).map(|i| a[i] * basis[i][k]).sum();
    (0..length).map(entry).collect()
}
