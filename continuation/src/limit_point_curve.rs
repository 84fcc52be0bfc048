//! Curves of limit points in two parameters.
//!
//! With z = (x, λ) the solutions of G(z; μ) = 0 form a surface, whose tangent plane T is the null space
//! of \[Gₓ `G_λ` `G_μ`\]. At a limit point one of its directions has neither a λ nor a μ component: it
//! is a null vector of Gₓ. The curve of limit points is the curve of solutions of
//!
//! ```text
//! G(z; μ) = 0,   ψ(z, μ) = det ┌ T₁λ  T₂λ ┐ = 0        n + 1 equations, n + 2 unknowns
//!                              └ T₁μ  T₂μ ┘
//! ```
//!
//! With the derivatives dᵢ of ψ along Tᵢ its tangent is −d₂ T₁ + d₁ T₂. This is regular at every
//! simple limit point, at cusps, where the tangent has neither component, and where isolas are born,
//! where \[Gₓ `G_λ`\] is singular.

use crate::corrector::Corrector;
use crate::metric::Metric;
use crate::null_space::{NullSpace, derivative};
use crate::system::{Cause, System, TwoParameter};
use crate::{Difficulty, Error, Options};

/// Step of the difference for `G_μ`, relative to 1 + |μ|.
const CENTRAL: f64 = 1e-5;
/// Step of the differences of ψ along the tangent plane, in the arclength norm.
const DIFFERENCE: f64 = 1e-3;
/// Step of forward differences of ψ, in the arclength norm.
const FORWARD: f64 = 1e-7;

/// The limit points of a two-parameter system as a [`System`] with unknowns (z, μ): its parameter is
/// μ, and the λ of the limit points is the last but one unknown.
///
/// Trace it as any other: its limit points are extrema of μ, [`Kind::Cusp`](crate::Kind::Cusp) its
/// cusps.
///
/// ```
/// use continuation::{Branch, DenseSystem, Direction, Kind, LimitPointCurve, Options};
///
/// // λ + μ x − x³ = 0, from its limit point for μ = 3 at x = 1, λ = −2
/// let system = DenseSystem::new(1, &[-2.0, 3.0], 0, |x, p, g| {
///     g[0] = p[0] + p[1] * x[0] - x[0].powi(3);
/// });
/// let mut curve = LimitPointCurve::new(system.with_second(1), &[1.0, -2.0])?;
/// let start = curve.start(&[1.0, -2.0]);
/// let options = Options::within(-1.0, 4.0);
/// let branch = Branch::new(&mut curve, &start, Direction::Decreasing, &options)?;
/// let cusps: Vec<_> = branch.filter(|point| point.kind == Kind::Cusp).collect();
/// assert_eq!(cusps.len(), 1);
/// assert!(cusps[0].z.iter().all(|z| z.abs() < 1e-9));
/// # Ok::<(), continuation::Error>(())
/// ```
#[derive(Clone)]
pub struct LimitPointCurve<S> {
    base: S,
    /// Evaluates away from the linearisation that `base` keeps.
    probe: S,
    corrector: Corrector,
    metric: Metric,
    /// The tangent plane to whose basis ψ refers.
    reference: NullSpace,
    /// Direction of the curve in the plane of (λ, μ), up to its sign.
    direction: [f64; 2],
    z: Vec<f64>,
    mu: f64,
    psi: f64,
    /// The tangent plane, oriented as the reference.
    plane: NullSpace,
    /// Derivatives of ψ along its basis.
    slopes: [f64; 2],
}

impl<S: TwoParameter + Clone> LimitPointCurve<S> {
    /// The curve of limit points of `system` near the limit point `z` found at its present μ.
    ///
    /// # Errors
    /// [`Error::NotSpecial`] where the tangent plane cannot be had there.
    pub fn new(system: S, z: &[f64]) -> Result<Self, Error> {
        let anywhere = Options::within(f64::NEG_INFINITY, f64::INFINITY);
        let mut metric = Metric::new(&system, &anywhere, z);
        metric.reach(&vec![0.0; z.len()]);
        let (mut probe, mut corrector) = (system.clone(), Corrector::anywhere());
        let mu = system.second();
        let kind = "limit point";
        let plane = tangent_plane(&mut probe, &mut corrector, &metric, z, mu)
            .map_err(|difficulty| Error::NotSpecial { kind, difficulty })?;
        let mut curve = Self {
            base: system,
            probe,
            corrector,
            metric,
            reference: plane.clone(),
            direction: [0.0; 2],
            z: Vec::new(),
            mu,
            psi: 0.0,
            plane,
            slopes: [0.0; 2],
        };
        curve.direction = curve.direction();
        Ok(curve)
    }

    /// The unknowns (z, μ) of a limit point `z` found at the present μ of the system.
    pub fn start(&self, z: &[f64]) -> Vec<f64> {
        [z, &[self.base.second()]].concat()
    }

    /// The system whose limit points are followed.
    pub fn base(&self) -> &S {
        &self.base
    }

    /// ψ away from the linearisation.
    fn psi(&mut self, z: &[f64], mu: f64) -> Result<f64, Difficulty> {
        let (probe, corrector) = (&mut self.probe, &mut self.corrector);
        let plane = tangent_plane(probe, corrector, &self.metric, z, mu)?;
        Ok(plane.determinant(&self.metric, &self.reference))
    }

    /// ψ moved from the linearisation by h times a direction (z, μ).
    fn psi_along(&mut self, direction: &[f64], h: f64) -> Result<f64, Difficulty> {
        let n = self.z.len();
        let z: Vec<f64> = self.z.iter().zip(direction).map(|(z, d)| z + h * d).collect();
        self.psi(&z, self.mu + h * direction[n])
    }

    /// The (λ, μ) components of the vector of the tangent plane that has more of them: at a limit
    /// point both have the same direction.
    fn direction(&self) -> [f64; 2] {
        let n = self.plane.0[0].len();
        let parts = [0, 1].map(|i| [self.plane.0[i][n - 2], self.plane.0[i][n - 1]]);
        let [first, second] = parts.map(|[a, b]: [f64; 2]| a.hypot(b));
        let (part, length) = if first > second { (parts[0], first) } else { (parts[1], second) };
        let [a, b] = self.direction;
        let sign = if part[0] * a + part[1] * b < 0.0 { -1.0 } else { 1.0 };
        part.map(|x| sign * x / length)
    }
}

/// The tangent plane of the surface G(z; μ) = 0: the null space of \[J `G_μ`\].
fn tangent_plane<S: TwoParameter>(
    system: &mut S,
    corrector: &mut Corrector,
    metric: &Metric,
    z: &[f64],
    mu: f64,
) -> Result<NullSpace, Difficulty> {
    let column = second_derivative(system, z, mu);
    NullSpace::at(system, corrector, metric, z, &column)
}

/// `G_μ` by a central difference; leaves the system at μ.
pub(crate) fn second_derivative(system: &mut impl TwoParameter, z: &[f64], mu: f64) -> Vec<f64> {
    let h = CENTRAL * (1.0 + mu.abs());
    let mut at = |mu: f64| {
        let mut g = vec![f64::NAN; z.len() - 1];
        system.set_second(mu);
        system.residual(z, &mut g);
        g
    };
    let (ahead, behind) = (at(mu + h), at(mu - h));
    system.set_second(mu);
    let pairs = ahead.iter().zip(&behind);
    pairs.map(|(a, b)| (a - b) / (2.0 * h)).collect()
}

impl<S: TwoParameter + Clone> System for LimitPointCurve<S> {
    fn unknowns(&self) -> usize {
        self.base.unknowns() + 1
    }

    fn residual(&mut self, z: &[f64], g: &mut [f64]) {
        let n = g.len() - 1;
        let (z, mu) = (&z[..=n], z[n + 1]);
        self.probe.set_second(mu);
        self.probe.residual(z, &mut g[..n]);
        g[n] = self.psi(z, mu).unwrap_or(f64::NAN);
    }

    fn linearise(&mut self, z: &[f64]) -> Result<(), Cause> {
        let n = z.len() - 1;
        self.mu = z[n];
        self.z.clear();
        self.z.extend_from_slice(&z[..n]);
        let (base, corrector) = (&mut self.base, &mut self.corrector);
        self.plane = tangent_plane(base, corrector, &self.metric, &self.z, self.mu)?;
        self.psi = self.plane.determinant(&self.metric, &self.reference);
        self.plane.orient(&self.metric, &self.reference);
        for (i, direction) in self.plane.0.clone().iter().enumerate() {
            let along = |h: f64| self.psi_along(direction, h).map(|psi| [psi]);
            [self.slopes[i]] = derivative(along, DIFFERENCE)?;
        }
        Ok(())
    }

    fn particular(&mut self, r: &[f64], v: &mut [f64]) {
        let n = r.len() - 1;
        self.base.particular(&r[..n], &mut v[..=n]);
        v[n + 1] = 0.0;
        self.plane.project_out(&self.metric, v);
        let length = self.metric.norm(&v[..=n]).hypot(v[n + 1]);
        let mut right = r[n];
        if length > 0.0 {
            let h = FORWARD / length;
            right -= (self.psi_along(v, h).unwrap_or(f64::NAN) - self.psi) / h;
        }
        let [d1, d2] = self.slopes;
        let factor = right / (d1 * d1 + d2 * d2);
        let along = self.plane.combine([factor * d1, factor * d2]);
        v.iter_mut().zip(along).for_each(|(v, a)| *v += a);
    }

    fn null_vector(&mut self, t: &mut [f64]) {
        let [d1, d2] = self.slopes;
        t.copy_from_slice(&self.plane.combine([-d2, d1]));
    }

    fn groups(&self, group: &mut [usize], share: &mut [f64]) {
        let n = group.len() - 1;
        self.base.groups(&mut group[..n], &mut share[..n]);
        group[n] = group[..n].iter().max().map_or(0, |last| last + 1);
        share[n] = 1.0;
    }

    fn adapt(&mut self, z: &[f64], vectors: &mut [Vec<f64>]) -> Result<bool, Cause> {
        let (n, mu) = (z.len() - 1, z[z.len() - 1]);
        self.base.set_second(mu);
        let changed = with_last(vectors, 1, |short| self.base.adapt(&z[..n], short))?;
        let mut here = z[..n].to_vec();
        if changed {
            here.clone_from(&vectors[0]);
            here.pop();
            self.probe = self.base.clone();
            self.metric.regroup(&self.base);
        }
        self.metric.observe(&here);
        let (probe, corrector) = (&mut self.probe, &mut self.corrector);
        self.plane = tangent_plane(probe, corrector, &self.metric, &here, mu)?;
        if !changed {
            self.plane.orient(&self.metric, &self.reference);
        }
        self.direction = self.direction();
        self.reference = self.plane.clone();
        Ok(changed)
    }

    fn refined(&self, vectors: &mut [Vec<f64>]) -> Option<Self> {
        let mut fine = with_last(vectors, 1, |short| self.base.refined(short))?;
        let (mu, z) = vectors.first()?.split_last()?;
        fine.set_second(*mu);
        Self::new(fine, z).ok()
    }

    fn tolerance(&self) -> f64 {
        self.base.tolerance()
    }

    fn cusp_function(&self) -> Option<f64> {
        let [d1, d2] = self.slopes;
        let along = self.plane.combine([-d2, d1]);
        let n = along.len();
        let [a, b] = self.direction();
        Some((along[n - 2] * a + along[n - 1] * b) / d1.hypot(d2))
    }
}

/// Works on vectors without their last entries, which are kept.
pub(crate) fn with_last<T>(
    vectors: &mut [Vec<f64>],
    last: usize,
    work: impl FnOnce(&mut [Vec<f64>]) -> T,
) -> T {
    let split = |v: &mut Vec<f64>| v.split_off(v.len() - last);
    let tails: Vec<Vec<f64>> = vectors.iter_mut().map(split).collect();
    let result = work(vectors);
    for (vector, tail) in vectors.iter_mut().zip(tails) {
        vector.extend(tail);
    }
    result
}
