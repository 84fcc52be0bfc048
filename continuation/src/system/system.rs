//! What the tracer needs to know of a system.

use crate::difficulty::Cause;

/// A nonlinear system G(z) = 0 of n equations in n + 1 unknowns z = (x, λ), the parameter λ last.
///
/// With the Jacobian J = \[Gₓ `G_λ`\] (n rows, n + 1 columns) of full rank, all solutions of J z = r
/// are v + α t with one particular solution v and the null vector t. These two are all that the
/// tracer asks for, so that a system solves its equations in its own way: dense, banded, almost
/// block diagonal. Gₓ alone need not be regular.
pub trait System {
    /// Number of unknowns, n + 1.
    fn unknowns(&self) -> usize;

    /// `g` = G(z), n numbers. Where G is not defined, write NaN: the tracer then takes a shorter step.
    fn residual(&mut self, z: &[f64], g: &mut [f64]);

    /// Prepares [`particular`](Self::particular) and [`null_vector`](Self::null_vector) at `z`.
    ///
    /// A matrix that is singular to rounding is to be solved as it is, with the smallest pivots
    /// that rounding allows: it occurs at branch points.
    ///
    /// # Errors
    /// Where the Jacobian is not finite or cannot be factored at all.
    fn linearise(&mut self, z: &[f64]) -> Result<(), Cause>;

    /// Some `v` (n + 1 numbers) with J v = `r` (n numbers), J from the last linearisation.
    fn particular(&mut self, r: &[f64], v: &mut [f64]);

    /// The null vector: J `t` = 0, J from the last linearisation, of any length but with the
    /// orientation det \[J; tᵀ\] > 0 — or always < 0, as long as only
    /// [`adapted`](Self::adapted) changes that. Branch points are recognised by it.
    fn null_vector(&mut self, t: &mut [f64]);

    /// The bounds of λ, told before anything else is asked: G is not to be evaluated beyond them, not even
    /// for differences. Systems that evaluate G only where they are asked to can ignore them.
    fn set_bounds(&mut self, bounds: [f64; 2]) {
        let _ = bounds;
    }

    /// `g` = J(z) d, the exact derivative of G along the direction `d` of n + 1 numbers or, for systems
    /// with a second parameter, of n + 2, the last one the rate of μ. Returns false (the default), with
    /// nothing promised about `g`, where it is known by differences only. The last linearisation stays
    /// valid.
    ///
    /// Second derivatives of G along d are then differences of these, accurate to about 1e-12, else second
    /// differences of G, accurate to about 1e-9.
    fn derivative_along(&mut self, z: &[f64], d: &[f64], g: &mut [f64]) -> bool {
        let _ = (z, d, g);
        false
    }

    /// Which unknowns of x (n numbers each) measure the same quantity, and with what share: the
    /// shares of a group sum to one. Samples of one function form a group, with quadrature weights
    /// as shares, so that the arclength does not depend on their number; an unknown with share
    /// zero does not count. Groups are numbered from 0. By default each unknown is a group.
    fn groups(&self, group: &mut [usize], share: &mut [f64]) {
        for (i, group) in group.iter_mut().enumerate() {
            *group = i;
        }
        share.fill(1.0);
    }

    /// Called with every accepted point, the first of `vectors` (points and tangents): the same system
    /// in a discretisation that suits the point better, with `vectors` re-expressed in it, or `None`
    /// (the default) where the present one serves. The tracer corrects the point there, and returns to
    /// this system, which must stay valid, if that moves the point too far.
    ///
    /// # Errors
    /// Where the discretisation needed is out of reach: a shorter step is then tried.
    fn adapted(&mut self, vectors: &mut [Vec<f64>]) -> Result<Option<Self>, Cause>
    where
        Self: Sized,
    {
        let _ = vectors;
        Ok(None)
    }

    /// The same system discretised so much finer that the difference between both is the
    /// discretisation error; `vectors` are re-expressed on it, a point the first. `None` (the default) where there is
    /// no such error or no such system.
    fn refined(&self, vectors: &mut [Vec<f64>]) -> Option<Self>
    where
        Self: Sized,
    {
        let _ = vectors;
        None
    }

    /// The largest relative discretisation error that a labelled point may have.
    fn tolerance(&self) -> f64 {
        f64::INFINITY
    }

    /// A function of the last linearisation that is zero at a cusp: for curves of limit points.
    fn cusp_function(&self) -> Option<f64> {
        None
    }
}

/// A system with a second parameter μ, for curves of limit points and of branch points.
pub trait TwoParameter: System {
    /// The second parameter μ.
    fn second(&self) -> f64;

    /// Changes the second parameter; what was linearised is no longer valid.
    fn set_second(&mut self, value: f64);
}
