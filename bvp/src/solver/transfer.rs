//! The collocation polynomials of a solution on another mesh.

use crate::discretisation::iterate::{Iterate, SegmentIterate};
use crate::discretisation::mesh::Mesh;
use crate::discretisation::tableau::Tableau;
use crate::kernels::dense::add_scaled;
use crate::kernels::specialise::{outlined, specialise};
use crate::result::solution::Solution;

/// The iterate with the nodes and slopes of a solution on another mesh, possibly of another scheme.
pub(crate) fn transfer(mesh: &Mesh, t: &Tableau, from: &Solution) -> Iterate {
    let mut x = Iterate::default();
    x.resize(&from.segments, mesh, t.stages, from.x.p.len());
    x.p.copy_from_slice(&from.x.p);
    let m = from.tableau.stages;
    for (index, (nodes, x)) in mesh.iter().zip(&mut x.segments).enumerate() {
        let n = from.segments[index].states;
        specialise!(n in [1, 2, 3, 4, 5, 6] => specialise!(m in [6, 7] =>
            outlined(|| transfer_segment([m, n], from, index, nodes, &t.c, x))
        ));
    }
    x
}

/// One segment with n states of a solution with m stages, in the order of its intervals.
#[inline(always)]
fn transfer_segment(
    [m, n]: [usize; 2],
    from: &Solution,
    index: usize,
    nodes: &[f64],
    c: &[f64],
    to: &mut SegmentIterate,
) {
    let x = &from.x.segments[index];
    let mut along = Along {
        tableau: &from.tableau,
        nodes: &from.mesh[index],
        x,
        interval: 0,
        powers: vec![0.0; m * n],
    };
    along.expand([m, n]);
    let states = to.nodes.chunks_exact_mut(n);
    let slopes = to.stages.chunks_exact_mut(c.len() * n);
    for ((ends, state), slopes) in nodes.windows(2).zip(states).zip(slopes) {
        along.state([m, n], ends[0], state);
        for (c, slope) in c.iter().zip(slopes.chunks_exact_mut(n)) {
            along.slope([m, n], ends[0] + c * (ends[1] - ends[0]), slope);
        }
    }
    let last = to.nodes.len() - n;
    to.nodes[last..].copy_from_slice(&x.nodes[x.nodes.len() - n..]);
}

/// A solution on a segment with n states and m stages, evaluated from left to right.
struct Along<'a> {
    tableau: &'a Tableau,
    nodes: &'a [f64],
    x: &'a SegmentIterate,
    /// The interval of the last evaluation.
    interval: usize,
    /// The coefficients of the slopes on it in powers of u, n per power; u runs from −1 at its left end to 1
    /// at its right end.
    powers: Vec<f64>,
}

impl Along<'_> {
    /// Finds the coefficients of the slopes on the current interval.
    #[inline(always)]
    fn expand(&mut self, [m, n]: [usize; 2]) {
        let stages = &self.x.stages[self.interval * m * n..][..m * n];
        let rows = self.tableau.powers_of_slope.chunks_exact(m);
        for (power, row) in self.powers.chunks_exact_mut(n).zip(rows) {
            power.fill(0.0);
            for (factor, slope) in row.iter().zip(stages.chunks_exact(n)) {
                add_scaled(power, *factor, slope);
            }
        }
    }

    /// Moves to the interval of s; returns its length and the u of s.
    #[inline(always)]
    fn go(&mut self, size: [usize; 2], s: f64) -> (f64, f64) {
        let before = self.interval;
        while self.interval + 2 < self.nodes.len() && self.nodes[self.interval + 1] <= s {
            self.interval += 1;
        }
        if self.interval != before {
            self.expand(size);
        }
        let (left, right) = (self.nodes[self.interval], self.nodes[self.interval + 1]);
        let h = right - left;
        (h, 2.0 * (s - left) / h - 1.0)
    }

    /// The slopes at s, by Horner's rule.
    #[inline(always)]
    fn slope(&mut self, size: [usize; 2], s: f64, slope: &mut [f64]) {
        let (_, u) = self.go(size, s);
        slope.fill(0.0);
        for power in self.powers.chunks_exact(size[1]).rev() {
            for (slope, power) in slope.iter_mut().zip(power) {
                *slope = *slope * u + power;
            }
        }
    }

    /// The state at s: the state at the left end of its interval plus the integral of the slopes.
    #[inline(always)]
    fn state(&mut self, size: [usize; 2], s: f64, y: &mut [f64]) {
        let (h, u) = self.go(size, s);
        let [m, n] = size;
        y.copy_from_slice(&self.x.nodes[self.interval * n..][..n]);
        let (mut ahead, mut at_start) = (1.0, 1.0);
        for (k, power) in self.powers.chunks_exact(n).take(m).enumerate() {
            ahead *= u;
            at_start = -at_start;
            add_scaled(y, 0.5 * h * (ahead - at_start) / (k + 1) as f64, power);
        }
    }
}
