//! A guess that meets the conditions and knows nothing else.

use crate::discretisation::mesh::Mesh;
use crate::kernels::dense::{add_scaled, all_finite, dot};
use crate::kernels::lu::lu;
use crate::problem::equations::Equations;
use crate::problem::guess::Guess;
use crate::problem::held::Held;
use crate::problem::problem::{Ends, Segment};

/// Straight lines between end states that meet the conditions.
///
/// The end states z are those of Gauss's and Newton's method from zero, with the parameters p₀ of
/// another guess and the derivative J = ∂g/∂z: z ← z − Jᵀ (J Jᵀ)⁻¹ g, the shortest changes. What
/// the conditions leave open stays zero.
pub(crate) struct Straight<'a> {
    segments: &'a [Segment],
    /// The end states in the order of [`Ends`].
    pub(crate) ends: Vec<f64>,
    /// The parameters p₀.
    pub(crate) parameters: Vec<f64>,
    /// The mesh of the other guess.
    mesh: Option<Mesh>,
}

impl<'a> Straight<'a> {
    /// With the parameters and the mesh of `guess`; `None` where a condition is not finite.
    pub(crate) fn new(equations: &'a Held<'a>, guess: &dyn Guess) -> Option<Self> {
        let segments = equations.segments();
        let mut parameters = vec![0.0; equations.parameters()];
        guess.parameters(&mut parameters);
        let mut ends = vec![0.0; segments.iter().map(|segment| 2 * segment.states).sum()];
        // Near a solution changes halve at least, as they do near a double one.
        let mut before = f64::INFINITY;
        loop {
            let change = shortest_change(equations, &mut ends, &parameters)?;
            if change > 0.5 * before || change == 0.0 {
                break;
            }
            before = change;
        }
        Some(Self {
            segments,
            ends,
            parameters,
            mesh: guess.mesh(),
        })
    }

    /// The constant slopes of the lines of a segment, into `slope`.
    pub(crate) fn slope(&self, segment: usize, slope: &mut [f64]) {
        let (at, &Segment { from, to, .. }) = (self.at(), &self.segments[segment]);
        let ends = at.start(segment).iter().zip(at.end(segment));
        for (slope, (start, end)) in slope.iter_mut().zip(ends) {
            *slope = (end - start) / (to - from);
        }
    }

    fn at(&self) -> Ends<'_, f64> {
        Ends::new(self.segments, &self.ends)
    }
}

impl Guess for Straight<'_> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        self.slope(segment, y);
        let distance = s - self.segments[segment].from;
        for (y, start) in y.iter_mut().zip(self.at().start(segment)) {
            *y = start + distance * *y;
        }
    }

    fn parameters(&self, p: &mut [f64]) {
        p.copy_from_slice(&self.parameters);
    }

    fn mesh(&self) -> Option<Mesh> {
        self.mesh.clone()
    }
}

/// One iteration of Gauss's and Newton's method; returns the largest change, `None` where the result is not
/// finite.
fn shortest_change(equations: &Held<'_>, ends: &mut [f64], p: &[f64]) -> Option<f64> {
    let before = ends.to_vec();
    let (count, columns) = (equations.condition_count(), ends.len() + p.len());
    let (mut g, mut jacobian) = (vec![0.0; count], vec![0.0; count * columns]);
    let at = Ends::new(equations.segments(), ends);
    equations.conditions_jacobian(at, p, &mut g, &mut jacobian);
    // Conditions of very different size count alike.
    for (row, g) in jacobian.chunks_exact_mut(columns).zip(&mut g) {
        let largest = row[..ends.len()]
            .iter()
            .fold(0.0, |m: f64, a| m.max(a.abs()));
        if largest > 0.0 {
            row.iter_mut().for_each(|a| *a /= largest);
            *g /= largest;
        }
    }
    let rows = || jacobian.chunks_exact(columns).map(|row| &row[..ends.len()]);
    let mut normal: Vec<f64> = rows()
        .flat_map(|a| rows().map(move |b| dot(a, b)))
        .collect();
    let diagonal = || (0..count).map(|i| i * (count + 1));
    let largest = diagonal().map(|i| normal[i]).fold(0.0, f64::max);
    // For conditions that say nothing of the ends or the same.
    for i in diagonal() {
        normal[i] += f64::EPSILON.sqrt() * largest;
    }
    let mut pivots = vec![0; count];
    if largest > 0.0 {
        lu::factor(
            &mut normal,
            count,
            &mut pivots,
            &mut lu::Workspace::new(count),
        )
        .ok()?;
        lu::solve(&normal, count, &pivots, &mut g);
        for (row, factor) in jacobian.chunks_exact(columns).zip(&g) {
            let (of_ends, _) = row.split_at(ends.len());
            add_scaled(ends, -factor, of_ends);
        }
    }
    let changes = ends.iter().zip(&before).map(|(end, before)| end - before);
    all_finite(ends).then(|| changes.fold(0.0, |m: f64, change| m.max(change.abs())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::guess::Constant;
    use crate::problem::problem::Problem;
    use crate::problem::real::Real;

    /// y₁(0) + y₂(0) = 2, y₁(1)² = 9 p, and one condition on p alone.
    struct Conditions;

    impl Problem for Conditions {
        fn segments(&self) -> Vec<Segment> {
            vec![Segment::on(2, 1.0, 3.0)]
        }

        fn parameters(&self) -> usize {
            1
        }

        fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
            dy.copy_from_slice(y);
        }

        fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
            r[0] = at.start(0)[0] + at.start(0)[1] - 2.0;
            r[1] = (at.end(0)[0] + 1.0).powi(2) - p[0] * 9.0;
            r[2] = p[0] - 5.0;
        }
    }

    #[test]
    fn the_line_meets_the_conditions_by_the_shortest_change() {
        let guess = Constant {
            states: vec![vec![7.0; 2]],
            parameters: vec![1.0],
        };
        let equations = Held::none(&Conditions);
        let line = Straight::new(&equations, &guess).unwrap();
        let (mut y, mut slope) = ([0.0; 2], [0.0; 2]);
        for (s, exact) in [(1.0, [1.0, 1.0]), (2.0, [1.5, 0.5]), (3.0, [2.0, 0.0])] {
            line.state(0, s, &mut y);
            let error = |(y, exact): (&f64, &f64)| (y - exact).abs();
            assert!(y.iter().zip(&exact).map(error).all(|error| error < 1e-6));
        }
        line.slope(0, &mut slope);
        assert!((slope[0] - 0.5).abs() < 1e-6 && (slope[1] + 0.5).abs() < 1e-6);
        assert_eq!(line.parameters, [1.0]);
    }
}
