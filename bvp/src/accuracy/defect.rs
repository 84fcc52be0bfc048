//! How well a continuous solution satisfies the differential equations.

use crate::discretisation::iterate::{Interval, Iterate, NonFinite};
use crate::discretisation::mesh::Mesh;
use crate::discretisation::tableau::Tableau;
use crate::kernels::dense::max_or_nan;
use crate::kernels::few::Few;
use crate::kernels::parallel::for_each_run;
use crate::kernels::room::make_room;
use crate::kernels::specialise::{outlined, specialise};
use crate::problem::equations::Equations;
use crate::problem::held::Held;
use crate::result::quality::{Defects, Samples};
use crate::result::stats::Stats;
use std::ops::Range;

/// Relative defect of the continuous solution S, one number per interval and segment:
///
/// ```text
/// rᵢ² = ∫₀¹ maxᶜ [ (S' − f(s, S, p)) / (1 + |f|) ]² dθ
/// ```
///
/// over the interval, by the Gauss rule with m + 1 points. J. Kierzenka & L. F. Shampine, "A BVP
/// solver based on residual control and the MATLAB PSE", ACM Trans. Math. Softw. 27 (2001)
/// 299-316. The values behind it are written to `samples`.
pub(crate) fn defects(
    equations: &Held<'_>,
    t: &Tableau,
    mesh: &Mesh,
    x: &Iterate,
    samples: &mut Samples,
    stats: &mut Stats,
) -> Result<Defects, NonFinite> {
    let [relative, local] = [(); 2].map(|()| Vec::with_capacity(mesh.len()));
    let mut all = Defects { relative, local };
    samples.resize_with(mesh.len(), Vec::new);
    let segments = equations.segments().iter().zip(samples).enumerate();
    for (index, (segment, samples)) in segments {
        let (n, m) = (segment.states, t.stages);
        let nodes = &mesh[index];
        let intervals = nodes.len() - 1;
        let along = Along {
            equations,
            tableau: t,
            index,
            nodes,
            x,
        };
        let [mut relative, mut local] = [(); 2].map(|()| vec![0.0; intervals]);
        make_room(samples, intervals * (m + 1) * n);
        for_each_run(
            0..intervals,
            (m + 1) * n * (2 * m + n),
            ((&mut relative[..], &mut local[..]), &mut samples[..]),
            &mut Few::zeros(3 * n),
            &|run, written, buffers| {
                specialise!(n in [1, 2, 3, 4, 5, 6] => specialise!(m in [6, 7] =>
                outlined(|| along.defects([m, n], run, written, buffers))))
            },
        )?;
        all.relative.push(relative);
        all.local.push(local);
        stats.rhs_evaluations += intervals * t.defect_rule.points.len();
    }
    Ok(all)
}

/// A continuous solution on one segment.
struct Along<'a> {
    equations: &'a Held<'a>,
    tableau: &'a Tableau,
    /// Which segment it is.
    index: usize,
    nodes: &'a [f64],
    x: &'a Iterate,
}

impl Along<'_> {
    /// The right-hand side at all points of a run of intervals, if that takes one call.
    #[inline(never)]
    fn rhs_at_once(&self, [m, n]: [usize; 2], run: Range<usize>) -> Option<Vec<f64>> {
        if !self.equations.is_vectorised() {
            return None;
        }
        let (t, x) = (self.tableau, self.x);
        let count = run.len() * (m + 1);
        let mut places = Vec::with_capacity(count);
        let [mut states, mut rhs] = [0.0, f64::NAN].map(|value| vec![value; count * n]);
        for (i, states) in run.zip(states.chunks_exact_mut((m + 1) * n)) {
            let ends = &self.nodes[i..i + 2];
            let interval = Interval::new(&x.segments[self.index], [m, n], i, ends);
            for (q, y) in states.chunks_exact_mut(n).enumerate() {
                places.push(interval.place(t.defect_rule.points[q]));
                interval.state(&t.defect_value[q * m..][..m], y);
            }
        }
        self.equations
            .evaluate_rhs_at(self.index, &places, &states, &x.p, &mut rhs);
        Some(rhs)
    }

    /// The defects of a run of intervals with m stages and n states, relative and local.
    #[inline(always)]
    fn defects(
        &self,
        [m, n]: [usize; 2],
        run: Range<usize>,
        ((relative, local), samples): ((&mut [f64], &mut [f64]), &mut [f64]),
        buffers: &mut [f64],
    ) -> Result<(), NonFinite> {
        let (t, x) = (self.tableau, self.x);
        let (y, buffers) = buffers.split_at_mut(n);
        let (f, slope) = buffers.split_at_mut(n);
        let (y, f, slope) = (&mut y[..n], &mut f[..n], &mut slope[..n]);
        let (points, weights) = (
            &t.defect_rule.points[..m + 1],
            &t.defect_rule.weights[..m + 1],
        );
        let to_value = &t.defect_value[..(m + 1) * m];
        let to_slope = &t.defect_slope[..(m + 1) * m];
        let at_once = self.rhs_at_once([m, n], run.clone());
        let first = run.start;
        let samples = samples.chunks_exact_mut((m + 1) * n);
        let written = relative.iter_mut().zip(local).zip(samples);
        for (i, ((relative, local), samples)) in run.zip(written) {
            let ends = &self.nodes[i..i + 2];
            let interval = Interval::new(&x.segments[self.index], [m, n], i, ends);
            let (mut square, mut local_square) = (0.0, 0.0);
            for (q, sample) in samples.chunks_exact_mut(n).enumerate() {
                let (s, weight) = (interval.place(points[q]), weights[q]);
                interval.state(&to_value[q * m..][..m], y);
                interval.slope(&to_slope[q * m..][..m], slope);
                match &at_once {
                    Some(all) => {
                        let place = (i - first) * (m + 1) + q;
                        f.copy_from_slice(&all[place * n..][..n]);
                    }
                    None => {
                        f.fill(f64::NAN);
                        self.equations.evaluate_rhs(self.index, s, y, &x.p, f);
                    }
                }
                if let Some(component) = f.iter().position(|f| !f.is_finite()) {
                    let segment = self.index;
                    return Err(NonFinite::Rhs {
                        segment,
                        s,
                        component,
                    });
                }
                let (mut largest, mut integrated) = (0.0f64, 0.0f64);
                for (((slope, f), y), sample) in slope.iter().zip(&*f).zip(&*y).zip(sample) {
                    *sample = slope - f;
                    let defect = sample.abs();
                    largest = max_or_nan(largest, defect / (1.0 + f.abs()));
                    integrated = max_or_nan(integrated, defect / (1.0 + y.abs()));
                }
                square += weight * largest * largest;
                local_square += weight * integrated * integrated;
            }
            *relative = square.sqrt();
            *local = interval.h * local_square.sqrt();
        }
        Ok(())
    }
}
