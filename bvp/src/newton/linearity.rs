//! Whether a linearisation made elsewhere is that of an iterate.

use crate::discretisation::iterate::{Interval, Iterate};
use crate::kernels::few::Few;
use crate::newton::collocation::{Collocation, gather_ends};
use crate::problem::equations::Equations;
use crate::problem::problem::Ends;
use crate::result::stats::Stats;

impl Collocation<'_> {
    /// Whether the Jacobians of the last linearisation are those at `x` to half of the digits: of the right-hand
    /// side at one stage of every interval, and of the conditions. A residual alone does not tell: exp(−y²) is as
    /// small as that of a linear problem after one step, far from where it was linearised, and has no zero.
    pub(crate) fn is_linearised_at(&self, x: &Iterate, stats: &mut Stats) -> bool {
        let (t, k) = (&*self.tableau, x.p.len());
        let middle = t.stages / 2;
        for (index, segment) in self.equations.segments().iter().enumerate() {
            let n = segment.states;
            let size = n * (n + k);
            let mut values = Few::zeros(2 * n + size);
            let (y, rest) = values.split_at_mut(n);
            let (f, jacobian) = rest.split_at_mut(n);
            let jacobian = &mut jacobian[..size];
            let known = self.stages[index].jacobians();
            let at_once = self.jacobians_at_once(index, middle, x);
            let intervals = known.chunks_exact(t.stages * size).enumerate();
            for (pair, (i, known)) in self.mesh[index].windows(2).zip(intervals) {
                match &at_once {
                    Some(all) => jacobian.copy_from_slice(&all[i * size..][..size]),
                    None => {
                        let interval = Interval::new(&x.segments[index], [t.stages, n], i, pair);
                        interval.stage_state(t, middle, &mut y[..n]);
                        let s = interval.place(t.c[middle]);
                        self.equations
                            .rhs_jacobian(index, s, &y[..n], &x.p, &mut f[..n], jacobian);
                    }
                }
                stats.jacobian_evaluations += 1;
                if !are_equal(jacobian, &known[middle * size..][..size], n + k) {
                    return false;
                }
            }
        }
        let segments = self.equations.segments();
        let states: usize = segments.iter().map(|segment| segment.states).sum();
        let mut ends = vec![0.0; 2 * states];
        gather_ends(segments, x, &mut ends);
        let mut residuals = vec![0.0; self.equations.condition_count()];
        let mut jacobian = vec![0.0; self.conditions_jacobian.len()];
        let at = Ends::new(segments, &ends);
        self.equations
            .conditions_jacobian(at, &x.p, &mut residuals, &mut jacobian);
        are_equal(&jacobian, &self.conditions_jacobian, 2 * states + k)
    }

    /// The Jacobians at one stage of every interval of a segment, if they take one call.
    fn jacobians_at_once(&self, index: usize, stage: usize, x: &Iterate) -> Option<Vec<f64>> {
        if !self.equations.is_vectorised() {
            return None;
        }
        let (t, n) = (&*self.tableau, self.equations.segments()[index].states);
        let pairs = self.mesh[index].windows(2);
        let mut places = Vec::with_capacity(pairs.len());
        let mut states = vec![0.0; pairs.len() * n];
        for (i, (pair, y)) in pairs.zip(states.chunks_exact_mut(n)).enumerate() {
            let interval = Interval::new(&x.segments[index], [t.stages, n], i, pair);
            interval.stage_state(t, stage, y);
            places.push(interval.place(t.c[stage]));
        }
        let mut rhs = vec![0.0; states.len()];
        let mut jacobians = vec![0.0; states.len() * (n + x.p.len())];
        self.equations
            .rhs_jacobian_at(index, &places, &states, &x.p, &mut rhs, &mut jacobians);
        Some(jacobians)
    }
}

/// Whether two matrices agree to half of the digits of the largest entry of every row.
fn are_equal(one: &[f64], other: &[f64], columns: usize) -> bool {
    let rows = one.chunks_exact(columns).zip(other.chunks_exact(columns));
    rows.into_iter().all(|(one, other)| {
        let largest = other.iter().fold(0.0f64, |m, a| m.max(a.abs()));
        let allowed = f64::EPSILON.sqrt() * largest;
        one.iter().zip(other).all(|(a, b)| (a - b).abs() <= allowed)
    })
}
