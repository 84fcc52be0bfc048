//! Small systems given by closures.

use crate::difficulty::Cause;
use crate::system::closures::Closures;
use crate::system::difference::{Difference, ROUNDING, Stencil, Step};
#[cfg(feature = "bvp")]
use crate::system::exact::{Differentiable, derivative_along, derivatives};
use crate::system::permutation::parity;
use crate::system::system::{System, TwoParameter};
use faer::MatRef;
use faer::linalg::solvers::FullPivLu;
use std::sync::Arc;

/// Derivatives: states x, all parameters p, n × (n + parameters) derivatives of G, row-major.
type Jacobian = Arc<dyn Fn(&[f64], &[f64], &mut [f64]) + Send + Sync>;

/// Derivative along a direction: states x, all parameters p, the rates of both, n derivatives of G.
type Along = Arc<dyn Fn([&[f64]; 2], [&[f64]; 2], &mut [f64]) + Send + Sync>;

/// A system G(x, p) = 0 of n equations given by a closure, one of whose parameters is λ.
///
/// The Jacobian is another closure, or found by differences of sixth order with steps that resolve G, each
/// unknown for itself, within the bounds of λ: accurate to about 1e-12 where G is smooth. It is factored
/// with complete pivoting (faer), so that limit points and branch points need no care.
///
/// ```
/// use continuation::{Branch, DenseSystem, Direction, Kind, Options};
///
/// // x² + λ² = 1
/// let circle = |x: &[f64], p: &[f64], g: &mut [f64]| g[0] = x[0] * x[0] + p[0] * p[0] - 1.0;
/// let mut system = DenseSystem::new(1, &[0.0], 0, circle);
/// let mut branch =
///     Branch::new(&mut system, &[1.0, 0.0], Direction::Increasing, &Options::within(-2.0, 2.0))?;
/// let limits: Vec<f64> = branch
///     .by_ref()
///     .filter(|point| point.kind == Kind::LimitPoint)
///     .map(|point| point.lambda())
///     .collect();
/// assert!((limits[0] - 1.0).abs() < 1e-14 && (limits[1] + 1.0).abs() < 1e-14);
/// # Ok::<(), continuation::Error>(())
/// ```
#[derive(Clone)]
pub struct DenseSystem {
    closures: Closures,
    jacobian: Option<Jacobian>,
    along: Option<Along>,
    /// The steps of the differences for all unknowns, once they were tried.
    steps: Vec<Option<Step>>,
    /// J, n × (n + 1), row-major.
    matrix: Vec<f64>,
    /// Row-major derivative with respect to all unknowns and parameters, n × (n + parameters).
    full: Vec<f64>,
    factors: Option<Factors>,
}

/// J with its rows scaled, exchanged to P J Q = L \[U u\].
#[derive(Clone)]
struct Factors {
    lu: FullPivLu<f64>,
    row_scale: Vec<f64>,
    /// Sign of det \[J; eᵀ\] with e the unit vector of the column that was left.
    sign: f64,
}

impl DenseSystem {
    /// The system with this many states, values of all parameters of which number `lambda` varies
    /// along branches, and `residual(x, p, g)`.
    ///
    /// # Panics
    /// If there is no parameter of that number.
    #[track_caller]
    pub fn new(
        states: usize,
        parameters: &[f64],
        lambda: usize,
        residual: impl Fn(&[f64], &[f64], &mut [f64]) + Send + Sync + 'static,
    ) -> Self {
        Self {
            closures: Closures::new(states, parameters, lambda, residual),
            jacobian: None,
            along: None,
            steps: vec![None; states + 1],
            matrix: vec![0.0; states * (states + 1)],
            full: vec![0.0; states * (states + parameters.len())],
            factors: None,
        }
    }

    /// As [`new`](Self::new), with exact derivatives by dual numbers. Neither the units of the unknowns
    /// nor narrow features of G matter to these, as they do to differences.
    ///
    /// ```
    /// use bvp::{LeftOf, Real};
    /// use continuation::{Branch, DenseSystem, Differentiable, Direction, Kind, Options};
    ///
    /// /// Steady states of a stirred tank (Uppal, Ray & Poore 1974).
    /// struct Tank;
    ///
    /// impl Differentiable for Tank {
    ///     fn residual<T: Real>(&self, x: &[T], p: &[T], g: &mut [T])
    ///     where
    ///         f64: LeftOf<T>,
    ///     {
    ///         let rate = p[0] * (1.0 - x[0]) * x[1].exp();
    ///         g[0] = rate - x[0];
    ///         g[1] = p[1] * rate - (1.0 + p[2]) * x[1];
    ///     }
    /// }
    ///
    /// let mut tank = DenseSystem::exact(2, &[0.0, 18.0, 3.0], 0, Tank);
    /// let options = Options::within(0.0, 0.3);
    /// let branch = Branch::new(&mut tank, &[0.0; 3], Direction::Increasing, &options)?;
    /// let limits: Vec<_> = branch.filter(|point| point.kind == Kind::LimitPoint).collect();
    /// assert!((limits[0].lambda() - 0.5 * (-1.5f64).exp()).abs() < 1e-15);
    /// # Ok::<(), continuation::Error>(())
    /// ```
    ///
    /// # Panics
    /// If there is no parameter of the number `lambda`.
    #[cfg(feature = "bvp")]
    #[track_caller]
    pub fn exact(
        states: usize,
        parameters: &[f64],
        lambda: usize,
        equations: impl Differentiable + Send + Sync + 'static,
    ) -> Self {
        let equations = Arc::new(equations);
        let [values, along] = [(); 2].map(|()| Arc::clone(&equations));
        Self::new(states, parameters, lambda, move |x, p, g| {
            values.residual(x, p, g);
        })
        .with_jacobian(move |x, p, j| derivatives(&*equations, x, p, j))
        .with_derivative_along(move |at, rates, g| derivative_along(&*along, at, rates, g))
    }

    /// Takes exact derivatives from `jacobian(x, p, j)`, which writes the n × (n + parameters)
    /// derivatives of G with respect to x and p, row-major.
    #[must_use]
    pub fn with_jacobian(
        mut self,
        jacobian: impl Fn(&[f64], &[f64], &mut [f64]) + Send + Sync + 'static,
    ) -> Self {
        self.jacobian = Some(Arc::new(jacobian));
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

    /// The same with derivatives along directions by `along([x, p], [rates of x, rates of p], g)`, which
    /// must agree with the Jacobian.
    #[cfg(feature = "bvp")]
    pub(crate) fn with_derivative_along(
        mut self,
        along: impl Fn([&[f64]; 2], [&[f64]; 2], &mut [f64]) + Send + Sync + 'static,
    ) -> Self {
        self.along = Some(Arc::new(along));
        self
    }

    /// Fills `matrix` by differences, with other steps for unknowns in which G is not resolved.
    fn difference(&mut self, z: &[f64]) {
        let n = self.closures.states;
        let mut centre = vec![f64::NAN; n];
        self.residual(z, &mut centre);
        let columns: Vec<Difference> = (0..=n)
            .map(|j| {
                let step = self.steps[j].unwrap_or_default();
                self.column(z, j, step.length(z[j]), &centre)
            })
            .collect();
        // The size of an equation is the largest change that it shows.
        let largest = |i: usize| columns.iter().fold(0.0, |m: f64, c| m.max(c.terms[i]));
        let sizes: Vec<f64> = (0..n).map(largest).collect();
        let along_lambda = columns[n].values.clone();
        let range = self.closures.bounds[1] - self.closures.bounds[0];
        for (j, mut column) in columns.into_iter().enumerate() {
            let known = self.steps[j];
            let mut at = |h: f64| self.column(z, j, h, &centre);
            let expected = known
                .is_none()
                .then(|| reach(&column, &along_lambda) * range);
            if let Some(h) = expected.and_then(|reach| Step::narrow(z[j], reach)) {
                let other = at(h);
                if column.contradicts(&other, &sizes) {
                    column = other;
                }
            }
            let left = column.unresolved(&sizes, ROUNDING);
            let mut step = known.unwrap_or_default();
            if !step.serves(left) {
                (step, column) = Step::searched(column, left, &sizes, at);
            }
            self.steps[j] = Some(step);
            let rows = self.matrix.chunks_exact_mut(n + 1);
            for (row, derivative) in rows.zip(&column.values) {
                row[j] = *derivative;
            }
        }
    }

    /// The derivatives with respect to unknown j, with steps of length h.
    fn column(&mut self, z: &[f64], j: usize, h: f64, centre: &[f64]) -> Difference {
        let n = self.closures.states;
        let [low, high] = self.closures.bounds;
        let room = if j == n {
            [z[n] - low, high - z[n]]
        } else {
            [f64::INFINITY; 2]
        };
        let (stencil, h) = Stencil::first(room, h);
        let mut moved = z.to_vec();
        stencil.apply(centre, h, |change, g| {
            moved[j] = z[j] + change;
            if j == n {
                // Rounding may lead beyond.
                moved[n] = moved[n].clamp(low, high);
            }
            self.residual(&moved, g);
        })
    }
}

/// The largest change of an unknown with this column of J that a unit change of λ can be compensated by in
/// one equation.
fn reach(column: &Difference, along_lambda: &[f64]) -> f64 {
    let pairs = column.values.iter().zip(along_lambda);
    let reaches = pairs.filter(|(value, _)| **value != 0.0);
    reaches.fold(0.0, |m: f64, (value, rate)| m.max((rate / value).abs()))
}

impl System for DenseSystem {
    fn unknowns(&self) -> usize {
        self.closures.states + 1
    }

    fn residual(&mut self, z: &[f64], g: &mut [f64]) {
        self.closures.residual(z, g);
    }

    fn set_bounds(&mut self, bounds: [f64; 2]) {
        self.closures.bounds = bounds;
    }

    fn derivative_along(&mut self, z: &[f64], d: &[f64], g: &mut [f64]) -> bool {
        let x = self.closures.read(z);
        let (states, rates) = self.closures.rates(d);
        let parameters = &self.closures.parameters;
        g.fill(f64::NAN);
        if let Some(along) = &self.along {
            along([x, parameters], [states, &rates], g);
            return true;
        }
        let Some(jacobian) = &self.jacobian else {
            return false;
        };
        self.full.fill(f64::NAN);
        jacobian(x, parameters, &mut self.full);
        let columns = x.len() + rates.len();
        for (g, row) in g.iter_mut().zip(self.full.chunks_exact(columns)) {
            let terms = row.iter().zip(states.iter().chain(&rates));
            // Derivatives with respect to parameters that do not vary need not be written.
            *g = terms.filter(|(_, d)| **d != 0.0).map(|(j, d)| j * d).sum();
        }
        g.iter().all(|g| g.is_finite())
    }

    fn linearise(&mut self, z: &[f64]) -> Result<(), Cause> {
        let n = self.closures.states;
        match &self.jacobian {
            None => self.difference(z),
            Some(jacobian) => {
                let Closures { lambda, .. } = self.closures;
                let columns = n + self.closures.parameters.len();
                let x = self.closures.read(z);
                self.full.fill(f64::NAN);
                jacobian(x, &self.closures.parameters, &mut self.full);
                let rows = self.matrix.chunks_exact_mut(n + 1);
                for (row, full) in rows.zip(self.full.chunks_exact(columns)) {
                    row[..n].copy_from_slice(&full[..n]);
                    row[n] = full[n + lambda];
                }
            }
        }
        let finite = |x: &f64| x.is_finite();
        if !self.matrix.iter().all(finite) {
            return Err("the jacobian is not finite".into());
        }
        self.factors = Some(Factors::new(&self.matrix, n));
        Ok(())
    }

    fn particular(&mut self, r: &[f64], v: &mut [f64]) {
        if let Some(factors) = &self.factors {
            factors.particular(r, v);
        }
    }

    fn null_vector(&mut self, t: &mut [f64]) {
        if let Some(factors) = &self.factors {
            factors.null_vector(t);
        }
    }
}

impl TwoParameter for DenseSystem {
    fn second(&self) -> f64 {
        self.closures.second()
    }

    fn set_second(&mut self, value: f64) {
        self.closures.set_second(value);
    }
}

impl Factors {
    fn new(matrix: &[f64], n: usize) -> Self {
        let columns = n + 1;
        let mut scaled = matrix.to_vec();
        let mut row_scale = vec![1.0; n];
        for (row, scale) in scaled.chunks_exact_mut(columns).zip(&mut row_scale) {
            let largest = row.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            if largest > 0.0 {
                *scale = 1.0 / largest;
                row.iter_mut().for_each(|x| *x *= *scale);
            }
        }
        let lu = FullPivLu::new(MatRef::from_row_major_slice(&scaled, n, columns));
        let mut sign = parity(lu.P().arrays().0) * parity(lu.Q().arrays().0);
        for i in 0..n {
            sign *= pivot(&lu, i).signum();
        }
        Self {
            lu,
            row_scale,
            sign,
        }
    }

    /// Solves U x + u `free` = y in the exchanged order and puts the result in its place.
    fn back_substitute(&self, mut y: Vec<f64>, free: f64, to: &mut [f64]) {
        let (n, upper) = (y.len(), self.lu.U());
        for i in (0..n).rev() {
            let mut sum = y[i] - upper[(i, n)] * free;
            for j in i + 1..n {
                sum -= upper[(i, j)] * y[j];
            }
            y[i] = sum / pivot(&self.lu, i);
        }
        y.push(free);
        for (&place, y) in self.lu.Q().arrays().0.iter().zip(y) {
            to[place] = y;
        }
    }

    fn particular(&self, r: &[f64], v: &mut [f64]) {
        let n = r.len();
        let order = self.lu.P().arrays().0;
        let mut y: Vec<f64> = order.iter().map(|&i| r[i] * self.row_scale[i]).collect();
        let lower = self.lu.L();
        for i in 0..n {
            for j in 0..i {
                y[i] -= lower[(i, j)] * y[j];
            }
        }
        self.back_substitute(y, 0.0, v);
    }

    fn null_vector(&self, t: &mut [f64]) {
        let n = t.len() - 1;
        // det [J; tᵀ] has the sign of det [J; eᵀ] times that of the free component.
        self.back_substitute(vec![0.0; n], self.sign, t);
    }
}

/// A pivot, or what rounding makes of zero.
fn pivot(lu: &FullPivLu<f64>, i: usize) -> f64 {
    let upper = lu.U();
    let least = f64::EPSILON * f64::EPSILON.max(upper[(0, 0)].abs());
    let pivot = upper[(i, i)];
    if pivot.abs() < least {
        least.copysign(pivot)
    } else {
        pivot
    }
}
