//! Comparison of two sources of derivatives.

use crate::problem::equations::Equations;
use crate::problem::guess::Guess;
use crate::problem::problem::Ends;

/// The largest difference found between two providers of the same equations, and where it was found.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct JacobianCheck {
    /// Largest |a − b| / (1 + |a|) over all values and derivatives compared.
    pub difference: f64,
    /// The segment and the place s of the right-hand side; `None` for a condition.
    pub rhs: Option<(usize, f64)>,
    /// Component of the right-hand side, or index of the condition.
    pub row: usize,
    /// Column of the Jacobian: a state of the segment or, for a condition, an end state in the order of
    /// [`Ends`]; then the parameters. `None` for the value.
    pub column: Option<usize>,
}

/// Compares values and Jacobians of two providers along a guess, at seven places per segment and
/// at the ends. Put it in a unit test of a hand-written Jacobian, with
/// [`FiniteDifferences::of`](crate::FiniteDifferences::of) it as the other provider.
///
/// # Panics
/// If the two do not have the same segments, parameters and number of conditions.
pub fn check_jacobians(a: &dyn Equations, b: &dyn Equations, along: &dyn Guess) -> JacobianCheck {
    let shape = a.shape();
    assert_eq!(shape, b.shape(), "the same segments and counts");
    let mut worst = JacobianCheck {
        difference: 0.0,
        rhs: None,
        row: 0,
        column: None,
    };
    let mut compare = |[a, b]: [&[f64]; 2], rhs: Option<(usize, f64)>, columns: Option<usize>| {
        for (i, (a, b)) in a.iter().zip(b).enumerate() {
            let difference = (a - b).abs() / (1.0 + a.abs());
            // A NaN on either side is the worst difference of all.
            let exceeds = difference > worst.difference && !worst.difference.is_nan();
            if difference.is_nan() || exceeds {
                worst = JacobianCheck {
                    difference,
                    rhs,
                    row: i / columns.unwrap_or(1),
                    column: columns.map(|columns| i % columns),
                };
            }
        }
    };
    let k = shape.parameters;
    let mut p = vec![0.0; k];
    along.parameters(&mut p);
    let mut ends = Vec::new();
    for (index, segment) in shape.segments.iter().enumerate() {
        let n = segment.states;
        let mut y = vec![0.0; n];
        let at = |theta: f64| segment.from + theta * (segment.to - segment.from);
        for theta in [0.02, 0.13, 0.31, 0.5, 0.73, 0.88, 0.99] {
            along.state(index, at(theta), &mut y);
            let evaluate = |equations: &dyn Equations| {
                let (mut dy, mut jacobian) = (vec![f64::NAN; n], vec![f64::NAN; n * (n + k)]);
                equations.rhs_jacobian(index, at(theta), &y, &p, &mut dy, &mut jacobian);
                (dy, jacobian)
            };
            let ((f_a, j_a), (f_b, j_b)) = (evaluate(a), evaluate(b));
            let place = Some((index, at(theta)));
            compare([&f_a, &f_b], place, None);
            compare([&j_a, &j_b], place, Some(n + k));
        }
        // A joined point is seen from before and from behind.
        let joined = segment.joined.iter().flat_map(|&s| [s, s]);
        for s in [segment.from].into_iter().chain(joined).chain([segment.to]) {
            along.state(index, s, &mut y);
            ends.extend_from_slice(&y);
        }
    }
    let at = Ends::new(&shape.segments, &ends);
    let (rows, columns) = (shape.conditions, ends.len() + k);
    let evaluate = |equations: &dyn Equations| {
        let (mut r, mut jacobian) = (vec![f64::NAN; rows], vec![f64::NAN; rows * columns]);
        equations.conditions_jacobian(at, &p, &mut r, &mut jacobian);
        (r, jacobian)
    };
    let ((r_a, j_a), (r_b, j_b)) = (evaluate(a), evaluate(b));
    compare([&r_a, &r_b], None, None);
    compare([&j_a, &j_b], None, Some(columns));
    worst
}
