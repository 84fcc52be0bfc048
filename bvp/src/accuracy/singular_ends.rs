//! Conditions at an end where the equations are singular.
//!
//! Next to an end a of a segment with ∂f/∂y ≈ S / (s − a) the solutions of the linearised equations behave like
//! |s − a|^λ v, with the eigenvalues λ and eigenvectors v of S: F. R. de Hoog & R. Weiss, "Difference methods for
//! boundary value problems with a singularity of the first kind", SIAM J. Numer. Anal. 13 (1976) 775-813. Those
//! with Re λ > 0 vanish at a, however large they are elsewhere, so that a condition on their part of y(a) holds
//! for all of them and determines nothing: y' = k y/s has y(0) = 0 for all c sᵏ. The discretised equations do not
//! show that unless sᵏ is a polynomial. With the projector P on these solutions, conditions with the derivative C
//! by y(a) determine no more than those with C (I − P).

use crate::discretisation::iterate::Iterate;
use crate::kernels::dense::add_scaled;
use crate::newton::collocation::Collocation;
use crate::newton_matrix::dependence::Dependence;
use crate::problem::equations::Equations as _;
use crate::result::stats::Stats;
use crate::shares::{NEGLIGIBLE, SPACINGS, UNNOTICED};
use faer::Mat;
use faer::linalg::solvers::DenseSolveCore as _;

/// An end of a segment.
#[derive(Clone, Copy)]
enum Side {
    Start,
    End,
}

impl Collocation<'_> {
    /// What the conditions leave free because they are on what vanishes at a singular end, by the last
    /// linearisation, which must be at the solution `x`.
    pub(crate) fn free_at_singular_ends(&self, x: &Iterate, stats: &mut Stats) -> Dependence {
        let mut vanishing = vec![];
        let mut column = 0;
        for (index, segment) in self.equations.segments().iter().enumerate() {
            for end in [Side::Start, Side::End] {
                let singular = self
                    .looks_singular(index, end)
                    .then(|| self.residue(index, end, x, stats))
                    .flatten();
                if let Some(projector) = singular.and_then(|residue| on_growing(&residue)) {
                    vanishing.push((column, projector));
                }
                column += segment.states;
            }
        }
        match vanishing.is_empty() {
            true => Dependence::default(),
            false => self.dependence_without(&vanishing),
        }
    }

    /// Whether ∂f/∂y at the stages of the interval at this end is like the inverse of the distance from it.
    fn looks_singular(&self, index: usize, end: Side) -> bool {
        let (n, k) = (
            self.equations.segments()[index].states,
            self.equations.parameters(),
        );
        let (c, m) = (&self.tableau.c, self.tableau.stages);
        let intervals = self.mesh[index].len() - 1;
        let (interval, [near, far]) = match end {
            Side::Start => (0, [0, m - 1]),
            Side::End => (intervals - 1, [m - 1, 0]),
        };
        let distance = |stage: usize| match end {
            Side::Start => c[stage],
            Side::End => 1.0 - c[stage],
        };
        let [near, far] = [near, far].map(|stage| {
            let all = self.stages[index].jacobians();
            let rows =
                all[(interval * m + stage) * n * (n + k)..][..n * (n + k)].chunks_exact(n + k);
            let entries = rows.flat_map(|row| &row[..n]);
            distance(stage) * entries.fold(0.0, |largest: f64, x| largest.max(x.abs()))
        });
        // Beside a singular part there is a regular one; without one this would be as the distances, which for the
        // fewest stages, two, are as 0.27 to 1.
        near > 0.5 * far
    }

    /// S at an end of a segment; `None` if ∂f/∂y is not like S / (s − a).
    ///
    /// The regular part of ∂f/∂y leaves in S its change over the distance from the end, three quarters of the
    /// digits less than the interval: a defective eigenvalue of multiplicity three takes the cube root, 1e-4.
    fn residue(&self, index: usize, end: Side, x: &Iterate, stats: &mut Stats) -> Option<Mat<f64>> {
        let (n, k, m) = (
            self.equations.segments()[index].states,
            x.p.len(),
            self.tableau.stages,
        );
        let (mesh, unknowns) = (&self.mesh[index], &x.segments[index]);
        let last = mesh.len() - 1;
        let (a, h, node, stage) = match end {
            Side::Start => (mesh[0], mesh[1] - mesh[0], 0, 0),
            Side::End => (mesh[last], mesh[last - 1] - mesh[last], last, last * m - 1),
        };
        let mut at = |share: f64| {
            // A place that is off by a rounding of s has S multiplied by a number near one, and the same P.
            let off = (share * h.abs()).max(SPACINGS * f64::EPSILON * a.abs());
            let s = a + off.copysign(h);
            let mut y = unknowns.nodes[node * n..][..n].to_vec();
            add_scaled(&mut y, s - a, &unknowns.stages[stage * n..][..n]);
            let (mut f, mut jacobian) = (vec![0.0; n], vec![f64::NAN; n * (n + k)]);
            self.equations
                .rhs_jacobian(index, s, &y, &x.p, &mut f, &mut jacobian);
            stats.jacobian_evaluations += 1;
            Mat::from_fn(n, n, |i, j| (s - a) * jacobian[i * (n + k) + j])
        };
        let [before, residue] = [0.5, 0.75].map(|digits| at(f64::EPSILON.powf(digits)));
        let size = residue.norm_max();
        let is_limit = size > NEGLIGIBLE && (&residue - before).norm_max() <= UNNOTICED * size;
        is_limit.then_some(residue)
    }
}

/// The projector on the solutions that vanish at a place with the residue S, if there are any:
/// P = (I + sign(S − δ I)) / 2, the sign by Newton's iteration: N. J. Higham, *Functions of Matrices*, SIAM 2008,
/// section 5.3. `None`, too, where an eigenvalue is not told from δ.
///
/// From 1e-16 to 1 a power of s below δ, a negligible one, changes by 4 %: as far as numbers tell it is a constant.
fn on_growing(residue: &Mat<f64>) -> Option<Mat<f64>> {
    let n = residue.nrows();
    // All eigenvalues lie in Gershgorin's circles. As a rule S is diagonal with entries that are not positive.
    let rightmost = |i: usize| {
        let others = (0..n).filter(|&j| j != i).map(|j| residue[(i, j)].abs());
        residue[(i, i)] + others.sum::<f64>()
    };
    if (0..n).all(|i| rightmost(i) < NEGLIGIBLE) {
        return None;
    }
    let identity = Mat::<f64>::identity(n, n);
    let mut x = residue - &identity * faer::Scale(NEGLIGIBLE);
    // A step halves an eigenvalue, or its inverse, until it is near ±1, and then doubles its digits: no more steps
    // than a number has digits are of use.
    for _ in 0..f64::MANTISSA_DIGITS {
        let next = (&x + x.partial_piv_lu().inverse()) * faer::Scale(0.5);
        let change = (&next - &x).norm_max();
        x = next;
        if change <= f64::EPSILON.sqrt() * x.norm_max() {
            let projector = (identity + x) * faer::Scale(0.5);
            // The number of these solutions.
            let trace: f64 = (0..n).map(|i| projector[(i, i)]).sum();
            return (trace > 0.5).then_some(projector);
        }
    }
    None
}
