//! Small systems given by closures.

use crate::difficulty::Cause;
use crate::system::closures::Closures;
use crate::system::permutation::parity;
use crate::system::system::{System, TwoParameter};
use faer::MatRef;
use faer::linalg::solvers::FullPivLu;
use std::sync::Arc;

/// Derivatives: states x, all parameters p, n × (n + parameters) derivatives of G, row-major.
type Jacobian = Arc<dyn Fn(&[f64], &[f64], &mut [f64]) + Send + Sync>;

/// Step of central differences of sixth order relative to 1 + |z|: ε^(1/7).
const DIFFERENCE: f64 = 5.8e-3;
/// The differences: (multiple of the step, weight).
const WEIGHTS: [(f64, f64); 3] = [(1.0, 45.0), (2.0, -9.0), (3.0, 1.0)];

/// A system G(x, p) = 0 of n equations given by a closure, one of whose parameters is λ.
///
/// The Jacobian is another closure, or found by central differences of sixth order, which are
/// accurate to about 1e-13 where G is smooth on the scale of one in every unknown. It is factored with
/// complete pivoting (faer), so that limit points and branch points need no care.
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
    /// The system with so many states, values of all parameters of which number `lambda` varies
    /// along branches, and `residual(x, p, g)`.
    ///
    /// # Panics
    /// If there is no parameter of that number.
    pub fn new(
        states: usize,
        parameters: &[f64],
        lambda: usize,
        residual: impl Fn(&[f64], &[f64], &mut [f64]) + Send + Sync + 'static,
    ) -> Self {
        Self {
            closures: Closures::new(states, parameters, lambda, residual),
            jacobian: None,
            matrix: vec![0.0; states * (states + 1)],
            full: vec![0.0; states * (states + parameters.len())],
            factors: None,
        }
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
    pub fn with_second(mut self, second: usize) -> Self {
        self.closures.name_second(second);
        self
    }

    /// The values of all parameters; λ is that of the last evaluation.
    pub fn parameters(&self) -> &[f64] {
        &self.closures.parameters
    }

    /// Fills `matrix` by differences.
    fn difference(&mut self, z: &[f64]) {
        let n = self.closures.states;
        let mut moved = z.to_vec();
        let (mut ahead, mut behind) = (vec![0.0; n], vec![0.0; n]);
        for j in 0..=n {
            // Where a step of the usual length leaves the domain of G, one relative to z may not.
            for h in [1.0 + z[j].abs(), z[j].abs()].map(|scale| DIFFERENCE * scale) {
                let mut column = vec![0.0; n];
                for (multiple, weight) in WEIGHTS {
                    moved[j] = z[j] + multiple * h;
                    self.residual(&moved, &mut ahead);
                    moved[j] = z[j] - multiple * h;
                    self.residual(&moved, &mut behind);
                    let pairs = ahead.iter().zip(&behind);
                    for (derivative, (ahead, behind)) in column.iter_mut().zip(pairs) {
                        *derivative += weight * (ahead - behind) / (60.0 * h);
                    }
                }
                moved[j] = z[j];
                let finite = column.iter().all(|x| x.is_finite());
                let rows = self.matrix.chunks_exact_mut(n + 1);
                for (row, derivative) in rows.zip(column) {
                    row[j] = derivative;
                }
                if finite {
                    break;
                }
            }
        }
    }
}

impl System for DenseSystem {
    fn unknowns(&self) -> usize {
        self.closures.states + 1
    }

    fn residual(&mut self, z: &[f64], g: &mut [f64]) {
        self.closures.residual(z, g);
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
