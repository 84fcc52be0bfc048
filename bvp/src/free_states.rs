//! The stages of one interval: the system of the free states, and the chained states from them.
//!
//! Notation of [`condensation`](crate::condensation). Every function has the numbers m of stages, n of
//! states and n + k of columns of the Jacobians, which the compiler knows where it inlines them.

use crate::chains::Chains;
use crate::dense::{add_scaled, dot};
use crate::scheme::MAX_STAGES;
use crate::tableau::{POWERS, Tableau};

/// The part of M of the free states.
#[inline(always)]
pub(crate) fn fill_matrix(
    t: &Tableau,
    chains: &Chains,
    [m, n, columns]: [usize; 3],
    h: f64,
    jacobians: &[f64],
    matrix: &mut [f64],
) {
    let free_size = chains.free.len() * m;
    let mut powers = [h; POWERS];
    for d in 1..POWERS {
        powers[d] = powers[d - 1] * h;
    }
    matrix.fill(0.0);
    for (v, rows) in matrix.chunks_exact_mut(m * free_size).enumerate() {
        for (j, row) in rows.chunks_exact_mut(free_size).enumerate() {
            let jacobian_row = &jacobians[(j * n + chains.free[v]) * columns..][..n];
            for (&slope, &(end, links)) in jacobian_row.iter().zip(&chains.ends) {
                let a = &t.powers[(links * m + j) * m..][..m];
                add_scaled(&mut row[end * m..][..m], -slope * powers[links], a);
            }
            row[v * m + j] += 1.0;
        }
    }
}

/// Xᵀ from its columns of the free states: for a chained state c and all that is chained to it
///
/// ```text
/// x_c = h b + h Aᵀ ( Σ_v diag(J_vc) x_v + Σ x_chained )      h b only in the row of c
/// ```
#[inline(always)]
pub(crate) fn expand(
    t: &Tableau,
    chains: &Chains,
    [m, n, columns]: [usize; 3],
    h: f64,
    jacobians: &[f64],
    rows: &[f64],
    adjoint: &mut [f64],
) {
    let free_size = chains.free.len() * m;
    let pairs = adjoint
        .chunks_exact_mut(m * n)
        .zip(rows.chunks_exact(free_size));
    for (row, (adjoint, free)) in pairs.enumerate() {
        for (x, &v) in free.chunks_exact(m).zip(&chains.free) {
            for (j, x) in x.iter().enumerate() {
                adjoint[j * n + v] = *x;
            }
        }
        for &(c, _) in chains.chained.iter().rev() {
            let mut sums = [0.0; MAX_STAGES];
            let sums = &mut sums[..m];
            for (j, sum) in sums.iter_mut().enumerate() {
                for &v in &chains.free {
                    *sum += jacobians[(j * n + v) * columns + c] * adjoint[j * n + v];
                }
                for &(chained, _) in chains.chained.iter().filter(|(_, source)| *source == c) {
                    *sum += adjoint[j * n + chained];
                }
            }
            let mut x = [0.0; MAX_STAGES];
            let x = &mut x[..m];
            for (sum, a) in sums.iter().zip(t.a.chunks_exact(m)) {
                add_scaled(x, h * *sum, a);
            }
            if c == row {
                add_scaled(x, h, &t.b);
            }
            for (j, x) in x.iter().enumerate() {
                adjoint[j * n + c] = *x;
            }
        }
    }
}

/// J δy + F δp − r into `stages`.
#[inline(always)]
pub(crate) fn apply(
    jacobians: &[f64],
    columns: usize,
    dy: &[f64],
    dp: &[f64],
    r: &[f64],
    stages: &mut [f64],
) {
    let rows = stages.iter_mut().zip(jacobians.chunks_exact(columns));
    for ((slope, row), r) in rows.zip(r) {
        let terms = row.iter().zip(dy.iter().chain(dp));
        *slope = terms.map(|(a, x)| a * x).sum::<f64>() - r;
    }
}

/// The right-hand sides of the free states from those of all, which are those of a system where
/// every chained state c has its slopes
///
/// ```text
/// K_c = T_c + h^d A^d K_end,    T_c = ρ_c + h A T_source      without the last term if the source is free
/// ```
///
/// T is left in the place of ρ. `known` holds h A T.
#[expect(clippy::too_many_arguments, reason = "what an interval has, each once")]
#[inline(always)]
pub(crate) fn gather_free(
    t: &Tableau,
    chains: &Chains,
    [m, n, columns]: [usize; 3],
    h: f64,
    jacobians: &[f64],
    stages: &mut [f64],
    free: &mut [f64],
    known: &mut [f64],
) {
    for &(c, source) in &chains.chained {
        if chains.ends[source].1 > 0 {
            for j in 0..m {
                stages[j * n + c] += known[source * m + j];
            }
        }
        for (j, a) in t.a.chunks_exact(m).enumerate() {
            let sum: f64 = (0..m).map(|l| a[l] * stages[l * n + c]).sum();
            known[c * m + j] = h * sum;
        }
    }
    for (x, &v) in free.chunks_exact_mut(m).zip(&chains.free) {
        for (j, x) in x.iter_mut().enumerate() {
            *x = stages[j * n + v];
            for &(c, _) in &chains.chained {
                *x += jacobians[(j * n + v) * columns + c] * known[c * m + j];
            }
        }
    }
}

/// The slopes of all states from those of the free ones and T of the others.
#[inline(always)]
pub(crate) fn scatter_free(
    t: &Tableau,
    chains: &Chains,
    [m, n, _]: [usize; 3],
    h: f64,
    free: &[f64],
    stages: &mut [f64],
) {
    for (x, &v) in free.chunks_exact(m).zip(&chains.free) {
        for (j, x) in x.iter().enumerate() {
            stages[j * n + v] = *x;
        }
    }
    for &(c, _) in &chains.chained {
        let (end, links) = chains.ends[c];
        let factor = (0..links).fold(1.0, |power, _| power * h);
        let slopes = &free[end * m..][..m];
        for (j, a) in t.powers[(links - 1) * m * m..][..m * m]
            .chunks_exact(m)
            .enumerate()
        {
            stages[j * n + c] += factor * dot(a, slopes);
        }
    }
}
