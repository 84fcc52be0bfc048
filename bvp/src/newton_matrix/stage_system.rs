//! The stages of one interval: the system of the free states, and the derivative states, quadratures and followers from
//! them.
//!
//! Notation of [`condensation`](crate::condensation).

use crate::discretisation::scheme::MAX_STAGES;
use crate::discretisation::tableau::{POWERS, Tableau};
use crate::kernels::dense::add_scaled;
use crate::kernels::specialise::specialise;
use crate::newton_matrix::derivative_states::StageReduction;

/// Unit vectors.
const IDENTITY: [[f64; MAX_STAGES]; MAX_STAGES] = {
    let mut identity = [[0.0; MAX_STAGES]; MAX_STAGES];
    let mut i = 0;
    while i < MAX_STAGES {
        identity[i][i] = 1.0;
        i += 1;
    }
    identity
};

/// The equations of the stages of an interval. Where its methods are inlined, the compiler may know the
/// numbers m, n, k and f.
#[derive(Clone, Copy)]
pub(crate) struct StageSystem<'a> {
    t: &'a Tableau,
    reduction: &'a StageReduction,
    /// Stages m, states n, parameters k, free states f.
    pub(crate) m: usize,
    pub(crate) n: usize,
    pub(crate) k: usize,
    pub(crate) f: usize,
}

/// h, h², …
#[inline(always)]
fn powers_of(h: f64) -> [f64; POWERS] {
    let mut powers = [h; POWERS];
    for d in 1..POWERS {
        powers[d] = powers[d - 1] * h;
    }
    powers
}

/// A x for an m × m matrix given by its columns, so that no sum waits for another.
#[inline(always)]
fn product(columns: &[f64], m: usize, x: &[f64]) -> [f64; MAX_STAGES] {
    let mut products = [0.0; MAX_STAGES];
    for (x, column) in x[..m].iter().zip(columns[..m * m].chunks_exact(m)) {
        add_scaled(&mut products[..m], *x, column);
    }
    products
}

impl<'a> StageSystem<'a> {
    /// With m, n, k and f.
    #[inline(always)]
    pub(crate) fn new(
        t: &'a Tableau,
        reduction: &'a StageReduction,
        [m, n, k, f]: [usize; 4],
    ) -> Self {
        Self {
            t,
            reduction,
            m,
            n,
            k,
            f,
        }
    }

    /// The part of M of the free states.
    #[inline(always)]
    pub(crate) fn fill_matrix(self, h: f64, jacobians: &[f64], matrix: &mut [f64]) {
        let Self {
            t,
            reduction,
            m,
            n,
            k,
            f,
        } = self;
        let powers = powers_of(h);
        for (v, &state) in reduction.free[..f].iter().enumerate() {
            let matrix = &mut matrix[v * m * f * m..][..m * f * m];
            for (row, unit) in matrix.chunks_exact_mut(f * m).zip(&IDENTITY) {
                row.fill(0.0);
                row[v * m..][..m].copy_from_slice(&unit[..m]);
            }
            for place in 0..f {
                for &(c, order, factor) in self.members_of(place) {
                    let scale = factor * powers[order];
                    let rows = matrix.chunks_exact_mut(f * m);
                    let a = t.powers[order * m * m..][..m * m].chunks_exact(m);
                    let slopes = jacobians[..m * n * (n + k)].chunks_exact(n * (n + k));
                    for ((row, a), slopes) in rows.zip(a).zip(slopes) {
                        let slope = slopes[state * (n + k) + c];
                        add_scaled(&mut row[place * m..][..m], -slope * scale, a);
                    }
                }
            }
        }
        for &(c, place) in &reduction.followers {
            let product = self.by_leader(h, jacobians, (c, place));
            for (v, &state) in reduction.free[..f].iter().enumerate() {
                let rows = matrix[v * m * f * m..][..m * f * m].chunks_exact_mut(f * m);
                let slopes = jacobians[..m * n * (n + k)].chunks_exact(n * (n + k));
                for ((row, product), slopes) in rows.zip(&product).zip(slopes) {
                    let slope = slopes[state * (n + k) + c];
                    if slope != 0.0 {
                        add_scaled(&mut row[place * m..][..m], -slope, &product[..m]);
                    }
                }
            }
        }
    }

    /// `h² A diag(J_cs) A` for a follower c with the leader s: the changes of the follower at the stages by the slopes of its
    /// leader.
    #[inline(always)]
    fn by_leader(
        self,
        h: f64,
        jacobians: &[f64],
        follower: (usize, usize),
    ) -> [[f64; MAX_STAGES]; MAX_STAGES] {
        let (t, m) = (self.t, self.m);
        let factors = self.factors_of(jacobians, follower);
        let mut products = [[0.0; MAX_STAGES]; MAX_STAGES];
        let rows = t.a[..m * m].chunks_exact(m);
        for (product, weights) in products.iter_mut().zip(rows) {
            let terms = weights.iter().zip(&factors);
            for ((weight, factor), a) in terms.zip(t.a[..m * m].chunks_exact(m)) {
                add_scaled(&mut product[..m], weight * factor * (h * h), a);
            }
        }
        products
    }

    /// The derivatives of the right-hand side of a follower by its leader at the stages.
    #[inline(always)]
    fn factors_of(self, jacobians: &[f64], (c, place): (usize, usize)) -> [f64; MAX_STAGES] {
        let columns = self.n + self.k;
        let entry = c * columns + self.reduction.free[place];
        let mut factors = [0.0; MAX_STAGES];
        let slopes = jacobians[..self.m * self.n * columns].chunks_exact(self.n * columns);
        for (factor, slopes) in factors.iter_mut().zip(slopes) {
            *factor = slopes[entry];
        }
        factors
    }

    /// The states whose highest derivative is a given free state, with its order and their factors. These are
    /// all states if there is only one free state, no quadrature and no follower.
    #[inline(always)]
    fn members_of(&self, place: usize) -> &[(usize, usize, f64)] {
        let reduction = self.reduction;
        if self.f == 1 && reduction.quadratures.is_empty() && reduction.followers.is_empty() {
            &self.reduction.members[..self.n]
        } else {
            &self.reduction.members[self.reduction.groups[place].clone()]
        }
    }

    /// h (bᵀ ⊗ I) for the free states, n rows. A derivative state contributes through its highest derivative; in the row of
    /// a quadrature, whose part of the solution is h b, stands h b times what it takes from the free states. A follower
    /// contributes through its leader.
    #[inline(always)]
    pub(crate) fn fill_weights(self, h: f64, jacobians: &[f64], rows: &mut [f64]) {
        let Self {
            t,
            reduction,
            m,
            n,
            k,
            f,
        } = self;
        let powers = powers_of(h);
        rows.fill(0.0);
        let states = reduction.highest[..n].iter().zip(&reduction.factors);
        for (row, (&(place, order), factor)) in states.enumerate() {
            let of_free = &mut rows[(row * f + place) * m..][..m];
            let weights = &t.weights[order * m..][..m];
            add_scaled(of_free, factor * powers[order], weights);
        }
        for &q in &reduction.quadratures {
            let row = &mut rows[q * f * m..][..f * m];
            for (place, of_free) in row.chunks_exact_mut(m).enumerate() {
                for &(c, order, factor) in self.members_of(place) {
                    let scale = h * factor * powers[order];
                    let a = t.powers[order * m * m..][..m * m].chunks_exact(m);
                    let slopes = jacobians[..m * n * (n + k)].chunks_exact(n * (n + k));
                    for ((b, a), slopes) in t.b[..m].iter().zip(a).zip(slopes) {
                        add_scaled(of_free, b * slopes[q * (n + k) + c] * scale, a);
                    }
                }
            }
            for &(c, place) in &reduction.followers {
                let mut of_follower = [0.0; MAX_STAGES];
                let slopes = jacobians[..m * n * (n + k)].chunks_exact(n * (n + k));
                let a = t.a[..m * m].chunks_exact(m);
                for ((b, a), slopes) in t.b[..m].iter().zip(a).zip(slopes) {
                    let factor = h * h * b * slopes[q * (n + k) + c];
                    add_scaled(&mut of_follower[..m], factor, a);
                }
                let of_leader = &mut row[place * m..][..m];
                self.add_led(h, jacobians, (c, place), &of_follower, of_leader);
            }
        }
        for &(c, place) in &reduction.followers {
            let mut of_follower = [0.0; MAX_STAGES];
            for (of_follower, b) in of_follower.iter_mut().zip(&t.b[..m]) {
                *of_follower = h * b;
            }
            let of_leader = &mut rows[(c * f + place) * m..][..m];
            self.add_led(h, jacobians, (c, place), &of_follower, of_leader);
        }
    }

    /// Adds to the entries of a leader what those of its follower contribute, `xᵀ h diag(J_cs) A`.
    #[inline(always)]
    fn add_led(
        self,
        h: f64,
        jacobians: &[f64],
        follower: (usize, usize),
        of_follower: &[f64; MAX_STAGES],
        of_leader: &mut [f64],
    ) {
        let (t, m) = (self.t, self.m);
        let factors = self.factors_of(jacobians, follower);
        let terms = of_follower.iter().zip(&factors);
        for ((x, factor), a) in terms.zip(t.a[..m * m].chunks_exact(m)) {
            add_scaled(of_leader, x * factor * h, a);
        }
    }

    /// Xᵀ from its columns of the free states: for a derivative state c and all states d with source c
    ///
    /// ```text
    /// x_c = h b + h Aᵀ ( Σ_v diag(J_vc) x_v + Σ_d J_dc x_d )      h b only in the row of c
    /// ```
    ///
    /// with the quadratures among the v, for which x = h b in their own row and 0 in others. For a follower c it is the same;
    /// it is the source of no state.
    #[inline(always)]
    pub(crate) fn expand(self, h: f64, jacobians: &[f64], rows: &[f64], adjoint: &mut [f64]) {
        let Self {
            t,
            reduction,
            m,
            n,
            k,
            f,
        } = self;
        let slopes = || jacobians[..m * n * (n + k)].chunks_exact(n * (n + k));
        for row in 0..n {
            let x_free = &rows[row * f * m..][..f * m];
            let adjoint = &mut adjoint[row * m * n..][..m * n];
            for (x, &v) in x_free.chunks_exact(m).zip(&reduction.free) {
                for (adjoint, x) in adjoint.chunks_exact_mut(n).zip(x) {
                    adjoint[v] = *x;
                }
            }
            for &q in &reduction.quadratures {
                let own = if q == row { h } else { 0.0 };
                for (adjoint, b) in adjoint.chunks_exact_mut(n).zip(&t.b[..m]) {
                    adjoint[q] = own * b;
                }
            }
            let derived = reduction.sources.iter().rev().map(|&(c, _, _)| c);
            for c in derived.chain(reduction.followers.iter().map(|&(c, _)| c)) {
                let mut sums = [0.0; MAX_STAGES];
                let sums = &mut sums[..m];
                // In the rows of other states its entries are zero.
                for &q in reduction.quadratures.iter().filter(|&&q| q == row) {
                    let adjoint = adjoint.chunks_exact(n);
                    for ((sum, adjoint), slopes) in sums.iter_mut().zip(adjoint).zip(slopes()) {
                        *sum += slopes[q * (n + k) + c] * adjoint[q];
                    }
                }
                for (x, &v) in x_free.chunks_exact(m).zip(&reduction.free) {
                    for ((sum, x), slopes) in sums.iter_mut().zip(x).zip(slopes()) {
                        *sum += slopes[v * (n + k) + c] * x;
                    }
                }
                for &(d, source, factor) in &reduction.sources {
                    if source == c {
                        for (sum, adjoint) in sums.iter_mut().zip(adjoint.chunks_exact(n)) {
                            *sum += factor * adjoint[d];
                        }
                    }
                }
                let mut x = [0.0; MAX_STAGES];
                let x = &mut x[..m];
                if c == row {
                    x.copy_from_slice(&t.b[..m]);
                }
                for (sum, a) in sums.iter().zip(t.a[..m * m].chunks_exact(m)) {
                    add_scaled(x, *sum, a);
                }
                for (adjoint, x) in adjoint.chunks_exact_mut(n).zip(&*x) {
                    adjoint[c] = h * x;
                }
            }
        }
    }

    /// J δy + F δp − r into `stages`.
    #[inline(always)]
    pub(crate) fn apply(
        self,
        jacobians: &[f64],
        dy: &[f64],
        dp: &[f64],
        r: &[f64],
        stages: &mut [f64],
    ) {
        let Self { m, n, k, .. } = self;
        specialise!(k in [0, 1] => for i in 0..m * n {
            let row = &jacobians[i * (n + k)..][..n + k];
            let mut sum = -r[i];
            for c in 0..n {
                sum += row[c] * dy[c];
            }
            for (by_parameter, dp) in row[n..].iter().zip(dp) {
                sum += by_parameter * dp;
            }
            stages[i] = sum;
        });
    }

    /// The right-hand sides of the free states from those ρ of all states. Every derivative state c of
    /// order d has the slopes
    ///
    /// ```text
    /// K_c = T_c + C h^d A^d K_free,    T_c = ρ_c + J_cs h A T_s      without the last term if its source s is free
    /// ```
    ///
    /// with the product C of the factors from c on. T is left in the place of ρ. `known` holds h A T. A follower c has
    /// `T_c = ρ_c`.
    #[inline(always)]
    pub(crate) fn gather_free(
        self,
        h: f64,
        jacobians: &[f64],
        stages: &mut [f64],
        free: &mut [f64],
        known: &mut [f64],
    ) {
        let Self {
            reduction, m, n, f, ..
        } = self;
        let (stages, free) = (&mut stages[..m * n], &mut free[..f * m]);
        for (free, &v) in free.chunks_exact_mut(m).zip(&reduction.free) {
            for (free, stage) in free.iter_mut().zip(stages.chunks_exact(n)) {
                *free = stage[v];
            }
        }
        for &(c, source, factor) in &reduction.sources {
            let mut slopes = [0.0; MAX_STAGES];
            for (slope, stage) in slopes.iter_mut().zip(stages.chunks_exact(n)) {
                *slope = stage[c];
            }
            if reduction.highest[source].1 > 0 {
                let known = &known[source * m..][..m];
                let stages = stages.chunks_exact_mut(n);
                for ((slope, stage), known) in slopes.iter_mut().zip(stages).zip(known) {
                    *slope += factor * known;
                    stage[c] = *slope;
                }
            }
            let known = &mut known[c * m..][..m];
            self.add_known(h, jacobians, c, &slopes, free, known);
        }
        for &(c, _) in &reduction.followers {
            let mut slopes = [0.0; MAX_STAGES];
            for (slope, stage) in slopes.iter_mut().zip(stages.chunks_exact(n)) {
                *slope = stage[c];
            }
            self.add_known(h, jacobians, c, &slopes, free, &mut known[c * m..][..m]);
        }
    }

    /// Adds to the right-hand sides of the free states what the known slopes T of state c make; leaves h A T in `known`.
    #[inline(always)]
    fn add_known(
        self,
        h: f64,
        jacobians: &[f64],
        c: usize,
        slopes: &[f64; MAX_STAGES],
        free: &mut [f64],
        known: &mut [f64],
    ) {
        let Self {
            t,
            reduction,
            m,
            n,
            k,
            ..
        } = self;
        for (known, product) in known.iter_mut().zip(product(&t.columns, m, slopes)) {
            *known = h * product;
        }
        let jacobians = || jacobians[..m * n * (n + k)].chunks_exact(n * (n + k));
        for (free, &v) in free.chunks_exact_mut(m).zip(&reduction.free) {
            for ((free, known), slopes) in free.iter_mut().zip(&*known).zip(jacobians()) {
                *free += slopes[v * (n + k) + c] * known;
            }
        }
    }

    /// The slopes of all states from those of the free ones, T of the derivative states and ρ of the followers and the
    /// quadratures, for which `K_c = ρ_c + J_cs h A K_s` and `K_q = ρ_q + Σ_c J_qc h A K_c`.
    #[inline(always)]
    pub(crate) fn scatter_free(self, h: f64, jacobians: &[f64], free: &[f64], stages: &mut [f64]) {
        let Self {
            t,
            reduction,
            m,
            n,
            k,
            f,
        } = self;
        let (powers, stages) = (powers_of(h), &mut stages[..m * n]);
        for (free, &v) in free.chunks_exact(m).zip(&reduction.free[..f]) {
            for (stage, free) in stages.chunks_exact_mut(n).zip(free) {
                stage[v] = *free;
            }
        }
        for &(c, _, _) in &reduction.sources {
            let (place, order) = reduction.highest[c];
            let columns = &t.columns[(order - 1) * m * m..];
            let products = product(columns, m, &free[place * m..]);
            let factor = reduction.factors[c] * powers[order - 1];
            for (stage, product) in stages.chunks_exact_mut(n).zip(products) {
                stage[c] += factor * product;
            }
        }
        for &(c, place) in &reduction.followers {
            let products = product(&t.columns, m, &free[place * m..]);
            let factors = self.factors_of(jacobians, (c, place));
            let terms = factors.iter().zip(products);
            for (stage, (factor, product)) in stages.chunks_exact_mut(n).zip(terms) {
                stage[c] += factor * h * product;
            }
        }
        if reduction.quadratures.is_empty() {
            return;
        }
        let is_known = |c: &usize| !reduction.quadratures.contains(c);
        for c in (0..n).filter(is_known) {
            let mut slopes = [0.0; MAX_STAGES];
            for (slope, stage) in slopes.iter_mut().zip(stages.chunks_exact(n)) {
                *slope = stage[c];
            }
            let products = product(&t.columns, m, &slopes);
            let jacobians = jacobians[..m * n * (n + k)].chunks_exact(n * (n + k));
            for ((stage, product), jacobian) in
                stages.chunks_exact_mut(n).zip(products).zip(jacobians)
            {
                for &q in &reduction.quadratures {
                    stage[q] += jacobian[q * (n + k) + c] * h * product;
                }
            }
        }
    }
}
