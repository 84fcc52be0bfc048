//! Whether a solution is the only one near it, as far as the discretised problem can tell.
//!
//! The inverse of the Newton matrix A takes forcings r of the size of the solution, with random signs, to
//!
//! ```text
//! v = A⁻¹ r,    a = max |v| / |x| over all nodes and parameters
//! ```
//!
//! Where the amplification a is large, z = v / a is nearly a null vector, A z = r / a. The solution S has
//! the estimated error e, so that S + e is nearer to the exact one; of the differential equations
//! linearised there z has the defect `d = z' − J(S + e) z − F_p p − r / a`, and by defect correction
//! ([`global_error`](crate::accuracy::global_error)) the size of A⁻¹ d is the relative change of the
//! smallest singular value from the discretised problem to the exact one. Where it is of the order of one,
//! the matrix is regular only by its discretisation: the solution belongs to a family, or is as good as
//! one, and z is the direction of the family.
//!
//! The amplification is a lower bound of ‖A⁻¹‖ by one solve, with random signs: N. J. Higham, *Accuracy
//! and Stability of Numerical Algorithms*, 2nd ed., SIAM 2002, chapter 15.

use crate::accuracy::global_error::subtract_sum;
use crate::discretisation::iterate::{Interval, Iterate, Residual};
use crate::kernels::dense::{add_scaled, dot, max_or_nan};
use crate::kernels::random::Signs;
use crate::newton::collocation::{Collocation, gather_ends};
use crate::problem::equations::Equations as _;
use crate::problem::problem::Segment;
use crate::problem::unknown::Unknown;
use crate::result::quality::{Direction, Samples};
use crate::result::stats::Stats;

/// Whether an amplification asks for a closer look at a solution with this error.
pub(crate) fn is_amplified(a: f64, error: f64) -> bool {
    a.is_nan() || a * error.max(COARSE) >= AMPLIFIED
}

/// Whether an amplification is so high that it must show on a finer mesh, too: what a mesh is too coarse for
/// can end an exponential growth beyond it.
pub(crate) fn is_high(a: f64) -> bool {
    a.is_nan() || a >= HIGH
}

/// Whether an amplification is the same on a mesh of halved intervals.
pub(crate) fn is_steady(a: f64, halved: f64) -> bool {
    halved < STEADY * a
}

/// Whether a matrix with this amplification is as good as singular.
pub(crate) fn is_open(a: f64) -> bool {
    a.is_nan() || a >= OPEN
}

/// An amplification that a mesh of six or seven stages resolves hardly changes; eight digits are half of
/// all.
const HIGH: f64 = 1e8;
/// It may grow by this factor, since it is found by other signs on other intervals.
const STEADY: f64 = 10.0;
/// From this amplification on a matrix may be singular to rounding: it leaves five digits, and is a lower
/// bound.
const OPEN: f64 = 1e11;
/// Below this amplification times the error of a solution its Newton matrix is regular in all of the
/// solutions that the error allows.
const AMPLIFIED: f64 = 0.03;
/// However small the error is, a mesh that need not resolve a solution as simple as zero may resolve
/// directions beside it no better than this.
const COARSE: f64 = 1e-5;
/// With a change of the smallest singular value beyond this the exact problem may be singular.
const SINGULAR: f64 = 0.1;
/// A state that is nowhere larger is rounding beside the smallest tolerance, 1e-13.
const NOTHING: f64 = 1e-14;
/// |cos| of the angle to a shift of s, from which on the direction of a family is called one.
const PARALLEL: f64 = 0.99;
/// The conditions do not feel a direction whose share at the ends is smaller than this: it is that of a
/// layer inside, which they hardly reach.
const FELT: f64 = 1e-3;

impl Collocation<'_> {
    /// The amplification a of forcings with random signs by the last linearisation, which must be at `x`;
    /// leaves v in `v`.
    pub(crate) fn amplification(
        &mut self,
        x: &Iterate,
        residual: &mut Residual,
        v: &mut Iterate,
    ) -> f64 {
        let mut signs = Signs::default();
        let m = self.tableau.stages;
        for (index, r) in residual.equations.iter_mut().enumerate() {
            let n = self.equations.segments()[index].states;
            let nodes = &self.mesh[index];
            let length = nodes[nodes.len() - 1] - nodes[0];
            r.nodes.fill(0.0);
            let y = &x.segments[index].nodes;
            for component in 0..n {
                let vanishes = largest_state(y, n, component) <= NOTHING;
                let states = y.iter().skip(component).step_by(n);
                for (stages, y) in r.stages.chunks_exact_mut(m * n).zip(states) {
                    let size = if vanishes { 1.0 } else { y.abs() };
                    let forcing = signs.turn(size / length);
                    let of_component = stages.iter_mut().skip(component).step_by(n);
                    of_component.for_each(|r| *r = forcing);
                }
            }
        }
        let scales = self.condition_scales(x);
        for (r, scale) in residual.conditions.iter_mut().zip(scales) {
            *r = signs.turn(scale);
        }
        self.correction(residual, v);
        self.local_size(x, v)
    }

    /// The largest entry of a correction relative to the states at its node and the two beside it, or to one
    /// unit or the largest state, whichever is smaller, where they are less: forcings of the size of a
    /// solution make changes of its size, wherever it is large or small, unless they are amplified.
    ///
    /// States that are the derivative of another one are left out: in a layer that the mesh does not
    /// resolve, and nothing depends on, they are as large as it is thin.
    fn local_size(&self, x: &Iterate, correction: &Iterate) -> f64 {
        let segments = self.equations.segments();
        largest_ratio(segments, x, correction, |index, nodes, n, component| {
            if self.stages[index].is_slope(component) {
                return vec![f64::INFINITY; nodes.len() / n];
            }
            let floor = unit(largest_state(nodes, n, component)).min(1.0);
            let states: Vec<f64> = nodes.iter().skip(component).step_by(n).copied().collect();
            let around = |i: usize| &states[i.saturating_sub(1)..(i + 2).min(states.len())];
            let size = |i: usize| around(i).iter().fold(floor, |m: f64, y| m.max(y.abs()));
            (0..states.len()).map(size).collect()
        })
    }

    /// The units of the states at all ends, in the order of [`Ends`](crate::Ends), and of the parameters.
    fn units(&self, x: &Iterate) -> Vec<f64> {
        let mut sizes = vec![];
        for (segment, x) in self.equations.segments().iter().zip(&x.segments) {
            let n = segment.states;
            let of_end = (0..n).map(|component| unit(largest_state(&x.nodes, n, component)));
            let of_end: Vec<f64> = of_end.collect();
            sizes.extend_from_slice(&of_end);
            sizes.extend(of_end);
        }
        sizes.extend(x.p.iter().map(|p| unit(p.abs())));
        sizes
    }

    /// The direction in which the solution `x` with the error of [`global_errors`](Self::global_errors),
    /// left in `w`, is not isolated, if so; `v` and `a` are those of
    /// [`amplification`](Self::amplification). Writes `residual`.
    pub(crate) fn direction(
        &mut self,
        x: &Iterate,
        (samples, w): (&Samples, &Iterate),
        (v, a): (&Iterate, f64),
        residual: &mut Residual,
        stats: &mut Stats,
    ) -> Option<Direction> {
        let mut z = self.zeros();
        z.set_sum(&z.clone(), 1.0 / a, v);
        let samples = self.linear_defects(x, &z, (samples, w), stats);
        self.integrate_defects(&samples, residual);
        residual.conditions.fill(0.0);
        let mut change = self.zeros();
        self.correction(residual, &mut change);
        // A change that is not a number is one that overflowed.
        let segments = self.equations.segments();
        let [change, size] = [&change, &z].map(|v| size_by_component(segments, x, v));
        let isolated = change < SINGULAR * size;
        (!isolated).then(|| self.name(x, &z))
    }

    /// The direction z in words.
    pub(crate) fn name(&self, x: &Iterate, z: &Iterate) -> Direction {
        let segments = self.equations.segments();
        let states: usize = segments.iter().map(|segment| segment.states).sum();
        let mut changes = vec![0.0; 2 * states];
        gather_ends(segments, z, &mut changes);
        changes.extend(&z.p);
        let sizes = self.units(x);
        for (change, size) in changes.iter_mut().zip(&sizes) {
            *change = change.abs() / size;
        }
        let largest = changes.iter().copied().fold(0.0, f64::max);
        let column = changes.iter().position(|&change| change == largest);
        Direction {
            felt: largest > FELT * size_by_component(segments, x, z),
            shift: self.shift(x, z) > PARALLEL,
            free: column.map(|column| Unknown::of_column(segments, column)),
        }
    }

    /// `z' − J(S + e) z − F_p p − r / a` at the defect points of all intervals.
    fn linear_defects(
        &self,
        x: &Iterate,
        z: &Iterate,
        (defects, w): (&Samples, &Iterate),
        stats: &mut Stats,
    ) -> Samples {
        let (t, m, k) = (&*self.tableau, self.tableau.stages, x.p.len());
        let z_p = z.p.clone();
        let p: Vec<f64> = x.p.iter().zip(&w.p).map(|(p, e)| p + e).collect();
        let each = self.equations.segments().iter().zip(defects).enumerate();
        let of_segment = |(index, (segment, defects)): (usize, (&Segment, &Vec<f64>))| {
            let n = segment.states;
            let [mut y, mut e, mut f, mut forcing] = [(); 4].map(|()| vec![0.0; n]);
            let mut jacobian = vec![0.0; n * (n + k)];
            let mut samples = vec![0.0; defects.len()];
            let intervals = samples.chunks_exact_mut((m + 1) * n);
            let intervals = intervals.zip(defects.chunks_exact((m + 1) * n));
            let places = self.mesh[index].windows(2).enumerate();
            for ((i, ends), (samples, defects)) in places.zip(intervals) {
                let [x, w, z] = [x, w, z].map(|x| Interval::new(&x.segments[index], n, t, i, ends));
                // z is not quite a null vector: it has the forcing r / a at all stages.
                z.stage_state(t, 0, &mut e);
                forcing.copy_from_slice(z.stage_slope(0));
                let rows = self.stages[index].jacobians()[i * m * n * (n + k)..].chunks(n + k);
                for (forcing, row) in forcing.iter_mut().zip(rows) {
                    *forcing -= dot(&row[..n], &e) + dot(&row[n..], &z_p);
                }
                for (q, sample) in samples.chunks_exact_mut(n).enumerate() {
                    let values = &t.defect_value[q * m..][..m];
                    let integrals = &t.defect_to_defect[q * (m + 1)..][..m + 1];
                    let s = x.place(t.defect_rule.points[q]);
                    x.state(values, &mut y);
                    w.state(values, &mut e);
                    subtract_sum(&mut e, x.h, integrals, defects);
                    add_scaled(&mut y, 1.0, &e);
                    let equations = &self.equations;
                    equations.rhs_jacobian(index, s, &y, &p, &mut f, &mut jacobian);
                    z.state(values, &mut e);
                    z.slope(&t.defect_slope[q * m..][..m], sample);
                    let rows = jacobian.chunks_exact(n + k).zip(&forcing);
                    for (d, (row, forcing)) in sample.iter_mut().zip(rows) {
                        *d -= dot(&row[..n], &e) + dot(&row[n..], &z_p) + forcing;
                    }
                }
            }
            stats.jacobian_evaluations += samples.len() / n;
            samples
        };
        each.map(of_segment).collect()
    }

    /// |cos| of the angle between z and the slopes of `x` at all nodes, relative to 1 + |x|: a shift of s
    /// changes states by their slopes and no parameters.
    fn shift(&self, x: &Iterate, z: &Iterate) -> f64 {
        let (mut product, mut slopes, mut changes) = (0.0, 0.0, 0.0);
        for (index, segment) in self.equations.segments().iter().enumerate() {
            let n = segment.states;
            let mut slope = vec![0.0; n];
            let states = x.segments[index].nodes.chunks_exact(n);
            let each = states.zip(z.segments[index].nodes.chunks_exact(n));
            for (&s, (y, z)) in self.mesh[index].iter().zip(each) {
                self.equations.evaluate_rhs(index, s, y, &x.p, &mut slope);
                for ((slope, z), y) in slope.iter().zip(z).zip(y) {
                    let [slope, z] = [slope, z].map(|x| x / (1.0 + y.abs()));
                    product += slope * z;
                    slopes += slope * slope;
                    changes += z * z;
                }
            }
        }
        let parameters = z.p.iter().zip(&x.p);
        changes += parameters
            .map(|(z, p)| (z / (1.0 + p.abs())).powi(2))
            .sum::<f64>();
        product.abs() / (slopes * changes).sqrt()
    }
}

/// The unit of a state or parameter with this largest value.
fn unit(largest: f64) -> f64 {
    if largest > NOTHING { largest } else { 1.0 }
}

/// The largest |y| of a component of n states at the nodes of a segment.
fn largest_state(nodes: &[f64], n: usize, component: usize) -> f64 {
    let states = nodes.iter().skip(component).step_by(n);
    states.fold(0.0, |m: f64, y| m.max(y.abs()))
}

/// The largest entry of a correction in the units of its components.
fn size_by_component(segments: &[Segment], x: &Iterate, correction: &Iterate) -> f64 {
    largest_ratio(segments, x, correction, |_, nodes, n, component| {
        let unit = unit(largest_state(nodes, n, component));
        vec![unit; nodes.len() / n]
    })
}

/// The largest entry of a correction relative to sizes of its component at the nodes of a segment.
fn largest_ratio(
    segments: &[Segment],
    x: &Iterate,
    correction: &Iterate,
    sizes: impl Fn(usize, &[f64], usize, usize) -> Vec<f64>,
) -> f64 {
    let mut largest = 0.0f64;
    let each = segments.iter().zip(&x.segments).zip(&correction.segments);
    for (index, ((segment, x), correction)) in each.enumerate() {
        let n = segment.states;
        for component in 0..n {
            let changes = correction.nodes.iter().skip(component).step_by(n);
            let sizes = sizes(index, &x.nodes, n, component);
            let ratios = changes.zip(sizes).map(|(change, size)| change.abs() / size);
            largest = ratios.fold(largest, max_or_nan);
        }
    }
    let parameters = x.p.iter().zip(&correction.p);
    parameters.fold(largest, |m, (p, c)| max_or_nan(m, c.abs() / unit(p.abs())))
}
