//! How well a continuous solution satisfies the differential equations.

use crate::dense::max_or_nan;
use crate::iterate::{Interval, Iterate, NonFinite};
use crate::mesh::Mesh;
use crate::scheme::Tableau;
use crate::{Equations, Stats};

/// Relative defect of the continuous solution S, one number per interval and segment:
///
/// ```text
/// rᵢ² = ∫₀¹ maxᶜ [ (S' − f(s, S, p)) / (1 + |f|) ]² dθ
/// ```
///
/// over the interval, by the Gauss rule with m + 1 points. J. Kierzenka & L. F. Shampine, "A BVP
/// solver based on residual control and the MATLAB PSE", ACM Trans. Math. Softw. 27 (2001)
/// 299-316.
pub(crate) fn defects(
    equations: &dyn Equations,
    t: &Tableau,
    mesh: &Mesh,
    x: &Iterate,
    stats: &mut Stats,
) -> Result<Vec<Vec<f64>>, NonFinite> {
    let mut all = Vec::with_capacity(mesh.len());
    for (index, segment) in equations.segments().iter().enumerate() {
        let n = segment.states;
        let (mut y, mut f, mut slope) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        let mut defects = Vec::with_capacity(mesh[index].len() - 1);
        for (i, pair) in mesh[index].windows(2).enumerate() {
            let interval = Interval::new(&x.segments[index], n, t, i, pair);
            let mut square = 0.0;
            for (q, weight) in t.defect_rule.weights.iter().enumerate() {
                let s = interval.place(t.defect_rule.points[q]);
                interval.state(&t.defect_value[q * t.stages..][..t.stages], &mut y);
                interval.slope(&t.defect_slope[q * t.stages..][..t.stages], &mut slope);
                f.fill(f64::NAN);
                equations.rhs(index, s, &y, &x.p, &mut f);
                stats.rhs_evaluations += 1;
                let mut largest: f64 = 0.0;
                for (component, (slope, f)) in slope.iter().zip(&f).enumerate() {
                    if !f.is_finite() {
                        let segment = index;
                        return Err(NonFinite::Rhs {
                            segment,
                            s,
                            component,
                        });
                    }
                    largest = max_or_nan(largest, ((slope - f) / (1.0 + f.abs())).abs());
                }
                square += weight * largest * largest;
            }
            defects.push(square.sqrt());
        }
        all.push(defects);
    }
    Ok(all)
}
