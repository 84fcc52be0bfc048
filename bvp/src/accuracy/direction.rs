//! The direction in which a solution is not the only one near it, as far as the discretised problem can tell.
//!
//! Where the [`amplification`](crate::accuracy::amplification) a of forcings r is large, z = v / a is nearly a
//! null vector, A z = r / a. The solution S has the estimated error e, so that S + e is nearer to the exact
//! one; of the differential equations linearised there z has the defect
//! `d = z' − J(S + e) z − F_p p − r / a`, and by defect correction
//! ([`global_error`](crate::accuracy::global_error)) the size of A⁻¹ d is the relative change of the
//! smallest singular value from the discretised problem to the exact one. Where it shows beside one, the
//! matrix may be regular only by its discretisation: the solution belongs to a family, or is as good as
//! one, and z is the direction of the family.
//!
//! The conditions are forced, too. Where the equations are singular at an end and a layer decays at once, that leaves
//! in z what no mesh resolves. A step of inverse iteration without forced conditions, A z₂ = z, keeps the direction of
//! a family and leaves such layers out.

use crate::accuracy::amplification::{is_high, unit};
use crate::accuracy::global_error::subtract_sum;
use crate::discretisation::iterate::{Interval, Iterate, Residual};
use crate::discretisation::ratio::{Component, largest_ratio};
use crate::kernels::dense::{add_scaled, dot};
use crate::newton::collocation::{Collocation, gather_ends};
use crate::problem::equations::Equations as _;
use crate::problem::problem::Segment;
use crate::problem::unknown::Unknown;
use crate::result::quality::{Direction, Samples};
use crate::result::stats::Stats;
use crate::shares::{NEGLIGIBLE, UNNOTICED};

impl Collocation<'_> {
    /// The direction in which the solution `x` with the error of [`correct_defects`](Self::correct_defects),
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
        let mut is_regular = |collocation: &mut Self, z: &Iterate, residual: &mut Residual| {
            let samples = collocation.linear_defects(x, z, (samples, w), stats);
            let to_stage = &collocation.tableau.defect_to_stage;
            collocation.integrate_defects(&samples, to_stage, residual);
            residual.conditions.fill(0.0);
            let mut change = collocation.zeros();
            collocation.correction(residual, &mut change);
            // With a change of the smallest singular value beyond this the exact problem may be singular; one
            // that is not a number overflowed. What makes the nodes superconvergent is known by its order only,
            // of the error as of z, and where it is amplified highly a change that shows at all may be a
            // hundredth of the true one. Of the reference set none exceeds 3e-4; of 10 directions in which
            // solutions of random problems were not isolated, amplified by 1e5 to 5e10, all exceed 8e-3.
            let allowed = if is_high(a) { NEGLIGIBLE } else { UNNOTICED };
            let segments = collocation.equations.segments();
            let [change, size] = [&change, z].map(|v| size_by_component(segments, x, tolerance, v));
            change < allowed * size
        };
        if is_regular(self, &z, residual) {
            return None;
        }
        let mut sharper = self.zeros();
        self.force_by(&z, residual);
        self.correction(residual, &mut sharper);
        if is_regular(self, &sharper, residual) {
            return None;
        }
        Some(self.name(x, tolerance, &z))
    }

    /// Forcings by z, linear on every interval between its values at the nodes, and none of the conditions.
    fn force_by(&self, z: &Iterate, residual: &mut Residual) {
        let m = self.tableau.stages;
        for (index, (r, z)) in residual.equations.iter_mut().zip(&z.segments).enumerate() {
            let n = self.equations.segments()[index].states;
            r.nodes.fill(0.0);
            let intervals = r.stages.chunks_exact_mut(m * n);
            for (i, stages) in intervals.enumerate() {
                let [from, to] = [i, i + 1].map(|node| &z.nodes[node * n..][..n]);
                for (r, c) in stages.chunks_exact_mut(n).zip(&self.tableau.c) {
                    for (r, (from, to)) in r.iter_mut().zip(from.iter().zip(to)) {
                        *r = from + c * (to - from);
                    }
                }
            }
        }
        residual.conditions.fill(0.0);
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
                let [x, w, z] =
                    [x, w, z].map(|x| Interval::new(&x.segments[index], [m, n], i, ends));
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
