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
//! The derivatives of ψ follow from those of T, which solve linear systems with the second derivatives of
//! G along T on their right-hand sides: a point takes one factorisation per Newton step, as for the
//! branch itself. With the derivatives dᵢ of ψ along Tᵢ the tangent of the curve is −d₂ T₁ + d₁ T₂. This is regular at every
//! simple limit point, at cusps, where the tangent has neither component, and where isolas are born,
//! where \[Gₓ `G_λ`\] is singular.

use crate::difficulty::{Cause, Difficulty};
use crate::error::{Error, check_length};
use crate::special_points::null_space::NullSpace;
use crate::special_points::second_derivative::Precision;
use crate::system::system::{System, TwoParameter};
use crate::two_parameters::null_surface::NullSurface;

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
    /// The tangent planes: null spaces of \[J `G_μ`\].
    null_surface: NullSurface<S>,
    /// The tangent plane to whose basis ψ refers.
    reference: NullSpace,
    /// Direction of the curve in the plane of (λ, μ), up to its sign.
    direction: [f64; 2],
    /// Derivatives of ψ along the basis of the plane.
    slopes: [f64; 2],
}

impl<S: TwoParameter + Clone> LimitPointCurve<S> {
    /// The curve of limit points of `system` near the limit point `z` found at its present μ.
    ///
    /// # Errors
    /// [`Error::StartCount`] if `z` has the wrong length, [`Error::NotSpecial`] where the tangent
    /// plane cannot be had there.
    pub fn new(system: S, z: &[f64]) -> Result<Self, Error> {
        check_length(z, system.unknowns())?;
        let kind = "limit point";
        let null_surface = NullSurface::new(system, z, |_, _| Ok(None))
            .map_err(|difficulty| Error::NotSpecial { kind, difficulty })?;
        let reference = null_surface.space().clone();
        let direction = direction(&reference, [0.0; 2]);
        Ok(Self {
            null_surface,
            reference,
            direction,
            slopes: [0.0; 2],
        })
    }

    /// The unknowns (z, μ) of a limit point `z` found at the present μ of the system.
    pub fn start(&self, z: &[f64]) -> Vec<f64> {
        [z, &[self.base().second()]].concat()
    }

    /// The system whose limit points are followed.
    pub fn base(&self) -> &S {
        &self.null_surface.base
    }

    /// The tangent of the curve.
    fn tangent(&self) -> Vec<f64> {
        let [d1, d2] = self.slopes;
        self.null_surface.space().combine([-d2, d1])
    }
}

/// The (λ, μ) components of the vector of a tangent plane that has more of them, with the sign that
/// suits those `before`: at a limit point both have the same direction.
fn direction(plane: &NullSpace, before: [f64; 2]) -> [f64; 2] {
    let parts = [0, 1].map(|i| {
        let n = plane.0[i].len();
        [plane.0[i][n - 2], plane.0[i][n - 1]]
    });
    let [first, second] = parts.map(|[a, b]: [f64; 2]| a.hypot(b));
    let (part, length) = if first > second {
        (parts[0], first)
    } else {
        (parts[1], second)
    };
    let [a, b] = before;
    let sign = if part[0] * a + part[1] * b < 0.0 {
        -1.0
    } else {
        1.0
    };
    part.map(|x| sign * x / length)
}

impl<S: TwoParameter + Clone> System for LimitPointCurve<S> {
    fn unknowns(&self) -> usize {
        self.base().unknowns() + 1
    }

    fn residual(&mut self, z: &[f64], g: &mut [f64]) {
        let n = g.len() - 1;
        let (z, mu) = (&z[..=n], z[n + 1]);
        self.null_surface.residual(z, mu, &mut g[..n]);
        g[n] = match self.null_surface.null_space_at(z, mu).cloned() {
            Ok(plane) => plane.determinant(&self.null_surface.metric, &self.reference),
            Err(_) => f64::NAN,
        };
    }

    fn set_bounds(&mut self, bounds: [f64; 2]) {
        self.null_surface.bounds = bounds;
    }

    fn linearise(&mut self, z: &[f64]) -> Result<(), Cause> {
        let n = z.len() - 1;
        self.null_surface
            .linearise(&z[..n], z[n], &self.reference)?;
        let rates = self.null_surface.own_rates();
        let (plane, metric) = (self.null_surface.space(), &self.null_surface.metric);
        self.slopes = rates.map(|rates| plane.determinant_rate(metric, &self.reference, &rates));
        if self.slopes.iter().all(|slope| slope.is_finite()) {
            Ok(())
        } else {
            Err(Difficulty::Singular.into())
        }
    }

    fn particular(&mut self, r: &[f64], v: &mut [f64]) {
        let n = r.len() - 1;
        v.copy_from_slice(&self.null_surface.shortest(&r[..n]));
        let length = self.null_surface.metric.norm(&v[..=n]).hypot(v[n + 1]);
        let mut right = r[n];
        if length > 0.0 {
            let unit: Vec<f64> = v.iter().map(|v| v / length).collect();
            let rates = self
                .null_surface
                .rates(&unit[..=n], unit[n + 1], Precision::Rough);
            let (plane, metric) = (self.null_surface.space(), &self.null_surface.metric);
            right -= length * plane.determinant_rate(metric, &self.reference, &rates);
        }
        let [d1, d2] = self.slopes;
        let factor = right / (d1 * d1 + d2 * d2);
        let along = self
            .null_surface
            .space()
            .combine([factor * d1, factor * d2]);
        v.iter_mut().zip(along).for_each(|(v, a)| *v += a);
    }

    fn null_vector(&mut self, t: &mut [f64]) {
        t.copy_from_slice(&self.tangent());
    }

    fn groups(&self, group: &mut [usize], share: &mut [f64]) {
        let n = group.len() - 1;
        self.base().groups(&mut group[..n], &mut share[..n]);
        group[n] = group[..n].iter().max().map_or(0, |last| last + 1);
        share[n] = 1.0;
    }

    fn adapted(&mut self, vectors: &mut [Vec<f64>]) -> Result<Option<Self>, Cause> {
        if let Some(null_surface) = self.null_surface.adapted(vectors, 1, |_, _, _| Ok(None))? {
            let reference = null_surface.space().clone();
            return Ok(Some(Self {
                direction: direction(&reference, self.direction),
                null_surface,
                reference,
                slopes: self.slopes,
            }));
        }
        let z = &vectors[0];
        let n = z.len() - 1;
        let mut plane = self.null_surface.null_space_at(&z[..n], z[n])?.clone();
        plane.align(&self.null_surface.metric, &self.reference);
        self.direction = direction(&plane, self.direction);
        self.reference = plane;
        Ok(None)
    }

    fn refined(&self, vectors: &mut [Vec<f64>]) -> Option<Self> {
        let fine = self.null_surface.refined(vectors, 1)?;
        let (_, z) = vectors.first()?.split_last()?;
        let mut fine = Self::new(fine, z).ok()?;
        fine.null_surface.bounds = self.null_surface.bounds;
        Some(fine)
    }

    fn tolerance(&self) -> f64 {
        self.base().tolerance()
    }

    fn cusp_function(&self) -> Option<f64> {
        let (along, [a, b]) = (
            self.tangent(),
            direction(self.null_surface.space(), self.direction),
        );
        let n = along.len();
        let [d1, d2] = self.slopes;
        Some((along[n - 2] * a + along[n - 1] * b) / d1.hypot(d2))
    }
}
