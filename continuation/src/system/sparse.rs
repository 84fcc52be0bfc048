//! Large systems with few entries in every row of the Jacobian, given by closures.

use crate::difficulty::Cause;
use crate::system::bordered::Bordered;
use crate::system::closures::Closures;
#[cfg(feature = "bvp")]
use crate::system::colouring::Coloured;
#[cfg(feature = "bvp")]
use crate::system::exact::Differentiable;
use crate::system::system::{System, TwoParameter};
use std::sync::Arc;

/// Entries of the Jacobian: states x, all parameters p, and what takes (row, column, value).
type Entries = Arc<
    dyn Fn(&[f64], &[f64], &mut dyn FnMut(usize, usize, f64)) -> Result<(), Cause> + Send + Sync,
>;

/// Derivative along a direction: states x, all parameters p, the rates of both, n derivatives of G.
type Along = Arc<dyn Fn([&[f64]; 2], [&[f64]; 2], &mut [f64]) + Send + Sync>;

/// The unknown that is left over is exchanged where its part of the null vector falls below this share
/// of the largest: the customary threshold of pivots, which lets errors grow by ten at most. Not the
/// part times the size of its column: in J t = 0 of one equation both parts are equal then, and nothing
/// is exchanged where the other pivot vanishes.
const THRESHOLD: f64 = 0.1;
/// The most exchanges in one linearisation: one finds the largest part. Where J has two null vectors
/// each choice may show another one; all are as good then.
const EXCHANGES: usize = 2;

/// A system G(x, p) = 0 of n equations whose Jacobian is sparse: differences and elements of
/// differential equations, networks, banded systems.
///
/// One of the parameters p is λ. The closure `entries(x, p, put)` calls `put(row, column, value)` for
/// every derivative that can be different from zero: in column j < n with respect to xⱼ, in column
/// n + i to parameter i, of which only that of λ is used. Entries named twice are added up. As long as
/// they are named in the same order, the structure is analysed once.
///
/// J is completed by one row that names an unknown which is left over, and factored by elimination with
/// row exchanges (faer). The unknown is changed along the branch, so that limit points need no care.
///
/// ```
/// use continuation::{Branch, Direction, Kind, Options, SparseSystem};
///
/// // Bratu's problem u'' + λ eᵘ = 0, u(0) = u(1) = 0 by differences at 99 places.
/// let n = 99;
/// let square = 1e-4;
/// let residual = move |u: &[f64], p: &[f64], g: &mut [f64]| {
///     for i in 0..n {
///         let left = if i > 0 { u[i - 1] } else { 0.0 };
///         let right = if i + 1 < n { u[i + 1] } else { 0.0 };
///         g[i] = left - 2.0 * u[i] + right + square * p[0] * u[i].exp();
///     }
/// };
/// let mut system = SparseSystem::new(n, &[0.0], 0, residual, move |u, p, put| {
///     for i in 0..n {
///         if i > 0 {
///             put(i, i - 1, 1.0);
///             put(i - 1, i, 1.0);
///         }
///         put(i, i, square * p[0] * u[i].exp() - 2.0);
///         put(i, n, square * u[i].exp());
///     }
/// })
/// .with_groups(&vec![0; n]);
/// let options = Options::within(0.0, 4.0);
/// let branch = Branch::new(&mut system, &vec![0.0; n + 1], Direction::Increasing, &options)?;
/// let limit = branch.filter(|point| point.kind == Kind::LimitPoint).next().expect("one");
/// assert!((limit.lambda() - 3.5138).abs() < 2e-4);
/// # Ok::<(), continuation::Error>(())
/// ```
#[derive(Clone)]
pub struct SparseSystem {
    closures: Closures,
    entries: Entries,
    along: Option<Along>,
    /// The group of every state.
    groups: Option<Vec<usize>>,
    /// The entries of J at the last linearisation, the column of λ as number n.
    listed: Vec<(usize, usize, f64)>,
    bordered: Option<Bordered>,
    /// The unknown that is left over.
    free: usize,
    null: Vec<f64>,
}

impl SparseSystem {
    /// The system with this many states, values of all parameters of which number `lambda` varies along
    /// branches, `residual(x, p, g)` and the `entries(x, p, put)` of its Jacobian.
    ///
    /// # Panics
    /// If there is no parameter of the number `lambda`.
    #[track_caller]
    pub fn new(
        states: usize,
        parameters: &[f64],
        lambda: usize,
        residual: impl Fn(&[f64], &[f64], &mut [f64]) + Send + Sync + 'static,
        entries: impl Fn(&[f64], &[f64], &mut dyn FnMut(usize, usize, f64)) + Send + Sync + 'static,
    ) -> Self {
        let entries = move |x: &[f64], p: &[f64], put: &mut dyn FnMut(usize, usize, f64)| {
            entries(x, p, put);
            Ok(())
        };
        let closures = Closures::new(states, parameters, lambda, residual);
        Self::with_entries(closures, Arc::new(entries))
    }

    fn with_entries(closures: Closures, entries: Entries) -> Self {
        let states = closures.states;
        Self {
            closures,
            entries,
            along: None,
            groups: None,
            listed: Vec::new(),
            bordered: None,
            free: states,
            null: vec![0.0; states + 1],
        }
    }

    /// The system of equations that are written once over any scalar, with exact derivatives by dual numbers.
    /// Equation i may depend on the states j of the pairs (i, j) of `pattern`, and on all parameters. States
    /// that share no equation are evaluated together, so that a banded system takes about a quarter as many
    /// evaluations as its band is wide.
    ///
    /// A linearisation fails with a cause where an equation depends on a state outside the pattern.
    ///
    /// ```
    /// use bvp::Real;
    /// use continuation::{Branch, Differentiable, Direction, Kind, Options, SparseSystem};
    ///
    /// /// Bratu's problem u'' + λ eᵘ = 0, u(0) = u(1) = 0 by differences.
    /// struct Bratu;
    ///
    /// impl Differentiable for Bratu {
    ///     fn residual<T: Real>(&self, u: &[T], p: &[T], g: &mut [T]) {
    ///         let n = u.len();
    ///         let square = ((n + 1) as f64).powi(-2);
    ///         for i in 0..n {
    ///             let left = if i > 0 { u[i - 1] } else { T::ZERO };
    ///             let right = if i + 1 < n { u[i + 1] } else { T::ZERO };
    ///             g[i] = left - u[i] * 2.0 + right + p[0] * u[i].exp() * square;
    ///         }
    ///     }
    /// }
    ///
    /// let n = 99;
    /// let band = |i: usize| (i.max(1) - 1..=(i + 1).min(n - 1)).map(move |j| (i, j));
    /// let pattern: Vec<(usize, usize)> = (0..n).flat_map(band).collect();
    /// let mut system = SparseSystem::exact(n, &[0.0], 0, &pattern, Bratu).with_groups(&vec![0; n]);
    /// let options = Options::within(0.0, 4.0);
    /// let branch = Branch::new(&mut system, &vec![0.0; n + 1], Direction::Increasing, &options)?;
    /// let limit = branch.filter(|point| point.kind == Kind::LimitPoint).next().expect("one");
    /// assert!((limit.lambda() - 3.513_647_9).abs() < 1e-7);
    /// # Ok::<(), continuation::Error>(())
    /// ```
    ///
    /// # Panics
    /// If there is no parameter of the number `lambda`, or no equation or state of a pair.
    #[cfg(feature = "bvp")]
    #[track_caller]
    pub fn exact(
        states: usize,
        parameters: &[f64],
        lambda: usize,
        pattern: &[(usize, usize)],
        equations: impl Differentiable + Send + Sync + 'static,
    ) -> Self {
        let equations = Arc::new(Coloured::new(states, pattern, lambda, equations));
        let [values, along] = [(); 2].map(|()| Arc::clone(&equations));
        let residual = move |x: &[f64], p: &[f64], g: &mut [f64]| values.residual(x, p, g);
        let closures = Closures::new(states, parameters, lambda, residual);
        let entries = move |x: &[f64], p: &[f64], put: &mut dyn FnMut(usize, usize, f64)| {
            equations.entries(x, p, put)
        };
        let mut system = Self::with_entries(closures, Arc::new(entries));
        system.along = Some(Arc::new(move |at, rates, g| {
            along.derivative_along(at, rates, g);
        }));
        system
    }

    /// Makes states with the same number in `groups` samples of one function, which count as one
    /// unknown in the arclength, all with the same share; without this each state counts for itself.
    /// Groups are numbered from 0.
    ///
    /// # Panics
    /// If there are not as many numbers as states.
    #[must_use]
    pub fn with_groups(mut self, groups: &[usize]) -> Self {
        assert_eq!(groups.len(), self.closures.states, "a group for each state");
        self.groups = Some(groups.to_vec());
        self
    }

    /// Makes parameter number `second` the μ of [`TwoParameter`], whose methods panic without it.
    ///
    /// # Panics
    /// If there is no parameter of that number.
    #[must_use]
    #[track_caller]
    pub fn with_second(mut self, second: usize) -> Self {
        self.closures.name_second(second);
        self
    }

    /// The values of all parameters; λ is that of the last evaluation.
    pub fn parameters(&self) -> &[f64] {
        &self.closures.parameters
    }

    /// Lists the entries of J at `z`; returns whether their places are those of the list before.
    fn list(&mut self, z: &[f64]) -> Result<bool, Cause> {
        let x = self.closures.read(z);
        let Closures {
            states: n, lambda, ..
        } = self.closures;
        let parameters = &self.closures.parameters;
        let (listed, mut count) = (&mut self.listed, 0);
        let (mut same, mut outside, mut finite) = (true, None, true);
        (self.entries)(x, parameters, &mut |row, column, value| {
            if row >= n || column >= n + parameters.len() {
                outside = Some((row, column));
                return;
            }
            if column >= n && column != n + lambda {
                return;
            }
            let column = column.min(n);
            finite &= value.is_finite();
            match listed.get_mut(count) {
                Some(entry) => {
                    same &= (entry.0, entry.1) == (row, column);
                    *entry = (row, column, value);
                }
                None => {
                    same = false;
                    listed.push((row, column, value));
                }
            }
            count += 1;
        })?;
        same &= count == listed.len();
        listed.truncate(count);
        if let Some((row, column)) = outside {
            return Err(format!("the jacobian has no entry ({row}, {column})").into());
        }
        if !finite {
            return Err("the jacobian is not finite".into());
        }
        Ok(same)
    }

    /// Factors the listed entries with the unknown that is left over at present, and finds the null
    /// vector.
    fn factor(&mut self) -> Result<(), Cause> {
        let bordered = match self.bordered.take() {
            Some(bordered) => bordered,
            None => Bordered::new(&self.listed, self.closures.states, self.free)
                .ok_or("there is no memory for the structure of the jacobian")?,
        };
        let bordered = self.bordered.insert(bordered);
        if !bordered.factor(&self.listed) {
            return Err("the jacobian is structurally singular".into());
        }
        bordered.null_vector(&mut self.null);
        Ok(())
    }

    /// Another unknown to be left over, if the null vector has too small a part of the present one.
    fn better_free(&self) -> Option<usize> {
        let part = |i: usize| self.null[i].abs();
        let largest = (0..self.null.len()).max_by(|&i, &j| part(i).total_cmp(&part(j)))?;
        (part(self.free) < THRESHOLD * part(largest)).then_some(largest)
    }
}

impl System for SparseSystem {
    fn unknowns(&self) -> usize {
        self.closures.states + 1
    }

    fn residual(&mut self, z: &[f64], g: &mut [f64]) {
        self.closures.residual(z, g);
    }

    fn derivative_along(&mut self, z: &[f64], d: &[f64], g: &mut [f64]) -> bool {
        let x = self.closures.read(z);
        let (n, (states, rates)) = (x.len(), self.closures.rates(d));
        let parameters = &self.closures.parameters;
        if let Some(along) = &self.along {
            g.fill(f64::NAN);
            along([x, parameters], [states, &rates], g);
            return true;
        }
        if d.len() > n + 1 && d[n + 1] != 0.0 {
            // The entries of parameters other than λ need not be given.
            return false;
        }
        g.fill(0.0);
        let listed = (self.entries)(x, parameters, &mut |row, column, value| {
            let rate = if column < n {
                states.get(column)
            } else {
                rates.get(column - n)
            };
            if let (Some(g), Some(rate)) = (g.get_mut(row), rate.filter(|rate| **rate != 0.0)) {
                *g += value * rate;
            }
        });
        listed.is_ok()
    }

    fn linearise(&mut self, z: &[f64]) -> Result<(), Cause> {
        if !self.list(z)? {
            self.bordered = None;
        }
        self.factor()?;
        for _ in 0..EXCHANGES {
            let Some(better) = self.better_free() else {
                break;
            };
            self.free = better;
            self.bordered = None;
            self.factor()?;
        }
        Ok(())
    }

    fn particular(&mut self, r: &[f64], v: &mut [f64]) {
        if let Some(bordered) = &self.bordered {
            bordered.particular(r, v);
        }
    }

    fn null_vector(&mut self, t: &mut [f64]) {
        t.copy_from_slice(&self.null);
    }

    fn groups(&self, group: &mut [usize], share: &mut [f64]) {
        let Some(groups) = &self.groups else {
            group.iter_mut().enumerate().for_each(|(i, g)| *g = i);
            return share.fill(1.0);
        };
        group.copy_from_slice(groups);
        let mut members = vec![0.0; groups.iter().max().map_or(0, |last| last + 1)];
        groups.iter().for_each(|&group| members[group] += 1.0);
        for (share, &group) in share.iter_mut().zip(groups) {
            *share = 1.0 / members[group];
        }
    }
}

impl TwoParameter for SparseSystem {
    fn second(&self) -> f64 {
        self.closures.second()
    }

    fn set_second(&mut self, value: f64) {
        self.closures.set_second(value);
    }
}
