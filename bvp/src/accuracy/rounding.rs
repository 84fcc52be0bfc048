//! What rounding leaves of a solution.
//!
//! The factored Newton matrix is A + E with |E| of the order of the unit roundoff u times |A|, and a
//! product A z carries errors of the order u |A| |z|. Newton's method is iterative refinement: its
//! corrections contract by ‖(A + E)⁻¹ E‖ and end at an error of the order
//!
//! ```text
//! u ‖ |A⁻¹| |A| |z| ‖
//! ```
//!
//! (R. D. Skeel, "Iterative refinement implies numerical stability for Gaussian elimination", Math.
//! Comp. 35 (1980) 817-832; N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed.,
//! SIAM 2002, chapters 7 and 12). Where A is singular to rounding, E decides what is found, and
//! neither corrections nor residuals show it.
//!
//! Both are measured at once by a system with a known solution. With the unknowns x of the solution,
//! stage slopes included, and random signs,
//!
//! ```text
//! z = ± x,    b = A z,    v₁ = (A + E)⁻¹ b,    v₂ = v₁ − (A + E)⁻¹ (A v₁ − b)
//! ```
//!
//! A is the matrix before its stages are condensed, and the rounding that of the arithmetic itself:
//! of the products, of the stage matrices, of the elimination. v₂ − z is the error that a step of
//! refinement leaves. The signs keep it from vanishing because x is what A + E, and not A, makes of
//! the conditions. Rounding inside the right-hand side beyond that of J y is not seen.

use crate::discretisation::iterate::{Interval, Iterate, Residual, SegmentIterate};
use crate::discretisation::ratio::{Component, largest_ratio};
use crate::discretisation::tableau::Tableau;
use crate::kernels::dense::dot;
use crate::kernels::random::Signs;
use crate::kernels::specialise::{outlined, specialise};
use crate::newton::collocation::{Collocation, gather_ends};
use crate::problem::problem::Segment;
use crate::shares::{INVISIBLE, MODERATE, ONE_SAMPLE, TWO_DIGITS};

/// The unit roundoff u of double precision.
pub(crate) const UNIT_ROUNDOFF: f64 = 0.5 * f64::EPSILON;

/// Whether a solution within the tolerance by all other measures may be nothing but rounding. A rounding error
/// that is not a number exceeds everything.
///
/// With a rounding error that leaves no two digits the matrix is singular to rounding, whatever the tolerance.
/// Measured for singularly perturbed problems whose condition number exceeds 1e16: at least 0.04 over seven sets of
/// signs, while u |A⁻¹| |A| |z| alone gives 6e-7 to 9e-5. Of the reference problems none exceeds 1e-8.
///
/// The rounding measured is a sample of one set of signs. Where it shows, the amplification a times the unit
/// roundoff must be within the tolerance, too; where it does not, only slopes in thin layers are amplified, on
/// which nothing depends.
///
/// Where the true error of the reference problems is rounding, with four stages at tolerances of 1e-11 to
/// 1e-13, it is in the median 1.6 to 2.9 times what is measured, at most 55 times. At 1e-3 to 1e-9 what is
/// measured is at most 1.8 tolerances over seven sets of signs, and at most 0.02 but for one problem, the
/// spike T09c.
pub(crate) fn exceeds(rounding: f64, a: f64, tolerance: f64) -> bool {
    let allowed = (ONE_SAMPLE * tolerance).min(TWO_DIGITS);
    let agreed = rounding > INVISIBLE * tolerance && a * UNIT_ROUNDOFF > tolerance;
    rounding.is_nan() || rounding > allowed || agreed
}

impl Collocation<'_> {
    /// Whether pivots of the last factorisation are so small that rounding may matter: at 1e-9 and above the
    /// rounding of reference problems without such a pivot is at most 0.6 tolerances, and problems that must
    /// be refused have pivots below 1e-7.
    pub(crate) fn is_suspect(&self) -> bool {
        self.smallest_pivot() < 1.0 / MODERATE
    }

    /// The largest state of the solution `x`, or one: the elimination rounds relative to what is largest, as at the
    /// end of an exponential growth, beside which its start is small. As in the amplification, states that are the
    /// derivative of another one are left out.
    pub(crate) fn largest_in_all(&self, x: &Iterate) -> f64 {
        let segments = self.equations.segments().iter().zip(&x.segments);
        segments
            .enumerate()
            .fold(1.0, |largest, (index, (segment, x))| {
                let states =
                    (0..segment.states).filter(|&state| !self.stages[index].is_slope(state));
                states.fold(largest, |m: f64, state| {
                    m.max(Component::new(&x.nodes, segment.states, state).largest)
                })
            })
    }

    /// The rounding error of the solution `x`, the largest over states and parameters relative to 1 + |x|, by
    /// the factored matrix of the last linearisation, which must be near `x`.
    pub(crate) fn rounding(&mut self, x: &Iterate) -> f64 {
        let known = with_random_signs(x);
        let (mut image, mut residual) = (self.residual_buffer(), self.residual_buffer());
        self.linear_residual(&known, &mut image);
        let (mut found, mut correction) = (self.zeros(), self.zeros());
        // The residual of zero is zero.
        subtract(&mut residual, &image);
        self.correction(&residual, &mut found);
        // A second solve refines.
        self.linear_residual(&found, &mut residual);
        subtract(&mut residual, &image);
        self.correction(&residual, &mut correction);
        let refined = found.clone();
        found.set_sum(&refined, 1.0, &correction);
        correction.set_sum(&found, -1.0, &known);
        norm_by_component(self.equations.segments(), x, &correction)
    }

    /// A z by the Jacobians of the last linearisation: the [`residual`](Self::residual) with f and g
    /// replaced by J y + `F_p` p and the product of the Jacobian of the conditions with z.
    fn linear_residual(&self, z: &Iterate, image: &mut Residual) {
        let (t, k) = (&*self.tableau, z.p.len());
        let segments = self.equations.segments();
        for (index, segment) in segments.iter().enumerate() {
            let (m, n) = (t.stages, segment.states);
            let jacobians = self.stages[index].jacobians();
            let (mesh, z) = (&self.mesh[index], (&z.segments[index], &z.p[..]));
            let image = &mut image.equations[index];
            specialise!(n in [1, 2, 3, 4, 5, 6] => specialise!(m in [6, 7] => specialise!(k in [0] =>
                outlined(|| linear_residuals([m, n, k], t, mesh, jacobians, z, image)))));
        }
        let states: usize = segments.iter().map(|segment| segment.states).sum();
        let mut unknowns = vec![0.0; 2 * states];
        gather_ends(segments, z, &mut unknowns);
        unknowns.extend(&z.p);
        let rows = self.conditions_jacobian.chunks_exact(unknowns.len());
        for (r, row) in image.conditions.iter_mut().zip(rows) {
            *r = dot(row, &unknowns);
        }
    }
}

/// The part of A z of one segment with these Jacobians at its stages, with m stages, n states and k parameters.
#[inline(always)]
fn linear_residuals(
    [m, n, k]: [usize; 3],
    t: &Tableau,
    mesh: &[f64],
    jacobians: &[f64],
    (z, p): (&SegmentIterate, &[f64]),
    image: &mut SegmentIterate,
) {
    let mut y = vec![0.0; n];
    let (y, a) = (&mut y[..n], &t.a[..m * m]);
    let images = image.stages.chunks_exact_mut(m * n);
    let images = images.zip(image.nodes[n..].chunks_exact_mut(n));
    let jacobians = jacobians.chunks_exact(m * n * (n + k));
    let pairs = mesh.windows(2).enumerate();
    for (((i, pair), (stages, continuity)), jacobians) in pairs.zip(images).zip(jacobians) {
        let interval = Interval::new(z, [m, n], i, pair);
        let rows = jacobians.chunks_exact(n * (n + k));
        for ((j, r), rows) in stages.chunks_exact_mut(n).enumerate().zip(rows) {
            interval.state(&a[j * m..][..m], y);
            let slopes = interval.stage_slope(j);
            for ((r, slope), row) in r.iter_mut().zip(slopes).zip(rows.chunks_exact(n + k)) {
                *r = slope - dot(&row[..n], y) - dot(&row[n..], p);
            }
        }
        interval.continuity(t, continuity);
    }
}

/// The largest entry of a correction relative to 1 + |x|, and to a share of the largest |x| of its component
/// on the segment: where a state is far smaller than elsewhere, rounding elsewhere is what counts.
fn norm_by_component(segments: &[Segment], x: &Iterate, correction: &Iterate) -> f64 {
    let of_state = |y: &Component<'_>, i| 1.0 + TWO_DIGITS * y.largest + y.at(i).abs();
    largest_ratio(segments, x, correction, of_state, |p| 1.0 + p.abs())
}

/// x with random signs.
fn with_random_signs(x: &Iterate) -> Iterate {
    let mut signs = Signs::default();
    let mut z = x.clone();
    let mut turn = |x: &mut f64| *x = signs.turn(*x);
    for segment in &mut z.segments {
        segment.nodes.iter_mut().for_each(&mut turn);
        segment.stages.iter_mut().for_each(&mut turn);
    }
    z.p.iter_mut().for_each(turn);
    z
}

/// r −= b.
fn subtract(r: &mut Residual, b: &Residual) {
    let less = |r: &mut [f64], b: &[f64]| r.iter_mut().zip(b).for_each(|(r, b)| *r -= b);
    for (r, b) in r.equations.iter_mut().zip(&b.equations) {
        less(&mut r.nodes, &b.nodes);
        less(&mut r.stages, &b.stages);
    }
    less(&mut r.conditions, &b.conditions);
}
