//! The plain `f64` view of a problem that the solver works with, and its automatic provider.

use crate::{Dual, Ends, Problem, Segment};

/// A boundary value problem with first derivatives, in plain `f64`.
///
/// Three providers: every [`Problem`] (exact, by dual numbers), closures differenced by
/// [`FiniteDifferences`](crate::FiniteDifferences), or your own implementation. Compare any two
/// with [`check_jacobians`](crate::check_jacobians).
pub trait Equations {
    /// The smooth segments.
    fn segments(&self) -> &[Segment];

    /// Number k of unknown scalar parameters.
    fn parameters(&self) -> usize;

    /// Number of conditions; must equal Σ nᵢ + k.
    fn condition_count(&self) -> usize;

    /// `dy` = f(s, y, p) on `segment`; `y`, `dy` hold n numbers, `p` holds k.
    fn rhs(&self, segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]);

    /// The right-hand side and its derivatives: `jacobian` is n × (n + k), row-major, element
    /// (i, j) = ∂fᵢ/∂yⱼ for j < n and ∂fᵢ/∂pⱼ₋ₙ beyond.
    fn rhs_jacobian(
        &self,
        segment: usize,
        s: f64,
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobian: &mut [f64],
    );

    /// `r` = g(ends, p), one number per condition.
    fn conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]);

    /// The conditions at `ends` (laid out as in [`Ends`]) and their derivatives: `jacobian` has a
    /// row per condition and Σ 2nᵢ + k columns, row-major: the ends in the order of [`Ends`],
    /// then the parameters.
    fn conditions_jacobian(&self, ends: &[f64], p: &[f64], r: &mut [f64], jacobian: &mut [f64]);
}

/// Directions carried in one pass where there are more than the widest instantiated width.
const CHUNK: usize = 24;

impl<P: Problem> Equations for P {
    fn segments(&self) -> &[Segment] {
        Problem::segments(self)
    }

    fn parameters(&self) -> usize {
        Problem::parameters(self)
    }

    fn condition_count(&self) -> usize {
        Problem::condition_count(self)
    }

    fn rhs(&self, segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]) {
        Problem::rhs(self, segment, s, y, p, dy);
    }

    fn rhs_jacobian(
        &self,
        segment: usize,
        s: f64,
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobian: &mut [f64],
    ) {
        // The smallest of a few widths that carries all directions in one pass.
        match y.len() + p.len() {
            0..=2 => one_pass::<P, 2>(self, segment, s, y, p, dy, jacobian),
            3..=4 => one_pass::<P, 4>(self, segment, s, y, p, dy, jacobian),
            5..=6 => one_pass::<P, 6>(self, segment, s, y, p, dy, jacobian),
            7..=10 => one_pass::<P, 10>(self, segment, s, y, p, dy, jacobian),
            11..=16 => one_pass::<P, 16>(self, segment, s, y, p, dy, jacobian),
            17..=CHUNK => one_pass::<P, CHUNK>(self, segment, s, y, p, dy, jacobian),
            _ => {
                let rhs = |y: &[Dual<CHUNK>], p: &[Dual<CHUNK>], dy: &mut [Dual<CHUNK>]| {
                    Problem::rhs(self, segment, Dual::constant(s), y, p, dy);
                };
                in_chunks(rhs, y, p, dy, jacobian);
            }
        }
    }

    fn conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]) {
        Problem::conditions(self, at, p, r);
    }

    fn conditions_jacobian(&self, ends: &[f64], p: &[f64], r: &mut [f64], jacobian: &mut [f64]) {
        let segments = Problem::segments(self);
        let conditions = |ends: &[Dual<CHUNK>], p: &[Dual<CHUNK>], r: &mut [Dual<CHUNK>]| {
            Problem::conditions(self, Ends::new(segments, ends), p, r);
        };
        in_chunks(conditions, ends, p, r, jacobian);
    }
}

/// Value and Jacobian of the right-hand side with all n + k ≤ W directions at once, on the stack.
fn one_pass<P: Problem, const W: usize>(
    problem: &P,
    segment: usize,
    s: f64,
    y: &[f64],
    p: &[f64],
    dy: &mut [f64],
    jacobian: &mut [f64],
) {
    let (n, columns) = (y.len(), y.len() + p.len());
    let mut z = [Dual::<W>::constant(0.0); W];
    for (i, (z, &v)) in z.iter_mut().zip(y.iter().chain(p)).enumerate() {
        *z = Dual::variable(v, i);
    }
    let mut f = [Dual::<W>::constant(f64::NAN); W];
    let (zy, zp) = z[..columns].split_at(n);
    problem.rhs(segment, Dual::constant(s), zy, zp, &mut f[..n]);
    for ((f, value), row) in f.iter().zip(dy).zip(jacobian.chunks_exact_mut(columns)) {
        *value = f.value;
        row.copy_from_slice(&f.gradient[..columns]);
    }
}

/// Value and Jacobian of `function(y, p)` in passes of [`CHUNK`] directions; `value` holds the
/// result, `jacobian` is row-major with `y.len() + p.len()` columns.
fn in_chunks(
    function: impl Fn(&[Dual<CHUNK>], &[Dual<CHUNK>], &mut [Dual<CHUNK>]),
    y: &[f64],
    p: &[f64],
    value: &mut [f64],
    jacobian: &mut [f64],
) {
    let columns = y.len() + p.len();
    let mut z: Vec<Dual<CHUNK>> = y.iter().chain(p).map(|&v| Dual::constant(v)).collect();
    let mut f = vec![Dual::constant(f64::NAN); value.len()];
    for first in (0..columns.max(1)).step_by(CHUNK) {
        let width = CHUNK.min(columns - first);
        for direction in 0..width {
            z[first + direction].gradient[direction] = 1.0;
        }
        let (zy, zp) = z.split_at(y.len());
        function(zy, zp, &mut f);
        for (i, f) in f.iter().enumerate() {
            value[i] = f.value;
            let row = &mut jacobian[i * columns + first..][..width];
            row.copy_from_slice(&f.gradient[..width]);
        }
        for direction in 0..width {
            z[first + direction].gradient[direction] = 0.0;
        }
    }
}
