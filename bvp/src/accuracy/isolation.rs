//! Whether a solution is the only one near it, as far as the discretised problem can tell.
//!
//! The inverse of the Newton matrix A takes forcings r of the size of the solution, with random signs, to
//!
//! ```text
//! v = A⁻¹ r,    a = max |v| / |x| over all nodes, places inside the intervals, and parameters
//! ```
//!
//! Where the amplification a is large, z = v / a is nearly a null vector, A z = r / a. The solution S has
//! the estimated error e, so that S + e is nearer to the exact one; of the differential equations
//! linearised there z has the defect `d = z' − J(S + e) z − F_p p − r / a`, and by defect correction
//! ([`global_error`](crate::accuracy::global_error)) the size of A⁻¹ d is the relative change of the
//! smallest singular value from the discretised problem to the exact one. Where it shows beside one, the
//! matrix may be regular only by its discretisation: the solution belongs to a family, or is as good as
//! one, and z is the direction of the family.
//!
//! The amplification is a lower bound of ‖A⁻¹‖ by one solve, with random signs: N. J. Higham, *Accuracy
//! and Stability of Numerical Algorithms*, 2nd ed., SIAM 2002, chapter 15.

use crate::accuracy::global_error::subtract_sum;
use crate::discretisation::iterate::{Interval, Iterate, Residual};
use crate::discretisation::ratio::{Component, largest_ratio};
use crate::discretisation::tableau::middle;
use crate::kernels::dense::{add_scaled, dot, max_or_nan};
use crate::kernels::random::Signs;
use crate::kernels::specialise::specialise;
use crate::newton::collocation::{Collocation, gather_ends};
use crate::problem::equations::Equations as _;
use crate::problem::problem::Segment;
use crate::problem::unknown::Unknown;
use crate::result::quality::{Direction, Samples};
use crate::result::stats::Stats;
use crate::shares::{AIM, NEGLIGIBLE, ONE_SAMPLE, UNNOTICED};

/// Whether an amplification asks for a closer look at a solution: with a change of its size for a forcing of
/// its size, as far as one sample of signs tells, the Newton matrix is regular in all solutions that the
/// tolerance allows.
///
/// However small the error is, a mesh that need not resolve a solution as simple as zero, or its flat parts,
/// may resolve directions beside it no better than to a third. From this on the direction is looked at in 18
/// of 267 solutions of the reference set; from 30 on, in 9 of them, 1 of 1000 random problems that are not
/// isolated and 2 of 500 random shocks were accepted.
pub(crate) fn is_amplified(a: f64) -> bool {
    a.is_nan() || a >= 1.0 / AIM
}

/// Whether an amplification is so high that it must show on a finer mesh, too, since it makes the negligible
/// large: what a mesh is too coarse for can end an exponential growth beyond it. Of 267 solutions of the
/// reference set none has more, so that the look at halved intervals costs nothing there.
pub(crate) fn is_high(a: f64) -> bool {
    a.is_nan() || a >= 1.0 / NEGLIGIBLE
}

/// Whether an amplification is the same on a mesh of halved intervals, as far as other signs on other
/// intervals tell.
pub(crate) fn is_steady(a: f64, halved: f64) -> bool {
    halved < ONE_SAMPLE * a
}

/// Whether a matrix with this amplification is as good as singular.
pub(crate) fn is_open(a: f64) -> bool {
    a.is_nan() || a >= OPEN
}

/// Whether all states of a solution with this tolerance vanish: any mesh does for that, and may be too coarse
/// for the directions beside it.
pub(crate) fn vanishes(x: &Iterate, tolerance: f64) -> bool {
    x.largest_state() <= NEGLIGIBLE * tolerance
}

/// From this amplification on a matrix may be singular to rounding: it leaves five digits, and is a lower
/// bound.
const OPEN: f64 = 1e11;

impl Collocation<'_> {
    /// The amplification a of forcings with random signs by the last linearisation, which must be at `x`,
    /// a solution with this tolerance; leaves v in `v`, and writes `residual`.
    pub(crate) fn amplification(
        &mut self,
        x: &Iterate,
        tolerance: f64,
        residual: &mut Residual,
        v: &mut Iterate,
    ) -> f64 {
        let segments = 0..self.equations.segments().len();
        let sizes: Vec<_> = segments.map(|i| self.interval_sizes(i, x)).collect();
        self.force(x, &sizes, tolerance, residual);
        self.correction(residual, v);
        self.local_size(x, &sizes, tolerance, v)
    }

    /// The largest |y| of every state on every interval of a segment: at its nodes and at the two collocation
    /// points in its middle, as a wave may vanish at all nodes, sin 3πx on three intervals.
    fn interval_sizes(&self, index: usize, x: &Iterate) -> Vec<f64> {
        let (n, m) = (self.equations.segments()[index].states, self.tableau.stages);
        let mut sizes = vec![0.0; n * (self.mesh[index].len() - 1)];
        specialise!(n in [1, 2, 3, 4, 5, 6] => specialise!(m in [6, 7] =>
            self.write_sizes([m, n], index, x, &mut sizes)));
        sizes
    }

    #[inline(always)]
    fn write_sizes(&self, [m, n]: [usize; 2], index: usize, x: &Iterate, sizes: &mut [f64]) {
        let (t, mut buffer) = (&*self.tableau, vec![0.0; n]);
        let y = &mut buffer[..n];
        let intervals = self.mesh[index].windows(2).zip(sizes.chunks_exact_mut(n));
        for (i, (ends, sizes)) in intervals.enumerate() {
            let interval = Interval::new(&x.segments[index], n, t, i, ends);
            enlarge(sizes, interval.y);
            enlarge(sizes, interval.next);
            for j in middle(m) {
                interval.state(&t.a[j * m..][..m], y);
                enlarge(sizes, y);
            }
        }
    }

    /// Forcings of the size of the solution `x` on every interval, linear there, with random signs of the mean
    /// and of the slope: a constant would not force what has a mean of zero over every interval, as sin 6πx on
    /// three.
    fn force(&mut self, x: &Iterate, sizes: &[Vec<f64>], tolerance: f64, residual: &mut Residual) {
        let mut signs = Signs::default();
        let m = self.tableau.stages;
        for (index, (r, sizes)) in residual.equations.iter_mut().zip(sizes).enumerate() {
            let n = self.equations.segments()[index].states;
            let mesh = &self.mesh[index];
            let length = mesh[mesh.len() - 1] - mesh[0];
            r.nodes.fill(0.0);
            for component in 0..n {
                let largest = Component::new(sizes, n, component).largest;
                let unit = unit(largest, tolerance);
                let vanishes = unit > largest;
                let sizes = sizes[component..].iter().step_by(n);
                for (stages, &size) in r.stages.chunks_exact_mut(m * n).zip(sizes) {
                    let size = if vanishes { unit } else { size };
                    let [mean, slope] = [(); 2].map(|()| signs.turn(size / length));
                    for (r, c) in stages.chunks_exact_mut(n).zip(&self.tableau.c) {
                        r[component] = mean + (c - 0.5) * slope;
                    }
                }
            }
        }
        let scales = self.condition_scales(x);
        for (r, scale) in residual.conditions.iter_mut().zip(scales) {
            *r = signs.turn(scale);
        }
    }

    /// The largest entry of a correction relative to the states on the intervals beside its place, or to one
    /// unit or the largest state, whichever is smaller, where they are less: forcings of the size of a
    /// solution make changes of its size, wherever it is large or small, unless they are amplified.
    ///
    /// States that are the derivative of another one are left out: in a layer that the mesh does not
    /// resolve, and nothing depends on, they are as large as it is thin.
    fn local_size(
        &self,
        x: &Iterate,
        sizes: &[Vec<f64>],
        tolerance: f64,
        correction: &Iterate,
    ) -> f64 {
        let m = self.tableau.stages;
        let segments = self.equations.segments().iter().zip(sizes).enumerate();
        let of_states = segments.fold(0.0, |largest, (index, (segment, sizes))| {
            let n = segment.states;
            let sizes = self.local_sizes(index, sizes, tolerance);
            let of_segment = specialise!(n in [1, 2, 3, 4, 5, 6] => specialise!(m in [6, 7] =>
                self.largest_change([m, n], index, correction, &sizes)));
            max_or_nan(largest, of_segment)
        });
        let parameters = x.p.iter().zip(&correction.p);
        parameters.fold(of_states, |largest, (p, change)| {
            max_or_nan(largest, change.abs() / unit(p.abs(), tolerance))
        })
    }

    /// For all nodes of a segment the sizes beside which the changes of the states there are large, from
    /// those on its intervals.
    fn local_sizes(&self, index: usize, of_intervals: &[f64], tolerance: f64) -> Vec<f64> {
        let n = self.equations.segments()[index].states;
        let least = |state| match self.stages[index].is_slope(state) {
            true => f64::INFINITY,
            false => unit(Component::new(of_intervals, n, state).largest, tolerance).min(1.0),
        };
        let least: Vec<f64> = (0..n).map(least).collect();
        let mut sizes = least.repeat(of_intervals.len() / n + 1);
        for (i, interval) in of_intervals.chunks_exact(n).enumerate() {
            enlarge(&mut sizes[i * n..][..n], interval);
            enlarge(&mut sizes[(i + 1) * n..][..n], interval);
        }
        sizes
    }

    /// The largest state of a correction at the nodes of a segment and at the collocation points in the middle
    /// of its intervals, relative to the sizes at the node or at the one to the left.
    #[inline(always)]
    fn largest_change(
        &self,
        [m, n]: [usize; 2],
        index: usize,
        correction: &Iterate,
        sizes: &[f64],
    ) -> f64 {
        let correction = &correction.segments[index];
        let larger = |largest, changes: &[f64], sizes: &[f64]| {
            let each = changes.iter().zip(sizes);
            each.fold(largest, |largest, (change, size)| {
                max_or_nan(largest, change.abs() / size)
            })
        };
        let mut largest = larger(0.0, &correction.nodes, sizes);
        let (t, mut buffer) = (&*self.tableau, vec![0.0; n]);
        let change = &mut buffer[..n];
        let intervals = self.mesh[index].windows(2).zip(sizes.chunks_exact(n));
        for (i, (ends, sizes)) in intervals.enumerate() {
            let interval = Interval::new(correction, n, t, i, ends);
            for j in middle(m) {
                interval.state(&t.a[j * m..][..m], change);
                largest = larger(largest, change, sizes);
            }
        }
        largest
    }

    /// The units of the states at all ends, in the order of [`Ends`](crate::Ends), and of the parameters.
    fn units(&self, x: &Iterate, tolerance: f64) -> Vec<f64> {
        let mut sizes = vec![];
        for (segment, x) in self.equations.segments().iter().zip(&x.segments) {
            let n = segment.states;
            let of = |state| unit(Component::new(&x.nodes, n, state).largest, tolerance);
            sizes.extend((0..2 * n).map(|end| of(end % n)));
        }
        sizes.extend(x.p.iter().map(|p| unit(p.abs(), tolerance)));
        sizes
    }

    /// The direction in which the solution `x` with the error of [`global_errors`](Self::global_errors),
    /// left in `w`, is not isolated, if so, with the [`amplification`](Self::amplification) a, left in `v`.
    /// Writes `residual`.
    pub(crate) fn direction(
        &mut self,
        x: &Iterate,
        (samples, w): (&Samples, &Iterate),
        (v, a): (&Iterate, f64),
        tolerance: f64,
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
        // With a change of the smallest singular value beyond this the exact problem may be singular; one
        // that is not a number overflowed. What makes the nodes superconvergent is known by its order only, of
        // the error as of z, and where it is amplified highly a change that shows at all may be a hundredth of
        // the true one. Of the reference set none exceeds 3e-4; of 10 directions in which solutions of random
        // problems were not isolated, amplified by 1e5 to 5e10, all exceed 8e-3.
        let allowed = if is_high(a) { NEGLIGIBLE } else { UNNOTICED };
        let segments = self.equations.segments();
        let [change, size] = [&change, &z].map(|v| size_by_component(segments, x, tolerance, v));
        let isolated = change < allowed * size;
        (!isolated).then(|| self.name(x, tolerance, &z))
    }

    /// The direction z in words.
    pub(crate) fn name(&self, x: &Iterate, tolerance: f64, z: &Iterate) -> Direction {
        let segments = self.equations.segments();
        let states: usize = segments.iter().map(|segment| segment.states).sum();
        let mut changes = vec![0.0; 2 * states];
        gather_ends(segments, z, &mut changes);
        changes.extend(&z.p);
        let sizes = self.units(x, tolerance);
        for (change, size) in changes.iter_mut().zip(&sizes) {
            *change = change.abs() / size;
        }
        let largest = changes.iter().copied().fold(0.0, f64::max);
        let column = changes.iter().position(|&change| change == largest);
        Direction {
            // Otherwise it is the direction of a layer inside, which the conditions hardly reach.
            felt: largest > NEGLIGIBLE * size_by_component(segments, x, tolerance, z),
            // Its sine does not show.
            shift: self.shift(x, z) > 1.0 - UNNOTICED.powi(2),
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
            let [mut y, mut e, mut f] = [(); 3].map(|()| vec![0.0; n]);
            let mut forcing = [(); 2].map(|()| vec![0.0; n]);
            let mut jacobian = vec![0.0; n * (n + k)];
            let mut samples = vec![0.0; defects.len()];
            let intervals = samples.chunks_exact_mut((m + 1) * n);
            let intervals = intervals.zip(defects.chunks_exact((m + 1) * n));
            let places = self.mesh[index].windows(2).enumerate();
            for ((i, ends), (samples, defects)) in places.zip(intervals) {
                let [x, w, z] = [x, w, z].map(|x| Interval::new(&x.segments[index], n, t, i, ends));
                // z is not quite a null vector: it has the forcing r / a, which is that of its first and its
                // last stage and linear in between.
                for (j, forcing) in [0, m - 1].into_iter().zip(&mut forcing) {
                    z.stage_state(t, j, &mut e);
                    forcing.copy_from_slice(z.stage_slope(j));
                    let rows = &self.stages[index].jacobians()[(i * m + j) * n * (n + k)..];
                    for (forcing, row) in forcing.iter_mut().zip(rows.chunks(n + k)) {
                        *forcing -= dot(&row[..n], &e) + dot(&row[n..], &z_p);
                    }
                }
                for (q, sample) in samples.chunks_exact_mut(n).enumerate() {
                    let values = &t.defect_value[q * m..][..m];
                    let integrals = &t.defect_to_defect[q * (m + 1)..][..m + 1];
                    let theta = t.defect_rule.points[q];
                    let s = x.place(theta);
                    let share = match m {
                        1 => 0.0,
                        _ => (theta - t.c[0]) / (t.c[m - 1] - t.c[0]),
                    };
                    x.state(values, &mut y);
                    w.state(values, &mut e);
                    subtract_sum(&mut e, x.h, integrals, defects);
                    add_scaled(&mut y, 1.0, &e);
                    let equations = &self.equations;
                    equations.rhs_jacobian(index, s, &y, &p, &mut f, &mut jacobian);
                    z.state(values, &mut e);
                    z.slope(&t.defect_slope[q * m..][..m], sample);
                    let forcing = forcing[0].iter().zip(&forcing[1]);
                    let rows = jacobian.chunks_exact(n + k).zip(forcing);
                    for (d, (row, (first, last))) in sample.iter_mut().zip(rows) {
                        let forcing = first + share * (last - first);
                        *d -= dot(&row[..n], &e) + dot(&row[n..], &z_p) + forcing;
                    }
                }
            }
            stats.jacobian_evaluations += samples.len() / n;
            samples
        };
        each.map(of_segment).collect()
    }

    /// cos² of the angle between z and the slopes of `x` at all nodes, relative to 1 + |x|: a shift of s
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
        product * product / (slopes * changes)
    }
}

/// Raises sizes to those of states.
#[inline(always)]
fn enlarge(sizes: &mut [f64], y: &[f64]) {
    for (size, y) in sizes.iter_mut().zip(y) {
        *size = size.max(y.abs());
    }
}

/// The unit of a state or parameter with this largest value. One that is nowhere larger than a negligible
/// share of the tolerance vanishes: what is left of it is what Newton's method leaves.
fn unit(largest: f64, tolerance: f64) -> f64 {
    if largest > NEGLIGIBLE * tolerance {
        largest
    } else {
        1.0
    }
}

/// The largest entry of a correction in the units of its components.
fn size_by_component(
    segments: &[Segment],
    x: &Iterate,
    tolerance: f64,
    correction: &Iterate,
) -> f64 {
    let of_state = |y: &Component<'_>, _| unit(y.largest, tolerance);
    largest_ratio(segments, x, correction, of_state, |p| {
        unit(p.abs(), tolerance)
    })
}
